//! Time steps that no accelerograph has: said, used, and no reason to compute for minutes.
use std::time::{Duration, Instant};

use pounding_ground_motion::measures::{IntensityMeasures, MeasureOptions};
use pounding_ground_motion::spectra::{Evaluation, logarithmic_periods, response_spectrum};
use pounding_ground_motion::{AccelerationUnit, Accelerogram, ReadOptions, read_bytes};

/// A motion of a step (s), the same for the same count.
fn motion(count: usize, step: f64) -> Accelerogram {
    let mut state = 1_u64;
    let samples = (0..count).map(|i| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        let noise = (state >> 33) as f64 / 2.0_f64.powi(31) - 0.5;
        3.0 * noise * (-((i as f64 / count as f64 - 0.4) * 4.0).powi(2)).exp()
    });
    let unit = AccelerationUnit::MetrePerSecondSquared;
    Accelerogram::new(samples.collect(), unit, step).unwrap()
}

/// The same motion with more samples on its straight lines.
fn refined(of: &Accelerogram, parts: usize) -> Accelerogram {
    let mut samples = vec![of.samples()[0]];
    for pair in of.samples().windows(2) {
        samples.extend((1..=parts).map(|i| {
            let part = i as f64 / parts as f64;
            pair[0] + part * (pair[1] - pair[0])
        }));
    }
    let unit = AccelerationUnit::MetrePerSecondSquared;
    Accelerogram::new(samples, unit, of.time_step() / parts as f64).unwrap()
}

/// Peaks between samples, where there are dozens of half cycles to a step, against a step that is
/// 400 times as short: what is passed over has no peak.
#[test]
fn peaks_of_many_half_cycles_are_those_of_short_steps() {
    let long = motion(60, 5.0);
    let short = refined(&long, 400);
    let periods = [0.2, 0.37, 1.0, 2.9, 7.0, 20.0];
    for damping in [0.0, 0.01, 0.05, 0.3, 0.95] {
        let linear = Evaluation::PiecewiseLinear;
        let found = response_spectrum(&long, &periods, damping, linear).unwrap();
        let exact = response_spectrum(&short, &periods, damping, linear).unwrap();
        for (i, period) in periods.iter().enumerate() {
            for (name, a, b) in [
                ("displacement", &found.displacement, &exact.displacement),
                ("velocity", &found.velocity, &exact.velocity),
                ("acceleration", &found.acceleration, &exact.acceleration),
            ] {
                let off = (a[i] / b[i] - 1.0).abs();
                assert!(off < 1e-9, "{name} at {period} s, {damping}: {off:e}");
            }
        }
    }
}

/// A step of 5 s in the place of 0.005 s took minutes.
#[test]
fn spectra_and_measures_of_long_steps_take_no_longer() {
    let record = motion(4000, 5.0);
    let began = Instant::now();
    let periods = logarithmic_periods(0.02, 5.0, 200).unwrap();
    response_spectrum(&record, &periods, 0.05, Evaluation::PiecewiseLinear).unwrap();
    IntensityMeasures::of(&record, MeasureOptions::default()).unwrap();
    // A second or less on an idle machine; four minutes before.
    let took = began.elapsed();
    assert!(took < Duration::from_secs(40), "{took:?}");
}

fn at2(step: &str) -> String {
    let values = "0.1 -0.2 0.3 -0.1 0.2\n".repeat(20);
    format!("A\nB\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS= 100, DT= {step}\n{values}")
}

fn read(step: &str) -> Accelerogram {
    read_bytes("a.at2", at2(step).as_bytes(), &ReadOptions::default()).unwrap()
}

#[test]
fn steps_of_no_accelerograph_are_named_with_their_line() {
    for (step, said) in [
        ("5 SEC", Some("line 4: the time step is 5 s")),
        ("0.11", Some("line 4: the time step is 0.11 s")),
        ("0.00001 SEC", Some("line 4: the time step is 1e-5 s")),
        ("0.1 SEC", None),
        ("0.0001 SEC", None),
        ("0.005 SEC", None),
    ] {
        let record = read(step);
        let found = record.origin().unwrap().warnings.iter();
        let found: Vec<_> = found.filter(|w| w.contains("the time step is")).collect();
        match said {
            Some(words) => assert!(found.len() == 1 && found[0].contains(words), "{found:?}"),
            None => assert!(found.is_empty(), "{step}: {found:?}"),
        }
        assert_eq!(record.unusual_time_step().is_some(), said.is_some());
    }
    let warnings = read("5 SEC").origin().unwrap().warnings.clone();
    assert!(
        warnings
            .iter()
            .any(|w| w.contains("100 samples take 495 s")),
        "{warnings:?}"
    );
}

/// A rate is none of the steps, and milliseconds are no seconds.
#[test]
fn the_step_of_an_at2_header_has_a_unit() {
    for (written, step) in [
        ("100 HZ", 0.01),
        ("100HZ", 0.01),
        ("200. hz", 0.005),
        ("100 SPS", 0.01),
        ("5 MSEC", 0.005),
        (".0050 SEC,", 0.005),
        (
            ".0050 SEC,   0 POLE @    40.00000 HZ,  -5 POLE @      .05000 HZ",
            0.005,
        ),
        (".0050", 0.005),
        ("5.0E-03SEC", 0.005),
        ("1.0D-02 SEC", 0.01),
    ] {
        let found = read(written).time_step();
        assert!((found / step - 1.0).abs() < 1e-12, "{written}: {found}");
    }
}

/// Steps of minutes have measures too: oscillators of periods too short for the recurrence move
/// with the ground.
#[test]
fn measures_of_steps_above_100_s() {
    for step in [100.0, 101.0, 1000.0] {
        let record = motion(50, step);
        let measures = IntensityMeasures::of(&record, MeasureOptions::default()).unwrap();
        let rigid = 0.4 * record.peak().value;
        let found = measures.acceleration_spectrum_intensity;
        assert!(
            (found / rigid - 1.0).abs() < 0.01,
            "{step}: {found} {rigid}"
        );
    }
}
