//! What can go wrong with the file of a study.

use std::path::PathBuf;

use pounding_files::PlaceTaken;

use crate::OpenError;

/// A result that cannot be read or written, or shards that do not make one.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum StudyFileError {
    /// A result that may not be parsed: see its reason.
    #[error("cannot read the result {path}: {source}")]
    Checksum {
        /// The file.
        path: PathBuf,
        /// Why not.
        source: OpenError,
    },
    /// The result cannot be written or read.
    #[error("cannot {what} the result {path}: {reason}")]
    File {
        /// What was tried.
        what: &'static str,
        /// The file.
        path: PathBuf,
        /// What HDF5 or the file system said.
        reason: String,
    },
    /// Its place takes no file, as is found out before the work.
    #[error("cannot write the result {path}: {reason}")]
    NoPlace {
        /// The file asked for.
        path: PathBuf,
        /// What the file system said.
        reason: String,
    },
    /// The result is written, but not under its name, where something stands that it may not
    /// replace.
    #[error("cannot write the result {path}: {source}")]
    Aside {
        /// The file asked for.
        path: PathBuf,
        /// Where it is.
        source: PlaceTaken,
    },
    /// Files that do not make one study together.
    #[error("cannot merge: {reason}")]
    Merge {
        /// Why.
        reason: String,
    },
    /// Something wrong with several files of a merge.
    #[error("{first}; {others} more of the files cannot be merged")]
    Several {
        /// The first.
        first: Box<StudyFileError>,
        /// How many more.
        others: usize,
    },
    /// Shards that different builds of the program computed.
    #[error("cannot merge shards that different builds of the program computed:\n{list}")]
    MixedBuilds {
        /// Each build with its files, a line each.
        list: String,
    },
}

impl StudyFileError {
    /// Why a result could not be read, without its path.
    #[must_use]
    pub fn reason(&self) -> String {
        match self {
            Self::Checksum { source, .. } => source.to_string(),
            Self::File { reason, .. } => reason.clone(),
            other => other.to_string(),
        }
    }

    /// What to try.
    #[must_use]
    pub fn help(&self) -> String {
        let text = match self {
            Self::Aside { source, .. } => return source.help(),
            Self::File { what: "write", .. } => {
                "check that the folder exists, may be written to and has room, or name another file with -o; what was finished stays stored: a sweep goes on with it by --resume, and shards can be merged anew"
            }
            Self::File { .. } => NO_SWEEP,
            Self::NoPlace { .. } => {
                "check that the folder exists, may be written to and has room, or name another file with -o"
            }
            Self::Checksum { source, .. } => source.help().unwrap_or(NO_SWEEP),
            Self::Merge { .. } => {
                "merge all shards i/n of one study for one n, computed by one version of the program"
            }
            Self::Several { .. } => "`pounding merge --check` with the same files names them all",
            Self::MixedBuilds { .. } => {
                "compute all shards by one build; or, if their numbers may differ in the last digits or more, merge with --allow-mixed-builds: the result then says which build made which shard"
            }
        };
        text.to_owned()
    }
}

const NO_SWEEP: &str = "check that it is the HDF5 file of a sweep";
