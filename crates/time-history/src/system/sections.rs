//! Responses of buildings that are sums over their coordinates: storey shears and base moments
//! of full stiffness matrices, drifts of buildings on a foundation that rotates, and responses
//! with names of their own.

use std::ops::Range;
use std::sync::Arc;

use crate::system::{Element, ElementPlace};
use pounding_shear_building::{
    FrameDirection, OVERTURNING_RATIO, ResponseKind, ResponseRow, ShearBuilding, YieldingFrame,
};

/// A response as a row on the coordinates of a building.
#[derive(Debug, Clone)]
pub(crate) struct SectionForce {
    pub place: SectionPlace,
    /// Degrees of freedom of the floors of the building, and of its other coordinates.
    parts: [Range<usize>; 2],
    /// One a coordinate (N/m, or N).
    weights: Vec<f64>,
    /// Storeys and frames with laws whose forces are a part of it, by their numbers in
    /// [`super::System::elements`], with their weights.
    pub elements: Vec<(usize, f64)>,
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

    /// The response at these displacements, without the forces of elements.
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
    elements: &[Element],
) -> Vec<SectionForce> {
    let mut all = Vec::new();
    let mut named = 0;
    for (b, building) in buildings.iter().enumerate() {
        let first = offsets[b];
        let parts = [first..offsets[b + 1], further[b]..further[b + 1]];
        let mut add = |place: SectionPlace, Sum { weights, elements }: Sum| {
            all.push(SectionForce {
                place,
                parts: parts.clone(),
                weights,
                elements,
            });
        };
        let laws = building.laws();
        let moment = moment_with_laws(b, building, elements);
        let rows = building.section_forces().into_iter().flatten();
        for (i, mut weights) in rows.enumerate() {
            if !building.yielding_frames().is_empty() {
                let own = frames_in(b, building, elements, i);
                let place = match i < building.storeys() {
                    true => SectionPlace::StoreyShear(first + i),
                    false => SectionPlace::BaseMoment(b),
                };
                for (_, arm, frame) in &own {
                    let carried = frame.law.law.initial_stiffness();
                    for (j, w) in &frame.deformation {
                        weights[*j] -= arm * carried * w;
                    }
                }
                let elements = own.iter().map(|(e, arm, _)| (*e, *arm)).collect();
                add(place, Sum { weights, elements });
                continue;
            }
            match (laws.get(i), &moment) {
                // Its element has the shear: a sum of nothing.
                (Some(Some(_)), _) => {
                    add(SectionPlace::StoreyShear(first + i), Vec::new().into());
                }
                (Some(None), _) => add(SectionPlace::StoreyShear(first + i), weights.into()),
                (None, Some(moment)) => add(SectionPlace::BaseMoment(b), moment.clone()),
                (None, None) => add(SectionPlace::BaseMoment(b), weights.into()),
            }
        }
        for (i, weights) in building.drifts().unwrap_or_default().iter().enumerate() {
            add(SectionPlace::Drift(first + i), weights.clone().into());
        }
        for row in building.responses() {
            if row.kind == ResponseKind::Displacement {
                let overturning = overturning_by_base_moment(building, row);
                let sum = match (overturning, &moment) {
                    (Some(limit), Some(moment)) => moment.over(limit),
                    _ => row.weights.clone().into(),
                };
                add(SectionPlace::Named(named), sum);
            }
            named += 1;
        }
    }
    all
}

/// A sum over the coordinates of a building and over forces of elements.
#[derive(Debug, Clone)]
struct Sum {
    weights: Vec<f64>,
    elements: Vec<(usize, f64)>,
}

impl From<Vec<f64>> for Sum {
    fn from(weights: Vec<f64>) -> Self {
        Self {
            weights,
            elements: Vec::new(),
        }
    }
}

impl Sum {
    fn over(&self, divisor: f64) -> Self {
        let elements = self.elements.iter();
        Self {
            weights: self.weights.iter().map(|w| w / divisor).collect(),
            elements: elements.map(|(e, w)| (*e, w / divisor)).collect(),
        }
    }
}

/// The moment at the base of a building some of whose storeys follow laws, `sum V_i h_i` over the
/// storeys: the row of the elastic ones, and the elements of the others with their heights.
fn moment_with_laws(index: usize, building: &ShearBuilding, elements: &[Element]) -> Option<Sum> {
    building.laws().iter().flatten().next()?;
    let drifts = building.drifts()?;
    let height = building.height();
    let mut weights = vec![0.0; building.coordinates()];
    let stiffness = building.without_foundation().stiffness().iter();
    for (storey, stiffness) in stiffness.enumerate() {
        if building.laws()[storey].is_none() {
            for (sum, w) in weights.iter_mut().zip(&drifts[storey]) {
                *sum += stiffness * height[storey] * w;
            }
        }
    }
    let own = elements.iter().enumerate();
    let own = own.filter_map(|(e, element)| match element.place {
        ElementPlace::Storey { building, storey } if building == index => Some((e, height[storey])),
        _ => None,
    });
    Some(Sum {
        weights,
        elements: own.collect(),
    })
}

/// Elements of the frames whose forces are a part of the shear of a storey, or behind the last of these of the
/// moment at the base, with their weights there.
fn frames_in<'b>(
    index: usize,
    building: &'b ShearBuilding,
    elements: &[Element],
    row: usize,
) -> Vec<(usize, f64, &'b YieldingFrame)> {
    let is_shear = row < building.storeys();
    let own = elements.iter().enumerate();
    let own = own.filter_map(|(e, element)| match element.place {
        ElementPlace::Frame {
            building: of,
            frame,
        } if of == index => {
            let frame = &building.yielding_frames()[frame];
            let along = frame.direction == FrameDirection::Along;
            let arm = match is_shear {
                true => 1.0,
                false => building.height()[frame.storey],
            };
            (along && (!is_shear || frame.storey == row)).then_some((e, arm, frame))
        }
        _ => None,
    });
    own.collect()
}

/// The moment (N m) over which a response is that at the base, where it is the
/// [`OVERTURNING_RATIO`] of a foundation that does not rock.
fn overturning_by_base_moment(building: &ShearBuilding, row: &ResponseRow) -> Option<f64> {
    let on = building.foundation()?;
    let by_base = row.name == OVERTURNING_RATIO && on.matrices().rotation().is_none();
    on.overturning_moment().filter(|_| by_base)
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
            elements: Vec::new(),
        });
        made.collect::<Vec<_>>()
    };
    buildings.iter().enumerate().flat_map(of).collect()
}
