//! Intensity measures against closed forms.
use std::f64::consts::{PI, TAU};

use pounding_ground_motion::measures::{GroundMotion, Husid, IntensityMeasures, MeasureOptions};
use pounding_ground_motion::spectra::{Evaluation, response_spectrum, response_spectrum_while};
use pounding_ground_motion::{AccelerationUnit, Accelerogram, GroundMotionError, ReadOptions};
use proptest::prelude::*;

const G: f64 = 9.80665;
const LINEAR: Evaluation = Evaluation::PiecewiseLinear;

fn record(samples: Vec<f64>, step: f64) -> Accelerogram {
    Accelerogram::new(samples, AccelerationUnit::MetrePerSecondSquared, step).unwrap()
}

fn near(found: f64, exact: f64, tolerance: f64) {
    assert!(
        (found - exact).abs() <= tolerance * exact.abs().max(1e-300),
        "{found} for {exact}"
    );
}

/// A triangle up and one down, integrated by hand: v = t^2/2, then 1/2 + s - s^2,
/// then (1 - s)^2/2.
#[test]
fn two_triangles() {
    let ground = record(vec![0.0, 1.0, -1.0, 0.0], 1.0);
    let options = MeasureOptions {
        duration_threshold: 0.5,
        velocity_threshold: 0.9,
        ..MeasureOptions::default()
    };
    let m = IntensityMeasures::of(&ground, options).unwrap();
    near(m.arias_intensity, PI / (2.0 * G), 1e-14);
    near(m.cumulative_absolute_velocity, 1.5, 1e-14);
    near(m.standardised_cumulative_absolute_velocity, 1.5, 1e-14);
    near(m.peak_velocity.value, 0.75, 1e-14);
    near(m.peak_velocity.time, 1.5, 1e-14);
    near(m.peak_displacement.value, 1.0, 1e-14);
    assert_eq!(m.end_velocity, 0.0);
    near(m.specific_energy_density, 0.55, 1e-14);
    let bracketed = m.bracketed.unwrap();
    assert_eq!((bracketed.start, bracketed.end), (0.5, 2.5));
    near(m.uniform_duration, 1.5, 1e-14);
    near(m.velocity_to_acceleration, 0.75, 1e-14);
    // t^3/3 = 0.05 and the same from the end.
    near(m.significant_5_95.start, 0.15_f64.cbrt(), 1e-12);
    near(m.significant_5_95.end, 3.0 - 0.15_f64.cbrt(), 1e-12);
    near(m.significant_5_75.end, 2.0 + (1.0 - 0.75_f64.cbrt()), 1e-12);
    let samples = IntensityMeasures::of(
        &ground,
        MeasureOptions {
            evaluation: Evaluation::AtSamples,
            ..options
        },
    )
    .unwrap();
    // Trapezoids: int a^2 = 1/2 + 1 + 1/2, int |a| the same, v = 0, 1/2, 1/2, 0.
    near(samples.arias_intensity, 2.0 * PI / (2.0 * G), 1e-14);
    near(samples.cumulative_absolute_velocity, 2.0, 1e-14);
    near(samples.peak_velocity.value, 0.5, 1e-14);
    near(samples.specific_energy_density, 0.5, 1e-14);
    near(samples.uniform_duration, 2.0, 1e-14);
    assert_eq!(samples.significant_5_95.start, 0.2);
}

/// A displacement that turns within a step: a = -1 from v = 1, d = t - t^2/2 up to
/// t = 1, where no sample is.
#[test]
fn displacement_between_samples() {
    let ground = record(vec![-1.0; 4], 0.7);
    let motion = GroundMotion::of(&ground, 1.0, 0.0);
    let peak = motion.peak_displacement(LINEAR);
    near(peak.value, 0.5, 1e-14);
    near(peak.time, 1.0, 1e-11);
    assert!(motion.peak_displacement(Evaluation::AtSamples).value < 0.46);
}

/// Also where peaks are taken at samples: the trapezoid rule twice over would give `h^2/12 (a_n - a_0)` more.
#[test]
fn displacements_at_samples_are_those_of_straight_lines() {
    let (h, samples) = (0.05, vec![1.0, 3.0, -2.0, 0.5, 4.0]);
    let motion = GroundMotion::of(&record(samples.clone(), h), 0.0, 0.0);
    let (mut velocity, mut displacement) = (0.0, 0.0);
    for (n, a) in samples.windows(2).enumerate() {
        let before = velocity;
        velocity += 0.5 * h * (a[0] + a[1]);
        displacement += 0.5 * h * (before + velocity);
        let more = h * h / 12.0 * (a[1] - samples[0]);
        near(motion.velocity[n + 1], velocity, 1e-12);
        near(motion.displacement[n + 1], displacement - more, 1e-12);
    }
    let largest = motion
        .displacement
        .iter()
        .fold(0.0_f64, |m, d| m.max(d.abs()));
    let peak = motion.peak_displacement(Evaluation::AtSamples);
    assert_eq!(peak.value, largest);
}

