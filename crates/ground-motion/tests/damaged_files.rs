//! Statements that stand twice and differ, files that are cut off or lack rows, and headers behind blank lines.
use pounding_ground_motion::writers::{Written, write_pounding_csv};
use pounding_ground_motion::{
    AccelerationUnit, Accelerogram, GroundMotionError, Processing, ReadOptions, Recording,
    read_all_bytes, read_bytes,
};

use crate::common::binary::{SENSITIVITY, Seed, record, sac_with, steim};
use crate::common::{Fixture, all, fixtures, signal};

fn text_of(format: &'static str) -> (Fixture, String) {
    let fixture = fixtures(format, 0).remove(0);
    let text = fixture.bytes.iter().map(|b| char::from(*b)).collect();
    (fixture, text)
}

fn read(text: &str, options: &ReadOptions) -> Result<Recording, GroundMotionError> {
    let bytes: Vec<u8> = text.chars().map(|c| c as u8).collect();
    read_all_bytes("f", &bytes, options)
}

fn lenient(options: &ReadOptions) -> ReadOptions {
    ReadOptions {
        lenient: true,
        ..options.clone()
    }
}

/// Refused at a line that holds some words, and read with a warning where the user takes the file
/// as it is.
fn refused(text: &str, options: &ReadOptions, at: &str, words: &[&str]) -> Recording {
    let line = text.lines().position(|l| l.contains(at)).unwrap() + 1;
    let error = read(text, options).unwrap_err();
    let shown = format!("{error}; {}", error.help().unwrap());
    assert!(shown.starts_with(&format!("f:{line}:1: ")), "{shown}");
    for words in words.iter().chain([&"lenient"]) {
        assert!(shown.contains(words), "{words} is not in {shown}");
    }
    let read = read(text, &lenient(options)).unwrap();
    assert!(!read.series[0].origin.warnings.is_empty());
    read
}

/// Step and count of the lines before the peaks of a Volume 2.
#[test]
fn words_of_volume_2() {
    for (format, step, other, count, label) in [
        (
            "csmip_v2",
            "intervals of   0.010",
            "intervals of   0.005",
            "    23 points of instrument",
            "points of accel data",
        ),
        (
            "caltech_volume_2",
            "INTERVALS OF    .020",
            "INTERVALS OF    .010",
            "    23  INSTRUMENT",
            "POINTS OF ACC DATA",
        ),
    ] {
        let (fixture, text) = text_of(format);
        assert!(text.contains(step) && text.contains(count), "{text}");
        let words = ["the step is", "in line 17"];
        refused(&text.replace(step, other), &fixture.options, label, &words);
        let wrong = count.replace("23", "63");
        let words = ["23 samples follow here, but line 16 says 63"];
        refused(
            &text.replace(count, &wrong),
            &fixture.options,
            label,
            &words,
        );
        let near = read(
            &text.replace(count, &count.replace("23", "24")),
            &fixture.options,
        );
        let warnings = near.unwrap().series[0].origin.warnings.join("; ");
        assert!(warnings.contains("line 16 says 24"), "{warnings}");
    }
}

#[test]
fn keys_that_stand_twice() {
    let (fixture, text) = text_of("dyna");
    for (line, again) in [
        ("UNITS: cm/s^2\n", "UNITS: m/s^2\n"),
        ("SAMPLING_INTERVAL_S: 0.01\n", "SAMPLING_INTERVAL_S: 0.02\n"),
        ("STREAM: HNE\n", "STREAM: HNN\n"),
    ] {
        let twice = text.replace(line, &format!("{line}{again}"));
        let (key, value) = again.trim().split_once(": ").unwrap();
        let words = [key, &format!("\"{value}\" here, but")];
        let read = refused(&twice, &fixture.options, again.trim(), &words);
        assert_eq!(read.series[0].component, "HNE");
        assert_eq!(read.series[0].unit, "cm/s2");
        self::read(&text.replace(line, &line.repeat(2)), &fixture.options).unwrap();
    }
    let (fixture, text) = text_of("k_net");
    let line = "Dir.              E-W\n";
    let twice = text.replace(line, &format!("{line}Dir.              N-S\n"));
    let words = ["dir. is \"N-S\" here, but \"E-W\" in line 13"];
    let read = refused(&twice, &fixture.options, "N-S", &words);
    assert_eq!(read.series[0].component, "EW");
}

