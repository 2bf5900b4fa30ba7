//! The descriptor of a law: what it is, needs, and is worth.

pub use pounding_catalogue::{Alias, ParameterDescriptor, ParameterUnit, Verification};
use pounding_catalogue::{Descriptor, Parameters};

use super::HysteresisLaw;
use crate::error::HysteresisError;

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
    /// Why it serves as a link alone and no storey can have it, whatever its parameters: what carries a
    /// building resists lasting deformations in both directions. `None` for laws of storeys and links.
    pub link_alone: Option<&'static str>,
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
    pub build: fn(&Parameters) -> Result<Box<dyn HysteresisLaw>, HysteresisError>,
}

impl Descriptor for LawDescriptor {
    const KIND: &'static str = "hysteresis law";
    const NOUN: &'static str = "law";

    fn name(&self) -> &'static str {
        self.name
    }

    fn aliases(&self) -> &'static [Alias] {
        self.aliases
    }

    fn parameters(&self) -> &'static [ParameterDescriptor] {
        self.parameters
    }
}

impl LawDescriptor {
    /// The parameters of [`LawDescriptor::example`].
    #[must_use]
    pub fn example_parameters(&self) -> Parameters {
        Parameters::from_pairs(self.example)
    }
}
