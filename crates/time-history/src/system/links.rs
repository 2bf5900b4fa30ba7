//! Elements with memory in a system: storeys and frames with laws, and links between floors.

use std::sync::Arc;

use pounding_hysteresis::HysteresisLaw;
use pounding_shear_building::{ShearBuilding, StoreyLaw};

use super::{Floor, LevelPlace, LinkedMotion, System, Terms};
use crate::error::TimeHistoryError;
use crate::system::{Element, ElementPlace};

/// A link: laws that join floors of two neighbours.
#[derive(Debug, Clone)]
pub struct Link {
    /// Name in the case file and the result.
    pub name: String,
    /// Names of the left and right neighbour, `wall` for a rigid wall.
    pub between: [String; 2],
    /// Range of its levels in [`System::elements`].
    pub first_element: usize,
    /// Number of levels.
    pub levels: usize,
    /// What it joins.
    pub joins: LinkedMotion,
}

/// One level of a link, for its definition.
#[derive(Debug, Clone)]
pub struct LinkedPair {
    /// Floor at the left end.
    pub left: Floor,
    /// Floor at the right end.
    pub right: Floor,
    /// The law.
    pub law: Arc<dyn HysteresisLaw>,
    /// Deformation (m) at which it begins to yield or slip, if the law has one.
    pub yield_deformation: Option<f64>,
}

impl System {
    /// Joins floors of neighbours by a law. `pairs` holds left floor, right floor, law
    /// and the deformation at which it begins to yield, of each level. The deformation
    /// is the displacement of the right floor less that of the left one: the link
    /// lengthens.
    ///
    /// # Errors
    /// A floor that does not exist, or a level between two walls.
    pub fn add_link(
        &mut self,
        name: &str,
        between: [String; 2],
        pairs: Vec<LinkedPair>,
    ) -> Result<(), TimeHistoryError> {
        let first_element = self.elements.len();
        let link = self.links.len();
        let levels = pairs.len();
        for (level, pair) in pairs.into_iter().enumerate() {
            let wrong = |reason: String| TimeHistoryError::LinkDefinition {
                link: name.to_owned(),
                reason,
            };
            // A link lengthens where a gap closes: its far end is the right one.
            let row = self.row_between(pair.right, pair.left).map_err(wrong)?;
            self.elements.push(Element {
                place: ElementPlace::Link { link, level },
                far: row.left,
                near: row.right,
                terms: row.terms,
                level_place: Some(LevelPlace {
                    storeys: [row.place.storeys[1], row.place.storeys[0]],
                    elevations: [row.place.elevations[1], row.place.elevations[0]],
                    ..row.place
                }),
                yield_deformation: pair
                    .yield_deformation
                    .filter(|_| pair.law.deforms_by_force_alone()),
                law: pair.law,
                carried: 0.0,
                first_variable: next_variable(&self.elements),
            });
        }
        self.links.push(Link {
            name: name.to_owned(),
            between,
            first_element,
            levels,
            joins: LinkedMotion::Floors,
        });
        Ok(())
    }

    /// Joins the foundations of two buildings through the soil by a law. Both ends are points
    /// of these buildings that move with their foundations.
    ///
    /// # Errors
    /// As [`System::add_link`].
    pub fn add_foundation_link(
        &mut self,
        name: &str,
        between: [String; 2],
        pair: LinkedPair,
        joins: LinkedMotion,
    ) -> Result<(), TimeHistoryError> {
        self.add_link(name, between, vec![pair])?;
        if let (Some(link), Some(element)) = (self.links.last_mut(), self.elements.last_mut()) {
            link.joins = joins;
            // They lie below all storeys.
            if let Some(place) = &mut element.level_place {
                place.storeys = [None, None];
                place.joins = joins;
            }
        }
        Ok(())
    }

    /// Links in the order of the case file.
    #[must_use]
    pub fn links(&self) -> &[Link] {
        &self.links
    }

    /// Storeys and elevations of the levels of a link, from the bottom.
    #[must_use]
    pub fn link_levels(&self, link: usize) -> Vec<LevelPlace> {
        let link = &self.links[link];
        let levels = &self.elements[link.first_element..link.first_element + link.levels];
        levels.iter().filter_map(|e| e.level_place).collect()
    }

