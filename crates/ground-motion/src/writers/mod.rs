//! Writers of records, one layout per file. Each gives the text of a whole file; what
//! it says is read back by the reader of the same name.

pub(crate) mod peer_at2;
mod plain_columns;
pub(crate) mod pounding_csv;

use crate::accelerogram::Accelerogram;
use crate::direction::Orientation;
use crate::error::GroundMotionError;
use crate::number::MISSING;
use crate::origin::Processing;
use crate::quantity::Quantity;
use crate::recording::{Sampling, Series};
use crate::unit::AccelerationUnit;

pub use peer_at2::write_peer_at2;
pub use plain_columns::{Column, write_plain_columns};
pub use pounding_csv::write_pounding_csv;

/// A series at even steps, as a file holds it.
#[derive(Debug, Clone, PartialEq)]
pub struct Written {
    /// What it records.
    pub quantity: Quantity,
    /// Values (m/s2, m/s or m).
    pub samples: Vec<f64>,
    /// Time step (s).
    pub time_step: f64,
    /// Event, station and component, for the header.
    pub title: String,
    /// Component; empty if not known.
    pub component: String,
    /// Velocity (m/s) and displacement (m) at the first sample of an acceleration, if known.
    pub initial: Option<(f64, f64)>,
    /// Time of the first sample as printed; empty if not known.
    pub start_time: String,
    /// Time of the first sample (s) in the column of times that a processed record was read with:
    /// what was cut off before it is known by it. Times of what is written count from zero.
    pub first_time: Option<f64>,
    /// Where its positive values point, if known in degrees.
    pub orientation: Option<Orientation>,
    /// What the agency did to it, if nothing was done to it since.
    pub processing: Processing,
    /// What else the header says: source, steps of processing.
    pub remarks: Vec<String>,
}

impl Written {
    /// An accelerogram with its source and what was done to it.
    #[must_use]
    pub fn of(record: &Accelerogram) -> Self {
        let mut remarks = Vec::new();
        let origin = record.origin();
        if let Some(o) = origin {
            remarks.extend(o.history.iter().cloned());
            remarks.push(source(&o.file, &o.format, &o.sha256));
            remarks.push(format!("Read: unit {}, time step {}", o.unit, o.time_step));
            remarks.extend(o.warnings.iter().map(|w| format!("Note: {w}")));
        }
        remarks.extend(record.steps().iter().map(|s| format!("Step: {s}")));
        let as_read = origin.filter(|o| record.steps().is_empty() && !o.mean_removed);
        Self {
            quantity: Quantity::Acceleration,
            samples: record.samples().to_vec(),
            time_step: record.time_step(),
            title: origin.map_or(String::new(), |o| o.title.clone()),
            component: origin.map_or(String::new(), |o| o.component.clone()),
            initial: record.initial(),
            orientation: origin.and_then(|o| o.orientation),
            start_time: origin.map_or(String::new(), |o| o.start_time.clone()),
            first_time: origin.and_then(|o| o.first_time),
            processing: as_read.map_or(Processing::Unstated, |o| o.processing),
            remarks,
        }
    }

    /// A series of a file with its source.
    ///
    /// # Errors
    /// Samples at uneven times: resample them first.
    pub fn of_series(series: &Series) -> Result<Self, GroundMotionError> {
        let origin = &series.origin;
        let time_step = match &series.sampling {
            Sampling::Even { time_step } => *time_step,
            Sampling::Uneven { .. } => {
                return Err(GroundMotionError::NotPossible {
                    step: "writing",
                    reason: format!("{} is at uneven times", series.label()),
                    remedy: "give `time_step`, to have an acceleration resampled to even steps",
                });
            }
        };
        Ok(Self {
            quantity: series.quantity,
            samples: series.samples.clone(),
            time_step,
            title: origin.title.clone(),
            component: series.component.clone(),
            initial: series.initial,
            orientation: origin.orientation,
            start_time: origin.start_time.clone(),
            first_time: None,
            processing: origin.processing,
            remarks: origin
                .history
                .iter()
                .cloned()
                .chain([source(&origin.file, &origin.format, &origin.sha256)])
                .collect(),
        })
    }
}

fn source(file: &str, format: &str, sha256: &str) -> String {
    // The folder is that of one machine; the digest finds the file anywhere.
    let name = file.rsplit(['/', '\\']).next().unwrap_or(file);
    format!("Source: {name} ({format}), SHA-256 {sha256}")
}

/// A text on one line.
fn line(text: &str) -> String {
    text.chars()
        .map(|c| if c.is_control() { ' ' } else { c })
        .collect()
}

/// The shortest digits that give the value back, without long rows of zeros.
fn number(value: f64) -> String {
    if value != 0.0 && !(1.0e-4..1.0e16).contains(&value.abs()) {
        format!("{value:e}")
    } else {
        format!("{value}")
    }
}

/// Time of a sample, without the noise of the multiplication: to 1e-9 s, and to a thousandth of a step below 1e-6 s. A
/// time too long for so many digits in a number is as it is.
fn time(index: usize, step: f64) -> f64 {
    let mut digits = 1.0e9;
    while step * digits < 1.0e3 {
        digits *= 10.0;
    }
    let time = index as f64 * step;
    match time * digits < 1.0e15 {
        true => (time * digits).round() / digits,
        false => time,
    }
}

/// Only an acceleration has these units.
fn acceleration_only(series: &Written, layout: &'static str) -> Result<(), GroundMotionError> {
    if series.quantity == Quantity::Acceleration {
        return Ok(());
    }
    Err(GroundMotionError::NotPossible {
        step: layout,
        reason: format!("the series is a {}, not an acceleration", series.quantity),
        remedy: "write peer_at2 or plain_columns, which hold velocities and displacements too",
    })
}

/// Refuses numbers that no reader takes for one, this program's own included.
fn readable(series: &Written) -> Result<(), GroundMotionError> {
    let largest = series.samples.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    if largest <= MISSING {
        return Ok(());
    }
    Err(GroundMotionError::NotPossible {
        step: "writing",
        reason: format!("a sample of {largest:e} stands for a missing value in files of records"),
        remedy: "correct the scale, or the unit of the record",
    })
}

/// The unit that a file shall have, in SI, and its symbol.
fn unit_of(quantity: Quantity, unit: Option<AccelerationUnit>) -> (f64, &'static str) {
    match (quantity, unit) {
        (Quantity::Acceleration, Some(unit)) => (unit.in_si(), unit.symbol()),
        (quantity, _) => (1.0, quantity.si_symbol()),
    }
}

/// A value (SI) in a unit of so much in SI: of fifteen digits if these read back as the same value, as those of a
/// file in that unit do, so that they are written as they stood there.
fn in_unit(value: f64, unit: f64) -> f64 {
    let exact = value / unit;
    let short: Option<f64> = format!("{exact:.14e}").parse().ok();
    short.filter(|x| x * unit == value).unwrap_or(exact)
}
