//! Text of EarthScope (IRIS): what its header says, against the samples and against itself.
use pounding_ground_motion::{
    AccelerationUnit, Quantity, ReadOptions, Recording, read_all_bytes, read_bytes,
};

use crate::common::fixtures;

fn text(name: &str) -> String {
    let fixture = fixtures("iris_ascii", 0)
        .into_iter()
        .find(|f| f.name == name)
        .unwrap();
    String::from_utf8(fixture.bytes).unwrap()
}

fn read(text: &str, options: &ReadOptions) -> Result<Recording, String> {
    read_all_bytes("f", text.as_bytes(), options)
        .map_err(|e| format!("{e}; {}", e.help().unwrap_or_default()))
}

#[track_caller]
fn refused(text: &str, expected: &str) {
    let said = read(text, &ReadOptions::default()).unwrap_err();
    assert!(said.contains(expected), "{said}");
}

#[test]
fn the_header_is_read() {
    for name in ["iris_slist", "iris_tspair"] {
        let found = read(&text(name), &ReadOptions::default()).unwrap();
        let origin = &found.series[0].origin;
        assert_eq!(origin.start_time, "2020-01-01T23:59:59.900000 UTC");
        assert_eq!(origin.title, "XX.ABCD");
        assert!(origin.warnings.is_empty(), "{:?}", origin.warnings);
    }
    let plain = text("iris_slist");
    for (from, to, expected) in [
        (
            "23 samples",
            "46 samples",
            "the header says 46 samples, the series ends after 23",
        ),
        (
            "23 samples",
            "13 samples",
            "the header says 13 samples, but 23 stand",
        ),
        ("23 samples", "many", "how many samples follow"),
        ("100 sps", "0 sps", "no rate in samples per second"),
        ("FLOAT", "ASCII", "neither FLOAT nor INTEGER"),
        ("M/S**2", "furlong", "\"furlong\" is no unit that is known"),
        ("M/S**2", "", "does not state the unit"),
        ("M/S**2", "Counts", "does not state how many make 1 m/s2"),
    ] {
        refused(&plain.replacen(from, to, 1), expected);
    }
}

#[test]
fn units_and_instruments() {
    let plain = text("iris_slist");
    let peak = |text: &str, options: &ReadOptions| {
        let found = read_bytes("f", text.as_bytes(), options);
        found
            .map(|record| record.samples()[1])
            .map_err(|e| e.to_string())
    };
    let strict = ReadOptions::default();
    let in_m_s2 = peak(&plain, &strict).unwrap();
    let with = |unit: &str| plain.replacen("M/S**2", unit, 1);
    let in_cm_s2 = peak(&with("CM/S**2"), &strict).unwrap();
    assert!((in_cm_s2 / in_m_s2 - 0.01).abs() < 1e-12);
    // The mean of counts is taken off.
    let counts = ReadOptions {
        sensitivity: Some(1000.0),
        ..ReadOptions::default()
    };
    for unit in ["Counts", "counts", ""] {
        let found = read(&with(unit), &counts).unwrap();
        assert!((found.series[0].samples[1] * 1000.0 / in_m_s2 - 1.0).abs() < 1e-12);
    }
    let velocity = read(&with("M/S"), &strict).unwrap();
    assert_eq!(velocity.series[0].quantity, Quantity::Velocity);
    assert!(
        peak(&with("M/S"), &strict)
            .unwrap_err()
            .contains("velocity")
    );
    // Without a unit of motion the code says what was recorded.
    let in_g = ReadOptions {
        unit: Some(AccelerationUnit::StandardGravity),
        ..ReadOptions::default()
    };
    assert!(read(&with(""), &in_g).is_ok());
    for (channel, what) in [("HHE", "a seismometer"), ("LDO", "records pressure")] {
        for options in [&in_g, &counts] {
            let said = read(&with("").replacen("HNE", channel, 1), options).unwrap_err();
            assert!(said.contains(what), "{said}");
        }
    }
    assert!(read(&plain.replacen("HNE", "HHE", 1), &strict).is_ok());
}

