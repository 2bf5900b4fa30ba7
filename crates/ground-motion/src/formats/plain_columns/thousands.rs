//! Separators of thousands that would pass for decimal signs: `1,024` among whole numbers is 1024, or
//! 1.024.

use super::rows;
use crate::error::GroundMotionError;
use crate::number;
use crate::source::Source;

/// Digits of a group.
const GROUP: usize = 3;

/// Refuses rows of one number each in which some have a comma before three digits, `-1,461.5` among `938.5`:
/// they would be two numbers.
///
/// # Errors
/// At the first such row.
pub(super) fn are_no_groups(source: &Source<'_>) -> Result<(), GroundMotionError> {
    let (mut single, mut first) = (false, None);
    for row in rows(source) {
        let field = row.bytes.trim_ascii();
        if is_grouped(field) {
            first.get_or_insert((row.number, number::shown(field)));
        } else if row.fields().count() == 1 {
            single = true;
        } else {
            return Ok(());
        }
    }
    match first.filter(|_| single) {
        None => Ok(()),
        Some((line, field)) => Err(source.error(
            line,
            0,
            format!("\"{field}\" has a comma before three digits, and other rows have one number: it parts thousands"),
            "write the numbers without separators of thousands",
        )),
    }
}

/// Whether a text is one number with commas before groups of three digits, `1,461.5`.
fn is_grouped(text: &[u8]) -> bool {
    let bare = text
        .strip_prefix(b"-")
        .or(text.strip_prefix(b"+"))
        .unwrap_or(text);
    let whole = bare.split(|b| *b == b'.').next().unwrap_or_default();
    let digits = |part: &[u8]| !part.is_empty() && part.iter().all(u8::is_ascii_digit);
    let mut groups = whole.split(|b| *b == b',');
    let leads = groups
        .next()
        .is_some_and(|first| digits(first) && first.len() <= GROUP && first[0] != b'0');
    let fraction = bare.get(whole.len() + 1..).unwrap_or_default();
    leads
        && whole.contains(&b',')
        && groups.all(|group| digits(group) && group.len() == GROUP)
        && fraction.iter().all(u8::is_ascii_digit)
}

/// The values of one series, as far as they show that their sign may part thousands: every one with a
/// sign has a group of three digits behind it and one of up to three, of a number above zero, before it.
#[derive(Debug, Default)]
pub(super) struct Thousands {
    /// Values with a sign, and the first of them: line, column, field.
    signed: usize,
    first: Option<(usize, usize, String)>,
    /// Whether one without a sign has three digits: a record that reaches thousands passes through
    /// hundreds.
    hundreds: bool,
    /// Whether a value shows that there are no separators.
    none: bool,
}

impl Thousands {
    /// Takes one more value of a line into account, which starts at a column (from 0) and has a point
    /// for its decimal sign.
    pub(super) fn see(&mut self, line: usize, column: usize, field: &[u8]) {
        if self.none {
            return;
        }
        let bare = field.strip_prefix(b"-").or(field.strip_prefix(b"+"));
        let bare = bare.unwrap_or(field);
        let mut parts = bare.split(|b| *b == b'.');
        let (before, behind) = (parts.next().unwrap_or_default(), parts.next());
        let digits = |part: &[u8]| part.iter().all(u8::is_ascii_digit);
        let leads = before.first().is_some_and(|b| *b != b'0');
        let may = match behind {
            // With separators a larger number has one.
            None => digits(before) && before.len() <= GROUP,
            Some(behind) => {
                let group = digits(behind) && behind.len() == GROUP;
                group && leads && digits(before) && before.len() <= GROUP
            }
        };
        self.none = !may;
        if behind.is_none() {
            self.hundreds |= leads && before.len() == GROUP;
        } else {
            self.signed += 1;
            self.first
                .get_or_insert_with(|| (line, column, number::shown(field)));
        }
    }

    /// Refuses values whose sign may part thousands.
    ///
    /// # Errors
    /// At the first value with a sign.
    pub(super) fn are_none(&self, source: &Source<'_>) -> Result<(), GroundMotionError> {
        let Some((line, column, field)) = self.first.as_ref().filter(|_| self.hundreds) else {
            return Ok(());
        };
        if self.none {
            return Ok(());
        }
        let thousands = field.replace('.', "");
        Err(source.error(
            *line,
            *column,
            format!(
                "\"{field}\" may be {thousands}: every value with a decimal sign ({} of them) has three digits behind it, and all others are whole numbers",
                self.signed
            ),
            "write whole numbers without separators of thousands, or all values with as many decimals",
        ))
    }
}
