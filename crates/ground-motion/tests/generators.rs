//! Random motions against theory over a thousand seeds.
use std::f64::consts::{PI, TAU};

use crate::ensemble::{G, Mean, SEEDS, grid, near, two_sided};
use pounding_ground_motion::Accelerogram;
use pounding_ground_motion::generators::{
    Boore2003, CloughPenzien1975, Envelope, FaultMechanism, Generated, KanaiTajimi1960,
    PowerSpectrum, RezaeianDerKiureghian2010, RezaeianDerKiureghianScenario, StationaryMotion,
    TimeGrid,
};
use pounding_ground_motion::measures::Husid;
use pounding_ground_motion::spectra::{Evaluation, oscillator_response};

fn firm() -> KanaiTajimi1960 {
    KanaiTajimi1960 {
        intensity: 0.01,
        ground_frequency: 15.6,
        ground_damping: 0.6,
    }
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

fn clough_penzien(peak: f64, filter_frequency: f64) -> CloughPenzien1975 {
    CloughPenzien1975::for_peak(peak, 3.0, firm(), filter_frequency, 0.6).unwrap()
}

/// The variance after both filters against quadrature, and that of Kanai and Tajimi where the
/// second filter takes nothing off.
#[test]
fn the_variance_of_both_filters_is_the_integral_of_the_density() {
    for (ground_frequency, ground_damping, filter_frequency, filter_damping) in [
        (15.6, 0.6, 1.56, 0.6),
        (15.0, 0.6, 1.5, 0.6),
        (10.0, 0.4, 1.0, 0.6),
        (5.0, 0.2, 0.5, 0.6),
        (3.0, 0.1, 9.0, 2.0),
    ] {
        let spectrum = CloughPenzien1975 {
            ground: KanaiTajimi1960 {
                intensity: 0.01,
                ground_frequency,
                ground_damping,
            },
            filter_frequency,
            filter_damping,
        };
        // Beyond the end it is 4 zg^2 wg^2 S0/w^2.
        let end = 2.0e4;
        let tail = 8.0 * (ground_damping * ground_frequency).powi(2) * 0.01 / end;
        let found = two_sided(end, |w| spectrum.density(w)) + tail;
        near(found, spectrum.variance(), 1e-5);
        let without = CloughPenzien1975 {
            filter_frequency: 1e-6,
            ..spectrum
        };
        near(without.variance(), without.ground.variance(), 1e-5);
    }
    for filter_frequency in [0.5, 1.56, 5.0] {
        let spectrum = clough_penzien(3.0, filter_frequency);
        near(spectrum.variance(), 1.0, 1e-12);
        near(two_sided(2.0e4, |w| spectrum.density(w)), 1.0, 1e-3);
    }
    let refused = CloughPenzien1975::for_peak(3.0, 3.0, firm(), -1.0, 0.6);
    assert!(refused.is_err());
}

/// A thousand motions have the standard deviation that their peak asks for, less the 2 % that the
/// spectrum has beyond half the sampling rate.
#[test]
fn clough_penzien_ensemble() {
    for filter_frequency in [1.56, 5.0] {
        let motion = StationaryMotion {
            spectrum: clough_penzien(3.0, filter_frequency),
            envelope: Envelope::Constant,
        };
        let mut squares = Mean::default();
        for seed in 0..SEEDS {
            let made = motion.generate(grid(0.005, 20.0), seed).unwrap();
            let a = made.accelerogram.samples();
            squares.add(a.iter().map(|a| a * a).sum::<f64>() / a.len() as f64);
        }
        squares.meets(two_sided(PI / 0.005, |w| motion.spectrum.density(w)), 0.005);
        near(squares.value(), 1.0, 0.02);
    }
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

/// What a high-pass takes of the expected Arias intensity is said where it is more than a tenth, and is what the
/// mean of many motions lacks; so is a filter that would leave its bounds.
#[test]
fn rezaeian_high_pass_that_takes_much() {
    let usual = RezaeianDerKiureghian2010::usual(12.0, 8.0, 3.0);
    let cases = [
        // Middle frequency, frequency rate, damping ratio, corner (Hz); whether the filter is held.
        ((1.0, -0.02, 0.3, 0.15), false),
        ((1.0, -0.1, 0.3, 0.15), true),
        ((1.5, -0.1, 0.6, 0.2), false),
        ((3.0, -2.0, 0.3, 0.15), true),
        ((0.3, 0.0, 0.3, 1.0), false),
        ((6.0, -0.1, 0.9, 0.5), false),
    ];
    for ((middle_frequency, frequency_rate, damping, high_pass), is_held) in cases {
        let motion = RezaeianDerKiureghian2010 {
            middle_frequency,
            frequency_rate,
            damping,
            high_pass,
            ..usual
        };
        let (mut arias, mut said) = (0.0, Vec::new());
        let seeds = 200;
        for seed in 0..seeds {
            let made = motion.generate(grid(0.02, 50.0), seed).unwrap();
            let husid = Husid::of(&made.accelerogram, Evaluation::AtSamples).unwrap();
            arias += husid.arias_intensity() / seeds as f64;
            said = made.warnings().map(str::to_owned).collect();
        }
        let of_loss = said.iter().find(|w| w.contains("high-pass")).unwrap();
        let (_, taken) = of_loss.split_once("takes ").unwrap();
        let taken: f64 = taken.split_once(' ').unwrap().0.parse().unwrap();
        let left = 1.0 - 0.01 * taken;
        // The mean of 200 motions of one to some ten independent cycles scatters by 5 % and less.
        assert!((arias - left).abs() < 0.06 * left + 0.005, "{arias} {left}");
        let held = said.iter().any(|w| w.contains("is held at 0.3 Hz"));
        assert_eq!(held, is_held, "{motion:?}: {said:?}");
    }
    let said = |motion: RezaeianDerKiureghian2010| {
        let made = motion.generate(grid(0.01, 50.0), 1).unwrap();
        let said: Vec<_> = made.warnings().map(str::to_owned).collect();
        said.join("; ")
    };
    assert_eq!(said(usual), "");
    // 3 Hz + 20 Hz/s t reaches 50 Hz 2.35 s after the middle, and 0.3 Hz 0.135 s before it.
    let fast = said(RezaeianDerKiureghian2010 {
        frequency_rate: 20.0,
        ..usual
    });
    for words in [
        "3 Hz at 8 s and +20 Hz/s, is held at 50 Hz, half the sampling rate, from 10.35 s",
        "held at 0.3 Hz, the lowest of the model, until 7.865 s",
    ] {
        assert!(fast.contains(words), "{words}: {fast}");
    }
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
        &|s| {
            Boore2003::western_north_america(6.5, 2.0e4)
                .generate(grid(0.01, 30.0), s)
                .unwrap()
        },
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

/// What `motion synth` and the studies leave out, as docs/reference/ground-motions.md and
/// docs/reference/studies.md have it.
#[test]
fn usual_parameters_are_those_of_the_documentation() {
    let usual = RezaeianDerKiureghian2010::usual(12.0, 8.0, 3.5);
    let expected = RezaeianDerKiureghian2010 {
        arias_intensity: 1.0,
        significant_duration: 12.0,
        middle_time: 8.0,
        middle_frequency: 3.5,
        frequency_rate: -0.1,
        damping: 0.3,
        high_pass: 0.15,
    };
    assert_eq!(usual, expected);
    assert_eq!(TimeGrid::USUAL_TIME_STEP, 0.01);
}

/// A duration that ends before D5-95 does is said, with the part of the Arias intensity that is lost:
/// by hand for an envelope whose square falls as an exponential of rate r, D5-95 = ln(19)/r.
#[test]
fn motions_that_their_duration_cuts_off_are_named() {
    let remarks = |duration: f64| {
        let motion = RezaeianDerKiureghian2010::usual(10.0, 10.000_01 * 0.597_837 / 2.944_439, 3.5);
        let made = motion.generate(grid(0.01, duration), 1).unwrap();
        made.steps[0].remarks.join("; ")
    };
    assert!(!remarks(10.4).contains("warning"), "{}", remarks(10.4));
    // exp(-r 4), r = ln(19)/10: 30.8 %; 99.9 % after ln(1000)/r = 23.5 s.
    let short = remarks(4.0);
    for words in [
        "warning",
        "the duration of 4 s",
        "30.8 %",
        "24 s hold 99.9 %",
    ] {
        assert!(short.contains(words), "{words}: {short}");
    }
}

/// Samples must show the frequency at which a spectrum is highest: 0.1 s apart they end at 5 Hz.
#[test]
fn spectra_above_half_the_sampling_rate() {
    let at = |hertz: f64, time_step: f64| {
        let spectrum = KanaiTajimi1960 {
            intensity: 0.01,
            ground_frequency: TAU * hertz,
            ground_damping: 0.6,
        };
        let grid = TimeGrid {
            time_step,
            duration: 20.0,
        };
        let motion = StationaryMotion {
            spectrum,
            envelope: Envelope::Constant,
        };
        motion.generate(grid, 1)
    };
    for hertz in [5.0, 8.0] {
        let error = at(hertz, 0.1).unwrap_err().to_string();
        assert!(
            error.contains("kanai_tajimi_1960") && error.contains("below 5 Hz"),
            "{error}"
        );
    }
    let few = at(2.0, 0.1).unwrap();
    assert!(few.steps[0].remarks[0].starts_with("only 5.0 samples in a period"));
    assert_eq!(at(2.0, 0.01).unwrap().steps[0].remarks.len(), 1);
}
