//! Opening what is read: a regular file. A device or a pipe may never end, and a pipe that nobody
//! writes into never begins.

use std::fs::File;
use std::io::{Error, Read, Result};
use std::path::Path;

/// Opens a regular file.
///
/// # Errors
/// What the operating system says; a folder, a device or a pipe.
pub fn open(path: &Path) -> Result<File> {
    let found = std::fs::metadata(path)?;
    if found.is_dir() {
        return Err(Error::other("this is a folder, not a file"));
    }
    if !found.is_file() {
        return Err(Error::other("this is no regular file"));
    }
    File::open(path)
}

/// The bytes of a regular file.
///
/// # Errors
/// As [`open`].
pub fn read(path: &Path) -> Result<Vec<u8>> {
    let mut file = open(path)?;
    let size = file.metadata().map_or(0, |m| m.len());
    let mut bytes = Vec::with_capacity(usize::try_from(size).unwrap_or(0));
    file.read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// The text of a regular file.
///
/// # Errors
/// As [`open`], and what is not in UTF-8.
pub fn read_to_string(path: &Path) -> Result<String> {
    let mut text = String::new();
    open(path)?.read_to_string(&mut text)?;
    Ok(text)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn files_are_read() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        std::fs::write(&path, "text").unwrap();
        assert_eq!(read(&path).unwrap(), b"text");
        assert_eq!(read_to_string(&path).unwrap(), "text");
        let told = |path: &Path| open(path).unwrap_err().to_string();
        assert_eq!(told(folder.path()), "this is a folder, not a file");
        #[cfg(unix)]
        assert_eq!(told(Path::new("/dev/zero")), "this is no regular file");
    }
}
