//! Files that end.

use std::path::Path;

use crate::error::GroundMotionError;

/// Refuses what is no regular file: a device or a pipe may never end.
pub(crate) fn regular(path: &Path, file: &str) -> Result<(), GroundMotionError> {
    let what = match std::fs::metadata(path) {
        Ok(found) if found.is_file() => return Ok(()),
        Ok(found) if found.is_dir() => "this is a folder, not a file",
        Ok(_) => "this is no regular file",
        Err(source) => {
            let file = file.to_owned();
            return Err(GroundMotionError::Io { file, source });
        }
    };
    Err(GroundMotionError::Unsupported {
        file: file.to_owned(),
        what: what.to_owned(),
        remedy: "give the path of a file; save what comes from a pipe or device first",
    })
}
