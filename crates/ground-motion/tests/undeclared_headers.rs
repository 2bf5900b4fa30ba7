//! Headers that are no header of a record, or that the program does not use: what they say of units
//! and quantities holds all the same. Counts that are one too small, and times in single precision.
use pounding_ground_motion::{
    AccelerationUnit, GroundMotionError, Processing, ReadOptions, Sampling, read_all_bytes,
    read_bytes,
};

const G: f64 = 9.80665;

fn options(unit: AccelerationUnit, time_step: Option<f64>) -> ReadOptions {
    ReadOptions {
        unit: Some(unit),
        time_step,
        ..ReadOptions::default()
    }
}

fn in_g(time_step: Option<f64>) -> ReadOptions {
    options(AccelerationUnit::StandardGravity, time_step)
}

fn value(i: usize) -> f64 {
    0.1 * (1.7 * i as f64 + 1.0).sin()
}

/// A header above pairs that go on by 0.02.
fn pairs(header: &str, separator: &str) -> String {
    let row = |i: usize| format!("{:.2}{separator}{:.5}\n", 0.02 * (i + 1) as f64, value(i));
    format!("{header}\n{}", (0..40).map(row).collect::<String>())
}

fn told(text: &str, options: &ReadOptions) -> String {
    let error = read_bytes("f", text.as_bytes(), options).unwrap_err();
    format!("{error}; {}", error.help().unwrap_or_default())
}

#[test]
fn spectra_are_no_records_whatever_unit_is_given() {
    for (names, separators) in [
        (["Period [sec]", "Acc./Elastic"], &["\t", ",", ";"][..]),
        (["f (Hz)", "A (g)"], &["\t", ",", ";", "  "]),
        (["Frequency [Hz]", "Amp./g"], &["\t", ",", "  "]),
        (["T", "Se"], &["\t", ",", ";"]),
        (["Per. (s)", "Acc. (g)"], &["\t", ",", "  "]),
        (["Tn (s)", "Acceleration (g)"], &["\t", ",", "  "]),
        (["T (s)", "Acceleration response (g)"], &["\t", ",", ";"]),
    ] {
        for separator in separators {
            let text = pairs(&names.join(separator), separator);
            for options in [ReadOptions::default(), in_g(None), in_g(Some(0.01))] {
                let told = told(&text, &options);
                assert!(told.contains("spectrum"), "{names:?} {separator:?}: {told}");
            }
        }
    }
    for line in [
        "ACCELERATION RESPONSE SPECTRUM IN UNITS OF G",
        "PSEUDO-ACCELERATION IN UNITS OF G",
    ] {
        let text = format!("PEER\nQUAKE, STATION, 90\n{line}\nNPTS= 4, DT= .01 SEC\n.1 .2 .3 .2\n");
        assert!(told(&text, &ReadOptions::default()).contains("spectrum"));
    }
}

#[test]
fn units_of_headers_that_are_not_used() {
    let text = pairs("Time (s)\tAcc. (cm/s2) filtered", "\t");
    assert!(told(&text, &in_g(None)).contains("unit is cm/s2 (line 1)"));
    let gal = options(AccelerationUnit::Gal, None);
    let record = read_bytes("f", text.as_bytes(), &gal).unwrap();
    assert!((record.samples()[0] - 0.01 * value(0)).abs() < 1e-6);
    for (name, unit) in [
        ("acc_cms2", 0.01),
        ("accel_ms2", 1.0),
        ("accel_mps2", 1.0),
        ("a(ms-2)", 1.0),
    ] {
        let text = pairs(&format!("time\t{name}"), "\t");
        let record = read_bytes("f", text.as_bytes(), &ReadOptions::default()).unwrap();
        assert!(
            (record.samples()[0] - unit * value(0)).abs() < 1e-5,
            "{name}"
        );
        assert!(told(&text, &in_g(None)).contains("but g was given"));
    }
}

#[test]
fn columns_of_something_else_are_no_times() {
    for name in [
        "Temp (C)",
        "Force (kN)",
        "Voltage (V)",
        "Strain (%)",
        "Angle (deg)",
        "Pressure (kPa)",
        "Drift (%)",
        "Magnitude",
        "Flag",
    ] {
        let text = pairs(&format!("{name};acc (g)"), ";");
        let error = read_bytes("f", text.as_bytes(), &ReadOptions::default()).unwrap_err();
        let step = matches!(error, GroundMotionError::MissingTimeStep { .. });
        assert!(step, "{name}: {error}");
        let given = ReadOptions {
            time_step: Some(0.01),
            ..ReadOptions::default()
        };
        let record = read_bytes("f", text.as_bytes(), &given).unwrap();
        assert_eq!((record.samples().len(), record.time_step()), (40, 0.01));
        let warnings = &record.origin().unwrap().warnings;
        let left_out = |w: &String| w.contains("not read as accelerations") && w.contains(name);
        assert!(warnings.iter().any(left_out), "{warnings:?}");
    }
    // Times in another language.
    let text = pairs("Tid (s);acc (g)", ";");
    let record = read_bytes("f", text.as_bytes(), &ReadOptions::default()).unwrap();
    assert_eq!(record.time_step(), 0.02);
}

