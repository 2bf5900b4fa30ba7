//! The unit of the values that a line before the rows states: `# unit: g`, `Units = cm/s2`, `Acceleration (gal)`.

use super::names;
use crate::header_keys::{self, Entry, keyed, unit_words};
use crate::quantity::{Multiple, Quantity, SeriesUnit, named_with_unit, of_something_else};

/// Words behind a key of units that name none.
const NO_UNIT: [&str; 12] = [
    "si", "metric", "english", "imperial", "cgs", "mks", "us", "none", "unknown", "n/a", "-",
    "standard",
];

/// A unit that a line states.
pub(super) enum Unit {
    None,
    Known(SeriesUnit),
    Unknown(String),
}

/// The unit that a line in lower case states: under a key, `# unit: g`, `units = cm/s2`,
/// `acceleration units: gal`; alone on the line; or behind the name of the quantity at the end.
pub(super) fn unit_of(lower: &str) -> Unit {
    let bare = lower
        .trim_start_matches(['#', '%', '!', '*', '/', ' ', '\t'])
        .trim();
    let alone = bare
        .strip_prefix(['(', '['])
        .and_then(|u| u.strip_suffix([')', ']']))
        .unwrap_or(bare);
    if let Some(unit) = names::motion_unit(alone).filter(|_| alone.len() > 1 || alone == "g") {
        return Unit::Known(unit);
    }
    if let Some(unit) = beside_seconds(bare) {
        return Unit::Known(unit);
    }
    let within = [
        "in units of ",
        "in ",
        "values in ",
        "data in ",
        "amplitudes in ",
        "samples in ",
    ];
    let behind = within.iter().find_map(|start| bare.strip_prefix(start));
    if let Some(unit) = behind.and_then(|unit| names::motion_unit(unit.trim_end_matches('.'))) {
        return Unit::Known(unit);
    }
    if let Some(stated) = header_keys::unit_in_words(lower) {
        // A word that is no unit, as in `values in ASCII`, is of something else; `data in N` may be of a direction.
        match value_of(stated) {
            Unit::Unknown(text) if !is_like_a_unit(&text) || text == "n" => {}
            Unit::None => {}
            stated => return stated,
        }
    }
    for entry in keyed(lower).iter().filter(|entry| unit_words(entry.key)) {
        // Other keys may follow on the line.
        let end = match entry.value.contains([':', '=']) {
            true => entry
                .value
                .find([',', ';', '\t', '|'])
                .or(entry.value.find(' ')),
            false => None,
        };
        let value = &entry.value[..end.unwrap_or(entry.value.len())];
        // `units: s, g; dt: 0.01` begins with that of the times.
        if end.is_some() && names::time_unit(value).is_some() {
            continue;
        }
        match value_of(value) {
            Unit::None => {}
            stated => return stated,
        }
    }
    if let Some(unit) = lower.split([',', ';', '|']).find_map(behind_word_of_unit) {
        return Unit::Known(unit);
    }
    if let Some(unit) = in_at_the_end(bare) {
        return Unit::Known(unit);
    }
    let by_name = named_with_unit(lower).filter(|found| {
        let rest = found.rest.trim_matches([' ', '\t', '.', ',', ';']);
        let rest = rest.strip_prefix("and ").unwrap_or(rest);
        // `acceleration (g) vs time`.
        if ["vs time", "vs. time", "versus time"].contains(&rest) {
            return true;
        }
        // `(cm/s/s) (+ is upward)`.
        let sign = rest.strip_suffix(')').and_then(|r| r.strip_prefix("(+"));
        if sign.is_some_and(|sign| !sign.contains(['(', '*', '/'])) {
            return true;
        }
        let key = rest.trim_start_matches(|c: char| c.is_ascii_alphabetic());
        rest.is_empty() || key.len() < rest.len() && key.trim_start().starts_with('=')
    });
    match by_name {
        // What names another quantity was refused before.
        Some(found)
            if found.quantity == Quantity::Acceleration
                && found.unit.quantity == Quantity::Acceleration =>
        {
            Unit::Known(found.unit)
        }
        _ => Unit::None,
    }
}

/// Whether what is no known unit of acceleration is a unit all the same: one of something else, or with a factor.
fn is_like_a_unit(text: &str) -> bool {
    names::is_foreign_unit(text) || Multiple::parse(text).is_some()
}

/// Whether a line states the unit of the values under a key, `Units: cm/s2 (gal)`.
pub(super) fn has_unit(text: &str) -> bool {
    let lower = text.to_lowercase();
    let stated = |entry: &Entry<'_>| {
        unit_words(entry.key) && matches!(value_of(entry.value), Unit::Known(_))
    };
    keyed(&lower).iter().any(stated)
}

