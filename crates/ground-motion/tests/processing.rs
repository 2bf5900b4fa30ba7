//! Filters, baselines and windows against closed forms.
use std::f64::consts::{PI, TAU};

use pounding_ground_motion::measures::{GroundMotion, Husid};
use pounding_ground_motion::processing::{
    Baseline, Butterworth, Interpolation, OffsetCorrection, Phase, ProcessingStep, Scale,
    SegmentWindow, Trim, process,
};
use pounding_ground_motion::spectra::{Evaluation, fourier_spectrum};
use pounding_ground_motion::{AccelerationUnit, Accelerogram, GroundMotionError};

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

/// Amplitudes of an impulse are the filter's gain; by the bilinear transform with the
/// corner put right it is Butterworth's with tan(pi f h) for f, exactly: at the corner
/// the square root of one half in one pass, one half in two.
#[test]
fn butterworth_gain() {
    let step = 0.01;
    let mut samples = vec![0.0; 60_000];
    samples[30_000] = 1.0;
    let impulse = record(samples, step);
    for order in 1..=9 {
        for (high_pass, low_pass) in [
            (Some(0.5), None),
            (None, Some(12.5)),
            (Some(0.5), Some(12.5)),
        ] {
            for (phase, passes) in [
                (Phase::Causal, 1.0),
                (Phase::Zero { keep_pads: false }, 2.0),
            ] {
                let filter = Butterworth {
                    order,
                    high_pass,
                    low_pass,
                    phase,
                };
                let filtered = one(&impulse, ProcessingStep::Filter(filter));
                let spectrum = fourier_spectrum(&filtered, 0);
                let warped = |f: f64| (PI * f * step).tan();
                for (f, a) in spectrum
                    .frequencies
                    .iter()
                    .zip(&spectrum.amplitudes)
                    .step_by(50)
                {
                    let side = |corner: Option<f64>, sign: f64| {
                        corner.map_or(1.0, |corner| {
                            let r = (warped(*f) / warped(corner)).powf(sign * 2.0 * order as f64);
                            1.0 / (1.0 + r)
                        })
                    };
                    let exact = (side(high_pass, -1.0) * side(low_pass, 1.0)).powf(passes / 2.0);
                    let gain = a / step;
                    assert!(
                        (gain - exact).abs() < 2e-6,
                        "{filter:?} at {f}: {gain} for {exact}"
                    );
                }
                let corner = spectrum
                    .frequencies
                    .iter()
                    .position(|f| (f - 0.5).abs() < 1e-9)
                    .unwrap();
                if high_pass.is_some() && low_pass.is_none() {
                    let gain = spectrum.amplitudes[corner] / step;
                    assert!((gain - 0.5_f64.powf(passes / 2.0)).abs() < 2e-6);
                }
            }
        }
    }
}

/// Without delay: an impulse becomes symmetric. Pads stay, and the ground comes to rest.
#[test]
fn zero_phase_and_pads() {
    let mut samples = vec![0.0; 4001];
    samples[2000] = 1.0;
    samples[2100] = 0.6;
    let filter = |keep_pads| {
        ProcessingStep::Filter(Butterworth {
            phase: Phase::Zero { keep_pads },
            ..Butterworth::zero_phase(Some(0.1), Some(20.0))
        })
    };
    let mut single = samples.clone();
    single[2100] = 0.0;
    let symmetric = one(&record(single, 0.01), filter(false));
    let a = symmetric.samples();
    // The backward pass starts in the pads: what the forward pass still has there.
    for i in 0..2000 {
        assert!((a[i] - a[4000 - i]).abs() < 1e-5 * a[2000], "{i}");
    }
    let kept = process(&record(samples.clone(), 0.01), &[filter(true)]).unwrap();
    let told = &kept.steps[0];
    assert_eq!(told.get("pad at each end"), Some(30.0));
    assert_eq!(kept.accelerogram.samples().len(), 4001 + 6000);
    assert!(told.get("end velocity").unwrap().abs() < 1e-6);
    let before = GroundMotion::of(&record(samples, 0.01), 0.0, 0.0);
    assert!(before.end_velocity().abs() > 0.01);
    // Half the amplitude at each end of 0.8/f.
    assert_eq!(told.get("longest usable period"), Some(8.0));
}

