//! Which floors of two neighbours face each other, across a gap or a link.

use pounding_catalogue::suggestion;
use pounding_shear_building::{ELEVATION_TOLERANCE, WALL, floor_without_partner, level_pairs};
use pounding_time_history::{Floor, System};

use crate::building::Building;
use crate::error::Error;

/// Which floors are meant.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Levels {
    /// All below the lower roof: each must have a partner at equal elevation.
    All,
    /// Those at equal elevation.
    Matching,
    /// These pairs of storeys, from 1; a wall has any number.
    Pairs(Vec<(usize, usize)>),
}

/// Two neighbours and their levels.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Facing {
    /// Gap or link.
    what: &'static str,
    name: Option<String>,
    pub(crate) between: [String; 2],
    pub(crate) levels: Levels,
}

impl Facing {
    pub(crate) fn new(what: &'static str, left: String, right: String) -> Self {
        Self {
            what,
            name: None,
            between: [left, right],
            levels: Levels::All,
        }
    }

    pub(crate) fn rename(&mut self, name: String) {
        self.name = Some(name);
    }

    /// Name, by default those of both sides.
    pub(crate) fn name(&self) -> String {
        self.name.clone().unwrap_or_else(|| self.between.join("-"))
    }

    /// What it is and its name, for messages.
    pub(crate) fn of(&self) -> String {
        format!("{} {}", self.what, self.name())
    }

    /// The floors that face each other, as they were named or bottom first.
    pub(crate) fn pairs(
        &self,
        buildings: &[Building],
        system: &System,
    ) -> Result<Vec<(Floor, Floor)>, Error> {
        let sides = [self.side(buildings, 0)?, self.side(buildings, 1)?];
        self.side_by_side(sides, buildings)?;
        let pairs = self.storeys(sides, buildings, system)?;
        let mut seen = std::collections::BTreeSet::new();
        if let Some(twice) = pairs.iter().find(|pair| !seen.insert(**pair)) {
            let storey = |side: usize, storey: usize| match sides[side] {
                Some(_) => (storey + 1).to_string(),
                None => WALL.to_owned(),
            };
            return Err(Error::LevelTwice {
                of: self.of(),
                left: storey(0, twice.0),
                right: storey(1, twice.1),
            });
        }
        if pairs.is_empty() {
            let level = match self.what {
                "gap" => "contact level",
                _ => "level",
            };
            return Err(Error::NoLevel {
                of: self.of(),
                level,
            });
        }
        let floor = |side: Option<usize>, storey: usize| {
            side.map_or(Floor::Wall, |building| Floor::Storey(building, storey))
        };
        let both = |(l, r)| (floor(sides[0], l), floor(sides[1], r));
        Ok(pairs.into_iter().map(both).collect())
    }

    /// Refuses sides that are not next to each other, the left one first.
    fn side_by_side(&self, sides: [Option<usize>; 2], buildings: &[Building]) -> Result<(), Error> {
        let refused = |reason: String, remedy: &'static str| {
            Err(Error::NotNeighbours {
                of: self.of(),
                reason,
                remedy,
            })
        };
        let [left, right] = &self.between;
        let end = |building: usize, side: &str, remedy: &'static str| {
            let name = buildings[building].name();
            let reason = format!(
                "the wall on the {side} is beside \"{name}\", the last building on that side"
            );
            refused(reason, remedy)
        };
        match sides {
            [Some(a), Some(b)] if b == a + 1 => Ok(()),
            [Some(a), Some(b)] if a == b => refused(
                format!("\"{left}\" is on both sides of it"),
                "name two buildings that stand next to each other, or a building and \"wall\"",
            ),
            [Some(a), Some(b)] if a == b + 1 => refused(
                format!("\"{left}\" stands on the right of \"{right}\""),
                "name the left building first",
            ),
            [Some(_), Some(_)] => refused(
                format!("\"{left}\" and \"{right}\" do not stand next to each other"),
                "buildings stand in the order in which the simulation is given them: name two neighbours",
            ),
            [Some(a), None] if a + 1 < buildings.len() => end(
                buildings.len() - 1,
                "right",
                "name that building and \"wall\", or \"wall\" first for the wall on the left",
            ),
            [None, Some(b)] if b > 0 => end(
                0,
                "left",
                "name \"wall\" and that building, or \"wall\" last for the wall on the right",
            ),
            [None, None] => refused(
                "there is a wall on both sides of it".to_owned(),
                "name a building on one of them",
            ),
            _ => Ok(()),
        }
    }

    /// The building on a side; `None` is a wall.
    fn side(&self, buildings: &[Building], side: usize) -> Result<Option<usize>, Error> {
        let name = self.between[side].as_str();
        let mut names = buildings.iter().map(Building::name);
        match names.position(|n| n == name) {
            None if name == WALL => Ok(None),
            None => Err(Error::UnknownBuilding {
                of: self.of(),
                building: name.to_owned(),
                nearest: suggestion::misspelt(name, buildings.iter().map(Building::name))
                    .map(str::to_owned),
            }),
            found => Ok(found),
        }
    }

    /// Storeys from zero of both sides.
    fn storeys(
        &self,
        sides: [Option<usize>; 2],
        buildings: &[Building],
        system: &System,
    ) -> Result<Vec<(usize, usize)>, Error> {
        if let Levels::Pairs(pairs) = &self.levels {
            let floor = |side: usize, storey: usize| match sides[side] {
                None => Ok(0),
                Some(building) => buildings[building].storey_index(&self.of(), storey),
            };
            let pairs = pairs
                .iter()
                .map(|(l, r)| Ok((floor(0, *l)?, floor(1, *r)?)));
            return pairs.collect();
        }
        let [Some(left), Some(right)] = sides else {
            let building = sides[0].or(sides[1]).unwrap_or_default();
            let storeys = system.buildings()[building].storeys();
            return Ok((0..storeys).map(|s| (s, s)).collect());
        };
        let neighbours = [left, right].map(|b| &system.buildings()[b]);
        let elevations = neighbours.map(|b| b.elevations());
        let pairs = level_pairs(elevations[0], elevations[1], ELEVATION_TOLERANCE);
        let lonely = floor_without_partner(elevations, &pairs, ELEVATION_TOLERANCE);
        match (lonely, &self.levels) {
            (Some((side, storey)), Levels::All) => Err(Error::UnequalFloors {
                of: self.of(),
                building: neighbours[side].name().to_owned(),
                floor: storey + 1,
                elevation: elevations[side][storey],
            }),
            _ => Ok(pairs),
        }
    }
}
