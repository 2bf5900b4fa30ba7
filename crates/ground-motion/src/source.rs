//! A file on its way through a reader: places in it, and what the user said.

use std::cell::{Cell, RefCell};
use std::path::Path;

use crate::error::GroundMotionError;
use crate::fortran::{Layout, format_of};
use crate::number::{self, Bare, Printed};
use crate::options::ReadOptions;
use crate::quantity::SeriesUnit;
use crate::recording::WithoutSensitivity;
use crate::text::{Line, Lines};

/// Lines that detection looks at.
const HEAD: usize = 30;
/// Series that any file may hold, and bytes that each further one must bring: no
/// agency's header is shorter.
const FREE_SERIES: usize = 12;
const BYTES_A_SERIES: usize = 256;
pub(crate) const REMEDY_VALUE: &str =
    "correct the value, or get the record again: no sample may be missing";

/// What to do about numbers of a row that touch.
fn touching_remedy(row: &[u8]) -> String {
    let example = match format_of(row) {
        Some(format) => format!("here `layout = \"{format}\"`"),
        None => "e.g. `layout = \"8I6\"` for eight numbers of six characters a row".to_owned(),
    };
    format!(
        "put a blank between the numbers; or in plain columns that hold one series along rows of fixed width give their Fortran format, {example}"
    )
}

/// A file's bytes with what is needed to point into them.
pub(crate) struct Source<'a> {
    pub file: &'a str,
    pub bytes: &'a [u8],
    pub options: &'a ReadOptions,
    /// Where the file lies, if it was read from a path.
    pub path: Option<&'a Path>,
    /// What holds for the whole file.
    warnings: RefCell<Vec<String>>,
    /// Channels that were passed over.
    without: RefCell<Vec<WithoutSensitivity>>,
    /// Series finished so far.
    series: Cell<usize>,
    /// What the user said that was of use.
    used: Cell<Used>,
}

/// Options that only some records have a use for.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Used {
    /// The counts of m/s2.
    pub sensitivity: bool,
    /// The g of units of gravity.
    pub gravity: bool,
}

/// Keys of a header with their values and lines.
#[derive(Default)]
pub(crate) struct Keys(Vec<(String, String, usize)>);

impl Keys {
    /// Whether a key stands for the first time; one that stands twice must say the same.
    ///
    /// # Errors
    /// Another value than before, unless the user takes the first.
    pub(crate) fn is_new(
        &mut self,
        source: &Source<'_>,
        line: Line<'_>,
        key: &str,
        value: &str,
    ) -> Result<bool, GroundMotionError> {
        let Some((_, first, at)) = self.0.iter().find(|(known, _, _)| known == key) else {
            self.0.push((key.to_owned(), value.to_owned(), line.number));
            return Ok(true);
        };
        if first != value {
            let shown = |text: &str| number::shown(text.as_bytes());
            let message = format!(
                "{} is \"{}\" here, but \"{}\" in line {at}",
                shown(key),
                shown(value),
                shown(first)
            );
            source.contradiction(line.number, message)?;
        }
        Ok(false)
    }
}

impl<'a> Source<'a> {
    pub(crate) fn new(
        file: &'a str,
        bytes: &'a [u8],
        options: &'a ReadOptions,
        path: Option<&'a Path>,
    ) -> Self {
        Self {
            file,
            bytes,
            options,
            path,
            warnings: RefCell::default(),
            without: RefCell::default(),
            series: Cell::default(),
            used: Cell::default(),
        }
    }

    /// Counts a series that ends at a line: a damaged file must not make hundreds
    /// of thousands of them.
    pub(crate) fn one_more_series(&self, line: usize) -> Result<(), GroundMotionError> {
        self.series.set(self.series.get() + 1);
        if self.series.get() <= FREE_SERIES + self.bytes.len() / BYTES_A_SERIES {
            return Ok(());
        }
        Err(self.error(
            line,
            0,
            format!(
                "{} series in a file of {} bytes",
                self.series.get(),
                self.bytes.len()
            ),
            "the file is damaged: get it again",
        ))
    }

    /// Says that options were of use.
    pub(crate) fn uses(&self, more: Used) {
        let before = self.used.get();
        self.used.set(Used {
            sensitivity: before.sensitivity || more.sensitivity,
            gravity: before.gravity || more.gravity,
        });
    }

    pub(crate) fn used(&self) -> Used {
        self.used.get()
    }

