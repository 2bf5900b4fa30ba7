//! Other time steps, scales, rotation, and the records of what was done.
use std::f64::consts::{PI, TAU};

use pounding_ground_motion::measures::{GroundMotion, Husid};
use pounding_ground_motion::processing::{
    BandTarget, Interpolation, OffsetCorrection, ProcessingStep, Scale, band_factor,
    fault_components, process, rotate, to_even_steps,
};
use pounding_ground_motion::spectra::{
    Evaluation, TargetSpectrum, logarithmic_periods, response_spectrum,
};
use pounding_ground_motion::{
    AccelerationUnit, Accelerogram, GroundMotionError, Quantity, Sampling, Series,
};
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

fn one(record: &Accelerogram, step: ProcessingStep) -> Accelerogram {
    process(record, &[step]).unwrap().accelerogram
}

fn refused(record: &Accelerogram, step: ProcessingStep) {
    let error = process(record, std::slice::from_ref(&step)).unwrap_err();
    assert!(error.help().is_some(), "{step:?}");
    assert!(
        matches!(
            error,
            GroundMotionError::OutOfRange { .. } | GroundMotionError::NotPossible { .. }
        ),
        "{error}"
    );
}

fn resample(time_step: f64, interpolation: Interpolation) -> ProcessingStep {
    ProcessingStep::Resample {
        time_step,
        interpolation,
    }
}

/// Below the Nyquist frequency a signal comes back between samples; what a longer step
/// cannot hold goes.
#[test]
fn band_limited_steps() {
    let shape = |t: f64| (-((t - 10.0) / 2.0).powi(2)).exp();
    let low = move |t: f64| shape(t) * (TAU * 3.0 * t).sin();
    let both = move |t: f64| low(t) + shape(t) * (TAU * 35.0 * t).sin();
    for (from, to) in [
        (0.02, 0.005),
        (0.02, 0.007),
        (0.01, 0.02),
        (0.005, 0.02),
        (0.01, 0.015),
    ] {
        let ground = of(low, (20.0 / from) as usize + 1, from);
        let new = one(&ground, resample(to, Interpolation::BandLimited));
        assert_eq!(new.samples().len(), (20.0 / to + 1e-9) as usize + 1);
        for (i, a) in new.samples().iter().enumerate() {
            assert!((a - low(i as f64 * to)).abs() < 1e-9, "{from} {to} {i}");
        }
    }
    // 35 Hz is above half of 50 Hz and would fold to 15 Hz.
    let ground = of(both, 4001, 0.005);
    let new = one(&ground, resample(0.02, Interpolation::BandLimited));
    for (i, a) in new.samples().iter().enumerate() {
        assert!((a - low(i as f64 * 0.02)).abs() < 1e-9);
    }
    refused(&ground, resample(0.02, Interpolation::Linear));
    refused(&ground, resample(0.0, Interpolation::Linear));
    refused(&ground, resample(1e-9, Interpolation::Linear));
    refused(&ground, resample(0.01 * PI, Interpolation::BandLimited));
}

fn uneven(times: Vec<f64>, function: impl Fn(f64) -> f64) -> Series {
    Series {
        quantity: Quantity::Acceleration,
        component: String::new(),
        channel: 1,
        unit: "m/s2",
        unit_in_si: 1.0,
        samples: times.iter().map(|t| function(*t)).collect(),
        sampling: Sampling::Uneven { times },
        header_peak: None,
        initial: None,
        origin: pounding_ground_motion::Origin::default(),
    }
}

