//! Generated motions: pulses against their closed forms, random ones against theory
//! over a thousand seeds.
#![allow(clippy::unwrap_used)]

use std::f64::consts::{PI, TAU};

use pounding_ground_motion::Accelerogram;
use pounding_ground_motion::generators::{
    Boore2003, CloughPenzien1975, Diminution, Envelope, FaultMechanism, Generated, KanaiTajimi1960,
    MakrisRoussos2000, MavroeidisPapageorgiou2003, PowerSpectrum, PulseType,
    RezaeianDerKiureghian2010, RezaeianDerKiureghianScenario, Ricker1953, Sine, StationaryMotion,
    TimeGrid,
};
use pounding_ground_motion::measures::{GroundMotion, Husid};
use pounding_ground_motion::spectra::{
    Evaluation, fourier_spectrum, oscillator_response, response_spectrum,
};

const G: f64 = 9.80665;
const SEEDS: u64 = 1000;

fn near(found: f64, exact: f64, tolerance: f64) {
    assert!(
        (found - exact).abs() <= tolerance * exact.abs(),
        "{found} for {exact}: off by {:e}",
        found / exact - 1.0
    );
}

/// A mean over seeds with its standard error.
#[derive(Clone, Copy, Default)]
struct Mean {
    sum: f64,
    squares: f64,
}

impl Mean {
    fn add(&mut self, value: f64) {
        self.sum += value;
        self.squares += value * value;
    }

    fn value(&self) -> f64 {
        self.sum / SEEDS as f64
    }