#[test]
fn filters_that_cannot_be() {
    let ground = of(|t| t.sin(), 1000, 0.01);
    for filter in [
        Butterworth::zero_phase(None, None),
        Butterworth::zero_phase(Some(2.0), Some(1.0)),
        Butterworth::zero_phase(Some(50.0), None),
        Butterworth::zero_phase(Some(-1.0), None),
        Butterworth::zero_phase(Some(1e-9), None),
        Butterworth {
            order: 0,
            ..Butterworth::zero_phase(Some(1.0), None)
        },
        Butterworth {
            order: 13,
            ..Butterworth::zero_phase(Some(1.0), None)
        },
    ] {
        refused(&ground, ProcessingStep::Filter(filter));
    }
}

/// What filters and resampling take off by mistakes of a power of ten is said; what is customary
/// is not.
#[test]
fn steps_that_leave_little_are_said() {
    let ground = of(|t| 3.0 + t.min(20.0 - t) * (TAU * t).sin(), 2001, 0.01).of_memory("ground");
    let warnings = |step: ProcessingStep| {
        let processed = one(&ground, step);
        processed.origin().unwrap().warnings.clone()
    };
    let filter = |high, low| ProcessingStep::Filter(Butterworth::zero_phase(Some(high), Some(low)));
    let resample = |time_step| ProcessingStep::Resample {
        time_step,
        interpolation: Interpolation::BandLimited,
    };
    for customary in [filter(0.1, 25.0), filter(0.02, 25.0), resample(0.02)] {
        assert!(warnings(customary.clone()).is_empty(), "{customary:?}");
    }
    for (mistaken, words) in [
        (filter(1.0e-4, 25.0), "period of 10000.0000 s"),
        (filter(0.01, 0.1), "% of that; check the corners"),
        (resample(5.0), "the time step is 5 s"),
        (resample(5.0), "% of that; check the time step"),
    ] {
        let said = warnings(mistaken);
        assert!(said.iter().any(|w| w.contains(words)), "{said:?}");
    }
}

/// A polynomial is taken off without rest.
#[test]
fn polynomial_baselines() {
    for degree in 0..=5 {
        let ground = of(
            |t| {
                (0..=degree)
                    .map(|k| (f64::from(k) - 1.7) * (t - 3.0).powi(k))
                    .sum()
            },
            1000,
            0.01,
        );
        let largest = ground.peak().value;
        let step = ProcessingStep::Baseline(Baseline::Acceleration {
            degree: degree as usize,
        });
        let rest = one(&ground, step).peak().value;
        assert!(rest < 1e-10 * largest, "{degree}: {rest}");
    }
    // An acceleration that is linear between samples and straight throughout: its
    // velocity is a parabola.
    let ground = of(|t| 0.3 - 0.2 * t, 1000, 0.01);
    for degree in 2..=5 {
        let rest = one(
            &ground,
            ProcessingStep::Baseline(Baseline::Velocity { degree }),
        );
        assert!(rest.peak().value < 1e-9, "{degree}: {}", rest.peak().value);
    }
    refused(
        &ground,
        ProcessingStep::Baseline(Baseline::Acceleration { degree: 6 }),
    );
    refused(
        &ground,
        ProcessingStep::Baseline(Baseline::Velocity { degree: 0 }),
    );
    refused(
        &record(vec![1.0, 2.0, 3.0], 0.1),
        ProcessingStep::Baseline(Baseline::Acceleration { degree: 3 }),
    );
}