#[test]
fn uneven_times() {
    // Steps of 4, 5 and 6 ms in turn.
    let mut times = vec![3.0];
    for i in 0..3000 {
        times.push(times[i] + 0.004 + 0.001 * (i % 3) as f64);
    }
    let straight = uneven(times.clone(), |t| 2.0 * t - 1.0);
    let (even, told) = to_even_steps(&straight, None, Interpolation::Linear).unwrap();
    assert!((told.get("median step").unwrap() - 0.005).abs() < 1e-12);
    assert!((told.get("largest gap").unwrap() - 0.006).abs() < 1e-12);
    for (i, a) in even.samples().iter().enumerate() {
        assert!((a - (5.0 + 2.0 * i as f64 * even.time_step())).abs() < 1e-10);
    }
    assert_eq!(even.samples().len(), 3001);
    // A slow wave keeps its shape at a longer step, up to (w h)^2/8 of straight lines.
    let wave = |t: f64| (-((t - 10.0) / 1.5).powi(2)).exp() * (TAU * 2.0 * t).sin();
    let series = uneven(times, wave);
    let (even, told) = to_even_steps(&series, Some(0.02), Interpolation::BandLimited).unwrap();
    assert_eq!(told.get("step between"), Some(0.005));
    let bound = (TAU * 2.0 * 0.006_f64).powi(2) / 8.0;
    for (i, a) in even.samples().iter().enumerate() {
        assert!((a - wave(3.0 + i as f64 * 0.02)).abs() < bound);
    }
    assert!(to_even_steps(&series, Some(0.02), Interpolation::Linear).is_err());
    assert!(to_even_steps(&series, Some(-1.0), Interpolation::Linear).is_err());
}

#[test]
fn scales() {
    let ground = of(
        |t| (-0.3 * t).exp() * ((7.0 * t).sin() + 0.4 * (31.0 * t).cos()),
        1500,
        0.01,
    );
    let periods = logarithmic_periods(0.1, 3.0, 100).unwrap();
    let own = response_spectrum(&ground, &periods, 0.05, LINEAR).unwrap();
    let target = TargetSpectrum::new(
        periods.clone(),
        own.pseudo_acceleration.iter().map(|a| 2.5 * a).collect(),
        0.05,
    )
    .unwrap();
    let scaled = |scale| one(&ground, ProcessingStep::Scale(scale));
    assert!((scaled(Scale::PeakAcceleration(3.0)).peak().value - 3.0).abs() < 1e-14);
    let velocity =
        GroundMotion::of(&scaled(Scale::PeakVelocity(0.4)), 0.0, 0.0).peak_velocity(LINEAR);
    assert!((velocity.value - 0.4).abs() < 1e-14);
    let spectral = scaled(Scale::SpectralAcceleration {
        period: 0.7,
        damping: 0.02,
        target: 4.0,
    });
    let reached = response_spectrum(&spectral, &[0.7], 0.02, LINEAR).unwrap();
    assert!((reached.pseudo_acceleration[0] - 4.0).abs() < 1e-12);
    let over = |from| {
        Scale::Band(BandTarget {
            spectrum: target.clone(),
            from,
            to: 3.0,
            times: 1.0,
            reason: String::new(),
        })
    };
    let band = scaled(over(0.1));
    assert!((band.scale() - 2.5).abs() < 1e-12);
    let Scale::Band(raised) = over(0.1) else {
        unreachable!()
    };
    let raised = BandTarget {
        times: 1.2,
        ..raised
    };
    assert!((scaled(Scale::Band(raised)).scale() - 3.0).abs() < 1e-12);
    // Two records, one three times the other: the mean of the logarithms is in the middle.
    let set = [ground.clone(), ground.scaled_by(3.0).unwrap()];
    let factor = band_factor(&set, &target, 0.1, 3.0).unwrap();
    assert!((factor - 2.5 / 3.0_f64.sqrt()).abs() < 1e-12);
    assert!(band_factor(&[], &target, 0.1, 3.0).is_err());
    refused(&ground, ProcessingStep::Scale(over(0.05)));
    refused(
        &ground,
        ProcessingStep::Scale(Scale::PeakAcceleration(-1.0)),
    );
}