    /// Within three and a half standard errors of theory, which must be a small part of
    /// it: 1 of 2000 such tests fails by chance, and seeds are fixed.
    fn meets(&self, exact: f64, greatest_error: f64) {
        let n = SEEDS as f64;
        let error = ((self.squares / n - self.value().powi(2)) / n).sqrt();
        assert!(
            error < greatest_error * exact,
            "standard error {error} of {exact}"
        );
        let apart = (self.value() - exact) / error;
        assert!(
            apart.abs() < 3.5,
            "{} for {exact}: {apart} standard errors",
            self.value()
        );
    }
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
    // Each has its greatest value one where its formula says.
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

/// The second derivative of a Gaussian leaves nothing behind; its spectrum is greatest at
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

fn firm() -> KanaiTajimi1960 {
    KanaiTajimi1960 {
        intensity: 0.01,
        ground_frequency: 15.6,
        ground_damping: 0.6,
    }
}

/// `2 int_0^end S(w) f(w) dw` by the trapezoid rule on steps far below the bandwidths.
fn two_sided(end: f64, integrand: impl Fn(f64) -> f64) -> f64 {
    let count = 400_000;
    let step = end / f64::from(count);
    let inner: f64 = (1..count).map(|i| integrand(f64::from(i) * step)).sum();
    2.0 * step * (inner + 0.5 * (integrand(0.0) + integrand(end)))
}

/// The variance of Kanai and Tajimi in closed form; Clough and Penzien's spectrum has
/// nothing at zero frequency and the same at high ones.
#[test]
fn power_spectra() {
    let kt = firm();
    // The tail beyond the end is 4 zg^2 wg^2 S0/w^2.
    let end = 2.0e4;
    let tail = 2.0 * 4.0 * (0.6 * 15.6_f64).powi(2) * 0.01 / end;
    near(
        two_sided(end, |w| kt.density(w)) + tail,
        kt.variance(),
        1e-6,
    );
    let peak = KanaiTajimi1960::for_peak(3.0, 3.0, 15.6, 0.6).unwrap();
    near(peak.variance(), 1.0, 1e-12);
    let cp = CloughPenzien1975 {
        ground: kt,
        filter_frequency: 1.5,
        filter_damping: 0.6,
    };
    assert_eq!(cp.density(0.0), 0.0);
    near(cp.density(500.0), kt.density(500.0), 1e-4);
    assert!(CloughPenzien1975::of_ground("soft", 0.01).is_some());
    assert!(CloughPenzien1975::of_ground("hard", 0.01).is_none());
    let bad = StationaryMotion {
        spectrum: KanaiTajimi1960 {
            ground_damping: -0.1,
            ..kt
        },
        envelope: Envelope::Constant,
    };
    assert!(bad.generate(grid(0.01, 10.0), 1).is_err());
}

/// Stationary motions: variance, mean square and mean peak of an oscillator's
/// acceleration over a thousand seeds.
#[test]
fn kanai_tajimi_ensemble() {
    let motion = StationaryMotion {
        spectrum: firm(),
        envelope: Envelope::Constant,
    };
    let (step, duration, period, zeta) = (0.01, 20.0, 0.5, 0.05);
    let nyquist = PI / step;
    let w0 = TAU / period;
    let gain = |w: f64| {
        let below = (w0 * w0 - w * w).powi(2) + (2.0 * zeta * w0 * w).powi(2);
        w0.powi(4) / below
    };
    let variance = two_sided(nyquist, |w| firm().density(w));
    let response = two_sided(nyquist, |w| firm().density(w) * gain(w));
    let rate = two_sided(nyquist, |w| firm().density(w) * gain(w) * w * w);
    let [mut squares, mut response_squares, mut peaks, mut arias] = [Mean::default(); 4];
    for seed in 0..SEEDS {
        let made = motion
            .generate(grid(step, duration), seed)
            .unwrap()
            .accelerogram;
        let a = made.samples();
        squares.add(a.iter().map(|a| a * a).sum::<f64>() / a.len() as f64);
        let husid = Husid::of(&made, Evaluation::AtSamples).unwrap();
        arias.add(husid.arias_intensity());
        let history = oscillator_response(&made, period, zeta).unwrap();
        // Transients are down to exp(-6) after 10 s.
        let late = &history.displacement[1000..];
        let square = late.iter().map(|u| (w0 * w0 * u).powi(2)).sum::<f64>();
        response_squares.add(square / late.len() as f64);
        peaks.add(w0 * w0 * late.iter().fold(0.0_f64, |m, u| m.max(u.abs())));
    }
    squares.meets(variance, 0.005);
    arias.meets(PI / (2.0 * G) * variance * duration, 0.005);
    response_squares.meets(response, 0.02);
    // Davenport (1964): peak factor of n = rate * 10 s crossings, corrected for the
    // narrow band by Der Kiureghian (1980), Earthq. Eng. Struct. Dyn. 8, eq. 14-16.
    let (zero, first) = (
        response,
        two_sided(nyquist, |w| firm().density(w) * gain(w) * w),
    );
    let spread = (1.0 - first * first / (zero * rate)).sqrt();
    let crossings = (rate / zero).sqrt() / PI * 10.0;
    let effective = if spread < 0.69 {
        (1.63 * spread.powf(0.45) - 0.38) * crossings
    } else {
        crossings
    };
    let root = (2.0 * effective.ln()).sqrt();
    let factor = root + 0.5772 / root;
    near(peaks.value(), factor * response.sqrt(), 0.05);
}

fn rezaeian() -> RezaeianDerKiureghian2010 {
    RezaeianDerKiureghian2010 {
        arias_intensity: 0.5,
        significant_duration: 12.0,
        middle_time: 8.0,
        middle_frequency: 5.0,
        frequency_rate: -0.08,
        damping: 0.3,
        high_pass: 0.1,
    }
}

/// A thousand motions have the intensity, the durations and the middle that were asked
/// for, less what the high-pass takes off: `int S |H|^2/int S` of white noise through the
/// filter, `|H| = r/(1 + r)`, `r = (w/wc)^2`.
#[test]
fn rezaeian_ensemble() {
    let asked = rezaeian();
    let (mut arias, mut duration, mut middle) = (0.0, 0.0, 0.0);
    let mut curve = vec![0.0; 3501];
    for seed in 0..SEEDS {
        let motion = asked.generate(grid(0.01, 35.0), seed).unwrap().accelerogram;
        let husid = Husid::of(&motion, Evaluation::PiecewiseLinear).unwrap();
        arias += husid.arias_intensity() / SEEDS as f64;
        duration += husid.between(0.05, 0.95).unwrap().duration() / SEEDS as f64;
        middle += husid.time_of(0.45).unwrap() / SEEDS as f64;
        for (c, i) in curve.iter_mut().zip(husid.intensity()) {
            *c += i / SEEDS as f64;
        }
    }
    let (w, zeta) = (TAU * asked.middle_frequency, asked.damping);
    let density = |x: f64| 1.0 / ((w * w - x * x).powi(2) + (2.0 * zeta * w * x).powi(2));
    let kept = |x: f64| {
        let r = (x / (TAU * asked.high_pass)).powi(2);
        (r / (1.0 + r)).powi(2)
    };
    let part = two_sided(PI / 0.01, |x| density(x) * kept(x)) / two_sided(PI / 0.01, density);
    eprintln!(
        "Ia {arias} of {}, D {duration}, t45 {middle}, part {part}",
        asked.arias_intensity
    );
    // Straight lines between samples lose energy: (w h)^2/6 of a sine.
    let chord = 1.0 - (w * 0.01).powi(2) / 6.0;
    near(arias, asked.arias_intensity * part * chord, 0.02);
    // The mean curve has the times of the gamma density.
    let time = |level: f64| {
        let wanted = level * curve[3500];
        curve.iter().position(|c| *c >= wanted).unwrap() as f64 * 0.01
    };
    near(time(0.95) - time(0.05), asked.significant_duration, 0.01);
    near(time(0.45), asked.middle_time, 0.01);
    // Single motions scatter about it and are a little shorter.
    near(duration, asked.significant_duration, 0.05);
    near(middle, asked.middle_time, 0.02);
}

#[test]
fn rezaeian_scenarios() {
    let scenario = RezaeianDerKiureghianScenario {
        magnitude: 7.0,
        distance: 2.0e4,
        shear_velocity: 760.0,
        mechanism: FaultMechanism::Reverse,
    };
    let median = scenario.median(0.15).unwrap();
    let mut logarithms = 0.0;
    for seed in 0..SEEDS {
        let drawn = scenario.draw(0.15, seed).unwrap();
        assert!(drawn.middle_time <= drawn.significant_duration);
        assert!((5.0..=45.0).contains(&drawn.significant_duration));
        assert!((0.02..1.0).contains(&drawn.damping));
        assert!((-2.0..=0.5).contains(&drawn.frequency_rate));
        logarithms += (drawn.arias_intensity / median.arias_intensity).ln() / SEEDS as f64;
        if seed < 20 {
            drawn.generate(grid(0.01, 60.0), seed).unwrap();
        }
    }
    // The logarithm is normal about the median with deviation 1.4318 sqrt(.5937^2 +
    // .2738^2) = 0.936; draws that are refused shift it little.
    assert!(logarithms.abs() < 0.15, "{logarithms}");
    // A middle beyond what a gamma density can have.
    let bad = RezaeianDerKiureghian2010 {
        middle_time: 2.0,
        ..rezaeian()
    };
    assert!(bad.generate(grid(0.01, 35.0), 0).is_err());
}

fn source() -> Boore2003 {
    Boore2003::western_north_america(6.5, 2.0e4)
}

/// The numbers of the page: corner 0.186 Hz at M 6.5, 8 MPa, 3500 m/s; window one at a
/// fifth of its length, 0.05 at its end.
#[test]
fn a_point_source() {
    let source = source();
    near(source.corner_frequency(), 0.186, 3e-3);
    near(source.moment(), 10.0_f64.powf(18.8), 1e-12);
    let length = 2.0 * source.duration();
    near(source.window(0.2 * length), 1.0, 1e-12);
    near(source.window(length), 0.05, 1e-12);
    assert_eq!(source.window(1.001 * length), 0.0);
    // Beyond 40 km amplitudes fall as the root.
    let at = |r: f64| Boore2003 {
        quality: (1e12, 0.0),
        ..Boore2003::western_north_america(6.5, r)
    };
    near(
        at(4e4).fourier_amplitude(1.0) / at(1.6e5).fourier_amplitude(1.0),
        2.0,
        1e-6,
    );
    near(
        at(1e4).fourier_amplitude(1.0) / at(2e4).fourier_amplitude(1.0),
        2.0,
        1e-6,
    );
    let highest = Boore2003 {
        diminution: Diminution::HighestFrequency(10.0),
        ..source.clone()
    };
    let none = Boore2003 {
        diminution: Diminution::Kappa(0.0),
        ..source.clone()
    };
    near(
        highest.fourier_amplitude(10.0) / none.fourier_amplitude(10.0),
        0.5_f64.sqrt(),
        1e-12,
    );
    assert!(source.generate(grid(0.01, 5.0), 0).is_err());
}

/// Fourier amplitudes, intensity, duration and mean spectrum of a thousand motions: the
/// last against random vibration (Cartwright and Longuet-Higgins 1956; duration of the
/// oscillator by Boore and Joyner 1984, Bull. Seism. Soc. Am. 74, 2035).
#[test]
fn point_source_ensemble() {
    let source = source();
    let grid = grid(0.02, 20.0);
    let (mut arias, mut duration) = (Mean::default(), 0.0);
    let bands = [0.3, 1.0, 3.0, 8.0];
    let mut squares = [Mean::default(); 4];
    let periods = [0.2, 0.5, 1.0];
    let mut spectra = [0.0; 3];
    for seed in 0..SEEDS {
        let motion = source.generate(grid, seed).unwrap().accelerogram;
        let husid = Husid::of(&motion, Evaluation::AtSamples).unwrap();
        arias.add(husid.arias_intensity());
        duration += husid.between(0.05, 0.95).unwrap().duration() / SEEDS as f64;
        let spectrum = fourier_spectrum(&motion, 2048);
        for (band, square) in bands.iter().zip(&mut squares) {
            let (mut found, mut exact) = (0.0, 0.0);
            for (f, a) in spectrum.frequencies.iter().zip(&spectrum.amplitudes) {
                if (f / band).ln().abs() < 0.1 {
                    found += a * a;
                    exact += source.fourier_amplitude(*f).powi(2);
                }
            }
            square.add(found / exact);
        }
        let found =
            response_spectrum(&motion, &periods, 0.05, Evaluation::PiecewiseLinear).unwrap();
        for (sum, a) in spectra.iter_mut().zip(&found.pseudo_acceleration) {
            *sum += a / SEEDS as f64;
        }
    }
    let nyquist = PI / 0.02;
    let square = |w: f64| source.fourier_amplitude(w / TAU).powi(2);
    let whole = two_sided(nyquist, square) / TAU;
    arias.meets(PI / (2.0 * G) * whole, 0.01);
    for square in squares {
        square.meets(1.0, 0.04);
    }
    // The energy of the window between 5 and 95 %.
    let length = 2.0 * source.duration();
    let energy: Vec<f64> = (0..=10_000)
        .scan(0.0, |sum, i| {
            *sum += source.window(length * f64::from(i) / 10_000.0).powi(2);
            Some(*sum)
        })
        .collect();
    let time = |part: f64| {
        energy
            .iter()
            .position(|e| *e >= part * energy[10_000])
            .unwrap() as f64
            / 10_000.0
            * length
    };
    near(duration, time(0.95) - time(0.05), 0.1);
    for (period, mean) in periods.iter().zip(spectra) {
        let exact = by_random_vibration(&source, *period);
        eprintln!("{period}: {mean} {exact} {}", mean / exact);
        near(mean, exact, 0.15);
    }
}

fn by_random_vibration(source: &Boore2003, period: f64) -> f64 {
    let (w0, zeta) = (TAU / period, 0.05);
    let power = |w: f64| {
        let below = (w0 * w0 - w * w).powi(2) + (2.0 * zeta * w0 * w).powi(2);
        source.fourier_amplitude(w / TAU).powi(2) * w0.powi(4) / below
    };
    let moment = |k: i32| two_sided(PI / 0.02, |w| power(w) * w.powi(k)) / TAU;
    let (m0, m2, m4) = (moment(0), moment(2), moment(4));
    let strong = source.duration();
    let cube = (strong / period).powi(3);
    let lasting = strong + period / (TAU * zeta) * cube / (cube + 1.0 / 3.0);
    let extremes = (m4 / m2).sqrt() / PI * strong;
    let width = m2 / (m0 * m4).sqrt();
    // sqrt(2) int_0^inf (1 - (1 - width exp(-z^2))^N) dz.
    let factor: f64 = (0..6000)
        .map(|i| {
            1.0 - (1.0 - width * (-(0.001 * (f64::from(i) + 0.5)).powi(2)).exp()).powf(extremes)
        })
        .sum::<f64>()
        * 0.001
        * 2.0_f64.sqrt();
    factor * (m0 / lasting).sqrt()
}

fn bytes(motion: &Accelerogram) -> Vec<u8> {
    motion
        .samples()
        .iter()
        .flat_map(|a| a.to_le_bytes())
        .collect()
}

/// The same seed makes the same bytes, another seed another motion; the record tells
/// which.
#[test]
fn seeds() {
    let kt = StationaryMotion {
        spectrum: firm(),
        envelope: Envelope::JenningsHousnerTsai1968 {
            rise: 4.0,
            strong_end: 15.0,
            decay: 0.0992,
        },
    };
    let cp = StationaryMotion {
        spectrum: CloughPenzien1975::of_ground("medium", 0.01).unwrap(),
        envelope: kt.envelope,
    };
    let makers: [&dyn Fn(u64) -> Generated; 4] = [
        &|s| kt.generate(grid(0.01, 30.0), s).unwrap(),
        &|s| cp.generate(grid(0.01, 30.0), s).unwrap(),
        &|s| rezaeian().generate(grid(0.01, 30.0), s).unwrap(),
        &|s| source().generate(grid(0.01, 30.0), s).unwrap(),
    ];
    for make in makers {
        let (a, b, other) = (make(7), make(7), make(8));
        assert_eq!(bytes(&a.accelerogram), bytes(&b.accelerogram));
        assert_eq!(a, b);
        assert_ne!(bytes(&a.accelerogram), bytes(&other.accelerogram));
        assert!(a.steps[0].to_string().contains("seed 7"));
        assert!(
            serde_json::to_string(&a.steps)
                .unwrap()
                .contains("achieved Arias intensity")
        );
    }
}
