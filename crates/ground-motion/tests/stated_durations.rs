//! Durations in headers are held against count and time step, in every format that states
//! one.
#![allow(clippy::unwrap_used)]

mod common;

use std::path::Path;

use common::{Fixture, fixtures};
use pounding_ground_motion::{Format, ReadOptions, Sampling, read_all, read_all_bytes};

fn named(format: Format, name: &str) -> Fixture {
    fixtures(format, 0)
        .into_iter()
        .find(|f| f.name == name)
        .unwrap()
}

/// Replaces what must be there.
fn changed(fixture: &Fixture, from: &str, to: &str) -> Vec<u8> {
    let text = String::from_utf8(fixture.bytes.clone()).unwrap();
    assert!(text.contains(from), "{}: {from}", fixture.name);
    text.replace(from, to).into_bytes()
}

/// Error without `lenient`, warning with it, both numbers in both.
fn refused(fixture: &Fixture, bytes: &[u8], numbers: [&str; 2]) {
    let error = read_all_bytes("file", bytes, &fixture.options).unwrap_err();
    let shown = error.to_string();
    assert!(shown.starts_with("file:"), "{shown}");
    for number in numbers {
        assert!(shown.contains(number), "{}: {shown}", fixture.name);
    }
    assert!(error.help().unwrap().contains("lenient"), "{shown}");
    let lenient = ReadOptions {
        lenient: true,
        ..fixture.options.clone()
    };
    read_all_bytes("file", bytes, &lenient).unwrap();
}

/// 23 samples at 0.005 s last 0.115 s, at the 200 s of before 4600 s.
#[test]
fn volume_1() {
    let spaced = named(Format::CsmipV1, "csmip_v1_spaced");
    let wrong = changed(&spaced, "SPACED AT .005 SEC", "SPACED AT .010 SEC");
    refused(&spaced, &wrong, ["0.11 s", "0.23 s"]);
    // A rate is a rate, whatever its number.
    let rate = changed(&spaced, "SPACED AT .005 SEC", "SPACED AT 200 PTS/SEC");
    let series = &read_all_bytes("file", &rate, &spaced.options)
        .unwrap()
        .series[0];
    assert_eq!(series.sampling, Sampling::Even { time_step: 0.005 });
    // A number without a unit is neither; the header's text still states the rate.
    let bare = changed(&spaced, "SPACED AT .005 SEC", "SPACED AT .005    ");
    let series = &read_all_bytes("file", &bare, &spaced.options)
        .unwrap()
        .series[0];
    assert_eq!(series.sampling, Sampling::Even { time_step: 0.005 });
    let pairs = named(Format::CsmipV1, "csmip_v1_pairs");
    let wrong = changed(&pairs, "      .110", "     5.110");
    refused(&pairs, &wrong, ["5.11 s", "0.11 s"]);
}

#[test]
fn other_formats() {
    let cosmos = &fixtures(Format::Cosmos, 0)[0];
    let text = String::from_utf8(cosmos.bytes.clone()).unwrap();
    let step = read_all_bytes("file", &cosmos.bytes, &cosmos.options).unwrap();
    assert!(
        matches!(step.series[0].sampling, Sampling::Even { .. }),
        "{text}"
    );

    let dyna = &fixtures(Format::Dyna, 0)[0];
    let text = String::from_utf8(dyna.bytes.clone()).unwrap();
    let line = text
        .lines()
        .find(|l| l.starts_with("NDATA"))
        .unwrap()
        .to_owned();
    let long = text.replace(&line, &format!("{line}\nDURATION_S: 70.01"));
    refused(dyna, long.as_bytes(), ["70.01 s", "23 samples"]);
    let open = text.replace(&line, &format!("{line}\nDURATION_S: "));
    read_all_bytes("file", open.as_bytes(), &dyna.options).unwrap();

    let k_net = &fixtures(Format::KNet, 0)[0];
    let slow = changed(k_net, "Sampling Freq(Hz) 100Hz", "Sampling Freq(Hz) 10Hz");
    refused(k_net, &slow, ["0.23 s", "2.3 s"]);

    let sac = &fixtures(Format::Sac, 0)[0];
    let mut bytes = sac.bytes.clone();
    let big = i32::from_be_bytes(bytes[304..308].try_into().unwrap()) == 6;
    for (word, value) in [(5_usize, 0.0_f32), (6, 60.0)] {
        let four = if big {
            value.to_be_bytes()
        } else {
            value.to_le_bytes()
        };
        bytes[4 * word..4 * word + 4].copy_from_slice(&four);
    }
    refused(sac, &bytes, ["60 s", "23 samples"]);
}

/// The file of the agency, where it is at hand.
#[test]
fn hesperia() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../../shared/ground_motions/agency_more/ce23583r_HESPERIA.RAW");
    if !path.exists() {
        return;
    }
    let recording = read_all(&path, &ReadOptions::default()).unwrap();
    for series in &recording.series {
        assert_eq!(series.sampling, Sampling::Even { time_step: 0.005 });
        assert_eq!(series.samples.len(), 12001);
        // Peaks with their times in the header are those of the samples at this step.
        assert!(series.header_peak.unwrap().time.is_some());
        let of_header = series.origin.warnings.iter().find(|w| w.contains("header"));
        assert_eq!(of_header, None);
    }
}
