//! Names, units, steps and counts that plain columns state in any usual layout: read as they say, or
//! refused with the line.
use pounding_ground_motion::processing::rotate;
use pounding_ground_motion::{
    AccelerationUnit, GroundMotionError, ReadOptions, Recording, Sampling, read_all_bytes,
    read_bytes,
};

const G: f64 = 9.80665;
const ROWS: usize = 40;

fn value(i: usize) -> f64 {
    0.3 * (1.7 * i as f64 + 1.0).sin()
}

fn in_g() -> ReadOptions {
    ReadOptions {
        unit: Some(AccelerationUnit::StandardGravity),
        ..ReadOptions::default()
    }
}

/// Rows of a time and so many values.
fn timed(values: usize, separator: &str) -> String {
    let row = |i: usize| {
        let cells = (0..values).map(|k| format!("{separator}{:.6}", value(values * i + k)));
        format!("{:.2}{}\n", 0.01 * i as f64, cells.collect::<String>())
    };
    (0..ROWS).map(row).collect()
}

/// Rows of so many values.
fn along(values: usize, rows: usize, separator: &str) -> String {
    let row = |i: usize| {
        let cells: Vec<_> = (0..values)
            .map(|k| format!("{:.6}", value(values * i + k)))
            .collect();
        cells.join(separator) + "\n"
    };
    (0..rows).map(row).collect()
}

fn all(text: &str, options: &ReadOptions) -> Result<Recording, GroundMotionError> {
    read_all_bytes("f", text.as_bytes(), options)
}

fn refused(text: &str, options: &ReadOptions, words: &[&str]) {
    let error = match all(text, options) {
        Err(error) => error,
        Ok(read) => panic!("{text}: {:?}", read.series[0].samples),
    };
    let shown = format!("{error}; {}", error.help().unwrap_or_default());
    for word in words {
        assert!(shown.contains(word), "{word}: {text}: {shown}");
    }
}

fn names(recording: &Recording) -> Vec<&str> {
    recording.series.iter().map(|s| &*s.component).collect()
}

#[test]
fn names_without_units_beside_times_are_kept() {
    for (header, separator, expected) in [
        ("Time NS EW UD", " ", ["NS", "EW", "UD"]),
        ("t,ns,ew,ud", ",", ["ns", "ew", "ud"]),
        ("time HNE HNN HNZ", " ", ["HNE", "HNN", "HNZ"]),
        ("time;NS;EW;UD", ";", ["NS", "EW", "UD"]),
        ("Time,N-S,E-W,U-D", ",", ["N-S", "E-W", "U-D"]),
        ("Time (s),RSN1,RSN2,RSN3", ",", ["RSN1", "RSN2", "RSN3"]),
        ("time acc_x acc_y acc_z", " ", ["acc_x", "acc_y", "acc_z"]),
        ("# Time Roof Base Mid", " ", ["Roof", "Base", "Mid"]),
        (" T Z N E", " ", ["Z", "N", "E"]),
        ("Tempo\tNS\tEW\tUD", "\t", ["NS", "EW", "UD"]),
    ] {
        let text = format!("{header}\n{}", timed(3, separator));
        let read = all(&text, &in_g()).unwrap_or_else(|e| panic!("{header}: {e}"));
        assert_eq!(names(&read), expected, "{header}");
        for (k, series) in read.series.iter().enumerate() {
            assert_eq!(series.samples.len(), ROWS, "{header}");
            assert!(
                (series.samples[5] - G * value(15 + k)).abs() < 1e-5,
                "{header}"
            );
        }
        let unit = read_bytes("f", text.as_bytes(), &ReadOptions::default()).unwrap_err();
        assert!(
            matches!(unit, GroundMotionError::MissingUnit { .. }),
            "{unit}"
        );
    }
    // The names say directions.
    let one = |component: &str| {
        let component = Some(component.to_owned());
        let options = ReadOptions {
            component,
            ..in_g()
        };
        let text = format!("t,ns,ew,ud\n{}", timed(3, ","));
        read_bytes("f", text.as_bytes(), &options).unwrap()
    };
    rotate(&one("ns"), &one("ew"), 30.0).unwrap();
    assert!(rotate(&one("ns"), &one("3"), 30.0).is_err());
    // A sentence names no columns.
    let text = format!("Time history of NS\n{}", timed(3, " "));
    assert_eq!(all(&text, &in_g()).unwrap().series[0].component, "column_2");
}

