//! Many runs of one case: is the gap wide enough, is the answer sensitive to
//! the impact model, and how likely is pounding?
//!
//! A [`Study`] is read from a file: a case, variables that replace its entries, and a
//! [`Design`] that samples them. [`sweep()`] makes its runs on all cores, stores finished
//! ones so that an interruption loses at most the chunk in flight, and writes one HDF5
//! file whose contents depend on the study only.

pub mod comparison;
pub mod faults;
pub mod gap_check;

mod case_text;
mod dealt;
mod design;
mod error;
mod fractiles;
mod ida;
mod merge;
mod parts;
mod runs;
mod shown;
mod study_file;
mod sweep;
mod table;

/// What this program was built of and for, as far as the results of runs may depend on it:
/// version, hash of the sources of the crates that compute and of the versions of their
/// dependencies, target, instructions that the compiler may use anywhere, and features. Built
/// from a package of a registry it holds the version, which names the sources there, instead of
/// the hash, and does not know the versions of other dependencies. Runs of two builds are not
/// mixed in a result unless that is asked for.
pub const BUILD: &str = env!("POUNDING_BUILD");

pub use dealt::Deal;
pub use design::{Design, MOST_DIMENSIONS};
pub use error::StudyError;
pub use ida::*;
pub use merge::{MergeReport, merge};
pub use pounding_results::study::{
    Coordinate, Description, MergeOptions, Part, ResultReader, StudyFileError, Survey, ranges,
    survey,
};
pub use runs::{Axis, Ending, Layout, Place, Quantity, RecordReport, Row};
pub use shown::case_of_run;
pub use study_file::{
    DemandKind, HazardCurve, IdaSettings, IntensityMeasure, Limit, Spacing, Study, Value, Values,
    Variable, hazard_schema, study_schema,
};
pub use sweep::{Progress, Shard, SweepOptions, SweepReport, parts_folder, sweep, writable};
pub use table::RunTable;
