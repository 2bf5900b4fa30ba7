//! What a case says, without how it is written.

use pounding_case::parse_quantity;
use toml::de::{DeTable, DeValue};

/// Entries that change no number of a run: the record counts by its bytes.
const WITHOUT_EFFECT: [&str; 2] = ["title", "ground_motion.file"];

/// A line for every value of a TOML text, in order of the keys, quantities in SI units:
/// texts that say the same give the same lines, whatever their comments, order and units.
/// Text that is not TOML stands for itself.
pub(crate) fn canonical(source: &str) -> String {
    let Ok(tree) = DeTable::parse(source) else {
        return source.to_owned();
    };
    let mut lines = Vec::new();
    table(tree.get_ref(), "", &mut lines);
    lines.sort_unstable();
    lines.join("\n")
}

fn table(entries: &DeTable<'_>, path: &str, lines: &mut Vec<String>) {
    for (key, inner) in entries {
        let name = key.get_ref();
        let place = match path {
            "" => name.to_string(),
            _ => format!("{path}.{name}"),
        };
        if !WITHOUT_EFFECT.contains(&place.as_str()) {
            value(inner.get_ref(), &place, lines);
        }
    }
}

fn value(value_here: &DeValue<'_>, path: &str, lines: &mut Vec<String>) {
    match value_here {
        DeValue::Table(entries) => table(entries, path, lines),
        DeValue::Array(items) => {
            for (i, item) in items.iter().enumerate() {
                value(item.get_ref(), &format!("{path}.{i}"), lines);
            }
        }
        DeValue::String(text) => match parse_quantity(text) {
            Ok(quantity) => lines.push(number(path, quantity.value)),
            Err(_) => lines.push(format!("{path} = {text:?}")),
        },
        DeValue::Integer(i) if i.radix() == 10 => {
            lines.push(match i.as_str().parse() {
                Ok(x) => number(path, x),
                Err(_) => format!("{path} = {}", i.as_str()),
            });
        }
        DeValue::Integer(i) => lines.push(format!("{path} = {}:{}", i.radix(), i.as_str())),
        DeValue::Float(f) => lines.push(match f.as_str().parse() {
            Ok(x) => number(path, x),
            Err(_) => format!("{path} = {}", f.as_str()),
        }),
        DeValue::Boolean(b) => lines.push(format!("{path} = {b}")),
        DeValue::Datetime(d) => lines.push(format!("{path} = {d}")),
    }
}

fn number(path: &str, x: f64) -> String {
    format!("{path} = {x:e}")
}

#[cfg(test)]
mod tests {
    use super::canonical;

    #[test]
    fn writing_does_not_matter_and_values_do() {
        let first = "title = \"a\"\n[g]\nw = \"20 mm\" # as built\nx = 3.0\n";
        let same = "[g]\nx = 3\nw = 0.02\n";
        assert_eq!(canonical(first), canonical(same));
        assert_ne!(canonical(first), canonical("[g]\nx = 3\nw = 0.021\n"));
        assert_eq!(canonical(same), "g.w = 2e-2\ng.x = 3e0");
    }
}
