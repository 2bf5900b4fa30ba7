//! What a case says, without how it is written.

use std::borrow::Cow;

use pounding_case::parse_quantity;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Entries that change no number of a run: the record counts by its bytes.
const WITHOUT_EFFECT: [&str; 2] = ["title", "ground_motion.file"];

/// A line for every value of a TOML text, in order of the keys, quantities in SI units:
/// texts that say the same give the same lines, whatever their comments, order and units.
/// Text that is not TOML stands for itself.
pub(crate) fn canonical(source: &str) -> String {
    match DeTable::parse(source) {
        Ok(tree) => Lines::of(tree.get_ref()).with(&DeTable::new()),
        Err(_) => source.to_owned(),
    }
}

/// The lines of a tree by its root keys.
#[derive(Debug)]
pub(crate) struct Lines(Vec<(String, Vec<String>)>);

impl Lines {
    pub(crate) fn of(tree: &DeTable<'_>) -> Self {
        let of_root = |(key, inner): (&Key<'_>, &Spanned<DeValue<'_>>)| {
            let mut lines = Vec::new();
            entry(key.get_ref(), inner, &mut lines);
            (key.get_ref().to_string(), lines)
        };
        Self(tree.iter().map(of_root).collect())
    }

    /// The lines in their order, with those of these root keys in the place of their own.
    pub(crate) fn with(&self, changed: &DeTable<'_>) -> String {
        let new = Self::of(changed);
        let kept = |(root, _): &&(String, _)| !changed.contains_key(root.as_str());
        let roots = self.0.iter().filter(kept).chain(&new.0);
        let mut lines: Vec<&str> = roots
            .flat_map(|(_, lines)| lines)
            .map(String::as_str)
            .collect();
        lines.sort_unstable();
        lines.join("\n")
    }
}

type Key<'a> = Spanned<Cow<'a, str>>;

fn entry(place: &str, inner: &Spanned<DeValue<'_>>, lines: &mut Vec<String>) {
    if !WITHOUT_EFFECT.contains(&place) {
        value(inner.get_ref(), place, lines);
    }
}

fn value(value_here: &DeValue<'_>, path: &str, lines: &mut Vec<String>) {
    if let Some(x) = number(value_here) {
        lines.push(format!("{path} = {x:e}"));
        return;
    }
    match value_here {
        DeValue::Table(entries) => {
            for (key, inner) in entries {
                entry(&format!("{path}.{}", key.get_ref()), inner, lines);
            }
        }
        DeValue::Array(items) => {
            for (i, item) in items.iter().enumerate() {
                value(item.get_ref(), &format!("{path}.{i}"), lines);
            }
        }
        DeValue::String(text) => lines.push(format!("{path} = {text:?}")),
        DeValue::Integer(i) => lines.push(format!("{path} = {}:{}", i.radix(), i.as_str())),
        DeValue::Float(f) => lines.push(format!("{path} = {}", f.as_str())),
        DeValue::Boolean(b) => lines.push(format!("{path} = {b}")),
        DeValue::Datetime(d) => lines.push(format!("{path} = {d}")),
    }
}

/// The number (SI) of a value, if it is one or a text with a unit.
pub(super) fn number(value: &DeValue<'_>) -> Option<f64> {
    match value {
        DeValue::String(text) => parse_quantity(text).ok().map(|quantity| quantity.value),
        DeValue::Integer(i) if i.radix() == 10 => i.as_str().parse().ok(),
        DeValue::Integer(i) => {
            let whole = i64::from_str_radix(i.as_str(), i.radix());
            whole.ok().map(|whole| whole as f64)
        }
        DeValue::Float(f) => f.as_str().parse().ok(),
        _ => None,
    }
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
