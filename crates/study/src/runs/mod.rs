//! Runs of a study: from a number to a row of results.

mod cache;
mod engine;
mod motion;
mod motion_set;
mod named_files;
mod proportion;
mod runner;
mod shared_records;
mod structures;
mod varied;

pub(crate) use engine::run_all;
pub(crate) use motion::motion;
pub use motion_set::RecordReport;
pub use pounding_results::study::{
    Axis, Ending, IsolatedQuantities, IsolatedRun, Layout, Place, Quantity, RESPONSES, Response,
    Row,
};
pub(crate) use pounding_results::study::{COLUMN_SHEAR, LEVEL_QUANTITIES, OPENING};
pub(crate) use pounding_results::study::{ID, is_result};
pub(crate) use proportion::{
    FurtherFactors, factors_of_further, further_motions, intensity_of_case,
};
pub(crate) use runner::{Runner, factor, wanted};
pub use shared_records::FOLDER as RECORDS_FOLDER;
