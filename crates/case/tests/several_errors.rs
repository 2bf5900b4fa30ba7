//! All that is wrong in one file is reported at once, each error at its place, and nothing
//! that only follows from another error.
use std::io::Write as _;
use std::path::Path;

use pounding_case::{Case, CaseError, read_text};

const CASE: &str = r#"title = "pair"
[[building]]
name = "a"
storeys = 2
mass = "25 t"
stiffness = "3.46 MN/m"
height = "3 m"
damping = { stiffness_proportional = 0.05 }
[[building]]
name = "b"
storeys = 2
mass = "100 t"
stiffness = "30 MN/m"
height = 3.0
damping = { ratio = 0.05, modes = [1, 2] }
[[gap]]
between = ["a", "b"]
width = "20 mm"
model = "anagnostopoulos_2004"
stiffness = "93.5 MN/m"
[ground_motion]
file = "record.csv"
[analysis]
duration = "2 s"
"#;

/// Every error of the case after some replacements: line, column, message.
fn errors(replaced: &[(&str, &str)]) -> Vec<(usize, usize, String)> {
    let mut source = CASE.to_owned();
    for (from, to) in replaced {
        assert!(source.contains(from), "{from}");
        source = source.replacen(from, to, 1);
    }
    let error = Case::parse(&source, Path::new("case.toml")).unwrap_err();
    let each: Vec<CaseError> = error.each().collect();
    assert!(each.iter().all(|e| e.others.is_empty() && e.help.is_some()));
    assert!(each.windows(2).all(|e| e[0].span.start <= e[1].span.start));
    each.into_iter()
        .map(|e| (e.line, e.column, e.message))
        .collect()
}

fn hold(replaced: &[(&str, &str)], expected: &[(usize, usize, &str)]) {
    let found = errors(replaced);
    assert_eq!(found.len(), expected.len(), "{found:#?}");
    for ((line, column, message), (l, c, says)) in found.iter().zip(expected) {
        assert_eq!((line, column), (l, c), "{found:#?}");
        assert!(message.contains(says), "{message} | {says}");
    }
}

#[test]
fn two_to_six_errors() {
    hold(
        &[("title", "titel"), ("\"2 s\"", "\"2 m\"")],
        &[(1, 1, "unknown key `titel`"), (24, 12, "must be a time")],
    );
    hold(
        &[
            ("\"25 t\"", "[\"25 t\", \"-1 t\"]"),
            ("\"3.46 MN/m\"", "\"3.46 MN\""),
            ("\"20 mm\"", "\"-20 mm\""),
        ],
        &[
            (5, 17, "greater than zero"),
            (6, 13, "must be a stiffness"),
            (18, 9, "zero or more"),
        ],
    );
    hold(
        &[
            ("\"25 t\"", "\"25 T\""),
            ("\"100 t\"", "true"),
            ("width = \"20 mm\"", "width = nan"),
            ("\"record.csv\"", "\"\""),
            ("duration", "stepp = 1\nduration"),
            ("\"2 s\"", "-2"),
        ],
        &[
            (5, 8, "mass"),
            (12, 8, "`mass` must be a number"),
            (18, 9, "not a finite number"),
            (22, 8, "`file` is empty"),
            (24, 1, "unknown key `stepp`"),
            (25, 12, "greater than zero"),
        ],
    );
    // Several wrong values of one list, several unknown keys of one table.
    hold(
        &[
            ("\"25 t\"", "[-1, 0]"),
            ("duration = \"2 s\"", "aa = 1\nbb = 2"),
        ],
        &[
            (5, 9, "greater than zero"),
            (5, 13, "greater than zero"),
            (24, 1, "unknown key `aa`"),
            (25, 1, "unknown key `bb`"),
        ],
    );
}

/// One mistake, one error: nothing that is only missing or contradictory because of it.
#[test]
fn nothing_follows_from_an_error() {
    for (from, to, line, column, says) in [
        // The key that is misspelt is not also missing.
        ("height", "hieght", 7, 1, "unknown key `hieght`"),
        ("width", "wdith", 18, 1, "unknown key `wdith`"),
        ("model", "modle", 19, 1, "unknown key `modle`"),
        ("between", "betwen", 17, 1, "unknown key `betwen`"),
        ("file", "fiel", 22, 1, "unknown key `fiel`"),
        ("storeys", "storey", 4, 1, "unknown key `storey`"),
        (
            "[ground_motion]",
            "[ground_motoin]",
            21,
            2,
            "unknown key `ground_motoin`",
        ),
        (
            "stiffness_proportional",
            "stiffness_proportinal",
            8,
            13,
            "unknown key",
        ),
        (
            "width",
            "level = [[1, 1]]\nwidth",
            18,
            1,
            "unknown key `level`",
        ),
        // A building that is wrong has a name nevertheless, and gaps find it.
        ("\"25 t\"", "\"25 kN\"", 5, 8, "must be a mass"),
        ("\"100 t\"", "[1, 2, 3]", 12, 8, "`storeys` says 2 storeys"),
        ("name = \"b\"", "nam = \"b\"", 10, 1, "unknown key `nam`"),
        ("name = \"b\"\n", "", 9, 1, "has no `name`"),
        ("\"b\"", "\"a\"", 10, 8, "given twice"),
        // One mistake of TOML.
        ("\"25 t\"", "25 t", 5, 8, "this is not TOML"),
        ("\"25 t\"", "\"25 t", 5, 13, "this is not TOML"),
        ("duration", "duration = 1\nduration", 25, 1, "given twice"),
    ] {
        hold(&[(from, to)], &[(line, column, says)]);
    }
}

