//! Parameters of a model as a user gives them, and those that several models have.

use std::ops::{Deref, DerefMut};

use pounding_catalogue::{ParameterDescriptor, ParameterUnit, Parameters};
pub(crate) use pounding_catalogue::{optional_non_negative, optional_positive, positive};

use crate::separation_rule::SeparationRule;

/// Parameters by name (SI), the separation rule, and a measured spring.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ModelParameters {
    /// Parameters by name.
    pub parameters: Parameters,
    /// Separation rule; `None` is the model's first.
    pub separation: Option<SeparationRule>,
    /// Penetrations (m) and forces (N) of a spring that is given as a table, both increasing from
    /// above zero, in the place of stiffness and exponent: straight lines from the origin over
    /// the points, and on beyond the last. For models that hold for any spring
    /// ([`crate::ModelDescriptor::takes_spring_table`]).
    pub spring: Option<Vec<(f64, f64)>>,
}

impl Deref for ModelParameters {
    type Target = Parameters;

    fn deref(&self) -> &Parameters {
        &self.parameters
    }
}

impl DerefMut for ModelParameters {
    fn deref_mut(&mut self) -> &mut Parameters {
        &mut self.parameters
    }
}

impl From<Parameters> for ModelParameters {
    fn from(parameters: Parameters) -> Self {
        Self {
            parameters,
            separation: None,
            spring: None,
        }
    }
}

impl ModelParameters {
    /// Parameters from pairs of name and SI value.
    #[must_use]
    pub fn from_pairs(pairs: &[(&str, f64)]) -> Self {
        Parameters::from_pairs(pairs).into()
    }

    /// The same with a separation rule.
    #[must_use]
    pub fn with_separation(mut self, rule: SeparationRule) -> Self {
        self.separation = Some(rule);
        self
    }
}

/// `restitution` of a dissipative model, in (0, 1].
pub(crate) const RESTITUTION: ParameterDescriptor = ParameterDescriptor {
    maximum: (1.0, true),
    ..optional_positive(
        "restitution",
        ParameterUnit::One,
        "Ratio of separation to approach velocity asked for",
    )
};

/// Linear contact stiffness.
pub(crate) const LINEAR_STIFFNESS: ParameterDescriptor = positive(
    "stiffness",
    ParameterUnit::NewtonPerMetre,
    "Contact stiffness",
);

/// Contact stiffness of a law with the exponent 3/2.
pub(crate) const HERTZ_STIFFNESS: ParameterDescriptor = positive(
    "stiffness",
    ParameterUnit::NewtonPerMetreToExponent,
    "Contact stiffness, N/m^1.5",
);

/// Contact stiffness of a law with a free exponent.
pub(crate) const POWER_STIFFNESS: ParameterDescriptor = positive(
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
    ..optional_non_negative(
        "damping_ratio",
        ParameterUnit::One,
        "Damping ratio of the contact, instead of restitution",
    )
};

/// Damping factor of a model of the Hunt-Crossley class.
pub(crate) const DAMPING_FACTOR: ParameterDescriptor = ParameterDescriptor {
    maximum: (1e6, true),
    ..optional_non_negative(
        "damping_factor",
        ParameterUnit::One,
        "Dimensionless damping factor y, instead of restitution",
    )
};

/// Friction factor of a model with dry friction.
pub(crate) const FRICTION: ParameterDescriptor = optional_non_negative(
    "friction",
    ParameterUnit::One,
    "Friction factor D, instead of restitution; 1 and above is a plastic impact",
);
