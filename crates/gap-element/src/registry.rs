//! All models by name.

use pounding_catalogue::suggestion;

use crate::descriptor::ModelDescriptor;
use crate::error::GapElementError;
use crate::model::ImpactModel;
use crate::models;
use crate::parameters::ModelParameters;

/// Descriptors of all models.
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

/// Words of other programs and of the literature, and the model that does what they say; they
/// are suggested, never taken.
const SYNONYMS: [(&[&str], &str); 8] = [
    (&["kelvin", "voigt", "viscoelastic"], "anagnostopoulos_2004"),
    (&["jankowski", "nonlinear_viscoelastic"], "jankowski_2005"),
    (&["linear", "spring", "elastic"], "linear_elastic"),
    (&["hertz", "nonlinear_elastic"], "hertz_1882"),
    (&["muthukumar", "desroches"], "muthukumar_desroches_2006"),
    (&["hunt", "crossley"], "hunt_crossley_1975"),
    (&["lankarani", "nikravesh"], "lankarani_nikravesh_1990"),
    (
        &["rigid", "restitution", "newton", "impulse", "hard"],
        "stereomechanical",
    ),
];

/// The model of a known word within the name.
fn by_word(name: &str) -> Option<&'static str> {
    let plain = name.to_lowercase().replace(['-', ' '], "_");
    let within = |word: &str| format!("_{plain}_").contains(&format!("_{word}_"));
    let found = SYNONYMS
        .iter()
        .find(|(words, _)| words.iter().any(|w| within(w)));
    found.map(|(_, model)| *model)
}

/// The nearest known name: one that is misspelt, else one by a word that means it.
fn nearest(name: &str) -> &'static str {
    let spelt = by_spelling(name);
    if suggestion::is_within(name, spelt, 1 + name.chars().count() / 4) {
        return spelt;
    }
    by_word(name).unwrap_or(spelt)
}

fn by_spelling(name: &str) -> &'static str {
    let known = models::ALL
        .iter()
        .flat_map(|d| std::iter::once(d.name).chain(d.aliases.iter().map(|a| a.name)));
    suggestion::nearest(name, known).unwrap_or("hertz_1882")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_of_others_lead_to_a_model() {
        for (name, model) in [
            ("kelvin-voigt-model", "anagnostopoulos_2004"),
            ("rigid", "stereomechanical"),
            ("hertz", "hertz_1882"),
            ("jankowski", "jankowski_2005"),
            ("linear_spring", "linear_elastic"),
            // Misspelt, not meant otherwise.
            ("jankowski_2005x", "jankowski_2005"),
            ("kelvin_voit", "kelvin_voigt"),
        ] {
            assert_eq!(nearest(name), model, "{name}");
        }
        for (_, model) in SYNONYMS {
            assert!(find(model).is_ok(), "{model}");
        }
    }
}
