//! Why a provision gives no gap.

use pounding_catalogue::DefinitionError;

use crate::inputs::Input;

/// A provision that is unknown, does not apply, or lacks an input.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SeparationError {
    /// No provision of this name.
    #[error(transparent)]
    UnknownProvision(#[from] DefinitionError),
    /// An input that the provision needs is not given.
    #[error("{provision} needs {} ({}){}", input.key(), input.explanation(), of(structure))]
    MissingInput {
        /// Provision.
        provision: &'static str,
        /// What it needs.
        input: Input,
        /// Structure that lacks it; empty where it belongs to the site.
        structure: String,
    },
    /// The provision does not speak of this situation.
    #[error("{provision} does not apply: {reason}")]
    NotApplicable {
        /// Provision.
        provision: &'static str,
        /// Why.
        reason: String,
    },
    /// An input that no structure can have.
    #[error("{quantity} = {value} is outside {range}")]
    OutOfRange {
        /// Quantity.
        quantity: &'static str,
        /// Value (SI).
        value: f64,
        /// Allowed range.
        range: &'static str,
    },
}

fn of(structure: &str) -> String {
    if structure.is_empty() {
        String::new()
    } else {
        format!(" of {structure}")
    }
}

impl SeparationError {
    /// What to do about it.
    #[must_use]
    pub fn help(&self) -> Option<String> {
        Some(match self {
            Self::UnknownProvision(error) => error.help(),
            Self::MissingInput { input, .. } => {
                format!("add `{}` to the table [separation]", input.key())
            }
            Self::NotApplicable { .. } => {
                "choose the rule of the code that covers this situation".to_owned()
            }
            Self::OutOfRange { .. } => "check the value and its unit".to_owned(),
        })
    }
}