#[test]
fn scale_factors_of_k_net() {
    let (fixture, text) = text_of("k_net");
    let with = |scale: &str| read(&text.replace("3920(gal)/6182761", scale), &fixture.options);
    let samples = with("3920(gal)/6182761").unwrap().series[0].samples.clone();
    for scale in [
        "3920(cm/s2)/6182761",
        "3920 (gal) / 6182761",
        "3920/6182761",
    ] {
        assert_eq!(with(scale).unwrap().series[0].samples, samples, "{scale}");
    }
    for scale in [
        "3920(gal)/6,182,761",
        "3920(gal)/6 182 761",
        "3920(gal)/6182761/2",
        "3920(gal)6182761",
        "(gal)/6182761",
    ] {
        let error = with(scale).unwrap_err().to_string();
        assert!(
            error.starts_with("f:14:19: scale factor"),
            "{scale}: {error}"
        );
    }
}

/// Counts have the offset of their instrument, in SAC as in miniSEED.
#[test]
fn counts_of_sac_are_raw() {
    let bytes = sac_with(&[], &[], "HNE");
    let counts = ReadOptions {
        sensitivity: Some(SENSITIVITY),
        ..ReadOptions::default()
    };
    let record = read_bytes("f", &bytes, &counts).unwrap();
    let origin = record.origin().unwrap();
    assert_eq!(origin.processing, Processing::Raw);
    assert!(origin.mean_removed && origin.warnings[0].contains("was taken off"));
    let unit = ReadOptions {
        unit: Some(AccelerationUnit::Gal),
        ..ReadOptions::default()
    };
    let record = read_bytes("f", &bytes, &unit).unwrap();
    assert_eq!(record.origin().unwrap().processing, Processing::Unstated);
}

/// The mean of a SAC header, in single precision and in the unit of the samples.
#[test]
fn means_of_sac() {
    let options = ReadOptions {
        unit: Some(AccelerationUnit::StandardGravity),
        ..ReadOptions::default()
    };
    let of = |mean: f32| {
        let bytes = sac_with(&[(56, mean)], &[], "HNE");
        read_all_bytes("f", &bytes, &options)
            .unwrap()
            .series
            .remove(0)
    };
    let plain = of(-12345.0);
    let mean = plain.samples.iter().sum::<f64>() / plain.samples.len() as f64 / plain.unit_in_si;
    let peak = plain.samples.iter().fold(0.0_f64, |m, a| m.max(a.abs())) / plain.unit_in_si;
    // A zero may be a field that was not filled in.
    for same in [mean, 0.0, mean + 5e-4 * peak] {
        let warnings = of(same as f32).origin.warnings;
        assert!(warnings.is_empty(), "{warnings:?}");
    }
    for other in [mean + 0.01 * peak, 3.0 * peak] {
        let warnings = of(other as f32).origin.warnings;
        let said = |w: &String| w.contains("(DEPMEN), that of the samples is");
        assert!(warnings.iter().any(said), "{warnings:?}");
    }
}

/// The extremes of a SAC header are in the unit of its samples, whichever that is: no unit that the
/// user states excuses them.
#[test]
fn extremes_of_sac_are_held_against_its_samples() {
    let values: Vec<f32> = signal(0.4, 0.2).iter().map(|a| *a as f32).collect();
    let (low, high) = values.iter().fold((0.0_f32, 0.0_f32), |(low, high), a| {
        (low.min(*a), high.max(*a))
    });
    let read = |factor: f32, lenient: bool, sensitivity: Option<f64>| {
        let bytes = sac_with(&[(1, factor * low), (2, factor * high)], &[], "HNE");
        let options = ReadOptions {
            unit: sensitivity.is_none().then_some(AccelerationUnit::Gal),
            sensitivity,
            lenient,
            ..ReadOptions::default()
        };
        read_bytes("f", &bytes, &options)
    };
    let warns = |record: &Accelerogram| {
        let warnings = &record.origin().unwrap().warnings;
        warnings.iter().any(|w| w.contains("the header's peak is"))
    };
    assert!(!warns(&read(1.0, false, None).unwrap()));
    assert!(warns(&read(1.03, false, None).unwrap()));
    for sensitivity in [None, Some(SENSITIVITY)] {
        let error = read(2.0, false, sensitivity).unwrap_err();
        assert!(
            error.to_string().contains("the header's peak is"),
            "{error}"
        );
        assert!(error.help().unwrap().contains("lenient"), "{error}");
        assert!(warns(&read(2.0, true, sensitivity).unwrap()));
    }
}

