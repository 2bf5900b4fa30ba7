//! What the header of an AT2 file says: its component, and all that it says twice.
use pounding_ground_motion::processing::rotate;
use pounding_ground_motion::writers::{Written, write_peer_at2};
use pounding_ground_motion::{
    AccelerationUnit, Accelerogram, GroundMotionError, Processing, Quantity, ReadOptions,
    read_bytes,
};

/// A file with this second line.
fn at2(second: &str) -> String {
    format!(
        "PEER STRONG MOTION DATABASE RECORD\n{second}\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS= 3, DT= .01 SEC\n 0.0 0.1 -0.2\n"
    )
}

fn read(text: &str, component: Option<&str>) -> Result<Accelerogram, GroundMotionError> {
    let options = ReadOptions {
        component: component.map(str::to_owned),
        ..ReadOptions::default()
    };
    read_bytes("f", text.as_bytes(), &options)
}

fn component_of(record: &Accelerogram) -> &str {
    &record.origin().unwrap().component
}

#[test]
fn components_behind_the_last_comma() {
    for (second, name, wanted) in [
        ("IMPERIAL VALLEY 5/19/40, EL CENTRO, 180", "180", "S"),
        (
            "QUAKE 10/18/89, STATION, 090 (USGS STATION 1652)",
            "090",
            "90",
        ),
        ("QUAKE, STATION, 360", "360", "N-S"),
        ("QUAKE, STATION, S16W", "S16W", "196"),
        ("QUAKE, STATION, N-S", "N-S", "0"),
        ("QUAKE, STATION, VERT", "VERT", "V"),
        ("QUAKE, STATION, DWN", "DWN", "down"),
        ("QUAKE, STATION, UP", "UP", "Z"),
        ("QUAKE, STATION,HNE", "HNE", "hne"),
        ("TABAS, IRAN 9/16/78, TABAS, LN", "LN", "ln"),
    ] {
        let text = at2(second);
        for wanted in [None, Some(name), Some(wanted), Some("1")] {
            let record = read(&text, wanted).unwrap_or_else(|e| panic!("{second}: {e}"));
            assert_eq!(component_of(&record), name, "{second}, {wanted:?}");
        }
        let error = read(&text, Some("45")).unwrap_err();
        assert!(
            matches!(error, GroundMotionError::NoSuchSeries { .. })
                && error.to_string().contains(name),
            "{error}"
        );
    }
    for second in [
        "QUAKE, STATION",
        "EL CENTRO",
        "QUAKE, STATION 1952",
        "QUAKE, STATION, 1952",
        "QUAKE, STATION,",
    ] {
        let record = read(&at2(second), None).unwrap();
        assert_eq!(component_of(&record), "", "{second}");
        assert!(read(&at2(second), Some("360")).is_err(), "{second}");
    }
    // Commas of the line of the count part no component.
    let short = "A\nNPTS= 3, DT= .01 SEC, 0\n 0.0 0.1 -0.2\n";
    let options = ReadOptions {
        unit: Some(AccelerationUnit::Gal),
        ..ReadOptions::default()
    };
    let record = read_bytes("f", short.as_bytes(), &options).unwrap();
    assert_eq!(component_of(&record), "");
}

#[test]
fn components_of_at2_that_are_not_at_right_angles_are_refused() {
    let of = |name: &str| read(&at2(&format!("QUAKE, STATION, {name}")), None).unwrap();
    for (a, b, words) in [
        ("180", "UP", "\"UP\" (vertical)"),
        ("180", "DWN", "\"DWN\" (vertical)"),
        ("180", "230", "azimuth 230"),
        ("N30E", "N60E", "azimuth 60"),
    ] {
        let error = rotate(&of(a), &of(b), 30.0).unwrap_err().to_string();
        assert!(error.contains(words), "{a} {b}: {error}");
    }
    rotate(&of("180"), &of("270"), 30.0).unwrap();
}

/// What the writer calls a component is found again by its name.
#[test]
fn components_that_are_written_are_found() {
    for name in [
        "NS (north-south)",
        "10.HNE",
        "L 50 deg",
        "H1",
        "Other",
        "N10E",
        "",
    ] {
        let written = Written {
            quantity: Quantity::Acceleration,
            samples: vec![0.0, 1.0, -2.0],
            time_step: 0.01,
            title: "Quake, Station, 2011".to_owned(),
            component: name.to_owned(),
            initial: None,
            first_time: None,
            start_time: String::new(),
            orientation: None,
            processing: Processing::Unstated,
            remarks: Vec::new(),
        };
        let text = write_peer_at2(&written);
        let wanted = Some(name).filter(|name| !name.is_empty());
        assert_eq!(component_of(&read(&text, wanted).unwrap()), name);
    }
}