/// A motion that returns to rest at 20 s, with one offset from 8 to 14 s and another
/// after it: both are found and the motion comes back.
#[test]
fn two_segments() {
    let step = 0.01;
    let clean = |t: f64| {
        if t < 20.0 {
            (TAU * t / 2.0).sin() - 0.5 * (TAU * t).sin()
        } else {
            0.0
        }
    };
    let (middle, last) = (0.013, -0.004);
    let offset = |t: f64| {
        let on = |from: f64| {
            if (t - from).abs() < 1e-6 {
                0.5
            } else {
                f64::from(u8::from(t > from))
            }
        };
        middle * on(8.0) + (last - middle) * on(14.0)
    };
    // Its own displacement at rest is not zero: the first cycles of sine move it.
    let ground = of(|t| clean(t) + offset(t), 6001, step);
    let correction = |window| {
        ProcessingStep::Baseline(Baseline::TwoSegments {
            window,
            fit_from: Some(20.0),
        })
    };
    let done = process(
        &ground,
        &[correction(SegmentWindow::Times {
            start: 8.0,
            end: 14.0,
        })],
    )
    .unwrap();
    let told = &done.steps[0];
    assert!((told.get("am").unwrap() - middle).abs() < 1e-12);
    assert!((told.get("af").unwrap() - last).abs() < 1e-12);
    let exact = of(clean, 6001, step);
    for (a, b) in done.accelerogram.samples().iter().zip(exact.samples()) {
        assert!((a - b).abs() < 1e-11);
    }
    assert!(told.get("end velocity").unwrap().abs() < 1e-10);
    // Iwan's window is where the motion is strong.
    let done = process(&ground, &[correction(SegmentWindow::Threshold(0.5))]).unwrap();
    assert!(done.steps[0].get("t1").unwrap() < 1.0 && done.steps[0].get("t2").unwrap() > 19.0);
    assert!(done.steps[0].get("end velocity").unwrap().abs() < 1e-10);
    refused(&ground, correction(SegmentWindow::Threshold(50.0)));
    refused(
        &ground,
        correction(SegmentWindow::Times {
            start: 5.0,
            end: 5.0,
        }),
    );
}

#[test]
fn offsets_units_and_signs() {
    let ground = of(|t| 1.0 + if t < 2.0 - 1e-9 { 0.5 } else { 0.0 }, 400, 0.01);
    let offset = |o| one(&ground, ProcessingStep::Offset(o));
    assert!((offset(OffsetCorrection::Mean).samples()[0] - 0.25).abs() < 1e-14);
    assert_eq!(
        offset(OffsetCorrection::PreEventMean(1.0)).samples()[0],
        0.0
    );
    assert_eq!(offset(OffsetCorrection::Value(0.5)).samples()[0], 1.0);
    refused(
        &ground,
        ProcessingStep::Offset(OffsetCorrection::PreEventMean(9.0)),
    );
    assert_eq!(one(&ground, ProcessingStep::Sign).samples()[0], -1.5);
    let inches = one(
        &ground,
        ProcessingStep::Unit(AccelerationUnit::InchPerSecondSquared),
    );
    assert_eq!((inches.samples()[0], inches.scale()), (1.5 * 0.0254, 1.0));
}

