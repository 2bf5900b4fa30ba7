//! Where a level of a gap or of a link lies, and how results name it.

use std::fmt;

use pounding_shear_building::{WALL, are_level};

/// Which motions of two buildings a link joins.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum LinkedMotion {
    /// Displacements of floors.
    Floors,
    /// Displacements of foundations.
    FoundationSway,
    /// Rotations of foundations: moments take the place of forces.
    FoundationRotation,
}

impl LinkedMotion {
    /// SI units of deformation and force.
    #[must_use]
    pub fn units(self) -> [&'static str; 2] {
        match self {
            Self::Floors | Self::FoundationSway => ["m", "N"],
            Self::FoundationRotation => ["rad", "N m"],
        }
    }

    /// What stands in the place of the level of a link that joins no floors.
    #[must_use]
    pub fn label(self) -> Option<&'static str> {
        match self {
            Self::Floors => None,
            Self::FoundationSway => Some("sway of foundations"),
            Self::FoundationRotation => Some("rotation of foundations"),
        }
    }
}

/// The floors on both sides of a contact level or of a level of a link, left and right;
/// `None` is a rigid wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LevelPlace {
    /// Storey numbers, from 1 at the bottom.
    pub storeys: [Option<usize>; 2],
    /// Elevations (m).
    pub elevations: [Option<f64>; 2],
    /// Position across the row (m), of floors that turn in plan.
    pub across: Option<f64>,
    /// What is there: floors, or of a link foundations, which have neither storey nor elevation.
    pub joins: LinkedMotion,
}

impl LevelPlace {
    /// Short name: left and right storey, `3-3`, or `3-wall`; of foundations what of them is joined.
    #[must_use]
    pub fn label(&self) -> String {
        if let Some(label) = self.joins.label() {
            return label.to_owned();
        }
        let storeys = self.storeys.map(or_wall).join("-");
        match self.across {
            None => storeys,
            Some(across) => format!("{storeys} at {across} m across"),
        }
    }

    /// Left and right elevation (m), `9 / 9`, or `9 / wall`.
    #[must_use]
    pub fn elevations_label(&self) -> String {
        self.elevations.map(or_wall).join(" / ")
    }

    /// Whether both floors are level within a tolerance (m). A wall is level with every
    /// floor.
    #[must_use]
    pub fn is_level(&self, tolerance: f64) -> bool {
        match self.elevations {
            [Some(left), Some(right)] => are_level(left, right, tolerance),
            _ => true,
        }
    }
}

/// Label, storeys and elevations; a wall has neither storey nor elevation.
#[cfg(feature = "serde")]
impl serde::Serialize for LevelPlace {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        use serde::ser::SerializeStruct;

        let mut place = serializer.serialize_struct("LevelPlace", 6)?;
        place.serialize_field("level", &self.label())?;
        place.serialize_field("left_storey", &self.storeys[0])?;
        place.serialize_field("right_storey", &self.storeys[1])?;
        place.serialize_field("left_elevation", &self.elevations[0])?;
        place.serialize_field("right_elevation", &self.elevations[1])?;
        place.serialize_field("across", &self.across)?;
        place.end()
    }
}

/// Storeys and elevations: `3-3 (9 m | 9 m)`, or `3-wall (9 m | wall)`.
impl fmt::Display for LevelPlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let side = |z: Option<f64>| or_wall(z.map(|z| format!("{z} m")));
        let [left, right] = self.elevations.map(side);
        write!(f, "{} ({left} | {right})", self.label())
    }
}

fn or_wall(side: Option<impl ToString>) -> String {
    side.map_or_else(|| WALL.to_owned(), |x| x.to_string())
}

#[cfg(test)]
mod tests {
    use super::{LevelPlace, LinkedMotion};

    #[test]
    fn both_storeys_and_both_elevations_are_in_the_name() {
        let place = LevelPlace {
            storeys: [Some(4), Some(1)],
            elevations: [Some(12.0), Some(3.06)],
            across: None,
            joins: LinkedMotion::Floors,
        };
        assert_eq!(place.label(), "4-1");
        assert_eq!(place.elevations_label(), "12 / 3.06");
        assert_eq!(place.to_string(), "4-1 (12 m | 3.06 m)");
        assert!(!place.is_level(0.01) && place.is_level(9.0));
        let wall = LevelPlace {
            storeys: [None, Some(2)],
            elevations: [None, Some(6.0)],
            across: None,
            joins: LinkedMotion::Floors,
        };
        assert_eq!(wall.to_string(), "wall-2 (wall | 6 m)");
        assert!(wall.is_level(0.0));
        let point = LevelPlace {
            across: Some(-5.0),
            ..place
        };
        assert_eq!(point.label(), "4-1 at -5 m across");
    }
}
