//! Pulses and envelopes against their closed forms.
use std::f64::consts::{PI, TAU};

use pounding_ground_motion::GroundMotionError;
use pounding_ground_motion::generators::{
    CloughPenzien1975, Envelope, Generated, KanaiTajimi1960, MakrisRoussos2000,
    MavroeidisPapageorgiou2003, PulseType, Ricker1953, Sine, StationaryMotion, TimeGrid,
};
use pounding_ground_motion::measures::GroundMotion;
use pounding_ground_motion::spectra::{Evaluation, fourier_spectrum};

fn near(found: f64, exact: f64, tolerance: f64) {
    assert!(
        (found - exact).abs() <= tolerance * exact.abs(),
        "{found} for {exact}: off by {:e}",
        found / exact - 1.0
    );
}
fn grid(time_step: f64, duration: f64) -> TimeGrid {
    TimeGrid {
        time_step,
        duration,
    }
}

fn ground(motion: &Generated) -> GroundMotion {
    GroundMotion::of(&motion.accelerogram, 0.0, 0.0)
}

#[test]
fn sines_and_envelopes() {
    let sine = Sine {
        amplitude: 2.0,
        frequency: 1.5,
        phase: 0.3,
        length: 4.0,
        envelope: Envelope::Ramped {
            rise: 1.0,
            fall: 2.0,
        },
    };
    let motion = sine.generate(grid(0.01, 6.0)).unwrap();
    let a = motion.accelerogram.samples();
    let value = |t: f64| 2.0 * (TAU * 1.5 * t + 0.3).sin();
    near(a[50], 0.5 * value(0.5), 1e-12);
    near(a[150], value(1.5), 1e-12);
    near(a[350], 0.25 * value(3.5), 1e-12);
    assert_eq!(a[450], 0.0);
    assert!(
        Sine {
            frequency: 60.0,
            ..sine
        }
        .generate(grid(0.01, 6.0))
        .is_err()
    );
    // Each has its maximum value one where its formula says.
    for (envelope, peak_at) in [
        (Envelope::HalfSine, 10.0),
        (Envelope::Decay { rate: 0.3 }, 0.0),
        (
            Envelope::JenningsHousnerTsai1968 {
                rise: 4.0,
                strong_end: 15.0,
                decay: 0.0992,
            },
            10.0,
        ),
        (
            Envelope::SaragoniHart1974 {
                power: 2.0,
                rate: 0.5,
            },
            4.0,
        ),
        (
            Envelope::ShinozukaSato1967 {
                slow: 0.1,
                fast: 0.5,
            },
            5.0_f64.ln() / 0.4,
        ),
    ] {
        near(envelope.at(peak_at, 20.0), 1.0, 1e-12);
        for i in 0..=200 {
            assert!(envelope.at(0.1 * f64::from(i), 20.0) <= 1.0 + 1e-12);
        }
        assert_eq!(envelope.at(21.0, 20.0), 0.0);
    }
}

/// The second derivative of a Gaussian leaves nothing behind; its spectrum is largest at
/// 1/Tp, as `f^2 exp(-f^2 Tp^2)`.
#[test]
fn ricker() {
    let pulse = Ricker1953 {
        amplitude: 3.0,
        period: 0.8,
        centre: 2.0,
    };
    let motion = pulse.generate(grid(0.005, 4.0)).unwrap();
    near(motion.accelerogram.peak().value, 3.0, 1e-14);
    let ground = ground(&motion);
    assert!(ground.end_velocity().abs() < 1e-9 && ground.end_displacement().abs() < 1e-9);
    // Displacement -A Tp^2/(2 pi^2) exp(-x).
    near(
        ground.peak_displacement(Evaluation::PiecewiseLinear).value,
        3.0 * 0.64 / (2.0 * PI * PI),
        1e-4,
    );
    let spectrum = fourier_spectrum(&motion.accelerogram, 1 << 15);
    let amplitude = |f: f64| {
        4.0 * PI.powf(-0.5) * 3.0 * 0.5 * (f * 0.8).powi(2) * 0.8 * (-(f * 0.8).powi(2)).exp()
    };
    for (f, a) in spectrum
        .frequencies
        .iter()
        .zip(&spectrum.amplitudes)
        .take(500)
    {
        assert!(
            (a - amplitude(*f)).abs() < 1e-6,
            "{f}: {a} {}",
            amplitude(*f)
        );
    }
}

