//! What raw files of COSMOS say of their instruments, against itself.
use pounding_ground_motion::{ReadOptions, Recording, read_all_bytes};

use crate::common::fixtures;

/// The fixture's first channel, of counts, with other reals (1 to 100) and a line in words.
fn text(changes: &[(usize, f64)], words: &str) -> String {
    let fixture = fixtures("cosmos", 0)
        .into_iter()
        .find(|f| f.name == "cosmos_raw")
        .unwrap();
    let text = String::from_utf8(fixture.bytes).unwrap();
    let end = text.find("End-of-data for Chan 1\n").unwrap();
    let mut lines: Vec<String> = text[..end].lines().map(str::to_owned).collect();
    let first = lines
        .iter()
        .position(|l| l.contains("Real-header"))
        .unwrap()
        + 1;
    for (index, value) in changes {
        let (row, column) = ((index - 1) / 5, (index - 1) % 5 * 15);
        lines[first + row].replace_range(column..column + 15, &format!("{value:15.6}"));
    }
    words.clone_into(&mut lines[8]);
    lines.join("\n") + "\nEnd-of-data for Chan 1\n"
}

fn read(text: &str, lenient: bool) -> Result<Recording, String> {
    let options = ReadOptions {
        lenient,
        ..ReadOptions::default()
    };
    read_all_bytes("f", text.as_bytes(), &options).map_err(|e| e.to_string())
}

const WORDS: &str = "Sta Chan   1: 90 Deg (Rcrdr Chan  1)";

/// 1.25 V/g is that of the fixture.
#[test]
fn sensitivity_against_the_full_scale() {
    for (output, scale) in [(2.5, 2.0), (2.6, 2.0), (2.5, -999.0), (2.5, 0.0)] {
        let text = text(&[(43, output), (44, scale)], WORDS);
        let found = read(&text, false).unwrap();
        assert!(found.series[0].origin.warnings.is_empty());
    }
    // Both lines of the sensor, or one.
    for output in [5.0, 1.25] {
        let found = read(&text(&[(43, output), (44, 2.0)], WORDS), false).unwrap();
        let warnings = &found.series[0].origin.warnings;
        assert!(
            warnings[0].contains("the sensor gives 1.25 V/g"),
            "{warnings:?}"
        );
    }
    let text = text(&[(43, 25.0), (44, 2.0)], WORDS);
    let said = read(&text, false).unwrap_err();
    let expected = "the sensor gives 1.25 V/g (real 42), but 25 V at 2 g";
    assert!(
        said.contains(expected) && said.contains("12.5 V/g"),
        "{said}"
    );
    let left = read(&text, true).unwrap();
    let warnings = &left.series[0].origin.warnings;
    assert!(
        warnings.iter().any(|w| w.contains(expected)),
        "{warnings:?}"
    );
}

#[test]
fn negative_factors_are_said() {
    let plain = read(&text(&[], WORDS), false).unwrap();
    for (index, value) in [(22, -0.298), (42, -1.25), (47, -2.0)] {
        let found = read(&text(&[(index, value)], WORDS), false).unwrap();
        let one = &found.series[0];
        let said = format!("real {index} is negative, {value}: the samples have the opposite sign");
        let warnings = &one.origin.warnings;
        assert!(warnings.iter().any(|w| w.contains(&said)), "{warnings:?}");
        assert_eq!(one.samples[3], -plain.series[0].samples[3]);
    }
}

#[test]
fn units_in_words_and_by_their_codes() {
    let plain = text(&[], WORDS);
    for other in ["mV", "V", "g", "cm/sec2"] {
        let text = plain.replacen("units= counts(50)", &format!("units= {other}(50)"), 1);
        let said = read(&text, true).unwrap_err();
        assert!(
            said.contains("in words here, but counts by its code 50"),
            "{said}"
        );
    }
}

#[test]
fn azimuths_beyond_a_turn() {
    for words in ["900 Deg", "-90 Deg"] {
        let text = text(&[], &WORDS.replace(" 90 Deg", words));
        let said = read(&text, false).unwrap_err();
        let told = said.starts_with("f:9:1:") && said.contains(&format!("is \"{words}\""));
        assert!(told, "{said}");
        // That of the numbers is left.
        assert_eq!(read(&text, true).unwrap().series[0].component, "90 deg");
    }
}
