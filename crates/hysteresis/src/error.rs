//! What can be wrong with the definition of a law or with data for it.

/// A law that cannot be built, or data that cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum HysteresisError {
    /// No law of this name.
    #[error("unknown hysteresis law \"{name}\"")]
    UnknownLaw {
        /// The name asked for.
        name: String,
        /// The nearest known name.
        nearest: &'static str,
    },
    /// The law has no such parameter.
    #[error("law {law} has no parameter \"{parameter}\"")]
    UnknownParameter {
        /// Law.
        law: &'static str,
        /// Parameter given.
        parameter: String,
        /// Parameters that the law has.
        known: Vec<&'static str>,
    },
    /// A parameter that the law needs is not given.
    #[error("law {law} needs {parameter}")]
    MissingParameter {
        /// Law.
        law: &'static str,
        /// Parameter.
        parameter: &'static str,
    },
    /// A parameter outside its range.
    #[error("law {law}: {parameter} = {value} is outside {range}")]
    OutOfRange {
        /// Law.
        law: &'static str,
        /// Parameter.
        parameter: &'static str,
        /// Value (SI).
        value: f64,
        /// Allowed range.
        range: String,
        /// What the parameter is.
        explanation: &'static str,
    },
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
    /// A measured curve that no parameters can be fitted to.
    #[error("the measured dissipation cannot be fitted: {reason}")]
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
            Self::UnknownLaw { nearest, .. } => format!("did you mean \"{nearest}\"?"),
            Self::UnknownParameter { known, .. } if known.is_empty() => {
                "it has no parameters".to_owned()
            }
            Self::UnknownParameter { known, .. } => {
                format!("its parameters are {}", known.join(", "))
            }
            Self::MissingParameter { parameter, .. } => format!("add {parameter} to the law"),
            Self::OutOfRange {
                parameter,
                explanation,
                ..
            } => format!("{parameter}: {explanation}; check the unit"),
            Self::Inconsistent { remedy, .. } | Self::Fit { remedy, .. } => (*remedy).to_owned(),
        })
    }
}
