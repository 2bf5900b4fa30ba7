//! Directions that the header of a volume states twice.
use pounding_ground_motion::{ReadOptions, Recording, read_all_bytes};

use crate::common::fixtures;

/// The first channel of a fixture alone, as text.
fn text(format: &'static str, name: &str) -> String {
    let fixture = fixtures(format, 0)
        .into_iter()
        .find(|f| f.name == name)
        .unwrap();
    String::from_utf8(fixture.bytes).unwrap()
}

fn read(text: &str, lenient: bool) -> Result<Recording, String> {
    let options = ReadOptions {
        lenient,
        ..ReadOptions::default()
    };
    read_all_bytes("f", text.as_bytes(), &options).map_err(|e| e.to_string())
}

/// A line (from 1) with other characters from a column on.
fn with(text: &str, line: usize, column: usize, field: &str) -> String {
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    lines[line - 1].replace_range(column..column + field.len(), field);
    lines.join("\n") + "\n"
}

#[track_caller]
fn refused(text: &str, expected: &str, first: &str) {
    let said = read(text, false).unwrap_err();
    assert!(said.contains(expected), "{said}");
    let left = read(text, true).unwrap();
    let one = &left.series[0];
    assert_eq!(one.component, first);
    let warned = |w: &String| w.contains("the component is");
    assert!(one.origin.warnings.iter().any(warned), "{:?}", one.origin);
}

#[test]
fn lines_of_volume_2() {
    let plain = text("csmip_v2", "csmip_v2");
    for other in [" 90 Deg", " Up    "] {
        let own = "Chan  1: 180 Deg";
        let changed = format!("Chan  1: {}", other.trim());
        let (head, tail) = plain.split_once("\nRcrd").unwrap();
        // The first line, and the eighth.
        let first = head.replacen(own, &changed, 1) + "\nRcrd" + tail;
        let eighth = head.to_owned() + "\nRcrd" + &tail.replacen(own, &changed, 1);
        let name = other.trim().replace("Deg", "deg");
        refused(
            &first,
            &format!("f:8:1: the component is \"180 deg\" here, but \"{name}\" in line 1"),
            &name,
        );
        let expected =
            format!("f:8:1: the component is \"{name}\" here, but \"180 deg\" in line 1");
        refused(&eighth, &expected, "180 deg");
        // The line before the numbers repeats it.
        let mut lines: Vec<&str> = plain.lines().collect();
        let last = format!("00000-N0000   Nowhere: 1 Blvd.    {changed}");
        lines[23] = &last;
        let text = lines.join("\n") + "\n";
        refused(&text, "f:24:1: the component is", "180 deg");
    }
    let caltech = text("caltech_volume_2", "caltech_volume_2");
    let changed = caltech.replacen("\nCOMP S90W", "\nCOMP S00E", 1);
    let expected = "f:8:1: the component is \"S00E\" here, but \"S90W\" in line 1";
    refused(&changed, expected, "S90W");
}

#[test]
fn azimuths_in_integers() {
    let plain = text("csmip_v1", "csmip_v1_spaced");
    let at = |field: &str| with(&plain, 15, 50, field);
    assert!(read(&at("   90"), false).is_ok());
    for says_nothing in ["    0", " -999", "  777", "     "] {
        assert!(read(&at(says_nothing), false).is_ok(), "{says_nothing}");
    }
    for (other, shown) in [("  180", "180 degrees"), ("  500", "Up")] {
        let expected = format!(
            "f:7:1: the component is \"90 deg\" here, but {shown} by integer 27 in line 15"
        );
        refused(&at(other), &expected, "90 deg");
    }
    for name in ["geo_net_v1a", "geo_net_v2a"] {
        let plain = text("geo_net", name);
        let at = |field: &str| with(&plain, 19, 56, field);
        assert!(read(&at("      10"), false).is_ok());
        let expected =
            "f:13:1: the component is \"N10E\" here, but 280 degrees by integer 28 in line 19";
        refused(&at("     280"), expected, "N10E");
    }
}
