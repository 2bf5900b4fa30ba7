//! Columns by name: the times, the components, and what is passed over.

use super::column_name::Role;
use super::counter::Counter;
use super::header;
use super::names;
use super::survey::{Survey, nearly_times};
use super::thousands::Thousands;
use super::{Header, OTHERS, Said, ends_within_a_number, rows};
use crate::cut_numbers::Forms;
use crate::error::GroundMotionError;
use crate::quantity::SeriesUnit;
use crate::recording::Series;
use crate::source::Source;
use crate::text::Line;
use crate::time_column::{TimeColumn, Times};

/// Columns by name, as they stand in the rows.
pub(super) struct Columns {
    pub names: Vec<String>,
    /// Unit of each, where the file states it.
    pub units: Vec<Option<SeriesUnit>>,
    /// One unit of the times (s).
    time_unit: f64,
    /// Whether pairs `t,a` may follow one another along a row.
    pairs: bool,
    /// Whether the user or a header names them, not the numbers.
    pub declared: bool,
    /// What stands between the cells of rows, which may be blank; `None`: anything.
    pub separator: Option<u8>,
}

impl Columns {
    /// Columns that the user or the numbers name; units are those of a header that has as
    /// many columns.
    pub(super) fn new(names: Vec<String>, header: Option<&Header>) -> Self {
        let roles = header.map_or(&[][..], |h| &h.columns);
        let roles = if roles.len() == names.len() {
            roles
        } else {
            &[]
        };
        let mut columns = Self::of_roles(roles);
        columns.units.resize(names.len(), None);
        columns.pairs = names.len() == 2 && names[0] == "t" && header.is_none();
        columns.names = names;
        columns
    }

    pub(super) fn of_roles(roles: &[Role]) -> Self {
        let several = roles
            .iter()
            .filter(|r| matches!(r, Role::Acceleration(..)))
            .count()
            > 1;
        let mut columns = Self {
            names: Vec::new(),
            units: Vec::new(),
            time_unit: 1.0,
            pairs: false,
            declared: true,
            separator: None,
        };
        for (k, role) in roles.iter().enumerate() {
            let (name, unit) = match role {
                Role::Time(unit) => {
                    columns.time_unit = *unit;
                    ("t".to_owned(), None)
                }
                // The name of one that says no more than that it is an acceleration.
                Role::Acceleration(name, unit) if !several && names::is_acceleration(name) => {
                    ("a".to_owned(), *unit)
                }
                // Names that mean something else here, or stand twice.
                Role::Acceleration(name, unit) => {
                    let other = ["t", "v", "d"].contains(&name.as_str()) && several;
                    let taken =
                        other || OTHERS.contains(&name.as_str()) || columns.names.contains(name);
                    let name = match (taken, several) {
                        (false, _) => name.clone(),
                        (true, true) => format!("column_{}", k + 1),
                        (true, false) => "a".to_owned(),
                    };
                    (name, *unit)
                }
                Role::Other => ("-".to_owned(), None),
            };
            columns.names.push(name);
            columns.units.push(unit);
        }
        columns
    }
}

/// What the rows of columns hold.
struct Table<'c> {
    columns: &'c Columns,
    /// Place of the column of times, from 0.
    main_time: Option<usize>,
    times: TimeColumn,
    values: Vec<Column>,
}

/// A column as it is read.
#[derive(Default)]
struct Column {
    values: Vec<f64>,
    forms: Forms,
    thousands: Thousands,
    counter: Counter,
    /// Line and place of the first cell that is blank.
    ended: Option<(usize, usize)>,
}

