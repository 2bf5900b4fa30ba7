//! Headers of Volume 1 state duration, step and unit more than once, in numbers and in words:
//! what differs is refused with its line, and the user may say which is right.
use crate::common::{self, Fixture, fixtures};
use pounding_ground_motion::{
    AccelerationUnit, GroundMotionError, ReadOptions, Recording, Sampling, read_all_bytes,
};

/// 23 samples at 0.005 s in g; header in lines 1 to 13, its length of 0.11 s in lines 11 and
/// 21, line 28 before the data.
fn spaced() -> Fixture {
    let mut all = fixtures("csmip_v1", 0).into_iter();
    all.find(|f| f.name == "csmip_v1_spaced").unwrap()
}

fn read(changes: &[(&str, &str)], options: &ReadOptions) -> Result<Recording, GroundMotionError> {
    let mut text = String::from_utf8(spaced().bytes).unwrap();
    for (from, to) in changes {
        assert!(text.contains(from), "{from}");
        text = text.replace(from, to);
    }
    read_all_bytes("t.RAW", text.as_bytes(), options)
}

/// The error names place and numbers, and says what to do.
fn refused(changes: &[(&str, &str)], place: &str, words: &[&str], remedy: &str) {
    let error = read(changes, &ReadOptions::default()).unwrap_err();
    let shown = error.to_string();
    assert!(shown.starts_with(place), "{shown}");
    for word in words {
        assert!(shown.contains(word), "{word} is not in {shown}");
    }
    assert!(error.help().unwrap().contains(remedy), "{:?}", error.help());
}

const LENGTH: &str = "RECORD LENGTH =   .110 SEC";

#[test]
fn durations_in_words() {
    read(&[], &ReadOptions::default()).unwrap();
    let words = ["0.19 s", "23 samples at 0.005 s last 0.115 s"];
    for to in ["RECORD LENGTH =   .190 SEC", "DURATION =   .190 SEC"] {
        refused(
            &[(LENGTH, to)],
            "t.RAW:11:1: ",
            &words,
            "get the record again",
        );
    }
    // The number of the block alone, and both.
    let number = ("      .110", "      .190");
    refused(&[number], "t.RAW:21:1: ", &words, "lenient");
    let both = [number, (LENGTH, "RECORD LENGTH =   .190 SEC")];
    refused(&both, "t.RAW:11:1: ", &words, "lenient");
    // A rounded one is none.
    let rounded = (LENGTH, "RECORD LENGTH =   .12 SEC");
    read(&[rounded], &ReadOptions::default()).unwrap();
    let lenient = ReadOptions {
        lenient: true,
        ..ReadOptions::default()
    };
    let read = read(&both, &lenient).unwrap();
    let warnings = &read.series[0].origin.warnings;
    let said = warnings.iter().filter(|w| w.contains("0.19 s")).count();
    assert_eq!(said, 1, "{warnings:?}");
}

#[test]
fn sampling_rates() {
    let slow = ("AT 200 SAMPLES/SEC", "AT 100 SAMPLES/SEC");
    let place = "t.RAW:28:1: ";
    let words = [
        "0.005 s",
        "0.01 s",
        "200 samples/s",
        "100 samples/s",
        "line 11",
    ];
    refused(&[slow], place, &words, "--time-step");
    let sentence = ("NOWHERE", "NOWHERE, SAMPLING RATE 100 HZ");
    refused(&[sentence], place, &["line 6", "0.01 s"], "time_step");
    // A hundredth is no difference.
    let near = ("AT 200 SAMPLES/SEC", "AT 199 SAMPLES/SEC");
    read(&[near], &ReadOptions::default()).unwrap();
    let far = ("AT 200 SAMPLES/SEC", "AT 197 SAMPLES/SEC");
    refused(&[far], place, &["197 samples/s"], "time_step");
    let given = |step| ReadOptions {
        time_step: Some(step),
        ..ReadOptions::default()
    };
    let recording = read(&[slow], &given(0.005)).unwrap();
    let series = &recording.series[0];
    assert_eq!(series.sampling, Sampling::Even { time_step: 0.005 });
    let warnings = &series.origin.warnings;
    assert!(
        warnings.iter().any(|w| w.contains("100 samples/s")),
        "{warnings:?}"
    );
    // The other one does not give the duration, a third one is not in the file.
    let other = read(&[slow], &given(0.01)).unwrap_err().to_string();
    assert!(other.contains("0.23 s"), "{other}");
    assert!(matches!(
        read(&[slow], &given(0.02)),
        Err(GroundMotionError::Contradiction { .. })
    ));
}

