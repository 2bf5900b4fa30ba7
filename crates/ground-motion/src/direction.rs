//! Directions as agencies write them: `90`, `90 deg`, `N00E`, `S 58 W`, `N-S`, `UP`.

use serde::{Deserialize, Serialize};

/// Where the positive values of a component point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Direction {
    /// Horizontal, degrees from north over east, in [0, 360).
    Azimuth(f64),
    /// Vertical.
    Up,
    /// Vertical, downwards.
    Down,
}

/// Where the positive values of a component point, as header or metadata state it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Orientation {
    /// Azimuth (degrees), from north over east.
    pub azimuth: f64,
    /// Dip (degrees), below the horizontal: -90 is upwards.
    pub dip: f64,
}

impl Orientation {
    /// Of angles (degrees) that can be those of a component.
    pub(crate) fn of(azimuth: f64, dip: f64) -> Option<Self> {
        let inside = (-360.0..=360.0).contains(&azimuth) && (-90.0..=90.0).contains(&dip);
        inside.then_some(Self { azimuth, dip })
    }

    /// The other way.
    pub(crate) fn reversed(self) -> Self {
        Self {
            azimuth: (self.azimuth + 180.0).rem_euclid(360.0),
            dip: 0.0 - self.dip,
        }
    }

    /// The direction; what is not horizontal counts as vertical.
    pub(crate) fn direction(self) -> Direction {
        if self.dip.abs() <= OFF_NAME {
            Direction::Azimuth(self.azimuth.rem_euclid(360.0))
        } else if self.dip < 0.0 {
            Direction::Up
        } else {
            Direction::Down
        }
    }

    /// What is to be said where a component's name says another direction.
    pub(crate) fn against_name(self, name: &str) -> Option<String> {
        let named = Direction::of_name(name)?;
        let stated = self.direction();
        let opposite = match (named, stated) {
            (Direction::Azimuth(a), Direction::Azimuth(b)) => {
                let apart = (a - b).rem_euclid(360.0);
                if apart.min(360.0 - apart) <= OFF_NAME {
                    return None;
                }
                (apart - 180.0).abs() <= OFF_NAME
            }
            (Direction::Azimuth(_), _) | (_, Direction::Azimuth(_)) => false,
            (a, b) if a == b => return None,
            _ => true,
        };
        let what = if opposite {
            "points the other way than its name says: its samples are used as they stand, with reversed sign against the name"
        } else {
            "points elsewhere than its name says: it is taken to point there"
        };
        Some(format!(
            "component {name} has azimuth {} and dip {} degrees, and {what}",
            self.azimuth, self.dip
        ))
    }
}

/// Degrees by which a component may miss the direction of its code (SEED manual, appendix A).
const OFF_NAME: f64 = 5.0;

/// Degrees within which whole degrees are those of an azimuth with decimals.
const WHOLE: f64 = 1.0;

/// Degrees within which two azimuths are the same.
const SAME: f64 = 0.01;

impl Direction {
    /// The direction that a component's name says; a letter before an azimuth is passed over, as
    /// in `L 50 deg`.
    pub(crate) fn parse(name: &str) -> Option<Self> {
        // What stands in brackets explains it: `NS (north-south)`.
        let name = name.split('(').next().unwrap_or(name);
        let upper = name.to_ascii_uppercase();
        let plain: String = upper
            .chars()
            .filter(|c| !matches!(c, ' ' | '\t' | '\u{b0}' | ':'))
            .collect();
        let plain = plain.strip_suffix("REES").unwrap_or(&plain);
        let plain = plain.strip_suffix("DEG").unwrap_or(plain);
        let named = match plain {
            "N" | "NS" | "N-S" | "NORTH" => Some(Self::Azimuth(0.0)),
            "E" | "EW" | "E-W" | "EAST" => Some(Self::Azimuth(90.0)),
            "S" | "SOUTH" => Some(Self::Azimuth(180.0)),
            "W" | "WEST" => Some(Self::Azimuth(270.0)),
            "V" | "Z" | "U" | "UP" | "UD" | "U-D" | "VER" | "VERT" | "VERTICAL" => Some(Self::Up),
            "DOWN" | "DN" | "DWN" => Some(Self::Down),
            _ => None,
        };
        named
            .or_else(|| Self::of_degrees(plain))
            .or_else(|| Self::of_compass(plain))
            .or_else(|| {
                let rest = plain.strip_prefix(['L', 'T', 'H', 'R'])?;
                Self::of_degrees(rest)
            })
    }

    /// The direction that a component's name says, also by its code (`HNE`: SEED manual, appendix
    /// A) or number (`NS2` of KiK-net). `H1` and `2` are numbers of components.
    pub(crate) fn of_name(name: &str) -> Option<Self> {
        let name = name.split('(').next()?.trim();
        // `10.HNE`: the code of a location goes before.
        let name = match name.rsplit_once('.') {
            Some((location, code)) if Self::of_code(code).is_some() && !location.contains(' ') => {
                code
            }
            _ => name,
        };
        if let Some((direction, _)) = Self::of_borehole(name) {
            return Some(direction);
        }
        let number = name.trim_start_matches(|c: char| c.is_ascii_alphabetic());
        if matches!(number.trim(), "1" | "2" | "3") {
            return None;
        }
        Self::of_code(name).or_else(|| Self::parse(name))
    }

