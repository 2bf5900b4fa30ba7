//! The laboratory: impact models with the values of their examples, put through collisions of
//! two bodies ([`crate::collide_with`], [`crate::restitution_table()`]) and held against measured
//! contact forces ([`MeasuredForce`]).

mod measured;
mod specimen;

pub use measured::{Difference, MeasuredForce, MeasuredForceError};
pub use specimen::{Specimen, exponent_of, unit_of};

use crate::collision::Bodies;

/// The bodies of all examples: a floor of 25 t meets one of 40 t at rest with 0.8 m/s.
pub const EXAMPLE_BODIES: Bodies = Bodies {
    mass_left: 25.0e3,
    mass_right: Some(40.0e3),
    velocity_left: 0.8,
    velocity_right: 0.0,
};

/// The restitution of the examples: customary for concrete floors.
pub const EXAMPLE_RESTITUTION: f64 = 0.65;
