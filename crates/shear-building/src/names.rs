//! What can name a building, a gap or a link.

/// What a name is, for messages.
pub const NAMES: &str = "a name is not empty, not \".\" or \"..\", and has no slash, no control characters and no blanks at its ends";

/// Whether a text can stand in messages and as a group of the result file: see [`NAMES`].
#[must_use]
pub fn is_name(text: &str) -> bool {
    text.trim() == text
        && !matches!(text, "" | "." | "..")
        && !text.contains(|c: char| c == '/' || c.is_control())
}
