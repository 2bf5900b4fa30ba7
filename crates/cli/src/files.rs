//! Files of a command: what it reads beside its arguments, and where its outputs have a place.

use std::path::{Path, PathBuf};

use pounding_files::{FileUse, LeftOver, PartFile, left_over};
use pounding_study::gap_check::{self, CheckError, SkippedFile};

use crate::arguments::InputPath;
use crate::failure::Failure;
use crate::output::note;

/// Names the part files of an output that a killed process has left behind. They stay: on a
/// file system that several machines share, another one may write them.
pub fn name_left_over(output: &Path) {
    for LeftOver { path, process } in left_over(output) {
        note(&format!(
            "{} is an unfinished file of process {process}, which does not run on this machine: unless another machine is writing it, delete it",
            path.display()
        ));
    }
}

/// The records that arguments name, with those in folders; files in folders that are no records
/// are named.
pub fn record_files(given: &[InputPath]) -> Result<Vec<PathBuf>, CheckError> {
    let given: Vec<PathBuf> = given.iter().map(|p| p.to_path_buf()).collect();
    let found = gap_check::record_files(&given)?;
    for SkippedFile { path, what } in &found.skipped {
        note(&format!(
            "{} is {what}, not a record: it is left out",
            path.display()
        ));
    }
    Ok(found.files)
}

/// Adds files that a case or a study names to those of the arguments, and holds all against
/// one another: before any work is done.
pub fn reads_too(
    files: &mut FileUse,
    more: impl IntoIterator<Item = (&'static str, PathBuf)>,
) -> Result<(), Failure> {
    for (role, path) in more {
        files.reads(role, path);
    }
    Ok(files.check()?)
}

/// Finds out before the work, not after it, that outputs have no place.
pub fn have_a_place<'p>(
    outputs: impl IntoIterator<Item = Option<&'p Path>>,
) -> Result<(), Failure> {
    for path in outputs.into_iter().flatten() {
        PartFile::beside(path).map_err(|e| Failure::output(&e, &path.display().to_string()))?;
    }
    Ok(())
}