#[test]
fn columns_of_something_else_are_left_out() {
    for header in [
        "Time (s),Acc (g),Force (kN)",
        "Time (s),Acc (g),Gyro X (rad/s)",
        "Time (s),Acc (g),Temp (C)",
        "Time (s),Acc (g),Flag",
        "Time (s),Acc (g),Arias (%)",
        "Time (s),Acc (g),Force (kN),,,",
    ] {
        let text = format!("{header}\n{}", timed(2, ","));
        let read = all(&text, &ReadOptions::default()).unwrap_or_else(|e| panic!("{header}: {e}"));
        assert_eq!(names(&read), ["a"], "{header}");
        let warnings = &read.series[0].origin.warnings;
        assert!(
            warnings
                .iter()
                .any(|w| w.contains("not read as accelerations")),
            "{header}"
        );
    }
    let force = format!("time force acc\n{}", timed(2, " "));
    let read = all(&force, &in_g()).unwrap();
    assert_eq!(names(&read), ["a"]);
    assert!((read.series[0].samples[0] - G * value(1)).abs() < 1e-5);
    // Numbers of the rows, as programs of tables write them.
    for header in [
        ",Time (s),Acc (g)",
        "#,Time (s),Acc (g)",
        "id,Time (s),Acc (g)",
        "Unnamed: 0,Time (s),Acc (g)",
    ] {
        let row = |i: usize| format!("{i},{:.2},{:.6}\n", 0.01 * i as f64, value(i));
        let text = format!("{header}\n{}", (0..ROWS).map(row).collect::<String>());
        let read = all(&text, &ReadOptions::default()).unwrap_or_else(|e| panic!("{header}: {e}"));
        assert_eq!(
            (names(&read), read.series[0].samples.len()),
            (vec!["a"], ROWS),
            "{header}"
        );
    }
    let frames = |i: usize| format!("{i},{:.2},{:.6}\n", 0.01 * i as f64, value(i));
    let text = format!(
        "Frame,Time,X\n{}",
        (0..ROWS).map(frames).collect::<String>()
    );
    assert_eq!(names(&all(&text, &in_g()).unwrap()), ["X"]);
    for (header, word) in [
        ("time,force", "\"force\" is none"),
        ("Time (s),Acc (V)", "in V, which is no unit of acceleration"),
        ("T (s),Sa (g)", "a spectrum"),
        ("T (s),PSA (g)", "a spectrum"),
        ("Time (s),Spectral acceleration (g)", "a spectrum"),
        ("Period (s),Acc (g)", "a spectrum"),
    ] {
        refused(
            &format!("{header}\n{}", timed(1, ",")),
            &in_g(),
            &["f:1:1: ", word],
        );
    }
    let own = "damping_ratio,period_s,sd_m,psv_m_s,psa_m_s2,sa_m_s2";
    refused(
        &format!("{own}\n{}", timed(5, ",")),
        &in_g(),
        &["a spectrum"],
    );
}

/// Four or more named columns without times were one series.
#[test]
fn named_columns_without_times_are_not_one_series() {
    let step = ReadOptions {
        time_step: Some(0.01),
        ..in_g()
    };
    for (header, separator, layout) in [
        ("NS,EW,UD,SUM", ",", "NS,EW,UD,SUM"),
        ("ch1 ch2 ch3 ch4", " ", "ch1,ch2,ch3,ch4"),
        ("Roof,Base,Mid,Free field", ",", "Roof,Base,Mid,Free_field"),
        (
            "Sensor 1,Sensor 2,Sensor 3,Sensor 4",
            ",",
            "Sensor_1,Sensor_2,Sensor_3,Sensor_4",
        ),
    ] {
        let text = format!("{header}\n{}", along(4, ROWS, separator));
        let remedy = format!("`layout = \"{layout}\"`");
        refused(&text, &step, &["rows of 4 values", &remedy]);
        let options = ReadOptions {
            layout: Some(layout.to_owned()),
            ..step.clone()
        };
        let read = all(&text, &options).unwrap();
        assert_eq!(names(&read).join(","), layout);
    }
}