#[test]
fn units() {
    let other = ("(UNITS: G)", "(UNITS: CM/SEC2)");
    let place = "t.RAW:28:1: ";
    refused(&[other], place, &["cm/s2 here", "g in line 12"], "--unit");
    let unknown = ("(UNITS: G)", "(UNITS: COUNTS)");
    refused(
        &[unknown],
        place,
        &["counts here", "g in line 12"],
        "--unit",
    );
    let header = ("ACCEL IS G.", "ACCEL ARE SEC AND G/10.");
    refused(&[header], place, &["g here", "g/10 in line 12"], "unit");
    let given = |unit| ReadOptions {
        unit: Some(unit),
        ..ReadOptions::default()
    };
    for (unit, factor) in [
        (AccelerationUnit::Gal, 0.01),
        (AccelerationUnit::StandardGravity, common::G),
    ] {
        let recording = read(&[other], &given(unit)).unwrap();
        let series = &recording.series[0];
        assert_eq!(series.unit_in_si, factor);
        let warnings = &series.origin.warnings;
        assert!(
            warnings.iter().any(|w| w.contains("g in line 12")),
            "{warnings:?}"
        );
    }
    // The same in other words, and one alone.
    for word in ["(UNITS: g)", "IN UNITS OF G.", ""] {
        read(&[("(UNITS: G)", word)], &ReadOptions::default()).unwrap();
    }
    let alone = [header, ("UNITS OF UNCOR ACCEL ARE SEC AND G/10.", "")];
    let series = &read(&alone, &ReadOptions::default()).unwrap().series[0];
    assert_eq!(series.unit_in_si, common::G);
}

/// Every value of pairs has its own time: a nominal rate beside them is only named.
#[test]
fn a_rate_beside_pairs() {
    let pairs = &fixtures("csmip_v1", 0)[0];
    let text = String::from_utf8(pairs.bytes.clone()).unwrap();
    let text = text.replace(LENGTH, &format!("{LENGTH}   AT 100 SAMPLES/SEC"));
    let read = read_all_bytes("t.RAW", text.as_bytes(), &pairs.options).unwrap();
    let warnings = &read.series[0].origin.warnings;
    assert!(
        warnings
            .iter()
            .any(|w| w.contains("line 11 says 100 samples/s")),
        "{warnings:?}"
    );
}

/// What lines before plain rows say of unit and rate, and the keys of our layout in any letters, are
/// held against the values and the options; they were passed over.
#[test]
fn lines_before_rows() {
    let read = |text: &str, unit, time_step| {
        let options = ReadOptions {
            unit,
            time_step,
            ..ReadOptions::default()
        };
        read_all_bytes("f", text.as_bytes(), &options)
    };
    let g = Some(AccelerationUnit::StandardGravity);
    let rows = "0.1\n-0.2\n0.3\n";
    let refused = |head: &str, wanted: &str| {
        let error = read(&(head.to_owned() + rows), g, Some(0.01)).unwrap_err();
        assert!(error.to_string().contains(wanted), "{head}: {error}");
    };
    for head in [
        "Units: cm/s2\n",
        "# unit = gal\n",
        "Acceleration units: cm/sec/sec\n",
    ] {
        refused(head, "unit is cm/s2 (line 1) in the file but g was given");
        let read = read(
            &(head.to_owned() + rows),
            Some(AccelerationUnit::Gal),
            Some(0.01),
        );
        assert!(read.is_ok(), "{head}");
    }
    refused("Units: cm/s\n", "is a velocity");
    refused(
        "Sampling rate: 200 Hz\n",
        "time_step is 0.005 s (line 1) in the file but 0.01 s was given",
    );
    for head in [
        "Units: g\n",
        "Sampling rate: 100 Hz\n",
        "Sampling rate: 200 Hz, decimated to 100 Hz\n",
        "Vs30 unit: m/s\n",
    ] {
        assert!(
            read(&(head.to_owned() + rows), g, Some(0.01)).is_ok(),
            "{head}"
        );
    }
    // Beside times it is a warning, as in other formats.
    let columns: String = (0..9)
        .map(|i| format!("{:.2} {}\n", 0.01 * f64::from(i), (i % 4) - 2))
        .collect();
    let recording = read(&format!("Sampling rate: 200 Hz\n{columns}"), g, None).unwrap();
    let warnings = &recording.series[0].origin.warnings;
    assert!(
        warnings
            .iter()
            .any(|w| w.starts_with("line 1: the header says 200 samples/s")),
        "{warnings:?}"
    );

    let own = "time_s,acceleration_g\n0.00,0.1\n0.01,-0.2\n0.02,0.3\n";
    for (key, wanted) in [
        ("# UNIT: cm/s2", "contradicts the column header"),
        ("# Units: cm/s2", "contradicts the column header"),
        ("# DT: 0.02 s", "follows from dt = 0.02 s"),
        ("# samples: 4", "4 samples"),
    ] {
        let error = read(&format!("{key}\n{own}"), None, None)
            .unwrap_err()
            .to_string();
        assert!(error.contains(wanted), "{key}: {error}");
    }
    assert!(read(&format!("# Units: s and g\n{own}"), None, None).is_ok());
}
