//! Rows of plain numbers that say nothing of their columns, and Fortran formats of them.
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
    // A title of one acceleration says no more; a count of samples does.
    let title = "Acceleration (cm/s2)\ndt = 0.02 s\n";
    for width in [2, 3] {
        let text = |count: &str| title.to_owned() + count + &rows(width, 30);
        let without_unit = ReadOptions::default();
        let read = |count: &str| read_bytes("f", text(count).as_bytes(), &without_unit);
        let asked = read("").unwrap_err();
        let place = format!("f:3:1: rows of {width} values");
        assert!(asked.to_string().starts_with(&place), "{asked}");
        let asked = read("Samples: 30\n").unwrap_err();
        let told = "as many rows as the header counts samples";
        assert!(asked.to_string().contains(told), "{asked}");
        let along = read(&format!("Samples: {}\n", 30 * width)).unwrap();
        assert_eq!(along.samples().len(), 30 * width);
        let headless = format!("Samples: {}\n{}", 30 * width, rows(width, 30));
        let along = read_bytes("f", headless.as_bytes(), &options(None, Some(0.02))).unwrap();
        assert_eq!(along.samples().len(), 30 * width);
    }
    let padded = format!("{title}Samples: 88\n{}0.1 0 0\n", rows(3, 29));
    let along = read_bytes("f", padded.as_bytes(), &ReadOptions::default()).unwrap();
    assert_eq!(along.samples().len(), 88);
    // What agencies wrap.
    for width in [4, 5, 6, 8, 10] {
        let text = "Imperial Valley 1940 El Centro NS component corrected by USGS\n".to_owned()
            + &rows(width, 30);
        let record = read(&text, None, Some(0.02)).unwrap();
        assert_eq!(record.samples().len(), 30 * width, "{width}");
    }
}

/// Rows of more values whose columns go on from row to row are as many series, whatever their number; with a count
/// of all numbers they are one.
#[test]
fn values_that_go_on_down_the_columns_are_no_series_along_the_rows() {
    let columns = |width: usize| -> String {
        let row = |i: usize| {
            let at = |k: usize| (0.35 * i as f64 + 2.0 * k as f64).sin();
            let values: Vec<_> = (0..width).map(|k| format!("{:.5}", at(k))).collect();
            values.join(" ") + "\n"
        };
        (0..40).map(row).collect()
    };
    let title = "Acceleration (cm/s2)\ndt = 0.02 s\n";
    let read = |text: &str| read_bytes("f", text.as_bytes(), &ReadOptions::default());
    for width in [4, 5, 6, 8] {
        let asked = read(&(title.to_owned() + &columns(width))).unwrap_err();
        let place = format!("f:3:1: rows of {width} values");
        assert!(asked.to_string().starts_with(&place), "{asked}");
        let bare = columns(width);
        let asked = read_bytes("f", bare.as_bytes(), &options(None, Some(0.02))).unwrap_err();
        assert!(asked.to_string().contains("beside one another"), "{asked}");
        let counted = format!("{title}Samples: {}\n{}", 40 * width, columns(width));
        assert_eq!(read(&counted).unwrap().samples().len(), 40 * width);
        let said = options(Some("a"), Some(0.02));
        let along = read_bytes("f", bare.as_bytes(), &said).unwrap();
        assert_eq!(along.samples().len(), 40 * width);
        // One series along the rows stays one, noise too.
        let noise = |n: usize| ((n * n * 7919) % 10_007) as f64 - 5000.0;
        for series in [
            &|n: usize| 100.0 * (0.3 * n as f64).sin(),
            &noise as &dyn Fn(usize) -> f64,
        ] {
            let row = |i: usize| {
                let values: Vec<_> = (0..width)
                    .map(|k| format!("{:.5}", series(width * i + k)))
                    .collect();
                values.join(" ") + "\n"
            };
            let text = title.to_owned() + &(0..40).map(row).collect::<String>();
            assert_eq!(read(&text).unwrap().samples().len(), 40 * width, "{width}");
        }
    }
}

