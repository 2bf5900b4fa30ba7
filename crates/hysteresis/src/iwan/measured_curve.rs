//! What is measured of an element over its deformation.

use super::density::IwanDensity;

/// What was measured over the deformation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MeasuredCurve {
    /// Dissipation of a cycle (J) over its amplitude (m).
    Dissipation,
    /// Force (N) over the deformation (m) on first loading.
    Backbone,
}

impl MeasuredCurve {
    /// What a density gives at a deformation (m): J or N.
    #[must_use]
    pub fn value(self, density: &IwanDensity, deformation: f64) -> f64 {
        match self {
            Self::Dissipation => density.cycle_dissipation(deformation),
            Self::Backbone => density.backbone(deformation).0,
        }
    }

    /// Unit of what was measured.
    #[must_use]
    pub fn unit(self) -> &'static str {
        match self {
            Self::Dissipation => "J",
            Self::Backbone => "N",
        }
    }

    /// What to do about data that are no such curve.
    pub(super) fn remedy(self) -> &'static str {
        match self {
            Self::Dissipation => {
                "give the energy of each cycle over its amplitude; check the order of the columns and their units"
            }
            Self::Backbone => {
                "give the force on first loading alone; check the order of the columns and their units"
            }
        }
    }
}
