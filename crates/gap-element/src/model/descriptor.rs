//! The descriptor of an impact model: what it is, needs, and is worth; parameters against it.

use pounding_catalogue::Descriptor;
pub use pounding_catalogue::{Alias, ParameterDescriptor, ParameterUnit, Verification};

use super::{ImpactModel, SeparationRule};
use crate::error::GapElementError;
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

impl ModelParameters {
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
