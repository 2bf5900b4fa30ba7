//! Where a record came from and how it was understood.

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

use crate::direction::Orientation;
use crate::error::bound;
use crate::start_times::later;

/// What the agency did to a series before it published it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum Processing {
    /// The file does not say.
    #[default]
    Unstated,
    /// Nothing: an offset of the instrument remains.
    Raw,
    /// Baseline or filter corrections.
    Corrected,
}

/// Where a record came from and how it was understood.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Origin {
    /// File name as given.
    pub file: String,
    /// Name of the format.
    pub format: Cow<'static, str>,
    /// Header text that names event, station or component.
    pub title: String,
    /// Component as the file names it; empty if it does not.
    pub component: String,
    /// Unit of the values in the file, and who stated it.
    pub unit: String,
    /// One such unit in SI, of counts the unit that they stand for; `None` without a file.
    pub unit_in_si: Option<f64>,
    /// Time step (s) and who stated it.
    pub time_step: String,
    /// Number of samples in the header, if it has one.
    pub header_count: Option<usize>,
    /// What the agency did to it.
    pub processing: Processing,
    /// Whether the mean was taken off when it was read.
    pub mean_removed: bool,
    /// Time of the first sample as printed, with its zone; empty if not stated.
    pub start_time: String,
    /// Time of the first sample (s) in a column of times, from whatever they count; `None` where
    /// there is no such column.
    pub first_time: Option<f64>,
    /// Where its positive values point, where header or metadata say it in degrees.
    pub orientation: Option<Orientation>,
    /// Corner frequency (Hz) of the low-cut filter.
    pub low_corner: Option<f64>,
    /// Corner frequency (Hz) of the high-cut filter.
    pub high_corner: Option<f64>,
    /// What the file says was done to the series before, a line each.
    pub history: Vec<String>,
    /// SHA-256 of the file's bytes, hexadecimal; where another file gave the sensitivity, of
    /// these bytes and the hexadecimal SHA-256 of the other file after them.
    pub sha256: String,
    /// The file that gave the sensitivity.
    pub response: Option<ResponseFile>,
    /// Line of the header that names its column, from 1, if it is one of several columns.
    pub header_line: Option<usize>,
    /// What the user should know.
    pub warnings: Vec<String>,
}

impl Origin {
    /// Moves the time of the first sample by so much (s).
    pub(crate) fn start_later(&mut self, by: f64) {
        if let Some(first) = &mut self.first_time {
            *first += by;
        }
        if by == 0.0 || self.start_time.is_empty() {
            return;
        }
        match later(&self.start_time, by) {
            Some(moved) => self.start_time = moved,
            None => {
                self.warnings.push(format!(
                    "the first sample is now {} s {}, and \"{}\", the time of the one before, is left out: it is not a date and time of day that can be moved",
                    bound(by.abs()),
                    if by > 0.0 { "later" } else { "earlier" },
                    self.start_time
                ));
                self.start_time.clear();
            }
        }
    }
}

/// A file that gives the sensitivity of a record.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ResponseFile {
    /// Its path as given, or as found beside the record.
    pub file: String,
    /// SHA-256 of its bytes, hexadecimal.
    pub sha256: String,
}
