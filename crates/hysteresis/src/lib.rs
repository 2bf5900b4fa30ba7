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
//!
//! ```
//! use pounding_hysteresis::{LawParameters, build, laboratory};
//!
//! let parameters = LawParameters::from_pairs(&[
//!     ("stiffness", 2.0e7),
//!     ("yield_force", 2.0e5),
//!     ("hardening_ratio", 0.05),
//! ]);
//! let law = build("bilinear", &parameters)?;
//! let points = laboratory::history(law.as_ref(), &[0.03, -0.03, 0.03], 0.01);
//! // A full cycle loses 4 (1 - r) Fy (A - Fy / k).
//! let cycle = points[2].dissipated - points[0].dissipated;
//! assert!((cycle - 4.0 * 0.95 * 2.0e5 * 0.02).abs() < 1e-8);
//! # Ok::<(), pounding_hysteresis::HysteresisError>(())
//! ```

// The same bits on every machine: see clippy.toml.
#![warn(clippy::disallowed_methods)]

pub mod error;
pub mod history;
pub mod iwan;
pub mod laboratory;
pub mod law;
pub mod parameters;
pub mod registry;

mod bouc_wen_family;
mod deteriorating;
mod laws;
mod masing;
mod path;
mod power_integral;
mod stiffness_degrading;
mod substeps;

pub use descriptor::*;
pub use error::HysteresisError;
pub use history::{History, MAXIMUM_INTERNAL_VARIABLES, Point};
pub use law::{descriptor, *};
pub use parameters::{LawParameters, yield_deformation};
pub use registry::{build, descriptors, find, help_among_gaps};