/// One extreme alone, or that of the smaller magnitude, and a factor: said, not refused.
#[test]
fn what_a_sac_header_says_beside_its_peak() {
    let values: Vec<f32> = signal(0.4, 0.2).iter().map(|a| *a as f32).collect();
    let high = values.iter().fold(0.0_f32, |high, a| high.max(*a));
    let warnings = |floats: &[(usize, f32)]| {
        let unit = ReadOptions {
            unit: Some(AccelerationUnit::Gal),
            ..ReadOptions::default()
        };
        let record = read_bytes("f", &sac_with(floats, &[], "HNE"), &unit).unwrap();
        record.origin().unwrap().warnings.join("\n")
    };
    for silent in [(2, high), (3, 1.0), (3, 0.0)] {
        assert!(!warnings(&[silent]).contains("the header"), "{silent:?}");
    }
    for of_most in [
        [(1, -12345.0), (2, 2.0 * high)],
        [(3, 1.0), (2, 0.5 * high)],
    ] {
        assert!(warnings(&of_most).contains("(DEPMAX), that of the samples is"));
    }
    let of_least = [(1, -2.0 * high), (2, -12345.0)];
    assert!(warnings(&of_least).contains("(DEPMIN), that of the samples is"));
    assert!(warnings(&[(3, 1e-4)]).contains("(SCALE), which is not applied"));
}

/// The code of a channel in small letters, and the channel of a recorder's messages.
#[test]
fn channels_of_sac_that_record_no_acceleration() {
    let unit = ReadOptions {
        unit: Some(AccelerationUnit::Gal),
        ..ReadOptions::default()
    };
    for (channel, said) in [
        ("hhe", "seismometer"),
        ("HHE", "seismometer"),
        ("LOG", "messages"),
    ] {
        let error = read_bytes("f", &sac_with(&[], &[(86, 5)], channel), &unit).unwrap_err();
        assert!(error.to_string().contains(said), "{channel}: {error}");
    }
}

/// A SAC file that says that it is unevenly spaced, but has no times.
#[test]
fn uneven_sac_without_times() {
    let bytes = sac_with(&[], &[(105, 0)], "HNE");
    let options = ReadOptions {
        unit: Some(AccelerationUnit::Gal),
        ..ReadOptions::default()
    };
    let error = read_bytes("f", &bytes, &options).unwrap_err();
    let told = error.to_string();
    for part in ["unevenly spaced (LEVEN", "its 23 samples", "23 numbers"] {
        assert!(told.contains(part), "{told}");
    }
    assert!(error.help().unwrap().contains("even steps"), "{told}");
}

