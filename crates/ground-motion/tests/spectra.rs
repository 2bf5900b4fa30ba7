//! Response and Fourier spectra against closed forms and against their own definition
//! on finer samples.
use std::f64::consts::{PI, TAU};

use pounding_ground_motion::processing::rotate;
use pounding_ground_motion::spectra::{
    Evaluation, ResponseSpectrum, TargetSpectrum, fourier_spectrum, logarithmic_periods,
    oscillator_response, response_spectra, response_spectrum, rotated_spectrum,
};
use pounding_ground_motion::{AccelerationUnit, Accelerogram, GroundMotionError};
use proptest::prelude::*;

use crate::common::two_components;

const LINEAR: Evaluation = Evaluation::PiecewiseLinear;

fn record(samples: Vec<f64>, step: f64) -> Accelerogram {
    Accelerogram::new(samples, AccelerationUnit::MetrePerSecondSquared, step).unwrap()
}

fn of(function: impl Fn(f64) -> f64, count: usize, step: f64) -> Accelerogram {
    record(
        (0..count).map(|i| function(i as f64 * step)).collect(),
        step,
    )
}

/// The same function of time, straight lines between samples, on finer samples.
fn finer(record: &Accelerogram, times: usize) -> Accelerogram {
    let a = record.samples();
    let mut samples = Vec::new();
    for pair in a.windows(2) {
        for k in 0..times {
            samples.push(pair[0] + (pair[1] - pair[0]) * k as f64 / times as f64);
        }
    }
    samples.push(a[a.len() - 1]);
    self::record(samples, record.time_step() / times as f64)
}

/// A step of the ground: `u w^2/a = 1 + exp(-pi zeta/sqrt(1 - zeta^2))` at half a
/// damped period, wherever samples are.
#[test]
fn a_step_of_the_ground() {
    for zeta in [0.0, 0.02, 0.05, 0.2, 0.7] {
        for period in [0.0731, 0.2, 0.93, 4.7] {
            let ground = record(vec![2.0; 700], 0.013);
            let spectrum = response_spectrum(&ground, &[period], zeta, LINEAR).unwrap();
            let root = f64::sqrt(1.0 - zeta * zeta);
            let exact = 2.0 * (1.0 + (-PI * zeta / root).exp());
            let found = spectrum.pseudo_acceleration[0];
            assert!(
                (found / exact - 1.0).abs() < 1e-12,
                "{zeta} {period}: {found}"
            );
            let history = oscillator_response(&ground, period, zeta).unwrap();
            let first = history.displacement[..2 + (0.5 * period / root / 0.013) as usize]
                .iter()
                .fold(0.0_f64, |m, u| m.max(u.abs()));
            assert!(first <= spectrum.displacement[0] * (1.0 + 1e-12));
        }
    }
}

/// Half a sine without damping (Chopra, Dynamics of Structures, 4.8): residual
/// amplitude `2 b cos(pi/(2 b))/(1 - b^2)` where the period is longer than the
/// pulse asks, forced peak `sin(2 pi b/(1 + b))/(1 - b)` for 1/3 < b < 1, with `b`
/// the frequency of the pulse over that of the oscillator.
#[test]
fn half_a_sine() {
    let (length, step) = (0.4, 2.0e-5);
    let count = 20_001;
    let mut samples: Vec<f64> = (0..count)
        .map(|i| (PI * i as f64 * step / length).sin())
        .collect();
    samples.resize(5 * count, 0.0);
    let ground = record(samples, step);
    // Chords of the sine lie below it by at most this part.
    let chord = (PI / length * step).powi(2) / 8.0;
    for b in [0.4_f64, 0.6, 0.9] {
        let period = 2.0 * length * b;
        let found = response_spectrum(&ground, &[period], 0.0, LINEAR).unwrap();
        let exact = (TAU * b / (1.0 + b)).sin() / (1.0 - b);
        let value = found.pseudo_acceleration[0];
        assert!((value / exact - 1.0).abs() < chord, "{b}: {value} {exact}");
        // Without damping, absolute and pseudo-acceleration are one.
        assert!((found.acceleration[0] / value - 1.0).abs() < 1e-12);
    }
    for b in [1.25_f64, 1.5, 2.0] {
        let period = 2.0 * length * b;
        let found = response_spectrum(&ground, &[period], 0.0, LINEAR).unwrap();
        let exact = 2.0 * b * (PI / (2.0 * b)).cos() / (1.0 - b * b);
        let value = found.pseudo_acceleration[0];
        assert!((value / exact.abs() - 1.0).abs() < chord, "{b}: {value}");
        // Free vibration without damping: the peak velocity is the pseudo-velocity.
        assert!((found.velocity[0] / found.pseudo_velocity[0] - 1.0).abs() < 1e-9);
    }
}