impl Table<'_> {
    fn is_value(&self, k: usize) -> bool {
        let names = &self.columns.names;
        names[k] != "t" && !is_other(names, &names[k])
    }

    /// Whether the last number of the last row is whole, held against the others of its column.
    ///
    /// # Errors
    /// It is cut off, unless the user takes what is there: without its row.
    fn ends_whole(&self, source: &Source<'_>) -> Result<bool, GroundMotionError> {
        let cells = |line: &Line<'_>| header::row_cells(line, self.columns.separator).len();
        let last = rows(source).last().map_or(0, |line| cells(&line));
        let count = self.columns.names.len();
        let Some(place) = last.checked_sub(1).map(|last| last % count) else {
            return Ok(true);
        };
        let is_read = self.is_value(place) || self.columns.names[place] == "t";
        if !is_read || !ends_within_a_number(source) {
            return Ok(true);
        }
        let values = rows(source).flat_map(|line| {
            let cells = header::row_cells(&line, self.columns.separator).into_iter();
            let of_column = cells.skip(place).step_by(count);
            of_column.map(move |(at, cell)| (line, at + source.options.skip_columns, cell))
        });
        source.is_last_whole(values)
    }

    /// Adds a row.
    fn row(&mut self, source: &Source<'_>, line: Line<'_>) -> Result<(), GroundMotionError> {
        let columns = self.columns;
        let count = columns.names.len();
        let cells = header::row_cells(&line, columns.separator);
        let found = cells.len();
        let fits = found == count
            || columns.separator.is_some() && found < count
            || columns.pairs && found.is_multiple_of(2);
        if !fits {
            let error = columns.other_row(source, line, found);
            // A later row may be damaged, the first one shows what columns there are.
            let is_first = self.values.iter().all(|column| column.values.is_empty());
            return Err(match columns.declared && is_first {
                true => error.of_option("layout"),
                false => error,
            });
        }
        let at = |i: usize| cells.get(i).copied().unwrap_or((line.bytes.len(), b""));
        // Columns that ended before others do so are blank below.
        let blank = |i: usize| {
            let (_, cell) = at(i);
            cell.is_empty() || cell.eq_ignore_ascii_case(b"nan")
        };
        let any = (0..count).any(|k| self.is_value(k) && !blank(k));
        if !any && self.main_time.is_none_or(blank) && columns.separator.is_some() {
            return Ok(());
        }
        let mut time = f64::NAN;
        for i in 0..found.max(count) {
            let k = i % count;
            let (is_time, is_value) = (columns.names[k] == "t", self.is_value(k));
            let is_main = Some(k) == self.main_time;
            let (column, cell) = at(i);
            let column = column + source.options.skip_columns;
            if !is_time && !is_value {
                // What is passed over is a number all the same, or damaged.
                if columns.separator.is_none() && !blank(i) {
                    source.number(line, column, cell)?;
                }
                self.values[k].counter.see(line.number, column, cell);
                continue;
            }
            let beside_none = is_time && !is_main && k + 1 < count && blank(i + 1);
            if blank(i) && any && (is_value || beside_none) {
                if is_value {
                    self.values[k].ended.get_or_insert((line.number, i));
                }
                continue;
            }
            let value = source.number(line, column, cell)?;
            if is_main {
                time = value;
                self.times.push(line, value, cell);
            } else if is_time {
                if (value - time).abs() > 1.0e-9 * time.abs().max(1.0) {
                    return Err(source.error(
                        line.number,
                        column,
                        format!("two columns of times, which differ: {time} and {value}"),
                        "say which one belongs to the values by `layout`, which passes the others over by `-`: \"t,a,-,-\" and \"-,-,t,a\" are two components",
                    ));
                }
            } else {
                self.values[k].push(source, (line.number, column), value, cell)?;
            }
        }
        Ok(())
    }
}

impl Column {
    /// Adds a value of a line, which starts at a column (from 0).
    fn push(
        &mut self,
        source: &Source<'_>,
        (line, column): (usize, usize),
        value: f64,
        cell: &[u8],
    ) -> Result<(), GroundMotionError> {
        if let Some((line, place)) = self.ended {
            return Err(source.error(
                line,
                0,
                format!(
                    "a value is missing in column {}, which goes on below",
                    place + 1
                ),
                "write the value that is missing, or get the record again",
            ));
        }
        self.forms.see(line, column, cell);
        self.thousands.see(line, column, cell);
        self.values.push(value);
        Ok(())
    }
}

impl Columns {
    /// The error of a row with another number of columns.
    fn other_row(&self, source: &Source<'_>, line: Line<'_>, found: usize) -> GroundMotionError {
        let count = self.names.len();
        let (what, remedy) = match self.declared {
            true => (
                format!("layout \"{}\" has {count}", self.names.join(",")),
                "correct `layout`, or the row",
            ),
            false => (
                format!("the other rows have {count}"),
                "correct the row, or take it out if it is not whole",
            ),
        };
        let message = format!("{found} columns where {what}");
        source.error(line.number, 0, message, remedy)
    }
}

