//! Parameters of a model as a user gives them, checked against its descriptor.

use std::collections::BTreeMap;

use crate::descriptor::{ModelDescriptor, ParameterDescriptor, ParameterUnit};
use crate::error::GapElementError;
use crate::model::SeparationRule;

/// Parameters by name (SI) and the separation rule.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ModelParameters {
    /// Values in SI units.
    pub values: BTreeMap<String, f64>,
    /// Separation rule; `None` is the model's first.
    pub separation: Option<SeparationRule>,
}

impl ModelParameters {
    /// Parameters from pairs of name and SI value.
    #[must_use]
    pub fn from_pairs(pairs: &[(&str, f64)]) -> Self {
        Self {
            values: pairs.iter().map(|(k, v)| ((*k).to_owned(), *v)).collect(),
            separation: None,
        }
    }

    /// The same with a separation rule.
    #[must_use]
    pub fn with_separation(mut self, rule: SeparationRule) -> Self {
        self.separation = Some(rule);
        self
    }

    /// Refuses unknown and out-of-range parameters.
    ///
    /// # Errors
    /// The first parameter that the model does not have or does not allow.
    pub fn check_values(&self, model: &'static ModelDescriptor) -> Result<(), GapElementError> {
        for (name, value) in &self.values {
            let Some(parameter) = model.parameters.iter().find(|p| p.name == name) else {
                return Err(GapElementError::UnknownParameter {
                    model: model.name,
                    parameter: name.clone(),
                    known: model.parameters.iter().map(|p| p.name).collect(),
                });
            };
            if !parameter.allows(*value) {
                return Err(GapElementError::OutOfRange {
                    model: model.name,
                    parameter: parameter.name,
                    value: *value,
                    range: parameter.range(),
                });
            }
        }
        Ok(())
    }

    /// Refuses unknown, missing and out-of-range parameters.
    pub(crate) fn check(&self, model: &'static ModelDescriptor) -> Result<(), GapElementError> {
        self.check_values(model)?;
        for parameter in model.parameters.iter().filter(|p| p.required) {
            self.required(model.name, parameter.name)?;
        }
        let rule = self.separation(model);
        if !model.separation_rules.contains(&rule) {
            return Err(GapElementError::Separation {
                model: model.name,
                rule: rule.name().to_owned(),
                offered: model.separation_rules.iter().map(|r| r.name()).collect(),
            });
        }
        Ok(())
    }

    /// The separation rule asked for, or the model's first.
    #[must_use]
    pub fn separation(&self, model: &ModelDescriptor) -> SeparationRule {
        self.separation
            .or_else(|| model.separation_rules.first().copied())
            .unwrap_or(SeparationRule::ZeroPenetration)
    }

    /// Exponent of the spring: as given, or the default of the model's parameter.
    pub(crate) fn exponent(&self, model: &ModelDescriptor) -> f64 {
        self.get("exponent").unwrap_or_else(|| {
            let known = model.parameters.iter().find(|p| p.name == "exponent");
            known.and_then(|p| p.default).unwrap_or(1.0)
        })
    }

    pub(crate) fn get(&self, name: &str) -> Option<f64> {
        self.values.get(name).copied()
    }

    pub(crate) fn required(
        &self,
        model: &'static str,
        name: &'static str,
    ) -> Result<f64, GapElementError> {
        self.get(name)
            .ok_or_else(|| GapElementError::MissingParameter {
                model,
                parameter: name.to_owned(),
            })
    }

    /// The damping parameter itself, or from the restitution by the model's own
    /// relation; exactly one of the two must be given.
    pub(crate) fn damping(
        &self,
        model: &'static str,
        raw: &'static str,
        relation: impl Fn(f64) -> f64,
    ) -> Result<f64, GapElementError> {
        match (self.get("restitution"), self.get(raw)) {
            (Some(_), Some(_)) => Err(GapElementError::Conflict {
                model,
                first: "restitution",
                second: raw,
            }),
            (Some(e), None) => Ok(relation(e)),
            (None, Some(value)) => Ok(value),
            (None, None) => Err(GapElementError::MissingParameter {
                model,
                parameter: format!("restitution or {raw}"),
            }),
        }
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
}

impl SeparationRule {
    /// All rules.
    pub const ALL: [Self; 4] = [
        Self::ZeroPenetration,
        Self::NoTension,
        Self::NoTensionLatched,
        Self::GapShift,
    ];

