//! Numbers that lost their end: `1.494E-02` cut after `1.494` or `1.494E-0` is a number too.

mod forms;
mod tally;

use std::collections::VecDeque;

pub(crate) use forms::Forms;

use crate::error::GroundMotionError;
use crate::number;
use crate::source::Source;
use crate::text::Line;

/// Values that show how a file writes its values.
const LIKE_IT: usize = 3;
/// Values without exponents that show how many decimals a file prints: one that leaves out zeros
/// at the end prints as many in all of them by chance only.
const LIKE_IT_IN_DECIMALS: usize = 30;
/// Last lines of values in which the form of a number is looked for.
const LAST_LINES: usize = 60;

/// What a printed number has behind its decimal point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Form {
    decimals: usize,
    /// Characters of the exponent, with its letter.
    exponent: usize,
}

impl Form {
    /// The form of a field; `None` of a number without a point or an exponent without a letter.
    fn of(field: &[u8]) -> Option<Self> {
        let end = field.iter().position(|b| b"eEdD".contains(b));
        let mantissa = &field[..end.unwrap_or(field.len())];
        let point = mantissa.iter().position(|b| *b == b'.')?;
        let decimals = &mantissa[point + 1..];
        decimals.iter().all(u8::is_ascii_digit).then_some(Self {
            decimals: decimals.len(),
            exponent: field.len() - mantissa.len(),
        })
    }
}

impl Source<'_> {
    /// Whether the file ends as a line does, or with the mark of its end.
    pub(crate) fn ends_in_a_line_end(&self) -> bool {
        matches!(self.bytes.last(), Some(b'\n' | b'\r' | 0x1a) | None)
    }

    /// Whether the last value of the file is whole. It is not where the file ends without an end of
    /// line in a number without the exponent, or a digit of it, or with fewer decimals than all
    /// values of the lines before it have.
    ///
    /// # Errors
    /// It is cut off, unless the user takes what is there: without it, which is said.
    pub(crate) fn ends_whole(&self) -> Result<bool, GroundMotionError> {
        if self.ends_in_a_line_end() {
            return Ok(true);
        }
        let mut ends = VecDeque::with_capacity(LAST_LINES);
        for line in self.lines().filter(|line| !line.is_blank()) {
            if line.is_text() {
                ends.clear();
                continue;
            }
            if ends.len() == LAST_LINES {
                ends.pop_front();
            }
            ends.push_back(line);
        }
        // One value at a time: a line may be as long as the file.
        let values = ends.into_iter().flat_map(|line| {
            let fields = line.fields();
            fields.map(move |(column, field)| (line, column, field))
        });
        self.is_last_whole(values)
    }

    /// Whether the last of these values, with their lines and columns, in which a file ends without an end of line is
    /// whole: it has the exponent, and as many decimals, as all others.
    ///
    /// # Errors
    /// It is cut off, unless the user takes what is there: without it, which is said.
    pub(crate) fn is_last_whole<'a>(
        &self,
        values: impl Iterator<Item = (Line<'a>, usize, &'a [u8])>,
    ) -> Result<bool, GroundMotionError> {
        if self.ends_in_a_line_end() {
            return Ok(true);
        }
        let (mut last, mut before, mut of_first, mut alike) = (None, 0_usize, None, true);
        for value in values {
            if let Some((_, _, earlier)) = last.replace(value) {
                let found = Form::of(earlier);
                if before == 0 {
                    of_first = found;
                }
                alike &= found.is_some() && found == of_first;
                before += 1;
            }
        }
        let (Some((line, column, field)), Some(usual)) = (last, of_first.filter(|_| alike)) else {
            return Ok(true);
        };
        let form = Form::of(field);
        let lacks = if form.map_or(0, |form| form.exponent) < usual.exponent && before >= LIKE_IT {
            "the exponent"
        } else if usual.exponent == 0
            && form.map_or(0, |form| form.decimals) < usual.decimals
            && before >= LIKE_IT_IN_DECIMALS
        {
            "decimals"
        } else {
            return Ok(true);
        };
        self.is_cut_off(line, column, field, lacks)?;
        Ok(false)
    }

    /// Says that the last value of the file is cut off.
    ///
    /// # Errors
    /// Unless the user takes what is there, without it.
    pub(crate) fn is_cut_off(
        &self,
        line: Line<'_>,
        column: usize,
        field: &[u8],
        lacks: &str,
    ) -> Result<(), GroundMotionError> {
        let shown = number::shown(field.trim_ascii());
        if self.options.lenient {
            self.warn(&format!(
                "line {}: the file ends within its last value, \"{shown}\", which is not used",
                line.number
            ));
            return Ok(());
        }
        Err(self.error(
            line.number,
            column,
            format!(
                "the file ends within its last value: \"{shown}\" lacks {lacks} of the values before it, and no end of line follows"
            ),
            "the file is probably truncated: get it again, or set `lenient = true` to use what is there before it",
        ))
    }
}