    /// The lines from the first that is not blank on: blank ones before a header hide no format.
    pub(crate) fn lines(&self) -> Lines<'a> {
        self.all_lines().after_blank()
    }

    /// All lines, of files whose lines the user counts.
    pub(crate) fn all_lines(&self) -> Lines<'a> {
        Lines::new(self.bytes)
    }

    /// The first lines, of which detection needs no more.
    pub(crate) fn head(&self) -> impl Iterator<Item = Line<'a>> + use<'a> {
        self.lines().take(HEAD)
    }

    /// The first line in lower case.
    pub(crate) fn first_line(&self) -> String {
        self.lines().next().map(|l| l.lower()).unwrap_or_default()
    }

    /// Says something about the whole file, once.
    pub(crate) fn warn(&self, text: &str) {
        let mut warnings = self.warnings.borrow_mut();
        if !warnings.iter().any(|w| w == text) {
            warnings.push(text.to_owned());
        }
    }

    /// Notes a channel that was passed over.
    pub(crate) fn is_without(&self, channel: WithoutSensitivity) {
        self.without.borrow_mut().push(channel);
    }

    pub(crate) fn without(&self) -> Vec<WithoutSensitivity> {
        self.without.borrow().clone()
    }

    pub(crate) fn warnings(&self) -> Vec<String> {
        self.warnings.borrow().clone()
    }

    /// An error at a line (from 1) and a column (from 0).
    pub(crate) fn error(
        &self,
        line: usize,
        column: usize,
        message: impl Into<String>,
        remedy: &str,
    ) -> GroundMotionError {
        GroundMotionError::Parse {
            file: self.file.to_owned(),
            line: line.max(1),
            column: column + 1,
            message: message.into(),
            remedy: remedy.to_owned(),
        }
    }

    /// An error at a byte (from 0) of a binary file.
    pub(crate) fn binary_error(
        &self,
        offset: usize,
        message: impl Into<String>,
    ) -> GroundMotionError {
        GroundMotionError::Binary {
            file: self.file.to_owned(),
            offset,
            message: message.into(),
        }
    }

    /// Two statements of a header that contradict one another at a line: an error, or a warning
    /// where the user takes the file as it is.
    pub(crate) fn contradiction(
        &self,
        line: usize,
        message: String,
    ) -> Result<(), GroundMotionError> {
        if self.options.lenient {
            self.warn(&format!("line {line}: {message}"));
            return Ok(());
        }
        Err(self.error(
            line,
            0,
            message,
            "the header contradicts itself: get the record again, or set `lenient = true` to use the first",
        ))
    }

    /// Two units for the same values.
    pub(crate) fn two_units(
        &self,
        line: Line<'_>,
        a: SeriesUnit,
        b: SeriesUnit,
    ) -> GroundMotionError {
        self.error(
            line.number,
            0,
            format!(
                "two units, {} and {}, for the same values",
                a.symbol, b.symbol
            ),
            "the header contradicts itself: get the record again",
        )
    }

    /// A word where a header states the unit of the values that is none.
    pub(crate) fn unknown_unit(&self, line: usize, word: &str, remedy: &str) -> GroundMotionError {
        self.error(
            line,
            0,
            format!(
                "\"{}\" is no unit that is known",
                number::shown(word.as_bytes())
            ),
            remedy,
        )
    }

    /// Text behind the series of a format whose files hold one.
    pub(crate) fn second_series(&self, line: Line<'_>) -> GroundMotionError {
        self.error(
            line.number,
            0,
            "text behind the series, where the file must end: files of this format hold one record",
            "put each record into a file of its own",
        )
    }

    /// The next line, which must be there: `what` names it.
    pub(crate) fn expect<'b>(
        &self,
        lines: &mut Lines<'b>,
        what: &str,
    ) -> Result<Line<'b>, GroundMotionError> {
        lines.next().ok_or_else(|| {
            self.error(
                lines.number() + 1,
                0,
                format!("the file ends where {what} must be"),
                "the file is truncated: get it again",
            )
        })
    }

    /// A number of a line that starts at a column (from 0).
    pub(crate) fn number(
        &self,
        line: Line<'_>,
        column: usize,
        field: &[u8],
    ) -> Result<f64, GroundMotionError> {
        number::parse(field).map_err(|message| {
            let remedy = match number::touching(field) {
                true => touching_remedy(line.bytes),
                false => REMEDY_VALUE.to_owned(),
            };
            self.error(line.number, column, message, &remedy)
        })
    }

    /// The number that a text of a header begins with, with one unit of its last digit. One that is damaged is named in a
    /// warning, and is held against nothing.
    pub(crate) fn header_number(&self, line: usize, what: &str, text: &str) -> Option<Printed> {
        let Some(word) = number::damaged(text) else {
            return number::first_in(text);
        };
        self.warn(&format!(
            "line {line}: {what} is \"{}\", which is not a number, and is not held against what the file holds",
            number::shown(word.as_bytes())
        ));
        None
    }

    /// The time step (s) of a text of a line that starts with it or with a rate.
    pub(crate) fn step_or_rate(
        &self,
        line: Line<'_>,
        text: &str,
        bare: Bare,
    ) -> Result<Option<f64>, GroundMotionError> {
        number::step_or_rate(&text.to_ascii_lowercase(), bare).map_err(|message| {
            self.error(
                line.number,
                0,
                message,
                "correct the header: the step is in seconds, as in `DT= .01000 SEC`, in milliseconds (MSEC), or a rate (HZ)",
            )
        })
    }

    /// A number in a field of a Fortran format.
    pub(crate) fn field(
        &self,
        line: Line<'_>,
        column: usize,
        field: &[u8],
        layout: Layout,
    ) -> Result<f64, GroundMotionError> {
        let number = self.number(line, column, field)?;
        let is_of_whole = |b: &u8| b.is_ascii_digit() || b"+-".contains(b);
        if layout.wholes && !field.trim_ascii().iter().all(is_of_whole) {
            let blanks = field.len() - field.trim_ascii_start().len();
            return Err(self.error(
                line.number,
                column + blanks,
                format!(
                    "\"{}\" is no whole number, as all are in the format of the values",
                    number::shown(field.trim_ascii())
                ),
                REMEDY_VALUE,
            ));
        }
        Ok(layout.value(field, number))
    }

    /// Refuses NUL bytes, which no text has: they stand where a program or a system did not write
    /// what it should have.
    pub(crate) fn is_text(&self) -> Result<(), GroundMotionError> {
        if !self.bytes.contains(&0) {
            return Ok(());
        }
        let place = |line: Line<'_>| Some((line.number, line.bytes.iter().position(|b| *b == 0)?));
        let (line, column) = self.lines().find_map(place).unwrap_or_default();
        Err(self.error(
            line,
            column,
            "a NUL byte stands in the text: a part of the file was not written",
            "get the record again; if it is UTF-16, save it as UTF-8",
        ))
    }

    /// `count` header numbers of fixed width; `None` where a field is blank or
    /// not a number: only those that are needed must be right.
    pub(crate) fn header_numbers(
        &self,
        lines: &mut Lines<'_>,
        layout: Layout,
        count: usize,
    ) -> Result<HeaderNumbers, GroundMotionError> {
        let first = lines.number() + 1;
        let mut values = Vec::new();
        let mut texts = Vec::new();
        let rows = count.div_ceil(layout.per_line);
        for i in 0..rows {
            let line = self.expect(lines, "numbers of the header")?;
            let here = layout.per_line.min(count - i * layout.per_line);
            for k in 0..here {
                let from = k * layout.width;
                let to = (from + layout.width).min(line.bytes.len());
                let field = line.bytes.get(from..to).unwrap_or(&[]);
                values.push(number::parse(field).ok());
                texts.push(number::shown(field.trim_ascii()));
            }
        }
        Ok(HeaderNumbers {
            values,
            texts,
            first,
            per_line: layout.per_line,
        })
    }
}

