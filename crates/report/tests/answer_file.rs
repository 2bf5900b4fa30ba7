//! Files of answers: what is read is what was written, and what is not as it was written is refused.
use std::path::{Path, PathBuf};

use pounding_files::checksum::hexadecimal;
use pounding_report::page::{Inputs, Picture};
use pounding_report::{
    AnswerFileError, Answered, AnsweredCommand, Curve, Panel, Reference, figure_with_references,
};
use serde_json::{Value, json};
use sha2::{Digest, Sha256};

const HOSTILE: &str = "</script><img src=x onerror=alert(1)>\u{2028}& \"b\" 橋";

/// An answer with all that could be lost on the way: numbers without a short decimal form, places
/// that are not finite, names that look like markup.
fn answered() -> Answered {
    let curve = |name: &str| Curve {
        name: name.to_owned(),
        points: vec![
            (0.1 + 0.2, 1.0 / 3.0),
            (0.7, 2.0 / 3.0),
            (1.0, f64::NAN),
            (f64::INFINITY, 2.0),
            (5e-324, 1.797e308),
        ],
    };
    let panel = Panel {
        caption: HOSTILE.to_owned(),
        horizontal: "time (s)".to_owned(),
        curves: (0..9).map(|i| curve(&format!("{HOSTILE} {i}"))).collect(),
    };
    let reference = Reference {
        panel: 0,
        curve: curve("target"),
    };
    let chart = figure_with_references(&[panel.clone(), panel], &[reference]);
    Answered {
        command: AnsweredCommand::Gap,
        inputs: Inputs {
            title: HOSTILE.to_owned(),
            origin: vec!["gap".to_owned(), HOSTILE.to_owned()],
            warnings: vec![HOSTILE.to_owned()],
            facts: vec![("SHA-256".to_owned(), "ab".repeat(32))],
            listings: vec![("The case file".to_owned(), HOSTILE.to_owned())],
        },
        answer: json!({
            "gaps": [{ "name": HOSTILE, "adequate": false, "demand": [0.1 + 0.2, null] }],
            "records": [{ "name": HOSTILE, "factor": 1.0 / 3.0 }],
        }),
        figures: vec![Picture::of("spectra", HOSTILE, chart)],
    }
}

fn read(text: impl AsRef<[u8]>) -> Result<Answered, AnswerFileError> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("answer.json");
    std::fs::write(&path, text).unwrap();
    assert!(Answered::may_be(&path));
    Answered::read(&path)
}

#[test]
fn what_is_read_is_what_was_written() {
    let written = answered();
    let text = written.text();
    let again = read(&text).unwrap();
    assert_eq!(again.text(), text);
    assert_eq!(again.page(), written.page());
    assert!(written.page().contains("<polyline"), "the figure is drawn");
    // Another program may break its lines and order its keys.
    let content: Value = serde_json::from_str(&text).unwrap();
    let other = read(format!("{content:#}\n\n")).unwrap();
    assert_eq!(other.page(), written.page());
}

#[test]
fn what_it_holds_stands_where_a_reader_looks() {
    let written = answered();
    let content: Value = serde_json::from_str(&written.text()).unwrap();
    assert_eq!(content["schema"], "pounding answer");
    assert_eq!(content["schema_version"], 1);
    assert_eq!(content["command"], "gap");
    assert_eq!(content["pounding"], env!("CARGO_PKG_VERSION"));
    assert_eq!(content["answer"], written.answer);
    assert_eq!(content["inputs"]["listings"][0][1], HOSTILE);
}

/// A file that is cut, at whatever byte, says so with the place where it ends.
#[test]
fn cut_files() {
    let text = answered().text();
    for end in (2..text.trim_end().len()).step_by(61) {
        let error = read(&text.as_bytes()[..end]).unwrap_err();
        let told = error.to_string();
        // Of a character of several bytes a part is no text at all.
        let known = matches!(error, AnswerFileError::Truncated { .. })
            || matches!(error, AnswerFileError::NotJson { .. }) && !text.is_char_boundary(end);
        assert!(known && told.contains("answer.json"), "{end}: {told}");
        assert!(error.help().unwrap().contains("--output"), "{told}");
    }
    let told = read("{\"schema\": \"pounding answer\",\n \"inp").unwrap_err();
    assert!(told.to_string().contains("at line 2, column 5"), "{told}");
}

