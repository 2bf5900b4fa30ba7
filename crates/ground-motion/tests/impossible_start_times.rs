//! Start times that no calendar or clock has, and headers that lack theirs.
use pounding_ground_motion::{AccelerationUnit, Origin, ReadOptions, read_all_bytes};

use crate::common::binary::sac_with;
use crate::common::fixtures;

fn origin_of(format: &'static str, from: &str, to: &str) -> Origin {
    let fixture = fixtures(format, 0).remove(0);
    let text: String = fixture.bytes.iter().map(|b| char::from(*b)).collect();
    assert!(text.contains(from), "{format}");
    let bytes: Vec<u8> = text
        .replacen(from, to, 1)
        .chars()
        .map(|c| c as u8)
        .collect();
    let found = read_all_bytes("f", &bytes, &fixture.options).unwrap();
    found.series[0].origin.clone()
}

#[test]
fn they_are_said_and_not_used() {
    for (format, from, to) in [
        (
            "k_net",
            "Record Time       2000/01/01 00:00:20",
            "Record Time       2000/13/41 25:61:15",
        ),
        ("dyna", ": 20000101_000000.000", ": 20001301_000000.000"),
        (
            "isesd",
            "time of first sample: 00:00:00",
            "time of first sample: 25:00:00",
        ),
        (
            "iris_ascii",
            "2020-01-01T23:59:59.900000",
            "2020-01-41T23:59:59.900000",
        ),
    ] {
        let plain = origin_of(format, from, from);
        assert!(!plain.start_time.is_empty(), "{format}");
        let said = |w: &String| w.contains("start time \"") && w.contains("is not used");
        assert!(!plain.warnings.iter().any(said), "{:?}", plain.warnings);
        let other = origin_of(format, from, to);
        assert_eq!(other.start_time, "", "{format}");
        assert!(other.warnings.iter().any(said), "{:?}", other.warnings);
    }
}

#[test]
fn a_header_without_one_states_none() {
    let origin = origin_of("k_net", "Record Time       2000/01/01 00:00:20\n", "");
    assert_eq!((&*origin.start_time, origin.warnings.len()), ("", 0));
}

#[test]
fn days_of_the_year_of_sac() {
    let options = ReadOptions {
        unit: Some(AccelerationUnit::StandardGravity),
        ..ReadOptions::default()
    };
    for (day, is_one) in [(366, true), (367, false), (0, false)] {
        let bytes = sac_with(
            &[],
            &[(70, 2020), (71, day), (72, 1), (73, 2), (74, 3), (75, 4)],
            "HNE",
        );
        let found = read_all_bytes("f", &bytes, &options).unwrap();
        let origin = &found.series[0].origin;
        assert_eq!(!origin.start_time.is_empty(), is_one, "{day}");
        assert_eq!(origin.warnings.is_empty(), is_one, "{:?}", origin.warnings);
    }
}