#[test]
fn units_in_a_line_of_their_own() {
    for (header, separator, unit) in [
        ("Time,Acc\ns,m/s2", ",", 1.0),
        ("Time\tAcc\n[sec]\t[cm/s^2]", "\t", 0.01),
        ("Time (s),Acc (g)\n--------,-----", ",", G),
        ("Time (s) | Acc (m/s2)", " | ", 1.0),
        ("El Centro\nm/s2", " ", 1.0),
        ("Time  Acceleration\n(sec)  (g)", " ", G),
        ("s g", " ", G),
        ("Acceleration (cm/s2)", " ", 0.01),
        ("time (seg),acc (cm/seg2)", ",", 0.01),
        ("time (s),acc (cm/seg/seg)", ",", 0.01),
        ("Zaman (s),acc (g's)", ",", G),
        ("time (s),acc (%g)", ",", 0.01 * G),
        ("time (s),acc (g/1000)", ",", 0.001 * G),
        ("time_s,acceleration_mm_s2", ",", 0.001),
        ("time_s,acceleration_ft_s2", ",", 0.3048),
        ("# Units: %g", " ", 0.01 * G),
    ] {
        let text = format!("{header}\n{}", timed(1, separator));
        let read = all(&text, &ReadOptions::default()).unwrap_or_else(|e| panic!("{header}: {e}"));
        let series = &read.series[0];
        assert_eq!(series.samples.len(), ROWS, "{header}");
        assert!(
            (series.samples[3] / (unit * value(3)) - 1.0).abs() < 1e-4,
            "{header}"
        );
    }
    let both = format!("time_s,acceleration_g,velocity_m_s\n{}", timed(2, ","));
    assert_eq!(names(&all(&both, &ReadOptions::default()).unwrap()), ["a"]);
    for (line, word) in [
        ("Units: counts", "\"counts\""),
        ("Units: V", "\"v\""),
        ("Units: 1000 g", "\"1000 g\""),
        ("El Centro velocity", "is a velocity"),
        ("Ground velocity", "is a velocity"),
        ("Corrected velocity", "is a velocity"),
        ("Type: velocity", "is a velocity"),
        ("Data: displacement", "is a displacement"),
        ("Velocity\ntime,acc", "is a velocity"),
    ] {
        let text = format!("{line}\n{}", timed(1, ","));
        refused(&text, &in_g(), &["f:1:1: ", word]);
    }
}

/// What lines state under a key is used, and held against options and rows.
#[test]
fn stated_units_steps_and_counts() {
    for head in [
        "# unit: g\n# dt: 0.01 s\n# Samples: 40",
        "Units: g\nSampling rate: 100 Hz",
        "Unit: g\nN = 40, dt = 10 ms",
        "UNITS = g\nSampling interval (s): 0.01",
        "Units: g\nfs = 100",
    ] {
        for values in [1, 8] {
            let text = format!("{head}\n{}", along(values, 40 / values, " "));
            let read =
                all(&text, &ReadOptions::default()).unwrap_or_else(|e| panic!("{head}: {e}"));
            let series = &read.series[0];
            assert_eq!(
                series.sampling,
                Sampling::Even { time_step: 0.01 },
                "{head}"
            );
            assert_eq!((series.samples.len(), series.unit), (40, "g"), "{head}");
        }
    }
    let step = ReadOptions {
        time_step: Some(0.02),
        ..in_g()
    };
    for head in [
        "# dt: 0.01 s",
        "dt = 0.01",
        "DT: 0.01 SEC",
        "Time step: 0.01 s",
        "Sampling interval: 0.01 s",
        "fs = 100 Hz",
        "Sampling Rate (Hz): 100",
    ] {
        let text = format!("{head}\n{}", along(1, 40, " "));
        refused(
            &text,
            &step,
            &["time_step is 0.01 s (line 1) in the file but 0.02 s was given"],
        );
        let same = ReadOptions {
            time_step: Some(0.01),
            ..in_g()
        };
        assert!(all(&text, &same).is_ok(), "{head}");
    }
    for head in [
        "# Samples: 400",
        "NPTS: 400",
        "Number of points: 400",
        "Number of points: 9",
    ] {
        let text = format!("{head}\n{}", along(1, 40, " "));
        let word = head.split(": ").nth(1).unwrap().to_owned() + " samples";
        refused(&text, &step, &[&word]);
    }
}

