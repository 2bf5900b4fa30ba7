//! All models by name.

use crate::descriptor::ModelDescriptor;
use crate::error::GapElementError;
use crate::model::ImpactModel;
use crate::models;
use crate::parameters::ModelParameters;

/// Cards of all models.
#[must_use]
pub fn descriptors() -> &'static [&'static ModelDescriptor] {
    models::ALL
}

/// The model of this name or alias.
///
/// # Errors
/// [`GapElementError::UnknownModel`] with the nearest known name.
pub fn find(name: &str) -> Result<&'static ModelDescriptor, GapElementError> {
    models::ALL
        .iter()
        .find(|d| d.name == name || d.aliases.iter().any(|a| a.name == name))
        .copied()
        .ok_or_else(|| GapElementError::UnknownModel {
            name: name.to_owned(),
            nearest: nearest(name),
        })
}

/// Builds a model from its name and parameters (SI).
///
/// # Errors
/// An unknown name, or parameters that are unknown, missing or out of range.
pub fn build(
    name: &str,
    parameters: &ModelParameters,
) -> Result<Box<dyn ImpactModel>, GapElementError> {
    let descriptor = find(name)?;
    parameters.check(descriptor)?;
    (descriptor.build)(parameters)
}

fn nearest(name: &str) -> &'static str {
    models::ALL
        .iter()
        .flat_map(|d| std::iter::once(d.name).chain(d.aliases.iter().map(|a| a.name)))
        .min_by_key(|known| edit_distance(name, known))
        .unwrap_or("hertz_1882")
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