#[test]
fn segments_times_and_rows() {
    for name in ["iris_slist", "iris_tspair"] {
        let plain = text(name);
        let other = plain.replace("HNE", "HNN");
        let line = plain.lines().count() + 1;
        refused(
            &(plain.clone() + &other),
            &format!("f:{line}:1: a second segment starts here, of XX_ABCD_00_HNN_D"),
        );
    }
    let pairs = text("iris_tspair");
    let lines: Vec<&str> = pairs.lines().collect();
    let joined = |lines: &[&str]| lines.join("\n") + "\n";
    let mut missing = lines.clone();
    missing.remove(7);
    refused(
        &joined(&missing),
        "f:8:1: the time 2020-01-01T23:59:59.970000 is not 0.01 s after",
    );
    let mut doubled = lines.clone();
    doubled.insert(7, lines[7]);
    refused(&joined(&doubled), "f:9:1: the time");
    let mut exchanged = lines.clone();
    exchanged.swap(6, 7);
    refused(&joined(&exchanged), "f:7:1: the time");
    refused(
        &pairs.replacen("100 sps", "200 sps", 1),
        "is not 0.005 s after",
    );
    // A rate that is off by less than half a step adds up.
    refused(
        &pairs.replacen("100 sps", "110 sps", 1),
        "the times are 0.01 s apart on average",
    );
    refused(
        &pairs.replacen("59.900000, TSPAIR", "58.900000, TSPAIR", 1),
        "is not 0 s after",
    );
    let list = text("iris_slist");
    let row = list.lines().nth(2).unwrap();
    refused(
        &list.replacen(row, &row[..row.len() - 18], 1),
        "another number of values",
    );
    // Cut off within the last value, and a value without its exponent.
    refused(&list[..list.len() - 2], "ends within its last value");
    refused(&list.replacen("e+00\t", "\t", 1), "no exponent");
}

/// A second that was inserted is no gap, whether the record begins in it or goes over it.
#[test]
fn seconds_that_were_inserted() {
    let strict = ReadOptions::default();
    let header = |kind: &str, start: &str, count: usize| {
        format!(
            "TIMESERIES XX_ABCD__HNE_D, {count} samples, 100 sps, {start}, {kind}, FLOAT, M/S**2\n"
        )
    };
    let values = "0.1\n0.2\n-0.3\n0.4\n";
    let start = "2016-12-31T23:59:60.500000";
    let found = read(&(header("SLIST", start, 4) + values), &strict).unwrap();
    let origin = &found.series[0].origin;
    assert_eq!(origin.start_time, format!("{start} UTC"));
    assert!(origin.warnings.is_empty(), "{:?}", origin.warnings);
    for times in [
        [
            "31T23:59:59.990000",
            "31T23:59:60.000000",
            "31T23:59:60.010000",
            "31T23:59:60.020000",
        ],
        [
            "31T23:59:60.000000",
            "31T23:59:60.010000",
            "31T23:59:60.020000",
            "31T23:59:60.030000",
        ],
    ] {
        let times = times.map(|time| format!("2016-12-{time}"));
        let rows: String = times.iter().map(|time| format!("{time}  0.5\n")).collect();
        let text = header("TSPAIR", &times[0], 4) + &rows;
        read(&text, &strict).unwrap();
    }
    let rows = "2016-12-31T23:59:60.980000 1\n2016-12-31T23:59:60.990000 2\n2017-01-01T00:00:00.000000 3\n2017-01-01T00:00:00.010000 4\n";
    let text = header("TSPAIR", "2016-12-31T23:59:60.980000", 4) + rows;
    read(&text, &strict).unwrap();
    // A second is missing.
    let missing = text.replace("00:00:00", "00:00:01");
    assert!(
        read(&missing, &strict)
            .unwrap_err()
            .contains("is not 0.01 s after")
    );
    let none = read(
        &(header("SLIST", "2016-12-31T23:58:60.5", 4) + values),
        &strict,
    )
    .unwrap();
    assert_eq!(none.series[0].origin.start_time, "");
}
