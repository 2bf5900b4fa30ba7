//! What is to be said below a result.

use pounding_catalogue::numbers::significant;
use pounding_gap_element::laboratory::Specimen;
use pounding_gap_element::{APPROACH_VELOCITY_FLOOR, Verification};

use super::chosen::parameter;
use super::setting::Setting;

/// What a reader must know of the results: where their numbers come from.
pub fn remarks(chosen: &[&Specimen], setting: &Setting) -> String {
    let mut filled = Vec::new();
    let mut own = Vec::new();
    let mut secondary = Vec::new();
    for one in chosen {
        if !one.filled.is_empty() {
            let list: Vec<_> = one.filled.iter().map(|key| parameter(one, key)).collect();
            filled.push((one.descriptor.name, list.join(", ")));
        }
        if one.keeps_own_separation {
            own.push((one.descriptor.name, one.separation().name().to_owned()));
        }
        if let Verification::SecondarySources(how) = one.descriptor.verification {
            secondary.push((one.descriptor.name, how.to_owned()));
        }
    }
    let single = chosen.len() == 1;
    let warnings = warnings(chosen.iter().copied(), setting);
    let warnings = warnings.iter().map(|w| format!("warning: {w}\n"));
    let warnings: String = warnings.collect();
    [
        warnings,
        lines("filled from the example", &filled, single),
        lines("keeps its own separation", &own, single),
        lines("from secondary sources", &secondary, single),
    ]
    .concat()
}

/// Of which models the collision is slower than they are made for.
pub fn warnings<'s>(
    chosen: impl IntoIterator<Item = &'s Specimen>,
    setting: &Setting,
) -> Vec<String> {
    let approach = setting.bodies.velocity_left - setting.bodies.velocity_right;
    let divide = |one: &&Specimen| one.descriptor.divides_by_approach_velocity();
    let divide = chosen.into_iter().filter(divide);
    let names: Vec<_> = divide.map(|one| one.descriptor.name).collect();
    if approach >= APPROACH_VELOCITY_FLOOR || names.is_empty() {
        return Vec::new();
    }
    vec![format!(
        "an approach of {} mm/s lies below 1 mm/s, the least that laws divide by: damped less, and returning more, than asked for: {}",
        significant(1.0e3 * approach),
        names.join(", ")
    )]
}

/// One line for all models of which the same is to be said.
fn lines(what: &str, said: &[(&str, String)], single: bool) -> String {
    let mut texts: Vec<&str> = Vec::new();
    for (_, text) in said {
        if !texts.contains(&text.as_str()) {
            texts.push(text);
        }
    }
    let line = |text: &&str| {
        let names: Vec<_> = said
            .iter()
            .filter(|(_, t)| t == text)
            .map(|(n, _)| *n)
            .collect();
        if single {
            format!("{what}: {text}\n")
        } else {
            format!("{what}: {}: {text}\n", names.join(", "))
        }
    };
    texts.iter().map(line).collect()
}
