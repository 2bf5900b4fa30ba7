//! Components are combined sample by sample: they must start together, and be two.
use pounding_ground_motion::processing::{ProcessingStep, Trim, distinct, process, rotate};
use pounding_ground_motion::spectra::{Evaluation, response_spectrum, rotated_spectrum};
use pounding_ground_motion::{Accelerogram, ReadOptions, read_bytes};

use crate::common::binary::{SENSITIVITY, Seed, counts, record};
use crate::common::fixtures;

fn component(direction: &str, seconds: &str) -> Accelerogram {
    let fixture = fixtures("k_net", 0).remove(0);
    let text = String::from_utf8(fixture.bytes).unwrap();
    let text = text.replace("00:00:20", seconds).replace("E-W", direction);
    read_bytes("f", text.as_bytes(), &fixture.options).unwrap()
}

#[test]
fn components_that_start_at_different_times_are_refused() {
    let first = component("E-W", "00:00:20");
    let together = component("N-S", "00:00:20");
    let later = component("N-S", "00:00:23");
    assert!(rotate(&first, &together, 30.0).is_ok());
    for error in [
        rotate(&first, &later, 30.0).unwrap_err(),
        rotated_spectrum(&first, &later, &[0.2], 0.05, Evaluation::AtSamples).unwrap_err(),
    ] {
        let shown = error.to_string();
        assert!(
            shown.contains("00:00:20") && shown.contains("00:00:23"),
            "{shown}"
        );
        assert!(error.help().unwrap().contains("--trim"), "{shown}");
    }
    // Cut since, it starts elsewhere.
    let cut = ProcessingStep::Trim(Trim::Times {
        start: 0.05,
        end: 0.2,
    });
    let cut = process(&first, &[cut]).unwrap().accelerogram;
    assert!(rotate(&cut, &together, 30.0).is_err());
}

#[test]
fn a_component_beside_itself_is_refused() {
    let first = component("E-W", "00:00:20");
    let error = distinct(&first, &first.clone()).unwrap_err().to_string();
    assert!(error.contains("the same series, \"EW\""), "{error}");
    let other = first.scaled_by(0.5).unwrap();
    assert!(distinct(&first, &other).is_ok());
}

/// A component of so many samples: strong from 1 to 2 s, and from 3 to 3.5 s times `tail`.
fn lasting(name: &str, count: usize, tail: f64) -> Accelerogram {
    let mut text = format!("# Component: {name}\ntime_s,acceleration_m_s2\n");
    for i in 0..count {
        let time = i as f64 * 0.01;
        let size = match time {
            t if (1.0..2.0).contains(&t) => 1.0,
            t if (3.0..3.5).contains(&t) => tail,
            _ => 0.0,
        };
        text.push_str(&format!("{time:.2},{:.6}\n", size * (19.0 * time).sin()));
    }
    read_bytes(name, text.as_bytes(), &ReadOptions::default()).unwrap()
}

/// Where the ground still moves a little behind the end of the shorter component, that one is
/// continued with zeros and both lengths are named: no direction has less than a component alone.
#[test]
fn a_shorter_component_is_continued_with_zeros() {
    let (long, short) = (lasting("NS", 400, 0.04), lasting("EW", 300, 0.0));
    let periods = [0.0, 0.1, 0.33, 2.0];
    for evaluation in [Evaluation::AtSamples, Evaluation::PiecewiseLinear] {
        for (first, second) in [(&long, &short), (&short, &long)] {
            let both = rotated_spectrum(first, second, &periods, 0.05, evaluation).unwrap();
            for one in [first, second] {
                let alone = response_spectrum(one, &periods, 0.05, evaluation).unwrap();
                for (most, alone) in both.maximum.iter().zip(&alone.pseudo_acceleration) {
                    assert!(*most >= alone * (1.0 - 1e-12), "{most} {alone}");
                }
            }
            let [warning] = both.warnings.as_slice() else {
                panic!("{:?}", both.warnings)
            };
            for part in ["400 samples in 3.99 s", "300 samples in 2.99 s", "4.0 %"] {
                assert!(warning.contains(part), "{warning}");
            }
            let turned = rotate(first, second, 30.0).unwrap();
            for one in [&turned.first, &turned.second] {
                assert_eq!(one.samples().len(), 400);
                assert!(one.origin().unwrap().warnings.contains(warning));
            }
            assert_eq!(
                turned.step.get("samples of the first"),
                Some(first.samples().len() as f64)
            );
        }
    }
    // Nothing is said of components of one length.
    let other = lasting("EW", 400, 0.0);
    let both = rotated_spectrum(&long, &other, &periods, 0.05, Evaluation::AtSamples).unwrap();
    assert!(both.warnings.is_empty(), "{:?}", both.warnings);
}

