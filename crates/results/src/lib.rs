//! Result files in HDF5, of runs and of studies: what stands in them, written and read.
//!
//! [`ResultFile::open`] is the only way to a result file: the checksum at its end is
//! compared before the HDF5 library sees the file. What is then read has the type that was
//! written and a size that is stored, or is an error: of a file without checksum, a
//! damaged type or a lost piece would otherwise be read as zeros. [`Label`] says what a file is
//! without the library, and [`watch`] who is told while the library is at work.

mod attributes;
mod chunks;
pub mod dimension_scales;
mod hdf5_file;
mod inputs;
mod label;
mod part;
mod run;
pub mod study;
mod values;
pub mod watch;

use std::path::Path;

use pounding_files::checksum::{Checksum, ChecksumError, WithoutChecksum, check};

pub use inputs::Inputs;
pub use label::{Kind, Label, OfStudy};
pub use run::{
    MAXIMUM_RESPONSES, ResponsesTooLarge, RunEnding, RunHead, RunWriter, WriteError, check_size,
    image, response_bytes, run_in_memory, write_run,
};
pub use values::{dataset, number, read_all, text, texts, value, values};

/// Name of the root attribute of a file that was written with a checksum.
pub const CHECKSUM: &str = "checksum";
/// Its value: what the last line of the file is.
pub const CHECKSUM_FORM: &str = "pounding-sha256:1, SHA-256 of all bytes before the last line";

/// A result file that was whole when it was opened, or has no checksum.
#[derive(Debug)]
pub struct ResultFile {
    file: hdf5::File,
    checksum: Checksum,
    stamp: Stamp,
}

/// What tells whether a file has changed since its checksum was compared.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Stamp {
    checksum: Checksum,
    bytes: u64,
    changed: Option<std::time::SystemTime>,
}

impl Stamp {
    fn of(path: &Path, checksum: Checksum) -> std::io::Result<Self> {
        let found = std::fs::metadata(path)?;
        Ok(Self {
            checksum,
            bytes: found.len(),
            // Where the file system has no times, the length decides.
            changed: found.modified().ok(),
        })
    }

    /// What the checksum said.
    pub(crate) fn checksum(&self) -> Checksum {
        self.checksum
    }

    /// Opens the file without comparing its content anew.
    pub(crate) fn open_again(&self, path: &Path) -> Result<ResultFile, OpenError> {
        let now = Self::of(path, self.checksum).map_err(ChecksumError::Read)?;
        if now != *self {
            return Err(OpenError::Changed);
        }
        let file = hdf5_file::open(path).map_err(|e| OpenError::Hdf5(reason_of(&e)))?;
        Ok(ResultFile {
            file,
            checksum: self.checksum,
            stamp: now,
        })
    }
}

/// Why a result file cannot be opened.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum OpenError {
    /// The operating system, or the checksum.
    #[error(transparent)]
    Checksum(#[from] ChecksumError),
    /// HDF5.
    #[error("HDF5 cannot open it: {0}")]
    Hdf5(String),
    /// Another process has written it while it was read.
    #[error("it was changed while it was being read")]
    Changed,
}

impl OpenError {
    /// What to do about it; `None` where that depends on what the file was to be.
    #[must_use]
    pub fn help(&self) -> Option<&'static str> {
        match self {
            Self::Checksum(error) => error.help(),
            Self::Hdf5(_) => None,
            Self::Changed => Some("wait until nobody writes it any more, and begin again"),
        }
    }
}

impl ResultFile {
    /// Opens a file after its checksum was compared. A file of a version of the program
    /// that wrote none is opened only if that is accepted.
    ///
    /// # Errors
    /// [`OpenError`].
    pub fn open(path: &Path, without: WithoutChecksum) -> Result<Self, OpenError> {
        // Before the content is read: what is written meanwhile is seen by it.
        let before = Stamp::of(path, Checksum::Matches).map_err(ChecksumError::Read)?;
        let checksum = check(path, without)?;
        let file = hdf5_file::open(path).map_err(|e| OpenError::Hdf5(reason_of(&e)))?;
        // Cut off right where its content ends, a file looks as if it never had one.
        if checksum == Checksum::Absent && file.attr_names().is_ok_and(|all| has_one(&all)) {
            return Err(ChecksumError::Removed.into());
        }
        let stamp = Stamp { checksum, ..before };
        Ok(Self {
            file,
            checksum,
            stamp,
        })
    }

    /// What the checksum said.
    #[must_use]
    pub fn checksum(&self) -> Checksum {
        self.checksum
    }

    /// What tells whether it has changed since.
    pub(crate) fn stamp(&self) -> &Stamp {
        &self.stamp
    }

    /// The file.
    #[must_use]
    pub fn file(&self) -> &hdf5::File {
        &self.file
    }
}

fn has_one(names: &[String]) -> bool {
    names.iter().any(|name| name == CHECKSUM)
}

/// Why HDF5 could not read or write: of its call stack, what the system said, or else the first line.
fn reason_of(error: &dyn std::fmt::Display) -> String {
    let text = error.to_string();
    let quoted = text.split("error message = '").nth(1);
    let said = quoted.and_then(|rest| rest.split('\'').next());
    let first = || text.lines().next().unwrap_or_default();
    said.unwrap_or_else(first).to_owned()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use pounding_files::checksum::append;

    use super::*;

    #[test]
    fn a_checksum_that_was_removed_is_missed() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.h5");
        let file = hdf5::File::create(&path).unwrap();
        let attribute = file.new_attr::<u8>().create(CHECKSUM).unwrap();
        attribute.write_scalar(&1).unwrap();
        drop((file, attribute));
        append(&path).unwrap();
        let opened = ResultFile::open(&path, WithoutChecksum::Refuse).unwrap();
        assert_eq!(opened.checksum(), Checksum::Matches);
        drop(opened);
        let bytes = std::fs::read(&path).unwrap();
        let cut = &bytes[..bytes.len() - pounding_files::checksum::LENGTH];
        std::fs::write(&path, cut).unwrap();
        let refused = ResultFile::open(&path, WithoutChecksum::Accept).unwrap_err();
        assert!(refused.to_string().contains("checksum is missing"));
        // HDF5 cuts what follows the content when it opens a file for writing.
        std::fs::write(&path, &bytes).unwrap();
        drop(hdf5::File::open_rw(&path).unwrap());
        assert_eq!(std::fs::read(&path).unwrap(), cut);
    }
}
