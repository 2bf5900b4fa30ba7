//! Commas among numbers with blanks between them: a minus that was damaged would change the sign of its number.

use crate::error::GroundMotionError;
use crate::source::Source;

/// Rows of numbers among which a comma in one of them is odd.
const MANY: usize = 20;

/// Refuses commas directly before the digits of a number, at the start of its row or behind a blank, where hardly
/// any other row of numbers has a comma.
///
/// # Errors
/// At the first of them.
pub(crate) fn refuse(source: &Source<'_>) -> Result<(), GroundMotionError> {
    let (mut rows, mut odd, mut first) = (0_usize, 0, None);
    for line in source.all_lines().skip(source.options.skip_lines) {
        let of_numbers = |b: &u8| b.is_ascii_digit() || b"+-.eEdD, \t".contains(b);
        if !line.bytes.iter().all(of_numbers) || !line.bytes.iter().any(u8::is_ascii_digit) {
            continue;
        }
        rows += 1;
        let is_blank = |b: &u8| matches!(b, b' ' | b'\t');
        let before_number = |at: &usize| {
            let is_behind_blank = line.bytes[..*at].last().is_none_or(is_blank);
            let digit = line.bytes[*at + 1..].first();
            is_behind_blank && digit.is_some_and(|b| b.is_ascii_digit() || *b == b'.')
        };
        let commas = (0..line.bytes.len()).filter(|i| line.bytes[*i] == b',');
        let Some(at) = commas.clone().next() else {
            continue;
        };
        odd += 1;
        if commas.clone().all(|at| before_number(&at)) {
            first.get_or_insert((line.number, at));
        }
    }
    let Some((line, column)) = first.filter(|_| rows > MANY && odd <= rows / 1000 + 1) else {
        return Ok(());
    };
    Err(source.error(
        line,
        column,
        "a comma stands directly before a number, where the other numbers have blanks between them: it may have been a minus",
        "the file is damaged: write the sign or the blank that was there, or get the record again",
    ))
}