/// Named columns; pairs `t,a` may follow one another along a row.
pub(super) fn columns(
    source: &Source<'_>,
    survey: &Survey,
    columns: &Columns,
    said: &Said,
) -> Result<Vec<Series>, GroundMotionError> {
    let names = columns.names.as_slice();
    let count = survey.numbers / names.len() + 1;
    let mut table = Table {
        columns,
        main_time: names.iter().position(|n| n == "t"),
        times: TimeColumn::with_capacity(count).in_unit(columns.time_unit),
        values: names.iter().map(|_| Column::default()).collect(),
    };
    for k in 0..names.len() {
        if table.is_value(k) {
            table.values[k].values.reserve_exact(count);
        }
    }
    let is_whole = table.ends_whole(source)?;
    let mut lines = rows(source).peekable();
    while let Some(line) = lines.next() {
        if is_whole || lines.peek().is_some() {
            table.row(source, line)?;
        }
    }
    let used: Vec<bool> = (0..names.len()).map(|k| table.is_value(k)).collect();
    // What is named a time or a component is one.
    for (k, column) in table.values.iter().enumerate() {
        if !used[k] && names[k] != "t" {
            column.counter.goes_on(source, k + 1, true)?;
        }
    }
    let Table {
        main_time,
        times,
        values,
        ..
    } = table;
    let mut warnings = Vec::new();
    let first_time = times.first();
    let times = match main_time {
        Some(_) => times.finish(source, survey.first, &mut warnings)?,
        None => Times::Step(None),
    };
    let times = match times {
        Times::Step(found) => Times::Step(said.stated.step(source, found)?),
        each => each,
    };
    let longest = values.iter().map(|c| c.values.len()).max().unwrap_or(0);
    let mut series = Vec::new();
    for (k, column) in values.into_iter().enumerate() {
        let name = &names[k];
        if !used[k] {
            continue;
        }
        column.forms.are_whole(source)?;
        column.thousands.are_none(source)?;
        let samples = column.values;
        let others = used.iter().filter(|used| **used).count() > 1;
        if main_time.is_some() && others && columns.units[k].is_none() && counts_rows(&samples) {
            source.warn(&format!("column {} counts the rows and is not data", k + 1));
            continue;
        }
        if main_time.is_none() && nearly_times(&samples).is_some() {
            return Err(source.error(
                survey.first,
                0,
                format!("the values of column {} increase as times do: they are no component", k + 1),
                "name the times by \"t\" in `layout`, such as \"t,a\"; if they go back, the file is damaged: get it again",
            ));
        }
        let mut warnings = warnings.clone();
        if let Some((line, _)) = column.ended {
            let text = format!(
                "column {} ends at line {line}, after {} of {longest} values",
                k + 1,
                samples.len()
            );
            if samples.len() < 2 && longest > 1 {
                source.warn(&format!("{text}, and is not read"));
                continue;
            }
            warnings.push(text);
        }
        let own = samples.len();
        let mut draft = said.draft(samples, columns.units[k], survey);
        if others {
            // That of one of them, or of all.
            draft.other_peaks.clear();
            draft.bare_peaks.clear();
        }
        if own < longest {
            draft.header_count = None;
            draft.other_counts.clear();
        }
        draft.component.clone_from(name);
        draft.channel = series.len() + 1;
        warnings.append(&mut draft.warnings);
        draft.warnings = warnings;
        // Times from zero may be counted anew, from one that the file states.
        if first_time.is_some_and(|time| time != 0.0) || draft.first_time.is_none() {
            draft.first_time = first_time;
        }
        draft.times = match &times {
            Times::Step(step) => Times::Step(*step),
            Times::Each(each) => Times::Each(each[..own.min(each.len())].to_vec()),
        };
        series.push(draft.finish(source)?);
    }
    Ok(series)
}

/// Whether values count on from any whole number.
fn counts_rows(values: &[f64]) -> bool {
    let steps = || values.windows(2).map(|w| w[1] - w[0]);
    values.len() > 3 && values[0].fract() == 0.0 && steps().all(|step| step == 1.0)
}

/// Whether a column is passed over: velocity and displacement have no unit that
/// could be stated. `v` is velocity beside `d`, a vertical component elsewhere.
fn is_other(names: &[String], name: &str) -> bool {
    OTHERS.contains(&name)
        || (matches!(name, "v" | "d")
            && names.iter().any(|n| n == "a")
            && names.iter().any(|n| n == "d"))
}
