//! The descriptor of an impact model: what it is, needs, and is worth.

use pounding_catalogue::Descriptor;
pub use pounding_catalogue::{Alias, ParameterDescriptor, ParameterUnit, Verification};

use crate::error::GapElementError;
use crate::model::{ImpactModel, SeparationRule};
use crate::parameters::ModelParameters;

/// What the restitution of a free collision depends on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AchievedRestitution {
    /// Always 1.
    Elastic,
    /// The parameters without a unit alone: the same for every mass, stiffness
    /// and speed, from [`crate::model::APPROACH_VELOCITY_FLOOR`] on of laws that divide by it.
    Constant,
    /// Also mass, stiffness or speed.
    Varies,
}

/// One constant that is fixed at closure and written with each impact.
#[derive(Debug, Clone, Copy)]
pub struct ConstantDescriptor {
    /// Name, spelled out.
    pub name: &'static str,
    /// SI unit.
    pub unit: ParameterUnit,
}

/// A constant of this name and unit.
pub(crate) const fn constant(name: &'static str, unit: ParameterUnit) -> ConstantDescriptor {
    ConstantDescriptor { name, unit }
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

impl Descriptor for ModelDescriptor {
    const KIND: &'static str = "impact model";
    const NOUN: &'static str = "model";

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

impl ModelDescriptor {
    /// Whether it is of a bumper, by its title: of something between the floors that is meant to be softer
    /// than they are.
    #[must_use]
    pub fn is_of_bumper(&self) -> bool {
        self.title
            .split(' ')
            .any(|word| word.eq_ignore_ascii_case("bumper"))
    }

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

    /// Whether the spring may be given as a table: the law holds for any force that increases.
    #[must_use]
    pub fn takes_spring_table(&self) -> bool {
        self.class == "dry friction"
    }

    /// Whether the law divides by the approach velocity, and so by
    /// [`crate::model::APPROACH_VELOCITY_FLOOR`] in slower collisions, where it is damped less.
    #[must_use]
    pub fn divides_by_approach_velocity(&self) -> bool {
        self.needs_approach_velocity && self.takes_restitution() && self.family() != "rigid"
    }

    /// Whether users may ask for a restitution.
    #[must_use]
    pub fn takes_restitution(&self) -> bool {
        self.parameters.iter().any(|p| p.name == "restitution")
    }
}
