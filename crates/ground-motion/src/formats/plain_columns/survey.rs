//! A first look at all rows: how many numbers, and how they are arranged.

use super::counter::Counter;
use super::{header, rows};
use crate::error::{GroundMotionError, bound};
use crate::number;
use crate::row_widths::{OddRow, RowWidths};
use crate::source::Source;
use crate::text::Line;
use crate::time_column::TimeColumn;

/// Rows from which on a column that increases evenly is one of times: fewer values of a series
/// along the rows may do so by chance.
const EVEN_ROWS: usize = 4;
/// Rows from which on a column that increases at all is one of times.
const INCREASING_ROWS: usize = 20;
/// Rows from which on a column beside row numbers that increases by one step, but for a few rows,
/// is one of times.
const EVEN_BESIDE_NUMBERS: usize = 8;
/// Columns among which one of times is looked for.
const TIME_AMONG: usize = 16;
/// Values of a row that may be components: agencies print more of one series.
const COMPONENTS: std::ops::RangeInclusive<usize> = 2..=3;
/// Rows from which on values show whether they go on down the columns rather than along the rows.
const SHOWING_ROWS: usize = 20;
/// Part of the mean square of differences along the rows below which those down the columns are of several series.
/// Of one series the next value is no farther than that in the row below, but where its period is a row.
const DOWN_COLUMNS: f64 = 0.1;

/// How the numbers are arranged.
pub(super) enum Arrangement {
    /// One series along the rows.
    Wrapped,
    /// As `Wrapped`, after rows of count and step.
    Headed(Head),
    /// A column each; `t` is the time.
    Columns(Vec<String>),
    /// Rows that end in their own number.
    Cards,
}

/// Rows of a count, or of a count and a step, before the values.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Head {
    pub rows: usize,
    pub count: usize,
    /// Step (s).
    pub step: Option<f64>,
}

/// Steps (s) of a row of count and step.
const SHORTEST_STEP: f64 = 1.0e-5;
const LONGEST_STEP: f64 = 1.0;
/// Counts from which on a whole number that is the number of the values behind it is no chance,
/// also among whole numbers.
const SURE_COUNT: usize = 20;

/// Times by which a first sample may be as large as all others, and as others behind the time step that is known.
const FAR_OUT: f64 = 20.0;
const STEP_BELOW: f64 = 3.0;

/// What to do about a row with another number of values than its neighbours.
const ODD_REMEDY: &str = "correct the row: a value is missing, was parted, as by a decimal comma, or the row is out of its place";

