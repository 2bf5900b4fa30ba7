//! Responses of buildings that are sums over their coordinates: storey shears and base moments
//! of full stiffness matrices, drifts of buildings on a foundation that rotates, and responses
//! with names of their own.

use std::ops::Range;
use std::sync::Arc;

use pounding_shear_building::{ResponseKind, ShearBuilding};

/// A response as a row on the coordinates of a building.
#[derive(Debug, Clone)]
pub(crate) struct SectionForce {
    pub place: SectionPlace,
    /// Degrees of freedom of the floors of the building, and of its other coordinates.
    parts: [Range<usize>; 2],
    /// One a coordinate (N/m, or N).
    weights: Vec<f64>,
}

/// Which response.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum SectionPlace {
    /// Shear of the storey below this floor, by its number among all.
    StoreyShear(usize),
    /// Overturning moment at the base of this building.
    BaseMoment(usize),
    /// Drift of the storey below this floor (m), by its number among all.
    Drift(usize),
    /// A response with a name, by its number among those of all buildings.
    Named(usize),
}

impl SectionForce {
    /// Sum over the coordinates, by their degrees of freedom and the weights.
    #[inline]
    pub(crate) fn terms(&self) -> impl Iterator<Item = (usize, f64)> {
        let [floors, further] = self.parts.clone();
        floors.chain(further).zip(self.weights.iter().copied())
    }

    /// The response at these displacements.
    pub(crate) fn at(&self, u: &[f64]) -> f64 {
        self.terms().map(|(i, weight)| weight * u[i]).sum()
    }
}

/// Those of displacements, one building after another: storey shears from the bottom, the base
/// moment, drifts, then named ones.
pub(super) fn section_forces(
    buildings: &[Arc<ShearBuilding>],
    offsets: &[usize],
    further: &[usize],
) -> Vec<SectionForce> {
    let mut all = Vec::new();
    let mut named = 0;
    for (b, building) in buildings.iter().enumerate() {
        let first = offsets[b];
        let parts = [first..offsets[b + 1], further[b]..further[b + 1]];
        let mut add = |place: SectionPlace, weights: Vec<f64>| {
            all.push(SectionForce {
                place,
                parts: parts.clone(),
                weights,
            });
        };
        let rows = building.section_forces().into_iter().flatten();
        for (i, weights) in rows.enumerate() {
            let place = match i < building.storeys() {
                true => SectionPlace::StoreyShear(first + i),
                false => SectionPlace::BaseMoment(b),
            };
            add(place, weights);
        }
        for (i, weights) in building.drifts().unwrap_or_default().iter().enumerate() {
            add(SectionPlace::Drift(first + i), weights.clone());
        }
        for row in building.responses() {
            if row.kind == ResponseKind::Displacement {
                add(SectionPlace::Named(named), row.weights.clone());
            }
            named += 1;
        }
    }
    all
}

/// Those of absolute accelerations.
pub(super) fn acceleration_responses(
    buildings: &[Arc<ShearBuilding>],
    offsets: &[usize],
    further: &[usize],
) -> Vec<SectionForce> {
    let mut named = 0..;
    let of = |(b, building): (usize, &Arc<ShearBuilding>)| {
        let parts = [offsets[b]..offsets[b + 1], further[b]..further[b + 1]];
        let rows = building.responses().iter().zip(named.by_ref());
        let accelerations = rows.filter(|(row, _)| row.kind == ResponseKind::Acceleration);
        let made = accelerations.map(|(row, number)| SectionForce {
            place: SectionPlace::Named(number),
            parts: parts.clone(),
            weights: row.weights.clone(),
        });
        made.collect::<Vec<_>>()
    };
    buildings.iter().enumerate().flat_map(of).collect()
}