/// What was done can be read, sorted and written as JSON.
#[test]
fn records_of_steps() {
    let ground = of(|t| (5.0 * t).sin(), 1000, 0.01);
    let steps = [
        ProcessingStep::Sign,
        ProcessingStep::Offset(OffsetCorrection::Mean),
        ProcessingStep::Pad {
            before: 0.0,
            after: 1.0,
        },
        ProcessingStep::Scale(Scale::PeakAcceleration(2.0)),
    ];
    let done = process(&ground, &steps).unwrap();
    let names: Vec<&str> = done.steps.iter().map(|s| &*s.step).collect();
    assert_eq!(names, ["sign", "offset", "pad", "scale"]);
    let json = serde_json::to_value(&done.steps).unwrap();
    assert_eq!(json[2]["numbers"][1]["name"], "after");
    assert_eq!(json[2]["numbers"][1]["value"], 1.0);
    assert!(
        done.steps[2]
            .to_string()
            .starts_with("pad: before 0 s, after 1 s")
    );
    assert!(process(&ground, &[]).unwrap().accelerogram == ground);
}

fn any_record() -> impl Strategy<Value = Accelerogram> {
    prop::collection::vec(-1.0..1.0_f64, 20..60).prop_map(|s| record(s, 0.02))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Rotation keeps the energy of both components, and turning back returns them.
    #[test]
    fn rotation_keeps_energy(first in any_record(), second in any_record(), angle in -360.0..360.0_f64) {
        let [first, second] = two_components([first, second]);
        let energy = |a: &[f64], b: &[f64]| a.iter().chain(b).map(|a| a * a).sum::<f64>();
        let pair = rotate(&first, &second, angle).unwrap();
        let before = energy(first.samples(), second.samples());
        let after = energy(pair.first.samples(), pair.second.samples());
        prop_assert!((after / before - 1.0).abs() < 1e-13);
        let back = rotate(&pair.first, &pair.second, -angle).unwrap();
        for (back, once) in [(&back.first, &first), (&back.second, &second)] {
            // Zeros behind the end of the shorter one.
            let once = once.samples().iter().chain(std::iter::repeat(&0.0));
            for (a, b) in back.samples().iter().zip(once) {
                prop_assert!((a - b).abs() < 1e-14);
            }
        }
    }

    /// A motion along north and east, seen by skew instruments, turned to a fault.
    #[test]
    fn components_of_a_fault(north in any_record(), east in any_record(), azimuth in 0.0..360.0_f64, between in 35.0..145.0_f64, strike in 0.0..360.0_f64) {
        let [north, east] = two_components([north, east]);
        let along = |bearing: f64| rotate(&north, &east, bearing).unwrap().first;
        let (a, b) = (along(azimuth), along((azimuth + between) % 360.0));
        let pair = fault_components((&a, azimuth), (&b, (azimuth + between) % 360.0), strike).unwrap();
        let exact = rotate(&north, &east, strike).unwrap();
        for i in 0..pair.first.samples().len() {
            prop_assert!((pair.first.samples()[i] - exact.first.samples()[i]).abs() < 1e-12);
            prop_assert!((pair.second.samples()[i] - exact.second.samples()[i]).abs() < 1e-12);
        }
        prop_assert!(fault_components((&a, 10.0), (&b, 20.0), strike).is_err());
    }

    /// Linear resampling to a part of the step changes nothing that straight lines see.
    #[test]
    fn finer_lines_are_the_same(ground in any_record(), parts in 2..6_u32) {
        let fine = one(&ground, resample(0.02 / f64::from(parts), Interpolation::Linear));
        let arias = |r: &Accelerogram| Husid::of(r, LINEAR).unwrap().arias_intensity();
        prop_assert!((arias(&fine) / arias(&ground) - 1.0).abs() < 1e-12);
        let spectrum = |r: &Accelerogram| response_spectrum(r, &[0.05, 0.4], 0.05, LINEAR).unwrap();
        let (a, b) = (spectrum(&ground), spectrum(&fine));
        for k in 0..2 {
            prop_assert!((a.displacement[k] / b.displacement[k] - 1.0).abs() < 1e-10);
            prop_assert!((a.acceleration[k] / b.acceleration[k] - 1.0).abs() < 1e-10);
        }
    }
}
