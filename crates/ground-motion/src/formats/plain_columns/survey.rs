//! A first look at all rows: how many numbers, and how they are arranged.

use super::{header, rows};
use crate::error::GroundMotionError;
use crate::number;
use crate::source::Source;
use crate::time_column::TimeColumn;

/// Rows from which on a column that increases evenly is one of times: fewer values of a series
/// along the rows may do so by chance.
const EVEN_ROWS: usize = 4;
/// Rows from which on a column that increases at all is one of times.
const INCREASING_ROWS: usize = 20;
/// Columns among which one of times is looked for.
const TIME_AMONG: usize = 16;
/// Values of a row that may be components: agencies print more of one series.
const COMPONENTS: std::ops::RangeInclusive<usize> = 2..=3;

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
            return Ok(Arrangement::Columns(named(width, 0)));
        }
        let counts = self.rows > 2 && last_counts(source);
        let mut times = Vec::new();
        for k in 0..width.min(TIME_AMONG) {
            if !(counts && k + 1 == width) && self.is_time(source, k)? {
                times.push(k);
            }
        }
        match (times.as_slice(), counts) {
            ([], true) => Ok(Arrangement::Cards),
            ([], false) => self.components(source, width),
            ([k], false) => Ok(Arrangement::Columns(named(width, *k))),
            ([k, ..], _) => Err(source.error(
                self.first,
                0,
                format!(
                    "the values of column {} increase as times do, and so do those of column {}",
                    k + 1,
                    times.get(1).map_or(width, |other| other + 1)
                ),
                "say what the columns are with `layout`, such as \"t,a\" or \"-,t,a\"; \"a\" if the values follow one another along the rows",
            )),
        }
    }

    /// One series along the rows, unless the rows may be those of several components.
    fn components(
        &self,
        source: &Source<'_>,
        width: usize,
    ) -> Result<Arrangement, GroundMotionError> {
        let before = source.all_lines().skip(source.options.skip_lines);
        let before = before.take_while(|l| l.number < self.first).last();
        let named = before.is_some_and(|l| header::names_components(&l, width));
        let many = COMPONENTS.contains(&width) && self.rows > EVEN_ROWS;
        if !(named || many) {
            return Ok(Arrangement::Wrapped);
        }
        Err(source.error(
            self.first,
            0,
            format!(
                "rows of {width} values, of which none is a time: {width} components beside one another, or one series along the rows?"
            ),
            "give `layout` with a name for each column, such as \"ns,ew\" or \"ns,ew,ud\" (`-` passes one over), and choose one by `component`; or \"a\" if the values follow one another along the rows",
        ))
    }

    /// Whether the values of a column (from 0) increase evenly, or for long at all, as times do
    /// wherever they start. A last row may be short.
    fn is_time(&self, source: &Source<'_>, k: usize) -> Result<bool, GroundMotionError> {
        let mut times = TimeColumn::with_capacity(0);
        let mut before = f64::NEG_INFINITY;
        let mut count = 0;
        for line in rows(source) {
            let Some((column, field)) = line.fields().nth(k) else {
                continue;
            };
            let column = column + source.options.skip_columns;
            let time = source.number(line, column, field)?;
            if !(time > before) {
                return Ok(false);
            }
            before = time;
            count += 1;
            times.push(line, time, field);
        }
        Ok(count >= INCREASING_ROWS || count >= EVEN_ROWS && times.is_even())
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
                times.push(line, time, field);
            }
        }
        let step = start[1] - start[0];
        Ok(start[0].abs() <= 0.01 * step || (start[0] - step).abs() <= 0.1 * step)
    }
}

/// Names of so many columns, of which one (from 0) holds the times.
fn named(width: usize, time: usize) -> Vec<String> {
    let name = |k: usize| match (k == time, width) {
        (true, _) => "t".to_owned(),
        (false, 2) => "a".to_owned(),
        (false, _) => format!("column_{}", k + 1),
    };
    (0..width).map(name).collect()
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