/// What to do about rows that may be times and values or one series.
const ALONG: &str = "if the values follow one another along the rows, say so by `layout = \"a\"` in [ground_motion] of a case, `--layout a` with `pounding motion`";

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
                return Err(super::blocks::text_among_numbers(source, line));
            }
            let length = line.fields().count();
            survey.last_ends(declared);
            survey.add(line.number, length);
        }
        survey.second_may_be_short(source);
        if survey.rows == 0 {
            return Err(source.error(1, 0, "the file has no data", "give a file with values"));
        }
        Ok(survey)
    }

    /// Takes a second and last row of fewer values than a first one of samples for a short one: rows of a header have
    /// whole numbers.
    fn second_may_be_short(&mut self, source: &Source<'_>) {
        let is_short = self.rows == 2 && self.second_length < self.first_length;
        if !is_short || self.first_length <= *COMPONENTS.end() {
            return;
        }
        let mut fields = rows(source).flat_map(|line| line.fields());
        if fields.all(|(_, field)| field.contains(&b'.')) {
            self.second_length = self.first_length;
        }
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

    /// Finds the arrangement from the numbers, and from counts of samples that lines before them state.
    pub(super) fn arrangement(
        &self,
        source: &Source<'_>,
        counts_stated: &[usize],
    ) -> Result<Arrangement, GroundMotionError> {
        if let Some(head) = self.head(source, false)? {
            return Ok(Arrangement::Headed(head));
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
            return Err(self.irregular(source, line));
        }
        let width = self.first_length;
        if width < 2 || self.rows < 2 {
            return Ok(Arrangement::Wrapped);
        }
        self.counts_on(source, width)?;
        if self.pairs_follow(source, width)? {
            return Ok(Arrangement::Columns(named(2, 0, &[])));
        }
        let first_is_time = !short_last && self.first_is_time(source)?;
        if first_is_time && width == 2 {
            return Ok(Arrangement::Columns(named(width, 0, &[])));
        }
        let last_counts = self.rows > 2 && counts(source, None, 1);
        let mut times = Vec::new();
        for k in 0..width.min(TIME_AMONG) {
            let is_last_counter = last_counts && k + 1 == width;
            let is_first = first_is_time && k == 0;
            if is_first || !is_last_counter && self.is_time(source, k)? {
                times.push(k);
            }
        }
        // Pairs of time and value beside one another, all at the same times.
        if width >= 4
            && width.is_multiple_of(2)
            && !last_counts
            && same_times(source, &times, width)?
        {
            let name = |k: usize| match k % 2 {
                0 => "t".to_owned(),
                _ => format!("column_{}", k + 1),
            };
            return Ok(Arrangement::Columns((0..width).map(name).collect()));
        }
        // `1 0.000 0.204`: the row, the time and the value.
        let mut passed = Vec::new();
        let first_counts = || counts(source, Some(0), 0) || counts(source, Some(0), 1);
        if width > 2 && times == [0] && first_counts() {
            for k in 1..width.min(TIME_AMONG) {
                self.goes_on_evenly(source, k)?;
            }
        }
        if times.len() == 2 && times[0] == 0 && first_counts() {
            passed.push(times.remove(0));
        }
        if last_counts && first_is_time && !times.is_empty() {
            passed.push(width - 1);
        }
        if let ([k], false) = (times.as_slice(), passed.is_empty())
            && passed.len() + 1 < width
        {
            for passed in &passed {
                source.warn(&format!(
                    "column {} counts the rows and is not data",
                    passed + 1
                ));
            }
            return Ok(Arrangement::Columns(named(width, *k, &passed)));
        }
        match (times.as_slice(), last_counts) {
            ([], true) => Ok(Arrangement::Cards),
            ([], false) => self.components(source, width, counts_stated),
            ([k], false) => Ok(Arrangement::Columns(named(width, *k, &[]))),
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

    /// Refuses a number of a first or last column that does not go on from the one before, where
    /// most count the rows.
    fn counts_on(&self, source: &Source<'_>, width: usize) -> Result<(), GroundMotionError> {
        let (mut first, mut last) = (Counter::default(), Counter::default());
        let mut inner = true;
        for line in rows(source) {
            let mut fields = line.fields().peekable();
            let mut k = 0;
            while let Some((column, field)) = fields.next() {
                let column = column + source.options.skip_columns;
                if k == 0 {
                    first.see(line.number, column, field);
                } else if fields.peek().is_none() {
                    last.see(line.number, column, field);
                } else {
                    inner &= field.contains(&b'.');
                }
                k += 1;
            }
        }
        // The other one of two columns may have points.
        let pointed = inner && (width > 2 || first.is_none() || last.is_none());
        first.goes_on(source, 1, pointed)?;
        last.goes_on(source, width, pointed)
    }

    /// The values of a column (from 0), and the lines that they stand in.
    fn values_of(
        &self,
        source: &Source<'_>,
        k: usize,
    ) -> Result<(Vec<f64>, Vec<usize>), GroundMotionError> {
        let mut values = Vec::with_capacity(self.rows);
        let mut lines = Vec::with_capacity(self.rows);
        for line in rows(source) {
            let Some((column, field)) = line.fields().nth(k) else {
                continue;
            };
            values.push(source.number(line, column + source.options.skip_columns, field)?);
            lines.push(line.number);
        }
        Ok((values, lines))
    }

    /// Refuses a column (from 0) beside row numbers whose values increase by one step but for a
    /// few, as damaged times do.
    fn goes_on_evenly(&self, source: &Source<'_>, k: usize) -> Result<(), GroundMotionError> {
        let (values, lines) = self.values_of(source, k)?;
        let steps: Vec<f64> = values.windows(2).map(|w| w[1] - w[0]).collect();
        let mut sorted = steps.clone();
        sorted.sort_by(f64::total_cmp);
        let usual = sorted.get(sorted.len() / 2).copied().unwrap_or(0.0);
        let differs = |step: &f64| (step - usual).abs() > 0.25 * usual;
        let others = steps.iter().filter(|step| differs(step)).count();
        let Some(at) = steps.iter().position(differs) else {
            return Ok(());
        };
        if !(usual > 0.0) || values.len() < EVEN_BESIDE_NUMBERS || 3 * others > steps.len() {
            return Ok(());
        }
        Err(source.error(
            lines[at + 1],
            0,
            format!(
                "the values of column {} increase by {} a row, as times do, but {} follows {} here",
                k + 1,
                bound(usual),
                values[at + 1],
                values[at]
            ),
            "correct the row, or get the record again",
        ))
    }

    /// Numbers of a row, where they are as many in each.
    pub(super) fn width(&self) -> usize {
        self.second_length.min(TIME_AMONG)
    }

    /// Whether pairs of time and value follow one another along the rows: `t a t a`, of which each
    /// time is after the one before it, in the row and from row to row, and the values are not.
    fn pairs_follow(&self, source: &Source<'_>, width: usize) -> Result<bool, GroundMotionError> {
        if width < 4 || !width.is_multiple_of(2) {
            return Ok(false);
        }
        let mut times = TimeColumn::with_capacity(0);
        let mut before = [f64::NEG_INFINITY; 2];
        let mut values_rise = true;
        let mut count = 0;
        for line in rows(source) {
            for (k, (column, field)) in line.fields().enumerate() {
                let column = column + source.options.skip_columns;
                let value = source.number(line, column, field)?;
                let rises = value > before[k % 2];
                before[k % 2] = value;
                match k % 2 {
                    0 if !rises => return Ok(false),
                    0 => {
                        count += 1;
                        times.push(line, value, field);
                    }
                    _ => values_rise &= rises,
                }
            }
        }
        let many = count >= INCREASING_ROWS || count >= 2 * EVEN_ROWS && times.is_even();
        Ok(many && !values_rise)
    }

    /// One series along the rows, unless the rows may be those of several components.
    fn components(
        &self,
        source: &Source<'_>,
        width: usize,
        counts_stated: &[usize],
    ) -> Result<Arrangement, GroundMotionError> {
        if self.rows >= INCREASING_ROWS {
            for k in 0..width.min(TIME_AMONG) {
                self.breaks_times(source, k)?;
            }
        }
        let names = header::name_lines(super::before(source));
        let named = rows(source)
            .next()
            .and_then(|row| names.last().filter(|names| names.names_columns(&row)));
        if let Some(names) = named {
            let own = format!("`layout = \"{}\"`, or ", names.as_layout());
            return Err(self.asks(source, width, "", &own));
        }
        self.is_one_series(source, counts_stated)?;
        Ok(Arrangement::Wrapped)
    }

    /// Refuses rows of two or three values, which may be as many components, and rows of more that go on down the
    /// columns, unless a count of samples says that they are one series along the rows.
    pub(super) fn is_one_series(
        &self,
        source: &Source<'_>,
        counts_stated: &[usize],
    ) -> Result<(), GroundMotionError> {
        let width = self.second_length;
        let may = width > 1 && self.rows > EVEN_ROWS;
        // Zeros may fill the last row.
        let all = self.numbers + 1 - width.min(self.numbers)..=self.numbers;
        if !may || counts_stated.iter().any(|count| all.contains(count)) {
            return Ok(());
        }
        let as_many_rows = counts_stated.contains(&self.rows);
        if !COMPONENTS.contains(&width) && !as_many_rows && !self.goes_down(source, width)? {
            return Ok(());
        }
        none_touch(source)?;
        let counted = match as_many_rows {
            true => "; as many rows as the header counts samples are those of components",
            false => "",
        };
        Err(self.asks(source, width, counted, ""))
    }

    /// Whether the values go on down the columns rather than along the rows, as those of as many series do.
    fn goes_down(&self, source: &Source<'_>, width: usize) -> Result<bool, GroundMotionError> {
        if self.rows < SHOWING_ROWS || self.first_length != width {
            return Ok(false);
        }
        let mut above = Vec::with_capacity(width);
        let mut row = Vec::with_capacity(width);
        let (mut along, mut down) = (0.0, 0.0);
        for line in rows(source) {
            row.clear();
            for (column, field) in line.fields() {
                row.push(source.number(line, column + source.options.skip_columns, field)?);
            }
            // From the end of the row above to the start of this one it goes on along the rows.
            let before = above.last().copied().into_iter().chain(row.iter().copied());
            let behind = row.iter().skip(usize::from(above.is_empty()));
            along += before
                .zip(behind)
                .map(|(a, b): (f64, &f64)| (b - a).powi(2))
                .sum::<f64>();
            down += above
                .iter()
                .zip(&row)
                .map(|(a, b): (&f64, &f64)| (b - a).powi(2))
                .sum::<f64>();
            std::mem::swap(&mut above, &mut row);
        }
        Ok(down < DOWN_COLUMNS * along)
    }

    /// The question what the values of a row are.
    fn asks(
        &self,
        source: &Source<'_>,
        width: usize,
        counted: &str,
        own: &str,
    ) -> GroundMotionError {
        source.error(
            self.first,
            0,
            format!(
                "rows of {width} values, of which none is a time: {width} components beside one another, or one series along the rows{counted}?"
            ),
            &format!("give {own}`layout` with a name for each column, such as \"ns,ew\" or \"ns,ew,ud\" (`-` passes one over), and choose one by `component`; or \"a\" if the values follow one another along the rows"),
        )
    }

    /// Refuses a column (from 0) whose values increase as times do, but for a few.
    fn breaks_times(&self, source: &Source<'_>, k: usize) -> Result<(), GroundMotionError> {
        let (values, lines) = self.values_of(source, k)?;
        let Some(Some(at)) = nearly_times(&values) else {
            return Ok(());
        };
        Err(source.error(
            lines[at],
            0,
            format!(
                "the values of column {} increase as times do, but {} is not after {}",
                k + 1,
                values[at],
                values[at - 1]
            ),
            &match (at, self.first_length == self.second_length) {
                // A whole row that is passed over would be one of values that are lost.
                (1, true) => format!(
                    "{ALONG}; if column {} has the times, they must increase: correct the first row, or take it out if it is none of values",
                    k + 1
                ),
                (1, false) => format!(
                    "{}; times must increase: if it is one, correct it",
                    super::skipping(lines[0])
                ),
                _ => format!(
                    "{ALONG}; times must increase, and need enough decimals: correct the row, or get the record again; without them, `layout = \"-,a\"` and `time_step` read the values"
                ),
            },
        ))
    }

    /// What is wrong with a row that has another number of values than its neighbours.
    fn irregular(&self, source: &Source<'_>, line: usize) -> GroundMotionError {
        let message = "this row has another number of values than its neighbours";
        let free = || self.ragged.is_some() && odd_row(source, 0).is_none();
        if line == self.first && !free() {
            return source.error(
                line,
                0,
                message,
                &format!(
                    "if it is no row of values, {}; if it is one, correct it",
                    super::skipping(line)
                ),
            );
        }
        match odd_row(source, 0) {
            Some(odd) => source.error(odd.line, 0, odd.message(), ODD_REMEDY),
            None => source.error(
                line,
                0,
                message,
                "correct the row, or give `layout = \"a\"` if the values follow one another along the rows",
            ),
        }
    }

    /// Refuses rows that the user says to be one series along them, of which one inside is no such
    /// row, or the first is none.
    pub(super) fn regular(
        &self,
        source: &Source<'_>,
        head: Option<Head>,
    ) -> Result<(), GroundMotionError> {
        let skipped = head.map_or(0, |head| head.rows);
        if let Some(odd) = odd_row(source, skipped) {
            none_touch(source)?;
            return Err(match odd.line == self.first {
                true => self.irregular(source, odd.line),
                false => source.error(odd.line, 0, odd.message(), ODD_REMEDY),
            });
        }
        let Some(line) = rows(source).next().filter(|_| head.is_none()) else {
            return Ok(());
        };
        let whole = |field: &[u8]| {
            let count = number::parse(field)
                .ok()
                .filter(|_| !field.contains(&b'.'))?;
            Some(count).filter(|count| count.fract() == 0.0)
        };
        let fields: Vec<&[u8]> = line.fields().map(|(_, field)| field).collect();
        let rest = self.numbers - fields.len();
        let is_count = |field: &&[u8]| whole(field) == Some(rest as f64);
        let points = || {
            let mut others = rows(source).skip(1).flat_map(|l| l.fields());
            others.all(|(_, field)| field.contains(&b'.'))
        };
        let counted = rest >= SURE_COUNT || points();
        let odd = fields.len() != self.second_length && fields.len() > 1;
        let alone =
            fields.len() == 1 && *COMPONENTS.end() < self.second_length && self.rows > EVEN_ROWS;
        let numbers = odd && fields.iter().all(|f| whole(f).is_some()) && self.rows > 2 && points();
        let counts = fields.len() > 1 && fields.iter().any(is_count) && counted;
        if !(counts || numbers || alone) {
            return Ok(());
        }
        Err(source.error(
            line.number,
            0,
            format!(
                "the first row, \"{}\", is no row of samples: numbers of a header above {rest} values",
                line.text().trim()
            ),
            &super::skipping(line.number),
        ))
    }

    /// A first row of a count, or of count and step, above columns of which the first has the times,
    /// or that the user names: its line, and what it says.
    pub(super) fn head_of_columns(
        &self,
        source: &Source<'_>,
        width: usize,
    ) -> Result<Option<(usize, Head)>, GroundMotionError> {
        let count = self.rows - 1;
        let Some(line) = rows(source).next().filter(|_| count >= 2) else {
            return Ok(None);
        };
        if self.first_length > 2 || self.second_length < 2 || self.second_length < width {
            return Ok(None);
        }
        let mut said = None;
        let mut step = None;
        for (column, field) in line.fields() {
            let value = source.number(line, column + source.options.skip_columns, field)?;
            let is_count = value == count as f64;
            let sure = count >= SURE_COUNT || !field.contains(&b'.');
            match is_count && sure && said.is_none() {
                true => said = Some(count),
                false => step = Some(value),
            }
        }
        let is_step = step.is_none_or(|step| step > 0.0 && step <= 1.0);
        let Some(count) = said.filter(|_| is_step) else {
            return Ok(None);
        };
        let mut times = TimeColumn::with_capacity(count);
        let mut before = f64::NEG_INFINITY;
        for line in rows(source).skip(1) {
            let Some((column, field)) = line.fields().next() else {
                return Ok(None);
            };
            let time = source.number(line, column + source.options.skip_columns, field)?;
            if !(time > before) || line.fields().count() != self.second_length {
                return Ok(None);
            }
            before = time;
            times.push(line, time, field);
        }
        let rows = 1;
        let head = Head { rows, count, step };
        Ok(times.is_even().then_some((line.number, head)))
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

    /// First rows of a count and a step, or of a count, if the other rows bear them out. `declared`:
    /// the user has said that the values follow one another along the rows.
    ///
    /// # Errors
    /// A first number alone that is the step which the user gives.
    pub(super) fn head(
        &self,
        source: &Source<'_>,
        declared: bool,
    ) -> Result<Option<Head>, GroundMotionError> {
        let mut lines = rows(source);
        let (Some(line), Some(next)) = (lines.next(), lines.next()) else {
            return Ok(None);
        };
        let mut fields = line.fields();
        let Some((at, first)) = fields.next() else {
            return Ok(None);
        };
        let column = at + source.options.skip_columns;
        let value = source.number(line, column, first)?;
        let whole = |field: &[u8]| {
            let count = number::parse(field)
                .ok()
                .filter(|_| !field.contains(&b'.'))?;
            let is_count = count.fract() == 0.0 && (2.0..1.0e9).contains(&count);
            is_count.then_some(count as usize)
        };
        // Samples have signs and sizes that no step has.
        let is_step = |step: f64| (SHORTEST_STEP..=LONGEST_STEP).contains(&step);
        let signed = |field: &[u8]| field.starts_with(b"+") || field.starts_with(b"-");
        let step_in = |field: &[u8]| {
            let step = number::parse(field).ok()?;
            Some(step).filter(|step| is_step(*step) && !signed(field))
        };
        // As `7.6150000e+03`, which counts where so many values are behind it.
        let exact = |field: &[u8], rest: usize| {
            let is_rest = number::parse(field).is_ok_and(|count| count == rest as f64);
            (is_rest && rest >= SURE_COUNT).then_some(rest)
        };
        if self.first_length == 2 {
            let Some((_, second)) = fields.next() else {
                return Ok(None);
            };
            let rest = self.numbers - 2;
            let unlike = self.second_length != 2 && !declared;
            let of = |count: &[u8], step: &[u8]| {
                let count = whole(count).or_else(|| exact(count, rest));
                count.zip(step_in(step))
            };
            let head = of(first, second)
                .filter(|(count, _)| unlike || rest == *count)
                .or_else(|| of(second, first).filter(|(count, _)| rest == *count));
            return Ok(head.map(|(count, step)| Head {
                rows: 1,
                count,
                step: Some(step),
            }));
        }
        if self.first_length != 1 {
            return Ok(None);
        }
        // A whole number may be the first of samples that are whole numbers.
        let pointed = |skipped: usize| {
            let mut others = rows(source).skip(skipped).flat_map(|l| l.fields());
            others.all(|(_, field)| field.contains(&b'.'))
        };
        let sure = |count: usize, skipped: usize| count >= SURE_COUNT || pointed(skipped);
        let second = next.fields().next().filter(|_| self.second_length == 1);
        if let Some((_, second)) = second {
            let either = [(first, second), (second, first)];
            let both = |(count, step): (&[u8], &[u8])| {
                let count = whole(count).or_else(|| exact(count, self.numbers - 2));
                count.zip(step_in(step))
            };
            let fits = |(count, _): &(usize, f64)| count + 2 == self.numbers && sure(*count, 2);
            if let Some((count, step)) = either.into_iter().filter_map(both).find(fits) {
                let other = |given: f64| (given - step).abs() > 1.0e-6 * step;
                if let Some(given) = source.options.time_step.filter(|given| other(*given)) {
                    return Err(step_or_sample(source, line.number, (count, step), given));
                }
                return Ok(Some(Head {
                    rows: 2,
                    count,
                    step: Some(step),
                }));
            }
        }
        let alone = |count: &usize| {
            let fits = count + 1 == self.numbers && sure(*count, 1);
            // Another count of samples is said of them.
            let along = self.second_length == 1 || self.second_length > 3;
            fits || along && *count >= SURE_COUNT && pointed(1)
        };
        let count = whole(first).or_else(|| exact(first, self.numbers - 1));
        if let Some(count) = count.filter(alone) {
            return Ok(Some(Head {
                rows: 1,
                count,
                step: None,
            }));
        }
        let given = |step: f64| (value - step).abs() <= 1.0e-9 * step;
        let said = declared && self.second_length == 1;
        if source.options.time_step.is_some_and(given) && !said {
            return Err(source.error(
                line.number,
                column,
                format!(
                    "the first value, {value}, stands alone and is the time step that is given: the step, or the first sample?"
                ),
                &format!(
                    "{}{}",
                    super::skipping(line.number),
                    match declared {
                        true => "",
                        false => "; if it is the first sample of one value a row, say so by `layout = \"a\"`",
                    }
                ),
            ));
        }
        Ok(None)
    }

    /// Refuses a first value, of values that stand one in a row, that is many times as large as all behind the second
    /// one, which may be a time step: a factor or a count and a step. `stated`: the time step (s) that is known.
    ///
    /// # Errors
    /// At the first value.
    pub(super) fn starts_as_samples(
        &self,
        source: &Source<'_>,
        stated: Option<f64>,
    ) -> Result<(), GroundMotionError> {
        if self.first_length != 1 || self.second_length != 1 || self.numbers < SURE_COUNT {
            return Ok(());
        }
        let value = |line: Line<'_>| {
            let (column, field) = line.fields().next().unwrap_or_default();
            source.number(line, column + source.options.skip_columns, field)
        };
        let mut lines = rows(source);
        let (Some(line), Some(next)) = (lines.next(), lines.next()) else {
            return Ok(());
        };
        let (first, second) = (value(line)?, value(next)?);
        let (mut largest, mut before, mut jump) = (0.0_f64, second, 0.0_f64);
        for line in lines {
            let found = value(line)?;
            largest = largest.max(found.abs());
            jump = jump.max((found - before).abs());
            before = found;
        }
        let is_stated = stated.is_some_and(|step| (second - step).abs() <= 1.0e-9 * step);
        let least = if is_stated { STEP_BELOW } else { FAR_OUT };
        // `1` above the step that is known is a factor, too, and so is a whole number farther from the value below it
        // than any other is from the next one.
        let is_whole = first >= 1.0 && first.fract() == 0.0 && !line.bytes.contains(&b'.');
        let is_factor = first == 1.0 && is_stated || is_whole && (first - second).abs() > jump;
        let far_out = largest > 0.0 && (first.abs() > least * largest || is_factor);
        if !(far_out && (SHORTEST_STEP..=LONGEST_STEP).contains(&second)) {
            return Ok(());
        }
        Err(source.error(
            line.number,
            0,
            format!(
                "the first value is {first} and the second {second}, where the largest behind them is {}: a factor or a count, and a time step, before the samples?",
                bound(largest)
            ),
            &format!(
                "{}, give `time_step`, and a factor of the samples by `scale`; if both are samples, say so by `layout = \"a\"`",
                super::skipping(next.number)
            ),
        ))
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

/// The error of a count above a value that is another step than the one given, or the first sample
/// if the count is one too small.
fn step_or_sample(
    source: &Source<'_>,
    line: usize,
    (count, step): (usize, f64),
    given: f64,
) -> GroundMotionError {
    let behind = count + 1;
    source.error(
        line,
        0,
        format!(
            "the first two values, {count} and {step}, are count and step of the {count} values behind them, but a time step of {given} s is given; or the count is one too small for the {behind} values behind it"
        ),
        &format!(
            "to read {count} values at {step} s, do not give the time step; to read {behind} values at {given} s, {}",
            super::skipping(line)
        ),
    )
}

/// Whether all but a few of a column of values increase as times do: the place (from 0) of the first
/// that does not, or none. Values of a motion fall as often as they rise.
pub(super) fn nearly_times(values: &[f64]) -> Option<Option<usize>> {
    if values.len() < INCREASING_ROWS {
        return None;
    }
    let steps = || values.windows(2).map(|w| w[1] - w[0]);
    let (mut rising, mut falling) = (0_usize, 0_usize);
    for step in steps() {
        rising += usize::from(step > 0.0);
        falling += usize::from(step < 0.0);
    }
    let all = values.len() - 1;
    // A motion may stand still for long.
    let longest = values
        .chunk_by(|a, b| a == b)
        .map(<[f64]>::len)
        .max()
        .unwrap_or(0);
    let as_times = 20 * falling <= all.max(20) && 5 * rising >= all && longest <= all / 4;
    as_times.then(|| steps().position(|step| !(step > 0.0)).map(|at| at + 1))
}

/// Whether every second column, from the first one, holds the same times.
fn same_times(
    source: &Source<'_>,
    times: &[usize],
    width: usize,
) -> Result<bool, GroundMotionError> {
    if !times.iter().copied().eq((0..width).step_by(2)) {
        return Ok(false);
    }
    for line in rows(source) {
        let mut first = None;
        for (column, field) in line.fields().step_by(2) {
            let time = source.number(line, column + source.options.skip_columns, field)?;
            if *first.get_or_insert(time) != time {
                return Ok(false);
            }
        }
    }
    Ok(true)
}

/// Names of so many columns, of which one (from 0) holds the times and some are passed over.
fn named(width: usize, time: usize, passed: &[usize]) -> Vec<String> {
    let values = width - 1 - passed.len();
    let name = |k: usize| match (k == time, values) {
        (true, _) => "t".to_owned(),
        (false, _) if passed.contains(&k) => "-".to_owned(),
        (false, 1) => "a".to_owned(),
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

/// The first of a few rows that have another number of values than all others, after the first few.
fn odd_row(source: &Source<'_>, skipped: usize) -> Option<OddRow> {
    let mut widths = RowWidths::default();
    for line in rows(source).skip(skipped) {
        widths.see(line.number, line.fields().count());
    }
    widths.odd()
}

/// Whether a column (from 0; `None`: the last of each row) counts on from a number: 1, 2, 3, ...
fn counts(source: &Source<'_>, k: Option<usize>, from: usize) -> bool {
    rows(source).enumerate().all(|(i, line)| {
        let mut fields = line.fields();
        let field = match k {
            Some(k) => fields.nth(k),
            None => fields.last(),
        };
        field.is_some_and(|(_, f)| {
            !f.contains(&b'.') && number::parse(f).is_ok_and(|n| n == (i + from) as f64)
        })
    })
}
