//! Rows of plain numbers that say nothing of their columns, and Fortran formats of them.
#![allow(clippy::unwrap_used)]

use pounding_ground_motion::processing::{ProcessingStep, process};
use pounding_ground_motion::{
    AccelerationUnit, Accelerogram, GroundMotionError, ReadOptions, read_bytes,
};

const G: f64 = 9.80665;

fn options(layout: Option<&str>, time_step: Option<f64>) -> ReadOptions {
    ReadOptions {
        layout: layout.map(str::to_owned),
        unit: Some(AccelerationUnit::StandardGravity),
        time_step,
        ..ReadOptions::default()
    }
}

fn read(
    text: &str,
    layout: Option<&str>,
    time_step: Option<f64>,
) -> Result<Accelerogram, GroundMotionError> {
    read_bytes("f", text.as_bytes(), &options(layout, time_step))
}

fn value(i: usize) -> f64 {
    (1.7 * i as f64 + 1.0).sin()
}

/// Times are times wherever they start and in whichever column they stand, also beside a step
/// that is given; they were read as accelerations.
#[test]
fn columns_of_times_that_start_anywhere() {
    let rows = |start: f64, row: &dyn Fn(f64, f64) -> String| -> String {
        let line = |i: usize| row(start + 0.02 * i as f64, value(i)) + "\n";
        (0..50).map(line).collect()
    };
    let first = |t: f64, a: f64| format!("{t:.2} {a:.6}");
    let second = |t: f64, a: f64| format!("{a:.6} {t:.2}");
    for start in [0.0, 0.02, 5.0, -0.1, 1000.0] {
        for text in [rows(start, &first), rows(start, &second)] {
            for step in [None, Some(0.02)] {
                let record = read(&text, None, step).unwrap();
                assert_eq!((record.samples().len(), record.time_step()), (50, 0.02));
                for (i, a) in record.samples().iter().enumerate() {
                    assert!((a - value(i) * G).abs() < 1e-5, "{start} {i}");
                }
            }
        }
    }
    // Times of film are not even.
    let uneven: String = (0..50)
        .map(|i| {
            format!(
                "{:.3} {:.6}\n",
                5.0 + 0.02 * (i as f64 + 0.2 * value(i)),
                value(i)
            )
        })
        .collect();
    let error = read(&uneven, None, None).unwrap_err();
    assert!(matches!(error, GroundMotionError::Uneven { .. }), "{error}");
    // A row that is cut off has no value.
    let cut = rows(5.0, &first) + "6.00\n";
    let error = read(&cut, None, Some(0.02)).unwrap_err().to_string();
    assert!(error.starts_with("f:51:1: 1 columns"), "{error}");
    // Two columns of times: the user says which.
    let both = |t: f64, a: f64| format!("{t:.2} {t:.2} {a:.6}");
    let error = read(&rows(5.0, &both), None, None).unwrap_err();
    assert!(
        error
            .to_string()
            .starts_with("f:1:1: the values of column 1"),
        "{error}"
    );
    assert!(error.help().unwrap().contains("layout"));
    assert_eq!(
        read(&rows(5.0, &both), Some("-,t,a"), None)
            .unwrap()
            .samples()
            .len(),
        50
    );
}

