//! What can go wrong between a result file and its page.

use std::path::PathBuf;

use pounding_ground_motion::GroundMotionError;
use pounding_results::OpenError;
use pounding_results::study::StudyFileError;
use thiserror::Error;

use crate::answer_file::AnswerFileError;

/// Why a page could not be made.
#[derive(Debug, Error)]
pub enum ReportError {
    /// The file cannot be opened, or is not as it was written.
    #[error("{} cannot be read: {source}", path.display())]
    Unreadable {
        /// File.
        path: PathBuf,
        /// What the operating system, the checksum or HDF5 says.
        source: OpenError,
    },
    /// The file is HDF5, but neither the result of a run nor of a study.
    #[error("{} is not a result: {found}", path.display())]
    NotAResult {
        /// File.
        path: PathBuf,
        /// What it is instead, or what it lacks.
        found: String,
    },
    /// A part of the result is missing or has another shape or type.
    #[error("{}: {object} cannot be read: {reason}", path.display())]
    Damaged {
        /// File.
        path: PathBuf,
        /// Group, dataset or attribute.
        object: String,
        /// What HDF5 says.
        reason: String,
    },
    /// The result of a study that cannot be read.
    #[error(transparent)]
    Study(StudyFileError),
    /// The file of an answer that cannot be used.
    #[error(transparent)]
    Answer(#[from] AnswerFileError),
    /// A motion or spectrum that cannot be drawn.
    #[error(transparent)]
    Motion(#[from] GroundMotionError),
    /// A figure could not be drawn.
    #[error("a figure could not be drawn: {reason}")]
    Figure {
        /// What the plotting library says.
        reason: String,
    },
}

impl ReportError {
    /// What to do about it.
    #[must_use]
    pub fn help(&self) -> Option<String> {
        match self {
            Self::Unreadable { source, .. } => {
                let help = source.help();
                Some(
                    help.unwrap_or("give the .h5 file that `pounding run` or a study has written, or the .json file of the option --output of `gap`, `compare` or `motion info`")
                        .to_owned(),
                )
            }
            Self::NotAResult { .. } => {
                Some("give the result of `pounding run`, `sweep`, `merge` or `ida`, or the .json file of the option --output of `gap`, `compare` or `motion info`".to_owned())
            }
            Self::Damaged { .. } => Some(
                "run the case again: its text stands in the file as the attribute `case`"
                    .to_owned(),
            ),
            Self::Answer(error) => error.help(),
            Self::Motion(error) => error.help(),
            Self::Study(error) => Some(error.help()),
            Self::Figure { .. } => None,
        }
    }
}
