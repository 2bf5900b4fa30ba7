//! Components are combined sample by sample: they must start together, and be two.
#![allow(clippy::unwrap_used)]

use pounding_ground_motion::processing::{ProcessingStep, Trim, distinct, process, rotate};
use pounding_ground_motion::spectra::{Evaluation, rotated_spectrum};
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
