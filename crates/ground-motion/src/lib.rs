//! Accelerogram readers, one format a file, and scaling.
//!
//! An [`Accelerogram`] cannot exist without unit and time step: it holds samples
//! in m/s2 and says where unit and step came from.

mod accelerogram;
mod error;
mod formats;
mod number;
mod unit;

pub use accelerogram::{Accelerogram, Origin, Peak};
pub use error::GroundMotionError;
pub use formats::{Format, ReadOptions, read, read_bytes};
pub use unit::AccelerationUnit;
