//! Entries of the case that a variable changes.

use std::ops::Range;
use std::sync::Arc;

use pounding_case::document::Reader;

use super::values::short;
use crate::case_text::{Edit, Entry, Found, Lost, LostAmong, Path, entries, numbers, written};

/// An entry of the case that a variable changes.
#[derive(Debug, Clone)]
pub(crate) struct VariedEntry {
    pub path: Path,
    pub entry: Arc<Entry>,
    /// Its number (SI) in the case, if the values of the variable are multiples of it.
    pub of_case: Option<f64>,
}

impl VariedEntry {
    /// The number (SI) that it has with a value of the variable: 0.9 times 20 mm is 0.018, as it is written.
    pub(crate) fn number(&self, value: f64) -> f64 {
        self.of_case
            .map_or(value, |of_case| short(value * of_case, 0.0))
    }
}

/// Edits that give all entries their number with a value of the variable.
pub(super) fn set_numbers(entries: &[VariedEntry], value: f64) -> Vec<Edit> {
    let edit = |varied: &VariedEntry| Edit::new(&varied.entry, written(varied.number(value)));
    entries.iter().map(edit).collect()
}

/// Edits that give all entries this value, as TOML.
pub(super) fn set_all(entries: &[VariedEntry], value: &str) -> Vec<Edit> {
    let edits = entries.iter().map(|varied| Edit::new(&varied.entry, value));
    edits.collect()
}

/// The entries that paths lead to, each of which stands at its place in the study; none of them
/// twice. Multiples are of numbers.
pub(super) fn varied_entries(
    reader: &Reader<'_>,
    case: &str,
    paths: &[(Path, Range<usize>)],
    relative: bool,
) -> Option<Vec<VariedEntry>> {
    let (only, places): (Vec<Path>, Vec<&Range<usize>>) = paths
        .iter()
        .map(|(path, place)| (path.clone(), place))
        .unzip();
    let found = match found(case, &only, relative) {
        Ok(found) => found,
        Err((path, (message, help))) => {
            return reader.refuse(places[path].clone(), message, help);
        }
    };
    let mut all: Vec<VariedEntry> = Vec::new();
    for (found, place) in found.into_iter().zip(places) {
        for varied in found {
            if all.iter().any(|other| other.entry.overlaps(&varied.entry)) {
                let message = format!("`path` leads to `{}` more than once", varied.path);
                return reader.refuse(place.clone(), message, "name each entry once");
            }
            all.push(varied);
        }
    }
    Some(all)
}

/// The entries that each path leads to.
fn found(case: &str, paths: &[Path], relative: bool) -> Result<Vec<Vec<VariedEntry>>, LostAmong> {
    let varied = |(path, entry), of_case| VariedEntry {
        path,
        entry,
        of_case,
    };
    Ok(match relative {
        true => {
            let multiples = |of: Vec<(Found, f64)>| {
                let numbers = of.into_iter();
                numbers.map(|(found, x)| varied(found, Some(x))).collect()
            };
            numbers(case, paths)?.into_iter().map(multiples).collect()
        }
        false => {
            let plain = |of: Vec<Found>| {
                let entries = of.into_iter();
                entries.map(|found| varied(found, None)).collect()
            };
            entries(case, paths)?.into_iter().map(plain).collect()
        }
    })
}

/// The value, or what is wrong with it at this place.
pub(super) fn kept<T>(
    reader: &Reader<'_>,
    place: &Range<usize>,
    value: Result<T, Lost>,
) -> Option<T> {
    match value {
        Ok(value) => Some(value),
        Err((message, help)) => reader.refuse(place.clone(), message, help),
    }
}
