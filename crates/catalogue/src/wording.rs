//! Numbers of things in sentences.

use std::borrow::Cow;
use std::fmt::Display;

/// A number with the noun that it counts: `1 gap`, `2 gaps`, `0 gaps`. Nouns whose plural takes
/// an `s`.
pub fn counted<N: Display + PartialEq + From<u8>>(count: N, noun: &str) -> String {
    let end = agreeing(&count, "", "s");
    format!("{count} {noun}{end}")
}

/// The word that agrees with a number: the first with one, else the second.
pub fn agreeing<'w, N: PartialEq + From<u8>>(count: &N, one: &'w str, others: &'w str) -> &'w str {
    if *count == N::from(1) { one } else { others }
}

/// A text as a cell of a CSV table. Spreadsheets take what begins with `=`, `+`, `-`, `@`, a tab or a
/// carriage return for a formula, which may do anything: an apostrophe before it makes it a text. A
/// number stays as it is, and so does the sign `-` of what has no unit.
#[must_use]
pub fn cell(text: &str) -> Cow<'_, str> {
    let formula = text.starts_with(['=', '+', '-', '@', '\t', '\r']);
    match formula && text != "-" && text.parse::<f64>().is_err() {
        true => Cow::Owned(format!("'{text}")),
        false => Cow::Borrowed(text),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_is_singular() {
        assert_eq!(counted(0_usize, "gap"), "0 gaps");
        assert_eq!(counted(1_usize, "gap"), "1 gap");
        assert_eq!(counted(2_u64, "storey"), "2 storeys");
        assert_eq!(agreeing(&1_usize, "closes", "close"), "closes");
        assert_eq!(agreeing(&3_usize, "closes", "close"), "close");
    }

    #[test]
    fn formulas_are_texts_and_numbers_numbers() {
        for text in [
            "=1+1",
            "+a",
            "-a",
            "@SUM(A1)",
            "\t=1",
            "\r=1",
            "-1-1",
            "=HYPERLINK(\"x\")",
        ] {
            assert_eq!(cell(text), format!("'{text}"));
        }
        for text in [
            "",
            "-",
            "-1.5",
            "+2",
            "-1e-9",
            "-inf",
            "a=b",
            "light-heavy",
            "'=1",
            "\u{fc}",
        ] {
            assert_eq!(cell(text), text);
        }
    }
}
