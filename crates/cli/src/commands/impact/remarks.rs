//! What is to be said below a result.

use pounding_gap_element::Verification;
use pounding_gap_element::laboratory::Specimen;

use super::chosen::parameter;

/// What a reader must know of the results: where their numbers come from.
pub fn remarks(chosen: &[&Specimen]) -> String {
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
    [
        lines("filled from the example", &filled, single),
        lines("keeps its own separation", &own, single),
        lines("from secondary sources", &secondary, single),
    ]
    .concat()
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
