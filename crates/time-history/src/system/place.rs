//! Where contacts and links act, and the relative displacement between two such places.

use pounding_shear_building::{Excitation, ShearBuilding};

use super::{LevelPlace, LinkedMotion, System, Terms};

/// A place in a contact level or a link, for its definition.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Floor {
    /// Building index in the row and storey index, both from zero.
    Storey(usize, usize),
    /// A point of a building that moves with several of its coordinates, or with one that is
    /// no floor, by its number in the system ([`System::add_point`]).
    Point(usize),
    /// A rigid wall that moves with the ground under the neighbour.
    Wall,
    /// A rigid wall that stands still in space while the ground moves.
    FixedWall,
}

/// A point of a building whose displacement relative to the ground is a sum over the coordinates of the
/// building. What the weights of floors lack to one is the share of the ground, as of a column in the first
/// storey: a unit shift of the ground carries every point along by one, whatever its weights, unless they are all
/// of rotations.
#[derive(Debug, Clone, PartialEq)]
pub struct BuildingPoint {
    /// Building index in the row, from zero.
    pub building: usize,
    /// Storey in which it lies, from zero.
    pub storey: usize,
    /// Elevation (m).
    pub elevation: f64,
    /// Numbers of coordinates, floors first, with their weights.
    pub weights: Vec<(usize, f64)>,
}

/// A relative displacement, left less right.
pub(super) struct Row {
    pub left: Option<usize>,
    pub right: Option<usize>,
    pub terms: Terms,
    pub place: LevelPlace,
}

/// One side of it: degrees of freedom with weights, storey from one and elevation, building.
struct Side {
    weights: Vec<(usize, f64)>,
    place: Option<(usize, f64)>,
    building: Option<usize>,
    /// Whether the ground along the row carries it: not a rotation.
    is_carried: bool,
    /// Position across the row (m), where it matters.
    across: Option<f64>,
}

impl System {
    /// Adds a point of a building, on which gaps and links may then act.
    pub fn add_point(&mut self, point: BuildingPoint) -> Floor {
        self.points.push((point, None));
        Floor::Point(self.points.len() - 1)
    }

    /// The same with its position across the row (m), which becomes part of the names of its
    /// levels.
    pub fn add_point_across(&mut self, point: BuildingPoint, across: f64) -> Floor {
        self.points.push((point, Some(across)));
        Floor::Point(self.points.len() - 1)
    }

    /// Building and storey in which a place lies, both from zero; `None` is a wall.
    #[must_use]
    pub fn storey_of(&self, floor: Floor) -> Option<(usize, usize)> {
        match floor {
            Floor::Storey(building, storey) => Some((building, storey)),
            Floor::Point(number) => {
                let (point, _) = self.points.get(number)?;
                Some((point.building, point.storey))
            }
            Floor::Wall | Floor::FixedWall => None,
        }
    }

    /// The point of a building that a place is; `None` for a floor or a wall.
    #[must_use]
    pub fn point(&self, floor: Floor) -> Option<&BuildingPoint> {
        match floor {
            Floor::Point(number) => self.points.get(number).map(|(point, _)| point),
            Floor::Storey(..) | Floor::Wall | Floor::FixedWall => None,
        }
    }

    /// The displacement of one place relative to another. Fails with what is wrong.
    pub(super) fn row_between(&mut self, left: Floor, right: Floor) -> Result<Row, String> {
        let sides = [self.side(left)?, self.side(right)?];
        if sides.iter().all(|s| s.weights.is_empty()) {
            return Err("a level lies between two walls".to_owned());
        }
        let mut terms = Terms::default();
        let mut ends = [None, None];
        for (k, side) in sides.iter().enumerate() {
            let sign = [1.0, -1.0][k];
            let mut weights = side.weights.iter().copied();
            if let Some((dof, 1.0)) = side.weights.first() {
                ends[k] = Some(*dof);
                weights.next();
            }
            terms.pushed.extend(weights.map(|(dof, w)| (dof, sign * w)));
        }
        self.add_ground(&sides, [left, right], &mut terms);
        let [left, right] = ends;
        Ok(Row {
            left,
            right,
            terms,
            place: LevelPlace {
                across: sides.iter().find_map(|s| s.across),
                joins: LinkedMotion::Floors,
                storeys: [0, 1].map(|k| sides[k].place.map(|p| p.0)),
                elevations: [0, 1].map(|k| sides[k].place.map(|p| p.1)),
            },
        })
    }

