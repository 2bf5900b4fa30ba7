//! The descriptor of a law: what it is, needs, and is worth.

use crate::error::HysteresisError;
use crate::law::HysteresisLaw;
use crate::parameters::LawParameters;

/// Unit of a parameter.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ParameterUnit {
    /// Dimensionless.
    One,
    /// N.
    Newton,
    /// N/m.
    NewtonPerMetre,
    /// N/m^(2+alpha) with the law's exponent alpha.
    NewtonPerMetreToExponent,
    /// N (s/m)^a with the law's exponent a.
    NewtonSecondPerMetreToExponent,
    /// N s/m.
    NewtonSecondPerMetre,
    /// m.
    Metre,
    /// m/s.
    MetrePerSecond,
}

impl ParameterUnit {
    /// The unit in characters.
    #[must_use]
    pub fn symbol(self) -> &'static str {
        match self {
            Self::One => "-",
            Self::Newton => "N",
            Self::NewtonPerMetre => "N/m",
            Self::NewtonPerMetreToExponent => "N/m^(2+alpha)",
            Self::NewtonSecondPerMetreToExponent => "N (s/m)^a",
            Self::NewtonSecondPerMetre => "N s/m",
            Self::Metre => "m",
            Self::MetrePerSecond => "m/s",
        }
    }
}

/// Another name of the identical law.
#[derive(Debug, Clone, Copy)]
pub struct Alias {
    /// Name, accepted wherever the law's own is.
    pub name: &'static str,
    /// Author, year, journal; or why the name is common.
    pub citation: &'static str,
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
    /// Value when the user gives none; `None`: the parameter is required.
    pub default: Option<f64>,
    /// What it is, in a sentence.
    pub explanation: &'static str,
}

/// How far the implementation has been checked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verification {
    /// Checked against what the text names.
    Verified(&'static str),
    /// The rules come from secondary sources; the text says what was checked.
    SecondarySources(&'static str),
}

/// Everything that is known of a law without running it.
#[derive(Debug)]
pub struct LawDescriptor {
    /// Name in the case file, `author_year` or the standard name.
    pub name: &'static str,
    /// Other names of the identical law.
    pub aliases: &'static [Alias],
    /// A title for people.
    pub title: &'static str,
    /// The law in plain characters.
    pub formula: &'static str,
    /// Author, year, journal, equation.
    pub citation: &'static str,
    /// Parameters that a user may give.
    pub parameters: &'static [ParameterDescriptor],
    /// Whether the force depends on the speed of the deformation.
    pub rate_dependent: bool,
    /// How far it has been checked.
    pub verification: Verification,
    /// Plausible values (SI) of the required parameters: a storey or a link of a
    /// concrete building.
    pub example: &'static [(&'static str, f64)],
    /// A deformation (m) that takes the example through all its branches when it is
    /// cycled.
    pub example_amplitude: f64,
    /// Known traps and what the law does not deliver.
    pub traps: &'static [&'static str],
    /// Builds the law from checked parameters.
    pub build: fn(&LawParameters) -> Result<Box<dyn HysteresisLaw>, HysteresisError>,
}

impl LawDescriptor {
    /// The parameters of [`LawDescriptor::example`].
    #[must_use]
    pub fn example_parameters(&self) -> LawParameters {
        LawParameters::from_pairs(self.example)
    }
}
