//! Units of acceleration.

use std::str::FromStr;

use pounding_catalogue::STANDARD_GRAVITY;

use crate::error::GroundMotionError;

/// A unit of acceleration.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AccelerationUnit {
    /// m/s2.
    MetrePerSecondSquared,
    /// Standard gravity, 9.80665 m/s2 (ISO 80000-3).
    StandardGravity,
    /// A thousandth of it, mg.
    MilliGravity,
    /// A tenth of it, g/10, as agencies print.
    TenthGravity,
    /// cm/s2, also called gal.
    Gal,
    /// mm/s2.
    MillimetrePerSecondSquared,
    /// in/s2, 0.0254 m/s2.
    InchPerSecondSquared,
    /// ft/s2, 0.3048 m/s2.
    FootPerSecondSquared,
}

impl AccelerationUnit {
    /// One unit in m/s2.
    #[must_use]
    pub fn in_si(self) -> f64 {
        match self {
            Self::MetrePerSecondSquared => 1.0,
            Self::StandardGravity => STANDARD_GRAVITY,
            Self::MilliGravity => 1.0e-3 * STANDARD_GRAVITY,
            Self::TenthGravity => 0.1 * STANDARD_GRAVITY,
            Self::Gal => 0.01,
            Self::MillimetrePerSecondSquared => 0.001,
            Self::InchPerSecondSquared => 0.0254,
            Self::FootPerSecondSquared => 0.3048,
        }
    }

    /// The unit's usual symbol.
    #[must_use]
    pub fn symbol(self) -> &'static str {
        match self {
            Self::MetrePerSecondSquared => "m/s2",
            Self::StandardGravity => "g",
            Self::MilliGravity => "mg",
            Self::TenthGravity => "g/10",
            Self::Gal => "cm/s2",
            Self::MillimetrePerSecondSquared => "mm/s2",
            Self::InchPerSecondSquared => "in/s2",
            Self::FootPerSecondSquared => "ft/s2",
        }
    }
}

impl FromStr for AccelerationUnit {
    type Err = GroundMotionError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let plain: String = text
            .trim()
            .to_lowercase()
            .replace('²', "2")
            .chars()
            .filter(|c| !matches!(c, '^' | ' ' | '*'))
            .collect();
        let known = match plain.as_str() {
            "g" => Some(Self::StandardGravity),
            "mg" => Some(Self::MilliGravity),
            "g/10" => Some(Self::TenthGravity),
            "m/s2" | "m/s/s" | "m/sec2" | "m/sec/sec" => Some(Self::MetrePerSecondSquared),
            "cm/s2" | "cm/s/s" | "cm/sec2" | "cm/sec/sec" | "gal" => Some(Self::Gal),
            "mm/s2" | "mm/s/s" | "mm/sec2" => Some(Self::MillimetrePerSecondSquared),
            "in/s2" | "in/s/s" | "in/sec2" => Some(Self::InchPerSecondSquared),
            "ft/s2" | "ft/s/s" | "ft/sec2" => Some(Self::FootPerSecondSquared),
            _ => None,
        };
        known.ok_or_else(|| GroundMotionError::Unit {
            text: text.to_owned(),
            hint: match plain.as_str() {
                "m/s" | "cm/s" | "mm/s" | "in/s" | "cm/sec" => ": it is one of velocity",
                "m" | "cm" | "mm" | "in" | "ft" => ": it is one of displacement",
                _ => "",
            },
        })
    }
}