/// Ten whole cycles of a sine: Ia = pi A^2 D/(4 g), CAV = 2 A D/pi,
/// int v^2 = 3/2 (A/w)^2 D, mean period the sine's own.
#[test]
fn a_sine() {
    let (amplitude, period, cycles) = (2.0, 0.4, 10);
    let count = 20_000 * cycles + 1;
    let step = period / 20_000.0;
    let w = TAU / period;
    let fine = record(
        (0..count)
            .map(|i| amplitude * (w * i as f64 * step).sin())
            .collect(),
        step,
    );
    let duration = period * cycles as f64;
    let husid = Husid::of(&fine, LINEAR).unwrap();
    near(
        husid.arias_intensity(),
        PI * amplitude * amplitude * duration / (4.0 * G),
        1e-7,
    );
    // The Husid curve crosses its chord at each quarter cycle, at the first steeply.
    near(husid.time_of(0.025).unwrap(), period / 4.0, 1e-7);
    let motion = GroundMotion::of(&fine, 0.0, 0.0);
    near(
        motion.peak_velocity(LINEAR).value,
        2.0 * amplitude / w,
        1e-7,
    );
    near(motion.end_displacement(), amplitude / w * duration, 1e-7);
    let coarse = record(
        (0..=4000)
            .map(|i| amplitude * (w * f64::from(i) * 0.001).sin())
            .collect(),
        0.001,
    );
    let m = IntensityMeasures::of(&coarse, MeasureOptions::default()).unwrap();
    near(
        m.cumulative_absolute_velocity,
        2.0 * amplitude * duration / PI,
        1e-4,
    );
    near(
        m.specific_energy_density,
        1.5 * (amplitude / w).powi(2) * duration,
        1e-4,
    );
    // |F| = 2 A w |sin(pi f D)|/|w^2 - (2 pi f)^2| at frequencies 0.05 Hz apart.
    let (mut above, mut below) = (0.0, 0.0);
    for k in 5..=400 {
        let f = 0.05 * f64::from(k);
        let a = if k == 50 {
            amplitude * duration / 2.0
        } else {
            2.0 * amplitude * w * (PI * f * duration).sin() / (w * w - (TAU * f).powi(2))
        };
        above += a * a / f;
        below += a * a;
    }
    near(m.mean_period.unwrap(), above / below, 1e-4);
    near(
        m.root_mean_square_acceleration,
        amplitude / 2.0_f64.sqrt(),
        0.02,
    );
    near(
        m.characteristic_intensity,
        m.root_mean_square_acceleration.powf(1.5) * m.significant_5_95.duration().sqrt(),
        1e-14,
    );
    // Ten cycles bring the oscillator at resonance furthest.
    near(m.predominant_period, period, 0.05);
}

/// Seconds below the threshold do not count: five seconds at 0.02 g, then two at 0.03 g.
#[test]
fn standardised_cumulative_absolute_velocity() {
    let step = 0.01;
    let value = |t: f64| if t < 5.0 - 1e-9 { 0.02 * G } else { 0.03 * G };
    for evaluation in [LINEAR, Evaluation::AtSamples] {
        let ground = record(
            (0..=700).map(|i| value(f64::from(i) * step)).collect(),
            step,
        );
        let options = MeasureOptions {
            evaluation,
            ..MeasureOptions::default()
        };
        let m = IntensityMeasures::of(&ground, options).unwrap();
        // The fifth second ends on the first sample of 0.03 g and so counts:
        // 0.99 s of 0.02 g and a ramp of 0.01 s.
        let exact = (0.99 * 0.02 + 0.01 * 0.025 + 2.0 * 0.03) * G;
        near(m.standardised_cumulative_absolute_velocity, exact, 1e-9);
        assert!(m.bracketed.is_none() && m.uniform_duration == 0.0);
    }
}

/// Housner's integral of the pseudo-velocity of a step of the ground, undamped:
/// PSV = 2 a T/(2 pi), integral a (2.5^2 - 0.1^2)/(2 pi); that of PSA is 2 a 0.4 s.
#[test]
fn spectrum_intensities() {
    let ground = record(vec![1.5; 1000], 0.005);
    let options = MeasureOptions {
        damping: 0.0,
        ..MeasureOptions::default()
    };
    let m = IntensityMeasures::of(&ground, options).unwrap();
    near(m.housner_intensity, 1.5 * (6.25 - 0.01) / TAU, 1e-10);
    near(m.acceleration_spectrum_intensity, 2.0 * 1.5 * 0.4, 1e-10);
}

/// The same integrals over a step of 0.1 ms, which are 2e-8 off theirs over 0.05 ms.
#[test]
fn spectrum_intensities_of_a_record() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    let file = folder.join("../../ground_motions/el_centro_1940_ns.csv");
    let ground = pounding_ground_motion::read(&file, &ReadOptions::default()).unwrap();
    let options = MeasureOptions::default();
    let periods: Vec<f64> = (0..=24_000).map(|i| 0.1 + 1e-4 * i as f64).collect();
    let spectrum =
        response_spectrum(&ground, &periods, options.damping, options.evaluation).unwrap();
    let integral = |values: &[f64]| 0.5e-4 * values.windows(2).map(|v| v[0] + v[1]).sum::<f64>();
    let m = IntensityMeasures::of(&ground, options).unwrap();
    let acceleration = integral(&spectrum.pseudo_acceleration[..=4000]);
    near(m.acceleration_spectrum_intensity, acceleration, 3e-5);
    near(
        m.housner_intensity,
        integral(&spectrum.pseudo_velocity),
        1e-5,
    );
}

