//! Storey shears and base moments of buildings with a full stiffness matrix.

use std::sync::Arc;

use pounding_shear_building::ShearBuilding;

/// A force in a section of a building: a row on the displacements of its floors.
#[derive(Debug, Clone)]
pub(crate) struct SectionForce {
    pub place: SectionPlace,
    /// Number of the building's first floor among all.
    first: usize,
    /// One a floor (N/m, or N).
    weights: Vec<f64>,
}

/// Which force.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum SectionPlace {
    /// Shear of the storey below this floor, by its number among all.
    StoreyShear(usize),
    /// Overturning moment at the base of this building.
    BaseMoment(usize),
}

impl SectionForce {
    /// Sum over the floors, by their numbers among all and the weights.
    #[inline]
    pub(crate) fn terms(&self) -> impl Iterator<Item = (usize, f64)> {
        let weights = self.weights.iter().copied().enumerate();
        weights.map(|(i, weight)| (self.first + i, weight))
    }

    /// The force (N, or N m) at these floor displacements (m).
    pub(crate) fn at(&self, u: &[f64]) -> f64 {
        self.terms().map(|(i, weight)| weight * u[i]).sum()
    }
}

/// Those of all buildings that are no chains, one building after another, storeys from the
/// bottom, then the base.
pub(super) fn section_forces(
    buildings: &[Arc<ShearBuilding>],
    offsets: &[usize],
) -> Vec<SectionForce> {
    let mut all = Vec::new();
    for (b, building) in buildings.iter().enumerate() {
        let first = offsets[b];
        let rows = building.section_forces().into_iter().flatten();
        all.extend(rows.enumerate().map(|(i, weights)| SectionForce {
            place: match i < building.storeys() {
                true => SectionPlace::StoreyShear(first + i),
                false => SectionPlace::BaseMoment(b),
            },
            first,
            weights,
        }));
    }
    all
}
