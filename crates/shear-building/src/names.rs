//! What can name a building, a gap or a link.

/// What a name is, for messages.
pub const NAMES: &str = "a name is not empty, not \".\" or \"..\", and has at most 200 characters, no slash, no control characters and no blanks at its ends";

/// Characters of a name: they stand in figures, tables and messages.
const LONGEST: usize = 200;

/// Whether a text can stand in messages and as a group of the result file: see [`NAMES`].
#[must_use]
pub fn is_name(text: &str) -> bool {
    text.trim() == text
        && !matches!(text, "" | "." | "..")
        && text.chars().nth(LONGEST).is_none()
        && !text.contains(|c: char| c == '/' || c.is_control() || turns_text(c))
}

/// Whether a character turns the direction of the text around it, numbers included.
fn turns_text(c: char) -> bool {
    matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_have_an_end() {
        assert!(is_name(&"\u{e4}".repeat(LONGEST)));
        assert!(!is_name(&"a".repeat(LONGEST + 1)));
    }
}
