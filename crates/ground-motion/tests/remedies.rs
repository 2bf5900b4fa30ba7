//! Messages about files that colleagues made of those of agencies say what is wrong with them, and what to
//! give instead.
use pounding_ground_motion::{AccelerationUnit, Format, ReadOptions, read_all_bytes, read_bytes};

use crate::common::fixtures;

fn refused(text: &[u8], options: &ReadOptions) -> String {
    let error = read_all_bytes("f", text, options).unwrap_err();
    format!("{error}; {}", error.help().unwrap_or_default())
}

fn lenient() -> ReadOptions {
    ReadOptions {
        lenient: true,
        ..ReadOptions::default()
    }
}

/// What is given already is no remedy, nor is what the format never reads.
#[test]
fn counts_of_iris_ascii() {
    let fixture = fixtures("iris_ascii", 0).remove(0);
    let text = String::from_utf8(fixture.bytes).unwrap();
    let counts = text.replacen("M/S**2", "Counts", 1);
    let with_response = ReadOptions {
        response: Some("station.xml".into()),
        ..ReadOptions::default()
    };
    for options in [ReadOptions::default(), with_response] {
        let said = refused(counts.as_bytes(), &options);
        assert!(
            said.contains("does not state how many make 1 m/s2")
                && said.contains("give `sensitivity` in counts per m/s2")
                && !said.contains("--response FILE"),
            "{said}"
        );
    }
}

/// Fields are parted at commas: within numbers they make two wrong values of each.
#[test]
fn decimal_commas() {
    let values: Vec<String> = (0..40)
        .map(|i| format!("{:.5}", 0.2 * f64::sin(0.7 * f64::from(i) + 0.1)))
        .collect();
    let dyna = "EVENT_NAME: quake\nSAMPLING_INTERVAL_S: 0.01\nNDATA: 40\nSTREAM: HNE\nUNITS: cm/s^2\nDATA_TYPE: ACCELERATION\n";
    let isesd = "file: 1.cor\nwaveform code: 1\norientation of transducer: NS\nsampling period: 0.01s\nnumber of samples: 40\nunits: m/s*s\n-> corrected acceleration time histories\n";
    let slist = "TIMESERIES XX_ABCD__HNE_D, 40 samples, 100 sps, 2020-01-01T00:00:00.0, SLIST, FLOAT, M/S**2\n";
    for (header, per_row) in [(dyna, 1), (isesd, 5), (slist, 1), (slist, 6)] {
        let rows: Vec<String> = values.chunks(per_row).map(|row| row.join("  ")).collect();
        let rows = rows.join("\n") + "\n";
        let plain = format!("{header}{rows}");
        let found = read_all_bytes("f", plain.as_bytes(), &ReadOptions::default()).unwrap();
        assert_eq!(found.series[0].samples.len(), 40);
        let text = header.to_owned() + &rows.replace('.', ",");
        let line = header.lines().count() + 1;
        for options in [ReadOptions::default(), lenient()] {
            let said = refused(text.as_bytes(), &options);
            assert!(
                said.starts_with(&format!("f:{line}:"))
                    && said.contains("they are within the numbers")
                    && said.contains("decimal points"),
                "{said}"
            );
        }
    }
}

#[test]
fn two_records_in_one_file() {
    let at2 = "PEER\nQUAKE, STATION, 90\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS= 5, DT= .01 SEC\n  .1 .2 .3 .2 .1\n";
    let of = |format: &'static str| fixtures(format, 0).remove(0).bytes;
    for bytes in [of("k_net"), of("dyna"), of("jma_csv"), at2.into()] {
        let text = bytes.trim_ascii_end();
        let line = text.split(|b| *b == b'\n').count() + 1;
        read_all_bytes("f", text, &ReadOptions::default()).unwrap();
        for ends in ["\n", "\r\n"] {
            let text = [text, text].join(ends.as_bytes());
            let said = refused(&text, &ReadOptions::default());
            assert!(
                said.starts_with(&format!("f:{line}:"))
                    && said.contains("a second record begins here")
                    && said.contains("a file of its own"),
                "{said}"
            );
        }
    }
}

