//! A provision of the registry or a rule of the user, alike.

use std::borrow::Cow;
use std::sync::Arc;

use crate::assumptions::Assumptions;
use crate::descriptor::{Basis, Place, ProvisionDescriptor};
use crate::error::SeparationError;
use crate::inputs::{Input, Site, Situation, Structure};
use crate::own::OwnRule;
use crate::status::Status;
use crate::working::Requirement;

/// A rule for the gap.
#[derive(Debug, Clone)]
pub enum Provision {
    /// One of the registry.
    BuiltIn(&'static ProvisionDescriptor),
    /// One of the user.
    Own(Arc<OwnRule>),
}

impl From<&'static ProvisionDescriptor> for Provision {
    fn from(descriptor: &'static ProvisionDescriptor) -> Self {
        Self::BuiltIn(descriptor)
    }
}

impl Provision {
    /// Name.
    #[must_use]
    pub fn name(&self) -> &str {
        match self {
            Self::BuiltIn(p) => p.name,
            Self::Own(rule) => rule.name(),
        }
    }

    /// Country or city.
    #[must_use]
    pub fn region(&self) -> &str {
        match self {
            Self::BuiltIn(p) => p.edition.region,
            Self::Own(rule) => rule.region(),
        }
    }

    /// Code with its edition.
    #[must_use]
    pub fn edition(&self) -> &str {
        match self {
            Self::BuiltIn(p) => p.edition.title,
            Self::Own(rule) => rule.edition(),
        }
    }

    /// Clause; empty if not known.
    #[must_use]
    pub fn clause(&self) -> &str {
        match self {
            Self::BuiltIn(p) => p.clause,
            Self::Own(rule) => rule.clause(),
        }
    }

    /// From when to when its edition is in force, as far as that is known, in words.
    #[must_use]
    pub fn in_force(&self) -> Option<String> {
        match self {
            Self::BuiltIn(p) => p.edition.in_force.map(|known| known.explanation()),
            Self::Own(_) => None,
        }
    }

    /// The edition that took its place, if one is known.
    #[must_use]
    pub fn superseded_by(&self) -> Option<&'static str> {
        match self {
            Self::BuiltIn(p) => p.edition.superseded_by,
            Self::Own(_) => None,
        }
    }

    /// What it measures.
    #[must_use]
    pub fn place(&self) -> Place {
        match self {
            Self::BuiltIn(p) => p.place(),
            Self::Own(rule) => rule.place(),
        }
    }

    /// What it rests on.
    #[must_use]
    pub fn basis(&self) -> Basis {
        match self {
            Self::BuiltIn(p) => p.basis,
            Self::Own(rule) if rule.depends_on_displacement() => Basis::Displacement,
            Self::Own(_) => Basis::Prescriptive,
        }
    }

    /// Formula in plain characters.
    #[must_use]
    pub fn formula(&self) -> Cow<'static, str> {
        match self {
            Self::BuiltIn(p) => p.formula.into(),
            Self::Own(rule) => rule.formula().into(),
        }
    }

    /// How far it may be trusted.
    #[must_use]
    pub fn status(&self) -> Status {
        match self {
            Self::BuiltIn(p) => p.status,
            Self::Own(_) => Status::Yours,
        }
    }

    /// Where it was seen, or stands.
    #[must_use]
    pub fn source(&self) -> Cow<'static, str> {
        match self {
            Self::BuiltIn(p) => p.status.remark().into(),
            Self::Own(rule) => rule.file().to_owned().into(),
        }
    }

    /// What the code multiplies the displacement of an elastic analysis by.
    #[must_use]
    pub fn elastic_displacement_factor(&self) -> Option<&'static str> {
        match self {
            Self::BuiltIn(p) => p.elastic_displacement_factor,
            Self::Own(_) => None,
        }
    }

    /// Inputs that it needs beside heights and storeys.
    #[must_use]
    pub fn inputs(&self) -> Vec<Input> {
        match self {
            Self::BuiltIn(p) => p.inputs.to_vec(),
            Self::Own(rule) => rule.inputs(),
        }
    }

    /// What it takes for granted.
    #[must_use]
    pub fn assumptions(&self) -> Assumptions {
        match self {
            Self::BuiltIn(p) => p.assumptions(),
            Self::Own(rule) => rule.assumptions(),
        }
    }

    /// What else a user should know of it; what a rule of the user takes for granted is theirs to
    /// say.
    #[must_use]
    pub fn remarks(&self) -> &'static [&'static str] {
        match self {
            Self::BuiltIn(p) => p.remarks,
            Self::Own(_) => &[],
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
        site: &Site,
    ) -> Result<Requirement, SeparationError> {
        match self {
            Self::BuiltIn(p) => p.boundary(structure, site),
            Self::Own(rule) => rule.boundary(structure, site),
        }
    }

    /// Distance between two buildings (m). A boundary rule gives the sum of the
    /// distances that either building keeps from the border.
    ///
    /// # Errors
    /// An input that is missing, or a situation that the provision does not cover.
    pub fn between(&self, situation: &Situation) -> Result<Requirement, SeparationError> {
        match self {
            Self::BuiltIn(p) => p.between(situation),
            Self::Own(rule) => rule.between(situation),
        }
    }
}
