//! All laws by name.

use pounding_catalogue::Registry;

use crate::descriptor::LawDescriptor;
use crate::error::HysteresisError;
use crate::law::HysteresisLaw;
use crate::laws;
use crate::parameters::LawParameters;

static LAWS: Registry<LawDescriptor> = Registry::new(laws::ALL, SYNONYMS);

/// Descriptors of all laws.
#[must_use]
pub fn descriptors() -> &'static [&'static LawDescriptor] {
    LAWS.all()
}

/// The descriptor of the law of this name or alias.
///
/// # Errors
/// [`DefinitionError::UnknownName`](pounding_catalogue::DefinitionError::UnknownName) with the
/// nearest known name.
pub fn find(name: &str) -> Result<&'static LawDescriptor, HysteresisError> {
    Ok(LAWS.find(name)?)
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

/// Words of other programs and of the literature, and the law that does what they say; they
/// are suggested, never taken.
const SYNONYMS: &[(&[&str], &str)] = &[
    (
        &["tension_only", "hook", "cable", "tie", "slack", "stopper"],
        "gap_hook",
    ),
    (
        &["compression_only", "no_tension", "gap", "bumper", "buffer"],
        "gap_hook",
    ),
    (
        &["epp", "elasto_plastic", "perfectly_plastic"],
        "elastic_perfectly_plastic",
    ),
    (&["steel01", "kinematic", "strain_hardening"], "bilinear"),
    (&["steel02", "menegotto", "giuffre"], "menegotto_pinto_1973"),
    (&["bouc", "boucwen"], "bouc_wen"),
    (&["clough", "degrading_stiffness"], "modified_clough"),
    (
        &["ibarra", "imk", "medina", "krawinkler"],
        "ibarra_medina_krawinkler_2005_bilinear",
    ),
    (
        &["pinching", "pinched"],
        "ibarra_medina_krawinkler_2005_pinching",
    ),
    (&["friction", "slider", "coulomb"], "coulomb_friction"),
    (&["damper", "viscous", "dashpot"], "viscous_damper"),
    (&["spring", "elastic"], "linear"),
    (&["iwan"], "iwan_six_parameter"),
];

/// Words of what only pulls, or pulls as well: no impact model does.
const PULLING: [&str; 6] = ["tension", "hook", "cable", "tie", "slack", "stopper"];

/// Help for a name that was looked for among the models of gaps, if it is that of a law of
/// links, or says that something pulls.
#[must_use]
pub fn help_among_gaps(name: &str) -> Option<String> {
    let law = match find(name) {
        Ok(law) => law.name,
        Err(_) => {
            let plain = name.to_lowercase().replace(['-', ' '], "_");
            let pulls = plain.split('_').any(|word| PULLING.contains(&word));
            pulls.then_some("gap_hook")?
        }
    };
    Some(format!(
        "a gap pushes and never pulls; for a law of a link write [[link]] with model = \"{law}\"; `pounding models` lists the models of gaps"
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_of_others_lead_to_a_law() {
        for (name, law) in [
            ("tension_only", "gap_hook"),
            ("Tension-Only", "gap_hook"),
            ("no tension", "gap_hook"),
            ("compression_only_gap", "gap_hook"),
            ("cable", "gap_hook"),
            ("epp", "elastic_perfectly_plastic"),
            ("Steel02", "menegotto_pinto_1973"),
            ("viscous", "viscous_damper"),
            ("imk", "ibarra_medina_krawinkler_2005_bilinear"),
            // Misspelt, not meant otherwise.
            ("bilinaer", "bilinear"),
            ("gap_hok", "gap_hook"),
            ("bouc_wenn", "bouc_wen"),
        ] {
            assert_eq!(LAWS.nearest(name), law, "{name}");
        }
        for (_, law) in SYNONYMS {
            assert!(find(law).is_ok(), "{law}");
        }
    }

    #[test]
    fn what_pulls_is_no_gap() {
        for (name, law) in [
            ("tension_only", "gap_hook"),
            ("Slack-Cable", "gap_hook"),
            ("gap_hook", "gap_hook"),
            ("viscous_damper", "viscous_damper"),
        ] {
            let help = help_among_gaps(name).unwrap_or_default();
            assert!(
                help.contains(&format!("model = \"{law}\"")),
                "{name}: {help}"
            );
        }
        for name in ["hertz", "kelvin_voigt", "no_such_model", "tiebreak"] {
            assert_eq!(help_among_gaps(name), None, "{name}");
        }
    }
}
