//! The card of an impact model: what it is, needs, and is worth.

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
    /// Greatest allowed value and whether it is allowed itself.
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
    pub aliases: &'static [&'static str],
    /// A title for people.
    pub title: &'static str,
    /// The force law in plain characters.
    pub formula: &'static str,
    /// Author, year, journal, equation.
    pub citation: &'static str,
    /// Class of the law: elastic, Hunt-Crossley, linear, dry friction.
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
    /// How far it has been checked.
    pub verification: Verification,
    /// Known traps and what the law does not deliver.
    pub traps: &'static [&'static str],
    /// Builds the model from checked parameters.
    pub build: fn(&ModelParameters) -> Result<Box<dyn ImpactModel>, GapElementError>,
}