/// The integral of the acceleration is the printed velocity, that of the velocity ends at
/// the net displacement.
#[test]
fn mavroeidis_papageorgiou() {
    for (gamma, nu) in [(1.2, 0.0), (1.7, 0.9), (2.0, PI / 2.0), (3.1, -2.0)] {
        let pulse = MavroeidisPapageorgiou2003 {
            amplitude: 0.9,
            frequency: 0.5,
            oscillation: gamma,
            phase: nu,
            centre: 5.0,
        };
        let motion = pulse.generate(grid(0.001, 10.0)).unwrap();
        let ground = ground(&motion);
        let mut worst = 0.0_f64;
        for (i, v) in ground.velocity.iter().enumerate() {
            worst = worst.max((v - pulse.velocity(i as f64 * 0.001)).abs());
        }
        // The acceleration may jump at both ends: half a step of it.
        assert!(worst < 2e-3, "{gamma} {nu}: {worst}");
        assert!((ground.end_displacement() - pulse.net_displacement()).abs() < 5e-3);
        assert!(pulse.generate(grid(0.001, 5.5)).is_err());
    }
}

#[test]
fn makris_roussos() {
    let of = |pulse| {
        let pulse = MakrisRoussos2000 {
            pulse,
            amplitude: 0.8,
            period: 1.25,
            start: 0.5,
        };
        let motion = pulse.generate(grid(0.0005, 9.0)).unwrap();
        (pulse, ground(&motion))
    };
    // Type A: v = v0/2 (1 - cos w t), net displacement v0 T/2.
    let (_, a) = of(PulseType::A);
    near(
        a.peak_velocity(Evaluation::PiecewiseLinear).value,
        0.8,
        1e-6,
    );
    near(a.end_displacement(), 0.8 * 1.25 / 2.0, 1e-5);
    // Type B: v = v0 sin w t, displacement v0 T/pi at half the time, none at the end.
    let (_, b) = of(PulseType::B);
    near(
        b.peak_velocity(Evaluation::PiecewiseLinear).value,
        0.8,
        1e-5,
    );
    near(
        b.peak_displacement(Evaluation::PiecewiseLinear).value,
        0.8 * 1.25 / PI,
        1e-5,
    );
    assert!(b.end_velocity().abs() < 1e-6 && b.end_displacement().abs() < 1e-6);
    for (cycles, phase) in [(1, 0.0697), (2, 0.0410)] {
        let (pulse, c) = of(PulseType::C { cycles });
        // The paper's phases, as printed in parts of pi.
        let found = f64::from(cycles) + 0.5 - pulse.length() / 1.25;
        assert!((found - phase).abs() < 5e-5, "{found}");
        assert!(c.end_velocity().abs() < 1e-5, "{}", c.end_velocity());
        assert!(
            c.end_displacement().abs() < 1e-4,
            "{}",
            c.end_displacement()
        );
    }
}

/// A pulse of several cycles is of no use where its own sampling leaves a velocity: whatever the
/// step, and wherever the pulse starts, on a sample, between two, or with the motion.
#[test]
fn velocities_return_wherever_a_pulse_starts() {
    let (amplitude, period) = (0.8, 1.25);
    let w = TAU / period;
    for step in [0.02, 0.01, 0.005, 0.0013] {
        for start in [
            0.0,
            0.3 * step,
            0.5 * step,
            0.8 * step,
            1.0,
            1.0 + 0.37 * step,
        ] {
            for pulse in [
                PulseType::A,
                PulseType::B,
                PulseType::C { cycles: 1 },
                PulseType::C { cycles: 3 },
            ] {
                let pulse = MakrisRoussos2000 {
                    pulse,
                    amplitude,
                    period,
                    start,
                };
                let long = start + pulse.length();
                // Also with the end of the motion at that of the pulse or a step after it.
                for duration in [long, long + step, 8.0] {
                    if duration < (long / step).ceil() * step - 0.5 * step {
                        continue;
                    }
                    let left = ground(&pulse.generate(grid(step, duration)).unwrap());
                    let left = left.end_velocity().abs() / amplitude;
                    assert!(
                        left < 0.25 * (w * step).powi(2) + 1.0e-6,
                        "{pulse:?} with {step} s over {duration} s leaves {left}"
                    );
                }
            }
        }
    }
    let starting = |pulse| {
        let of = MakrisRoussos2000 {
            pulse,
            amplitude,
            period,
            start: 0.0,
        };
        let motion = of.generate(grid(0.02, 8.0)).unwrap();
        let left = ground(&motion).end_velocity().abs();
        (motion.accelerogram.samples()[0], left)
    };
    let (first, left) = starting(PulseType::B);
    near(first, amplitude * w, 1e-12);
    assert!(left < 1e-4, "{left}");
    // With the velocity that the halved sample took off, it was 0.04.
    let (first, left) = starting(PulseType::C { cycles: 2 });
    near(first, amplitude * w * (0.0410 * PI).cos(), 1e-4);
    assert!(left < 4e-4, "{left}");
}