/// The unit of accelerations in a line of units alone, of which one is that of times: `s g`,
/// `(sec),(cm/s2),(cm/s2)`.
fn beside_seconds(bare: &str) -> Option<SeriesUnit> {
    let units: Vec<String> = bare
        .split([' ', '\t', ',', ';'])
        .filter(|unit| !unit.is_empty())
        .map(names::bare_unit)
        .collect();
    let (times, motions): (Vec<&String>, Vec<&String>) = units
        .iter()
        .partition(|unit| names::time_unit(unit).is_some());
    let known: Option<Vec<SeriesUnit>> = motions.iter().map(|u| names::motion_unit(u)).collect();
    let mut known = known?.into_iter();
    let accelerates = |unit: &SeriesUnit| unit.quantity == Quantity::Acceleration;
    let first = known
        .next()
        .filter(|unit| accelerates(unit) && times.len() == 1)?;
    known.all(|unit| unit == first).then_some(first)
}

/// The unit behind a word for it without a colon: `units g`, `unit of cm/s2`.
fn behind_word_of_unit(part: &str) -> Option<SeriesUnit> {
    let bare = part.trim_matches(|c: char| "#%!*/ \t".contains(c));
    let (key, unit) = bare.split_once([' ', '\t'])?;
    let unit = unit.trim();
    let unit = unit.strip_prefix("of ").unwrap_or(unit);
    unit_words(key).then(|| names::motion_unit(&names::bare_unit(unit)))?
}

/// The unit that ends a line on accelerations alone, without a number: `acceleration time history in g`,
/// `acceleration data (cm/sec^2)`.
fn in_at_the_end(bare: &str) -> Option<SeriesUnit> {
    let bare = bare.trim_end_matches('.');
    let in_brackets = || {
        let (words, unit) = bare.strip_suffix([')', ']'])?.rsplit_once(['(', '['])?;
        Some((words, unit))
    };
    let (words, unit) = bare.rsplit_once(" in ").or_else(in_brackets)?;
    let unit = names::motion_unit(unit.strip_prefix("units of ").unwrap_or(unit))?;
    let is = |of: &dyn Fn(&str) -> bool| words.split(|c: char| !c.is_alphabetic()).any(of);
    let accelerates = is(&|word| word.starts_with("accel") || word == "acc");
    let other =
        is(&|word| word.starts_with("vel") || word.starts_with("disp") || of_something_else(word))
            || words.contains(|c: char| c.is_ascii_digit());
    (accelerates && !other).then_some(unit)
}

/// A unit that another spelling of it may follow in brackets: `cm/s2 (gal)`, `g (9.81 m/s2)`; a factor of one
/// may stand before it.
fn spelled_twice(value: &str) -> Option<SeriesUnit> {
    let value = value.strip_prefix("1 ").unwrap_or(value);
    for words in [
        "fraction of ",
        "fractions of ",
        "units of ",
        "multiples of ",
    ] {
        if let Some(unit) = value.strip_prefix(words) {
            return names::motion_unit(unit);
        }
    }
    let Some((unit, inside)) = value.split_once('(') else {
        return names::motion_unit(value);
    };
    let unit = names::motion_unit(unit.trim())?;
    let inside = inside
        .strip_suffix(')')?
        .trim()
        .trim_start_matches(['1', '=', ' ']);
    let digits = inside.trim_start_matches(|c: char| c.is_ascii_digit() || c == '.');
    let other = names::motion_unit(digits.trim())?;
    let printed = inside[..inside.len() - digits.len()].parse();
    let one = match inside.len() == digits.len() {
        true => 1.0,
        false => printed.ok()?,
    };
    let same = |a: f64, b: f64| (a / b - 1.0).abs() < 0.002;
    let gravity = pounding_catalogue::STANDARD_GRAVITY;
    same(unit.in_si(gravity), one * other.in_si(gravity)).then_some(unit)
}

/// The unit behind a key; units of the times may stand beside it.
fn value_of(value: &str) -> Unit {
    let value = value.trim().trim_end_matches(['.', ';', ',']);
    let quoted = value.trim_matches(['"', '\'', '<', '>']).trim();
    // The bracket of the whole line.
    let value = [('(', ')'), ('[', ']'), ('{', '}')]
        .iter()
        .filter(|(opening, _)| !quoted.contains(*opening))
        .fold(quoted, |value, (_, closing)| {
            value.trim_end_matches(*closing)
        });
    if let Some(unit) = names::motion_unit(value).or_else(|| spelled_twice(value)) {
        return Unit::Known(unit);
    }
    if let Some(multiple) = Multiple::parse(value) {
        let unknown = || Unit::Unknown(value.to_owned());
        return multiple.unit.map_or_else(unknown, Unit::Known);
    }
    let joined = value.replace(' ', "");
    let word = value.split_whitespace().count() <= 1;
    let of_gravity = joined.ends_with('g') && joined.contains(|c: char| c.is_ascii_digit());
    if value.is_empty() || NO_UNIT.contains(&value) || value.contains([',', ';']) {
        return Unit::None;
    }
    if word || of_gravity || names::is_foreign_unit(value) {
        return Unit::Unknown(value.to_owned());
    }
    Unit::None
}
