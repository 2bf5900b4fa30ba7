//! What the user says about a record.

use std::path::PathBuf;

use serde::Deserialize;

use crate::format::Format;
use crate::quantity::Quantity;
use crate::unit::AccelerationUnit;

/// What becomes of the mean of a series that is used as excitation. By itself, raw series
/// lose it, for it is the instrument's offset, and corrected ones keep it; the record's
/// warnings say how much was taken off.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "snake_case", expecting = "a text in quotes")]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub enum Offset {
    /// Taken off raw records, kept in corrected ones.
    #[default]
    Automatic,
    /// Kept.
    Keep,
    /// Taken off.
    Remove,
}

/// What the user says about a record.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ReadOptions {
    /// Format; `None`: found from the content.
    pub format: Option<&'static Format>,
    /// Time step (s), for files that do not state it. Uneven series are resampled
    /// to it.
    pub time_step: Option<f64>,
    /// Unit, for files that do not state it.
    pub unit: Option<AccelerationUnit>,
    /// Layout of plain columns: `"a"` (values along the rows), column names such
    /// as `"t,ns,ew,v"` or `"t,a,v,d"` (`-` is a column to pass over), or a Fortran
    /// format such as `"8F10.5"`. `None`: found from the content.
    pub layout: Option<String>,
    /// Component to use: its name in the file, its azimuth, or its channel number.
    pub component: Option<String>,
    /// Quantity to use; `None`: acceleration.
    pub quantity: Option<Quantity>,
    /// Lines to skip at the start of plain columns.
    pub skip_lines: usize,
    /// Characters to skip at the start of each line of plain columns.
    pub skip_columns: usize,
    /// Puts a zero before the first value, which is then at one time step.
    pub prepend_zero: bool,
    /// Accepts fewer samples than the header says, with a warning.
    pub lenient: bool,
    /// Counts per m/s2, the sensitivity of the whole channel, for records in counts.
    pub sensitivity: Option<f64>,
    /// StationXML that gives the sensitivities of a miniSEED record; `None`: one that lies
    /// beside the record, if there is one.
    pub response: Option<PathBuf>,
    /// The g (m/s2) in units of gravity; `None`: 9.80665.
    pub gravity: Option<f64>,
    /// What becomes of the mean.
    pub offset: Offset,
}