/// A harmonic ground from rest against the closed form of transient and steady state.
#[test]
fn a_harmonic_ground() {
    let (zeta, period, forcing) = (0.05, 0.8, TAU * 1.7);
    let step = 1.0e-4;
    let ground = of(|t| (forcing * t).sin(), 60_001, step);
    let history = oscillator_response(&ground, period, zeta).unwrap();
    let w = TAU / period;
    let damped = w * (1.0_f64 - zeta * zeta).sqrt();
    let (real, imaginary) = (w * w - forcing * forcing, 2.0 * zeta * w * forcing);
    let norm = real * real + imaginary * imaginary;
    // u = c1 sin + c2 cos + transient, of u'' + ... = -sin.
    let (c1, c2) = (-real / norm, imaginary / norm);
    let (t1, t2) = (-c2, -(c1 * forcing + zeta * w * c2) / damped);
    let largest = (c1 * c1 + c2 * c2).sqrt();
    for (i, u) in history.displacement.iter().enumerate().step_by(500) {
        let t = i as f64 * step;
        let exact = c1 * (forcing * t).sin()
            + c2 * (forcing * t).cos()
            + (-zeta * w * t).exp() * (t1 * (damped * t).cos() + t2 * (damped * t).sin());
        assert!((u - exact).abs() < 2e-7 * largest, "{t}: {u} {exact}");
    }
}

#[test]
fn a_rigid_oscillator_feels_the_ground() {
    let ground = of(|t| (9.0 * t).sin() + 0.3 * (31.0 * t).cos(), 400, 0.01);
    let peak = ground.peak().value;
    let spectrum = response_spectrum(&ground, &[0.0, 1e-4, 1e-3], 0.05, LINEAR).unwrap();
    assert_eq!(spectrum.pseudo_acceleration[0], peak);
    assert_eq!(spectrum.acceleration[0], peak);
    // The first sample is a step of 0.3 m/s2 that a stiff oscillator overshoots; the
    // peak comes later, when that has died away. A kink of the straight lines swings
    // it by (change of slope) T/(2 pi), which decays to a twentieth within a step.
    let kink = ground.samples().windows(3).fold(0.0_f64, |m, a| {
        m.max((a[0] - 2.0 * a[1] + a[2]).abs() / 0.01)
    });
    for (a, period) in spectrum.pseudo_acceleration.iter().zip([0.0, 1e-4, 1e-3]) {
        let bound = 1.2 * kink * period / TAU;
        assert!((a - peak).abs() <= bound, "{a} {peak} {bound}");
    }
    for (period, zeta) in [
        (-0.1, 0.05),
        (1e-6, 0.05),
        (1.0, 1.0),
        (1.0, -0.1),
        (f64::NAN, 0.05),
    ] {
        let error = response_spectrum(&ground, &[period], zeta, LINEAR).unwrap_err();
        assert!(matches!(error, GroundMotionError::OutOfRange { .. }));
        assert!(error.help().is_some());
    }
}

/// Long periods keep their digits: the ground's displacement is what is left.
#[test]
fn a_very_long_period_stands_still() {
    // One cycle of sine: velocity returns to zero, displacement ends at A T^2/(2 pi).
    let ground = of(|t| (TAU * t).sin(), 10_001, 1.0e-4);
    let spectrum = response_spectrum(&ground, &[1.0e5], 0.0, LINEAR).unwrap();
    let moved = 1.0 / TAU;
    // Up to the chords of the sine.
    let chord = (TAU * 1.0e-4).powi(2) / 8.0;
    assert!((spectrum.displacement[0] / moved - 1.0).abs() < chord);
}

fn any_record() -> impl Strategy<Value = Accelerogram> {
    prop::collection::vec(-1.0..1.0_f64, 20..60).prop_map(|s| record(s, 0.02))
}

