//! Plain columns, as most programs read them.

use std::fmt::Write as _;

use crate::unit::AccelerationUnit;
use crate::writers::{Written, in_unit, number, time, unit_of};

/// A column of a plain file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Column {
    /// Times (s).
    Time,
    /// Values.
    Value,
}

/// Plain columns, divided by blanks, one sample per line, without any header: for
/// programs that read nothing but numbers. Accelerations are in `unit` (`None`: m/s2),
/// velocities in m/s, displacements in m, all at full precision. Also returns the symbol
/// of the unit, which the file does not state.
#[must_use]
pub fn write_plain_columns(
    series: &Written,
    columns: &[Column],
    unit: Option<AccelerationUnit>,
) -> (String, &'static str) {
    let (one, symbol) = unit_of(series.quantity, unit);
    let mut text = String::with_capacity(28 * series.samples.len());
    for (i, a) in series.samples.iter().enumerate() {
        for (k, column) in columns.iter().enumerate() {
            let blank = if k == 0 { "" } else { " " };
            let value = match column {
                Column::Time => time(i, series.time_step),
                Column::Value => in_unit(*a, one),
            };
            let _ = write!(text, "{blank}{}", number(value));
        }
        text.push('\n');
    }
    (text, symbol)
}