#[test]
fn names_of_jma_that_are_single_letters() {
    for names in ["N,E,U", "X,Y,Z", "N-S,E-W,U-D", " N, E, U,,"] {
        let text = format!(
            "SITE CODE= 1\nSAMPLING RATE= 100Hz\nUNIT = gal(cm/s/s)\n{names}\n1.0,2.0,3.0\n4.0,5.0,6.0\n"
        );
        let found = read_all_bytes("f", text.as_bytes(), &ReadOptions::default()).unwrap();
        let components = found.series.iter().map(|s| &*s.component);
        let expected = names.trim_end_matches(',').split(',').map(str::trim);
        assert!(components.eq(expected), "{names}");
    }
}

/// What was done to the values says nothing of their unit; what may scale them does.
#[test]
fn remarks_behind_units_of_columns() {
    let read = |name: &str| {
        let text = format!("Time (s),{name}\n0.00,0.1\n0.01,-0.2\n0.02,0.3\n0.03,0.1\n");
        read_bytes("f", text.as_bytes(), &ReadOptions::default())
    };
    let in_g = AccelerationUnit::StandardGravity.in_si();
    for (name, unit) in [
        ("Acceleration [g] (baseline corrected)", in_g),
        ("Acceleration (g) (Baseline-corrected and filtered)", in_g),
        ("Acc [cm/s2](raw)", 0.01),
        ("NS (gal) [band-pass filtered]", 0.01),
    ] {
        let record = read(name).unwrap_or_else(|e| panic!("{name}: {e}"));
        let first = record.samples()[0];
        assert!((first - 0.1 * unit).abs() < 1.0e-12, "{name}: {first}");
    }
    for name in [
        "Acceleration [g] (x 1000)",
        "Acceleration [g] (gal)",
        "Acceleration [g] (inverted)",
        "Acceleration [g] ()",
    ] {
        assert!(read(name).is_err(), "{name}");
    }
}

/// A pulse that decays: its columns fall once and rise then, as times with a wrong first row do.
#[test]
fn rows_of_a_pulse_lose_no_row() {
    let value = |i: usize| (1.0 - i as f64 / 30.0) * (-(i as f64) / 30.0).exp();
    let values: Vec<String> = (0..1559).map(|i| format!("{:.5e}", value(i))).collect();
    let rows: String = values.chunks(8).map(|row| row.join(" ") + "\n").collect();
    let options = |layout: Option<&str>| ReadOptions {
        layout: layout.map(str::to_owned),
        unit: Some(AccelerationUnit::StandardGravity),
        time_step: Some(0.02),
        ..ReadOptions::default()
    };
    let error = read_bytes("f", rows.as_bytes(), &options(None)).unwrap_err();
    let help = error.help().unwrap();
    assert!(
        help.contains("`--layout a`") && !help.contains("skip"),
        "{help}"
    );
    let record = read_bytes("f", rows.as_bytes(), &options(Some("a"))).unwrap();
    assert_eq!(record.samples().len(), 1559);
    // Two rows, of which the last one is short.
    let twelve: String = (0..12)
        .map(|i| format!("{:.6}{}", value(i), if i == 7 { "\n" } else { " " }))
        .collect();
    for layout in [None, Some("a")] {
        let record = read_bytes("f", twelve.as_bytes(), &options(layout)).unwrap();
        assert_eq!(record.samples().len(), 12);
    }
    // Whole numbers above fewer values may be a header.
    let headed = "1940 5 18 4 37 117 1 1\n0.1 0.2 -0.1 0.3\n";
    let error = read_bytes("f", headed.as_bytes(), &options(None)).unwrap_err();
    assert!(error.to_string().starts_with("f:1:1:"), "{error}");
}

/// The files of the earthquake of Chi-Chi begin with the second line of later ones.
#[test]
fn cwa_without_its_first_line() {
    for fixture in fixtures("cwa", 0) {
        let text: String = fixture.bytes.iter().map(|b| char::from(*b)).collect();
        let rest = &text[text.find("#StationCode").unwrap()..];
        let said = refused(rest.as_bytes(), &ReadOptions::default());
        assert!(
            said.starts_with("f:1:1:") && said.contains("`--format cwa`"),
            "{said}"
        );
        let given = ReadOptions {
            format: Format::find("cwa").ok(),
            ..ReadOptions::default()
        };
        read_all_bytes("f", rest.as_bytes(), &given).unwrap();
    }
    // What it does not read either is told as before.
    let said = refused(
        b"#StationCode: A\n0.1 0.2\n0.3 0.4\n",
        &ReadOptions::default(),
    );
    assert!(!said.contains("cwa"), "{said}");
}
