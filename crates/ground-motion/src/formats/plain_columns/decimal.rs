//! Decimal commas: found where nothing else fits, refused where something else does.

use std::borrow::Cow;

use super::header::Header;
use super::rows;
use crate::error::GroundMotionError;
use crate::source::Source;
use crate::text::{Line, Lines};

const REMEDY: &str = "write decimal points, or separate the columns by semicolons or tabs";

/// What the rows are made of.
#[derive(Default)]
struct Seen {
    /// A decimal point.
    point: Option<usize>,
    /// A comma within a number, the first: line and column.
    inner: Option<(usize, usize)>,
    /// Another comma.
    outer: Option<(usize, usize)>,
    /// Two commas within what stands between two separators.
    twice: Option<(usize, usize)>,
    /// Semicolons or tabs between fields.
    divided: bool,
    /// Blanks between fields, and as many of them in every row as the header names columns.
    blanks: bool,
    as_named: bool,
}

/// The bytes with blanks for quotes around the numbers of rows, and semicolons for bars between
/// them. Commas between quoted numbers that have commas of their own are semicolons, too.
pub(super) fn without_quotes<'a>(source: &Source<'a>) -> Cow<'a, [u8]> {
    let has = |b: u8| rows(source).any(|l| l.bytes.contains(&b));
    let first = rows(source).next().map_or(1, |l| l.number);
    let start = line_start(source.bytes, first);
    let rest = &source.bytes[start..];
    if !(rest.contains(&b'"') && has(b'"') || rest.contains(&b'|') && has(b'|')) {
        return Cow::Borrowed(source.bytes);
    }
    let mut inside = false;
    let mut within = false;
    for b in rest {
        inside ^= *b == b'"';
        within |= inside && *b == b',';
    }
    inside = false;
    let mut bytes = source.bytes.to_vec();
    for b in &mut bytes[start..] {
        inside ^= *b == b'"';
        *b = match *b {
            b'"' => b' ',
            b'|' => b';',
            b',' if within && !inside => b';',
            other => other,
        };
    }
    Cow::Owned(bytes)
}

/// The bytes with points for decimal commas; as they are if the commas stand between the
/// columns.
///
/// # Errors
/// Commas that may be either.
pub(super) fn with_points<'a>(
    source: &Source<'a>,
    header: Option<&Header>,
) -> Result<Cow<'a, [u8]>, GroundMotionError> {
    let seen = Seen::of(source, header);
    let Some((line, column)) = seen.inner else {
        return Ok(Cow::Borrowed(source.bytes));
    };
    let refused = |(line, column): (usize, usize), message: &str| {
        Err(source.error(line, column, message, REMEDY))
    };
    if seen.divided {
        if let Some(point) = seen.point {
            let message = format!(
                "a comma within a number, where line {point} has a decimal point: which one is the decimal sign?"
            );
            return refused((line, column), &message);
        }
        if let Some(place) = seen.twice.or(seen.outer) {
            let message = "decimal commas, or commas between columns beside semicolons or tabs?";
            return refused(place, message);
        }
    } else if seen.point.is_some() {
        // Commas separate numbers with decimal points.
        return Ok(Cow::Borrowed(source.bytes));
    } else if !(seen.blanks && seen.as_named && seen.twice.is_none() && seen.outer.is_none()) {
        // Whole numbers between commas, as many as a header names between commas.
        if header.is_some_and(|h| h.separator == Some(',') && whole(source, h.columns.len())) {
            return Ok(Cow::Borrowed(source.bytes));
        }
        return refused(
            (line, column),
            "commas, but no decimal point in the whole file: decimal commas, or whole numbers between commas?",
        );
    }
    let mut bytes = source.bytes.to_vec();
    let first = rows(source).next().map_or(1, |l| l.number);
    let start = line_start(&bytes, first);
    for at in start.max(1)..bytes.len().saturating_sub(1) {
        if bytes[at] == b',' && inner(&source.bytes[at - 1..=at + 1]) {
            bytes[at] = b'.';
        }
    }
    // A number such as `,5` at the start of the first row.
    Ok(Cow::Owned(bytes))
}

/// Whether the comma in the middle of three bytes stands within a number.
fn inner(three: &[u8]) -> bool {
    three[0].is_ascii_digit() && three[2].is_ascii_digit()
}

/// Offset of a line (from 1), whatever ends the lines.
fn line_start(bytes: &[u8], line: usize) -> usize {
    let mut lines = Lines::new(bytes);
    match line.checked_sub(2) {
        None => 0,
        Some(before) => match lines.nth(before) {
            Some(_) => bytes.len() - lines.remaining(),
            None => 0,
        },
    }
}

/// Whether every row has so many fields between commas.
fn whole(source: &Source<'_>, columns: usize) -> bool {
    rows(source).all(|line| line.bytes.split(|b| *b == b',').count() == columns)
}

impl Seen {
    fn of(source: &Source<'_>, header: Option<&Header>) -> Self {
        let mut seen = Self {
            as_named: header.is_some(),
            ..Self::default()
        };
        let columns = header.map_or(0, |h| h.columns.len());
        for line in rows(source) {
            seen.add(line, columns);
        }
        seen
    }

    fn add(&mut self, line: Line<'_>, columns: usize) {
        let bytes = line.bytes;
        if self.point.is_none() && bytes.contains(&b'.') {
            self.point = Some(line.number);
        }
        let divider = |b: &u8| matches!(b, b';' | b'\t');
        let filled = |field: &[u8]| !field.trim_ascii().is_empty();
        self.divided |= bytes.split(|b| divider(b)).filter(|f| filled(f)).count() > 1;
        let blank = |b: &u8| b.is_ascii_whitespace();
        let words = bytes.split(|b| blank(b)).filter(|f| filled(f)).count();
        self.blanks |= words > 1;
        self.as_named &= words == columns;
        let mut commas_of_field = 0;
        for (at, b) in bytes.iter().enumerate() {
            match b {
                b';' | b'\t' | b' ' => commas_of_field = 0,
                b',' => {
                    let place = (line.number, at);
                    let within = at > 0 && bytes.get(at - 1..at + 2).is_some_and(inner);
                    if within {
                        self.inner.get_or_insert(place);
                        commas_of_field += 1;
                        if commas_of_field > 1 {
                            self.twice.get_or_insert(place);
                        }
                    } else {
                        self.outer.get_or_insert(place);
                    }
                }
                _ => {}
            }
        }
    }
}