fn rows(s: &ResponseSpectrum) -> [&Vec<f64>; 3] {
    [&s.displacement, &s.velocity, &s.acceleration]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    /// Peaks between samples are those of the same straight lines sampled 256 times
    /// as finely, less what the finer samples miss: at most `h^2/8` of the second
    /// derivative, bounded through the equation of motion.
    #[test]
    fn peaks_between_samples(ground in any_record(), zeta in 0.0..0.3_f64, period in 0.015..2.0_f64) {
        let exact = response_spectrum(&ground, &[period], zeta, LINEAR).unwrap();
        let fine = finer(&ground, 256);
        let sampled = response_spectrum(&fine, &[period], zeta, Evaluation::AtSamples).unwrap();
        let w = TAU / period;
        let slope = ground.samples().windows(2).fold(0.0_f64, |m, a| m.max((a[1] - a[0]).abs() / 0.02));
        let acceleration = exact.acceleration[0] + ground.peak().value;
        let jerk = slope + 2.0 * zeta * w * acceleration + w * w * exact.velocity[0];
        let second = [acceleration, jerk, w * w * acceleration + 2.0 * zeta * w * jerk];
        for k in 0..3 {
            let (a, b) = (rows(&exact)[k][0], rows(&sampled)[k][0]);
            let miss = fine.time_step().powi(2) / 8.0 * second[k];
            prop_assert!(a >= b * (1.0 - 1e-10), "{} {}", a, b);
            prop_assert!(a <= b * (1.0 + 1e-10) + miss, "{} {} {}", a, b, miss);
        }
    }

    /// Spectra are linear in the record.
    #[test]
    fn spectra_scale(ground in any_record(), factor in 0.01..100.0_f64) {
        let periods = [0.0, 0.05, 0.3, 1.7];
        let one = response_spectra(&ground, &periods, &[0.02, 0.05], LINEAR).unwrap();
        let other = ground.scaled_by(-factor).unwrap();
        let other = response_spectra(&other, &periods, &[0.02, 0.05], LINEAR).unwrap();
        for (a, b) in one.iter().zip(&other) {
            for (a, b) in rows(a).iter().zip(rows(b)) {
                for (a, b) in a.iter().zip(b) {
                    prop_assert!((a * factor - b).abs() <= 1e-11 * b);
                }
            }
        }
    }

    /// The median and maximum over directions are those of rotated records.
    #[test]
    fn directions(first in any_record(), second in any_record(), period in 0.03..1.5_f64) {
        let [first, second] = two_components([first, second]);
        for evaluation in [LINEAR, Evaluation::AtSamples] {
            let periods = [0.0, period];
            let rotated = rotated_spectrum(&first, &second, &periods, 0.05, evaluation).unwrap();
            for k in 0..2 {
                let mut peaks: Vec<f64> = (0..180)
                    .map(|angle| {
                        let pair = rotate(&first, &second, f64::from(angle)).unwrap();
                        response_spectrum(&pair.first, &periods, 0.05, evaluation)
                            .unwrap()
                            .pseudo_acceleration[k]
                    })
                    .collect();
                let direction = rotated.direction_of_maximum[k] as usize;
                prop_assert!((peaks[direction] / rotated.maximum[k] - 1.0).abs() < 1e-10);
                peaks.sort_by(f64::total_cmp);
                prop_assert!((peaks[179] / rotated.maximum[k] - 1.0).abs() < 1e-10);
                prop_assert!(((peaks[89] + peaks[90]) / 2.0 / rotated.median[k] - 1.0).abs() < 1e-10);
            }
        }
    }

    /// Parseval: the squares of all amplitudes are those of the samples.
    #[test]
    fn power_is_kept(ground in any_record(), more in 0..40_usize) {
        let spectrum = fourier_spectrum(&ground, ground.samples().len() + more);
        let last = spectrum.amplitudes.len() - 1;
        let is_even = ((spectrum.length / spectrum.time_step).round() as usize).is_multiple_of(2);
        // All but these lines stand for a negative frequency too.
        let sides = |k: usize| if k == 0 || k == last && is_even { 1.0 } else { 2.0 };
        let lines = spectrum.amplitudes.iter().enumerate();
        let sum: f64 = lines.map(|(k, a)| sides(k) * a * a).sum::<f64>() / spectrum.length;
        let square: f64 = ground.samples().iter().map(|a| a * a * 0.02).sum();
        prop_assert!((sum / square - 1.0).abs() < 1e-12);
    }
}

