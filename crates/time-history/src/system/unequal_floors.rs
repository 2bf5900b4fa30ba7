//! Floors at different elevations that face one another in a gap.

use pounding_shear_building::decimal;

use super::{ContactLevel, Floor, Gap, LevelPlace, System};
use crate::warnings::Warning;

/// A contact level whose floors are not level within the tolerance of its gap. In a
/// building such a floor hits a column between two floors; here both floors act on each
/// other as if they were level.
#[derive(Debug, Clone, PartialEq)]
pub struct UnequalFloors {
    /// Names of the left and right neighbour.
    pub between: [String; 2],
    /// Storeys and elevations.
    pub place: LevelPlace,
    /// Difference of the elevations (m).
    pub difference: f64,
}

impl UnequalFloors {
    /// Both floors with their elevations: `storey 4 of "a" at 12 m and storey 1 of "b" at
    /// 3 m`.
    #[must_use]
    pub fn floors(&self) -> String {
        let side = |i: usize| {
            format!(
                "storey {} of \"{}\" at {} m",
                self.place.storeys[i].unwrap_or(0),
                self.between[i],
                self.place.elevations[i].unwrap_or(0.0)
            )
        };
        format!("{} and {}", side(0), side(1))
    }
}

/// What to say behind the first of so many pairs of unequal floors: that there are more.
#[must_use]
pub fn more_pairs(pairs: usize) -> String {
    match pairs {
        1 => String::new(),
        n => format!(" (the first of {n} such pairs in this gap)"),
    }
}

impl System {
    /// Levels of a gap whose floors are not level within its tolerance, from the bottom.
    #[must_use]
    pub fn unequal_floors(&self, gap: &Gap) -> Vec<UnequalFloors> {
        let levels = self.levels_of(gap).iter();
        let unequal = levels.filter(|l| !l.place.is_level(gap.elevation_tolerance));
        unequal
            .filter_map(|l| match l.place.elevations {
                [Some(left), Some(right)] => Some(UnequalFloors {
                    between: gap.between.clone(),
                    place: l.place,
                    // To the nanometre: that of two decimal numbers is one only so far.
                    difference: decimal(((left - right).abs() * 1.0e9).round() / 1.0e9),
                }),
                _ => None,
            })
            .collect()
    }

    /// Each gap in which floors at different elevations act on each other, or in which floors
    /// that meet columns hit nothing while others hit columns, as a warning.
    #[must_use]
    pub fn unequal_floor_warnings(&self) -> Vec<Warning> {
        let left_out = self
            .gaps()
            .iter()
            .flat_map(|gap| self.columns_left_out(gap));
        let warned = self.gaps().iter().filter_map(|gap| {
            let unequal = self.unequal_floors(gap);
            let first = unequal.first()?;
            Some(Warning::UnequalFloors {
                gap: gap.name.clone(),
                floors: first.floors(),
                difference: first.difference,
                pairs: unequal.len(),
            })
        });
        warned.chain(left_out).collect()
    }

    /// Whether a side of a contact level is no floor but a column between two.
    #[must_use]
    pub fn is_column(&self, level: &ContactLevel, side: usize) -> bool {
        let place = self.storey_of(level.between[side]);
        match (level.between[side], place, level.place.elevations[side]) {
            (Floor::Point(_), Some((building, storey)), Some(elevation)) => {
                self.buildings()[building].elevations()[storey] != elevation
            }
            _ => false,
        }
    }

    /// Floors of both sides of a gap that meet columns and hit nothing, where others hit
    /// columns.
    fn columns_left_out(&self, gap: &Gap) -> Vec<Warning> {
        let levels = self.levels_of(gap);
        let hits = |level: &ContactLevel| (0..2).any(|side| self.is_column(level, side));
        if !levels.iter().any(hits) {
            return Vec::new();
        }
        let of = |side: usize| {
            let places = levels
                .iter()
                .filter_map(|l| self.storey_of(l.between[side]));
            let building = places.map(|(building, _)| building).next()?;
            Some(&self.buildings()[building])
        };
        let (Some(left), Some(right)) = (of(0), of(1)) else {
            return Vec::new();
        };
        let both = [(0, left, right), (1, right, left)];
        let warned = both.into_iter().filter_map(|(side, own, other)| {
            let roof = other.elevations().last().copied().unwrap_or(0.0);
            let hits_nothing = |storey: &usize| {
                !levels.iter().any(|level| {
                    let place = self.storey_of(level.between[side]);
                    !self.is_column(level, side) && place.is_some_and(|(_, s)| s == *storey)
                })
            };
            let below = |storey: &usize| own.elevations()[*storey] < roof;
            let mut floors = (0..own.storeys()).filter(|s| below(s) && hits_nothing(s));
            let first = floors.next()?;
            Some(Warning::ColumnsLeftOut {
                gap: gap.name.clone(),
                floor: format!(
                    "floor {} of \"{}\" at {} m",
                    first + 1,
                    own.name(),
                    own.elevations()[first]
                ),
                hit: other.name().to_owned(),
                floors: 1 + floors.count(),
            })
        });
        warned.collect()
    }
}
