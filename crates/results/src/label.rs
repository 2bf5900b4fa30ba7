//! What a result is, as its label says: known before anybody parses it, and so of any file, be
//! it damaged or made to look like a result.

use std::io::Read;
use std::path::Path;

use serde_json::{Value, json};

use crate::part::{MOST_SHARDS, Part, numbers};

/// What a result holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// One run.
    Run,
    /// The runs of a study, or of shards of it.
    Study,
}

impl Kind {
    const RUN: &str = "run";
    pub(crate) const STUDY: &str = "study";
}

impl std::fmt::Display for Kind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Run => "a run",
            Self::Study => "a study",
        })
    }
}

/// What a file says that it is, true or not.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Label {
    /// What it holds.
    pub kind: Kind,
    /// The case or study file, as seen from the folder in which the program was called; empty if
    /// it does not say so.
    pub file: String,
    /// SHA-256 of the text of a case that was read from no file.
    pub case_sha256: Option<String>,
    /// Of which study.
    pub study: Option<OfStudy>,
    /// Whether it has a label: another program that opens a file for writing takes it away, and early versions wrote none.
    pub is_labelled: bool,
}

/// Which runs of which study a result says that it holds.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OfStudy {
    /// Identity of the study.
    pub sha256: String,
    /// SHA-256 of the text of the study.
    pub text_sha256: String,
    /// Shards of it.
    pub part: Part,
    /// What computed them.
    pub build: String,
}

/// The label of the result of a run.
pub(crate) fn of_run(file: &str) -> String {
    json!({"result": Kind::RUN, "file": file}).to_string()
}

/// The label of the result of a run whose case was read from no file, by the SHA-256 of its text.
pub(crate) fn of_run_without_file(case_sha256: &str) -> String {
    json!({"result": Kind::RUN, "file": "", "case_sha256": case_sha256}).to_string()
}

impl Label {
    /// What a file says that it is; `None` if it does not look like a result.
    #[must_use]
    pub fn of(path: &Path) -> Option<Self> {
        match pounding_files::label::read(path) {
            Some(text) => Self::parse(&text),
            None => unlabelled(path),
        }
    }

    fn parse(text: &str) -> Option<Self> {
        let label: Value = serde_json::from_str(text).ok()?;
        let kind = match label["result"].as_str()? {
            Kind::RUN => Kind::Run,
            Kind::STUDY => Kind::Study,
            _ => return None,
        };
        let study = || {
            let of = usize::try_from(label["of"].as_u64()?).ok()?;
            if of > MOST_SHARDS {
                return None;
            }
            let part = Part::of(numbers(label["shards"].as_str()?, of)?, of)?;
            Some(OfStudy {
                sha256: label["study_sha256"].as_str()?.to_owned(),
                text_sha256: label["text_sha256"].as_str()?.to_owned(),
                part,
                build: label["build"].as_str()?.to_owned(),
            })
        };
        Some(Self {
            kind,
            file: label["file"].as_str()?.to_owned(),
            case_sha256: label["case_sha256"].as_str().map(str::to_owned),
            study: study(),
            is_labelled: true,
        })
    }
}

/// Names of attributes that results of either kind alone have, as HDF5 writes them.
const OF_RUNS: &[u8] = b"case_sha256\0";
const OF_STUDIES: &[u8] = b"study_sha256\0";
/// Versions before labels wrote the attributes of the file here.
const HEAD: u64 = 1 << 20;

/// The kind of a result without a label, by the names of its attributes.
fn unlabelled(path: &Path) -> Option<Label> {
    let file = pounding_files::input::open(path).ok()?;
    let mut head = Vec::new();
    file.take(HEAD).read_to_end(&mut head).ok()?;
    let has = |name: &[u8]| head.windows(name.len()).any(|w| w == name);
    if !head.starts_with(b"\x89HDF\r\n\x1a\n") {
        return None;
    }
    let kind = if has(OF_STUDIES) {
        Kind::Study
    } else if has(OF_RUNS) {
        Kind::Run
    } else {
        return None;
    };
    Some(Label {
        kind,
        file: String::new(),
        case_sha256: None,
        study: None,
        is_labelled: false,
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn a_result_says_what_it_is() {
        let run = Label::parse(&of_run("a/case.toml")).unwrap();
        assert_eq!(run.kind, Kind::Run);
        assert_eq!(run.file, "a/case.toml");
        assert_eq!(run.case_sha256, None);
        let made = Label::parse(&of_run_without_file("ab")).unwrap();
        assert_eq!((&*made.file, made.case_sha256.as_deref()), ("", Some("ab")));
        let study = json!({
            "result": "study", "file": "s", "study_sha256": "1", "shards": "2-3", "of": 4,
            "build": "b", "text_sha256": "2",
        });
        let of = OfStudy {
            sha256: "1".to_owned(),
            text_sha256: "2".to_owned(),
            part: Part::of(vec![2, 3], 4).unwrap(),
            build: "b".to_owned(),
        };
        assert_eq!(Label::parse(&study.to_string()).unwrap().study, Some(of));
        for text in ["", "{}", "[]", r#"{"result": 1}"#, r#"{"result": "x"}"#] {
            assert_eq!(Label::parse(text), None);
        }
        // Numbers that cannot be are none.
        for (shards, of) in [
            ("1", u64::MAX),
            ("5", 4),
            ("", 4),
            ("1-4294967295", 4_294_967_295),
        ] {
            let text = json!({
                "result": "study", "file": "", "study_sha256": "1", "shards": shards, "of": of, "build": "",
                "text_sha256": "",
            });
            let label = Label::parse(&text.to_string());
            assert_eq!(label.unwrap().study, None, "{text}");
        }
    }
}