#[test]
fn windows() {
    let ground = of(|_| 1.0, 1001, 0.01);
    let cut = one(
        &ground,
        ProcessingStep::Trim(Trim::Times {
            start: 1.0,
            end: 3.0,
        }),
    );
    assert_eq!(cut.samples().len(), 201);
    let cut = process(
        &ground,
        &[ProcessingStep::Trim(Trim::Arias {
            from: 0.05,
            to: 0.95,
        })],
    )
    .unwrap();
    assert_eq!(cut.steps[0].get("start"), Some(0.5));
    assert_eq!(cut.steps[0].get("end"), Some(9.5));
    let whole = Husid::of(&ground, LINEAR).unwrap().arias_intensity();
    let kept = Husid::of(&cut.accelerogram, LINEAR)
        .unwrap()
        .arias_intensity();
    assert!((kept / whole - 0.9).abs() < 1e-12);
    let tapered = one(
        &ground,
        ProcessingStep::Taper {
            start: 1.0,
            end: 2.0,
        },
    );
    // What is told is what was done: whole steps.
    let between = [ProcessingStep::Taper {
        start: 1.009,
        end: 2.0,
    }];
    let done = process(&ground, &between).unwrap();
    assert_eq!(done.steps[0].get("start"), Some(1.0));
    assert_eq!(done.steps[0].get("end"), Some(2.0));
    assert_eq!(done.accelerogram.samples(), tapered.samples());
    let a = tapered.samples();
    for (i, exact) in [
        (0, 0.0),
        (50, 0.5),
        (25, 0.5 - 0.125_f64.sqrt()),
        (100, 1.0),
        (800, 1.0),
        (900, 0.5),
        (1000, 0.0),
    ] {
        assert!((a[i] - exact).abs() < 1e-14, "{i}: {}", a[i]);
    }
    let padded = one(
        &ground,
        ProcessingStep::Pad {
            before: 0.5,
            after: 20.0,
        },
    );
    assert_eq!(padded.samples().len(), 1001 + 50 + 2000);
    assert_eq!(
        (
            padded.samples()[49],
            padded.samples()[50],
            padded.samples()[1051]
        ),
        (0.0, 1.0, 0.0)
    );
    refused(
        &ground,
        ProcessingStep::Trim(Trim::Times {
            start: 1.0,
            end: 11.0,
        }),
    );
    refused(
        &ground,
        ProcessingStep::Trim(Trim::Times {
            start: 3.0,
            end: 1.0,
        }),
    );
    refused(
        &ground,
        ProcessingStep::Trim(Trim::Arias { from: 0.9, to: 0.1 }),
    );
    refused(
        &ground,
        ProcessingStep::Taper {
            start: 6.0,
            end: 6.0,
        },
    );
    refused(
        &ground,
        ProcessingStep::Pad {
            before: 0.0,
            after: -1.0,
        },
    );
}

/// A step that is far too short would make a pad of seconds as long as the memory.
#[test]
fn a_pad_of_more_samples_than_any_record_has_is_refused() {
    let short = record(vec![0.0, 1.0, 0.0], 1.0e-9);
    let pad = |before, after| ProcessingStep::Pad { before, after };
    refused(&short, pad(10.0, 0.0));
    refused(&short, pad(0.0, 10.0));
    one(&short, pad(1.0e-6, 0.0));
}

/// Each step that multiplies or integrates can leave the range of numbers: it says so by its
/// name, and there is no record.
#[test]
fn what_is_not_finite_is_no_record() {
    let ordinary = of(|t| (TAU * t).sin(), 400, 0.01);
    let huge = of(|t| 1.0e308 * (TAU * t).sin(), 400, 0.01);
    for (record, step, name) in [
        (
            &ordinary,
            ProcessingStep::Scale(Scale::Factor(f64::MAX)),
            "scale",
        ),
        (&huge, ProcessingStep::Scale(Scale::Factor(10.0)), "scale"),
        (
            &huge,
            ProcessingStep::Unit(AccelerationUnit::StandardGravity),
            "unit",
        ),
        (
            &huge,
            ProcessingStep::Offset(OffsetCorrection::Value(-1.7e308)),
            "offset",
        ),
    ] {
        let error = process(record, std::slice::from_ref(&step)).unwrap_err();
        let said = error.to_string();
        assert!(said.starts_with(&format!("{name}: ")), "{said}");
        assert!(said.contains("inf") || said.contains("NaN"), "{said}");
        assert!(error.help().is_some());
    }
    // Samples that only their unit makes infinite.
    let samples = vec![0.0, 1.0e308];
    assert!(Accelerogram::new(samples, AccelerationUnit::StandardGravity, 0.01).is_err());
}

/// The fit starts at the end of the first segment unless a key says otherwise: the message is of
/// the key that was given.
#[test]
fn a_first_segment_up_to_the_end() {
    let ordinary = of(|t| (TAU * t).sin(), 401, 0.01);
    let window = SegmentWindow::Times {
        start: 1.0,
        end: 3.99,
    };
    let said = |fit_from| {
        let step = ProcessingStep::Baseline(Baseline::TwoSegments { window, fit_from });
        process(&ordinary, &[step]).map_err(|error| error.to_string())
    };
    let told = said(None).unwrap_err();
    assert!(
        told.contains("the end of the first segment, 3.99 s"),
        "{told}"
    );
    assert!(
        said(Some(3.995))
            .unwrap_err()
            .contains("start of the fit = 3.995")
    );
    assert!(said(Some(3.5)).is_ok());
}