#[test]
fn refusals_and_serialisation() {
    let zeros = record(vec![0.0; 100], 0.01);
    let error = IntensityMeasures::of(&zeros, MeasureOptions::default()).unwrap_err();
    assert!(error.help().is_some());
    let ground = record(vec![0.0, 1.0, -1.0, 0.0], 0.1);
    let bad = MeasureOptions {
        duration_threshold: 0.0,
        ..MeasureOptions::default()
    };
    assert!(IntensityMeasures::of(&ground, bad).is_err());
    let husid = Husid::of(&ground, LINEAR).unwrap();
    assert!(husid.time_of(1.1).is_err() && husid.between(0.9, 0.1).is_err());
    let m = IntensityMeasures::of(&ground, MeasureOptions::default()).unwrap();
    let json = serde_json::to_value(&m).unwrap();
    assert_eq!(json["peak_acceleration"]["value"], 1.0);
    assert_eq!(json["options"]["evaluation"], "piecewise_linear");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Measures go with the powers of the scale that their units have.
    #[test]
    fn measures_scale(samples in prop::collection::vec(-1.0..1.0_f64, 30..80), factor in 0.1..10.0_f64) {
        let ground = record(samples, 0.02);
        let scaled = ground.scaled_by(factor).unwrap();
        let options = |f: f64| MeasureOptions {
            duration_threshold: 0.5 * f,
            velocity_threshold: 0.25 * f,
            ..MeasureOptions::default()
        };
        let a = IntensityMeasures::of(&ground, options(1.0)).unwrap();
        let b = IntensityMeasures::of(&scaled, options(factor)).unwrap();
        let pairs = [
            (a.peak_velocity.value * factor, b.peak_velocity.value),
            (a.peak_displacement.value * factor, b.peak_displacement.value),
            (a.arias_intensity * factor * factor, b.arias_intensity),
            (a.significant_5_95.duration(), b.significant_5_95.duration()),
            (a.uniform_duration, b.uniform_duration),
            (a.cumulative_absolute_velocity * factor, b.cumulative_absolute_velocity),
            (a.standardised_cumulative_absolute_velocity * factor, b.standardised_cumulative_absolute_velocity),
            (a.specific_energy_density * factor * factor, b.specific_energy_density),
            (a.housner_intensity * factor, b.housner_intensity),
            (a.mean_period.unwrap(), b.mean_period.unwrap()),
        ];
        for (i, (x, y)) in pairs.iter().enumerate() {
            prop_assert!((x - y).abs() <= 1e-9 * x.abs() + 1e-14, "{}: {} {}", i, x, y);
        }
    }
}

/// A record that is not zero is not called so.
#[test]
fn records_whose_squares_vanish() {
    let error = Husid::of(&record(vec![0.0, 1.0e-300, 0.0], 0.01), LINEAR).unwrap_err();
    assert!(
        error.to_string().contains("1e-300 m/s2 is too small"),
        "{error}"
    );
}

#[test]
fn records_whose_squares_are_beyond_all_numbers() {
    for samples in [[1e308, -1e308, 1e308], [1e200, 1e200, 0.0]] {
        let error = Husid::of(&record(samples.to_vec(), 0.01), Evaluation::default()).unwrap_err();
        assert!(
            error.to_string().contains("too large to be squared"),
            "{error}"
        );
    }
}

#[test]
fn work_that_is_not_to_go_on_ends() {
    let sine: Vec<f64> = (0..500).map(|i| libm::sin(0.3 * f64::from(i))).collect();
    let record = record(sine, 0.01);
    let how = (0.05, Evaluation::default());
    let periods: Vec<f64> = (1..40).map(|i| 0.05 * f64::from(i)).collect();
    let whole = response_spectrum_while(&record, &periods, how, &|| true).unwrap();
    assert_eq!(
        whole,
        response_spectrum(&record, &periods, how.0, how.1).unwrap()
    );
    let asked = std::cell::Cell::new(0);
    let fewer_than = |last: i32| {
        asked.set(asked.get() + 1);
        asked.get() < last
    };
    let stopped = response_spectrum_while(&record, &periods, how, &|| fewer_than(5));
    assert!(matches!(stopped, Err(GroundMotionError::Stopped)));
    assert_eq!(asked.replace(0), 5);
    let options = MeasureOptions::default();
    let stopped = IntensityMeasures::of_while(&record, options, &|| fewer_than(1000));
    assert!(matches!(stopped, Err(GroundMotionError::Stopped)));
    assert_eq!(asked.get(), 1000);
}
