//! How many steps a run may take, what makes them so many, and how short its contacts may be.

use std::fmt;

use crate::short_numbers::short;

/// Steps of a run at most: more than a day at a microsecond each.
pub const MAXIMUM_STEPS: f64 = 1.0e11;

/// Approach velocity (m/s) at which a contact is looked at before the run.
pub(crate) const APPROACH_VELOCITY: f64 = 0.5;

/// Duration of a contact (s) at least: what follows times of some ten
/// seconds with 16 digits loses the energy of shorter ones.
pub(crate) const SHORTEST_CONTACT: f64 = 1.0e-12;

/// What makes the steps of a run so many.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "snake_case")
)]
#[non_exhaustive]
pub enum StepLimit {
    /// The duration (s), longer than that of any ground motion.
    Duration(f64),
    /// The time step of the ground motion (s).
    GroundMotion(f64),
    /// The step that was asked for (s).
    Step(f64),
    /// The shortest period (s), or the shortest memory of a damper times two pi.
    Period {
        /// Name of the building that has it.
        building: String,
        /// Period (s).
        period: f64,
    },
    /// The shortest period (s) of a floor on a storey or link that follows a law, or the memory of a damper
    /// or of its law times two pi.
    Element {
        /// The storey or link.
        place: String,
        /// Period (s) with the law's initial stiffness, or its damping.
        period: f64,
    },
}

impl fmt::Display for StepLimit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Duration(duration) => write!(f, "`duration` is {} s", short(*duration)),
            Self::GroundMotion(step) => {
                write!(
                    f,
                    "the time step of the ground motion is {} s",
                    short(*step)
                )
            }
            Self::Step(step) => write!(f, "`step` is {} s", short(*step)),
            Self::Period { building, period } => {
                write!(
                    f,
                    "the shortest period of building {building} is {period:.3e} s"
                )
            }
            Self::Element { place, period } => {
                write!(f, "{place} gives its floor a period of {period:.3e} s")
            }
        }
    }
}

impl StepLimit {
    /// What makes steps longer, or fewer.
    pub(crate) fn remedy(&self) -> &'static str {
        match self {
            Self::Duration(_) => "shorten `duration` in [analysis]",
            Self::GroundMotion(_) => "shorten `duration`, or correct the time step of the record",
            Self::Step(_) => "raise `step` or shorten `duration` in [analysis]",
            Self::Element { .. } => {
                "correct stiffness and damping of the law and the masses beside it (units?); else shorten `duration`"
            }
            Self::Period { .. } => {
                "correct masses, stiffnesses and damping (units?), or join storeys that are much lighter or stiffer than their neighbours; else shorten `duration`"
            }
        }
    }
}
