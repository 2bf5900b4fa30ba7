//! The buildings in elevation: where they stand, and what holds them apart.

use crate::result::{GapResult, RunResult};

/// Word for a rigid wall in the result file.
const WALL: &str = "wall";
/// Magnifications that a reader can choose.
pub(super) const MAGNIFICATIONS: [f64; 9] = [1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0];

/// A building or a wall. At a magnification `m` its left side is at `left + m * offset`, and
/// each floor further by `m` times its displacement (m).
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Body {
    /// Name.
    pub name: String,
    /// Place among the buildings; `None` for a wall.
    pub building: Option<usize>,
    /// Left side without the gaps (m).
    pub left: f64,
    /// Width as it is drawn (m): a case has none.
    pub width: f64,
    /// Gaps at its left together (m).
    pub offset: f64,
    /// Elevations of its floors (m); that of its top for a wall.
    pub elevation: Vec<f64>,
}

/// A level at which two bodies can touch.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Contact {
    /// Gap and level.
    pub place: (usize, usize),
    /// Bodies.
    pub between: [usize; 2],
    /// Elevations (m).
    pub elevations: [f64; 2],
    /// How far the right body stands out here, where the gap is narrower than elsewhere (m).
    pub ahead: f64,
}

/// All of it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Scene {
    /// From left to right.
    pub bodies: Vec<Body>,
    /// Of all gaps.
    pub contacts: Vec<Contact>,
    /// Height of the tallest (m).
    pub height: f64,
    /// Width of all bodies (m).
    pub width: f64,
    /// All gaps together (m).
    pub offsets: f64,
    /// Largest displacement (m).
    pub reach: f64,
}

impl Scene {
    /// The buildings of a result in the order of the case, with the walls beside them.
    pub(super) fn of(result: &RunResult) -> Self {
        let sides = |gap: &GapResult| sides(result, gap);
        let walls: Vec<[Option<Option<usize>>; 2]> = result.gaps.iter().map(sides).collect();
        let top = |i: usize| result.buildings[i].elevation.last().copied().unwrap_or(0.0);
        let all = 0..result.buildings.len();
        let height = all.clone().map(top).fold(1.0, f64::max);
        let count = result.buildings.len().max(1) as f64;
        let width = (2.0 * height / count).clamp(0.12 * height, 0.5 * height);
        let mut scene = Self {
            bodies: Vec::new(),
            contacts: Vec::new(),
            height,
            width: 0.0,
            offsets: 0.0,
            reach: reach(result),
        };
        let mut body_of = vec![[usize::MAX; 2]; result.gaps.len()];
        for building in all {
            let here = |side: usize| {
                let walls = walls.iter().enumerate();
                let beside = walls.filter(move |(_, sides)| {
                    sides[1 - side] == Some(Some(building)) && sides[side] == Some(None)
                });
                beside.map(|(gap, _)| gap).collect::<Vec<_>>()
            };
            let (left_walls, right_walls) = (here(0), here(1));
            if !left_walls.is_empty() {
                let wall = scene.add(WALL, None, 0.25 * width, vec![top(building)]);
                left_walls.iter().for_each(|g| body_of[*g][0] = wall);
                scene.offsets += widest(result, &left_walls);
            }
            let before = walls.iter().enumerate().filter(|(_, sides)| {
                sides[1] == Some(Some(building)) && matches!(sides[0], Some(Some(_)))
            });
            let before: Vec<usize> = before.map(|(gap, _)| gap).collect();
            if !before.is_empty() {
                scene.offsets += widest(result, &before);
            } else if !scene.bodies.is_empty() && left_walls.is_empty() {
                // Nothing says how far these are apart.
                scene.width += 0.3 * width;
            }
            let elevation = result.buildings[building].elevation.clone();
            let name = &result.buildings[building].name;
            let number = scene.add(name, Some(building), width, elevation);
            for (gap, sides) in walls.iter().enumerate() {
                for side in 0..2 {
                    if sides[side] == Some(Some(building)) {
                        body_of[gap][side] = number;
                    }
                }
            }
            if !right_walls.is_empty() {
                scene.offsets += widest(result, &right_walls);
                let wall = scene.add(WALL, None, 0.25 * width, vec![top(building)]);
                right_walls.iter().for_each(|g| body_of[*g][1] = wall);
            }
        }
        for (gap, between) in body_of.into_iter().enumerate() {
            if between.contains(&usize::MAX) {
                continue;
            }
            let most = widest(result, &[gap]);
            for (level, place) in result.gaps[gap].levels.iter().enumerate() {
                let [left, right] = place.elevations;
                // A wall is met where the floor is.
                let or = |z: f64, other: f64| if z.is_finite() { z } else { other };
                scene.contacts.push(Contact {
                    place: (gap, level),
                    between,
                    elevations: [or(left, right), or(right, left)],
                    ahead: most - result.gaps[gap].width[level],
                });
            }
        }
        scene
    }

    fn add(
        &mut self,
        name: &str,
        building: Option<usize>,
        width: f64,
        elevation: Vec<f64>,
    ) -> usize {
        self.bodies.push(Body {
            name: name.to_owned(),
            building,
            left: self.width,
            width,
            offset: self.offsets,
            elevation,
        });
        self.width += width;
        self.bodies.len() - 1
    }

    /// The greatest magnification at which the picture still looks like buildings.
    pub(super) fn magnification(&self) -> f64 {
        let narrowest = self.bodies.iter().filter(|b| b.building.is_some());
        let narrowest = narrowest.map(|b| b.width).fold(f64::INFINITY, f64::min);
        let bodies = self.bodies.len().max(1) as f64;
        let moved = self.reach.max(self.offsets / bodies);
        let fits = |m: &&f64| **m * moved <= 0.3 * narrowest;
        let known = MAGNIFICATIONS.iter().rev().find(fits);
        known.copied().unwrap_or(1.0)
    }

    /// What is left free around the picture (m).
    pub(super) fn margin(&self) -> f64 {
        0.06 * self.height
    }
}

/// What stands on both sides of a gap: a building, or `Some(None)` for a wall; `None` where
/// the text does not say.
fn sides(result: &RunResult, gap: &GapResult) -> [Option<Option<usize>>; 2] {
    let body = |name: &str| {
        let building = result.buildings.iter().position(|b| b.name == name);
        match building {
            Some(building) => Some(Some(building)),
            None => (name == WALL).then_some(None),
        }
    };
    // A name may hold the same sign.
    let parts = gap.between.match_indices(" | ").map(|(at, sign)| {
        [
            body(&gap.between[..at]),
            body(&gap.between[at + sign.len()..]),
        ]
    });
    let mut parts = parts.filter(|sides| sides.iter().all(Option::is_some));
    parts.next().unwrap_or([None, None])
}

/// The width of the widest level of some gaps (m).
fn widest(result: &RunResult, gaps: &[usize]) -> f64 {
    let widths = gaps.iter().flat_map(|g| &result.gaps[*g].width);
    widths
        .copied()
        .filter(|w| w.is_finite())
        .fold(0.0, f64::max)
}

/// Largest displacement of all (m).
fn reach(result: &RunResult) -> f64 {
    let values = result.buildings.iter().flat_map(|b| &b.displacement.values);
    let values = values.copied().filter(|u| u.is_finite());
    values.fold(0.0, |m: f64, u| m.max(u.abs()))
}
