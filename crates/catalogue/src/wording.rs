//! Numbers of things in sentences.

use std::borrow::Cow;
use std::collections::BTreeSet;
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

/// A title or name on one line: blanks stand for what ends lines. With its own lines one could say in an answer what
/// the answer does not.
#[must_use]
pub fn one_line(text: String) -> String {
    match text.contains(['\n', '\r']) {
        false => text,
        true => text.split_whitespace().collect::<Vec<_>>().join(" "),
    }
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

/// Texts of at most so many characters: what is left out in their middle, or elsewhere where
/// different texts would become one, is a sign.
#[must_use]
pub fn shortened<S: AsRef<str>>(texts: &[S], most: usize) -> Vec<String> {
    let kept = most.max(2) - 1;
    let texts: Vec<&str> = texts.iter().map(AsRef::as_ref).collect();
    let different = |texts: &[String]| texts.iter().collect::<BTreeSet<_>>().len();
    let all = texts.iter().collect::<BTreeSet<_>>().len();
    let made = |texts: &[&str], first: usize| -> Vec<String> {
        let one = |text: &&str| cut(text, (first, kept - first));
        texts.iter().map(one).collect()
    };
    let firsts = [kept / 2, 3 * kept / 4, kept / 4, kept, 0];
    let tried = firsts.iter().map(|first| made(&texts, *first));
    let known = tried.into_iter().find(|made| different(made) == all);
    known.unwrap_or_else(|| {
        // They begin and end alike: what they begin with is left out.
        let common = texts.iter().skip(1).fold(texts[0], |common, text| {
            let pairs = common.char_indices().zip(text.chars());
            let end = pairs.take_while(|((_, a), b)| a == b).last();
            let end = end.map_or(0, |((at, c), _)| at + c.len_utf8());
            &common[..end]
        });
        let rests: Vec<String> = texts
            .iter()
            .map(|text| format!("{LEFT_OUT}{}", &text[common.len()..]))
            .collect();
        let rests: Vec<&str> = rests.iter().map(String::as_str).collect();
        made(&rests, kept / 2)
    })
}

/// Stands for what is left out of a text.
const LEFT_OUT: char = '\u{2026}';

/// So many characters of the beginning and the end of a text, if it has more than these and one.
fn cut(text: &str, (first, last): (usize, usize)) -> String {
    let count = text.chars().count();
    if count <= first + last + 1 {
        return text.to_owned();
    }
    let start: String = text.chars().take(first).collect();
    let end: String = text.chars().skip(count - last).collect();
    format!("{}{LEFT_OUT}{}", start.trim_end(), end.trim_start())
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
    fn different_texts_stay_different() {
        assert_eq!(
            shortened(&["short", "also short"], 10),
            ["short", "also short"]
        );
        assert_eq!(
            shortened(
                &["the tower in the north 1", "the tower in the north 2"],
                12
            ),
            ["the t\u{2026}orth 1", "the t\u{2026}orth 2"]
        );
        // At the beginning, in the middle of it, at the end, after much that is alike.
        for pair in [
            [
                "north tower of the old hospital",
                "south tower of the old hospital",
            ],
            [
                "the northern tower of the hospital",
                "the southern tower of the hospital",
            ],
            ["hospital tower of the north", "hospital tower of the south"],
            [
                "a tower with a name of many letters, number 1, of the old hospital in the north",
                "a tower with a name of many letters, number 2, of the old hospital in the north",
            ],
        ] {
            let made = shortened(&pair, 12);
            assert_ne!(made[0], made[1], "{made:?}");
            assert!(
                made.iter().all(|text| text.chars().count() <= 12),
                "{made:?}"
            );
        }
        assert!(shortened::<&str>(&[], 12).is_empty());
        assert_eq!(shortened(&["one name", "one name"], 4), ["o\u{2026}me"; 2]);
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
