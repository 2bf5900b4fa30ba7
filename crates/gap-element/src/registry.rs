//! All models by name.

use crate::descriptor::ModelDescriptor;
use crate::error::GapElementError;
use crate::model::ImpactModel;
use crate::models;
use crate::parameters::ModelParameters;

/// Every model, in the order in which they are listed to users.
static MODELS: &[&ModelDescriptor] = &[
    &models::linear_elastic::DESCRIPTOR,
    &models::hertz_1882::DESCRIPTOR,
    &models::anagnostopoulos_2004::DESCRIPTOR,
    &models::mahmoud_jankowski_2011::DESCRIPTOR,
    &models::jankowski_2005::DESCRIPTOR,
    &models::muthukumar_desroches_2006::DESCRIPTOR,
    &models::borovin_2014::DESCRIPTOR,
];

/// Cards of all models.
#[must_use]
pub fn descriptors() -> &'static [&'static ModelDescriptor] {
    MODELS
}

/// The model of this name or alias.
///
/// # Errors
/// [`GapElementError::UnknownModel`] with the nearest known name.
pub fn find(name: &str) -> Result<&'static ModelDescriptor, GapElementError> {
    MODELS
        .iter()
        .find(|d| d.name == name || d.aliases.contains(&name))
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
    MODELS
        .iter()
        .flat_map(|d| std::iter::once(d.name).chain(d.aliases.iter().copied()))
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
