//! The descriptor of an impact model: what it is, needs, and is worth.

use crate::error::GapElementError;
use crate::model::{ImpactModel, SeparationRule};
use crate::parameters::ModelParameters;

/// Unit of a parameter or constant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ParameterUnit {
    /// Dimensionless.
    One,
    /// N/m.
    NewtonPerMetre,
    /// N/m^n with the model's exponent n.
    NewtonPerMetreToExponent,
    /// N s/m.
    NewtonSecondPerMetre,
    /// s/m.
    SecondPerMetre,
    /// m.
    Metre,
    /// s.
    Second,
}

impl ParameterUnit {
    /// The unit in characters, `n` standing for the exponent of the law.
    #[must_use]
    pub fn symbol(self) -> &'static str {
        match self {
            Self::One => "-",
            Self::NewtonPerMetre => "N/m",
            Self::NewtonPerMetreToExponent => "N/m^n",
            Self::NewtonSecondPerMetre => "N s/m",
            Self::SecondPerMetre => "s/m",
            Self::Metre => "m",
            Self::Second => "s",
        }
    }
}

/// Another name of the identical law, with the paper that gave it.
#[derive(Debug, Clone, Copy)]
pub struct Alias {
    /// Name, accepted wherever the model's own is.
    pub name: &'static str,
    /// Author, year, journal; or why the name is common.
    pub citation: &'static str,
}

/// What the restitution of a free collision depends on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AchievedRestitution {
    /// Always 1.
    Elastic,
    /// The parameters without a unit alone: the same for every mass, stiffness
    /// and speed.
    Constant,
    /// Also mass, stiffness or speed.
    Varies,
}

/// One parameter that a user may give.
#[derive(Debug, Clone, Copy)]
pub struct ParameterDescriptor {
    /// Key in the case file, spelled out.
    pub name: &'static str,
    /// SI unit.
    pub unit: ParameterUnit,
    /// Least allowed value and whether it is allowed itself.
    pub minimum: (f64, bool),
    /// Maximum allowed value and whether it is allowed itself.
    pub maximum: (f64, bool),
    /// Value when the user gives none; `None`: the parameter is required
    /// (or one of a pair of alternatives, see `explanation`).
    pub default: Option<f64>,
    /// Whether a case without it is refused.
    pub required: bool,
    /// What it is, in a sentence.
    pub explanation: &'static str,
}

/// One constant that is fixed at closure and written with each impact.
#[derive(Debug, Clone, Copy)]
pub struct ConstantDescriptor {
    /// Name, spelled out.
    pub name: &'static str,
    /// SI unit.
    pub unit: ParameterUnit,
}

/// How far the implementation has been checked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verification {
    /// Checked against what the text names.
    Verified(&'static str),
    /// The formula or its constants come from secondary sources.
    SecondarySources(&'static str),
}

/// Everything that is known of a model without running it.
#[derive(Debug)]
pub struct ModelDescriptor {
    /// Name in the case file, `author_year`.
    pub name: &'static str,
    /// Other names of the identical law.
    pub aliases: &'static [Alias],
    /// A title for people.
    pub title: &'static str,
    /// The force law in plain characters.
    pub formula: &'static str,
    /// Author, year, journal, equation.
    pub citation: &'static str,
    /// Class of the law: the family, and after a comma its member. The
    /// documentation groups models by family.
    pub class: &'static str,
    /// Parameters that a user may give.
    pub parameters: &'static [ParameterDescriptor],
    /// Constants fixed at closure, in the order of
    /// [`crate::model::Collision::constants`].
    pub constants: &'static [ConstantDescriptor],
    /// Separation rules that the model offers, the default first.
    pub separation_rules: &'static [SeparationRule],
    /// Whether the law needs the approach velocity.
    pub needs_approach_velocity: bool,
    /// Whether the law needs the effective mass.
    pub needs_effective_mass: bool,
    /// What the achieved restitution depends on.
    pub achieved_restitution: AchievedRestitution,
    /// Whether we recommend it: it returns the restitution asked for.
    pub recommended: bool,
    /// How far it has been checked.
    pub verification: Verification,
    /// Plausible values (SI) of what must be given beside the restitution: the
    /// concrete floors of the documentation's examples.
    pub example: &'static [(&'static str, f64)],
    /// Known traps and what the law does not deliver.
    pub traps: &'static [&'static str],
    /// Builds the model from checked parameters.
    pub build: fn(&ModelParameters) -> Result<Box<dyn ImpactModel>, GapElementError>,
}

impl ModelDescriptor {
    /// The example's parameters, with this restitution where the model takes one.
    #[must_use]
    pub fn example_parameters(&self, restitution: f64) -> ModelParameters {
        let mut parameters = ModelParameters::from_pairs(self.example);
        if self.takes_restitution() {
            parameters
                .values
                .insert("restitution".to_owned(), restitution);
        }
        parameters
    }

    /// The family in [`ModelDescriptor::class`].
    #[must_use]
    pub fn family(&self) -> &'static str {
        self.class.split(',').next().unwrap_or(self.class)
    }

    /// Symbol of a unit, with the model's own exponent where that is not free.
    #[must_use]
    pub fn unit_symbol(&self, unit: ParameterUnit) -> &'static str {
        let free = self.parameters.iter().any(|p| p.name == "exponent");
        match unit {
            ParameterUnit::NewtonPerMetreToExponent if !free => "N/m^1.5",
            other => other.symbol(),
        }
    }

    /// Whether users may ask for a restitution.
    #[must_use]
    pub fn takes_restitution(&self) -> bool {
        self.parameters.iter().any(|p| p.name == "restitution")
    }
}
