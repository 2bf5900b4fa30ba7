//! What a series is, and the units in which agencies print it.

use std::fmt;

use crate::unit::AccelerationUnit;

/// What a series records.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// Ground acceleration (m/s2).
    Acceleration,
    /// Ground velocity (m/s).
    Velocity,
    /// Ground displacement (m).
    Displacement,
}

impl Quantity {
    /// Its name, as in `quantity = "acceleration"`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Acceleration => "acceleration",
            Self::Velocity => "velocity",
            Self::Displacement => "displacement",
        }
    }

    /// Symbol of its SI unit.
    #[must_use]
    pub fn si_symbol(self) -> &'static str {
        match self {
            Self::Acceleration => "m/s2",
            Self::Velocity => "m/s",
            Self::Displacement => "m",
        }
    }

    /// The quantity that a text in lower case names, if it names one alone: `uncorrected
    /// accelerogram`, `raw veloc. counts`.
    pub(crate) fn in_words(lower: &str) -> Option<Self> {
        let named = |q: &Self| lower.contains(&q.name()[..5]);
        let all = [Self::Acceleration, Self::Velocity, Self::Displacement];
        let mut found = all.into_iter().filter(named);
        found.next().filter(|_| found.next().is_none())
    }

    /// The quantity of this name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        [Self::Acceleration, Self::Velocity, Self::Displacement]
            .into_iter()
            .find(|q| q.name().eq_ignore_ascii_case(name.trim()))
    }
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A unit in which a file prints a series.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SeriesUnit {
    pub quantity: Quantity,
    pub symbol: &'static str,
    /// One unit in SI, or in g where `of_gravity`.
    factor: f64,
    of_gravity: bool,
}

impl SeriesUnit {
    pub(crate) const G: Self = Self::gravity("g", 1.0);
    pub(crate) const TENTH_G: Self = Self::gravity("g/10", 0.1);
    pub(crate) const MILLI_G: Self = Self::gravity("mg", 1.0e-3);
    pub(crate) const MICRO_G: Self = Self::gravity("micro-g", 1.0e-6);
    pub(crate) const M_S2: Self = Self::si(Quantity::Acceleration, "m/s2", 1.0);
    pub(crate) const CM_S2: Self = Self::si(Quantity::Acceleration, "cm/s2", 0.01);
    pub(crate) const MM_S2: Self = Self::si(Quantity::Acceleration, "mm/s2", 0.001);
    pub(crate) const NM_S2: Self = Self::si(Quantity::Acceleration, "nm/s2", 1.0e-9);
    pub(crate) const IN_S2: Self = Self::si(Quantity::Acceleration, "in/s2", 0.0254);
    pub(crate) const M_S: Self = Self::si(Quantity::Velocity, "m/s", 1.0);
    pub(crate) const CM_S: Self = Self::si(Quantity::Velocity, "cm/s", 0.01);
    pub(crate) const MM_S: Self = Self::si(Quantity::Velocity, "mm/s", 0.001);
    pub(crate) const IN_S: Self = Self::si(Quantity::Velocity, "in/s", 0.0254);
    pub(crate) const M: Self = Self::si(Quantity::Displacement, "m", 1.0);
    pub(crate) const CM: Self = Self::si(Quantity::Displacement, "cm", 0.01);
    pub(crate) const MM: Self = Self::si(Quantity::Displacement, "mm", 0.001);
    pub(crate) const IN: Self = Self::si(Quantity::Displacement, "in", 0.0254);

    const fn si(quantity: Quantity, symbol: &'static str, factor: f64) -> Self {
        Self {
            quantity,
            symbol,
            factor,
            of_gravity: false,
        }
    }

    const fn gravity(symbol: &'static str, factor: f64) -> Self {
        Self {
            quantity: Quantity::Acceleration,
            symbol,
            factor,
            of_gravity: true,
        }
    }

    /// One unit in SI, for a g of `gravity` (m/s2).
    pub(crate) fn in_si(self, gravity: f64) -> f64 {
        if self.of_gravity {
            self.factor * gravity
        } else {
            self.factor
        }
    }

    /// Whether it is a part or a multiple of g.
    pub(crate) fn is_of_gravity(self) -> bool {
        self.of_gravity
    }

    /// Whether the user's word means the same.
    pub(crate) fn is(self, unit: AccelerationUnit) -> bool {
        Self::from(unit) == self
    }

    /// The unit written as agencies write it, e.g. `cm/sec/sec`, `gal`, `CM/S^2`.
    pub(crate) fn parse(text: &str) -> Option<Self> {
        let plain: String = text
            .to_ascii_lowercase()
            .replace("sec", "s")
            .chars()
            .filter(|c| !matches!(c, '^' | ' ' | '\t' | '(' | ')' | '.'))
            .collect::<String>()
            .replace("s*s", "s2")
            .replace("s**2", "s2")
            .replace("/s/s", "/s2");
        Some(match plain.as_str() {
            "g" => Self::G,
            "g/10" => Self::TENTH_G,
            "mg" => Self::MILLI_G,
            "m/s2" => Self::M_S2,
            "cm/s2" | "cms/s2" | "gal" | "gals" => Self::CM_S2,
            "mm/s2" => Self::MM_S2,
            "in/s2" => Self::IN_S2,
            "ft/s2" => Self::from(AccelerationUnit::FootPerSecondSquared),
            "nm/s2" => Self::NM_S2,
            "m/s" => Self::M_S,
            "cm/s" | "cms/s" => Self::CM_S,
            "mm/s" => Self::MM_S,
            "in/s" => Self::IN_S,
            "m" => Self::M,
            "cm" | "cms" => Self::CM,
            "mm" => Self::MM,
            "in" => Self::IN,
            _ => return None,
        })
    }
}

impl From<AccelerationUnit> for SeriesUnit {
    fn from(unit: AccelerationUnit) -> Self {
        if unit == AccelerationUnit::StandardGravity {
            Self::G
        } else {
            Self::si(Quantity::Acceleration, unit.symbol(), unit.in_si())
        }
    }
}
