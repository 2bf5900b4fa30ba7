//! What can be wrong with a test of a law.

use pounding_catalogue::DefinitionError;
use pounding_catalogue::numbers::significant;

use crate::error::HysteresisError;

/// A law that cannot be tested like this, or a test without a result.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LaboratoryError {
    /// The law refuses its parameters.
    #[error("{source}")]
    Parameters {
        /// What it says.
        source: HysteresisError,
        /// Parameters that were taken from the example of the descriptor.
        filled: Vec<String>,
    },
    /// A history whose time does not increase.
    #[error("time does not increase here")]
    TimeOrder {
        /// Number of the row, from zero.
        row: usize,
    },
    /// A law that depends on the rate, and a history that begins displaced.
    #[error("the history begins with a deformation, and how fast it came about is not known")]
    UnknownStart {
        /// Number of the row, from zero.
        row: usize,
    },
    /// A law that depends on the rate, and a history without times or speed.
    #[error(
        "the force of law {law} depends on the rate of deformation, which the history does not state"
    )]
    UnknownRate {
        /// Law.
        law: &'static str,
    },
    /// A history of zeros.
    #[error("the history does not move the element")]
    NoMotion,
    /// A path far beyond yield for a law that has to be integrated along it.
    #[error(
        "a path of {} m in all is {} times the yield deformation of {law}, which is integrated along its path up to {} times",
        significant(*length),
        significant(*ratio),
        significant(*most)
    )]
    TooLong {
        /// Law.
        law: &'static str,
        /// Length of the path (m).
        length: f64,
        /// The same over the yield deformation.
        ratio: f64,
        /// Maximum of that ratio.
        most: f64,
    },
    /// A force or an energy beyond the numbers of double precision.
    #[error("force or energy overflow at a deformation of {} m", significant(*deformation))]
    Overflow {
        /// Deformation (m).
        deformation: f64,
    },
}

impl LaboratoryError {
    /// What to do about it.
    #[must_use]
    pub fn help(&self) -> String {
        match self {
            Self::Parameters { source, filled } => {
                let mut help = match source {
                    HysteresisError::Definition(DefinitionError::MissingParameter { parameter, .. }) => format!(
                        "add --set {parameter}=VALUE: the example's belongs to another exponent"
                    ),
                    _ => source.help().unwrap_or_default(),
                };
                // A value of the example may be the cause.
                if matches!(source, HysteresisError::Inconsistent { .. }) && !filled.is_empty() {
                    help.push_str(&format!(
                        "; from the example of the descriptor are {}",
                        filled.join(", ")
                    ));
                }
                return help;
            }
            Self::TimeOrder { .. } => {
                "sort the rows by time, and leave out rows that repeat a time"
            }
            Self::UnknownStart { .. } => "begin with a row of zero deformation",
            Self::UnknownRate { .. } => {
                "add --rate \"20 mm/s\", or a column of times: time_s,deformation_mm"
            }
            Self::NoMotion => "give it rows of deformations",
            Self::TooLong { .. } => {
                "check the unit of the deformation, of stiffness and of yield_force; law bilinear takes any"
            }
            Self::Overflow { .. } => "check the unit of the deformations",
        }
        .to_owned()
    }
}
