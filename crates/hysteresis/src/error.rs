//! What can be wrong with the definition of a law or with data for it.

use pounding_catalogue::DefinitionError;

/// A law that cannot be built, or data that cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum HysteresisError {
    /// No law of this name, or parameters that it does not take.
    #[error(transparent)]
    Definition(#[from] DefinitionError),
    /// Parameters that are allowed one by one but not together.
    #[error("law {law}: {reason}")]
    Inconsistent {
        /// Law.
        law: &'static str,
        /// Why.
        reason: String,
        /// What to do.
        remedy: &'static str,
    },
    /// A measured curve that is none of this law, whatever its parameters.
    #[error("{reason}")]
    Measured {
        /// Why.
        reason: String,
        /// What to do.
        remedy: &'static str,
    },
    /// A measured curve that no parameters can be fitted to.
    #[error("the measured curve cannot be fitted: {reason}")]
    Fit {
        /// Why.
        reason: String,
        /// What to do.
        remedy: &'static str,
    },
}

impl HysteresisError {
    /// What to do about it.
    #[must_use]
    pub fn help(&self) -> Option<String> {
        Some(match self {
            Self::Definition(error) => error.help(),
            Self::Inconsistent { remedy, .. }
            | Self::Measured { remedy, .. }
            | Self::Fit { remedy, .. } => (*remedy).to_owned(),
        })
    }
}
