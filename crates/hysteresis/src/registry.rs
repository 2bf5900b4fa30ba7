//! All laws by name.

use crate::descriptor::LawDescriptor;
use crate::error::HysteresisError;
use crate::law::HysteresisLaw;
use crate::laws;
use crate::parameters::LawParameters;

/// Cards of all laws.
#[must_use]
pub fn descriptors() -> &'static [&'static LawDescriptor] {
    laws::ALL
}

/// The card of the law of this name or alias.
///
/// # Errors
/// [`HysteresisError::UnknownLaw`] with the nearest known name.
pub fn find(name: &str) -> Result<&'static LawDescriptor, HysteresisError> {
    laws::ALL
        .iter()
        .find(|d| names(d).any(|known| known == name))
        .copied()
        .ok_or_else(|| HysteresisError::UnknownLaw {
            name: name.to_owned(),
            nearest: nearest(name),
        })
}

/// Builds a law from its name and parameters (SI).
///
/// # Errors
/// An unknown name, or parameters that are unknown, missing, out of range or
/// inconsistent.
pub fn build(
    name: &str,
    parameters: &LawParameters,
) -> Result<Box<dyn HysteresisLaw>, HysteresisError> {
    let descriptor = find(name)?;
    parameters.check(descriptor)?;
    (descriptor.build)(parameters)
}

fn names(card: &'static LawDescriptor) -> impl Iterator<Item = &'static str> {
    std::iter::once(card.name).chain(card.aliases.iter().map(|a| a.name))
}

fn nearest(name: &str) -> &'static str {
    laws::ALL
        .iter()
        .flat_map(|card| names(card))
        .min_by_key(|known| edit_distance(name, known))
        .unwrap_or("bilinear")
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
