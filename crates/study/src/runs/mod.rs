//! Runs of a study: from a number to a row of results.

mod cache;
mod columns;
mod engine;
mod motions;
mod runner;

pub(crate) use columns::is_result;
pub use columns::{Axis, Layout, Place, Quantity};
pub(crate) use engine::run_all;
pub use motions::RecordReport;
pub(crate) use motions::motion;
pub use runner::{Ending, Row};
pub(crate) use runner::{Runner, chosen, factor, wanted, written};
