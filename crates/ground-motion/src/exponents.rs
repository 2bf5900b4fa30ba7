//! Exponents that are lost from the middle of a series: `2.705619` where all others are as
//! `3.100000E-02` is a number too.

use crate::error::GroundMotionError;
use crate::number;
use crate::source::Source;

/// Exponents of the numbers of a series, which all have one, or of which one has lost it.
#[derive(Default)]
pub(crate) struct Exponents {
    /// Numbers that have one.
    with: usize,
    /// Their decimals, while they are all the same.
    decimals: Option<usize>,
    mixed: bool,
    /// The first number that has none: line, column, decimals, as it stands.
    without: Option<(usize, usize, usize, String)>,
    missing: usize,
}

impl Exponents {
    /// Adds a number of a line, which starts at a column (from 0).
    pub(crate) fn see(&mut self, line: usize, column: usize, field: &[u8]) {
        if self.mixed {
            return;
        }
        let mantissa = field
            .iter()
            .position(|b| b"eEdD".contains(b))
            .map_or(field, |at| &field[..at]);
        let point = mantissa.iter().position(|b| *b == b'.');
        let decimals = point.map_or(0, |at| mantissa.len() - at - 1);
        if mantissa.len() < field.len() {
            self.with += 1;
            self.mixed |= *self.decimals.get_or_insert(decimals) != decimals;
        } else {
            self.missing += 1;
            self.mixed |= self.missing > 3;
            self.without
                .get_or_insert_with(|| (line, column, decimals, number::shown(field)));
        }
    }

    /// # Errors
    /// A number without an exponent among many that have one, with as many decimals.
    pub(crate) fn are_whole(self, source: &Source<'_>) -> Result<(), GroundMotionError> {
        let many = self.with >= 20 && !self.mixed;
        let Some((line, column, decimals, shown)) = self.without.filter(|_| many) else {
            return Ok(());
        };
        if self.decimals != Some(decimals) {
            return Ok(());
        }
        Err(source.error(
            line,
            column,
            format!("\"{shown}\" has no exponent, as all other values have: it may have been lost"),
            "correct the value, or get the record again",
        ))
    }
}
