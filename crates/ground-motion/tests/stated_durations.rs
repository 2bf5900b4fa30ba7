//! Durations in headers are held against count and time step, in every format that states
//! one.
use std::path::Path;

use crate::common::{Fixture, fixtures};
use pounding_ground_motion::{ReadOptions, Sampling, read_all, read_all_bytes};

fn named(format: &'static str, name: &str) -> Fixture {
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
    let spaced = named("csmip_v1", "csmip_v1_spaced");
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
    let pairs = named("csmip_v1", "csmip_v1_pairs");
    let wrong = changed(&pairs, "      .110", "     5.110");
    refused(&pairs, &wrong, ["5.11 s", "0.11 s"]);
}

/// 23 samples at 0.01 s and at 0.02 s, in words and in real 60; the records before they were
/// processed lasted a tenth longer, in real 3.
#[test]
fn volume_2() {
    let mut csmip = named("csmip_v2", "csmip_v2");
    // The agency's line 12, which the fixture leaves blank.
    let blank = "\n\n\n\nAccelerogram";
    let words = "\n  Record Length =   .230 sec.\n\n\nAccelerogram";
    csmip.bytes = changed(&csmip, blank, words);
    let caltech = named("caltech_volume_2", "caltech_volume_2");
    for (fixture, from, to, numbers) in [
        (&csmip, "=   .230 sec", "=   .260 sec", ["0.26 s", "0.23 s"]),
        (&csmip, "     .2300", "     .2600", ["0.26 s", "0.23 s"]),
        (&csmip, "at 0.010", "at 0.001", ["0.23 s", "0.023 s"]),
        (&caltech, "=  0.46 SEC", "=  0.52 SEC", ["0.52 s", "0.46 s"]),
        (&caltech, "     .4600", "     .5200", ["0.52 s", "0.46 s"]),
    ] {
        read_all_bytes("file", &fixture.bytes, &fixture.options).unwrap();
        refused(fixture, &changed(fixture, from, to), numbers);
    }
    let wrong = changed(&csmip, "=   .230 sec", "=   .260 sec");
    let error = read_all_bytes("file", &wrong, &csmip.options).unwrap_err();
    assert!(error.to_string().starts_with("file:12:1: "), "{error}");
    // The words may repeat the number of the record before it was processed, where that of the
    // series stands beside it.
    let raw = changed(&csmip, "=   .230 sec", "=   .253 sec");
    read_all_bytes("file", &raw, &csmip.options).unwrap();
    csmip.bytes = changed(&csmip, "     .2300", " -999.0000");
    read_all_bytes("file", &csmip.bytes, &csmip.options).unwrap();
    let raw = changed(&csmip, "=   .230 sec", "=   .253 sec");
    refused(&csmip, &raw, ["0.253 s", "0.23 s"]);
}

/// 23 samples at 0.005 s: in real 63, in words, and to a second in the line before the data;
/// the record before it was processed lasted 0.125 s, in real 35.
#[test]
fn cosmos() {
    let mut cosmos = named("cosmos", "cosmos");
    let words = "Raw record length =  0.115  sec, Uncor max = 1, at 0.0 sec.";
    cosmos.bytes = changed(&cosmos, "Text line 10", words);
    read_all_bytes("file", &cosmos.bytes, &cosmos.options).unwrap();
    for (from, to, place, numbers) in [
        (
            "length =  0.115",
            "length =  0.135",
            "file:10:1: ",
            ["0.135 s", "0.115 s"],
        ),
        (
            "      .115000",
            "      .135000",
            "file:36:1: ",
            ["0.135 s", "0.115 s"],
        ),
        (
            "approx  0 secs",
            "approx  7 secs",
            "file:45:1: ",
            ["7 s", "0.115 s"],
        ),
    ] {
        let wrong = changed(&cosmos, from, to);
        refused(&cosmos, &wrong, numbers);
        let error = read_all_bytes("file", &wrong, &cosmos.options).unwrap_err();
        assert!(error.to_string().starts_with(place), "{error}");
    }
    for (from, to) in [
        ("approx  0 secs", "approx  1 secs"),
        ("length =  0.115", "length =  0.125"),
    ] {
        let right = changed(&cosmos, from, to);
        read_all_bytes("file", &right, &cosmos.options).unwrap();
    }
}

#[test]
fn other_formats() {
    let dyna = &fixtures("dyna", 0)[0];
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

    let k_net = &fixtures("k_net", 0)[0];
    let slow = changed(k_net, "Sampling Freq(Hz) 100Hz", "Sampling Freq(Hz) 10Hz");
    refused(k_net, &slow, ["0.23 s", "2.3 s"]);

    let sac = &fixtures("sac", 0)[0];
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