#[test]
fn a_count_that_is_one_too_small() {
    let text = "5\n0.004\n0.10\n-0.20\n0.30\n0.10\n-0.10\n";
    let told = told(text, &in_g(Some(0.01)));
    for word in [
        "one too small",
        "do not give the time step",
        "skip_lines = 1",
    ] {
        assert!(told.contains(word), "{told}");
    }
    let record = read_bytes("f", text.as_bytes(), &in_g(None)).unwrap();
    assert_eq!((record.samples().len(), record.time_step()), (5, 0.004));
    let skipped = ReadOptions {
        skip_lines: 1,
        ..in_g(Some(0.01))
    };
    let record = read_bytes("f", text.as_bytes(), &skipped).unwrap();
    assert_eq!((record.samples().len(), record.time_step()), (6, 0.01));
    assert!((record.samples()[0] - 0.004 * G).abs() < 1e-12);
    // Steps have no sign.
    for first in ["+0.004", "-0.004", "0.000001"] {
        let text = text.replace("\n0.004", &format!("\n{first}"));
        let found = read_bytes("f", text.as_bytes(), &in_g(None));
        assert!(found.is_err(), "{first}");
    }
}

/// Times that were added up in single precision, as Fortran's `T = T + DT`: even, unless one is
/// missing.
#[test]
fn sums_in_single_precision() {
    let mut time = 0.0_f32;
    let mut rows = Vec::new();
    for i in 0..4000 {
        rows.push(format!("{time:14.7e} {:10.5}", value(i)));
        time += 0.01;
    }
    let read = |rows: &[String]| {
        let all = read_all_bytes("f", rows.join("\n").as_bytes(), &in_g(None)).unwrap();
        all.series[0].sampling.clone()
    };
    assert_eq!(read(&rows), Sampling::Even { time_step: 0.01 });
    rows.remove(2000);
    assert!(matches!(read(&rows), Sampling::Uneven { .. }));
}

#[test]
fn units_of_jma_that_are_none_of_acceleration() {
    let text = |unit: &str| {
        let rows: String = (0..20)
            .map(|i| format!("{0:.3},{0:.3},{0:.3}\n", value(i)))
            .collect();
        format!("SITE CODE= X\nSAMPLING RATE= 100Hz\nUNIT  = {unit}\nNS,EW,UD\n{rows}")
    };
    for unit in ["counts", "V", "deg"] {
        for options in [ReadOptions::default(), in_g(None)] {
            let found = read_all_bytes("f", text(unit).as_bytes(), &options);
            let error = found.unwrap_err().to_string();
            assert!(error.contains("no unit that is known"), "{unit}: {error}");
        }
    }
    let velocity = text("kine(cm/s)");
    assert!(told(&velocity, &in_g(None)).contains("velocity"));
    assert!(told(&velocity, &ReadOptions::default()).contains("velocity"));
    assert!(read_all_bytes("f", text("gal(cm/s/s)").as_bytes(), &ReadOptions::default()).is_ok());
}

/// Keys of our CSV mean the same where the file is read as plain columns, and what cannot be used
/// is said.
#[test]
fn keys_of_our_csv_above_plain_columns() {
    let rows = |separator: &str| -> String {
        let row = |i: usize| format!("{:.2}{separator}{:.5}\n", 0.02 * i as f64, value(i));
        (0..40).map(row).collect()
    };
    let all = |text: &str| read_all_bytes("f", text.as_bytes(), &ReadOptions::default()).unwrap();
    for (head, separator, initial) in [
        (
            "# Initial velocity: 0.5 m/s\n# Stage: raw\ntime_s, acceleration_m/s2",
            ",",
            0.5,
        ),
        (
            "# Initial velocity: 0.5 m/s\n# Stage: raw\nTime_s,acceleration_m/s2",
            ",",
            0.5,
        ),
        (
            "# Initial velocity: 0.5 m/s;\n# Stage: raw;\ntime_s;acceleration_m/s2",
            ";",
            0.5,
        ),
        (
            "\"# Initial velocity: 0.5 m/s\"\n\"# Stage: raw\"\ntime_s, acceleration_m/s2",
            ",",
            0.5,
        ),
        ("# Stage: raw,\ntime_s,acceleration_m/s2", ",", 0.0),
        ("# Stage: raw\n# Unit: m/s2\n# Samples: 40", ",", 0.0),
    ] {
        let found = all(&format!("{head}\n{}", rows(separator)));
        let one = &found.series[0];
        assert_eq!(one.samples.len(), 40, "{head}");
        assert_eq!(one.initial.map_or(0.0, |(v, _)| v), initial, "{head}");
        assert_eq!(one.origin.processing, Processing::Raw, "{head}");
    }
    for (key, words) in [
        ("Samples: x", "number of samples"),
        ("Azimuth: x", "azimuth"),
        ("Azimuth: 1200 degrees", "azimuth"),
        ("Dip: 900 degrees", "dip"),
        ("Start: yesterday", "time \"yesterday\""),
        ("Stage: cooked", "cooked"),
    ] {
        for header in ["time_s,acceleration_g", "time_s, acceleration_g"] {
            let text = format!("# {key}\n{header}\n{}", rows(","));
            if key.starts_with("Stage") && !header.contains(' ') {
                assert!(read_all_bytes("f", text.as_bytes(), &ReadOptions::default()).is_err());
                continue;
            }
            let warnings = &all(&text).series[0].origin.warnings;
            let said = |w: &String| w.contains(words) && w.contains("not used");
            assert!(warnings.iter().any(said), "{key}: {warnings:?}");
        }
    }
}
