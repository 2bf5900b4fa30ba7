//! What can be wrong with an impact model's definition.

/// A model that cannot be built, or a collision that cannot be computed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GapElementError {
    /// No model of this name.
    #[error("unknown impact model \"{name}\"")]
    UnknownModel {
        /// The name asked for.
        name: String,
        /// The nearest known name.
        nearest: &'static str,
    },
    /// The model has no such parameter.
    #[error("model {model} has no parameter \"{parameter}\"")]
    UnknownParameter {
        /// Model.
        model: &'static str,
        /// Parameter given.
        parameter: String,
        /// Parameters that the model has.
        known: Vec<&'static str>,
    },
    /// A parameter that the model needs is not given.
    #[error("model {model} needs {parameter}")]
    MissingParameter {
        /// Model.
        model: &'static str,
        /// Parameter, or the alternatives.
        parameter: String,
    },
    /// A parameter outside its range.
    #[error("model {model}: {parameter} = {value} is outside {range}")]
    OutOfRange {
        /// Model.
        model: &'static str,
        /// Parameter.
        parameter: &'static str,
        /// Value (SI).
        value: f64,
        /// Allowed range.
        range: String,
    },
    /// Two parameters that exclude one another.
    #[error("model {model}: {first} and {second} exclude one another")]
    Conflict {
        /// Model.
        model: &'static str,
        /// One parameter.
        first: &'static str,
        /// The other.
        second: &'static str,
    },
    /// The model does not offer this separation rule.
    #[error("model {model} does not offer separation \"{rule}\"")]
    Separation {
        /// Model.
        model: &'static str,
        /// Rule asked for.
        rule: String,
        /// Rules offered.
        offered: Vec<&'static str>,
    },
    /// Bodies that cannot collide.
    #[error("the bodies cannot collide: {0}")]
    Bodies(String),
    /// A collision that did not end.
    #[error(
        "model {model}: the collision did not end within {steps} steps, at t = {time:e} s after closure"
    )]
    Unfinished {
        /// Name of the model.
        model: &'static str,
        /// Steps taken.
        steps: usize,
        /// Time after closure (s).
        time: f64,
    },
}

impl GapElementError {
    /// What to do about it.
    #[must_use]
    pub fn help(&self) -> Option<String> {
        Some(match self {
            Self::UnknownModel { nearest, .. } => {
                format!("did you mean \"{nearest}\"? `pounding models` lists all")
            }
            Self::UnknownParameter { known, .. } => {
                format!("its parameters are {}", known.join(", "))
            }
            Self::MissingParameter { parameter, .. } => format!("add {parameter} to the gap"),
            Self::OutOfRange { parameter, .. } if *parameter == "restitution" => {
                "restitution is the ratio of separation to approach velocity: 1 for elastic impact, 0.65 is customary for concrete".to_owned()
            }
            Self::OutOfRange { .. } => "check the unit".to_owned(),
            Self::Conflict { first, second, .. } => format!("give {first} or {second}, not both"),
            Self::Separation { offered, .. } => format!("it offers {}", offered.join(", ")),
            Self::Bodies(_) => "the left body must move towards the right one".to_owned(),
            Self::Unfinished { .. } => "so much damping makes the contact creep for ever: check damping, restitution and their units".to_owned(),
        })
    }
}
