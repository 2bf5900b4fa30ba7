//! Accelerogram readers, one format per file; processing, intensity measures, spectra
//! and generators.
//!
//! [`read_all`] returns every series of a file as a [`Recording`]; [`read`]
//! chooses the acceleration that excites the buildings. An [`Accelerogram`]
//! cannot exist without unit and time step: it holds samples in m/s2 and says
//! where unit and step came from. Whatever is done to it, or how it was
//! generated, is reported by a list of [`StepRecord`]s.

// The same bits on every machine: see clippy.toml.
#![warn(clippy::disallowed_methods)]

pub mod distributions;
pub mod generators;
mod instrument;
pub mod matching;
pub mod measures;
pub mod processing;
pub mod spectra;
pub mod writers;

mod accelerogram;
mod components;
mod cut_numbers;
mod direction;
mod draft;
mod error;
mod fixed_width;
mod format;
mod formats;
mod fortran;
mod header_keys;
mod help;
mod integrals;
mod number;
mod options;
mod origin;
mod quantity;
mod recording;
mod regular_file;
mod row_widths;
mod select;
mod source;
mod start_times;
mod stated_step;
mod station_xml;
mod step_record;
mod stray_commas;
mod text;
mod time_column;
mod time_step;
mod unit;
mod volume;
mod volume_1;
mod volume_2;

pub use accelerogram::{Accelerogram, AccelerogramHistory, Peak};
pub use direction::Orientation;
pub use error::GroundMotionError;
pub use format::Format;
pub use formats::{read, read_all, read_all_bytes, read_bytes};
pub use options::{Offset, ReadOptions};
pub use origin::{Origin, Processing, ResponseFile};
pub use quantity::Quantity;
pub use recording::{HeaderPeak, Recording, Sampling, Series, WithoutSensitivity};
pub use station_xml::responses_beside;
pub use step_record::{StepNumber, StepRecord};
pub use unit::AccelerationUnit;