/// Numbers of a header above the values.
#[test]
fn rows_of_a_header_above_the_values() {
    let step = ReadOptions {
        time_step: Some(0.01),
        ..in_g()
    };
    let eight = along(8, 5, " ");
    for (head, options) in [
        ("0.01 40", in_g()),
        ("40 0.01", in_g()),
        ("40", step.clone()),
    ] {
        for layout in [None, Some("a".to_owned())] {
            let options = ReadOptions {
                layout,
                ..options.clone()
            };
            let read = all(&format!("{head}\n{eight}"), &options).unwrap();
            assert_eq!(read.series[0].samples.len(), 40, "{head}");
        }
    }
    for head in [
        "40 0.01 0.0",
        "1 40 0.01",
        "40 100",
        "1940 5 18",
        "0.01",
        "0.5",
    ] {
        for layout in [None, Some("a".to_owned())] {
            let options = ReadOptions {
                layout,
                ..step.clone()
            };
            refused(
                &format!("{head}\n{eight}"),
                &options,
                &["f:1:1: ", "--skip-lines 1"],
            );
        }
        let options = ReadOptions {
            skip_lines: 1,
            ..step.clone()
        };
        let read = all(&format!("{head}\n{eight}"), &options).unwrap();
        assert_eq!(read.series[0].samples.len(), 40, "{head}");
    }
    // Above pairs of time and value.
    for head in ["40 0.01", "40", "0.01 40"] {
        for layout in [None, Some("t,a".to_owned())] {
            let options = ReadOptions { layout, ..in_g() };
            let read = all(&format!("{head}\n{}", timed(1, " ")), &options).unwrap();
            assert_eq!(read.series[0].samples.len(), 40, "{head}");
        }
    }
    refused(
        &format!("40 0.02\n{}", timed(1, " ")),
        &in_g(),
        &["f:1:1: ", "0.02 s"],
    );
    let fixed = ReadOptions {
        layout: Some("8F10.6".to_owned()),
        ..step
    };
    let columns = |line: &str| -> String {
        line.split(' ')
            .map(|v| format!("{v:>10}"))
            .collect::<String>()
            + "\n"
    };
    let eight: String = eight.lines().map(columns).collect();
    for head in ["4000 0.005", "40"] {
        refused(
            &format!("{head}\n{eight}"),
            &fixed,
            &["f:1:1: ", "--skip-lines 1"],
        );
    }
}

#[test]
fn damaged_rows_are_named() {
    let step = ReadOptions {
        time_step: Some(0.01),
        ..in_g()
    };
    let rows = along(8, 20, " ");
    let mut lines: Vec<&str> = rows.lines().collect();
    let short = lines[9].rsplit_once(' ').unwrap().0;
    lines[9] = short;
    for layout in [None, Some("a".to_owned())] {
        let options = ReadOptions {
            layout,
            ..step.clone()
        };
        refused(
            &lines.join("\n"),
            &options,
            &["f:10:1: ", "7, where all others have 8", "correct the row"],
        );
    }
    // A last row may be short.
    let options = ReadOptions {
        layout: Some("a".to_owned()),
        ..step.clone()
    };
    assert!(all(&format!("{rows}0.1 0.2\n"), &options).is_ok());
    // A blank line among values one a row.
    let text = along(1, 20, " ") + "\n" + &along(1, 20, " ");
    refused(&text, &step, &["f:21:1: a blank line"]);
    assert!(all(&(along(1, 20, " ") + "\n\n"), &step).is_ok());
    assert!(all(&along(1, 20, " ").replace('\n', "\n\n"), &step).is_ok());
    // An exponent that is lost.
    let exponents = |lost: usize| -> String {
        let row = |i: usize| match i == lost {
            true => "2.705619\n".to_owned(),
            false => format!("{:.6e}\n", value(i)),
        };
        (0..ROWS).map(row).collect()
    };
    refused(
        &exponents(25),
        &step,
        &["f:26:1: \"2.705619\" has no exponent"],
    );
    assert!(all(&exponents(ROWS), &step).is_ok());
    let own = exponents(25);
    let own: String = own
        .lines()
        .enumerate()
        .map(|(i, v)| format!("{:.2},{v}\n", 0.01 * i as f64))
        .collect();
    for header in ["time_s,acceleration_g", "time (s),acc (g)"] {
        refused(
            &format!("{header}\n{own}"),
            &ReadOptions::default(),
            &["f:27:", "has no exponent"],
        );
    }
}