    /// Name in the case file.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::ZeroPenetration => "zero_penetration",
            Self::NoTension => "no_tension",
            Self::NoTensionLatched => "no_tension_latched",
            Self::GapShift => "gap_shift",
        }
    }

    /// The rule of this name in the case file.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|rule| rule.name() == name)
    }
}

/// A parameter that is positive.
const fn positive(
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
        required: false,
        explanation,
    }
}

/// A parameter that is positive and must be given.
pub(crate) const fn required_positive(
    name: &'static str,
    unit: ParameterUnit,
    explanation: &'static str,
) -> ParameterDescriptor {
    ParameterDescriptor {
        required: true,
        ..positive(name, unit, explanation)
    }
}

/// A parameter that is positive and may be left out.
pub(crate) const fn optional_positive(
    name: &'static str,
    unit: ParameterUnit,
    explanation: &'static str,
) -> ParameterDescriptor {
    positive(name, unit, explanation)
}

/// A parameter that is zero or more and may be left out.
pub(crate) const fn optional(
    name: &'static str,
    unit: ParameterUnit,
    explanation: &'static str,
) -> ParameterDescriptor {
    ParameterDescriptor {
        minimum: (0.0, true),
        ..positive(name, unit, explanation)
    }
}

/// `restitution` of a dissipative model, in (0, 1].
pub(crate) const RESTITUTION: ParameterDescriptor = ParameterDescriptor {
    maximum: (1.0, true),
    ..positive(
        "restitution",
        ParameterUnit::One,
        "Ratio of separation to approach velocity asked for",
    )
};

/// Linear contact stiffness.
pub(crate) const LINEAR_STIFFNESS: ParameterDescriptor = required_positive(
    "stiffness",
    ParameterUnit::NewtonPerMetre,
    "Contact stiffness",
);

/// Contact stiffness of a law with the exponent 3/2.
pub(crate) const HERTZ_STIFFNESS: ParameterDescriptor = required_positive(
    "stiffness",
    ParameterUnit::NewtonPerMetreToExponent,
    "Contact stiffness, N/m^1.5",
);

/// Contact stiffness of a law with a free exponent.
pub(crate) const POWER_STIFFNESS: ParameterDescriptor = required_positive(
    "stiffness",
    ParameterUnit::NewtonPerMetreToExponent,
    "Contact stiffness, N/m^n with the exponent n",
);

/// Exponent of the spring.
pub(crate) const EXPONENT: ParameterDescriptor = ParameterDescriptor {
    name: "exponent",
    unit: ParameterUnit::One,
    minimum: (1.0, true),
    maximum: (5.0, true),
    default: Some(1.5),
    required: false,
    explanation: "Exponent n of the spring",
};

/// Damping ratio of a model of the linear class.
///
/// Above 1e4 next to nothing of the approach velocity is given back, and every tenfold
/// takes six times the steps.
pub(crate) const DAMPING_RATIO: ParameterDescriptor = ParameterDescriptor {
    maximum: (1e4, true),
    ..optional(
        "damping_ratio",
        ParameterUnit::One,
        "Damping ratio of the contact, instead of restitution",
    )
};

/// Damping factor of a model of the Hunt-Crossley class.
pub(crate) const DAMPING_FACTOR: ParameterDescriptor = ParameterDescriptor {
    maximum: (1e6, true),
    ..optional(
        "damping_factor",
        ParameterUnit::One,
        "Dimensionless damping factor y, instead of restitution",
    )
};

/// Friction factor of a model with dry friction.
pub(crate) const FRICTION: ParameterDescriptor = ParameterDescriptor {
    maximum: (1.0, false),
    ..optional(
        "friction",
        ParameterUnit::One,
        "Friction factor D, instead of restitution",
    )
};
