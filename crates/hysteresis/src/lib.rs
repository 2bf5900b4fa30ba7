//! Force-deformation laws with memory for yielding storeys and links between floors.
//!
//! One trait, [`HysteresisLaw`], serves two kinds of method. Implicit methods ask
//! for the force and its tangents at a trial point ([`HysteresisLaw::trial`]).
//! Explicit methods that locate events hold a branch within a step
//! ([`HysteresisLaw::force`]), watch its guards and pass them one by one
//! ([`HysteresisLaw::pass`]). What happened lies in a [`History`], a plain value.
//!
//! Deformation and force of one law have the same sign: a positive deformation of
//! a spring makes a positive force. Units are SI throughout.

pub mod descriptor;
pub mod error;
pub mod history;
pub mod iwan;
pub mod laboratory;
pub mod law;
pub mod parameters;
pub mod registry;

mod bouc_wen_family;
mod deteriorating;
mod iwan_fit;
mod laws;
mod masing;
mod path;
mod power_integral;
mod stiffness_degrading;
mod substeps;

pub use descriptor::*;
pub use error::HysteresisError;
pub use history::{History, MAXIMUM_INTERNAL_VARIABLES, Point};
pub use law::*;
pub use parameters::LawParameters;
pub use registry::{build, descriptors, find};