/// As many rows as the header counts samples are those of components, in a header of AT2 too.
#[test]
fn a_count_of_rows_is_that_of_components() {
    let rows = |width: usize| -> String {
        (0..40)
            .map(|i| format!("{:.4} ", value(i)).repeat(width) + "\n")
            .collect()
    };
    let title = "Acceleration (g)\nNPTS: 40, DT: 0.02 s\n";
    for width in [2, 3, 5] {
        for lenient in [false, true] {
            let given = ReadOptions {
                lenient,
                ..ReadOptions::default()
            };
            let text = title.to_owned() + &rows(width);
            let error = read_bytes("f", text.as_bytes(), &given).unwrap_err();
            let told = format!(
                "f:3:1: the header says 40 samples, and there are as many rows, of {width} values"
            );
            assert!(error.to_string().starts_with(&told), "{error}");
            assert!(
                error.help().unwrap().contains("`skip_lines = 2`"),
                "{error}"
            );
        }
    }
    let one = title.to_owned() + &rows(1);
    let read = read_bytes("f", one.as_bytes(), &ReadOptions::default()).unwrap();
    assert_eq!(read.samples().len(), 40);
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

/// Pairs of time and value that follow one another along the rows are read in their order; three of
/// four samples were lost, or times were read as accelerations.
#[test]
fn pairs_along_rows() {
    let pair = |i: usize| format!("{:.3} {:.5} ", 0.01 * i as f64, value(i));
    for along in [2, 4] {
        let text: String = (0..400)
            .map(|i| pair(i) + if i % along + 1 == along { "\n" } else { "" })
            .collect();
        for layout in [None, Some("t,a")] {
            let record = read(&text, layout, None).unwrap();
            assert_eq!((record.samples().len(), record.time_step()), (400, 0.01));
            for (i, a) in record.samples().iter().enumerate() {
                assert!((a - value(i) * G).abs() < 1e-3, "{i}");
            }
        }
        // They are no series along the rows, also with a row out of its place.
        let mut lines: Vec<&str> = text.lines().collect();
        lines.swap(20, 21);
        for (text, layout) in [
            (text.clone(), Some("a")),
            (lines.join("\n"), Some("a")),
            (lines.join("\n"), None),
        ] {
            let error = read(&text, layout, Some(0.01)).unwrap_err().to_string();
            assert!(error.contains("as times do"), "{layout:?}: {error}");
        }
    }
    // Two components, each with times of its own.
    let later = |i: usize| pair(i) + &pair(i + 1) + "\n";
    let twice: String = (0..100).map(later).collect();
    let error = read(&twice, None, None).unwrap_err().to_string();
    assert!(error.contains("so do those of column 3"), "{error}");
    // Columns beside times, read along the rows.
    let three: String = (0..100)
        .map(|i| format!("{} {:.5}\n", pair(i), value(i + 50)))
        .collect();
    let error = read(&three, Some("a"), Some(0.01)).unwrap_err().to_string();
    assert!(error.contains("one of every 3 numbers"), "{error}");
    // A slow motion in one series is one.
    let slow: String = (0..400)
        .map(|i| {
            format!(
                "{:.5}{}",
                (0.01 * i as f64).sin(),
                if i % 4 == 3 { "\n" } else { " " }
            )
        })
        .collect();
    assert_eq!(
        read(&slow, Some("a"), Some(0.01)).unwrap().samples().len(),
        400
    );
}

/// Numbers of the rows beside times are passed over; the times were offered as an acceleration.
#[test]
fn row_numbers_beside_times() {
    let row =
        |first: usize, i: usize| format!("{} {:.2} {:.5}\n", i + first, 0.02 * i as f64, value(i));
    for first in [0, 1] {
        let text: String = (0..50).map(|i| row(first, i)).collect();
        let record = read(&text, None, None).unwrap();
        assert_eq!((record.samples().len(), record.time_step()), (50, 0.02));
        assert!((record.samples()[7] - value(7) * G).abs() < 1e-3);
        let warnings = &record.origin().unwrap().warnings;
        assert!(
            warnings
                .iter()
                .any(|w| w.contains("column 1 counts the rows"))
        );
    }
    let last: String = (0..50)
        .map(|i| format!("{:.2} {:.5} {}\n", 0.02 * i as f64, value(i), i + 1))
        .collect();
    let record = read(&last, None, None).unwrap();
    assert_eq!((record.samples().len(), record.time_step()), (50, 0.02));
}

/// A count before the values, with the step or alone, was the first sample.
#[test]
fn counts_in_lines_of_their_own() {
    let rows = |along: usize| -> String {
        let end = |i: usize| if i % along + 1 == along { "\n" } else { " " };
        (0..120)
            .map(|i| format!("{:.5}{}", value(i), end(i)))
            .collect()
    };
    for (head, step) in [
        ("120\n", Some(0.01)),
        ("120\n0.01\n", None),
        ("0.01\n120\n", None),
        ("120\n0.01\n", Some(0.01)),
        ("120 0.01\n", None),
    ] {
        for (along, layout) in [(1, None), (1, Some("a")), (8, None), (8, Some("a"))] {
            if along == 8 && head.lines().count() == 2 {
                continue;
            }
            let record = read(&(head.to_owned() + &rows(along)), layout, step)
                .unwrap_or_else(|e| panic!("{head} {along} {layout:?}: {e}"));
            assert_eq!(
                (record.samples().len(), record.time_step()),
                (120, 0.01),
                "{head}"
            );
            assert!((record.samples()[0] - value(0) * G).abs() < 1e-3);
        }
    }
    // Another count.
    let error = read(&("121\n".to_owned() + &rows(1)), None, Some(0.01)).unwrap_err();
    assert!(
        matches!(error, GroundMotionError::TooFewSamples { .. }),
        "{error}"
    );
    // The step alone, or a first sample that is the same number.
    let text = "0.01\n".to_owned() + &rows(1);
    let error = read(&text, None, Some(0.01)).unwrap_err();
    assert!(
        error.to_string().contains("is the time step that is given"),
        "{error}"
    );
    assert!(error.help().unwrap().contains("--skip-lines 1"), "{error}");
    assert_eq!(
        read(&text, Some("a"), Some(0.01)).unwrap().samples().len(),
        121
    );
    // Whole numbers that are samples.
    for text in ["3\n1\n-2\n4\n", "2.0\n1.5\n-0.5\n", "7\n1.5\n-0.5\n"] {
        let record = read(text, None, Some(0.01)).unwrap();
        assert_eq!(record.samples().len(), text.lines().count(), "{text}");
    }
}

/// Units that headers may state, a fill and a repeat count in their own words.
#[test]
fn units_fills_and_repeat_counts() {
    let with = |text: &str, unit: &str| {
        let options = ReadOptions {
            unit: Some(unit.parse().unwrap()),
            time_step: Some(0.01),
            ..ReadOptions::default()
        };
        read_bytes("f", text.as_bytes(), &options)
    };
    for (unit, each) in [("mg", 1.0e-3), ("g/10", 0.1)] {
        let record = with("1.0\n-2.0\n0.5\n", unit).unwrap();
        assert!(
            (record.samples()[1] + 2.0 * each * G).abs() < 1e-12,
            "{unit}"
        );
        let origin = record.origin().unwrap();
        assert_eq!(origin.unit, format!("{unit} (given by the user)"));
    }
    let filled = with("1.0\n9999\n0.5\n", "g").unwrap();
    let warnings = &filled.origin().unwrap().warnings;
    assert!(
        warnings[0].contains("sample 2 is exactly 9999"),
        "{warnings:?}"
    );
    let error = with("1.0\n2*0.5\n", "g").unwrap_err().to_string();
    assert!(
        error.contains("repeat count of Fortran, 2 times 0.5"),
        "{error}"
    );
    let error = with("1.0\n****\n", "g").unwrap_err().to_string();
    assert!(error.contains("Fortran overflow"), "{error}");
}
