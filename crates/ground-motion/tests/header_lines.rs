//! Lines of headers that were changed, exchanged or filled: an error, or a warning.
use pounding_ground_motion::{
    AccelerationUnit, GroundMotionError, ReadOptions, Recording, Sampling, read_all_bytes,
    read_bytes,
};

use crate::common::{COUNT, binary, fixtures};

fn all(bytes: &[u8]) -> Result<Recording, GroundMotionError> {
    read_all_bytes("f", bytes, &ReadOptions::default())
}

fn in_g(bytes: &[u8]) -> Result<Recording, GroundMotionError> {
    let options = ReadOptions {
        unit: Some(AccelerationUnit::StandardGravity),
        ..ReadOptions::default()
    };
    read_all_bytes("f", bytes, &options)
}

fn says(recording: &Recording, words: &str) -> bool {
    let mut warnings = recording.series.iter().flat_map(|s| &s.origin.warnings);
    warnings.any(|w| w.contains(words))
}

/// What the numbers of COSMOS headers mean is said by their place.
#[test]
fn numbers_of_cosmos_stand_where_they_are_announced() {
    for fixture in fixtures("cosmos", 0) {
        let text = String::from_utf8(fixture.bytes.clone()).unwrap();
        for (from, to) in [
            ("on  10 lines", "on  11 lines"),
            (
                "on  10 lines, Format= (10I8)",
                "on  10 lines, Format= (11I8)",
            ),
            ("on  20 lines", "on  21 lines"),
        ] {
            let changed = text.replacen(from, to, 1);
            if changed == text {
                continue;
            }
            let options = fixture.options.clone();
            let error = read_all_bytes("f", changed.as_bytes(), &options).unwrap_err();
            assert!(matches!(error, GroundMotionError::Parse { .. }), "{error}");
        }
    }
}

/// A line of NUL bytes behind the last row is a filling, in a format that counts its values.
#[test]
fn filling_behind_smc() {
    for fixture in fixtures("usgs_smc", 0) {
        let mut filled = fixture.bytes.clone();
        filled.extend([0; 512]);
        let found = read_all_bytes("f", &filled, &fixture.options).unwrap();
        assert!(says(&found, "512 NUL bytes"), "{}", fixture.name);
        // An end of line may stand behind them.
        filled.extend(b"\r\n");
        let found = read_all_bytes("f", &filled, &fixture.options).unwrap();
        assert!(says(&found, "512 NUL bytes"), "{}", fixture.name);
        // Within the rows they are missing values.
        let end = fixture.bytes.len() - 20;
        let mut cut = fixture.bytes[..end].to_vec();
        cut.extend([0; 512]);
        assert!(read_all_bytes("f", &cut, &fixture.options).is_err());
    }
}

#[test]
fn channels_and_types_of_sac() {
    let low_gain = binary::sac_with(&[], &[(86, -12345)], "HLZ");
    assert!(says(&in_g(&low_gain).unwrap(), "low gain"));
    let no_type = binary::sac_with(&[], &[(85, -12345)], "HNZ");
    assert!(says(&in_g(&no_type).unwrap(), "IFTYPE"));
    for (code, measured) in [
        ("HDF", "pressure"),
        ("LKO", "temperature"),
        ("HJZ", "rotation"),
    ] {
        let other = binary::sac_with(&[], &[(86, -12345)], code);
        let said = in_g(&other).unwrap_err().to_string();
        assert!(said.contains(measured), "{code}: {said}");
    }
    // Names of directions are no codes.
    for name in ["RAD", "VER", "TRA", "LON", "EAS"] {
        let named = binary::sac_with(&[], &[(86, -12345)], name);
        assert!(in_g(&named).is_ok(), "{name}");
    }
    let spectrum = binary::sac_with(&[], &[(85, 2)], "HNZ");
    assert!(in_g(&spectrum).is_err());
}

/// Times behind the samples that are even in single precision are a step.
#[test]
fn even_times_of_sac() {
    let mut fixture = binary::sac(COUNT as i64).remove(1);
    let from = 632 + 4 * COUNT;
    for i in 0..COUNT {
        let time = (0.01 * i as f64) as f32;
        fixture.bytes[from + 4 * i..from + 4 * i + 4].copy_from_slice(&time.to_le_bytes());
    }
    let found = in_g(&fixture.bytes).unwrap();
    let even = Sampling::Even { time_step: 0.01 };
    assert_eq!(found.series[0].sampling, even);
    let late = (0.01 * (COUNT - 1) as f64 + 0.005) as f32;
    fixture.bytes[from + 4 * COUNT - 4..from + 4 * COUNT].copy_from_slice(&late.to_le_bytes());
    let found = in_g(&fixture.bytes).unwrap();
    assert!(matches!(found.series[0].sampling, Sampling::Uneven { .. }));
}

/// `X` of a Fortran format passes over whatever stands there.
#[test]
fn formats_pass_over_columns() {
    let row = |i: usize| {
        let values = (0..8).map(|k| 0.1 * (1.7 * (8 * i + k) as f64).sin());
        let values: String = values.map(|a| format!("{a:9.5}")).collect();
        format!("{:8.3}{values}\n", 0.08 * i as f64)
    };
    let text: String = (0..20).map(row).collect();
    let options = ReadOptions {
        layout: Some("8X,8F9.5".to_owned()),
        unit: Some(AccelerationUnit::StandardGravity),
        time_step: Some(0.01),
        ..ReadOptions::default()
    };
    let record = read_bytes("f", text.as_bytes(), &options).unwrap();
    assert_eq!(record.samples().len(), 160);
}

#[test]
fn lines_behind_the_count_of_at2() {
    let text = "npts=6 dt=0.01\nUnits: gal\n0.1 0.2 -0.3\n0.1 0.2 0.5\n";
    let found = all(text.as_bytes()).unwrap();
    assert_eq!(
        (found.series[0].unit, found.series[0].samples.len()),
        ("cm/s2", 6)
    );
    // Numbers that touch: the remedy says all that is needed.
    let touching = text.replace("0.2 -0.3", "0.2-0.3");
    let help = all(touching.as_bytes()).unwrap_err().help().unwrap();
    for word in [
        "plain_columns",
        "skip_lines = 2",
        "layout",
        "time_step",
        "unit",
    ] {
        assert!(help.contains(word), "{help}");
    }
}