/// A sine that begins or ends anywhere has the velocity of its integral, `A/w (cos p - cos(w l +
/// p))`; a whole period of a cosine none.
#[test]
fn sines_end_with_the_velocity_of_their_integral() {
    let w = TAU * 1.5;
    for step in [0.02, 0.01, 0.0013] {
        for (phase, length) in [
            (0.0, 1.0 / 3.0),
            (PI / 2.0, 2.0 / 3.0),
            (0.7, 1.0),
            (1.1, 3.137),
        ] {
            let sine = Sine {
                amplitude: 2.0,
                frequency: 1.5,
                phase,
                length,
                envelope: Envelope::Constant,
            };
            let found = ground(&sine.generate(grid(step, 5.0)).unwrap()).end_velocity();
            let exact = 2.0 / w * (phase.cos() - (w * length + phase).cos());
            let off = (found - exact).abs() * w / 2.0;
            assert!(
                off < 0.5 * (w * step).powi(2),
                "{step} {phase} {length}: {off}"
            );
        }
    }
}

/// Those whose acceleration has no jump need nothing of the kind.
#[test]
fn smooth_pulses_leave_the_velocity_of_their_formula() {
    for step in [0.02, 0.01, 0.0013] {
        for part in [0.0, 0.4] {
            for (gamma, nu) in [(1.5, 0.0), (2.0, PI / 2.0), (3.1, -2.0)] {
                let pulse = MavroeidisPapageorgiou2003 {
                    amplitude: 0.8,
                    frequency: 0.8,
                    oscillation: gamma,
                    phase: nu,
                    centre: 0.5 * gamma / 0.8 + part * step,
                };
                let left = ground(&pulse.generate(grid(step, 8.0)).unwrap()).end_velocity();
                let bound = 0.25 * (TAU * 0.8 * step).powi(2) * 0.8;
                assert!(left.abs() < bound, "{gamma} {nu} {step}: {left}");
            }
            let ricker = Ricker1953 {
                amplitude: 3.0,
                period: 1.25,
                centre: 1.5 * 1.25 + part * step,
            };
            let left = ground(&ricker.generate(grid(step, 8.0)).unwrap()).end_velocity();
            assert!(left.abs() < 1e-6, "{step}: {left}");
        }
    }
}

/// A wavelet of which the motion does not hold one period on either side of its centre is refused; it was cut,
/// with a quarter of a metre per second left behind. What is just held leaves nothing behind.
#[test]
fn ricker_wavelets_are_not_cut() {
    let pulse = |period: f64, centre: f64, duration: f64| {
        let pulse = Ricker1953 {
            amplitude: 3.0,
            period,
            centre,
        };
        pulse.generate(grid(0.01, duration))
    };
    for (centre, duration, words) in [
        (1.5, 1.6, "the pulse takes 2 s, and the duration is 1.6 s"),
        (1.5, 2.2, "centre"),
        (0.0, 5.0, "centre"),
        (4.5, 5.0, "centre"),
    ] {
        let error = pulse(1.0, centre, duration).unwrap_err().to_string();
        assert!(error.contains(words), "{centre} {duration}: {error}");
    }
    for (centre, duration) in [(1.0, 2.0), (1.5, 2.5), (4.0, 5.0)] {
        let made = pulse(1.0, centre, duration).unwrap();
        let ground = ground(&made);
        let peak = ground.peak_velocity(Evaluation::PiecewiseLinear).value;
        assert!(ground.end_velocity().abs() < 1e-3 * peak, "{centre}");
    }
}

