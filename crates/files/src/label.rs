//! A line between the content of a result file and its checksum that says what the file is,
//! read without the library that parses the content.
//!
//! The line begins with [`START`] and holds a text of the file's owner. HDF5 says itself where
//! its content ends and ignores what follows. The checksum is that of the line too.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use crate::label_line::LONGEST;
pub use crate::label_line::START;
use crate::{checksum, input};

/// Appends a label to a file that is finished and closed, and has no checksum yet.
///
/// # Errors
/// What the operating system says, or a text of several lines or of 64 KiB.
pub fn append(path: &Path, text: &str) -> io::Result<()> {
    if text.contains('\n') || (START.len() + text.len()) as u64 >= LONGEST {
        return Err(io::Error::other("a label is one line of less than 64 KiB"));
    }
    let mut file = File::options().append(true).open(path)?;
    file.write_all(format!("{START}{text}\n").as_bytes())
}

/// The label of a file; `None` for one that has none or cannot be read. Whether the file is as
/// it was written is not looked at.
#[must_use]
pub fn read(path: &Path) -> Option<String> {
    let mut file = input::open(path).ok()?;
    let end = checksum::without_line(&mut file).ok()?;
    let start = end.saturating_sub(LONGEST);
    file.seek(SeekFrom::Start(start)).ok()?;
    let mut last = Vec::new();
    file.take(end - start).read_to_end(&mut last).ok()?;
    let line = last.strip_suffix(b"\n")?;
    let begin = START.as_bytes();
    let at = line.windows(begin.len()).rposition(|w| w == begin)?;
    let text = &line[at + begin.len()..];
    String::from_utf8(text.to_vec())
        .ok()
        .filter(|t| !t.contains('\n'))
}

/// A path as it is seen from the current folder, with `/` between its parts and without links:
/// the same for every way to write it.
#[must_use]
pub fn seen_from_here(path: &Path) -> String {
    let real = |path: &Path| {
        path.canonicalize()
            .unwrap_or_else(|_| std::path::absolute(path).unwrap_or_else(|_| path.to_owned()))
    };
    let (path, here) = (real(path), real(Path::new(".")));
    let shared = path
        .components()
        .zip(here.components())
        .take_while(|(a, b)| a == b)
        .count();
    if shared == 0 {
        return path.display().to_string();
    }
    let up = here.components().skip(shared).map(|_| "..".into());
    let down = path.components().skip(shared);
    let parts: Vec<PathBuf> = up.chain(down.map(|c| c.as_os_str().into())).collect();
    let parts: Vec<_> = parts.iter().map(|p| p.to_string_lossy()).collect();
    parts.join("/")
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn a_label_comes_back_with_and_without_checksum() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        for content in [&b""[..], b"content", b"x\npounding-label:1 inside\nmore"] {
            std::fs::write(&path, content).unwrap();
            assert_eq!(read(&path), None);
            append(&path, "{\"a\": \"\u{fc}\"}").unwrap();
            assert_eq!(read(&path).unwrap(), "{\"a\": \"\u{fc}\"}");
            checksum::append(&path).unwrap();
            assert_eq!(read(&path).unwrap(), "{\"a\": \"\u{fc}\"}");
        }
        assert!(append(&path, "two\nlines").is_err());
        assert_eq!(read(&folder.path().join("none")), None);
        assert_eq!(read(folder.path()), None);
    }

    #[test]
    fn a_path_has_one_name_from_here() {
        assert_eq!(seen_from_here(Path::new("src/lib.rs")), "src/lib.rs");
        assert_eq!(
            seen_from_here(Path::new("./src/../src/lib.rs")),
            "src/lib.rs"
        );
        let absolute = Path::new("src/lib.rs").canonicalize().unwrap();
        assert_eq!(seen_from_here(&absolute), "src/lib.rs");
        assert_eq!(seen_from_here(Path::new("..")), "..");
    }
}