/// The rate of blockette 100 is the actual one; far from that of the fixed header it is named.
#[test]
fn rates_of_mini_seed_that_differ() {
    let read = |rate: f32| {
        let mut bytes = record(&Seed {
            channel: b"HNE",
            encoding: 3,
            big: true,
            start: 0,
            count: 50,
            data: (0..50_i32)
                .flat_map(|i| (i * i % 17 - 8).to_be_bytes())
                .collect(),
        });
        // Blockette 100 behind the other one: the data move up by its length.
        let data = bytes[64..264].to_vec();
        bytes[64..72].copy_from_slice(&[0, 100, 0, 0, 0, 0, 0, 0]);
        bytes[68..72].copy_from_slice(&rate.to_be_bytes());
        bytes[72..128].fill(0);
        bytes[128..328].copy_from_slice(&data);
        bytes[44..46].copy_from_slice(&128_u16.to_be_bytes());
        bytes[50..52].copy_from_slice(&64_u16.to_be_bytes());
        let options = ReadOptions {
            sensitivity: Some(SENSITIVITY),
            ..ReadOptions::default()
        };
        read_bytes("f", &bytes, &options).unwrap()
    };
    for (rate, named) in [
        (100.0, false),
        (100.5, false),
        (99.9, false),
        (200.0, true),
        (98.0, true),
    ] {
        let record = read(rate);
        assert!((record.time_step() * f64::from(rate) - 1.0).abs() < 1e-12);
        let warnings = &record.origin().unwrap().warnings;
        let text = format!(
            "has {rate} samples per second by its blockette 100, which is used, but 100 by"
        );
        assert_eq!(
            warnings.iter().any(|w| w.contains(&text)),
            named,
            "{warnings:?}"
        );
    }
}

/// Our CSV states its number of samples; files without it are read as before.
#[test]
fn csv_that_is_cut_off() {
    let (_, plain) = text_of("pounding_csv");
    let record = read_bytes("f", plain.as_bytes(), &ReadOptions::default()).unwrap();
    let text = write_pounding_csv(&Written::of(&record)).unwrap();
    assert!(text.contains("\n# Samples: 23\n"), "{text}");
    let cut = text[..text.trim_end().rfind('\n').unwrap()].to_owned() + "\n";
    let error = read(&cut, &ReadOptions::default()).unwrap_err();
    assert!(
        matches!(
            error,
            GroundMotionError::TooFewSamples {
                expected: 23,
                found: 22,
                ..
            }
        ),
        "{error}"
    );
    let taken = read(&cut, &lenient(&ReadOptions::default())).unwrap();
    assert_eq!(taken.series[0].samples.len(), 22);
    // Words of others behind the key.
    let words = plain.replace("# dt", "# Samples: by hand\n# dt");
    read(&words, &ReadOptions::default()).unwrap();
}

#[test]
fn midas_without_its_end() {
    let (fixture, text) = text_of("midas_sgs");
    let cut = text.replace("*ENDDATA\n", "");
    let last = cut.lines().last().unwrap().to_owned();
    refused(&cut, &fixture.options, &last, &["ends without *ENDDATA"]);
}

#[test]
fn blank_rows_of_jma() {
    let (fixture, text) = text_of("jma_csv");
    let lines: Vec<&str> = text.lines().collect();
    let with_blank = |at: usize| [&lines[..at], &[""], &lines[at..]].concat().join("\n");
    let error = read(&with_blank(12), &fixture.options)
        .unwrap_err()
        .to_string();
    assert!(error.starts_with("f:13:1: a blank row"), "{error}");
    for at in [7, lines.len()] {
        read(&with_blank(at), &fixture.options).unwrap();
    }
    let start = text.replace("2000 01 01 00 00 00", "");
    assert_eq!(
        read(&start, &fixture.options).unwrap().series[0]
            .origin
            .start_time,
        ""
    );
}

/// A Fortran format must take all numbers of a row, or say what stands behind them.
#[test]
fn numbers_behind_a_layout() {
    let rows = "  1.25000  2.25000  3.25000  4.25000\n".repeat(3);
    let with = |rows: &str, layout: &str| {
        let options = ReadOptions {
            unit: Some(AccelerationUnit::Gal),
            time_step: Some(0.01),
            layout: Some(layout.to_owned()),
            ..ReadOptions::default()
        };
        read(rows, &options).map_err(|e| format!("{e}; {}", e.help().unwrap()))
    };
    let error = with(&rows, "2F9.5").unwrap_err();
    for words in [
        "f:1:",
        "36 columns, of which the layout takes 18",
        "8F9.5,I7",
    ] {
        assert!(error.contains(words), "{error}");
    }
    for (layout, count) in [("4F9.5", 12), ("2F9.5,2F9.5", 6)] {
        assert_eq!(with(&rows, layout).unwrap().series[0].samples.len(), count);
    }
    // Numbers of cards.
    let cards = |by: usize| {
        let row = |i: usize| format!("  1.25000  2.25000{:>4}\n", 7 + by * i);
        (0..3).map(row).collect::<String>()
    };
    assert_eq!(with(&cards(1), "2F9.5").unwrap().series[0].samples.len(), 6);
    assert!(with(&cards(2), "2F9.5").is_err());
}