/// A sine of whole cycles is one line of height `A T/2`.
#[test]
fn fourier_of_a_sine() {
    let ground = of(|t| 3.0 * (TAU * 5.0 * t).sin(), 2000, 0.005);
    let spectrum = fourier_spectrum(&ground, 0);
    for (f, a) in spectrum.frequencies.iter().zip(&spectrum.amplitudes) {
        let exact = if (f - 5.0).abs() < 0.01 { 15.0 } else { 0.0 };
        assert!((a - exact).abs() < 1e-9, "{f}: {a}");
    }
}

/// The window keeps a constant, and is `(sin x/x)^4` about a line.
#[test]
fn smoothing() {
    let impulse = {
        let mut samples = vec![0.0; 4000];
        samples[7] = 1.0;
        record(samples, 0.005)
    };
    let flat = fourier_spectrum(&impulse, 0);
    for a in flat.konno_ohmachi(&[0.3, 1.0, 20.0, 90.0], 40.0).unwrap() {
        assert!((a - 0.005).abs() < 1e-15);
    }
    let line = fourier_spectrum(&of(|t| (TAU * 5.0 * t).sin(), 4000, 0.005), 0);
    let smoothed = line.konno_ohmachi(&[5.0, 5.5], 20.0).unwrap();
    // One line among all weights: their ratio is that of the windows over their sums,
    // and the sums grow as the frequency.
    let x = 20.0 * (5.0_f64 / 5.5).log10();
    let exact = (x.sin() / x).powi(4) / 1.1;
    assert!((smoothed[1] / smoothed[0] / exact - 1.0).abs() < 2e-3);
    assert!(line.konno_ohmachi(&[0.0], 20.0).is_err());
    assert!(line.konno_ohmachi(&[1.0], -1.0).is_err());
}

/// 20 s at 5 ms: lines from 0.05 Hz to 100 Hz, and with as many zeros behind them from 0.025 Hz.
#[test]
fn frequencies_without_a_line_are_refused() {
    let ground = of(|t| (TAU * 5.0 * t).sin(), 4000, 0.005);
    let (spectrum, padded) = (
        fourier_spectrum(&ground, 0),
        fourier_spectrum(&ground, 8000),
    );
    for (spectrum, frequency, wanted) in [
        (&spectrum, 0.05, None),
        (&spectrum, 100.0, None),
        (&padded, 0.025, None),
        (
            &spectrum,
            0.049,
            Some("0.049 Hz is below the first line of the spectrum, 0.05 Hz"),
        ),
        (&padded, 0.024, Some("one over 40 s")),
        (
            &spectrum,
            101.0,
            Some("101 Hz is above half the sampling rate, 100 Hz"),
        ),
    ] {
        let found = spectrum.konno_ohmachi(&[1.0, frequency], 40.0);
        match (found, wanted) {
            (Ok(amplitudes), None) => assert!(amplitudes.iter().all(|a| a.is_finite())),
            (Err(error), Some(wanted)) => {
                assert!(error.to_string().contains(wanted), "{error}");
                assert!(error.help().is_some());
            }
            (found, wanted) => panic!("{frequency} Hz: {found:?}, not {wanted:?}"),
        }
    }
}

#[test]
fn targets_and_periods() {
    let target = TargetSpectrum::new(vec![0.1, 1.0, 4.0], vec![5.0, 5.0, 1.25], 0.05).unwrap();
    assert_eq!(target.at(0.1).unwrap(), 5.0);
    // PSA ~ 1/T is straight in logarithms.
    assert!((target.at(2.0).unwrap() - 2.5).abs() < 1e-12);
    assert!((target.at(4.0).unwrap() - 1.25).abs() < 1e-12);
    assert!(target.at(4.1).is_err());
    assert!(TargetSpectrum::new(vec![1.0, 0.5], vec![1.0, 1.0], 0.05).is_err());
    assert!(TargetSpectrum::new(vec![0.5], vec![1.0], 0.05).is_err());
    assert!(TargetSpectrum::new(vec![0.5, 1.0], vec![1.0, 0.0], 0.05).is_err());
    let periods = logarithmic_periods(0.01, 10.0, 4).unwrap();
    for (found, exact) in periods.iter().zip([0.01, 0.1, 1.0, 10.0]) {
        assert!((found / exact - 1.0).abs() < 1e-14);
    }
    assert!(logarithmic_periods(1.0, 1.0, 4).is_err());
}
