//! Floors at different elevations that face one another in a gap.

use pounding_shear_building::decimal;

use super::{ContactLevel, Floor, Gap, LevelPlace, System};

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
}