    /// Third letter of a code of band, instrument and direction.
    fn of_code(name: &str) -> Option<Self> {
        let upper = name.to_ascii_uppercase();
        let [band, instrument, direction] = upper.as_bytes() else {
            return None;
        };
        if !(band.is_ascii_uppercase() && b"HLGMN".contains(instrument)) {
            return None;
        }
        match direction {
            b'N' => Some(Self::Azimuth(0.0)),
            b'E' => Some(Self::Azimuth(90.0)),
            b'Z' => Some(Self::Up),
            _ => None,
        }
    }

    /// Direction and number of the instrument of `NS1` (in the borehole) or `UD2` (at the surface).
    pub(crate) fn of_borehole(name: &str) -> Option<(Self, u8)> {
        let (direction, instrument) = name.trim().split_at_checked(2)?;
        let instrument = match instrument {
            "1" => 1,
            "2" => 2,
            _ => return None,
        };
        let direction = match direction.to_ascii_uppercase().as_str() {
            "NS" => Self::Azimuth(0.0),
            "EW" => Self::Azimuth(90.0),
            "UD" => Self::Up,
            _ => return None,
        };
        Some((direction, instrument))
    }

    fn of_degrees(text: &str) -> Option<Self> {
        let is_number = text.bytes().all(|b| b.is_ascii_digit() || b == b'.');
        let degrees = text.parse::<f64>().ok().filter(|_| is_number)?;
        (0.0..=360.0)
            .contains(&degrees)
            .then_some(Self::Azimuth(degrees % 360.0))
    }

    /// `N00E`, `S58W`: degrees from north or south towards east or west.
    fn of_compass(text: &str) -> Option<Self> {
        let from = text.chars().next()?;
        let towards = text.chars().last()?;
        let angle = text.get(1..text.len().checked_sub(1)?)?;
        let Self::Azimuth(angle) = Self::of_degrees(angle)? else {
            return None;
        };
        let azimuth = match (from, towards) {
            ('N', 'E') => angle,
            ('N', 'W') => 360.0 - angle,
            ('S', 'E') => 180.0 - angle,
            ('S', 'W') => 180.0 + angle,
            _ => return None,
        };
        Some(Self::Azimuth(azimuth.rem_euclid(360.0)))
    }

    /// Whether two directions are the same, azimuths within so many degrees.
    fn is_within(self, other: Self, degrees: f64) -> bool {
        match (self, other) {
            (Self::Azimuth(a), Self::Azimuth(b)) => {
                let apart = (a - b).rem_euclid(360.0);
                apart.min(360.0 - apart) <= degrees
            }
            (a, b) => a == b,
        }
    }

    /// Whether two directions are the same.
    pub(crate) fn is(self, other: Self) -> bool {
        self.is_within(other, SAME)
    }

    /// The direction that an integer of a header says beside one in words: an azimuth of whole degrees
    /// from 1 to 360, or 500 for upwards, which is not the one in words. Zero is a field that was not
    /// filled in, and beside a vertical component an azimuth says nothing.
    pub(crate) fn contradicts(words: &str, integer: f64) -> Option<String> {
        let Some(named @ Self::Azimuth(_)) = Self::parse(words) else {
            return None;
        };
        let (stated, shown) = match integer {
            500.0 => (Self::Up, "Up".to_owned()),
            n if (1.0..=360.0).contains(&n) && n.fract() == 0.0 => {
                (Self::Azimuth(n), format!("{n} degrees"))
            }
            _ => return None,
        };
        (!named.is_within(stated, WHOLE)).then_some(shown)
    }

    /// Whether two names say different directions; what says none contradicts nothing.
    pub(crate) fn differ(a: &str, b: &str) -> bool {
        match (Self::parse(a), Self::parse(b)) {
            (Some(a), Some(b)) => !a.is(b),
            _ => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_directions() {
        for (name, degrees) in [
            ("90", 90.0),
            ("360", 0.0),
            ("0", 0.0),
            ("90 deg", 90.0),
            ("360 Deg", 0.0),
            ("N00E", 0.0),
            ("N90E", 90.0),
            ("N90W", 270.0),
            ("S00E", 180.0),
            ("S 58 W", 238.0),
            ("s74e", 106.0),
            ("N-S", 0.0),
            ("EW", 90.0),
            ("L 50 deg", 50.0),
            ("T 140", 140.0),
            ("West", 270.0),
            ("NS (north-south)", 0.0),
        ] {
            assert_eq!(
                Direction::parse(name),
                Some(Direction::Azimuth(degrees)),
                "{name}"
            );
        }
        for name in ["V", "UP", "Up", "U-D", "Vert", "Z"] {
            assert_eq!(Direction::parse(name), Some(Direction::Up), "{name}");
        }
        assert_eq!(Direction::parse("Down"), Some(Direction::Down));
        for name in [
            "", "L", "HNE", "361", "NE", "S-N", "-90", "Other", "N00", "1e1",
        ] {
            assert_eq!(Direction::parse(name), None, "{name}");
        }
        assert!(!Direction::differ("360 deg", "N00E"));
        assert!(Direction::differ("N00E", "N90E") && Direction::differ("V", "90"));
        assert!(!Direction::differ("V", "Other"));
    }
}