/// With a line too many in the header the last numbers of it are none of the data.
#[test]
fn a_header_of_bhrc_with_a_line_more() {
    let (fixture, text) = text_of("bhrc");
    let data: Vec<&str> = text.lines().collect();
    let last = 13 + 7 + 7;
    let row = data[last - 1];
    assert!(row.len() < 30, "{row}");
    let more = text.replacen(&format!("{row}\n"), &format!("{row}\n{row}\n"), 1);
    let error = read(&more, &fixture.options).unwrap_err().to_string();
    assert!(
        error.starts_with(&format!(
            "f:{}:1: the data start with a row of 2 numbers",
            last + 1
        )),
        "{error}"
    );
}

/// Blank lines before a header hide no format.
#[test]
fn blank_lines_before_a_header() {
    for fixture in all(0) {
        if ["mini_seed_2", "sac"].contains(&fixture.format) {
            continue;
        }
        let read = |bytes: &[u8]| {
            let read = read_all_bytes("f", bytes, &fixture.options);
            read.unwrap_or_else(|e| panic!("{}: {e}", fixture.name))
                .series
        };
        let behind = read(&[b"\n  \r\n", &fixture.bytes[..]].concat());
        for (a, b) in read(&fixture.bytes).iter().zip(&behind) {
            assert_eq!(b.origin.format, fixture.format, "{}", fixture.name);
            assert_eq!((&a.samples, &a.component), (&b.samples, &b.component));
        }
    }
    // Lines keep their numbers.
    let (fixture, text) = text_of("dyna");
    let wrong = text.replace("UNITS: cm/s^2", "UNITS: furlongs");
    let error = read(&format!("\n\n{wrong}"), &fixture.options).unwrap_err();
    let shown = error.to_string();
    assert!(shown.starts_with("f:12:"), "{shown}");
}

/// A record that says it has no samples, but holds data, is not passed over in silence.
#[test]
fn records_of_mini_seed_without_samples() {
    let options = ReadOptions {
        sensitivity: Some(SENSITIVITY),
        ..ReadOptions::default()
    };
    let make = |channel: &[u8; 3], encoding: u8, start: u32, count: u16, data: Vec<u8>| {
        record(&Seed {
            channel,
            encoding,
            big: true,
            start,
            count,
            data,
        })
    };
    let data = steim(&[1, 5, -3, 2], 1, true);
    let good = make(b"HNE", 10, 0, 4, data.clone());
    let emptied = make(b"HNE", 10, 400, 0, data);
    for (bytes, at) in [
        ([good.clone(), emptied.clone()].concat(), "byte 512"),
        ([emptied, good.clone()].concat(), "byte 0"),
    ] {
        let read = read_all_bytes("f", &bytes, &options).unwrap();
        let warnings = read.series[0].origin.warnings.join("; ");
        assert!(
            warnings.contains(at) && warnings.contains("no samples"),
            "{warnings}"
        );
        assert_eq!(read.series[0].samples.len(), 4);
    }
    // Logs and detections.
    let log = make(b"LOG", 0, 0, 0, b"clock locked".to_vec());
    let detection = make(b"HNE", 10, 0, 0, Vec::new());
    let read = read_all_bytes("f", &[log, detection, good].concat(), &options).unwrap();
    assert!(read.series[0].origin.warnings.is_empty());
}

