//! Where a contact stiffness comes from: five ways to a number, each with its
//! source and with warnings where it does not hold. Pure functions, SI units.

mod hertz;
mod multiple;
mod power_law;
mod slab;

pub use hertz::{Sphere, hertz};
pub use multiple::{CUSTOMARY_MULTIPLE, MULTIPLES_IN_USE, multiple};
pub use power_law::{Approach, duration, penetration};
pub use slab::{Slab, slab};

use crate::descriptor::Verification;

/// A contact stiffness and what is known of it.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactStiffness {
    /// Stiffness `k` of `F = k delta^n` (N/m^n).
    pub value: f64,
    /// Exponent `n` of the law that it belongs to (-).
    pub exponent: f64,
    /// Author, year, journal.
    pub source: &'static str,
    /// How far it has been checked.
    pub status: Verification,
    /// What was computed on the way or follows from it.
    pub intermediate: Vec<Intermediate>,
    /// Where the number does not hold.
    pub warnings: Vec<String>,
}

/// A quantity computed on the way to a stiffness.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Intermediate {
    /// Name, spelled out.
    pub name: &'static str,
    /// Value in the unit.
    pub value: f64,
    /// SI unit.
    pub unit: &'static str,
}

/// What cannot be turned into a stiffness.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ContactStiffnessError {
    /// A quantity that is negative, zero or not a finite number.
    #[error("{quantity} = {value} {unit}, but it must be finite and greater than zero")]
    NotPositive {
        /// The quantity.
        quantity: &'static str,
        /// Value (SI).
        value: f64,
        /// SI unit.
        unit: &'static str,
    },
    /// A quantity outside its range.
    #[error("{quantity} = {value} is outside {range}")]
    OutOfRange {
        /// The quantity.
        quantity: &'static str,
        /// Value (SI).
        value: f64,
        /// Allowed range.
        range: &'static str,
    },
    /// Two flat bodies, which Hertz's theory does not cover.
    #[error("both bodies are flat, and flat on flat is not a Hertz contact")]
    BothFlat,
    /// A result too large or too small for a number.
    #[error("{quantity} comes out as {value}: the input is too large or too small")]
    NotRepresentable {
        /// The quantity.
        quantity: &'static str,
        /// What came out (SI).
        value: f64,
    },
}

impl ContactStiffnessError {
    /// What to do about it.
    #[must_use]
    pub fn help(&self) -> String {
        match self {
            Self::BothFlat => "slab against slab is linear: see `pounding stiffness slab`",
            Self::OutOfRange { quantity, .. } => match *quantity {
                "Poisson's ratio" => "concrete has about 0.2, steel 0.3, rubber 0.5",
                "exponent" => {
                    "1 is a linear law, 1.5 that of Hertz; impact models take exponents from 1 to 5"
                }
                "factor" => "20 is customary, 10 to 100 are in use",
                _ => "restitution is 1 for an elastic impact, 0.65 is customary for concrete",
            },
            Self::NotPositive { .. } | Self::NotRepresentable { .. } => {
                "check the value and its unit; plain numbers are SI"
            }
        }
        .to_owned()
    }
}

impl ContactStiffness {
    /// Unit of the value: `N/m`, or `N/m^n` with the exponent in figures.
    #[must_use]
    pub fn unit(&self) -> String {
        if self.exponent == 1.0 {
            "N/m".to_owned()
        } else {
            format!("N/m^{}", self.exponent)
        }
    }

    /// The line for a gap of a case file. All digits: it reads back as the value. An exponent that a
    /// model must be given, neither that of linear laws nor that of Hertz, has a line of its own.
    #[must_use]
    pub fn case_line(&self) -> String {
        let stiffness = format!("stiffness = \"{:e} {}\"", self.value, self.unit());
        match self.exponent {
            1.0 | 1.5 => stiffness,
            n => format!("{stiffness}\nexponent = {n}"),
        }
    }

    /// Refuses numbers that no run could use.
    fn checked(self) -> Result<Self, ContactStiffnessError> {
        let quantities = self.intermediate.iter().map(|i| (i.name, i.value));
        for (quantity, value) in quantities.chain([("stiffness", self.value)]) {
            if !(value.is_normal() && value > 0.0) {
                return Err(ContactStiffnessError::NotRepresentable { quantity, value });
            }
        }
        Ok(self)
    }
}

fn quantity(name: &'static str, value: f64, unit: &'static str) -> Intermediate {
    Intermediate { name, value, unit }
}

fn positive(
    quantity: &'static str,
    value: f64,
    unit: &'static str,
) -> Result<(), ContactStiffnessError> {
    if value.is_finite() && value > 0.0 {
        return Ok(());
    }
    Err(ContactStiffnessError::NotPositive {
        quantity,
        value,
        unit,
    })
}
