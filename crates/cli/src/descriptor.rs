//! What descriptors of models and laws have in common, for machines.

use pounding_catalogue::{Alias, ParameterDescriptor};
use serde::Serialize;

/// Another name, and who uses it.
#[derive(Serialize)]
pub struct OtherName {
    name: &'static str,
    citation: &'static str,
}

impl OtherName {
    /// All of a descriptor.
    pub fn of_all(aliases: &[Alias]) -> Vec<Self> {
        let aliases = aliases.iter();
        aliases
            .map(|a| Self {
                name: a.name,
                citation: a.citation,
            })
            .collect()
    }
}

/// A parameter with its unit and range.
#[derive(Serialize)]
pub struct DescribedParameter {
    name: &'static str,
    unit: String,
    range: String,
    default: Option<f64>,
    required: bool,
    explanation: &'static str,
}

impl DescribedParameter {
    /// A parameter of a descriptor, in this unit.
    pub fn of(parameter: &ParameterDescriptor, unit: String, required: bool) -> Self {
        Self {
            name: parameter.name,
            unit,
            range: parameter.range(),
            default: parameter.default,
            required,
            explanation: parameter.explanation,
        }
    }
}
