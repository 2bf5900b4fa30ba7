//! The descriptor of a provision.

use pounding_catalogue::Descriptor;
pub use pounding_catalogue::Verification;

use crate::error::SeparationError;
use crate::inputs::{Input, Site, Situation, Structure};
use crate::working::{Requirement, Working};

/// What a rule measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// From one building to the border of its own site.
    Boundary,
    /// Between two buildings.
    Between,
}

impl Place {
    /// A word for tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Boundary => "boundary",
            Self::Between => "between",
        }
    }
}

/// What a rule rests on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Basis {
    /// Computed displacements.
    Displacement,
    /// What the code itself takes of structures, such as heights, kinds or isolators.
    Prescriptive,
}

impl Basis {
    /// A word for tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Displacement => "displacement",
            Self::Prescriptive => "prescriptive",
        }
    }
}

/// How a provision computes.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Rule {
    /// One building, height of the level (m).
    Boundary(fn(&mut Working, &Structure, f64, &Site) -> Result<f64, SeparationError>),
    /// Two buildings.
    Between(fn(&mut Working, &Situation) -> Result<f64, SeparationError>),
}

/// Everything that is known of a provision without applying it.
#[derive(Debug, Clone, Copy)]
pub struct ProvisionDescriptor {
    /// Name: code, edition, and what it measures.
    pub name: &'static str,
    /// Country or city.
    pub region: &'static str,
    /// Code with its edition.
    pub edition: &'static str,
    /// Clause; empty if not known.
    pub clause: &'static str,
    /// What it rests on.
    pub basis: Basis,
    /// What the code multiplies the displacement of an elastic analysis under its reduced
    /// forces by, in its own symbols; `None` for a rule that takes displacements as an
    /// analysis gives them, or none. Such a rule does not hold for the displacement of an
    /// analysis in which the structure yields: the factor would count its ductility twice.
    pub elastic_displacement_factor: Option<&'static str>,
    /// Formula in plain characters. `u` is the unreduced peak displacement, `d` that
    /// under the reduced forces of the code, `I u / R` unless given; `h` the height of
    /// the level.
    pub formula: &'static str,
    /// Inputs that it needs beside heights and storeys.
    pub inputs: &'static [Input],
    /// How far the formula has been checked.
    pub status: Verification,
    /// What else a user should know.
    pub remarks: &'static [&'static str],
    pub(crate) rule: Rule,
}

impl Descriptor for ProvisionDescriptor {
    const KIND: &'static str = "provision";
    const NOUN: &'static str = "provision";

    fn name(&self) -> &'static str {
        self.name
    }
}

impl ProvisionDescriptor {
    /// Whether the rule is one for isolated structures, and says nothing of others.
    #[must_use]
    pub fn is_of_isolated_structures(&self) -> bool {
        self.inputs.contains(&Input::IsolationPeriod)
    }

    /// Whether it takes displacements, and not only what is known without an analysis.
    #[must_use]
    pub fn depends_on_displacement(&self) -> bool {
        self.basis == Basis::Displacement
    }

    /// What the rule measures.
    #[must_use]
    pub fn place(&self) -> Place {
        match self.rule {
            Rule::Boundary(_) => Place::Boundary,
            Rule::Between(_) => Place::Between,
        }
    }

    /// Distance of one building from the border of its site (m).
    ///
    /// # Errors
    /// An input that is missing, a situation that the provision does not cover, or a
    /// rule that holds between two buildings.
    pub fn boundary(
        &self,
        structure: &Structure,
        elevation: f64,
        site: &Site,
    ) -> Result<Requirement, SeparationError> {
        let mut working = Working::new(self.name);
        let Rule::Boundary(rule) = self.rule else {
            return Err(working.not_applicable("it needs a building on either side"));
        };
        let width = rule(&mut working, structure, elevation, site)?;
        working.finish(self.formula, (width, site), self.caution(&[structure]))
    }

    /// Distance between two buildings (m). A boundary rule gives the sum of the
    /// distances that either building keeps from the border.
    ///
    /// # Errors
    /// An input that is missing, or a situation that the provision does not cover.
    pub fn between(&self, situation: &Situation) -> Result<Requirement, SeparationError> {
        let mut working = Working::new(self.name);
        let caution = self.caution(&[&situation.left, &situation.right]);
        match self.rule {
            Rule::Between(rule) => {
                let width = rule(&mut working, situation)?;
                working.finish(self.formula, (width, &situation.site), caution)
            }
            Rule::Boundary(rule) => {
                let Situation {
                    left,
                    right,
                    elevation,
                    site,
                } = situation;
                let left = rule(&mut working, left, *elevation, site)?;
                let right = rule(&mut working, right, *elevation, site)?;
                let width = working.note("own side, left", left, "m")
                    + working.note("own side, right", right, "m");
                let formula = format!("{}, summed over both sides", self.formula);
                working.finish(&formula, (width, site), caution)
            }
        }
    }

    /// Why the rule does not hold for the displacements of these structures.
    fn caution(&self, structures: &[&Structure]) -> Option<String> {
        let factor = self.elastic_displacement_factor?;
        let taken = |s: &&&Structure| s.inelastic && s.elastic_displacement.is_none();
        let names: Vec<_> = structures.iter().filter(taken).map(|s| &*s.name).collect();
        if names.is_empty() {
            return None;
        }
        Some(format!(
            "the rule is for elastic displacements, which the code multiplies by {factor}; that of {} is inelastic already, and its ductility must not be counted again",
            names.join(" and ")
        ))
    }
}

/// A code that is known to speak of gaps, with no formula here.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Unavailable {
    /// Country or city.
    pub region: &'static str,
    /// Code with its edition.
    pub edition: &'static str,
    /// Why there is no formula.
    pub reason: &'static str,
}