/// Numbers of a header.
pub(crate) struct HeaderNumbers {
    values: Vec<Option<f64>>,
    /// The fields as they stand.
    texts: Vec<String>,
    /// Their first line, from 1.
    pub first: usize,
    per_line: usize,
}

impl HeaderNumbers {
    /// Number `index` (from 1, as specifications count) unless it is blank or
    /// stands for unknown.
    pub(crate) fn get(&self, index: usize) -> Option<f64> {
        let value = self.values.get(index.checked_sub(1)?).copied().flatten()?;
        let unknown = [-999.0, -9999.0, -32768.0, -12345.0].contains(&value);
        (!unknown).then_some(value)
    }

    /// Number `index` with one unit of its last printed digit, unless it is zero, blank or unknown.
    pub(crate) fn printed(&self, index: usize) -> Option<Printed> {
        let value = self.get(index).filter(|value| *value != 0.0)?;
        let text = self.texts.get(index.checked_sub(1)?)?;
        Some((value, number::resolution(text.as_bytes())))
    }

    /// What is to be said of the first of some integers that stands there and cannot be read, for want of which something is
    /// not known.
    pub(crate) fn unread(&self, indices: &[usize], unknown: &str) -> Option<String> {
        let index = indices.iter().copied().find(|index| {
            let at = index.saturating_sub(1);
            let is_there = self.texts.get(at).is_some_and(|text| !text.is_empty());
            is_there && self.values.get(at).copied().flatten().is_none()
        })?;
        Some(format!(
            "line {}: integer {index} of the header {}, which is not a number: {unknown} is not known",
            self.line_of(index),
            self.shown(index)
        ))
    }

    /// Line (from 1) of number `index` (from 1).
    pub(crate) fn line_of(&self, index: usize) -> usize {
        self.first + index.saturating_sub(1) / self.per_line
    }

    /// What stands in the field of number `index`, in words.
    pub(crate) fn shown(&self, index: usize) -> String {
        let text = index.checked_sub(1).and_then(|i| self.texts.get(i));
        match text.map_or("", String::as_str) {
            "" => "is blank".to_owned(),
            text => format!("is \"{text}\""),
        }
    }

    /// Number `index` as a count, unless it is zero or not whole.
    pub(crate) fn count(&self, index: usize) -> Option<usize> {
        self.get(index)
            .filter(|n| n.fract() == 0.0 && (1.0..1.0e9).contains(n))
            .map(|n| n as usize)
    }

    /// Number `index` unless it is zero or negative.
    pub(crate) fn positive(&self, index: usize) -> Option<f64> {
        self.get(index).filter(|n| *n > 0.0)
    }
}
