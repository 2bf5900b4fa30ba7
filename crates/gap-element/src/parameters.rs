//! Parameters of a model as a user gives them, checked against its descriptor.

use std::ops::{Deref, DerefMut};

use pounding_catalogue::{Descriptor, Parameters};
pub(crate) use pounding_catalogue::{optional_non_negative, optional_positive, positive};

use crate::descriptor::{ModelDescriptor, ParameterDescriptor, ParameterUnit};
use crate::error::GapElementError;
use crate::model::SeparationRule;

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
    /// ([`ModelDescriptor::takes_spring_table`]).
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

    /// Refuses unknown, missing and out-of-range parameters, and a separation rule that the
    /// model does not offer.
    pub(crate) fn check(&self, model: &'static ModelDescriptor) -> Result<(), GapElementError> {
        match &self.spring {
            Some(table) => self.check_spring(model, table)?,
            None => self.parameters.check(model)?,
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

    /// The same with a table of a spring, whose first line stands for the stiffness.
    fn check_spring(
        &self,
        model: &'static ModelDescriptor,
        table: &[(f64, f64)],
    ) -> Result<(), GapElementError> {
        if !model.takes_spring_table() {
            return Err(GapElementError::SpringTable(format!(
                "model {} takes none",
                model.name
            )));
        }
        let given = ["stiffness", "exponent"]
            .into_iter()
            .find(|name| self.given(name).is_some());
        if let Some(second) = given {
            return Err(GapElementError::Conflict {
                model: model.name,
                first: "spring",
                second,
            });
        }
        let Some((penetration, force)) = table.first() else {
            return Err(GapElementError::SpringTable("it is empty".to_owned()));
        };
        let mut all = self.parameters.clone();
        let slope = force / penetration;
        // What is wrong with the table is said where it is taken apart.
        let slope = if slope.is_finite() && slope > 0.0 {
            slope
        } else {
            1.0
        };
        all.values.insert("stiffness".to_owned(), slope);
        all.check(model)?;
        Ok(())
    }

    /// The separation rule asked for, or the model's first.
    #[must_use]
    pub fn separation(&self, model: &ModelDescriptor) -> SeparationRule {
        self.separation
            .or_else(|| model.separation_rules.first().copied())
            .unwrap_or(SeparationRule::ZeroPenetration)
    }

    /// Exponent of the spring: as given, or the default of the model's parameter, or 1.
    pub(crate) fn exponent(&self, model: &ModelDescriptor) -> f64 {
        self.get(model, "exponent").unwrap_or(1.0)
    }

    /// The damping parameter itself, or from the restitution by the model's own
    /// relation; exactly one of the two must be given.
    pub(crate) fn damping(
        &self,
        model: &ModelDescriptor,
        raw: &'static str,
        relation: impl Fn(f64) -> f64,
    ) -> Result<f64, GapElementError> {
        match (self.given("restitution"), self.given(raw)) {
            (Some(_), Some(_)) => Err(GapElementError::Conflict {
                model: model.name,
                first: "restitution",
                second: raw,
            }),
            (Some(e), None) => Ok(relation(e)),
            (None, Some(value)) => Ok(value),
            (None, None) => Err(model.missing(format!("restitution or {raw}")).into()),
        }
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
