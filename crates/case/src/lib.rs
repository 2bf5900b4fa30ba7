//! The case file: units, validation with source positions, JSON Schema.
//!
//! The crate knows words, not physics: it turns a TOML text into plain SI values
//! and keeps where each stood, so that an error anywhere above can point at file,
//! line and column. What is done to a record it says by the types of `pounding-ground-motion`;
//! which floors are level it asks `pounding-shear-building`, which knows where floors lie.

// The same bits on every machine: see clippy.toml.
#![warn(clippy::disallowed_methods)]

pub mod document;
mod error;
mod located;
mod parse;
mod types;
mod units;

pub use error::{CaseError, Errors, MORE_FILES, UnreadParameter, is_short_of_files};
pub use located::Located;
pub use parse::{CaseTree, ProcessSteps, ground_motion_schema, process_steps, schema};
pub use types::*;
pub use units::{Dimension, Quantity, UnitError, parse_degrees, parse_quantity, unit_in};
