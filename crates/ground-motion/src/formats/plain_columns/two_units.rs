//! Lines before the rows that state two units of one quantity: `Acc[g] (original record in cm/s2)`.

use super::header::{self, Cells, Role, role};
use super::names::{motion_unit, unquoted};
use super::{before, is_history};
use crate::error::GroundMotionError;
use crate::header_keys::{Entry, keyed};
use crate::quantity::{Quantity, SeriesUnit};
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

/// Whether a name has two units of acceleration.
pub(super) fn has_two(name: &str) -> bool {
    of_name(name, "").is_some()
}

/// Two units of acceleration in one name: beside it, and in brackets behind that.
fn of_name(name: &str, word_before: &str) -> Option<[SeriesUnit; 2]> {
    let name = unquoted(name);
    let accelerates = |unit: &SeriesUnit| unit.quantity == Quantity::Acceleration;
    let (own, mut rest) = name.split_at(name.find(['(', '['])?);
    // `Acc in g (..)` between blanks: the unit is a word of its own.
    let of_word = || motion_unit(own).filter(|_| word_before.eq_ignore_ascii_case("in"));
    let of_own = match role(own.trim()) {
        Some(Role::Acceleration(_, unit)) => unit,
        _ => of_word(),
    };
    let mut first = of_own.filter(accelerates);
    while let Some(opened) = rest.find(['(', '[']) {
        let inside = &rest[opened + 1..];
        // Units may have brackets of their own: `(cm/(s s))`.
        let ends = || inside.match_indices([')', ']']).map(|(end, _)| end);
        let unit_to = |end: usize| {
            let text = &inside[..end];
            let behind_in = || text.rsplit_once(" in ").and_then(|(_, u)| motion_unit(u));
            Some((
                motion_unit(text).or_else(behind_in).filter(accelerates)?,
                end,
            ))
        };
        let end = match ends().find_map(unit_to) {
            Some((unit, end)) => {
                match first {
                    Some(first) if first != unit => return Some([first, unit]),
                    _ => first = Some(unit),
                }
                end
            }
            None => ends().next().unwrap_or(inside.len()),
        };
        rest = &inside[end..];
    }
    None
}

/// Whether the name before the brackets has a unit of acceleration of its own, and another one stands in them:
/// `acc_g (gal)`.
pub(super) fn has_another_unit(before: &str, in_brackets: SeriesUnit) -> bool {
    let own = match role(before.trim()) {
        Some(Role::Acceleration(_, unit)) => unit,
        _ => None,
    };
    own.is_some_and(|own| own != in_brackets)
}