/// Times without a header of which one is wrong, or which have too few digits.
#[test]
fn damaged_times_are_named() {
    let rows = timed(1, " ");
    let lines: Vec<&str> = rows.lines().collect();
    let mut swapped = lines.clone();
    swapped.swap(19, 20);
    let wrong = lines[25].replacen("0.25", "30.00", 1);
    let mut moved = lines.clone();
    moved[25] = &wrong;
    let coarse: String = (0..ROWS)
        .map(|i| format!("{:.2} {:.6}\n", 0.005 * i as f64, value(i)))
        .collect();
    for (text, line) in [
        (swapped.join("\n"), 21),
        (moved.join("\n"), 27),
        (rows.clone() + &rows, 41),
        (coarse, 2),
    ] {
        let place = format!("f:{line}:1: the values of column 1 increase as times do");
        let at = match all(&text, &in_g()) {
            Err(error) => error.to_string(),
            Ok(_) => panic!("{text}"),
        };
        assert!(
            at.starts_with(&place) || line == 2 && at.contains("column 1 increase"),
            "{at}"
        );
        let step = Some(0.01);
        let named = ReadOptions {
            layout: Some("ns,ew".to_owned()),
            time_step: step,
            ..in_g()
        };
        refused(&text, &named, &["increase as times do"]);
    }
    // No layout was given.
    let cut = rows + "8.00\n";
    refused(
        &cut,
        &in_g(),
        &["f:41:1: 1 columns where the other rows have 2"],
    );
}

/// Cells that are quoted, blank at the end of a shorter component, or pairs beside one another.
#[test]
fn cells_of_tables() {
    let quoted: String = (0..ROWS)
        .map(|i| format!("\"{:.2}\",\"{:.6}\"\n", 0.01 * i as f64, value(i)))
        .collect();
    for (text, options) in [
        (quoted.clone(), in_g()),
        (
            format!("\"Time (s)\",\"Acc (g)\"\n{quoted}"),
            ReadOptions::default(),
        ),
        (
            format!(
                "\"Time (s)\";\"Acc (g)\"\n{}",
                quoted.replace("\",", "\";").replace('.', ",")
            ),
            ReadOptions::default(),
        ),
    ] {
        let read = all(&text, &options).unwrap_or_else(|e| panic!("{text}: {e}"));
        assert_eq!((read.series.len(), read.series[0].samples.len()), (1, ROWS));
        assert!((read.series[0].samples[3] - G * value(3)).abs() < 1e-5);
    }
    for (separator, blank) in [
        (",", ""),
        (",", "NaN"),
        (";", ""),
        ("\t", ""),
        ("\t", "nan"),
        (" ", "NaN"),
    ] {
        let row = |i: usize| {
            let second = if i < 30 {
                format!("{:.6}", value(i + 9))
            } else {
                blank.to_owned()
            };
            format!(
                "{:.2}{separator}{:.6}{separator}{second}\n",
                0.01 * i as f64,
                value(i)
            )
        };
        let header = format!("time (s){separator}NS (g){separator}EW (g)\n");
        let header = if separator == " " {
            "time_s ns_g ew_g\n".to_owned()
        } else {
            header
        };
        let rows: Vec<String> = (0..ROWS).map(row).collect();
        let read = all(&(header.clone() + &rows.concat()), &ReadOptions::default())
            .unwrap_or_else(|e| panic!("{header}: {e}"));
        let counts: Vec<_> = read.series.iter().map(|s| s.samples.len()).collect();
        assert_eq!(counts, [ROWS, 30], "{header}");
        assert!(
            read.series[1]
                .origin
                .warnings
                .iter()
                .any(|w| w.contains("after 30 of 40 values"))
        );
        // A blank inside is an error.
        let inside = rows[..10].concat() + &rows[35] + &rows[10..30].concat();
        let inside = inside.replace(&rows[35], &rows[35].replacen("0.35", "0.095", 1));
        assert!(all(&(header + &inside), &ReadOptions::default()).is_err());
    }
    let pairs = |apart: f64| -> String {
        let row = |i: usize| {
            let time = 0.01 * i as f64;
            format!(
                "{time:.2},{:.6},{:.2},{:.6}\n",
                value(i),
                time * apart,
                value(i + 9)
            )
        };
        (0..ROWS).map(row).collect()
    };
    for (header, options, expected) in [
        ("", in_g(), ["column_2", "column_4"]),
        (
            "Time (s),NS (g),Time (s),EW (g)\n",
            ReadOptions::default(),
            ["NS", "EW"],
        ),
    ] {
        let read = all(&format!("{header}{}", pairs(1.0)), &options).unwrap();
        assert_eq!(names(&read), expected);
        assert!((read.series[1].samples[3] - G * value(12)).abs() < 1e-5);
        assert!(all(&format!("{header}{}", pairs(2.0)), &options).is_err());
    }
}

