//! The HDF5 file of a study or of a shard of one, netCDF-4 style: dimensions `run`, `storey` and
//! `level`, a coordinate for every variable. The layout is in `docs/reference/studies.md`.

mod datasets;
mod error;
mod layout;
mod reading;
mod row;
mod shards;
mod writing;

pub use crate::part::{MOST_SHARDS, Part, numbers, ranges};
pub use error::StudyFileError;
pub use layout::{
    Axis, COLUMN_SHEAR, ISOLATED_DEMAND, IsolatedQuantities, IsolatedRun, LEVEL_QUANTITIES, Layout,
    LevelQuantity, OPENING, Place, Quantity, RESPONSES, Response, is_result, isolated_peaks,
    quantity_names,
};
pub use reading::ResultReader;
pub use row::{Ending, ID, Row, Value};
pub use shards::{Fault, MergeOptions, Shards, Survey, survey};
pub use writing::ResultWriter;

/// A coordinate of the runs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Coordinate {
    /// Name of its dataset.
    pub name: String,
    /// What it is.
    pub long_name: String,
    /// Unit of its numbers; empty if there is none or it is a choice.
    pub unit: String,
    /// Names of its choices; `None` if it holds numbers.
    pub choices: Option<Vec<String>>,
}

/// All that a result says beside its rows.
#[derive(Debug, Clone, PartialEq)]
pub struct Description {
    /// Title of the study.
    pub title: String,
    /// Identity of the study.
    pub study_sha256: String,
    /// The study's text.
    pub study: String,
    /// The text of its case.
    pub case: String,
    /// SHA-256 of each record, a line each with its name.
    pub records: String,
    /// Version of the program.
    pub version: String,
    /// What the program was built of and for, see `BUILD` of the crate that makes the runs; a line for each build if
    /// a merged result has several. Empty in files of versions that did not record it.
    pub build: String,
    /// Number of runs of the whole study.
    pub runs: usize,
    /// Runs that are stored at once.
    pub chunk: usize,
    /// Which shards of the study it holds.
    pub part: Part,
    /// What the user should know of the case.
    pub warnings: Vec<String>,
    /// Names of the quantities that are stored, if the study chooses some; the columns are those.
    pub quantities: Option<Vec<String>>,
    /// Whether quantities are stored as numbers of 32 bits.
    pub float32: bool,
    /// Columns.
    pub layout: Layout,
    /// Variables of the study.
    pub coordinates: Vec<Coordinate>,
}
