//! Many runs of one case: is the gap wide enough, is the answer sensitive to
//! the impact model, and how likely is pounding?
//!
//! A [`Study`] is read from a file: a case, variables that replace its entries, and a
//! [`Design`] that samples them. [`sweep()`] makes its runs on all cores, stores finished
//! ones so that an interruption loses at most the chunk in flight, and writes one HDF5
//! file whose contents depend on the study only.
//!
//! Without the feature `results`, which needs HDF5, there are gap checks, calibrated models,
//! edited cases and what is wrong with them: all that reads and writes no file.

// The same bits on every machine: see clippy.toml.
#![warn(clippy::disallowed_methods)]

pub mod calibration;
pub mod edited;
pub mod faults;
pub mod floor_spectra;
pub mod gap_check;

// Studies replace and identify more than a single case.
#[cfg_attr(not(feature = "results"), allow(dead_code, unused_imports))]
mod case_text;
mod fractiles;

#[cfg(feature = "results")]
pub mod comparison;
#[cfg(feature = "results")]
mod error;
#[cfg(feature = "results")]
mod ida;
#[cfg(feature = "results")]
mod merge;
#[cfg(feature = "results")]
mod mixing;
#[cfg(feature = "results")]
mod parts;
#[cfg(feature = "results")]
mod result_name;
#[cfg(feature = "results")]
mod runs;
#[cfg(feature = "results")]
pub mod sensitivity;
#[cfg(feature = "results")]
mod shard;
#[cfg(feature = "results")]
mod shown;
#[cfg(feature = "results")]
mod stored_runs;
#[cfg(feature = "results")]
mod study_file;
#[cfg(feature = "results")]
mod sweep;
#[cfg(feature = "results")]
mod table;
#[cfg(feature = "results")]
mod written_by_hand;

/// What this program was built of and for, as far as the results of runs may depend on it:
/// version, hash of the sources of the crates that compute and of the versions of their
/// dependencies, target, instructions that the compiler may use anywhere, and features. Built
/// from a package of a registry it holds the version, which names the sources there, instead of
/// the hash, and does not know the versions of other dependencies. Runs of two builds are not
/// mixed in a result unless that is asked for.
pub const BUILD: &str = env!("POUNDING_BUILD");

#[cfg(feature = "results")]
pub use error::StudyError;
pub use fractiles::fractile;
pub use gap_check::Deal;
#[cfg(feature = "results")]
pub use gap_check::is_shard_of_check;
#[cfg(feature = "results")]
pub use ida::*;
#[cfg(feature = "results")]
pub use merge::{MergeReport, merge, merge_saying, read_by_study};
#[cfg(feature = "results")]
pub use pounding_results::study::{
    Coordinate, Description, Fault, MergeOptions, Part, ResultReader, StudyFileError, Survey,
    ranges, survey,
};
#[cfg(feature = "results")]
pub use result_name::{
    ShardName, default_result, default_result_of, refuse_name_of_shard, study_name,
};
#[cfg(feature = "results")]
pub use runs::{
    Axis, Ending, IsolatedQuantities, IsolatedRun, Layout, Place, Quantity, RECORDS_FOLDER,
    RecordReport, Row,
};
#[cfg(feature = "results")]
pub use shard::Shard;
#[cfg(feature = "results")]
pub use shown::case_of_run;
#[cfg(feature = "results")]
pub use study_file::{
    DemandKind, Design, Distribution, HazardCurve, IdaSettings, IntensityMeasure, Limit,
    MOST_DIMENSIONS, Spacing, Study, Value, Values, Variable, hazard_schema, study_schema,
};
#[cfg(feature = "results")]
pub use sweep::{Progress, SweepOptions, SweepReport, parts_folder, sweep, writable};
#[cfg(feature = "results")]
pub use table::{RunTable, writable_table};
#[cfg(feature = "results")]
pub use written_by_hand::written_by_hand;