    /// Displacements of the ground, where it is not the same on both sides.
    fn add_ground(&mut self, sides: &[Side; 2], floors: [Floor; 2], terms: &mut Terms) {
        let motions = [0, 1].map(|k| sides[k].building.map(|b| self.support(b).along));
        let fixed = floors.contains(&Floor::FixedWall);
        let moves = match motions {
            [Some(a), Some(b)] => a != b,
            _ => fixed,
        };
        if !moves {
            return;
        }
        for ((motion, sign), side) in motions.into_iter().zip([1.0, -1.0]).zip(sides) {
            if let Some(motion) = motion.filter(|_| side.is_carried) {
                let dof = self.displacement_of_ground(motion);
                terms.ground.push((dof, sign));
            }
        }
    }

    fn side(&self, floor: Floor) -> Result<Side, String> {
        let found = |b: usize, s: usize| {
            let building = self.buildings.get(b);
            let building = building.ok_or_else(|| format!("there is no building of index {b}"))?;
            match s < building.storeys() {
                true => Ok(building),
                false => Err(no_storey(building, s)),
            }
        };
        match floor {
            Floor::Wall | Floor::FixedWall => Ok(Side {
                weights: Vec::new(),
                place: None,
                building: None,
                is_carried: false,
                across: None,
            }),
            Floor::Storey(b, s) => {
                let building = found(b, s)?;
                Ok(Side {
                    weights: vec![(self.offsets[b] + s, 1.0)],
                    place: Some((s + 1, building.elevations()[s])),
                    building: Some(b),
                    is_carried: true,
                    across: None,
                })
            }
            Floor::Point(number) => {
                let point = self.points.get(number);
                let found_point = point.ok_or_else(|| format!("there is no point {number}"));
                let (point, across) = found_point?;
                let b = point.building;
                let building = found(b, point.storey)?;
                let parts = self.parts(b);
                let dof = |i: usize| match i < building.storeys() {
                    true => parts[0].start + i,
                    false => parts[1].start + i - building.storeys(),
                };
                let within = |i: &usize| *i < building.coordinates();
                let all = point.weights.iter();
                if let Some((i, _)) = all.clone().find(|(i, w)| !within(i) || !w.is_finite()) {
                    let name = building.name();
                    return Err(format!("{name} has no coordinate {i} with a finite weight"));
                }
                let further = building.further_coordinates();
                let along = |i: usize| match i.checked_sub(building.storeys()) {
                    None => true,
                    Some(k) => further[k].excitation == Excitation::Along,
                };
                let is_carried = all.clone().any(|(i, w)| along(*i) && *w != 0.0);
                let weights: Vec<_> = all.map(|(i, w)| (dof(*i), *w)).collect();
                if weights.iter().all(|(_, w)| *w == 0.0) {
                    return Err(format!("a point of {} that nothing moves", building.name()));
                }
                Ok(Side {
                    weights,
                    place: Some((point.storey + 1, point.elevation)),
                    building: Some(b),
                    is_carried,
                    across: *across,
                })
            }
        }
    }
}

/// What is said of a storey, from zero, that a building does not have.
pub(super) fn no_storey(building: &ShearBuilding, storey: usize) -> String {
    format!(
        "{} has no storey {}; the highest is {}",
        building.name(),
        storey.saturating_add(1),
        building.storeys()
    )
}