/// Two or three values a row are components as well as one series: none is guessed.
#[test]
fn components_without_times_are_not_one_series() {
    let rows = |width: usize, count: usize| -> String {
        let row = |i: usize| {
            let values: Vec<_> = (0..width)
                .map(|k| format!("{:.5}", value(width * i + k)))
                .collect();
            values.join(" ") + "\n"
        };
        (0..count).map(row).collect()
    };
    for (text, place) in [
        (rows(2, 30), "f:1:1: rows of 2 values"),
        (
            "NS EW UD\n".to_owned() + &rows(3, 30),
            "f:2:1: rows of 3 values",
        ),
        (
            "NS, EW, UD, 090\n".to_owned() + &rows(4, 3),
            "f:2:1: rows of 4 values",
        ),
    ] {
        let error = read(&text, None, Some(0.02)).unwrap_err();
        assert!(error.to_string().starts_with(place), "{error}");
        assert!(error.help().unwrap().contains("\"ns,ew,ud\""));
        let along = read(&text, Some("a"), Some(0.02)).unwrap();
        assert!((along.samples()[1] - value(1) * G).abs() < 1e-4);
    }
    let named = ReadOptions {
        component: Some("ew".to_owned()),
        ..options(Some("ns,ew"), Some(0.02))
    };
    assert_eq!(
        read_bytes("f", rows(2, 30).as_bytes(), &named)
            .unwrap()
            .samples()
            .len(),
        30
    );
    // What agencies wrap.
    for width in [4, 5, 6, 8, 10] {
        let text = "Imperial Valley 1940 El Centro NS component corrected by USGS\n".to_owned()
            + &rows(width, 30);
        let record = read(&text, None, Some(0.02)).unwrap();
        assert_eq!(record.samples().len(), 30 * width, "{width}");
    }
}

/// Fortran's input: digits without a point are decimals as the format says.
#[test]
fn fortran_formats_with_implied_decimals() {
    let text =
        "      -241      -638      -712       586\n      1.25      -638      -712       586\n";
    let record = read(text, Some("4F10.5"), Some(0.02)).unwrap();
    let expected = [
        -0.00241, -0.00638, -0.00712, 0.00586, 1.25, -0.00638, -0.00712, 0.00586,
    ];
    for (a, expected) in record.samples().iter().zip(expected) {
        assert!((a - expected * G).abs() < 1e-14, "{a} {expected}");
    }
    let spaced = "  1.500000E-01  2.500000E-01\n  3.500000E-01\n";
    for format in ["(1P2E14.6)", "2(1X,E13.6)", "1X,E13.6,E14.6", "1P,2E14.6"] {
        let found = read(spaced, Some(format), Some(0.02));
        if format == "1X,E13.6,E14.6" {
            // One number of this width a line, and more behind it.
            assert_eq!(found.unwrap().samples().len(), 2);
            continue;
        }
        let record = found.unwrap();
        assert_eq!(record.samples().len(), 3, "{format}");
        assert!((record.samples()[2] - 0.35 * G).abs() < 1e-14);
    }
    let error = read(spaced, Some("2(F8.3,F6.4)"), Some(0.02)).unwrap_err();
    assert!(error.to_string().contains("is not understood"), "{error}");
    let margin = "9 1.50000 2.50000\n";
    let error = read(margin, Some("2(1X,F8.5)"), Some(0.02)).unwrap_err();
    assert!(error.to_string().contains("must be blank"), "{error}");
    // The last card is short, its number behind the blanks.
    let cards = format!(
        "{}{:>7}\n{:<72}{:>7}\n",
        "  1.25000".repeat(8),
        1,
        "  2.25000".repeat(3),
        2
    );
    let record = read(&cards, Some("8F9.6"), Some(0.02)).unwrap();
    assert_eq!(record.samples().len(), 11);
}

/// The true unit is that of the values in the file, whatever unit it states.
#[test]
fn true_units_of_files_that_state_another() {
    let csv = |unit: &str| format!("time_s,acceleration_{unit}\n0.00,0\n0.02,35\n0.04,-7\n");
    let at2 = "TITLE\nMORE\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS= 3, DT= .02 SEC\n 0.0 35.0 -7.0\n";
    for text in [&csv("g"), &csv("m_s2"), &csv("gal"), at2] {
        let record = read_bytes("f", text.as_bytes(), &ReadOptions::default()).unwrap();
        let steps = [
            ProcessingStep::Unit(AccelerationUnit::StandardGravity),
            ProcessingStep::Unit(AccelerationUnit::Gal),
        ];
        for steps in [&steps[1..], &steps] {
            let processed = process(&record, steps).unwrap().accelerogram;
            assert!((processed.peak().value - 0.35).abs() < 1e-12, "{text}");
        }
    }
}
