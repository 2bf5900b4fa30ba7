//! Parameters of a law as a user gives them, checked against its descriptor.

use std::collections::BTreeMap;

use crate::descriptor::{LawDescriptor, ParameterDescriptor, ParameterUnit};
use crate::error::HysteresisError;

/// Parameters by name (SI).
#[derive(Debug, Clone, PartialEq, Default)]
pub struct LawParameters {
    /// Values in SI units.
    pub values: BTreeMap<String, f64>,
}

impl LawParameters {
    /// Parameters from pairs of name and SI value.
    #[must_use]
    pub fn from_pairs(pairs: &[(&str, f64)]) -> Self {
        Self {
            values: pairs.iter().map(|(k, v)| ((*k).to_owned(), *v)).collect(),
        }
    }

    /// The same with one parameter more, or another value of it.
    #[must_use]
    pub fn with(mut self, name: &str, value: f64) -> Self {
        self.values.insert(name.to_owned(), value);
        self
    }

    /// Refuses unknown, missing and out-of-range parameters.
    ///
    /// # Errors
    /// The first parameter that the law does not have, does not allow, or misses.
    pub fn check(&self, law: &'static LawDescriptor) -> Result<(), HysteresisError> {
        for (name, value) in &self.values {
            let Some(parameter) = law.parameters.iter().find(|p| p.name == name) else {
                return Err(HysteresisError::UnknownParameter {
                    law: law.name,
                    parameter: name.clone(),
                    known: law.parameters.iter().map(|p| p.name).collect(),
                });
            };
            if !parameter.allows(*value) {
                return Err(HysteresisError::OutOfRange {
                    law: law.name,
                    parameter: parameter.name,
                    value: *value,
                    range: parameter.range(),
                    explanation: parameter.explanation,
                });
            }
        }
        for parameter in law.parameters {
            self.get(law, parameter.name)?;
        }
        Ok(())
    }

    /// Deformation (m) at which an element of initial stiffness `stiffness` (N/m) begins
    /// to yield or slip: its yield or friction force over that stiffness. `None` for a
    /// law without such a force.
    #[must_use]
    pub fn yield_deformation(&self, stiffness: f64) -> Option<f64> {
        ["yield_force", "friction_force"]
            .iter()
            .find_map(|name| self.values.get(*name))
            .map(|force| force / stiffness)
            .filter(|x| x.is_finite() && *x > 0.0)
    }

    /// The value given, or the default of the law.
    ///
    /// # Errors
    /// [`HysteresisError::MissingParameter`] where there is neither.
    pub(crate) fn get(
        &self,
        law: &'static LawDescriptor,
        name: &'static str,
    ) -> Result<f64, HysteresisError> {
        let default = || {
            let known = law.parameters.iter().find(|p| p.name == name);
            known.and_then(|p| p.default)
        };
        self.values
            .get(name)
            .copied()
            .or_else(default)
            .ok_or(HysteresisError::MissingParameter {
                law: law.name,
                parameter: name,
            })
    }
}

impl ParameterDescriptor {
    /// Whether a value lies in the range.
    #[must_use]
    pub fn allows(&self, value: f64) -> bool {
        let ((low, low_in), (high, high_in)) = (self.minimum, self.maximum);
        value.is_finite()
            && (value > low || (low_in && value == low))
            && (value < high || (high_in && value == high))
    }

    /// The range in mathematical brackets.
    #[must_use]
    pub fn range(&self) -> String {
        let ((low, low_in), (high, high_in)) = (self.minimum, self.maximum);
        format!(
            "{}{low}, {high}{}",
            if low_in { '[' } else { '(' },
            if high_in { ']' } else { ')' }
        )
    }

    /// The same with this range, ends included where the flag says so.
    pub(crate) const fn within(mut self, minimum: (f64, bool), maximum: (f64, bool)) -> Self {
        self.minimum = minimum;
        self.maximum = maximum;
        self
    }

    /// The same with a default.
    pub(crate) const fn default_to(mut self, value: f64) -> Self {
        self.default = Some(value);
        self
    }
}

/// A parameter that is positive and must be given.
pub(crate) const fn positive(
    name: &'static str,
    unit: ParameterUnit,
    explanation: &'static str,
) -> ParameterDescriptor {
    ParameterDescriptor {
        name,
        unit,
        minimum: (0.0, false),
        maximum: (f64::INFINITY, false),
        default: None,
        explanation,
    }
}

/// A parameter that is zero or more and must be given.
pub(crate) const fn non_negative(
    name: &'static str,
    unit: ParameterUnit,
    explanation: &'static str,
) -> ParameterDescriptor {
    positive(name, unit, explanation).within((0.0, true), (f64::INFINITY, false))
}

/// Elastic stiffness.
pub(crate) const STIFFNESS: ParameterDescriptor = positive(
    "stiffness",
    ParameterUnit::NewtonPerMetre,
    "Stiffness before yield",
);

/// Yield force.
pub(crate) const YIELD_FORCE: ParameterDescriptor = positive(
    "yield_force",
    ParameterUnit::Newton,
    "Force at which the element yields",
);

/// Ratio of the stiffness after yield, not negative.
pub(crate) const HARDENING_RATIO: ParameterDescriptor = non_negative(
    "hardening_ratio",
    ParameterUnit::One,
    "Stiffness after yield over stiffness before; a falling backbone would reach zero force, which this law cannot follow",
)
.within((0.0, true), (1.0, false))
.default_to(0.0);
