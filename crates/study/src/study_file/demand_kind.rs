//! Demands whose exceedance is asked for, and where they belong to.

use pounding_case::{Building, Dimension, Support};
use schemars::JsonSchema;
use serde::Deserialize;

/// A demand whose exceedance is asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(
    rename = "demand",
    rename_all = "snake_case",
    expecting = "a text in quotes"
)]
pub enum DemandKind {
    /// Maximum floor displacement (m).
    Displacement,
    /// Maximum drift ratio (-).
    DriftRatio,
    /// Maximum storey shear (N).
    StoreyShear,
    /// Maximum absolute floor acceleration (m/s2).
    AccelerationAbsolute,
    /// Maximum ductility of storeys with a yield force (-).
    Ductility,
    /// Magnitude of the residual drift ratio of storeys with a law (-).
    ResidualDriftRatio,
    /// Maximum overturning moment at the base of a building with a stiffness matrix or a
    /// foundation (N m).
    BaseMoment,
    /// Maximum displacement of a foundation relative to the ground (m).
    FoundationSway,
    /// Maximum rotation of a foundation (rad).
    FoundationRotation,
    /// Maximum force of the sway spring below a foundation (N).
    FoundationShear,
    /// Maximum moment of the rocking spring below a foundation (N m).
    FoundationMoment,
    /// Maximum moment on a foundation over half of weight times length (-).
    OverturningRatio,
    /// Maximum rotation of a floor that turns in plan (rad).
    Rotation,
    /// Maximum displacement along the row of both ends of a floor that turns in plan (m).
    EdgeDisplacement,
    /// Maximum displacement across the row of a floor that turns in plan (m).
    DisplacementAcross,
    /// Maximum absolute acceleration across the row of a floor that turns in plan (m/s2).
    AccelerationAcross,
    /// Maximum contact force (N).
    ContactForce,
    /// Maximum shear of columns that are hit (N).
    ColumnShear,
    /// Maximum opening of joints with a seat, beyond their width at rest (m).
    Opening,
    /// Maximum force of links between floors or displacements of foundations (N).
    LinkForce,
    /// Maximum deformation of such links (m).
    LinkDeformation,
    /// Maximum impulse of one impact (N s).
    Impulse,
    /// Number of impacts.
    Impacts,
    /// Maximum relative displacement of the isolated buildings (m).
    IsolatedDemand,
}

impl DemandKind {
    /// What it is called, and which buildings have it, of a demand that belongs to the building
    /// as a whole.
    pub(super) fn of_building(self) -> Option<OfBuilding> {
        type Has = fn(&Building) -> bool;
        let (name, has, of): (_, Has, _) = match self {
            Self::BaseMoment => (
                "the base moment",
                |b| b.lateral.is_some() || b.foundation.is_some() || b.plan.is_some(),
                "on a foundation, with a plan or with a stiffness matrix",
            ),
            Self::FoundationSway | Self::FoundationShear => (
                "sway",
                |b| support(b).is_some_and(Support::sways),
                "with a foundation that sways",
            ),
            Self::FoundationRotation | Self::FoundationMoment => (
                "rotation",
                |b| support(b).is_some_and(Support::rocks),
                "with a foundation that rocks",
            ),
            Self::OverturningRatio => (
                "the overturning ratio",
                |b| {
                    let foundation = b.foundation.as_ref();
                    foundation.is_some_and(|f| f.value.length.is_some())
                },
                "with a foundation whose length is known",
            ),
            _ => return None,
        };
        Some(OfBuilding { name, has, of })
    }

    /// Whether it belongs to the contact levels of gaps.
    pub(super) fn of_levels(self) -> bool {
        matches!(
            self,
            Self::ContactForce
                | Self::ColumnShear
                | Self::Opening
                | Self::Impulse
                | Self::Impacts
                | Self::IsolatedDemand
        )
    }

    /// Whether it belongs to the levels of links.
    pub(super) fn of_links(self) -> bool {
        matches!(self, Self::LinkForce | Self::LinkDeformation)
    }

    /// Whether only storeys with a law have it.
    pub(super) fn of_laws(self) -> bool {
        matches!(self, Self::Ductility | Self::ResidualDriftRatio)
    }

    /// Whether only floors that turn in plan have it.
    pub(super) fn of_floors_that_turn(self) -> bool {
        matches!(
            self,
            Self::Rotation
                | Self::EdgeDisplacement
                | Self::DisplacementAcross
                | Self::AccelerationAcross
        )
    }

    /// Dimension of its values.
    #[must_use]
    pub fn dimension(self) -> Dimension {
        match self {
            Self::Displacement
            | Self::IsolatedDemand
            | Self::Opening
            | Self::LinkDeformation
            | Self::FoundationSway
            | Self::EdgeDisplacement
            | Self::DisplacementAcross => Dimension::LENGTH,
            Self::DriftRatio
            | Self::Ductility
            | Self::ResidualDriftRatio
            | Self::Impacts
            | Self::FoundationRotation
            | Self::Rotation
            | Self::OverturningRatio => Dimension::NUMBER,
            Self::StoreyShear
            | Self::ContactForce
            | Self::FoundationShear
            | Self::ColumnShear
            | Self::LinkForce => Dimension::FORCE,
            Self::AccelerationAbsolute | Self::AccelerationAcross => Dimension::ACCELERATION,
            // Of a moment, as of an energy.
            Self::BaseMoment | Self::FoundationMoment => Dimension::ENERGY,
            Self::Impulse => Dimension {
                mass: 1.0,
                length: 1.0,
                time: -1.0,
            },
        }
    }
}

/// A demand that belongs to a building as a whole.
pub(super) struct OfBuilding {
    pub name: &'static str,
    pub has: fn(&Building) -> bool,
    /// Which buildings have it, in words.
    pub of: &'static str,
}

fn support(building: &Building) -> Option<&Support> {
    Some(&building.foundation.as_ref()?.value.support)
}
