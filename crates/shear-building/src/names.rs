//! What can name a building, a gap or a link.

use std::collections::BTreeSet;

/// What gaps and links of cases and builders call a rigid wall, and no building therefore.
pub const WALL: &str = "wall";

/// What a name is, for messages.
pub const NAMES: &str = "a name is not empty, not \".\" or \"..\", and has at most 200 characters, no slash, no control characters, none that cannot be seen and no blanks at its ends";

/// Characters of a name: they stand in figures, tables and messages.
const LONGEST: usize = 200;

/// Whether a text can stand in messages and as a group of the result file: see [`NAMES`].
#[must_use]
pub fn is_name(text: &str) -> bool {
    text.trim() == text
        && !matches!(text, "" | "." | "..")
        && text.chars().nth(LONGEST).is_none()
        && !text.contains(|c: char| c == '/' || c.is_control() || is_unseen(c))
}

/// A name that cannot stand in messages and results.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{name:?} cannot name a {what}: {}", match fault {
    NameFault::Form => NAMES.to_owned(),
    NameFault::Taken => format!("another {what} has it"),
})]
pub struct NameError {
    /// The name.
    pub name: String,
    /// What it was to name, such as "gap".
    pub what: &'static str,
    /// Why it cannot.
    pub fault: NameFault,
}

impl NameError {
    /// What to do about it.
    pub const HELP: &str = "give it another name";
}

/// Why something cannot have a name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NameFault {
    /// It is no name: see [`NAMES`].
    Form,
    /// Another one of its kind has it.
    Taken,
}

/// Refuses the first of these names that cannot stand in messages and results, where `what` says of
/// what kind they are, such as "gap", or that another one has.
///
/// # Errors
/// [`NameError`].
pub fn check_names<'n>(
    what: &'static str,
    names: impl IntoIterator<Item = &'n str>,
) -> Result<(), NameError> {
    let mut seen = BTreeSet::new();
    for name in names {
        let fault = match name {
            _ if !is_name(name) => NameFault::Form,
            _ if !seen.insert(name) => NameFault::Taken,
            _ => continue,
        };
        let name = name.to_owned();
        return Err(NameError { name, what, fault });
    }
    Ok(())
}

/// Whether a character cannot be seen: it turns the direction of the text around it, numbers included,
/// or has no width, so that two names look alike. The joiners between letters of some scripts are
/// none of those.
fn is_unseen(c: char) -> bool {
    matches!(
        c,
        '\u{ad}' | '\u{200b}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{feff}'
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_have_an_end() {
        assert!(is_name(&"\u{e4}".repeat(LONGEST)));
        assert!(!is_name(&"a".repeat(LONGEST + 1)));
    }

    #[test]
    fn names_are_different() {
        let fault = |what, names: &[&str]| {
            let error = check_names(what, names.iter().copied()).err();
            error.map(|e| (e.name.clone(), e.fault, e.to_string()))
        };
        assert_eq!(fault("gap", &["a", "A", "wall"]), None);
        for (what, names, name, expected, said) in [
            ("gap", ["a", "a/b"], "a/b", NameFault::Form, "no slash"),
            ("link", ["", "a"], "", NameFault::Form, "not empty"),
            (
                "link",
                ["a", "a"],
                "a",
                NameFault::Taken,
                "another link has it",
            ),
        ] {
            let found = fault(what, &names);
            let found = found.as_ref();
            assert_eq!(found.map(|f| (&*f.0, f.1)), Some((name, expected)));
            assert!(found.is_some_and(|f| f.2.contains(said)), "{found:?}");
        }
    }
}