/// Tables and keys that stand twice are named as they are written, with where the first one stands.
#[test]
fn what_stands_twice_is_named() {
    for (text, says) in [
        ("[analysis]\n[analysis]\n", "[analysis] stands twice"),
        (
            "[building]\n[[building]]\n",
            "[[building]] stands beside [building]",
        ),
        (
            "gap = { width = 1 }\n[[gap]]\n",
            "`gap` is given before, in another form",
        ),
        (
            "analysis.method = \"a\"\n[analysis]\n",
            "`analysis` is given before",
        ),
        (
            "[ground_motion.process] # one\n[ground_motion.process]\n",
            "[ground_motion.process] stands twice",
        ),
        ("a = [\n [ {b = 1, b = 2} ],\n]\n", "`b` is given twice"),
    ] {
        let error = Case::parse(text, Path::new("case.toml")).unwrap_err();
        let told: Vec<String> = error.each().map(|e| e.to_string()).collect();
        assert!(told.iter().any(|t| t.contains(says)), "{text}: {told:?}");
    }
}

#[test]
fn several_mistakes_of_toml() {
    hold(
        &[
            ("\"25 t\"", "25 t"),
            ("\"30 MN/m\"", "30 MN/m"),
            ("\"2 s\"", ""),
        ],
        &[
            (5, 8, "this is not TOML"),
            (13, 13, "this is not TOML"),
            (24, 12, "this is not TOML"),
        ],
    );
}

/// What is not in UTF-8 is named with the place of its first byte.
#[test]
fn encodings() {
    let folder = std::env::temp_dir().join(format!("pounding_encodings_{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join("case.toml");
    let read = |bytes: &[u8]| {
        std::fs::File::create(&path)
            .unwrap()
            .write_all(bytes)
            .unwrap();
        read_text(&path, "case")
    };
    let utf_16 = |text: &str, mark: bool, big: bool| -> Vec<u8> {
        let units = mark
            .then_some(0xfeff)
            .into_iter()
            .chain(text.encode_utf16());
        units
            .flat_map(|u| {
                if big {
                    u.to_be_bytes()
                } else {
                    u.to_le_bytes()
                }
            })
            .collect()
    };
    let latin_1 = |text: &str| -> Vec<u8> { text.chars().map(|c| c as u8).collect() };
    for (bytes, line, column, says) in [
        (latin_1("a = 1\ntitle = \"Gebäude\"\n"), 2, 13, "Latin-1"),
        (latin_1("# °\n"), 1, 3, "\"°\""),
        (utf_16("title = 1\n", true, false), 1, 1, "UTF-16"),
        (utf_16("title = 1\n", true, true), 1, 1, "UTF-16"),
        (utf_16("title = 1\n", false, false), 1, 1, "UTF-16"),
        (utf_16("title = 1\n", false, true), 1, 1, "UTF-16"),
        (b"title = \"a\"\nx\0y\n".to_vec(), 2, 2, "0x00"),
        (
            [b"\x89HDF\r\n\x1a\n".as_slice(), &[0; 40]].concat(),
            1,
            1,
            "HDF5",
        ),
    ] {
        let error = read(&bytes).unwrap_err();
        assert_eq!((error.line, error.column), (line, column), "{error}");
        assert!(error.message.contains(says), "{error}");
        assert!(error.help.unwrap().contains(match says {
            "0x00" => "byte",
            "HDF5" => "TOML",
            _ => "UTF-8",
        }));
    }
    assert_eq!(
        read("\u{feff}title = \"ä\"\n".as_bytes()).unwrap(),
        "\u{feff}title = \"ä\"\n"
    );
    let unread = read_text(&folder, "case").unwrap_err();
    // It has no line, and none is told.
    let place = format!("{}: cannot read the case file: ", folder.display());
    assert!(unread.to_string().starts_with(&place), "{unread}");
    std::fs::remove_dir_all(&folder).unwrap();
}