/// What a component did is not known where it has ended and the other still moves strongly.
#[test]
fn a_component_that_ends_in_strong_motion_is_refused() {
    let (long, short) = (lasting("NS", 400, 1.4), lasting("EW", 300, 0.0));
    for error in [
        rotate(&long, &short, 30.0).unwrap_err(),
        rotate(&short, &long, 30.0).unwrap_err(),
        rotated_spectrum(&long, &short, &[0.2], 0.05, Evaluation::AtSamples).unwrap_err(),
    ] {
        let shown = error.to_string();
        for part in ["400 samples", "300 samples", "\"NS\"", "\"EW\"", "100.0 %"] {
            assert!(shown.contains(part), "{shown}");
        }
        assert!(error.help().unwrap().contains("--trim"), "{shown}");
    }
}

/// Columns of times say when a component starts where no date does. One without such a column
/// says nothing of it.
#[test]
fn columns_of_times_that_start_apart_are_refused() {
    let read = |name: &str, first: f64, options: &ReadOptions| {
        let mut text = format!("time (s),{name} (g)\n");
        for i in 0..50 {
            let time = first + 0.02 * f64::from(i);
            text.push_str(&format!("{time:.2},{:.4}\n", (0.7 * f64::from(i)).sin()));
        }
        read_bytes(name, text.as_bytes(), options).unwrap()
    };
    let plain = ReadOptions::default();
    let zero = ReadOptions {
        prepend_zero: true,
        ..ReadOptions::default()
    };
    let first = read("NS", 0.0, &plain);
    for start in [0.0, 0.01] {
        rotate(&first, &read("EW", start, &plain), 30.0).unwrap();
    }
    for start in [0.02, 5.0] {
        let later = read("EW", start, &plain);
        for error in [
            rotate(&first, &later, 30.0).unwrap_err(),
            rotated_spectrum(&later, &first, &[0.2], 0.05, Evaluation::AtSamples).unwrap_err(),
        ] {
            let shown = error.to_string();
            let times = [
                format!("{start} s of their times"),
                "0 s of their times".to_owned(),
            ];
            assert!(times.iter().all(|t| shown.contains(t)), "{shown}");
            let help = error.help().unwrap();
            assert!(
                help.contains("--trim") && help.contains("motion convert"),
                "{help}"
            );
        }
    }
    // From one step on, both; and with the zero before them.
    let (one, other) = (read("NS", 0.02, &plain), read("EW", 0.02, &plain));
    rotate(&one, &other, 30.0).unwrap();
    let end = ProcessingStep::Trim(Trim::Times {
        start: 0.0,
        end: 0.98,
    });
    let from_zero = process(&read("EW", 0.02, &zero), &[end]).unwrap();
    rotate(&first, &from_zero.accelerogram, 30.0).unwrap();
    // What is cut off moves the start.
    let cut = ProcessingStep::Trim(Trim::Times {
        start: 0.02,
        end: 0.98,
    });
    let cut = process(&first, &[cut]).unwrap().accelerogram;
    let of_its_length = ProcessingStep::Trim(Trim::Times {
        start: 0.0,
        end: 0.96,
    });
    let of_its_length = process(&other, &[of_its_length]).unwrap().accelerogram;
    rotate(&cut, &of_its_length, 30.0).unwrap();
    let error = rotate(&cut, &read("EW", 0.0, &plain), 30.0).unwrap_err();
    assert!(
        error.to_string().contains("0.02 s of their times"),
        "{error}"
    );
    // Samples alone.
    let text: String = (0..50)
        .map(|i| format!("{:.4}\n", (0.3 * f64::from(i)).sin()))
        .collect();
    let options = ReadOptions {
        unit: Some(pounding_ground_motion::AccelerationUnit::StandardGravity),
        time_step: Some(0.02),
        ..ReadOptions::default()
    };
    let bare = read_bytes("f", text.as_bytes(), &options).unwrap();
    rotate(&bare, &other, 30.0).unwrap();
}

/// Gaps of less than half a sample add up.
#[test]
fn small_gaps_between_records_are_named() {
    let values = counts();
    let at_100_hz = |late: u32| -> Vec<u8> {
        let records = (0..30_u32).map(|k| {
            let length = values.len() as u32;
            record(&Seed {
                channel: b"HNE",
                encoding: 3,
                big: true,
                start: k * (100 * length + late),
                count: u16::try_from(length).unwrap(),
                data: values.iter().flat_map(|c| c.to_be_bytes()).collect(),
            })
        });
        records.flatten().collect()
    };
    let options = ReadOptions {
        sensitivity: Some(SENSITIVITY),
        ..ReadOptions::default()
    };
    for (late, named) in [(0, false), (40, true)] {
        let found = read_bytes("f", &at_100_hz(late), &options).unwrap();
        assert_eq!(found.samples().len(), 30 * values.len());
        let warnings = &found.origin().unwrap().warnings;
        let says = |w: &String| w.contains("11.6 samples") && w.contains("later");
        assert_eq!(warnings.iter().any(says), named, "{warnings:?}");
    }
}
