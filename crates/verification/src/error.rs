//! What keeps a published result from being computed.

use pounding_assembly::AssemblyError;
use pounding_gap_element::GapElementError;
use pounding_gap_element::calibration::CalibrationError;
use pounding_gap_element::contact_stiffness::ContactStiffnessError;
use pounding_ground_motion::GroundMotionError;
use pounding_hysteresis::HysteresisError;

/// A published result that could not be computed, in the words of the crate that computes it.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum VerificationError {
    /// A collision.
    #[error(transparent)]
    Collision(#[from] GapElementError),
    /// A contact stiffness.
    #[error(transparent)]
    Stiffness(#[from] ContactStiffnessError),
    /// A drop test.
    #[error(transparent)]
    Calibration(#[from] CalibrationError),
    /// A law of hysteresis.
    #[error(transparent)]
    Law(#[from] HysteresisError),
    /// A case that is none, or that cannot be assembled or run.
    #[error("{error}")]
    Case {
        /// What is wrong.
        error: Box<AssemblyError>,
        /// Text of the case file, in which errors have their places.
        text: String,
    },
    /// A record.
    #[error(transparent)]
    GroundMotion(#[from] GroundMotionError),
    /// Published numbers that a user entered.
    #[error(transparent)]
    Entered(#[from] EnteredError),
    /// A line of a table of reference values, which this crate holds itself.
    #[error("{file}, line {line}: {problem}")]
    Table {
        /// File.
        file: &'static str,
        /// Line, from 1.
        line: u64,
        /// What is wrong.
        problem: String,
    },
    /// A run without an impact that the comparison speaks of.
    #[error("{case}: no impact {number}, of {impacts}")]
    NoImpact {
        /// Case.
        case: &'static str,
        /// Impact, from 1.
        number: usize,
        /// Impacts of the run.
        impacts: usize,
    },
}

/// What is wrong with a file of published numbers.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{file}, line {line}: {problem}")]
pub struct EnteredError {
    /// File.
    pub file: String,
    /// Line, from 1.
    pub line: usize,
    /// What is wrong.
    pub problem: String,
    /// What to do about it.
    pub help: String,
}

impl VerificationError {
    /// An error of a case, whose text this is.
    pub(crate) fn of_case(error: impl Into<AssemblyError>, text: &str) -> Self {
        Self::Case {
            error: Box::new(error.into()),
            text: text.to_owned(),
        }
    }
}
