//! Files that people write for this program, known by what they hold.

use toml::de::{DeTable, DeValue};

/// Tables that stand in files of a kind alone, at their root.
const ROOTS: [(&str, &str); 8] = [
    ("variable", "a study"),
    ("ida", "a study"),
    ("rule", "a file of rules"),
    ("building", "a case"),
    ("gap", "a case"),
    ("link", "a case"),
    ("ground_motion", "a case"),
    ("entry", "a file of published values"),
];

/// What a text is that somebody has written for this program, whatever its file is called: a case, a study, rules or
/// published values. It is TOML with a table of theirs; whether it is without errors else is not asked.
#[must_use]
pub fn written_by_hand(text: &str) -> Option<&'static str> {
    // Long tables of numbers need not be read as TOML.
    let mut lines = text.trim_start_matches('\u{feff}').lines().map(str::trim);
    let first = lines.find(|line| !line.is_empty() && !line.starts_with('#'))?;
    if !first.starts_with('[') && !first.contains('=') {
        return None;
    }
    let tree = DeTable::parse(text).ok()?;
    let tables = tree.get_ref();
    let is_there = |key: &str| match tables.get(key).map(toml::Spanned::get_ref) {
        Some(DeValue::Table(_)) => true,
        Some(DeValue::Array(items)) => items
            .iter()
            .any(|item| matches!(item.get_ref(), DeValue::Table(_))),
        _ => false,
    };
    let mut roots = ROOTS.into_iter();
    roots.find(|(key, _)| is_there(key)).map(|(_, kind)| kind)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_known_by_their_tables() {
        for (text, kind) in [
            (
                "case = \"case.toml\"\n[[variable]]\nvalues = [1]",
                "a study",
            ),
            ("\u{feff}# Ours\n\n[ida]\n", "a study"),
            ("title = \"t\"\n[[building]]\nname = \"a\"", "a case"),
            ("ground_motion = { file = \"r.csv\" }", "a case"),
            ("gap = [{ width = \"1 mm\" }]\r\n", "a case"),
            ("[[rule]]\nname = \"mine\"", "a file of rules"),
            ("[[entry]]\n", "a file of published values"),
        ] {
            assert_eq!(written_by_hand(text), Some(kind), "{text}");
        }
        for text in [
            "",
            "# building\n",
            "time_s,acceleration_g\n0,0\n[[building]]\n",
            "<!DOCTYPE html>\n<pre>\n[[building]]\n</pre>",
            "{\"building\": [{}]}",
            "[package]\nname = \"a\"",
            "building = 3",
            "gap = [1, 2]",
            "a = b = c\n[[building]]",
        ] {
            assert_eq!(written_by_hand(text), None, "{text}");
        }
    }
}