/// A file with these lines behind its title.
fn with_header(lines: &str) -> String {
    format!("PEER STRONG MOTION DATABASE RECORD\nQUAKE, STATION, 180\n{lines}\n 0.0 0.1 -0.2\n")
}

#[test]
fn what_follows_the_unit() {
    let counts = "NPTS= 3, DT= .01 SEC";
    let read = |words: &str| {
        let text = with_header(&format!(
            "ACCELERATION TIME SERIES IN UNITS OF {words}\n{counts}"
        ));
        read(&text, None)
    };
    for (words, unit) in [
        ("G", 9.80665),
        ("G.", 9.80665),
        ("(G)", 9.80665),
        ("G/10", 0.980665),
        ("G / 10", 0.980665),
        ("G. FILTER POINTS: HP=0.2 Hz LP=20.0 Hz", 9.80665),
        ("G  PGA= 0.2 HP=0.2 Hz", 9.80665),
        ("G (8F10.5)", 9.80665),
        ("G, 3 POINTS", 9.80665),
        ("G, BASELINE CORRECTED", 9.80665),
        ("G / 1000", 9.80665e-3),
        ("MILLI-G", 9.80665e-3),
        ("0.001 G", 9.80665e-3),
        ("X 0.001 G", 9.80665e-3),
        ("1/1000 G", 9.80665e-3),
        ("10^-3 G, 3 POINTS", 9.80665e-3),
        ("10**-3 G", 9.80665e-3),
        ("1E-03 G, BASELINE CORRECTED", 9.80665e-3),
        ("0.1 G", 0.980665),
        ("1 G", 9.80665),
        ("9.81 M/S2", 9.80665),
        ("0.01 M/S2", 0.01),
        ("CM/S/S (GAL)", 0.01),
        ("CM / SEC / SEC", 0.01),
        ("CM/SEC**2", 0.01),
    ] {
        let record = read(words).unwrap_or_else(|e| panic!("{words}: {e}"));
        let peak = record.peak().value;
        assert!((peak / (0.2 * unit) - 1.0).abs() < 1e-12, "{words}: {peak}");
    }
    for words in [
        "G * 1E-3",
        "G x 1000",
        "G X10",
        "G, 1000",
        "G, MULTIPLIED BY 1000",
        "G TIMES 10",
        "G (TIMES 10)",
        "G (CM/S2)",
        "CM/S/S X 10",
        "CM/SEC**2 OR G",
        "G GAL",
    ] {
        let error = read(words).unwrap_err();
        let shown = format!("{error}; {}", error.help().unwrap());
        assert!(
            shown.starts_with("f:3:1: ") && shown.contains("behind the unit"),
            "{words}: {shown}"
        );
    }
}

#[test]
fn counts_and_steps_that_stand_twice() {
    let unit = "ACCELERATION TIME SERIES IN UNITS OF G";
    let counts = "NPTS= 3, DT= .01 SEC";
    let read = |lines: &str, options: &ReadOptions| {
        read_bytes("f", with_header(lines).as_bytes(), options).map_err(|e| {
            let help = e.help().unwrap();
            format!("{e}; {help}")
        })
    };
    for lines in [
        format!("3 points at equal spacing of 0.01 sec\n{unit}\n{counts}"),
        format!("{unit}, NPTS= 3\n{counts}, DT= 10 MSEC"),
        format!("{unit}\nNPTS= 3; DT= .01 SEC"),
        format!("{unit}\nNPTS=3,DT=.01"),
    ] {
        let record = read(&lines, &ReadOptions::default()).unwrap();
        assert_eq!(
            (record.samples().len(), record.time_step()),
            (3, 0.01),
            "{lines}"
        );
    }
    let lenient = ReadOptions {
        lenient: true,
        ..ReadOptions::default()
    };
    for (lines, place, words) in [
        (
            format!("{unit}\n{counts}, DT= .02 SEC"),
            "f:4:1: ",
            "the time step is 0.01 s (100 samples/s) here, but 0.02 s",
        ),
        (
            format!("DT= .02 SEC\n{unit}\n{counts}"),
            "f:5:1: ",
            "in line 3",
        ),
        (
            format!("3 points at equal spacing of 0.02 sec\n{unit}\n{counts}"),
            "f:5:1: ",
            "but 0.02 s (50 samples/s) in line 3",
        ),
        (
            format!("{unit}\n{counts}, NPTS= 4"),
            "f:4:1: ",
            "the header says 3 samples here, but 4 in line 4",
        ),
        (
            format!("{unit}\n4 points at equal spacing of 0.01 sec\n{counts}"),
            "f:5:1: ",
            "but 4 in line 4",
        ),
    ] {
        let error = read(&lines, &ReadOptions::default()).unwrap_err();
        assert!(
            error.starts_with(place) && error.contains(words) && error.contains("lenient"),
            "{lines}: {error}"
        );
        let record = read(&lines, &lenient).unwrap();
        assert_eq!(
            (record.samples().len(), record.time_step()),
            (3, 0.01),
            "{lines}"
        );
        assert!(!record.origin().unwrap().warnings.is_empty());
    }
    let given = ReadOptions {
        time_step: Some(0.02),
        ..ReadOptions::default()
    };
    let record = read(&format!("{unit}\n{counts}, DT= .02 SEC"), &given).unwrap();
    assert_eq!(record.time_step(), 0.02);
    let error = read(&format!("{unit}\nNPTS= 1,021, DT= .01"), &lenient).unwrap_err();
    assert!(error.contains("\"1,021\" has a comma"), "{error}");
}

