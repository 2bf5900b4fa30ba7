//! The buildings in elevation: where they stand in a picture, what holds them apart, and the
//! script that moves them.

use serde_json::{Value, json};

/// Word for a rigid wall.
pub const WALL: &str = "wall";
/// JavaScript that moves the buildings of a [`Scene`]: the function `elevation`, which takes
/// what [`Scene::json`] gives.
pub const SCRIPT: &str = include_str!("elevation.js");
/// Magnifications that a reader can choose.
pub const MAGNIFICATIONS: [f64; 9] = [1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0];

/// What stands on one side of a gap.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Neighbour {
    /// A building of the row, from zero.
    Building(usize),
    /// A rigid wall.
    Wall,
    /// Nobody knows.
    Unknown,
}

/// A gap of a row.
#[derive(Debug, Clone, PartialEq)]
pub struct RowGap {
    /// What stands on both sides.
    pub between: [Neighbour; 2],
    /// Elevations of the left and the right floor (m; NaN for a wall) and width at rest (m) of
    /// every level.
    pub levels: Vec<([f64; 2], f64)>,
}

/// Buildings in a row.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Names and elevations of floors (m), from the left.
    pub buildings: Vec<(String, Vec<f64>)>,
    /// What is between them.
    pub gaps: Vec<RowGap>,
    /// Largest displacement (m).
    pub reach: f64,
}

/// A building or a wall. At a magnification `m` its left side is at `left + m * offset`, and
/// each floor further by `m` times its displacement (m).
#[derive(Debug, Clone, PartialEq)]
pub struct Body {
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
pub struct Contact {
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
pub struct Scene {
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
    /// The buildings of a row in their order, with the walls beside them.
    #[must_use]
    pub fn of(row: &Row) -> Self {
        use Neighbour::{Building, Wall};
        let walls: Vec<[Neighbour; 2]> = row.gaps.iter().map(|gap| gap.between).collect();
        let top = |i: usize| row.buildings[i].1.last().copied().unwrap_or(0.0);
        let all = 0..row.buildings.len();
        let height = all.clone().map(top).fold(1.0, f64::max);
        let count = row.buildings.len().max(1) as f64;
        let width = (2.0 * height / count).clamp(0.12 * height, 0.5 * height);
        let mut scene = Self {
            bodies: Vec::new(),
            contacts: Vec::new(),
            height,
            width: 0.0,
            offsets: 0.0,
            reach: row.reach,
        };
        let mut body_of = vec![[usize::MAX; 2]; row.gaps.len()];
        for building in all {
            let here = |side: usize| {
                let walls = walls.iter().enumerate();
                let beside = walls.filter(move |(_, sides)| {
                    sides[1 - side] == Building(building) && sides[side] == Wall
                });
                beside.map(|(gap, _)| gap).collect::<Vec<_>>()
            };
            let (left_walls, right_walls) = (here(0), here(1));
            if !left_walls.is_empty() {
                let wall = scene.add(WALL, None, 0.25 * width, vec![top(building)]);
                left_walls.iter().for_each(|g| body_of[*g][0] = wall);
                scene.offsets += widest(row, &left_walls);
            }
            let before = walls.iter().enumerate().filter(|(_, sides)| {
                sides[1] == Building(building) && matches!(sides[0], Building(_))
            });
            let before: Vec<usize> = before.map(|(gap, _)| gap).collect();
            if !before.is_empty() {
                scene.offsets += widest(row, &before);
            } else if !scene.bodies.is_empty() && left_walls.is_empty() {
                // Nothing says how far these are apart.
                scene.width += 0.3 * width;
            }
            let (name, elevation) = &row.buildings[building];
            let elevation = elevation.clone();
            let number = scene.add(name, Some(building), width, elevation);
            for (gap, sides) in walls.iter().enumerate() {
                for side in 0..2 {
                    if sides[side] == Building(building) {
                        body_of[gap][side] = number;
                    }
                }
            }
            if !right_walls.is_empty() {
                scene.offsets += widest(row, &right_walls);
                let wall = scene.add(WALL, None, 0.25 * width, vec![top(building)]);
                right_walls.iter().for_each(|g| body_of[*g][1] = wall);
            }
        }
        for (gap, between) in body_of.into_iter().enumerate() {
            if between.contains(&usize::MAX) {
                continue;
            }
            let most = widest(row, &[gap]);
            for (level, ([left, right], width)) in row.gaps[gap].levels.iter().enumerate() {
                let (left, right) = (*left, *right);
                // A wall is met where the floor is.
                let or = |z: f64, other: f64| if z.is_finite() { z } else { other };
                scene.contacts.push(Contact {
                    place: (gap, level),
                    between,
                    elevations: [or(left, right), or(right, left)],
                    ahead: most - width,
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

    /// What the script reads, with these contacts alone, under these names.
    #[must_use]
    pub fn json(&self, contacts: impl Iterator<Item = (usize, String)>) -> Value {
        let body = |body: &Body| {
            json!({
                "title": body.name,
                "building": body.building,
                "left": body.left,
                "width": body.width,
                "offset": body.offset,
                "elevation": body.elevation,
            })
        };
        let contact = |(place, name): (usize, String)| {
            let contact = &self.contacts[place];
            json!({
                "name": name,
                "left": contact.between[0],
                "right": contact.between[1],
                "elevations": contact.elevations,
                "ahead": contact.ahead,
            })
        };
        json!({
            "height": self.height,
            "width": self.width,
            "offsets": self.offsets,
            "reach": self.reach,
            "margin": self.margin(),
            "magnification": self.magnification(),
            "bodies": self.bodies.iter().map(body).collect::<Vec<Value>>(),
            "contacts": contacts.map(contact).collect::<Vec<Value>>(),
        })
    }

    /// The greatest magnification at which the picture still looks like buildings.
    #[must_use]
    pub fn magnification(&self) -> f64 {
        let narrowest = self.bodies.iter().filter(|b| b.building.is_some());
        let narrowest = narrowest.map(|b| b.width).fold(f64::INFINITY, f64::min);
        let bodies = self.bodies.len().max(1) as f64;
        let moved = self.reach.max(self.offsets / bodies);
        let fits = |m: &&f64| **m * moved <= 0.3 * narrowest;
        let known = MAGNIFICATIONS.iter().rev().find(fits);
        known.copied().unwrap_or(1.0)
    }

    /// What is left free around the picture (m).
    #[must_use]
    pub fn margin(&self) -> f64 {
        0.06 * self.height
    }
}

/// The width of the widest level of some gaps (m).
fn widest(row: &Row, gaps: &[usize]) -> f64 {
    let levels = gaps.iter().flat_map(|g| &row.gaps[*g].levels);
    let widths = levels.map(|(_, width)| *width);
    widths.filter(|w| w.is_finite()).fold(0.0, f64::max)
}
