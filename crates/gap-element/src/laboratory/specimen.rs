//! A model with its parameters.

use super::EXAMPLE_RESTITUTION;
use crate::descriptor::{ModelDescriptor, ParameterUnit};
use crate::error::GapElementError;
use crate::model::{ImpactModel, SeparationRule};
use crate::parameters::ModelParameters;
use crate::registry;

/// A model with its parameters.
#[derive(Debug, Clone)]
pub struct Specimen {
    /// The model's descriptor.
    pub descriptor: &'static ModelDescriptor,
    /// Parameters (SI), given and filled in.
    pub parameters: ModelParameters,
    /// Names of those that were filled in from the model's example.
    pub filled: Vec<String>,
    /// Whether the separation rule asked for is not offered, so that its own holds.
    pub keeps_own_separation: bool,
}

impl Specimen {
    /// A model with given parameters.
    #[must_use]
    pub fn new(descriptor: &'static ModelDescriptor, parameters: ModelParameters) -> Self {
        Self {
            descriptor,
            parameters,
            filled: Vec::new(),
            keeps_own_separation: false,
        }
    }

    /// Whether the model offers a separation rule.
    #[must_use]
    pub fn offers(&self, rule: SeparationRule) -> bool {
        self.descriptor.separation_rules.contains(&rule)
    }

    /// Asks for a separation rule, which a model takes that offers it.
    pub fn ask_for_separation(&mut self, rule: SeparationRule) {
        self.keeps_own_separation = !self.offers(rule);
        if self.offers(rule) {
            self.parameters.separation = Some(rule);
        }
    }

    /// Takes what is missing from the model's example; its restitution is
    /// [`EXAMPLE_RESTITUTION`].
    pub fn fill_from_example(&mut self) {
        let example = self.descriptor.example_parameters(EXAMPLE_RESTITUTION);
        // The example's stiffness belongs to the example's exponent.
        let exponent = self.parameters.values.contains_key("exponent")
            && !example.values.contains_key("exponent");
        for (key, value) in example.parameters.values {
            let foreign = exponent && key == "stiffness";
            if !foreign && !self.parameters.values.contains_key(&key) {
                self.filled.push(key.clone());
                self.parameters.values.insert(key, value);
            }
        }
        // What was given may exclude its alternatives.
        while let Err(GapElementError::Conflict { first, second, .. }) = self.build() {
            let Some(at) = self.filled.iter().position(|k| k == first || k == second) else {
                break;
            };
            let key = self.filled.remove(at);
            self.parameters.values.remove(&key);
        }
    }

    /// Leaves the restitution out, for a table that goes through all of them.
    pub fn remove_restitution(&mut self) {
        self.parameters.values.remove("restitution");
        self.filled.retain(|key| key != "restitution");
    }

    /// The model itself.
    ///
    /// # Errors
    /// Parameters that are missing, not known or out of range.
    pub fn build(&self) -> Result<Box<dyn ImpactModel>, GapElementError> {
        registry::build(self.descriptor.name, &self.parameters)
    }

    /// Exponent of its spring ([`exponent_of`]).
    #[must_use]
    pub fn exponent(&self) -> f64 {
        exponent_of(self.descriptor, &self.parameters)
    }

    /// The rule by which its contact ends.
    #[must_use]
    pub fn separation(&self) -> SeparationRule {
        self.parameters.separation(self.descriptor)
    }
}

/// Unit of a parameter as case files and arguments take it, the exponent of the law in figures;
/// none without one.
#[must_use]
pub fn unit_of(
    descriptor: &ModelDescriptor,
    parameters: &ModelParameters,
    name: &str,
) -> Option<String> {
    let known = |name: &str| descriptor.parameters.iter().find(|p| p.name == name);
    let unit = known(name)?.unit;
    (unit != ParameterUnit::One).then(|| unit.with_exponent(exponent_of(descriptor, parameters)))
}

/// Exponent of the spring of a law, with which its force begins: as given, else that of the
/// descriptor, else that of its stiffness; 1 for a law without one.
#[must_use]
pub fn exponent_of(descriptor: &ModelDescriptor, parameters: &ModelParameters) -> f64 {
    // A table begins with a straight line.
    if parameters.spring.is_some() {
        return 1.0;
    }
    let known = |name: &str| descriptor.parameters.iter().find(|p| p.name == name);
    let of_stiffness = match known("stiffness").map(|p| p.unit) {
        Some(ParameterUnit::NewtonPerMetreToExponent) => 1.5,
        _ => 1.0,
    };
    let given = parameters.given("exponent");
    given
        .or(known("exponent").and_then(|p| p.default))
        .unwrap_or(of_stiffness)
}
