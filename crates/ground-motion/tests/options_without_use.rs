//! Options that say nothing of a record are refused, each with the record and what to do.
use pounding_ground_motion::{AccelerationUnit, Format, ReadOptions, read_bytes};

const AT2: &str =
    "A\nB\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS= 4, DT= 0.01 SEC\n0.1 -0.2 0.3 -0.1\n";
const CSV: &str = "time_s,acceleration_m_s2\n0,0.1\n0.01,0.2\n0.02,0.1\n";
const COLUMN: &str = "0.1\n-0.2\n0.3\n-0.1\n";

fn refused(text: &str, options: &ReadOptions, wanted: &[&str]) {
    let error = read_bytes("record", text.as_bytes(), options).unwrap_err();
    let said = format!("{error}; {}", error.help().unwrap_or_default());
    for part in ["record: "].iter().chain(wanted) {
        assert!(said.contains(part), "\"{part}\" is not in: {said}");
    }
}

#[test]
fn options_of_other_formats() {
    let none = ReadOptions::default;
    for text in [AT2, CSV] {
        let layout = ReadOptions {
            layout: Some("t,a".to_owned()),
            ..none()
        };
        refused(
            text,
            &layout,
            &["`layout` is given", "plain columns", "leave it out"],
        );
        let lines = ReadOptions {
            skip_lines: 1,
            format: Some(
                Format::find(if text == AT2 {
                    "peer_at2"
                } else {
                    "pounding_csv"
                })
                .unwrap(),
            ),
            ..none()
        };
        refused(text, &lines, &["`skip_lines` is given"]);
        let columns = ReadOptions {
            skip_columns: 1,
            ..none()
        };
        refused(text, &columns, &["`skip_columns` is given"]);
        let sensitivity = ReadOptions {
            sensitivity: Some(1000.0),
            ..none()
        };
        refused(
            text,
            &sensitivity,
            &["`sensitivity` is given", "counts", "leave it out"],
        );
    }
    let gravity = ReadOptions {
        gravity: Some(9.81),
        ..none()
    };
    refused(
        CSV,
        &gravity,
        &["`gravity` is given", "no value of this record is in g"],
    );
    // One in other units than m/s2.
    for wrong in [981.0, 386.1, 32.174, 1.0, -9.81, f64::NAN] {
        let options = ReadOptions {
            gravity: Some(wrong),
            ..ReadOptions::default()
        };
        let said = read_bytes("record", AT2.as_bytes(), &options)
            .unwrap_err()
            .to_string();
        assert!(said.contains("outside [9.7, 9.9]"), "{said}");
    }
    let used = read_bytes("record", AT2.as_bytes(), &gravity).unwrap();
    assert!((used.peak().value - 0.3 * 9.81).abs() < 1e-12);
}

#[test]
fn options_of_plain_columns() {
    let options = ReadOptions {
        unit: Some(AccelerationUnit::StandardGravity),
        time_step: Some(0.01),
        layout: Some("a".to_owned()),
        skip_lines: 1,
        gravity: Some(9.81),
        ..ReadOptions::default()
    };
    let read = read_bytes("record", COLUMN.as_bytes(), &options).unwrap();
    assert_eq!(read.samples().len(), 3);
    assert!((read.peak().value - 0.3 * 9.81).abs() < 1e-12);
    let counts = ReadOptions {
        sensitivity: Some(1000.0),
        ..options
    };
    refused(
        COLUMN,
        &counts,
        &["`sensitivity` is given", "plain_columns"],
    );
}

/// A second column of the same name, and a unit that is none, have file and line.
#[test]
fn headers_of_our_layout_have_a_place() {
    for (header, wanted) in [
        ("time_s,acceleration_g,acceleration_g", "record:1:22: "),
        (
            "time_s,acceleration_furlong",
            "record:1:21: \"furlong\" is not a unit",
        ),
    ] {
        let text = format!("{header}\n0,0.1\n0.01,0.2\n");
        let error = read_bytes("record", text.as_bytes(), &ReadOptions::default()).unwrap_err();
        assert!(error.to_string().contains(wanted), "{error}");
        assert!(error.help().is_some());
    }
    let text = format!("# Unit: cubit\n{CSV}");
    let error = read_bytes("record", text.as_bytes(), &ReadOptions::default()).unwrap_err();
    assert!(error.to_string().starts_with("record:1:1: "), "{error}");
}