/// Files that were packed, or saved in another encoding, are called what they are.
#[test]
fn files_that_are_no_text() {
    for (start, words, remedy) in [
        (&b"\x1f\x8b\x08\x00abc"[..], "compressed by gzip", "unpack"),
        (b"PK\x03\x04abc", "zip archive", "unpack"),
        (b"MS\x03\x04abc", "miniSEED 3", "miniSEED 2"),
        (b"\xff\xfe0\x00.\x001\x00\n\x00", "UTF-16", "UTF-8"),
    ] {
        let error = read_all_bytes("f", start, &ReadOptions::default()).unwrap_err();
        let shown = format!("{error}; {}", error.help().unwrap());
        assert!(shown.contains(words) && shown.contains(remedy), "{shown}");
    }
    let row = format!(
        "{:15.7}{:15.3}{:15.3}{:15.2}{:15.2}\n",
        0.01, -1.0, 1.0, -12345.0, -12345.0
    );
    let error = read(&row.repeat(14), &ReadOptions::default()).unwrap_err();
    assert!(error.to_string().contains("alphanumeric SAC"), "{error}");
}

/// Row numbers that pass for times of 1 s, beside the step that the user gives.
#[test]
fn row_numbers_beside_a_time_step() {
    let rows: String = (1..30).map(|i| format!("{i} 0.{}\n", i % 7)).collect();
    let mut options = ReadOptions {
        unit: Some(AccelerationUnit::Gal),
        time_step: Some(0.02),
        ..ReadOptions::default()
    };
    let error = read(&rows, &options).unwrap_err();
    let shown = format!("{error}; {}", error.help().unwrap());
    for words in ["f:1:1: column 1 increases by 1", "--layout \"-,a\""] {
        assert!(shown.contains(words), "{shown}");
    }
    options.layout = Some("-,a".to_owned());
    assert_eq!(read(&rows, &options).unwrap().series[0].samples.len(), 29);
}

/// The step in double precision behind the data of SAC 7.
#[test]
fn two_steps_of_sac() {
    let with = |step: f64| {
        let mut bytes = sac_with(&[], &[(76, 7)], "HNE");
        bytes.extend(step.to_le_bytes());
        bytes.extend((-12345.0_f64).to_le_bytes().repeat(21));
        let unit = ReadOptions {
            unit: Some(AccelerationUnit::Gal),
            ..ReadOptions::default()
        };
        read_all_bytes("f", &bytes, &unit)
    };
    with(0.01).unwrap();
    with(-12345.0).unwrap();
    let error = with(0.02).unwrap_err().to_string();
    assert!(error.contains("0.02 s here, but 0.01 s"), "{error}");
}

/// As many samples as the doubles behind the data would be, 44: those are no samples.
#[test]
fn samples_of_sac_that_are_its_footer() {
    let of = |count: i32, footer: bool| {
        let mut bytes = sac_with(&[], &[(76, 7), (79, count)], "HNE");
        if footer {
            bytes.extend(0.01_f64.to_le_bytes());
            bytes.extend((-12345.0_f64).to_le_bytes().repeat(21));
        }
        let unit = ReadOptions {
            unit: Some(AccelerationUnit::Gal),
            ..ReadOptions::default()
        };
        read_all_bytes("f", &bytes, &unit).map(|r| r.series[0].samples.len())
    };
    assert_eq!(of(23, true).unwrap(), 23);
    assert_eq!(of(23, false).unwrap(), 23);
    let error = of(23 + 44, true).unwrap_err().to_string();
    assert!(
        error.contains("says 67 samples, the file holds 23"),
        "{error}"
    );
}

/// Files of miniSEED are filled up to whole blocks; between records nothing is passed over.
#[test]
fn blocks_behind_the_last_record_of_mini_seed() {
    for fixture in fixtures("mini_seed_2", 0) {
        let plain = read_all_bytes("f", &fixture.bytes, &fixture.options).unwrap();
        for (filler, what) in [(0, "zeros"), (b' ', "blanks")] {
            let mut bytes = fixture.bytes.clone();
            bytes.extend([filler; 512]);
            let found = read_all_bytes("f", &bytes, &fixture.options).unwrap();
            assert_eq!(found.series[0].samples, plain.series[0].samples);
            let said = format!("the last 512 bytes are all {what} and were passed over");
            let warnings = &found.series[0].origin.warnings;
            assert!(warnings.iter().any(|w| w.contains(&said)), "{warnings:?}");
            bytes.extend(&fixture.bytes);
            let said = read_all_bytes("f", &bytes, &fixture.options).unwrap_err();
            assert!(
                said.to_string().contains("no miniSEED record starts here"),
                "{said}"
            );
        }
    }
}

