//! Whether a file is one that a result was made of: by what it holds, wherever it lies by now, or by its name.

use std::fs::File;
use std::io::{Read, copy};
use std::path::Path;

use pounding_files::checksum::hexadecimal;
use sha2::{Digest, Sha256};

/// What a result says of the files that it was made of.
#[derive(Debug, Clone, Copy)]
pub struct Inputs<'r> {
    /// Texts of case and study.
    pub texts: &'r [&'r str],
    /// SHA-256 of the records, hexadecimal, among other words.
    pub records: &'r str,
}

impl Inputs<'_> {
    /// What the file at this path is, if it is one of them: `record`, or `case or study`, or, of one that has the name of
    /// a file in the texts, `file`: a record of one building, a history of forces, a matrix, whose content is not
    /// known. What is not there, is empty or cannot be read is none.
    #[must_use]
    pub fn holds(&self, path: &Path) -> Option<&'static str> {
        let file = || File::open(path).ok();
        let size = path
            .metadata()
            .ok()
            .filter(|m| m.is_file() && m.len() > 0)?
            .len();
        let as_long = self.texts.iter().filter(|text| text.len() as u64 == size);
        for text in as_long {
            let mut content = Vec::new();
            file()?.read_to_end(&mut content).ok()?;
            if content == text.as_bytes() {
                return Some("case or study");
            }
        }
        let mut hash = Sha256::new();
        copy(&mut file()?, &mut hash).ok()?;
        let digits = hexadecimal(&hash.finalize());
        let mut words = self.records.split_whitespace();
        if words.any(|word| word == digits) {
            return Some("record");
        }
        let name = path.file_name()?.to_str()?;
        self.texts
            .iter()
            .any(|text| names(text, name))
            .then_some("file")
    }
}

/// Whether a text holds the name of a file as a quoted word, or as the end of one behind its folders.
fn names(text: &str, name: &str) -> bool {
    text.match_indices(name).any(|(at, _)| {
        let (before, after) = (
            text[..at].chars().next_back(),
            text[at + name.len()..].chars().next(),
        );
        let quote = |c: Option<char>| matches!(c, Some('"' | '\''));
        // In JSON a quote may follow a backslash.
        (quote(after) || after == Some('\\'))
            && (quote(before) || matches!(before, Some('/' | '\\')))
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn inputs_are_known_by_what_they_hold() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str, text: &str| {
            let path = folder.path().join(name);
            std::fs::write(&path, text).unwrap();
            path
        };
        // SHA-256 of "abc" by FIPS 180-2, appendix B.1.
        let digits = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        let records = format!("{digits} first\nunreadable second");
        let inputs = Inputs {
            texts: &["title = 1", ""],
            records: &records,
        };
        assert_eq!(inputs.holds(&at("a", "abc")), Some("record"));
        assert_eq!(inputs.holds(&at("b", "title = 1")), Some("case or study"));
        // A history of forces is known by its name alone, wherever the case looks for it.
        let inputs = Inputs {
            texts: &["file = \"histories/push.csv\"", "file = 'own.csv'"],
            ..inputs
        };
        for (name, what) in [
            ("push.csv", Some("file")),
            ("own.csv", Some("file")),
            ("push.cs", None),
            ("ush.csv", None),
            ("histories", None),
        ] {
            assert_eq!(inputs.holds(&at(name, "1")), what, "{name}");
        }
        for other in ["title = 2", "abcd", ""] {
            assert_eq!(inputs.holds(&at("c", other)), None, "{other}");
        }
        assert_eq!(inputs.holds(folder.path()), None);
        assert_eq!(inputs.holds(&folder.path().join("none")), None);
    }
}
