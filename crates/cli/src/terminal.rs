//! Texts that are shown on a terminal.
//!
//! Titles, names of files and excerpts of them are of users, and may hold characters that a terminal
//! obeys: control characters, and those that turn the direction of writing. They are shown as
//! `\u{1b}`; letters of all languages stay as they are.

use std::borrow::Cow;

/// The character that begins what terminals obey.
const ESCAPE: char = '\u{1b}';
/// What stands for it in sources until they are shown: it is as long, so that places in them stay.
const SUBSTITUTE: char = '\u{1a}';
/// The same for a carriage return that ends no line.
const RETURN: char = '\u{19}';

/// Whether a terminal obeys a character, or shows what follows it in another order.
fn is_obeyed(c: char) -> bool {
    (c.is_control() && c != '\n' && c != '\t')
        || matches!(
            c,
            '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}' | '\u{2029}'
        )
        || matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// A text with characters that a terminal would obey written out.
pub fn shown(text: &str) -> Cow<'_, str> {
    if !text.contains(is_obeyed) {
        return Cow::Borrowed(text);
    }
    let mut all = String::with_capacity(text.len() + 16);
    for (at, c) in text.char_indices() {
        // Half of the end of a line.
        let ends_line = c == '\r' && text[at + 1..].starts_with('\n');
        match is_obeyed(c) && !ends_line {
            true => all.extend(c.escape_unicode()),
            false => all.push(c),
        }
    }
    Cow::Owned(all)
}

/// The source of an excerpt, with every character at the place where it was: [`rendered`] shows it.
pub fn source(text: &str) -> String {
    let mut all = String::with_capacity(text.len());
    let mut characters = text.chars().peekable();
    while let Some(c) = characters.next() {
        all.push(match c {
            ESCAPE => SUBSTITUTE,
            // Whoever read the file has begun no line there.
            '\r' if characters.peek() != Some(&'\n') => RETURN,
            c => c,
        });
    }
    all
}

/// A report whose texts went through [`shown`] and whose source through [`source`], and which may
/// have colours of its own.
pub fn rendered(report: &str) -> String {
    let mut all = String::with_capacity(report.len());
    let mut rest = report;
    while let Some(at) = rest.find(ESCAPE) {
        all.push_str(&without_substitutes(&rest[..at]));
        let colour = colour(&rest[at..]);
        all.push_str(match colour {
            0 => "\\u{1b}",
            length => &rest[at..at + length],
        });
        rest = &rest[at + colour.max(ESCAPE.len_utf8())..];
    }
    all.push_str(&without_substitutes(rest));
    all
}

fn without_substitutes(text: &str) -> String {
    let text = text.replace(SUBSTITUTE, "\\u{1b}");
    shown(&text.replace(RETURN, "\\u{d}")).into_owned()
}

/// Length of the sequence at the start of a text that sets a colour or a weight; zero if it is none.
fn colour(text: &str) -> usize {
    let numbers = |c: char| c.is_ascii_digit() || c == ';';
    let after = text.strip_prefix("\u{1b}[");
    let end = after.map(|after| after.trim_start_matches(numbers));
    match end.filter(|end| end.starts_with('m')) {
        Some(end) => text.len() - end.len() + 1,
        None => 0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_terminal_obeys_is_written_out() {
        for (text, wanted) in [
            ("a\u{1b}[2Jb", "a\\u{1b}[2Jb"),
            ("a\u{9b}31mb", "a\\u{9b}31mb"),
            ("\u{202e}x\u{2066}", "\\u{202e}x\\u{2066}"),
            ("a\rb\u{7f}\u{7}", "a\\u{d}b\\u{7f}\\u{7}"),
            ("Gebäude 建物 é\t\n", "Gebäude 建物 é\t\n"),
            ("line\r\nline\r\n", "line\r\nline\r\n"),
        ] {
            assert_eq!(shown(text), wanted);
        }
    }

    #[test]
    fn reports_keep_their_own_colours_alone() {
        let excerpt = source("title = \"\u{1b}[31m\u{202e}\"");
        let report = format!("\u{1b}[31;1m×\u{1b}[0m {excerpt}\u{1b}]0;x");
        assert_eq!(
            rendered(&report),
            "\u{1b}[31;1m×\u{1b}[0m title = \"\\u{1b}[31m\\u{202e}\"\\u{1b}]0;x"
        );
    }

    #[test]
    fn a_return_that_ends_no_line_stays_in_it() {
        let text = "a = 1\rb = 2\r\nc = 3\r";
        assert_eq!(source(text).len(), text.len());
        assert_eq!(rendered(&source(text)), "a = 1\\u{d}b = 2\r\nc = 3\\u{d}");
    }
}
