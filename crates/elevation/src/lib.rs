//! The buildings in elevation: where they stand in a picture, what holds them apart, and the
//! script that moves them.

use pounding_catalogue::wording::shortened;
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

/// How names stand below their bodies.
#[derive(Debug, Clone, PartialEq)]
pub struct Names {
    /// What is shown of each.
    pub shown: Vec<String>,
    /// Size of the text (m).
    pub size: f64,
    /// Whether they are turned: read upwards, their end at the ground.
    pub turned: bool,
    /// What they take below the ground (m).
    pub below: f64,
}

/// Size of names over the height of the tallest body.
const TEXT: f64 = 0.05;
/// Width of a letter over the size of the text.
const LETTER: f64 = 0.6;
/// Fewest letters that names beside one another are shortened to; if they have less room they are
/// turned.
const FEWEST: usize = 10;
/// Most letters of a name that is turned.
const MOST_TURNED: usize = 18;

impl Scene {
    /// How the names stand: below their bodies, as far as there is room for the letters.
    #[must_use]
    pub fn names(&self) -> Names {
        let size = TEXT * self.height;
        let names: Vec<&str> = self.bodies.iter().map(|b| b.name.as_str()).collect();
        let middles: Vec<f64> = self.bodies.iter().map(|b| b.left + 0.5 * b.width).collect();
        let letters = |name: &str| name.chars().count() as f64 + 1.0;
        let half = |name: &str| 0.5 * LETTER * size * letters(name);
        let fits = |names: &[String]| {
            let places: Vec<(f64, f64)> = (middles.iter().zip(names))
                .map(|(x, name)| (x - half(name), x + half(name)))
                .collect();
            let apart = places.windows(2).all(|pair| pair[0].1 <= pair[1].0);
            let margin = self.margin();
            let inside = |place: &(f64, f64)| place.0 >= -margin && place.1 <= self.width + margin;
            apart && places.iter().all(inside)
        };
        let most = names.iter().map(|name| name.chars().count()).max();
        // More letters have no room even across the whole picture.
        let room = (self.width + 2.0 * self.margin()) / (LETTER * size);
        let longest = most.unwrap_or(0).min(room as usize).max(FEWEST);
        let mut beside = (FEWEST..=longest).rev().map(|most| shortened(&names, most));
        if let Some(shown) = beside.find(|shown| fits(shown)) {
            return Names {
                shown,
                size,
                turned: false,
                below: 2.0 * self.margin(),
            };
        }
        let shown = shortened(&names, MOST_TURNED);
        let longest = shown.iter().map(|name| letters(name)).fold(0.0, f64::max);
        Names {
            shown,
            size,
            turned: true,
            below: LETTER * size * longest + self.margin(),
        }
    }

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
                let top = top_of_wall(row, (&left_walls, 1), top(building));
                let wall = scene.add(WALL, None, 0.25 * width, vec![top]);
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
                let top = top_of_wall(row, (&right_walls, 0), top(building));
                let wall = scene.add(WALL, None, 0.25 * width, vec![top]);
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
        let names = self.names();
        let body = |(body, shown): (&Body, &String)| {
            json!({
                "title": body.name,
                "shown": shown,
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
            "names": { "size": names.size, "turned": names.turned, "below": names.below },
            "bodies": self.bodies.iter().zip(&names.shown).map(body).collect::<Vec<Value>>(),
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

/// How high a wall beside a building is drawn (m): to its highest level in these gaps, of which the building is on this
/// side; to the roof where no level says.
fn top_of_wall(row: &Row, (gaps, side): (&[usize], usize), roof: f64) -> f64 {
    let levels = gaps.iter().flat_map(|g| &row.gaps[*g].levels);
    let elevations = levels.map(|(elevations, _)| elevations[side]);
    let highest = elevations.filter(|z| *z > 0.0).reduce(f64::max);
    highest.map_or(roof, |z| z.min(roof))
}

/// The width of the widest level of some gaps (m).
fn widest(row: &Row, gaps: &[usize]) -> f64 {
    let levels = gaps.iter().flat_map(|g| &row.gaps[*g].levels);
    let widths = levels.map(|(_, width)| *width);
    widths.filter(|w| w.is_finite()).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scene(names: &[&str]) -> Scene {
        Scene::of(&Row {
            buildings: names
                .iter()
                .map(|name| ((*name).to_owned(), vec![3.0, 6.0, 9.0]))
                .collect(),
            gaps: Vec::new(),
            reach: 0.1,
        })
    }

    /// Names keep their size: those that have no room beside one another are shortened or turned.
    #[test]
    fn names_keep_their_size() {
        let few = scene(&["light", "heavy"]).names();
        assert_eq!((few.size, few.turned), (0.45, false));
        assert_eq!(few.shown, ["light", "heavy"]);
        let long = scene(&[
            "the light frame of the old hospital",
            "the heavy frame of the old hospital",
        ]);
        let long = long.names();
        assert_eq!((long.size, long.turned), (0.45, false));
        assert_ne!(long.shown[0], long.shown[1]);
        let many: Vec<String> = (1..=20).map(|i| format!("building {i}")).collect();
        let many: Vec<&str> = many.iter().map(String::as_str).collect();
        let many = scene(&many).names();
        assert_eq!((many.size, many.turned), (0.45, true));
        assert_eq!(many.shown[19], "building 20");
        assert!(many.below > 0.6 * 0.45 * 11.0, "{}", many.below);
    }

    /// The wall of a moat reaches as far as it is met, a fire wall to the roof.
    #[test]
    fn walls_are_as_high_as_they_are_met() {
        let wall = |levels: &[f64]| {
            let row = Row {
                buildings: vec![("base isolated".to_owned(), vec![0.5, 4.0, 8.0])],
                gaps: vec![RowGap {
                    between: [Neighbour::Building(0), Neighbour::Wall],
                    levels: levels.iter().map(|z| ([*z, f64::NAN], 0.3)).collect(),
                }],
                reach: 0.2,
            };
            Scene::of(&row).bodies[1].elevation.clone()
        };
        assert_eq!(wall(&[0.5]), [0.5]);
        assert_eq!(wall(&[0.5, 4.0, 8.0]), [8.0]);
        assert_eq!(wall(&[]), [8.0]);
    }
}
