//! What the name of one column says of it: `acceleration (m/s2)`, `time_s`, `NS_g`.

use super::names::{
    ACCELERATION, COUNTER, FOREIGN, LONG, TIME, has_factor, is_channel, is_component, is_spectral,
    is_time, motion, motion_unit, plain, time_unit, unquoted,
};
use crate::quantity::{Quantity, SeriesUnit, is_of_no_record};

/// What a column holds.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Role {
    /// Times; one of their unit (s).
    Time(f64),
    /// Accelerations with their name and, if it stands there, their unit.
    Acceleration(String, Option<SeriesUnit>),
    /// Velocities, displacements, row numbers: passed over.
    Other,
}

/// What a cell of a line that names a column of times says.
pub(super) enum Kind {
    /// Understood as it stands.
    Known(Role),
    /// An acceleration by its name, without a unit.
    Component,
    /// Something else than motion.
    Foreign,
    /// A name of which nothing is known.
    Unknown,
}

/// What a cell of a header says; `None`: a unit that is not known, which is an error of its own.
pub(super) fn kind(cell: &str) -> Option<Kind> {
    let cell = unquoted(cell);
    let whole = plain(cell);
    if cell.is_empty() || whole.starts_with("unnamed:") {
        return Some(Kind::Known(Role::Other));
    }
    if is_spectral(cell) {
        return Some(Kind::Foreign);
    }
    if let Some(role) = role(cell) {
        return Some(Kind::Known(role));
    }
    // By how much the values would have to be divided, or in which unit they are, is not known.
    if has_factor(cell) || has_two(cell) {
        return None;
    }
    if is_channel(&whole) {
        return Some(Kind::Component);
    }
    let known = is_quantity;
    if let Some((name, _)) = cell.split_once(['(', '[']) {
        let name = plain(name);
        return (!known(&name) && !is_channel(&name)).then_some(Kind::Foreign);
    }
    let word = |of: &dyn Fn(&str) -> bool| {
        whole
            .split(|c: char| !c.is_alphabetic())
            .filter(|w| !w.is_empty())
            .any(of)
    };
    if word(&|w| FOREIGN.contains(&w)) {
        return Some(Kind::Foreign);
    }
    let first = whole.split([' ', '-']).next().unwrap_or_default();
    if known(first) && whole != first {
        // `acc_furlongs` has a unit, `Acc roof` a name.
        return match cell.contains('_') || !ACCELERATION.contains(&first) {
            true => None,
            false => Some(Kind::Component),
        };
    }
    Some(match is_component(first) {
        true => Kind::Component,
        false => Kind::Unknown,
    })
}

/// The unit of acceleration that the name of a column has in brackets or behind it, also where
/// the name is not understood: `Acc. (cm/s2) filtered`.
pub(super) fn unit_beside(cell: &str) -> Option<SeriesUnit> {
    let cell = unquoted(cell);
    let (name, rest) = cell
        .split_once(['(', '['])
        .or_else(|| cell.split_once('_'))?;
    let known = plain(name);
    let first = known.split([' ', '-', '.']).next().unwrap_or_default();
    if !(ACCELERATION.contains(&first) || is_channel(&known)) {
        return None;
    }
    let (unit, behind) = match rest.find([')', ']']) {
        Some(end) => rest.split_at(end),
        None => (rest.rsplit('_').find(|u| motion_unit(u).is_some())?, ""),
    };
    let counts = name.contains(|c: char| c.is_ascii_digit()) && !is_channel(&known)
        || behind.contains(|c: char| c.is_ascii_digit());
    let unit = motion_unit(unit).filter(|unit| unit.quantity == Quantity::Acceleration)?;
    (!counts).then_some(unit)
}

/// Whether a name in lower case is that of times, accelerations, velocities or displacements.
pub(super) fn is_quantity(known: &str) -> bool {
    TIME.contains(&known) || ACCELERATION.contains(&known) || motion(known).is_some()
}

/// What stands in the brackets of a cell.
pub(super) fn divided_at_brackets(cell: &str) -> Option<String> {
    let (_, rest) = unquoted(cell).split_once(['(', '['])?;
    Some(rest.trim_end_matches([')', ']']).to_owned())
}

/// Name, in lower case, and unit of a cell that has both.
pub(super) fn divided(cell: &str) -> Option<(String, String)> {
    let cell = cell.trim().trim_matches(['"', '\'']).trim();
    if let Some((name, rest)) = cell.split_once(['(', '[']) {
        let unit = without_remark(rest).strip_suffix([')', ']'])?;
        return Some((plain(name.trim_end_matches('/')), unit.trim().to_owned()));
    }
    let (name, unit) = cell
        .split_once(" in ")
        .or_else(|| cell.split_once(['_', ' ', '/']))?;
    let unit = unit.trim();
    let known = plain(name);
    let takes = |names: &[&str]| names.contains(&known.as_str());
    let may = takes(&LONG) || motion(&known).is_some() || is_component(&known);
    (may && !unit.is_empty()).then(|| (known, unit.to_owned()))
}

/// Words of what was done to the values of a column, which say nothing of their unit.
const PROCESSING: [&str; 15] = [
    "and",
    "band",
    "bandpass",
    "base",
    "baseline",
    "corrected",
    "detrended",
    "filtered",
    "line",
    "pass",
    "processed",
    "raw",
    "uncorrected",
    "unfiltered",
    "unprocessed",
];

