//! All provisions by name.

use crate::descriptor::{ProvisionDescriptor, Unavailable};
use crate::error::SeparationError;
use crate::provisions;

/// Cards of all provisions.
#[must_use]
pub fn descriptors() -> &'static [&'static ProvisionDescriptor] {
    provisions::ALL
}

/// Codes that are known to speak of gaps, with no formula here.
#[must_use]
pub fn unavailable() -> &'static [Unavailable] {
    provisions::UNAVAILABLE
}

/// The provision of this name.
///
/// # Errors
/// [`SeparationError::UnknownProvision`] with the nearest known name.
pub fn find(name: &str) -> Result<&'static ProvisionDescriptor, SeparationError> {
    let all = provisions::ALL;
    all.iter().find(|p| p.name == name).copied().ok_or_else(|| {
        let part = all
            .iter()
            .find(|p| !name.is_empty() && p.name.contains(name));
        let nearest = part.or(all.iter().min_by_key(|p| edit_distance(name, p.name)));
        SeparationError::UnknownProvision {
            name: name.to_owned(),
            nearest: nearest.map_or("", |p| p.name),
        }
    })
}

/// Levenshtein distance.
fn edit_distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, y) in b.iter().enumerate() {
            let substituted = diagonal + usize::from(x != *y);
            diagonal = row[j + 1];
            row[j + 1] = substituted.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}
