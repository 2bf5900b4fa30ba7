//! Columns that count the rows, of which one is missing, doubled or out of its place.

use crate::error::GroundMotionError;
use crate::number;
use crate::source::Source;

/// Steps by one that show that whole numbers count the rows, beside numbers with points and
/// beside whole numbers.
const FEW: usize = 2;
const MANY: usize = 9;

/// A column of whole numbers, as it is read.
#[derive(Debug, Default)]
pub(super) struct Counter {
    before: Option<f64>,
    /// Numbers that are one more than that before, and others.
    next: usize,
    others: usize,
    /// The first of the others: line, column, the number before, itself.
    first: Option<(usize, usize, f64, f64)>,
    /// Whether a number is not whole, or printed as one that need not be.
    none: bool,
}

impl Counter {
    /// Takes the number of a row into account, which starts at a column (from 0).
    pub(super) fn see(&mut self, line: usize, column: usize, field: &[u8]) {
        let digits = field.iter().all(u8::is_ascii_digit);
        let Some(found) = number::parse(field).ok().filter(|_| digits && !self.none) else {
            self.none = true;
            return;
        };
        match self.before.replace(found) {
            None => {}
            Some(before) if found == before + 1.0 => self.next += 1,
            Some(before) => {
                self.others += 1;
                self.first.get_or_insert((line, column, before, found));
            }
        }
    }

    /// Whether they are no whole numbers.
    pub(super) fn is_none(&self) -> bool {
        self.none
    }

    /// Line of the first number that is not the next one.
    pub(super) fn first_other(&self) -> Option<usize> {
        self.first.map(|(line, ..)| line)
    }

    /// Refuses a number that does not go on from the one before, where most do. `pointed`: the
    /// other columns have decimal points, and this one has none.
    ///
    /// # Errors
    /// At that number.
    pub(super) fn goes_on(
        &self,
        source: &Source<'_>,
        place: usize,
        pointed: bool,
    ) -> Result<(), GroundMotionError> {
        let most = match pointed {
            true => self.next >= FEW && self.next > self.others,
            false => self.next >= MANY && self.next >= 3 * self.others,
        };
        match self.first {
            Some((line, column, before, found)) if !self.none && most => Err(source.error(
                line,
                column,
                format!(
                    "column {place} counts the rows, but {found} follows {before} here: a row is missing, doubled or out of its place, or its number is damaged"
                ),
                "put the row or its number right, or get the record again",
            )),
            _ => Ok(()),
        }
    }
}