/// What stands behind the first bracket of a name, without what it says of its sign or its processing:
/// `cm/s2) (+ is upward)`, `g] (baseline corrected)`.
fn without_remark(rest: &str) -> &str {
    const ENDS: [char; 2] = [')', ']'];
    if let Some(end) = rest.find(ENDS)
        && let Some(remark) = rest[end + 1..].trim_start().strip_prefix(['(', '['])
        && let Some(remark) = remark.strip_suffix(ENDS)
    {
        let remark = remark.to_lowercase();
        let mut words = remark.split([' ', '-', ',']).filter(|w| !w.is_empty());
        if !remark.is_empty() && words.all(|word| PROCESSING.contains(&word)) {
            return &rest[..=end];
        }
    }
    let sign = rest.find(") (+").or_else(|| rest.find("] (+"));
    match sign {
        Some(at) if rest.ends_with(')') => &rest[..=at],
        _ => rest,
    }
}

/// What a column of velocities or displacements holds, by its unit or else by its name.
pub(super) fn quantity(cell: &str) -> Option<Quantity> {
    if role(cell) != Some(Role::Other) {
        return None;
    }
    let (known, unit) = divided(cell).unwrap_or_else(|| (plain(cell), String::new()));
    let by_unit = motion_unit(&unit).map(|unit| unit.quantity);
    by_unit.or_else(|| motion(&known))
}

pub(super) fn role(cell: &str) -> Option<Role> {
    let cell = unquoted(cell);
    if is_spectral(cell) {
        return None;
    }
    let named = |name: &str, unit: &str| of_unit(&plain(name), name.trim(), unit);
    // `a/g (-)` is a number.
    let cell = cell
        .strip_suffix("(-)")
        .or(cell.strip_suffix("[-]"))
        .map_or(cell, str::trim_end);
    if let Some((name, rest)) = cell.split_once(['(', '[']) {
        let unit = without_remark(rest).strip_suffix([')', ']'])?;
        if motion_unit(unit).is_some_and(|unit| has_another_unit(name, unit)) {
            return None;
        }
        // `a/(m/s2)`, as standards on quantities write.
        return named(name.trim_end_matches('/'), unit);
    }
    let whole = plain(cell);
    if is_time(&whole) {
        return Some(Role::Time(1.0));
    }
    if ACCELERATION.contains(&whole.as_str()) {
        return Some(Role::Acceleration(cell.to_owned(), None));
    }
    if motion(&whole).is_some() || COUNTER.contains(&whole.as_str()) {
        return Some(Role::Other);
    }
    if let Some((name, unit)) = cell.split_once(" in ") {
        return named(name, unit);
    }
    // `Time - s`, `Acceleration, g` in one cell.
    let apart = cell.rsplit_once(" - ").or_else(|| cell.rsplit_once(','));
    if let Some(found) = apart.and_then(|(name, unit)| {
        let named_so = is_quantity(&plain(name));
        named(name, unit.trim()).filter(|_| named_so)
    }) {
        return Some(found);
    }
    cell.match_indices(['_', ' ', '/'])
        .find_map(|(at, divider)| {
            let (name, unit) = (&cell[..at], &cell[at + 1..]);
            let known = plain(name);
            let takes = |names: &[&str]| names.contains(&known.as_str());
            let may = takes(&LONG)
                || motion(&known).is_some()
                || is_component(&known)
                || divider == "/" && takes(&ACCELERATION);
            if may { named(name, unit) } else { None }
        })
}

/// A name with its unit: both must mean the same quantity.
fn of_unit(known: &str, name: &str, unit: &str) -> Option<Role> {
    if is_time(known) {
        return time_unit(unit).map(Role::Time);
    }
    let unit = motion_unit(unit)?;
    let accelerates = unit.quantity == Quantity::Acceleration;
    if ACCELERATION.contains(&known) {
        return accelerates.then(|| Role::Acceleration(name.to_owned(), Some(unit)));
    }
    if motion(known).is_some() {
        // `d (g)` is no displacement, `v (g)` may be the vertical component.
        return match accelerates {
            true if known == "v" => Some(Role::Acceleration(name.to_owned(), Some(unit))),
            true => None,
            false => Some(Role::Other),
        };
    }
    // A component or channel by its own name.
    match accelerates {
        true if has_factor(name) => None,
        true if known.split(' ').any(is_of_no_record) => None,
        true => Some(Role::Acceleration(name.to_owned(), Some(unit))),
        false => Some(Role::Other),
    }
}

/// Whether a name has two units of acceleration.
fn has_two(name: &str) -> bool {
    of_name(name, "").is_some()
}

/// Two units of acceleration in one name: beside it, and in brackets behind that.
pub(super) fn of_name(name: &str, word_before: &str) -> Option<[SeriesUnit; 2]> {
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
fn has_another_unit(before: &str, in_brackets: SeriesUnit) -> bool {
    let own = match role(before.trim()) {
        Some(Role::Acceleration(_, unit)) => unit,
        _ => None,
    };
    own.is_some_and(|own| own != in_brackets)
}