/// A second that is inserted is no overlap: the flags of the record over which it falls name it (SEED
/// manual 2.4, fixed header, field 12, bit 4). A recorder that has not been told goes on without it.
#[test]
fn leap_seconds_of_mini_seed() {
    let options = ReadOptions {
        sensitivity: Some(SENSITIVITY),
        ..ReadOptions::default()
    };
    // Two seconds a record, at 100 samples per second.
    let make = |start: u32, flags: u8| {
        let mut bytes = record(&Seed {
            channel: b"HNE",
            encoding: 1,
            big: true,
            start,
            count: 200,
            data: (0..200_i16)
                .flat_map(|i| (i % 9 - 4).to_be_bytes())
                .collect(),
        });
        bytes[36] |= flags;
        bytes
    };
    let read = |first: (u32, u8), second: u32| {
        let bytes = [make(first.0, first.1), make(second, 0)].concat();
        read_all_bytes("f", &bytes, &options)
    };
    const INSERTED: u8 = 0b1_0000;
    const LEFT_OUT: u8 = 0b10_0000;
    for (first, second) in [
        ((0, 0), 20_000),
        ((0, INSERTED), 10_000),
        ((0, INSERTED), 20_000),
        ((0, LEFT_OUT), 30_000),
    ] {
        let found = read(first, second).unwrap();
        assert_eq!(found.series[0].samples.len(), 400, "{first:?} {second}");
        let warnings = &found.series[0].origin.warnings;
        assert!(warnings.is_empty(), "{first:?} {second}: {warnings:?}");
    }
    for (first, second) in [((0, 0), 10_000), ((0, INSERTED), 30_000)] {
        let error = read(first, second).unwrap_err().to_string();
        assert!(
            error.contains("an overlap of 1.0000 s") || error.contains("a gap of 1.0000 s"),
            "{error}"
        );
    }
}

/// Encodings that are not read are named, and called no damage.
#[test]
fn encodings_of_mini_seed_that_are_not_read() {
    for (encoding, name) in [(0, "text"), (13, "GEOSCOPE"), (30, "SRO"), (99, "99")] {
        let bytes = record(&Seed {
            channel: b"HNE",
            encoding,
            big: true,
            start: 0,
            count: 4,
            data: vec![1; 64],
        });
        let options = ReadOptions {
            sensitivity: Some(SENSITIVITY),
            ..ReadOptions::default()
        };
        let error = read_bytes("f", &bytes, &options).unwrap_err();
        let told = error.to_string();
        assert!(told.contains("byte 0") && told.contains(name), "{told}");
        assert!(error.help().unwrap().contains("Steim-2"));
    }
}

/// Data behind the samples that a header counts are not passed over in silence.
#[test]
fn more_samples_than_the_header_of_mini_seed_counts() {
    let options = ReadOptions {
        sensitivity: Some(SENSITIVITY),
        ..ReadOptions::default()
    };
    // Twelve differences in three words.
    let packed = steim(&[1, 5, -3, 2, 4, -1, 2, 3, -2, 5, 1, 4], 1, true);
    for (encoding, data, all, fewer) in [
        (
            3,
            [7_i32; 12].map(i32::to_be_bytes).concat(),
            12_u16,
            10_u16,
        ),
        (10, packed, 12, 4),
    ] {
        for count in [all, fewer] {
            let mut data = data.clone();
            if encoding == 10 && count == fewer {
                // The last sample of those that are counted.
                data[8..12].copy_from_slice(&2_i32.to_be_bytes());
            }
            let bytes = record(&Seed {
                channel: b"HNE",
                encoding,
                big: true,
                start: 0,
                count,
                data,
            });
            let found = read_all_bytes("f", &bytes, &options).unwrap();
            let series = &found.series[0];
            assert_eq!(series.samples.len(), usize::from(count));
            let told = series.origin.warnings.join("; ");
            assert_eq!(
                told.contains("data stand behind the"),
                count == fewer,
                "{told}"
            );
        }
    }
}
