//! All models by name.

use pounding_catalogue::Registry;

use crate::descriptor::ModelDescriptor;
use crate::error::GapElementError;
use crate::model::ImpactModel;
use crate::models;
use crate::parameters::ModelParameters;

static MODELS: Registry<ModelDescriptor> = Registry::new(models::ALL, SYNONYMS);

/// Descriptors of all models.
#[must_use]
pub fn descriptors() -> &'static [&'static ModelDescriptor] {
    MODELS.all()
}

/// The model of this name or alias.
///
/// # Errors
/// [`DefinitionError::UnknownName`](pounding_catalogue::DefinitionError::UnknownName) with the
/// nearest known name.
pub fn find(name: &str) -> Result<&'static ModelDescriptor, GapElementError> {
    Ok(MODELS.find(name)?)
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
const SYNONYMS: &[(&[&str], &str)] = &[
    // The words of several before those within them.
    (
        &[
            "jankowski",
            "nonlinear_viscoelastic",
            "non_linear_viscoelastic",
        ],
        "jankowski_2005",
    ),
    (&["kelvin", "voigt", "viscoelastic"], "anagnostopoulos_2004"),
    (
        &[
            "hertz_damped",
            "hertz_damping",
            "hertz_damper",
            "damped_hertz",
        ],
        "muthukumar_desroches_2006",
    ),
    (
        &["hertz", "nonlinear_elastic", "non_linear_elastic"],
        "hertz_1882",
    ),
    (&["linear", "spring", "elastic"], "linear_elastic"),
    (&["muthukumar", "desroches"], "muthukumar_desroches_2006"),
    (&["hunt", "crossley"], "hunt_crossley_1975"),
    (&["lankarani", "nikravesh"], "lankarani_nikravesh_1990"),
    (
        &["rigid", "restitution", "newton", "impulse", "hard"],
        "stereomechanical",
    ),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_of_others_lead_to_a_model() {
        for (name, model) in [
            ("kelvin-voigt-model", "anagnostopoulos_2004"),
            ("rigid", "stereomechanical"),
            ("hertz", "hertz_1882"),
            ("hertz_damped", "muthukumar_desroches_2006"),
            ("jankowski", "jankowski_2005"),
            ("linear_spring", "linear_elastic"),
            ("linear_viscoelastic", "anagnostopoulos_2004"),
            ("nonlinear_viscoelastic", "jankowski_2005"),
            // Misspelt, not meant otherwise.
            ("jankowski_2005x", "jankowski_2005"),
            ("kelvin_voit", "kelvin_voigt"),
        ] {
            assert_eq!(MODELS.nearest(name), model, "{name}");
        }
        for (_, model) in SYNONYMS {
            assert!(find(model).is_ok(), "{model}");
        }
    }
}