#[test]
fn decimal_commas() {
    let unit = "ACCELERATION TIME SERIES IN UNITS OF G";
    let text = with_header(&format!("{unit}\nNPTS= 3, DT= .01 SEC\n 0,01 0,02 -0,03"));
    let text = text.replace("\n 0.0 0.1 -0.2", "");
    let error = read(&text, None).unwrap_err().to_string();
    assert!(
        error.starts_with("f:5:1: ") && error.contains("within the numbers"),
        "{error}"
    );
}

/// A unit beside the name of the quantity, without the word "units", is that of the values.
#[test]
fn units_beside_the_quantity() {
    let read = |line: &str, unit: Option<AccelerationUnit>| {
        let text =
            at2("QUAKE, STATION, 90").replace("ACCELERATION TIME SERIES IN UNITS OF G", line);
        let options = ReadOptions {
            unit,
            ..ReadOptions::default()
        };
        read_bytes("f", text.as_bytes(), &options)
    };
    for line in [
        "ACCELERATION IN GAL",
        "ACCELERATION (GAL)",
        "ACCELERATION, CM/S2",
        "ACCEL. IN UNITS CM/S2",
        "CORRECTED ACCELERATION (cm/s**2) DT=0.01 SEC",
        "ACCELERATION (CM / SEC / SEC)",
    ] {
        for unit in [None, Some(AccelerationUnit::Gal)] {
            let record = read(line, unit).unwrap_or_else(|e| panic!("{line}: {e}"));
            assert!((record.samples()[2] + 0.002).abs() < 1e-12, "{line}");
        }
        let error = read(line, Some(AccelerationUnit::StandardGravity)).unwrap_err();
        let text = error.to_string();
        assert!(
            text.contains("unit is cm/s2 in the file but g was given"),
            "{line}: {text}"
        );
    }
    // Velocities and displacements, whatever unit is given.
    for line in [
        "VELOCITY (CM/S)",
        "DISPLACEMENT, CM",
        "NS VELOCITY IN CM/SEC",
    ] {
        let error = read(line, None).unwrap_err().to_string();
        assert!(error.contains("not an acceleration"), "{line}: {error}");
        let error = read(line, Some(AccelerationUnit::Gal))
            .unwrap_err()
            .to_string();
        assert!(error.contains("the unit cm/s2 is given"), "{line}: {error}");
    }
    let error = read("VELOCITY (CM/S2)", None).unwrap_err().to_string();
    assert!(error.contains("the header says velocity here"), "{error}");
    let error = read("ACCELERATION (G) X 1000", None)
        .unwrap_err()
        .to_string();
    assert!(
        error.contains("behind the unit g is not understood"),
        "{error}"
    );
    // No unit of the values.
    for line in [
        "SHEAR WAVE VELOCITY (M/S)",
        "PEAK ACCELERATION (CM/S2)",
        "ACCELEROGRAM, G",
    ] {
        let error = read(line, None).unwrap_err();
        assert!(
            matches!(error, GroundMotionError::MissingUnit { .. }),
            "{line}: {error}"
        );
        assert!(
            read(line, Some(AccelerationUnit::StandardGravity)).is_ok(),
            "{line}"
        );
    }
}