    /// Where an element sits, in words.
    #[must_use]
    pub fn place_of_element(&self, element: usize) -> String {
        match self.elements[element].place {
            ElementPlace::Storey { building, storey } => {
                format!("{} storey {}", self.buildings[building].name(), storey + 1)
            }
            ElementPlace::Frame { building, frame } => {
                let building = &self.buildings[building];
                format!("{} {}", building.name(), building.yielding_frames()[frame])
            }
            ElementPlace::Link { link, level } => {
                let joined = &self.links[link];
                match joined.joins.label() {
                    Some(label) => format!("{}, {label}", joined.name),
                    None => format!("{} level {}", joined.name, self.link_levels(link)[level]),
                }
            }
        }
    }

    /// Storeys and frames with laws, buildings from the left, then the levels of all links.
    #[must_use]
    pub fn elements(&self) -> &[Element] {
        &self.elements
    }

    /// Building and storey, both from zero, in which a storey or a frame with a law stands; `None` of a level of
    /// a link.
    #[must_use]
    pub fn storey_of_element(&self, place: ElementPlace) -> Option<(usize, usize)> {
        match place {
            ElementPlace::Storey { building, storey } => Some((building, storey)),
            ElementPlace::Frame { building, frame } => {
                let frames = self.buildings[building].yielding_frames();
                Some((building, frames[frame].storey))
            }
            ElementPlace::Link { .. } => None,
        }
    }

    /// Index in [`System::elements`] of the first storey or link whose law is not linear
    /// between changes of branch
    /// ([`pounding_hysteresis::HysteresisLaw::is_piecewise_linear`]). With one the
    /// event-driven method has no exact steps.
    #[must_use]
    pub fn first_curved_element(&self) -> Option<usize> {
        let curved = |element: &Element| !element.law.is_piecewise_linear();
        self.elements.iter().position(curved)
    }
}

/// Stiffnesses that store strain energy, and the elements of storeys and frames with laws.
pub(super) fn storeys(
    buildings: &[Arc<ShearBuilding>],
    offsets: &[usize],
    further_offsets: &[usize],
) -> (Vec<f64>, Vec<Element>) {
    let (mut spring, mut elements) = (Vec::new(), Vec::new());
    for (b, building) in buildings.iter().enumerate() {
        for (storey, law) in building.laws().iter().enumerate() {
            let own = building.stiffness().get(storey);
            let geometric = building.geometric_stiffness()[storey];
            let dof = offsets[b] + storey;
            // The energy of a matrix is that of the whole building, of which
            // [`System::strain_energy`] takes off what stands in the place of laws.
            spring.push(match (own, law) {
                (None, _) => 0.0,
                (Some(_), Some(_)) => -geometric,
                (Some(elastic), None) => elastic - geometric,
            });
            let elastic = building.without_foundation().stiffness().get(storey);
            let (Some(StoreyLaw { law, yield_drift }), Some(elastic)) = (law, elastic) else {
                continue;
            };
            // A foundation moves a storey without deforming it.
            let drift = building.drifts().map(|rows| rows[storey].iter());
            let by_foundation = drift.into_iter().flatten().skip(building.storeys());
            let by_foundation = by_foundation.enumerate().filter(|(_, w)| **w != 0.0);
            elements.push(Element {
                place: ElementPlace::Storey {
                    building: b,
                    storey,
                },
                far: Some(dof),
                near: (storey > 0).then(|| dof - 1),
                terms: Terms {
                    pushed: by_foundation
                        .map(|(j, w)| (further_offsets[b] + j, *w))
                        .collect(),
                    ground: Vec::new(),
                },
                level_place: None,
                law: Arc::clone(law),
                yield_deformation: *yield_drift,
                carried: *elastic,
                first_variable: next_variable(&elements),
            });
        }
        for (index, frame) in building.yielding_frames().iter().enumerate() {
            let floors = building.storeys();
            let degree_of_freedom = |coordinate: usize| match coordinate.checked_sub(floors) {
                None => offsets[b] + coordinate,
                Some(other) => further_offsets[b] + other,
            };
            let deformation = frame.deformation.iter();
            elements.push(Element {
                place: ElementPlace::Frame {
                    building: b,
                    frame: index,
                },
                far: None,
                near: None,
                terms: Terms {
                    pushed: deformation
                        .map(|(i, w)| (degree_of_freedom(*i), *w))
                        .collect(),
                    ground: Vec::new(),
                },
                level_place: None,
                law: Arc::clone(&frame.law.law),
                yield_deformation: frame.law.yield_drift,
                carried: frame.law.law.initial_stiffness(),
                first_variable: next_variable(&elements),
            });
        }
    }
    (spring, elements)
}

fn next_variable(elements: &[Element]) -> usize {
    elements
        .last()
        .map_or(0, |e| e.first_variable + e.law.internal_variables())
}
