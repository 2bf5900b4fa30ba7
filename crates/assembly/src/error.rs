//! Why a case cannot be assembled.

use pounding_case::CaseError;
use pounding_ground_motion::GroundMotionError;
use pounding_time_history::TimeHistoryError;

/// What keeps a case from being a system under its record.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum AssemblyError {
    /// The case says something that cannot be, at a place in its file.
    #[error(transparent)]
    Case(#[from] CaseError),
    /// The record cannot be read, processed or scaled.
    #[error(transparent)]
    GroundMotion(#[from] GroundMotionError),
    /// The system or the options of the analysis are not what the solver takes.
    #[error(transparent)]
    System(#[from] TimeHistoryError),
}

impl AssemblyError {
    /// What to try.
    #[must_use]
    pub fn help(&self) -> Option<String> {
        match self {
            Self::Case(error) => error.help.clone(),
            Self::GroundMotion(error) => error.help(),
            Self::System(error) => error.help(),
        }
    }
}
