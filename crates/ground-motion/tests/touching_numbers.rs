//! Numbers that fill their columns and touch: never read as another number.
use pounding_ground_motion::{AccelerationUnit, ReadOptions, read_bytes};

fn options(layout: Option<&str>) -> ReadOptions {
    ReadOptions {
        layout: layout.map(str::to_owned),
        unit: Some(AccelerationUnit::Gal),
        time_step: Some(0.01),
        ..ReadOptions::default()
    }
}

#[test]
fn integers_that_touch_are_refused_in_any_layout_but_their_own() {
    for (text, place, format, values) in [
        (
            "  1234-5678\n  1000-2000\n  1100-2300\n",
            "f:1:3: \"1234-5678\"",
            "",
            &[][..],
        ),
        (
            "     1     2    -3\n  1234-12345   234\n     7     8     9\n",
            "f:2:3: \"1234-12345\"",
            "3I6",
            &[1.0, 2.0, -3.0, 1234.0, -12345.0, 234.0, 7.0, 8.0, 9.0],
        ),
        (
            "     1     2    -3\n     7     8     9\n  1234-123   234\n",
            "f:3:3: \"1234-123\"",
            "",
            &[],
        ),
        ("50-3 4\n100.5 -2\n", "f:1:1: \"50-3\"", "", &[]),
        ("100-5\n-850.5\n3.0\n", "f:1:1: \"100-5\"", "", &[]),
    ] {
        for layout in [None, Some("a")] {
            let error = read_bytes("f", text.as_bytes(), &options(layout)).unwrap_err();
            let shown = error.to_string();
            assert!(shown.starts_with(place), "{layout:?}: {shown}");
            assert!(shown.contains("touch"), "{shown}");
            assert!(error.help().unwrap().contains("8I6"), "{error}");
        }
        if !format.is_empty() {
            let record = read_bytes("f", text.as_bytes(), &options(Some(format))).unwrap();
            let read: Vec<f64> = record
                .samples()
                .iter()
                .map(|a| (a * 100.0).round())
                .collect();
            assert_eq!(read, values, "{text}");
        }
    }
}

#[test]
fn exponents_without_their_letter_are_read() {
    let text = "1.234-103\n1.5+001\n-2.5-001\n";
    let record = read_bytes("f", text.as_bytes(), &options(None)).unwrap();
    for (a, value) in record.samples().iter().zip([1.234e-105, 0.15, -0.0025]) {
        assert!((a / value - 1.0).abs() < 1e-12, "{a} {value}");
    }
}

/// The remedy names the format of the row, which reads it.
#[test]
fn the_format_of_rows_that_touch_is_named() {
    for (text, format) in [
        (
            " 1.2345678E-01-2.3456789E+00\n-3.4567890E-01-4.5678901E+00\n",
            "2E14.7",
        ),
        (
            "   1.250  -2.500-100.250\n   1.000   2.000   3.000\n",
            "3F8.3",
        ),
        (
            "    1.25  -2.50-100.25\n    1.00   2.00   3.00\n",
            "1X,3F7.2",
        ),
    ] {
        let error = read_bytes("f", text.as_bytes(), &options(Some("a"))).unwrap_err();
        let named = format!("here `layout = \"{format}\"`");
        assert!(error.help().unwrap().contains(&named), "{error:?}");
        let record = read_bytes("f", text.as_bytes(), &options(Some(format))).unwrap();
        assert_eq!(record.samples().len(), text.matches('.').count());
    }
}
