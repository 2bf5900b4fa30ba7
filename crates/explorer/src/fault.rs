//! What is wrong, in the words of the command line.

use pounding_assembly::AssemblyError;
use pounding_case::{Case, CaseError};
use pounding_study::edited::NoRoom;
use pounding_study::faults;
use pounding_study::gap_check::CheckError;
use pounding_time_history::TimeHistoryError;
use serde::Serialize;

/// One thing that is wrong.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub(crate) struct Fault {
    /// What is wrong, with its place.
    pub message: String,
    /// What to do about it.
    pub help: Option<String>,
    /// The line of the case that it stands in; empty where it has none.
    pub line: String,
    /// Whether the case is sound, and only its run came to no end here.
    pub sound: bool,
}

/// Why a request has no other answer.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Refused(pub Vec<Fault>);

impl Refused {
    /// One fault without a place.
    pub(crate) fn new(message: impl Into<String>, help: Option<String>) -> Self {
        Self(vec![Fault {
            message: message.into(),
            help,
            line: String::new(),
            sound: false,
        }])
    }

    /// The same of a case that is sound.
    pub(crate) fn of_a_sound_case(mut self) -> Self {
        for fault in &mut self.0 {
            fault.sound = true;
        }
        self
    }

    /// The faults of a case, in its text.
    pub(crate) fn of_case(error: CaseError, source: &str) -> Self {
        let line = |number: usize| source.lines().nth(number.wrapping_sub(1));
        let fault = |error: CaseError| Fault {
            message: error.to_string(),
            line: line(error.line).unwrap_or_default().trim().to_owned(),
            help: error.help,
            sound: false,
        };
        Self(error.each().map(fault).collect())
    }

    /// What kept a case from being assembled, with all else that is wrong in it.
    pub(crate) fn of_assembly(error: AssemblyError, case: &Case) -> Self {
        match faults::with_all(error, case, true) {
            AssemblyError::Case(error) => Self::of_case(error, &case.source),
            error => Self::new(error.to_string(), error.help()),
        }
    }

    /// What kept a case from being checked.
    pub(crate) fn of_check(error: CheckError, case: &Case) -> Self {
        match error {
            CheckError::Case(error) => Self::of_case(error, &case.source),
            CheckError::Record { source, .. } => Self::of_assembly(*source, case),
            error => Self::new(error.to_string(), error.help()),
        }
    }
}

impl From<TimeHistoryError> for Refused {
    fn from(error: TimeHistoryError) -> Self {
        let refused = Self::new(words(&error), error.help());
        match error {
            // What looks at runs here ends those that take too long.
            TimeHistoryError::Collapse { .. } | TimeHistoryError::Recorder(_) => {
                refused.of_a_sound_case()
            }
            _ => refused,
        }
    }
}

/// What ended a run. What looks at runs here keeps their time: readers know of no recorder.
pub(crate) fn words(error: &TimeHistoryError) -> String {
    match error {
        TimeHistoryError::Recorder(why) => why.clone(),
        error => error.to_string(),
    }
}

impl From<NoRoom> for Refused {
    fn from(error: NoRoom) -> Self {
        Self::new(error.reason, Some(error.help))
    }
}
