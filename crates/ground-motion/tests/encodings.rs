//! Texts in characters of two and four bytes, in UTF-8 and Latin-1, and numbers with a dash for the minus.
use pounding_ground_motion::writers::{Written, write_pounding_csv};
use pounding_ground_motion::{AccelerationUnit, ReadOptions, read_all_bytes, read_bytes};

use crate::common::fixtures;

const TEXT: &str = "time (s),acceleration (m/s2)\n0.00,0.1\n0.01,-0.2\n0.02,0.3\n0.03,0.1\n";

fn read(bytes: &[u8], options: &ReadOptions) -> Result<usize, String> {
    read_all_bytes("f", bytes, options)
        .map(|found| found.series[0].samples.len())
        .map_err(|e| format!("{e}; {}", e.help().unwrap_or_default()))
}

#[test]
fn wide_characters_are_called_what_they_are() {
    let strict = ReadOptions::default();
    assert_eq!(read(TEXT.as_bytes(), &strict), Ok(4));
    let wide = |width: usize, big: bool, mark: bool| -> Vec<u8> {
        let text = if mark {
            format!("\u{feff}{TEXT}")
        } else {
            TEXT.to_owned()
        };
        let bytes = |c: char| {
            let four = u32::from(c).to_be_bytes();
            let mut bytes = four[4 - width..].to_vec();
            if !big {
                bytes.reverse();
            }
            bytes
        };
        text.chars().flat_map(bytes).collect()
    };
    let columns = ReadOptions {
        format: Some(pounding_ground_motion::Format::find("plain_columns").unwrap()),
        ..ReadOptions::default()
    };
    for (width, name) in [(2, "UTF-16"), (4, "UTF-32")] {
        for big in [false, true] {
            for mark in [false, true] {
                for options in [&strict, &columns] {
                    let said = read(&wide(width, big, mark), options).unwrap_err();
                    let told = said.contains(&format!("the text is {name};"));
                    assert!(told && said.contains("UTF-8"), "{said}");
                }
            }
        }
    }
}

#[test]
fn dashes_for_the_minus() {
    let strict = ReadOptions::default();
    for (dash, name) in [("\u{2212}", "U+2212"), ("\u{2013}", "U+2013")] {
        let text = TEXT.replace('-', dash);
        let said = read(text.as_bytes(), &strict).unwrap_err();
        let told = said.contains(name) && said.contains("line 3") && said.contains("hyphen");
        assert!(told, "{said}");
    }
    // Where the format is found or given, at the number.
    let head: String = (0..40).map(|i| format!("0.{:02}\n", i % 7)).collect();
    let text = format!("{head}\u{2212}0.2\n0.1\n");
    let options = ReadOptions {
        unit: Some(AccelerationUnit::Gal),
        time_step: Some(0.01),
        ..ReadOptions::default()
    };
    let said = read(text.as_bytes(), &options).unwrap_err();
    let told = said.starts_with("f:41:1:") && said.contains("its sign is U+2212");
    assert!(told, "{said}");
    // A unit in a comment has one, too.
    let text = format!("# unit of the sensor: m s\u{2212}2\n{TEXT}");
    assert_eq!(read(text.as_bytes(), &strict), Ok(4));
}

/// Names are what they are in UTF-8 and in Latin-1, and stay so in what the program writes.
#[test]
fn names_in_utf_8_and_latin_1() {
    let name = "kuzey_güney";
    let text = format!(
        "# Event: Düzce, İzmit\n# Component: {name}\n# Note: Überschrift\ntime_s,acceleration_g\n0.00,0.1\n0.01,-0.2\n0.02,0.3\n"
    );
    let chosen = ReadOptions {
        component: Some(name.to_owned()),
        ..ReadOptions::default()
    };
    let mut bytes = text.into_bytes();
    for _ in 0..3 {
        let record = read_bytes("f", &bytes, &chosen).unwrap();
        let origin = record.origin().unwrap();
        assert_eq!((&*origin.component, &*origin.title), (name, "Düzce, İzmit"));
        bytes = write_pounding_csv(&Written::of(&record))
            .unwrap()
            .into_bytes();
    }
    // The same in Latin-1, as older programs write it.
    let latin: Vec<u8> = "# Component: kuzey_güney\ntime_s,acceleration_g\n0.00,0.1\n0.01,-0.2\n"
        .chars()
        .map(|c| u8::try_from(u32::from(c)).unwrap())
        .collect();
    read_bytes("f", &latin, &chosen).unwrap();
}

/// Columns of a header are bytes: letters of two of them before a number move nothing, and one that
/// lies on the edge of a field is whole.
#[test]
fn columns_behind_letters_of_two_bytes() {
    let fixture = fixtures("k_net", 0).remove(0);
    let text = String::from_utf8(fixture.bytes).unwrap();
    for (from, to) in [
        ("Station Code      XXX001", "Station Code      Señal-東京"),
        // The last letter of the key begins in its last column.
        ("Station Code      XXX001", "Station Code     éSeñal-東京"),
    ] {
        let other = text.replace(from, to);
        let found = read_all_bytes("f", other.as_bytes(), &fixture.options).unwrap();
        let origin = &found.series[0].origin;
        assert!(origin.title.starts_with("Señal-東京; "), "{}", origin.title);
        assert_eq!(
            found.series[0].samples.len(),
            fixture.truth[0].samples.len()
        );
    }
}

/// Formats of agencies show the letters of their texts as they are.
#[test]
fn titles_of_agencies_in_utf_8() {
    let text = "EVENT_NAME: Düzce\nSTATION_CODE: Bolu-İl\nSTREAM: HNE\nUNITS: cm/s^2\nDATA_TYPE: ACCELERATION\nSAMPLING_INTERVAL_S: 0.01\n0.1\n-0.2\n0.3\n";
    let at2 = "PEER\nİzmit, Değirmendere, 90\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS= 3, DT= .01 SEC\n .1 .2 .3\n";
    for (text, words) in [(text, "Düzce; Bolu-İl"), (at2, "İzmit, Değirmendere, 90")] {
        let found = read_all_bytes("f", text.as_bytes(), &ReadOptions::default()).unwrap();
        let title = &found.series[0].origin.title;
        assert!(title.contains(words), "{title}");
    }
    // And so do messages.
    let text = "# Azimuth: kuzeydoğu yönü\ntime_s,acceleration_g\n0.00,0.1\n0.01,-0.2\n";
    let found = read_all_bytes("f", text.as_bytes(), &ReadOptions::default()).unwrap();
    let said = |w: &String| w.contains("\"kuzeydoğu yönü\"");
    let warnings = &found.series[0].origin.warnings;
    assert!(warnings.iter().any(said), "{warnings:?}");
}