/// Of two exponentials the faster is faster: the interval is open, and the envelope of rates that are nearly one
/// is the limit `e r t exp(-r t)`.
#[test]
fn rates_of_two_exponentials_differ() {
    let envelope = |fast: f64| Envelope::ShinozukaSato1967 { slow: 0.5, fast };
    let sine = |fast: f64| Sine {
        amplitude: 1.0,
        frequency: 1.0,
        phase: 0.0,
        length: 20.0,
        envelope: envelope(fast),
    };
    for fast in [0.5, 0.4, f64::INFINITY, f64::NAN] {
        let error = sine(fast).generate(grid(0.01, 20.0)).unwrap_err();
        assert!(error.to_string().contains("outside (0.5, inf)"), "{error}");
    }
    let nearly = 0.5_f64.next_up();
    assert!(sine(nearly).generate(grid(0.01, 20.0)).is_ok());
    for t in [0.5_f64, 2.0, 8.0] {
        let limit = (1.0 - 0.5 * t).exp() * 0.5 * t;
        near(envelope(nearly).at(t, 20.0), limit, 1e-12);
        near(envelope(0.5 * (1.0 + 1e-5)).at(t, 20.0), limit, 1e-4);
    }
}

/// A motion of each kind of pulse with a period (s), at 10 ms.
fn of_period(period: f64) -> [Result<Generated, GroundMotionError>; 4] {
    let grid = grid(0.01, 8.0);
    let (amplitude, frequency) = (0.8, 1.0 / period);
    let sine = Sine {
        amplitude,
        frequency,
        phase: 0.0,
        length: 4.0,
        envelope: Envelope::Constant,
    };
    let ricker = Ricker1953 {
        amplitude,
        period,
        centre: 4.0,
    };
    let velocity_pulse = MavroeidisPapageorgiou2003 {
        amplitude,
        frequency,
        oscillation: 2.0,
        phase: 0.0,
        centre: 4.0,
    };
    let trigonometric = MakrisRoussos2000 {
        pulse: PulseType::B,
        amplitude,
        period,
        start: 1.0,
    };
    [
        sine.generate(grid),
        ricker.generate(grid),
        velocity_pulse.generate(grid),
        trigonometric.generate(grid),
    ]
}

/// Part of a sine that straight lines between `count` samples of a period have, by the sum of
/// their product with it.
fn part_of_a_sine(count: f64) -> f64 {
    let value = |i: f64| (TAU * i / count).sin();
    let line = |x: f64| {
        let (i, part) = (x.floor(), x.fract());
        value(i) + part * (value(i + 1.0) - value(i))
    };
    let (periods, points) = (100.0, 400_000);
    let at = |k: i32| f64::from(k) * periods * count / f64::from(points);
    (0..points)
        .map(|k| 2.0 * line(at(k)) * (TAU * at(k) / count).sin())
        .sum::<f64>()
        / f64::from(points)
}

#[test]
fn periods_that_the_time_step_does_not_show() {
    // Half the sampling rate and above: zeros, or another motion.
    for period in [0.02, 1.0 / 60.0, 0.01] {
        for made in of_period(period) {
            let error = made.unwrap_err();
            assert!(error.to_string().contains("below 50 Hz"), "{error}");
            assert!(error.help().is_some());
        }
    }
    for (period, told) in [(0.025, true), (0.08, true), (0.1, false), (0.5, false)] {
        let lost = 100.0 * (1.0 - part_of_a_sine(period / 0.01));
        // From 3 % on it is said.
        assert_eq!(lost > 3.3, told, "{lost}");
        for made in of_period(period) {
            let remarks = made.unwrap().steps[0].remarks.join("; ");
            let remark = format!("have {lost:.0} % less");
            assert_eq!(remarks.contains(&remark), told, "{remark}: {remarks}");
        }
    }
}

