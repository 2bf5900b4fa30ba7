//! Lines before the rows that state two units of one quantity: `Acc[g] (original record in cm/s2)`.

use super::column_name::of_name;
use super::header::{self, Cells};
use super::names::unquoted;
use super::{before, is_history};
use crate::error::GroundMotionError;
use crate::header_keys::{Entry, keyed};
use crate::quantity::SeriesUnit;
use crate::source::Source;

/// The lines, from 1, that state two units of which the user says which one is right: what they state of the unit is
/// passed over.
///
/// # Errors
/// Two units of which nobody says which one the values have.
pub(super) fn decided(source: &Source<'_>) -> Result<Vec<usize>, GroundMotionError> {
    let mut decided = Vec::new();
    for cells in header::name_lines(before(source)) {
        let lower = cells.text.to_lowercase();
        let Some((name, units)) = of_line(&cells).filter(|_| !is_history(&lower)) else {
            continue;
        };
        let given = source.options.unit;
        if given.is_some_and(|given| units.iter().any(|unit| unit.is(given))) {
            decided.push(cells.line);
            continue;
        }
        let [first, second] = units.map(|unit| unit.symbol);
        return Err(source.error(
            cells.line,
            0,
            format!("two units, {first} and {second}, stand beside one quantity: \"{name}\""),
            "say which one the values have by `unit` in [ground_motion] of a case, `--unit` with `pounding motion`; or correct the line so that it states that unit alone",
        ));
    }
    Ok(decided)
}

/// The first name of a line with two units of acceleration, and these.
fn of_line(cells: &Cells) -> Option<(String, [SeriesUnit; 2])> {
    let has_value = |text: &str| keyed(&text.to_lowercase()).iter().any(Entry::has_number);
    // `PGA [g] (cm/s2): 0.3 (294)` states no unit of the values.
    if cells.separator.is_none() && has_value(&cells.text) {
        return None;
    }
    let mut before = "";
    for name in &cells.names {
        if let Some(units) = of_name(name, before).filter(|_| !has_value(name)) {
            return Some((unquoted(name).to_owned(), units));
        }
        before = name;
    }
    None
}
