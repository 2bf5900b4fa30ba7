//! Rows of one series along the rows: all but the last have as many values.

use std::collections::BTreeMap;

use crate::error::GroundMotionError;
use crate::source::Source;

/// Rows with another number of values that are damaged, not free, in any file; more in a long one.
const FEW: usize = 2;
/// Rows of which one more may be damaged.
const AMONG: usize = 20;

/// Numbers of values of rows, as they are read.
#[derive(Debug, Default)]
pub(crate) struct RowWidths {
    /// By the number of values: so many rows, and the line of the first.
    rows: BTreeMap<usize, (usize, usize)>,
    /// Line and number of values of the row before, which may be the last.
    last: Option<(usize, usize)>,
}

/// A row that has another number of values than the others.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct OddRow {
    pub line: usize,
    pub found: usize,
    pub others: usize,
}

impl RowWidths {
    /// Takes a row of so many values into account.
    pub(crate) fn see(&mut self, line: usize, values: usize) {
        if let Some((line, values)) = self.last.replace((line, values)) {
            self.add(line, values);
        }
    }

    fn add(&mut self, line: usize, values: usize) {
        self.rows.entry(values).or_insert((0, line)).0 += 1;
    }

    /// The number of values that each row has, if there are so many rows and more than one value in each.
    pub(crate) fn are_all(&self, rows: usize) -> Option<usize> {
        let (_, last) = self.last?;
        let all: usize = self.rows.values().map(|(count, _)| count).sum();
        let only = self.rows.len() == 1 && self.rows.contains_key(&last);
        (only && last > 1 && all + 1 == rows).then_some(last)
    }

    /// The most values that a row has.
    pub(crate) fn most(&self) -> Option<usize> {
        let before = self.rows.keys().next_back().copied();
        before.max(self.last.map(|(_, values)| values))
    }

    /// The first row that is damaged: a few have another number of values than all others. Where
    /// many do, the rows are free. The last one may be shorter.
    pub(crate) fn odd(mut self) -> Option<OddRow> {
        let (line, values) = self.last.take()?;
        let usual = |rows: &BTreeMap<usize, (usize, usize)>| {
            let most = rows
                .iter()
                .max_by_key(|(values, (count, _))| (*count, **values));
            most.map(|(values, _)| *values)
        };
        if usual(&self.rows).is_none_or(|usual| values >= usual) {
            self.add(line, values);
        }
        let others = usual(&self.rows)?;
        let all: usize = self.rows.values().map(|(count, _)| count).sum();
        let odd = all - self.rows.get(&others)?.0;
        if odd == 0 || odd > FEW.max(all / AMONG) || 3 * odd > all {
            return None;
        }
        let first = self.rows.iter().filter(|(values, _)| **values != others);
        let (found, (_, line)) = first.min_by_key(|(_, (_, line))| *line)?;
        Some(OddRow {
            line: *line,
            found: *found,
            others,
        })
    }

    /// Refuses a damaged row of a format of an agency.
    ///
    /// # Errors
    /// At that row, unless the user takes what is there.
    pub(crate) fn are_even(self, source: &Source<'_>) -> Result<(), GroundMotionError> {
        let Some(odd) = self.odd() else {
            return Ok(());
        };
        let message = odd.message();
        if source.options.lenient {
            source.warn(&format!("line {}: {message}", odd.line));
            return Ok(());
        }
        Err(source.error(odd.line, 0, message, REMEDY))
    }
}

/// What to do about a damaged row.
pub(crate) const REMEDY: &str =
    "the row is damaged, or out of its place: correct it, or get the record again";

impl OddRow {
    pub(crate) fn message(self) -> String {
        format!(
            "this row has another number of values than its neighbours: {}, where all others have {}",
            self.found, self.others
        )
    }
}
