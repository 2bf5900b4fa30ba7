//! PEER AT2, VT2 and DT2.

use std::fmt::Write as _;

use crate::origin::Processing;
use crate::quantity::Quantity;
use crate::unit::AccelerationUnit;
use crate::writers::{Written, line};

/// First lines, of raw records, of those of which the stage of processing is not known, and of others.
pub(crate) const RAW: &str = "RAW MOTION WRITTEN BY POUNDING IN THE LAYOUT OF PEER AT2";
pub(crate) const UNSTATED: &str =
    "MOTION OF UNKNOWN PROCESSING WRITTEN BY POUNDING IN THE LAYOUT OF PEER AT2";
pub(crate) const OTHER: &str = "MOTION WRITTEN BY POUNDING IN THE LAYOUT OF PEER AT2";
/// Values on a line.
const COLUMNS: usize = 5;

/// The text of an AT2 file (accelerations in g of 9.80665 m/s2), a VT2 file (cm/s) or
/// a DT2 file (cm): four lines of header, five values of eight digits per line. The
/// format has no room for what was done to the motion; the first line says of a raw record that it
/// is one, and of others whether that is known.
#[must_use]
pub fn write_peer_at2(series: &Written) -> String {
    let (words, unit, factor) = match series.quantity {
        Quantity::Acceleration => (
            "ACCELERATION",
            "G",
            1.0 / AccelerationUnit::StandardGravity.in_si(),
        ),
        Quantity::Velocity => ("VELOCITY", "CM/SEC", 100.0),
        Quantity::Displacement => ("DISPLACEMENT", "CM", 100.0),
    };
    let mut text = String::with_capacity(16 * series.samples.len() + 300);
    let _ = match series.processing {
        Processing::Raw => writeln!(text, "{RAW}"),
        Processing::Unstated => writeln!(text, "{UNSTATED}"),
        Processing::Corrected => writeln!(text, "{OTHER}"),
    };
    // The component is what follows the last comma.
    let component = line(&series.component).replace(',', ";");
    let title = format!("{}, {component}", line(&series.title));
    let _ = writeln!(text, "{}", without_keys(&title));
    let _ = writeln!(text, "{words} TIME SERIES IN UNITS OF {unit}");
    let _ = writeln!(
        text,
        "NPTS= {:6}, DT= {} SEC",
        series.samples.len(),
        series.time_step
    );
    for row in series.samples.chunks(COLUMNS) {
        for value in row {
            text.push_str(&exponential(value * factor));
        }
        text.push('\n');
    }
    text
}

/// Words of titles that readers of AT2 take for those of the header, and what says the same.
const KEYS: [(&str, &str); 6] = [
    ("npts", "count"),
    ("points at equal spacing of", "points at even spacing of"),
    ("units", "unit"),
    ("time history", "time-history"),
    ("time series", "time-series"),
    ("=", ": "),
];

/// A title that says nothing of count, step, unit, quantity and peak, which stand in lines of
/// their own.
fn without_keys(title: &str) -> String {
    KEYS.iter().fold(title.to_owned(), |text, (key, other)| {
        let lower = text.to_ascii_lowercase();
        let mut without = String::with_capacity(text.len());
        let mut end = 0;
        for (at, found) in lower.match_indices(key) {
            without.push_str(&text[end..at]);
            without.push_str(other);
            end = at + found.len();
        }
        without + &text[end..]
    })
}

/// Least magnitude whose exponent has two digits: with three, a negative number fills its field and touches the one before.
const SMALLEST: f64 = 1.0e-99;

/// Fortran's `1PE15.7`; what is too small for it is zero, as where it underflows.
fn exponential(value: f64) -> String {
    let value = match value != 0.0 && value.abs() < SMALLEST {
        true => 0.0,
        false => value,
    };
    let text = format!("{value:.7e}");
    let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    let sign = if exponent < 0 { '-' } else { '+' };
    format!("{:>15}", format!("{digits}E{sign}{:02}", exponent.abs()))
}
