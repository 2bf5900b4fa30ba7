//! What stands among the rows of values of a file, and is none.

use crate::error::GroundMotionError;
use crate::format::Format;
use crate::source::Source;
use crate::text::Line;

/// The first line on which commas seem to stand within the numbers.
#[derive(Debug, Default)]
pub(super) struct DecimalCommas(Option<usize>);

impl DecimalCommas {
    /// Takes a line of values into account.
    pub(super) fn see(&mut self, line: Line<'_>) {
        if self.0.is_none() && has_commas_alone(line) {
            self.0 = Some(line.number);
        }
    }

    /// Refuses commas within numbers, which make more values than the header says: fields are parted at them.
    ///
    /// # Errors
    /// At the first line of them, whatever the user takes: each value would be two wrong ones.
    pub(super) fn part_values(
        &self,
        source: &Source<'_>,
        found: usize,
        count: Option<usize>,
    ) -> Result<(), GroundMotionError> {
        match (self.0, count) {
            (Some(line), Some(count)) if found > count => Err(source.error(
                line,
                0,
                format!(
                    "the header says {count} samples, and commas stand between digits here: they are within the numbers"
                ),
                "write decimal points, `0.0172`, and blanks between the numbers",
            )),
            _ => Ok(()),
        }
    }
}

/// Whether commas stand between digits on a line without any point, or on one whose numbers have
/// blanks between them.
fn has_commas_alone(line: Line<'_>) -> bool {
    let digits =
        |three: &[u8]| three[1] == b',' && three[0].is_ascii_digit() && three[2].is_ascii_digit();
    let in_blanks = line.bytes.trim_ascii().contains(&b' ');
    (in_blanks || !line.bytes.contains(&b'.')) && line.bytes.windows(3).any(digits)
}

/// The first line of another header where values must stand.
pub(super) fn second_record(source: &Source<'_>, line: Line<'_>) -> GroundMotionError {
    source.error(
        line.number,
        0,
        "a second record begins here: files of this format hold one",
        "put each record into a file of its own",
    )
}

/// The error of a file that is not of the format that the user gives: its header has none of these keys before `what`.
pub(super) fn not_of_format(
    source: &Source<'_>,
    line: usize,
    format: &Format,
    (keys, what): (&str, &str),
) -> GroundMotionError {
    source.error(
        line,
        0,
        format!(
            "the file does not look like {}: no line such as {keys} stands before the names of the {what}",
            format.name
        ),
        "leave the format out, so that it is found, or give the one of the file: `format` in [ground_motion] of a case, `--format` with `pounding motion`",
    )
}
