//! Why a case cannot be assembled.

use std::ops::Range;

use pounding_case::{Case, CaseError};
use pounding_ground_motion::GroundMotionError;
use pounding_time_history::{StepLimit, TimeHistoryError};

/// Where in a case stands what the solver refuses; `None` where no single value does.
#[must_use]
pub fn place_of(error: &TimeHistoryError, case: &Case) -> Option<Range<usize>> {
    let option = |key: &str| case.analysis.places.get(key).cloned();
    let building = |name: &str| {
        let mut named = case.buildings.iter().map(|b| &b.name);
        named.find(|b| b.value == name).map(|b| b.span.clone())
    };
    match error {
        TimeHistoryError::TooManySteps { limit, .. }
        | TimeHistoryError::UnstableStep { limit, .. } => match limit {
            StepLimit::Duration(_) => option("duration"),
            StepLimit::Step(_) => option("step"),
            StepLimit::Period { building: name, .. } => option("step").or_else(|| building(name)),
            _ => option("step"),
        },
        TimeHistoryError::Option { option: key, .. } => option(key),
        TimeHistoryError::ContactTooShort { gap }
        | TimeHistoryError::CompliantModel { gap, .. } => {
            let gap = case.gaps.iter().find(|g| g.name == *gap)?;
            Some(gap.model.span.clone())
        }
        _ => None,
    }
}

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