/// One character that is another one is seen, wherever it stands.
#[test]
fn changed_files() {
    let text = answered().text();
    let places: Vec<usize> = text.char_indices().map(|(i, _)| i).collect();
    for at in places.into_iter().step_by(37).skip(1) {
        let mut bytes = text.clone().into_bytes();
        if !bytes[at].is_ascii_alphanumeric() {
            continue;
        }
        bytes[at] = if bytes[at] == b'1' { b'2' } else { b'1' };
        assert!(read(&bytes).is_err(), "byte {at} of {text}");
    }
}

/// The text of a content that is none of ours, with the hash that it should have.
fn signed(mut content: Value) -> String {
    content.as_object_mut().unwrap().remove("sha256");
    let hash = hexadecimal(&Sha256::digest(content.to_string()));
    content["sha256"] = json!(hash);
    content.to_string()
}

#[test]
fn newer_and_foreign_files() {
    let told = |text: &str| {
        let error = read(text).unwrap_err();
        format!("{error}; {}", error.help().unwrap())
    };
    let content: Value = serde_json::from_str(&answered().text()).unwrap();
    let mut newer = content.clone();
    newer["schema_version"] = json!(2);
    newer["pounding"] = json!("9.1.0");
    newer["figures"] = json!("of another shape");
    let newer = told(&signed(newer));
    assert!(newer.contains("pounding 9.1.0 in version 2"), "{newer}");
    assert!(newer.contains("use pounding 9.1.0 or later"), "{newer}");
    for (text, word) in [
        ("{\"a\": 1}", "`schema` is not \"pounding answer\""),
        (
            "{\"gaps\": [], \"adequate\": true}",
            "what --json prints has neither inputs nor figures",
        ),
        (
            "{\"check\": \"ab\", \"shards\": 2}\n\u{1}\u{2}",
            "it is a shard of a check; merge all shards first",
        ),
        ("{\"a\": tru}", "is no JSON: expected"),
        ("{} {}", "something follows the end"),
    ] {
        let told = told(text);
        assert!(told.contains(word), "{told}");
    }
    let mut without = content;
    without.as_object_mut().unwrap().remove("figures");
    let told = told(&signed(without));
    assert!(told.contains("missing field `figures`"), "{told}");
}

/// What stands in a picture as it is cannot be markup.
#[test]
fn looks_are_no_markup() {
    let content: Value = serde_json::from_str(&answered().text()).unwrap();
    assert!(read(signed(content.clone())).is_ok());
    let look = "/figures/0/plots/0/series/0/look";
    for (key, value) in [
        ("colour", json!("\"/><script>alert(1)</script>")),
        ("colour", json!("red")),
        ("dash", json!("5\" onload=\"alert(1)")),
        ("width", json!(1e9)),
    ] {
        let mut other = content.clone();
        *other.pointer_mut(&format!("{look}/{key}")).unwrap() = value;
        let error = read(signed(other)).unwrap_err();
        assert!(matches!(error, AnswerFileError::Shape { .. }), "{error}");
    }
}

/// HDF5, an empty file, and none are for others to refuse.
#[test]
fn other_files_are_not_taken() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, content: &[u8]| -> PathBuf {
        let path = folder.path().join(name);
        std::fs::write(&path, content).unwrap();
        path
    };
    assert!(!Answered::may_be(&file("a", b"\x89HDF\r\n\x1a\n")));
    assert!(!Answered::may_be(&file("b", b"")));
    assert!(!Answered::may_be(Path::new("no such file")));
    assert!(Answered::may_be(&file("c", b"\n  {")));
}