/// Factors of units that are not known, wherever they stand, whatever unit is given.
#[test]
fn units_with_factors() {
    let counts = "NPTS= 3, DT= .01 SEC";
    let series = "ACCELERATION TIME SERIES IN UNITS OF";
    for (lines, place) in [
        (format!("{series} 1000 G\n{counts}"), "f:3:1: "),
        (format!("{series} G*0.001\n{counts}"), "f:3:1: "),
        (format!("{series} G\n{counts}\nUNITS: G*1000"), "f:5:1: "),
        (format!("{series} G\n{counts}\nUNITS: 0.001 G"), "f:5:1: "),
        (format!("{series} G\n{counts}, UNITS= 1/1000 G"), "f:4:1: "),
    ] {
        for unit in [None, Some(AccelerationUnit::StandardGravity)] {
            let options = ReadOptions {
                unit,
                ..ReadOptions::default()
            };
            let error = read_bytes("f", with_header(&lines).as_bytes(), &options).unwrap_err();
            let text = error.to_string();
            assert!(text.starts_with(place), "{lines}: {text}");
        }
    }
    // The strength of a motion is no unit.
    let level = format!("ACCELERATION TIME SERIES (0.1 G)\n{counts}");
    let error = read(&with_header(&level), None).unwrap_err();
    assert!(
        matches!(error, GroundMotionError::MissingUnit { .. }),
        "{error}"
    );
    let milli = format!("ACCELERATION TIME SERIES (0.001 G)\n{counts}");
    let record = read(&with_header(&milli), None).unwrap();
    assert!((record.peak().value - 0.2e-3 * 9.80665).abs() < 1e-12);
}

/// Factors and decimations are told wherever they stand, but in titles that this program wrote.
#[test]
fn factors_and_decimations_in_words() {
    let unit = "ACCELERATION TIME SERIES IN UNITS OF G";
    let counts = "NPTS= 3, DT= .01 SEC";
    let warnings = |text: &str, options: &ReadOptions| {
        let record = read_bytes("f", text.as_bytes(), options);
        let record = record.unwrap_or_else(|e| panic!("{text}: {e}"));
        let mut warnings = record.origin().unwrap().warnings.clone();
        warnings.retain(|w| w.starts_with("line "));
        warnings
    };
    let given = ReadOptions {
        time_step: Some(0.01),
        ..ReadOptions::default()
    };
    for (words, factor) in [
        ("VALUES MULTIPLIED BY 1000", "1000"),
        ("ACCELERATIONS ARE MULTIPLIED BY 1000.", "1000"),
        ("SCALE FACTOR 0.5", "0.5"),
        ("SCALE FACTOR= 0.5", "0.5"),
        ("SCALED BY A FACTOR OF 2.0", "2"),
        ("SCALED BY 50 %", "0.5"),
        ("VALUES DIVIDED BY 1000", "0.001"),
        ("VALUES X 1000", "1000"),
    ] {
        let told = format!("a factor of {factor} is stated");
        for (lines, line) in [
            (format!("{words}\n{unit}\n{counts}"), 3),
            (format!("{unit}\n{counts}, {words}"), 4),
        ] {
            let found = warnings(&with_header(&lines), &ReadOptions::default());
            let told = format!("line {line}: {told}");
            assert!(
                found.iter().any(|w| w.starts_with(&told)),
                "{lines}: {found:?}"
            );
        }
        let title = at2(&format!("QUAKE, STATION {words}, 180"));
        let found = warnings(&title, &ReadOptions::default());
        assert!(
            found.iter().any(|w| w.contains(&told)),
            "{title}: {found:?}"
        );
        let own = title.replace(
            "PEER STRONG MOTION DATABASE RECORD",
            "MOTION WRITTEN BY POUNDING IN THE LAYOUT OF PEER AT2",
        );
        let found = warnings(&own, &ReadOptions::default());
        assert!(found.is_empty(), "{own}: {found:?}");
    }
    for words in [
        "MULTIPLIED BY 1",
        "SCALED TO 0.3 G PGA",
        "DECIMATION FACTOR= 1",
        "DECIMATED TO 100 HZ",
        "ORIGINAL DT= .005 SEC",
        "ORIGINAL NPTS= 6",
    ] {
        let lines = format!("{words}\n{unit}\n{counts}");
        let found = warnings(&with_header(&lines), &ReadOptions::default());
        assert!(found.is_empty(), "{words}: {found:?}");
    }
    for words in [
        "DECIMATED BY 2",
        "RECORD DECIMATED BY A FACTOR OF 2",
        "DECIMATION FACTOR= 2",
    ] {
        for lines in [
            format!("{words}\n{unit}\n{counts}"),
            format!("{unit}\n{counts}, {words}"),
        ] {
            let found = warnings(&with_header(&lines), &ReadOptions::default());
            let told = |w: &String| w.contains("a decimation by 2 is stated");
            assert!(found.iter().any(told), "{lines}: {found:?}");
            assert!(warnings(&with_header(&lines), &given).is_empty(), "{lines}");
        }
    }
}
