//! Impact models for the gaps between buildings: trait, models, registry, two-body collision.

// The same bits on every machine: see clippy.toml.
#![warn(clippy::disallowed_methods)]

pub mod calibration;
pub mod contact_stiffness;
pub mod error;
pub mod laboratory;
pub mod model;
pub mod parameters;
pub mod published;
pub mod registry;

mod classes;
mod collision;
mod in_series;
mod models;
mod restitution_table;
mod separation_rule;

pub use collision::{
    Bodies, CollisionOptions, CollisionOutcome, CollisionSample, collide, collide_with,
};
pub use descriptor::*;
pub use error::GapElementError;
pub use in_series::in_series;
pub use model::{descriptor, *};
pub use parameters::ModelParameters;
pub use restitution_table::*;
