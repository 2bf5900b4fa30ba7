//! All laws by name.

use pounding_catalogue::suggestion;

use crate::descriptor::LawDescriptor;
use crate::error::HysteresisError;
use crate::law::HysteresisLaw;
use crate::laws;
use crate::parameters::LawParameters;

/// Descriptors of all laws.
#[must_use]
pub fn descriptors() -> &'static [&'static LawDescriptor] {
    laws::ALL
}

/// The descriptor of the law of this name or alias.
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

fn names(descriptor: &'static LawDescriptor) -> impl Iterator<Item = &'static str> {
    std::iter::once(descriptor.name).chain(descriptor.aliases.iter().map(|a| a.name))
}

/// Words of other programs and of the literature, and the law that does what they say; they
/// are suggested, never taken.
const SYNONYMS: [(&[&str], &str); 13] = [
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

/// The law of a known word within the name.
fn by_word(name: &str) -> Option<&'static str> {
    let plain = name.to_lowercase().replace(['-', ' '], "_");
    let within = |word: &str| format!("_{plain}_").contains(&format!("_{word}_"));
    let found = SYNONYMS
        .iter()
        .find(|(words, _)| words.iter().any(|w| within(w)));
    found.map(|(_, law)| *law)
}

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

/// The nearest known name: one that is misspelt, else one by a word that means it.
fn nearest(name: &str) -> &'static str {
    let spelt = by_spelling(name);
    if suggestion::is_within(name, spelt, 1 + name.chars().count() / 4) {
        return spelt;
    }
    by_word(name).unwrap_or(spelt)
}

fn by_spelling(name: &str) -> &'static str {
    let known = laws::ALL.iter().flat_map(|descriptor| names(descriptor));
    suggestion::nearest(name, known).unwrap_or("bilinear")
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
            assert_eq!(nearest(name), law, "{name}");
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