/// 2/(0.5 Hz) of the one and one period of the other do not fit into 3 s, wherever they start.
#[test]
fn pulses_longer_than_the_motion() {
    let velocity_pulse = MavroeidisPapageorgiou2003 {
        amplitude: 0.8,
        frequency: 0.5,
        oscillation: 2.0,
        phase: 0.0,
        centre: 2.0,
    };
    let trigonometric = MakrisRoussos2000 {
        pulse: PulseType::A,
        amplitude: 0.8,
        period: 4.0,
        start: 0.0,
    };
    for duration in [3.0, 4.0] {
        let grid = grid(0.01, duration);
        for made in [velocity_pulse.generate(grid), trigonometric.generate(grid)] {
            match made {
                Ok(_) => assert!(duration >= 4.0),
                Err(error) => {
                    let told = error.to_string();
                    let wanted = "the pulse takes 4 s, and the duration is 3 s";
                    assert!(duration < 4.0 && told.contains(wanted), "{told}");
                }
            }
        }
    }
}

/// Each generator names itself.
#[test]
fn filtered_noise_names_itself() {
    let ground = KanaiTajimi1960 {
        intensity: 1.0,
        ground_frequency: 15.6,
        ground_damping: 0.6,
    };
    let rigid = KanaiTajimi1960 {
        ground_damping: 0.0,
        ..ground
    };
    for (error, wanted) in [
        (
            KanaiTajimi1960::for_peak(3.0, 0.0, 15.6, 0.6).err(),
            "kanai_tajimi_1960: peak factor",
        ),
        (
            CloughPenzien1975::for_peak(3.0, 0.0, ground, 1.56, 0.6).err(),
            "clough_penzien_1975: peak factor",
        ),
        (
            CloughPenzien1975::for_peak(3.0, 3.0, rigid, 1.56, 0.6).err(),
            "clough_penzien_1975: ground damping",
        ),
    ] {
        let told = error.unwrap().to_string();
        assert!(told.starts_with(wanted), "{told}");
    }
}

/// The last sample is at a whole number of steps, which is said where it is not what was asked for.
#[test]
fn durations_between_two_samples() {
    let sine = Sine {
        amplitude: 1.0,
        frequency: 1.0,
        phase: 0.0,
        length: 5.0,
        envelope: Envelope::Constant,
    };
    for (duration, end, told) in [(5.005, 5.01, true), (5.0, 5.0, false), (5.07, 5.07, false)] {
        let made = sine.generate(grid(0.01, duration)).unwrap();
        near(made.accelerogram.duration(), end, 1e-12);
        let remarks = made.steps[0].remarks.join("; ");
        let remark = format!(
            "{duration} s are no whole number of time steps: the last sample is at {end} s"
        );
        assert_eq!(remarks.contains(&remark), told, "{remarks}");
    }
}

/// An envelope whose maximum value lies behind the end makes a motion weaker than was asked for.
#[test]
fn envelopes_that_never_reach_one() {
    let spectrum = KanaiTajimi1960::for_peak(3.0, 3.0, 15.6, 0.6).unwrap();
    for envelope in [
        Envelope::JenningsHousnerTsai1968 {
            rise: 10.0,
            strong_end: 15.0,
            decay: 0.1,
        },
        Envelope::SaragoniHart1974 {
            power: 2.0,
            rate: 0.2,
        },
        // (ln 0.2 - ln 0.05)/0.15 = 9.24 s.
        Envelope::ShinozukaSato1967 {
            slow: 0.05,
            fast: 0.2,
        },
    ] {
        let motion = StationaryMotion { spectrum, envelope };
        let at = |i: u32| envelope.at(0.1 * f64::from(i), 20.0);
        let highest = |end: u32| (0..=end).map(at).fold(0.0, f64::max);
        for (duration, reached) in [(5.0, false), (9.0, false), (10.0, true)] {
            assert_eq!(
                highest((10.0 * duration) as u32) > 0.9999,
                reached,
                "{envelope:?}"
            );
            match motion.generate(grid(0.01, duration), 1) {
                Ok(_) => assert!(reached, "{envelope:?} {duration}"),
                Err(error) => {
                    let told = error.to_string();
                    assert!(!reached && told.contains("it reaches one at"), "{told}");
                }
            }
        }
    }
}
