//! What can be wrong with an impact model's definition.

use pounding_catalogue::DefinitionError;

/// A model that cannot be built, or a collision that cannot be computed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GapElementError {
    /// No model of this name, or parameters that it does not take.
    #[error(transparent)]
    Definition(#[from] DefinitionError),
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
    /// A law that cannot have a spring behind it.
    #[error("model {model} cannot stand in series with a spring: {reason}")]
    Series {
        /// Model.
        model: &'static str,
        /// Why.
        reason: String,
    },
    /// A table of a spring that is none.
    #[error("the table of the spring: {0}")]
    SpringTable(String),
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
        /// Whether it has no damping.
        elastic: bool,
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
            // Too many for a list.
            Self::Definition(DefinitionError::UnknownName { nearest: "", .. }) => {
                "`pounding models` lists all".to_owned()
            }
            Self::Definition(error @ DefinitionError::UnknownName { .. }) => {
                format!("{} `pounding models` lists all", error.help())
            }
            Self::Definition(DefinitionError::MissingParameter { parameter, .. }) => {
                format!("add {parameter} to the gap")
            }
            Self::Definition(DefinitionError::OutOfRange { parameter: "restitution", .. }) => {
                "restitution is the ratio of separation to approach velocity: 1 for elastic impact, 0.65 is customary for concrete".to_owned()
            }
            Self::Definition(error) => error.help(),
            Self::Conflict { first, second, .. } => format!("give {first} or {second}, not both"),
            Self::Separation { offered, .. } => format!("it offers {}", offered.join(", ")),
            Self::Series { .. } => "take an elastic law, linear_elastic or hertz_1882".to_owned(),
            Self::SpringTable(_) => "give borovin_2014 penetrations and forces that increase from above zero".to_owned(),
            Self::Bodies(_) => "the left body must move towards the right one; check masses and velocities with their units".to_owned(),
            Self::Unfinished { elastic: true, .. } => "stiffness, mass and speed are out of all proportion, so that the contact is over in next to no time: check their values and units; plain numbers are SI".to_owned(),
            Self::Unfinished { elastic: false, .. } => "so much damping makes the contact creep for ever, or stiffness, mass and speed are out of all proportion: check them, damping, restitution and their units".to_owned(),
        })
    }
}
