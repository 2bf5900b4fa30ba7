//! Directions as agencies write them: `90`, `90 deg`, `N00E`, `S 58 W`, `N-S`, `UP`.

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
            "V" | "Z" | "U" | "UP" | "UD" | "U-D" | "VERT" | "VERTICAL" => Some(Self::Up),
            "DOWN" | "DN" => Some(Self::Down),
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

    /// Whether two directions are the same.
    pub(crate) fn is(self, other: Self) -> bool {
        match (self, other) {
            (Self::Azimuth(a), Self::Azimuth(b)) => {
                let apart = (a - b).rem_euclid(360.0);
                apart.min(360.0 - apart) <= SAME
            }
            (a, b) => a == b,
        }
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
