//! What can be wrong with a name and its parameters.

use crate::suggestion;

/// A name that is not known, or parameters that do not fit what it names.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DefinitionError {
    /// Nothing of this name.
    #[error("unknown {kind} \"{name}\"")]
    UnknownName {
        /// What was looked for: `impact model`.
        kind: &'static str,
        /// The name asked for.
        name: String,
        /// The known name that is meant; empty if it is like none.
        nearest: &'static str,
        /// All known names.
        known: Vec<&'static str>,
    },
    /// There is no such parameter.
    #[error("{noun} {owner} has no parameter \"{parameter}\"")]
    UnknownParameter {
        /// What would have it: `model`.
        noun: &'static str,
        /// Its name.
        owner: &'static str,
        /// Parameter given.
        parameter: String,
        /// Parameters that it has.
        known: Vec<&'static str>,
    },
    /// A parameter that is needed is not given.
    #[error("{noun} {owner} needs {parameter}")]
    MissingParameter {
        /// What needs it: `model`.
        noun: &'static str,
        /// Its name.
        owner: &'static str,
        /// Parameter, or the alternatives.
        parameter: String,
    },
    /// A parameter outside its range.
    #[error("{noun} {owner}: {parameter} = {value} is outside {range}")]
    OutOfRange {
        /// What it belongs to: `model`.
        noun: &'static str,
        /// Its name.
        owner: &'static str,
        /// Parameter.
        parameter: &'static str,
        /// Value (SI).
        value: f64,
        /// Allowed range.
        range: String,
        /// What the parameter is.
        explanation: &'static str,
    },
}

impl DefinitionError {
    /// What to do about it.
    #[must_use]
    pub fn help(&self) -> String {
        match self {
            Self::UnknownName {
                nearest: "", known, ..
            } => format!("known are {}", known.join(", ")),
            Self::UnknownName { nearest, .. } => format!("did you mean \"{nearest}\"?"),
            Self::UnknownParameter { known, .. } if known.is_empty() => {
                "it has no parameters".to_owned()
            }
            Self::UnknownParameter {
                parameter, known, ..
            } => {
                let meant = suggestion::misspelt(parameter, known)
                    .map_or_else(String::new, |name| format!("did you mean \"{name}\"? "));
                format!("{meant}its parameters are {}", known.join(", "))
            }
            Self::MissingParameter {
                noun, parameter, ..
            } => format!("add {parameter} to the {noun}"),
            Self::OutOfRange {
                parameter,
                explanation,
                ..
            } => format!("{parameter}: {explanation}; check the unit"),
        }
    }
}
