//! Signs that come with text that was pasted, and decimal commas: the parser says of them what it expected.

use std::ops::Range;

/// A sign that TOML does not have.
pub(super) struct Pasted {
    /// Where it stands.
    pub place: Range<usize>,
    /// What it is.
    pub message: String,
    /// What to write.
    pub help: String,
}

/// The first such sign in the lines of a place that the parser refuses.
pub(super) fn sign_in(source: &str, place: &Range<usize>) -> Option<Pasted> {
    let start = source.get(..place.start)?.rfind('\n');
    let start = start.map_or(0, |end| end + 1);
    let line = source.get(start..)?.split('\n').next()?;
    if let Some(offset) = line.find(FENCE).filter(|at| line[..*at].trim().is_empty()) {
        return Some(Pasted {
            place: start + offset..start + offset + FENCE.len(),
            message: format!("{FENCE} is a sign of Markdown"),
            help: "take this line out: what stands between two of them is the text".to_owned(),
        });
    }
    let mut found = outside_of_texts(line, open_lists(&source[..start]))?;
    found.place = found.place.start + start..found.place.end + start;
    Some(found)
}

/// What begins and ends code in Markdown.
const FENCE: &str = "```";

/// Lists that are open at the end of these lines.
fn open_lists(before: &str) -> usize {
    let mut lists = 0_usize;
    for line in before.lines() {
        let mut rest = line;
        while let Some(at) = rest.find(['#', '"', '\'', '[', ']']) {
            let (sign, behind) = (rest.as_bytes()[at], &rest[at + 1..]);
            rest = match sign {
                b'#' => "",
                b'[' | b']' => {
                    lists = if sign == b'[' {
                        lists + 1
                    } else {
                        lists.saturating_sub(1)
                    };
                    behind
                }
                _ => &behind[end_of_text(behind, char::from(sign)).unwrap_or(behind.len())..],
            };
        }
    }
    lists
}

/// The first such sign in a line, outside of texts and comments, that begins within so many lists.
fn outside_of_texts(line: &str, mut lists: usize) -> Option<Pasted> {
    // Texts of several lines have their own signs.
    if line.contains("\"\"\"") || line.contains("'''") {
        return None;
    }
    let mut at = 0;
    while let Some(sign) = line.get(at..).and_then(|rest| rest.chars().next()) {
        let rest = &line[at..];
        let next = at + sign.len_utf8();
        match sign {
            '#' => return None,
            '"' | '\'' => match end_of_text(&line[next..], sign) {
                Some(length) => {
                    at = next + length;
                    continue;
                }
                // A text that ends with another sign than it began with.
                None => {
                    let mut signs = line[next..].char_indices().take_while(|(_, c)| *c != '#');
                    let (offset, end) = signs.find(|(_, c)| quotation_mark(*c) == Some(sign))?;
                    return Some(of_quotation_mark(next + offset, end, sign));
                }
            },
            '[' => lists += 1,
            ']' => lists = lists.saturating_sub(1),
            _ if sign.is_ascii_digit() => {
                let length = length_of_number(rest);
                if let Some(pasted) = decimal_comma(rest, length, lists > 0) {
                    let place = at + pasted.place.start..at + pasted.place.end;
                    return Some(Pasted { place, ..pasted });
                }
                at += length;
                continue;
            }
            _ => {
                if let Some(plain) = quotation_mark(sign) {
                    return Some(of_quotation_mark(at, sign, plain));
                }
                if let Some(name) = invisible(sign) {
                    return Some(Pasted {
                        place: at..next,
                        message: format!("{name} stands here"),
                        help: "write a plain blank in its place, or nothing".to_owned(),
                    });
                }
            }
        }
        at = next;
    }
    None
}

/// Length of the rest of a text in quotation marks, with the last one.
fn end_of_text(rest: &str, mark: char) -> Option<usize> {
    let mut escaped = false;
    for (at, sign) in rest.char_indices() {
        match sign {
            _ if escaped => escaped = false,
            '\\' if mark == '"' => escaped = true,
            _ if sign == mark => return Some(at + 1),
            _ => {}
        }
    }
    None
}

/// The plain sign for a typographic quotation mark.
fn quotation_mark(sign: char) -> Option<char> {
    match sign {
        '\u{201c}'..='\u{201f}' | '\u{ab}' | '\u{bb}' | '\u{2033}' | '\u{ff02}' => Some('"'),
        '\u{2018}'..='\u{201b}' | '\u{b4}' | '`' | '\u{2032}' | '\u{2039}' | '\u{203a}' => {
            Some('\'')
        }
        _ => None,
    }
}

fn of_quotation_mark(at: usize, sign: char, plain: char) -> Pasted {
    Pasted {
        place: at..at + sign.len_utf8(),
        message: match sign {
            '`' => "` is no quotation mark".to_owned(),
            _ => format!("the quotation mark {sign} is a typographic one"),
        },
        help: format!("write {plain} before and after the text"),
    }
}

/// The name of a sign that looks like a blank or like nothing.
fn invisible(sign: char) -> Option<String> {
    let name = match sign {
        '\u{a0}' | '\u{202f}' | '\u{2007}' => "a no-break space",
        '\u{ad}' => "a soft hyphen",
        '\u{200b}'..='\u{200f}'
        | '\u{2060}'..='\u{2064}'
        | '\u{feff}'
        | '\u{202a}'..='\u{202e}' => "an invisible sign",
        _ if !sign.is_ascii() && sign.is_whitespace() => "a blank that is not the plain one",
        _ => return None,
    };
    Some(format!("{name} (U+{:04X})", u32::from(sign)))
}

/// Length of a number or a key that begins with a digit, up to a comma or what separates values.
fn length_of_number(text: &str) -> usize {
    let of_number = |c: char| c.is_ascii_alphanumeric() || matches!(c, '.' | '_' | '+' | '-');
    text.find(|c| !of_number(c)).unwrap_or(text.len())
}

/// A number with a decimal comma, of which `length` bytes lie before the comma. In lists commas separate values, and
/// only those tell that begin with a zero as no number does.
fn decimal_comma(text: &str, length: usize, in_list: bool) -> Option<Pasted> {
    let whole = &text[..length];
    let after = text[length..].strip_prefix(',')?;
    let decimals = &after[..length_of_number(after)];
    let are_digits = |part: &str| !part.is_empty() && part.bytes().all(|b| b.is_ascii_digit());
    // A power of ten may follow.
    let mantissa = decimals.split(['e', 'E']).next().unwrap_or_default();
    let begins_with_zero = mantissa.len() > 1 && mantissa.starts_with('0');
    let is_key = after[decimals.len()..].trim_start().starts_with(['=', '.']);
    let is_one = are_digits(whole) && are_digits(mantissa) && !is_key;
    let point = format!("decimals have a point: {whole}.{decimals}");
    let may_be_thousands = decimals.len() == 3 && length <= 3 && !whole.starts_with('0');
    (is_one && (!in_list || begins_with_zero)).then(|| Pasted {
        place: 0..length + 1 + decimals.len(),
        message: match !in_list && may_be_thousands {
            true => format!("{whole},{decimals} has a comma within the number"),
            false => format!("{whole},{decimals} has a decimal comma"),
        },
        help: match (in_list, may_be_thousands) {
            (true, _) => format!("{point}; values of a list do not begin with a zero"),
            (false, true) => format!("{point}; thousands stand without a comma: {whole}{decimals}"),
            _ => point,
        },
    })
}
