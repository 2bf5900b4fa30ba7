//! Texts in characters of two and four bytes, and numbers with a dash for the minus.
#![allow(clippy::unwrap_used)]

use pounding_ground_motion::{AccelerationUnit, ReadOptions, read_all_bytes};

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