/// Times of 0.0025 s with three decimals that start at one step.
#[test]
fn coarse_times_from_one_step() {
    let text: String = (1..=400)
        .map(|i| {
            format!(
                "{:.3} {:.6}\n",
                0.0025 * f64::from(i) + 1e-9,
                value(i as usize)
            )
        })
        .collect();
    let read = all(&text, &in_g()).unwrap();
    assert_eq!(
        read.series[0].sampling,
        Sampling::Even { time_step: 0.0025 }
    );
}

/// A layout names columns; what the header says that they hold, stands.
#[test]
fn a_layout_against_its_header() {
    let rows = timed(2, ",");
    let with = |header: &str, layout: &str, component: Option<&str>| {
        let options = ReadOptions {
            layout: Some(layout.to_owned()),
            component: component.map(str::to_owned),
            ..in_g()
        };
        read_bytes("f", format!("{header}\n{rows}").as_bytes(), &options)
    };
    let pair = "time (s),NS (g),EW (g)";
    let own = with(pair, "t,ns,ew", Some("EW")).unwrap();
    assert!((own.samples()[0] - G * value(1)).abs() < 1e-5);
    // Names of one's own are no contradiction.
    assert!(with(pair, "t,first,second", Some("second")).is_ok());
    for (header, layout, component, word) in [
        (pair, "t,ew,ns", Some("NS"), "the name of column 3"),
        (
            "time (s),acc (g),vel (cm/s)",
            "t,-,a",
            None,
            "is a velocity",
        ),
        (
            "time (s),acc (g),Force (kN)",
            "t,-,a",
            None,
            "is no acceleration",
        ),
        ("time,acc,vel", "t,acc,vel", Some("vel"), "is a velocity"),
    ] {
        let said = with(header, layout, component).unwrap_err().to_string();
        assert!(said.contains(word), "{header} {layout}: {said}");
    }
    assert!(with("time (s),acc (g),vel (cm/s)", "t,a,-", None).is_ok());
}

/// Ordinates of spectra by a mean, a damping or a component in any order; a name of a floor is none.
#[test]
fn ordinates_of_means_and_dampings() {
    let rows: String = (0..ROWS)
        .map(|i| format!("{:.2},{:.4}\n", 0.01 * i as f64, value(i)))
        .collect();
    let read = |name: &str| read_bytes("f", format!("t,{name}\n{rows}").as_bytes(), &in_g());
    for name in [
        "Sa_avg_g",
        "Sa_geomean_g",
        "Sa_median",
        "Sa_g_X",
        "Sa_g_5pct",
        "PSA_RotD50_g",
        "PSA_5pct_X_g",
        "PSA_X_5pct_m_s2",
        "Sa_5_pct_g",
        "PSA_xi5_g",
        "Sa_damp5_g",
        "SaX_g",
        "SaNS",
    ] {
        let said = read(name).unwrap_err().to_string();
        assert!(said.contains("that of a spectrum"), "{name}: {said}");
    }
    for name in ["sa_roof_g", "sa1", "SAX", "acc_x_g", "a_X_g"] {
        read(name).unwrap_or_else(|e| panic!("{name}: {e}"));
    }
}
