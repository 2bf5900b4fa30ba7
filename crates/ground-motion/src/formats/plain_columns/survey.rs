//! A first look at all rows: how many numbers, and how they are arranged.

use super::rows;
use crate::error::GroundMotionError;
use crate::number;
use crate::source::Source;
use crate::time_column::TimeColumn;

/// How the numbers are arranged.
pub(super) enum Arrangement {
    /// One series along the rows.
    Wrapped,
    /// As `Wrapped`, after a row of count and step.
    CountAndStep(usize, f64),
    /// A column each; `t` is the time.
    Columns(Vec<String>),
    /// Rows that end in their own number.
    Cards,
}

/// What was seen.
pub(super) struct Survey {
    /// Numbers in all rows.
    pub numbers: usize,
    /// Lines of the first and last row, from 1.
    pub first: usize,
    pub last: usize,
    rows: usize,
    /// Numbers of the first, second and last row, and the first row that differs
    /// from the second.
    first_length: usize,
    second_length: usize,
    last_length: usize,
    ragged: Option<usize>,
}

impl Survey {
    /// Looks at all rows; `declared`: the user has said how they are arranged.
    pub(super) fn new(source: &Source<'_>, declared: bool) -> Result<Self, GroundMotionError> {
        let mut survey = Self {
            numbers: 0,
            first: 0,
            last: 0,
            rows: 0,
            first_length: 0,
            second_length: 0,
            last_length: 0,
            ragged: None,
        };
        for line in rows(source) {
            if line.is_text() {
                return Err(source.error(
                    line.number,
                    0,
                    "text among the numbers",
                    "remove the line, or start it with #",
                ));
            }
            let length = line.fields().count();
            survey.last_ends(declared);
            survey.add(line.number, length);
        }
        if survey.rows == 0 {
            return Err(source.error(1, 0, "the file has no data", "give a file with values"));
        }
        Ok(survey)
    }

    /// The row before is not the last one: a short one is ragged.
    fn last_ends(&mut self, declared: bool) {
        if !declared
            && self.rows > 1
            && self.last_length != self.second_length
            && self.ragged.is_none()
        {
            self.ragged = Some(self.last);
        }
    }

    fn add(&mut self, line: usize, length: usize) {
        self.rows += 1;
        self.numbers += length;
        match self.rows {
            1 => {
                self.first = line;
                self.first_length = length;
                self.second_length = length;
            }
            2 => self.second_length = length,
            _ => {}
        }
        self.last = line;
        self.last_length = length;
    }

    /// Finds the arrangement from the numbers.
    pub(super) fn arrangement(
        &self,
        source: &Source<'_>,
    ) -> Result<Arrangement, GroundMotionError> {
        if let Some((count, step)) = self.count_and_step(source)? {
            return Ok(Arrangement::CountAndStep(count, step));
        }
        let short_last = self.last_length < self.second_length;
        let odd = if self.first_length != self.second_length && !(self.rows == 2 && short_last) {
            Some(self.first)
        } else if self.last_length > self.second_length {
            Some(self.last)
        } else {
            self.ragged
        };
        if let Some(line) = odd {
            none_touch(source)?;
            return Err(source.error(
                line,
                0,
                "this row has another number of values than its neighbours",
                "correct the row, or give `layout = \"a\"` if the values follow one another along the rows",
            ));
        }
        let width = self.first_length;
        if width < 2 || self.rows < 2 {
            return Ok(Arrangement::Wrapped);
        }
        if !short_last && self.first_is_time(source)? {
            let names = match width {
                2 => vec!["t".to_owned(), "a".to_owned()],
                _ => std::iter::once("t".to_owned())
                    .chain((2..=width).map(|k| format!("column_{k}")))
                    .collect(),
            };
            return Ok(Arrangement::Columns(names));
        }
        if width > 2 && self.rows > 2 && last_counts(source) {
            return Ok(Arrangement::Cards);
        }
        Ok(Arrangement::Wrapped)
    }

    /// A first row of count and step, if the other rows bear it out.
    fn count_and_step(
        &self,
        source: &Source<'_>,
    ) -> Result<Option<(usize, f64)>, GroundMotionError> {
        if self.first_length != 2 || self.rows < 2 {
            return Ok(None);
        }
        let Some(line) = rows(source).next() else {
            return Ok(None);
        };
        let mut fields = line.fields();
        let (Some((at, count)), Some((_, step))) = (fields.next(), fields.next()) else {
            return Ok(None);
        };
        if count.contains(&b'.') {
            return Ok(None);
        }
        let count = source.number(line, at, count)?;
        let step = number::parse(step).unwrap_or(0.0);
        let plausible = count.fract() == 0.0 && (2.0..1.0e9).contains(&count);
        let rest = self.numbers - 2;
        let borne_out = self.second_length != 2 || rest == count as usize;
        Ok((plausible && step > 0.0 && step <= 1.0 && borne_out).then_some((count as usize, step)))
    }

    /// Whether the first column increases from row to row, as times do, and starts
    /// at zero or at one step.
    fn first_is_time(&self, source: &Source<'_>) -> Result<bool, GroundMotionError> {
        let mut times = TimeColumn::with_capacity(0);
        let mut before = f64::NEG_INFINITY;
        let mut start = Vec::new();
        for line in rows(source) {
            let Some((column, field)) = line.fields().next() else {
                return Ok(false);
            };
            let time = source.number(line, column, field)?;
            if !(time > before) {
                return Ok(false);
            }
            before = time;
            if start.len() < 2 {
                start.push(time);
                times.push(time, field);
            }
        }
        let step = start[1] - start[0];
        Ok(start[0].abs() <= 0.01 * step || (start[0] - step).abs() <= 0.1 * step)
    }
}

/// Names numbers that touch as what is wrong with a row that has fewer fields than the others.
fn none_touch(source: &Source<'_>) -> Result<(), GroundMotionError> {
    for line in rows(source) {
        for (column, field) in line.fields().filter(|(_, f)| number::touching(f)) {
            source.number(line, column + source.options.skip_columns, field)?;
        }
    }
    Ok(())
}

/// Whether the last column counts 1, 2, 3, ...
fn last_counts(source: &Source<'_>) -> bool {
    rows(source).enumerate().all(|(i, line)| {
        line.fields().last().is_some_and(|(_, f)| {
            !f.contains(&b'.') && number::parse(f).is_ok_and(|n| n == (i + 1) as f64)
        })
    })
}
