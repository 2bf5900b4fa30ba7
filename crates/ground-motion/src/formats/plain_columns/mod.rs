//! Plain columns of numbers: one column, a series wrapped along the rows, times
//! and one or more series, `npts dt` before the values, card images with row
//! numbers; with any number of comment and text lines before them, of which one may name
//! the columns with their units.

use crate::draft::{Draft, DraftUnit, Times};
use crate::error::{GroundMotionError, bound};
use crate::formats::Format;
use crate::fortran::Layout;
use crate::recording::{Sampling, Series};
use crate::source::Source;
use crate::stated_step::STEP_TOLERANCE;
use crate::text::Line;
use crate::time_column::{TimeColumn, mostly_times};

mod decimal;
mod header;
mod survey;

use header::{Fault, Header, Role};
use survey::{Arrangement, Head, Survey};

use super::pounding_csv::Keys;
use crate::quantity::{Quantity, SeriesUnit};

const COMMENTS: [&[u8]; 6] = [b"#", b"%", b"*", b"!", b"//", b"$"];
/// Names of columns that are not accelerations.
const OTHERS: [&str; 4] = ["-", "row", "velocity", "displacement"];

fn is_comment(line: &Line<'_>) -> bool {
    let start = line.bytes.trim_ascii_start();
    // A row may start with a Fortran overflow.
    COMMENTS.iter().any(|c| start.starts_with(c)) && (!start.starts_with(b"**") || line.is_text())
}

/// Rows of numbers: no comments, no blank lines, no text before the first row;
/// each with the characters cut off that the user wants cut off.
fn rows<'a>(source: &Source<'a>) -> impl Iterator<Item = Line<'a>> + use<'a> {
    let columns = source.options.skip_columns;
    source
        .all_lines()
        .skip(source.options.skip_lines)
        .map(move |l| Line {
            number: l.number,
            bytes: l.bytes.get(columns..).unwrap_or(&[]),
        })
        .filter(|l| !l.is_blank() && !is_comment(l))
        .skip_while(|l| l.is_text() || header::parse(l).is_some())
}

/// The line before the rows, comments among them, that names their columns.
fn header(source: &Source<'_>) -> Option<Header> {
    let first = rows(source).next()?.number;
    let before = source.all_lines().skip(source.options.skip_lines);
    let before = before.take_while(|l| l.number < first);
    before.filter_map(|l| header::parse(&l)).last()
}

/// A line that names columns and could not be used.
struct Faulty {
    line: usize,
    text: String,
    fault: Fault,
}

/// The last such line before the rows, if no header follows it; one of another quantity before
/// others.
fn fault(source: &Source<'_>, header: Option<&Header>) -> Option<Faulty> {
    let first = rows(source).next()?.number;
    let after = header.map_or(0, |h| h.line);
    let before = source.all_lines().skip(source.options.skip_lines);
    before
        .take_while(|l| l.number < first)
        .filter(|l| l.number > after)
        .filter_map(|l| {
            let (text, fault) = header::fault(&l)?;
            Some(Faulty {
                line: l.number,
                text,
                fault,
            })
        })
        .max_by_key(|f| matches!(f.fault, Fault::NoAcceleration(..)))
}

impl Faulty {
    /// The error where what the user says cannot mend it: no unit makes an acceleration of a
    /// displacement, and times in an unknown unit would pass for seconds unless the layout
    /// says what the columns are.
    fn refused(&self, source: &Source<'_>) -> Option<GroundMotionError> {
        let refused = match self.fault {
            Fault::NoAcceleration(..) => true,
            Fault::TimeUnit(..) => source.options.layout.is_none(),
            _ => false,
        };
        refused.then(|| self.error(source))
    }

    fn error(&self, source: &Source<'_>) -> GroundMotionError {
        let Self { line, text, fault } = self;
        let (message, remedy) = match fault {
            Fault::NoAcceleration(quantity, name) => (
                format!("the header \"{text}\" names no acceleration: \"{name}\" is a {quantity}"),
                "give the accelerations of the same record: no unit makes an excitation of another quantity; if the line says nothing of the values, take it out, or pass it over by `skip_lines`",
            ),
            Fault::TimeUnit(name, unit) => (
                format!("the unit \"{unit}\" of the column \"{name}\" is not known"),
                "write the times in s or ms, as in `time (s)`; or pass them over, e.g. with `layout = \"-,a\"`, and give `time_step` and `unit`",
            ),
            Fault::MotionUnit(name, unit) => (
                format!("the unit \"{unit}\" of the column \"{name}\" is not known"),
                "write g, m/s2, cm/s2, mm/s2, gal, in/s2 or ft/s2, as in `acceleration (m/s2)`; or give `layout`, e.g. \"t,a\", and `unit`",
            ),
            Fault::TwoTimes => (
                format!("the header \"{text}\" names two columns of times"),
                "name one of them otherwise, or give `layout`, e.g. \"t,-,a\", and `unit`",
            ),
            Fault::Column(number, name) => (
                format!(
                    "the header \"{text}\" is not used: its column {number}, \"{name}\", is not understood"
                ),
                "name every column, as in `t [s];a [m/s2]` or `time (s),NS (g),EW (g)`; a time step stands in a line of its own before it, `# dt: 0.01 s`; or give `layout`, e.g. \"t,a\", and `unit`",
            ),
        };
        source.error(*line, 0, message, remedy)
    }
}

/// Damaged and touching values are numbers to detection: the reader names them.
fn looks_numeric(field: &[u8]) -> bool {
    let part = |b: &u8| b.is_ascii_digit() || b"+-.eEdD*".contains(b);
    field.iter().all(part) && field.iter().any(|b| b.is_ascii_digit() || *b == b'*')
        || [&b"nan"[..], b"inf", b"-inf", b"+inf"]
            .iter()
            .any(|w| field.eq_ignore_ascii_case(w))
}

pub(super) static FORMAT: Format = Format {
    name: "plain_columns",
    title: "Numbers: one or more columns, values along the rows, Fortran formats",
    source: "whoever wrote the file",
    recognised_by: "rows of numbers alone after any lines of text",
    matches,
    read,
};

fn matches(source: &Source<'_>) -> bool {
    let mut first = rows(source).take(30).peekable();
    first.peek().is_some() && first.all(|l| l.fields().all(|(_, f)| looks_numeric(f)))
}

fn read(source: &Source<'_>) -> Result<Vec<Series>, GroundMotionError> {
    let header = header(source);
    let faulty = fault(source, header.as_ref());
    if let Some(error) = faulty.as_ref().and_then(|f| f.refused(source)) {
        return Err(error);
    }
    let bytes = decimal::with_points(source, header.as_ref())?;
    let pointed = Source::new(source.file, &bytes, source.options, source.path);
    let series = match (numbers(&pointed, header.as_ref()), faulty) {
        // Unit and step may well be there: why they were not understood is the reason.
        (
            Err(GroundMotionError::MissingUnit { .. } | GroundMotionError::MissingTimeStep { .. }),
            Some(faulty),
        ) => return Err(faulty.error(source)),
        (series, _) => series?,
    };
    agrees(source, &series)?;
    for warning in pointed.warnings() {
        source.warn(&warning);
    }
    source.uses(pointed.used());
    Ok(series)
}

/// Holds the unit and the sampling rate that lines before the rows state, `Units: cm/s2`, `Sampling
/// rate: 200 Hz`, against those of the series.
///
/// # Errors
/// Another unit, or another step than the user gives.
fn agrees(source: &Source<'_>, series: &[Series]) -> Result<(), GroundMotionError> {
    let (Some(first), Some(one)) = (rows(source).next(), series.first()) else {
        return Ok(());
    };
    let before = || {
        let lines = source.all_lines().skip(source.options.skip_lines);
        lines.take_while(|l| l.number < first.number)
    };
    let contradicts = |quantity: &'static str, stated: String, given: String| {
        Err(GroundMotionError::Contradiction {
            file: source.file.to_owned(),
            quantity,
            stated,
            given,
        })
    };
    for line in before() {
        let Some(unit) = stated_unit(&line) else {
            continue;
        };
        if unit.quantity != Quantity::Acceleration {
            let fault = Fault::NoAcceleration(unit.quantity, unit.symbol.to_owned());
            let (line, text) = (line.number, line.text().trim().to_owned());
            return Err(Faulty { line, text, fault }.error(source));
        }
        if series.iter().any(|s| s.unit != unit.symbol) {
            let stated = format!("{} (line {})", unit.symbol, line.number);
            return contradicts("unit", stated, one.unit.to_owned());
        }
    }
    let Sampling::Even { time_step } = one.sampling else {
        return Ok(());
    };
    let rates = || {
        before().flat_map(|l| {
            crate::number::rates(&l.text())
                .into_iter()
                .map(move |r| (l.number, r.0))
        })
    };
    let same = |step: f64| (step - time_step).abs() <= STEP_TOLERANCE * time_step;
    // A rate before the record was resampled may stand beside its own.
    if rates().any(|(_, step)| same(step)) {
        return Ok(());
    }
    let Some((line, step)) = rates().next() else {
        return Ok(());
    };
    if source.options.time_step.is_some() {
        let stated = format!("{} s (line {line})", bound(step));
        return contradicts("time_step", stated, format!("{time_step} s"));
    }
    source.warn(&format!(
        "line {line}: the header says {} samples/s, but the values are {time_step} s apart, which is used",
        bound(1.0 / step)
    ));
    Ok(())
}

/// The unit that a line states under a key, `# Unit: g`, `Units = cm/s2`, `acceleration units: gal`.
fn stated_unit(line: &Line<'_>) -> Option<SeriesUnit> {
    let lower = line.lower();
    let (key, value) = lower.split_once([':', '='])?;
    let key = key.trim_start_matches(|c: char| !c.is_ascii_alphanumeric());
    let is_unit = ["unit", "units"].contains(&key.trim());
    let mut words = key.split_whitespace();
    let of_values = words
        .next()
        .is_some_and(|w| w.starts_with("accel") || w == "data")
        && words.next().is_some_and(|w| ["unit", "units"].contains(&w))
        && words.next().is_none();
    (is_unit || of_values).then(|| SeriesUnit::parse(value.trim()))?
}

/// Reads numbers with decimal points.
fn numbers(source: &Source<'_>, header: Option<&Header>) -> Result<Vec<Series>, GroundMotionError> {
    if let Some(text) = &source.options.layout {
        if let Some(layout) = Layout::parse(text) {
            return fixed(source, layout);
        }
        // No column has such a name.
        if text.contains(['(', ')', '.']) {
            return Err(GroundMotionError::Unsupported {
                file: source.file.to_owned(),
                what: format!("the Fortran format \"{text}\" is not understood"),
                remedy: "give one of numbers of one width, such as \"8F10.5\", \"(1P5E14.6)\", \"2X,8F9.5\" or \"5(1X,E14.7)\"",
            });
        }
        let names: Vec<String> = text.split(',').map(|n| n.trim().to_owned()).collect();
        if names == ["a"] {
            let survey = Survey::new(source, true)?;
            let head = survey.head(source, true)?;
            return wrapped(source, &survey, head);
        }
        let survey = Survey::new(source, true)?;
        return columns(
            source,
            &survey,
            &Columns::new(names, header),
            &Keys::default(),
        );
    }
    if let Some(header) = header {
        let survey = Survey::new(source, true)?;
        return headed(source, &survey, header);
    }
    let survey = Survey::new(source, false)?;
    match survey.arrangement(source)? {
        Arrangement::Wrapped => wrapped(source, &survey, None),
        Arrangement::Headed(head) => wrapped(source, &survey, Some(head)),
        Arrangement::Columns(names) => {
            let columns = Columns::new(names, None);
            match self::columns(source, &survey, &columns, &Keys::default()) {
                Err(GroundMotionError::Contradiction {
                    quantity: "time_step",
                    stated,
                    given,
                    ..
                }) if stated == "1 s" => Err(counts_rows(source, &survey, &columns.names, &given)),
                found => found,
            }
        }
        Arrangement::Cards => cards(source, &survey),
    }
}

/// The error of a column that was taken for one of times, 1 s apart, beside another step.
fn counts_rows(
    source: &Source<'_>,
    survey: &Survey,
    names: &[String],
    given: &str,
) -> GroundMotionError {
    let passed = names.iter().map(|n| if n == "t" { "-" } else { n });
    let layout: Vec<&str> = passed.collect();
    source.error(
        survey.first,
        0,
        format!(
            "column {} increases by 1 a row, which are times 1 s apart, but a time step of {given} is given",
            names.iter().position(|n| n == "t").unwrap_or(0) + 1
        ),
        &format!(
            "if it counts the rows, pass it over: `layout = \"{0}\"` in [ground_motion] of a case, `--layout \"{0}\"` with `pounding motion`; else do not give the time step",
            layout.join(",")
        ),
    )
}

/// Columns by name, as they stand in the rows.
struct Columns {
    names: Vec<String>,
    /// Unit of each, where the file states it.
    units: Vec<Option<SeriesUnit>>,
    /// One unit of the times (s).
    time_unit: f64,
    /// Whether pairs `t,a` may follow one another along a row.
    pairs: bool,
}

impl Columns {
    /// Columns that the user or the numbers name; units are those of a header that has as
    /// many columns.
    fn new(names: Vec<String>, header: Option<&Header>) -> Self {
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

    fn of_roles(roles: &[Role]) -> Self {
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
        };
        for (k, role) in roles.iter().enumerate() {
            let (name, unit) = match role {
                Role::Time(unit) => {
                    columns.time_unit = *unit;
                    ("t".to_owned(), None)
                }
                // The name of one that says no more than that it is an acceleration.
                Role::Acceleration(name, unit) if !several && header::is_acceleration(name) => {
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

/// Columns that a header names, held against the key lines before it.
fn headed(
    source: &Source<'_>,
    survey: &Survey,
    header: &Header,
) -> Result<Vec<Series>, GroundMotionError> {
    let keys = Keys::before(source, header.line);
    let columns = Columns::of_roles(&header.columns);
    for unit in columns.units.iter().flatten() {
        keys.agree(source, *unit, &header.text)?;
    }
    if let ([name], [Role::Acceleration(..)]) = (columns.names.as_slice(), &*header.columns) {
        // Values may follow one another along the rows.
        let samples = along(source, survey, 0)?;
        without_times(source, survey.first, &samples, survey.width())?;
        let unit = columns.units[0].map_or(DraftUnit::Unstated, DraftUnit::Stated);
        let mut draft = Draft::new(samples, unit, (survey.first, survey.first, survey.last));
        draft.times = Times::Step(keys.step(source, None)?);
        draft.component.clone_from(name);
        let mut series = draft.finish(source)?;
        keys.report(&mut series.origin);
        return Ok(vec![series]);
    }
    let row = rows(source).find(|l| l.fields().count() != columns.names.len());
    if let Some(row) = row {
        let found = row.fields().count();
        let twice = found == 2 * columns.names.len() && !row.bytes.contains(&b'.');
        return Err(source.error(
            row.number,
            0,
            format!(
                "{found} numbers where the header \"{}\" names {} columns{}",
                header.text,
                columns.names.len(),
                if twice { ": commas both within numbers and between them?" } else { "" }
            ),
            "correct the row or the header; with decimal commas separate the columns by semicolons or tabs",
        ));
    }
    let mut series = self::columns(source, survey, &columns, &keys)?;
    for one in &mut series {
        one.origin.header_line = Some(header.line);
        keys.report(&mut one.origin);
    }
    Ok(series)
}

/// A series along rows of fixed width.
fn fixed(source: &Source<'_>, layout: Layout) -> Result<Vec<Series>, GroundMotionError> {
    let room = source.bytes.len() / layout.width + 1;
    let mut samples = Vec::with_capacity(room);
    let mut first = 0;
    let mut last = 0;
    let mut card = None;
    let mut lines = rows(source).peekable();
    while let Some(line) = lines.next() {
        first = if first == 0 { line.number } else { first };
        last = line.number;
        // Row numbers of cards stand after the numbers, and are not data.
        let width = layout.margin + layout.per_line * layout.width;
        if !layout.more {
            card = counted_card(source, line, width, card)?;
        }
        let mut bytes = &line.bytes[..width.min(line.bytes.len())];
        if lines.peek().is_none() && line.bytes.len() > width {
            // The last card may hold fewer numbers before its own.
            let filled = bytes.trim_ascii_end().len().saturating_sub(layout.margin);
            bytes = &bytes[..layout.margin + filled.next_multiple_of(layout.width)];
        }
        source.row(Line { bytes, ..line }, layout, &mut samples)?;
    }
    without_times(source, first, &samples, layout.per_line)?;
    let draft = Draft::new(samples, DraftUnit::Unstated, (first, first, last));
    Ok(vec![draft.finish(source)?])
}

/// The number of a card that stands behind its numbers, which end at a column; `before` is that of
/// the card before.
///
/// # Errors
/// Anything else there: the layout has fewer numbers than the rows.
fn counted_card(
    source: &Source<'_>,
    line: Line<'_>,
    width: usize,
    before: Option<usize>,
) -> Result<Option<usize>, GroundMotionError> {
    let behind = line.columns(width, line.bytes.len());
    if behind.is_empty() {
        return Ok(before);
    }
    match (before, behind.parse().ok()) {
        (None, Some(card)) => return Ok(Some(card)),
        (Some(before), Some(card)) if card == before + 1 => return Ok(Some(card)),
        _ => {}
    }
    Err(source.error(
        line.number,
        width + source.options.skip_columns,
        format!(
            "the row has {} columns, of which the layout takes {width}: \"{}\" is left over, and does not count the rows",
            line.bytes.len(),
            crate::number::shown(behind.as_bytes())
        ),
        "give the format of all numbers of a row in `layout`, such as \"8F10.5\"; or that of what is to be passed over behind them, such as \"8F9.5,I7\"",
    ))
}

/// A series along the rows, after rows of count and step if there are any.
fn wrapped(
    source: &Source<'_>,
    survey: &Survey,
    head: Option<Head>,
) -> Result<Vec<Series>, GroundMotionError> {
    let samples = along(source, survey, head.map_or(0, |head| head.rows))?;
    without_times(source, survey.first, &samples, survey.width())?;
    let mut draft = Draft::new(
        samples,
        DraftUnit::Unstated,
        (survey.first, survey.first, survey.last),
    );
    if let Some(head) = head {
        draft.header_count = Some(head.count);
        draft.times = Times::Step(head.step);
    }
    Ok(vec![draft.finish(source)?])
}

/// Refuses a series along the rows with times among its values, whoever says that it is one.
fn without_times(
    source: &Source<'_>,
    line: usize,
    samples: &[f64],
    width: usize,
) -> Result<(), GroundMotionError> {
    let among = |every: &usize| mostly_times(samples, *every);
    let Some(every) = [2, width].into_iter().filter(|n| *n > 1).find(among) else {
        return Ok(());
    };
    let which = match every {
        2 => "every other number increases".to_owned(),
        every => format!("one of every {every} numbers increases"),
    };
    Err(source.error(
        line,
        0,
        format!("{which} as times do, all along the rows: they are no series of one quantity"),
        "say what the columns are with `layout`, such as \"t,a\", which also reads pairs that follow one another along a row, or \"t,ns,ew\" (`-` passes one over); if times go back, the file is damaged: get it again",
    ))
}

/// All numbers of the rows after the first few.
fn along(
    source: &Source<'_>,
    survey: &Survey,
    skipped: usize,
) -> Result<Vec<f64>, GroundMotionError> {
    let mut samples = Vec::with_capacity(survey.numbers);
    for line in rows(source).skip(skipped) {
        for (column, field) in line.fields() {
            let column = column + source.options.skip_columns;
            samples.push(source.number(line, column, field)?);
        }
    }
    Ok(samples)
}

/// Card images: the last number of each row is the row's.
fn cards(source: &Source<'_>, survey: &Survey) -> Result<Vec<Series>, GroundMotionError> {
    let mut samples = Vec::with_capacity(survey.numbers);
    for line in rows(source) {
        let before = samples.len();
        for (column, field) in line.fields() {
            samples.push(source.number(line, column, field)?);
        }
        if samples.len() > before {
            samples.pop();
        }
    }
    without_times(source, survey.first, &samples, survey.width() - 1)?;
    let mut draft = Draft::new(
        samples,
        DraftUnit::Unstated,
        (survey.first, survey.first, survey.last),
    );
    draft
        .warnings
        .push("the last column counts the rows and is not data".to_owned());
    Ok(vec![draft.finish(source)?])
}

/// Named columns; pairs `t,a` may follow one another along a row.
fn columns(
    source: &Source<'_>,
    survey: &Survey,
    columns: &Columns,
    keys: &Keys,
) -> Result<Vec<Series>, GroundMotionError> {
    let (names, pairs) = (columns.names.as_slice(), columns.pairs);
    let count = survey.numbers / names.len() + 1;
    let mut values: Vec<Vec<f64>> = vec![Vec::new(); names.len()];
    for (name, column) in names.iter().zip(&mut values) {
        if name != "t" && !is_other(names, name) {
            column.reserve_exact(count);
        }
    }
    let mut times = TimeColumn::with_capacity(count).in_unit(columns.time_unit);
    for line in rows(source) {
        let found = line.fields().count();
        if found != names.len() && !(pairs && found.is_multiple_of(2)) {
            return Err(source.error(
                line.number,
                0,
                format!(
                    "{found} columns where layout \"{}\" has {}",
                    names.join(","),
                    names.len()
                ),
                "correct `layout`, or the row",
            ));
        }
        for (i, (column, field)) in line.fields().enumerate() {
            let k = i % names.len();
            let value = source.number(line, column + source.options.skip_columns, field)?;
            if names[k] == "t" {
                times.push(line, value, field);
            } else if !is_other(names, &names[k]) {
                values[k].push(value);
            }
        }
    }
    let mut warnings = Vec::new();
    let has_times = names.iter().any(|n| n == "t");
    let first_time = times.first();
    let times = if has_times {
        times.finish(source, survey.first, &mut warnings)?
    } else {
        Times::Step(None)
    };
    let times = match times {
        Times::Step(found) => Times::Step(keys.step(source, found)?),
        each => each,
    };
    let mut series = Vec::new();
    for ((name, unit), samples) in names.iter().zip(&columns.units).zip(values) {
        if name == "t" || is_other(names, name) {
            continue;
        }
        let mut draft = Draft::new(
            samples,
            unit.map_or(DraftUnit::Unstated, DraftUnit::Stated),
            (survey.first, survey.first, survey.last),
        );
        draft.component.clone_from(name);
        draft.channel = series.len() + 1;
        draft.warnings.clone_from(&warnings);
        draft.first_time = first_time;
        draft.times = match &times {
            Times::Step(step) => Times::Step(*step),
            Times::Each(each) => Times::Each(each.clone()),
        };
        series.push(draft.finish(source)?);
    }
    Ok(series)
}

/// Whether a column is passed over: velocity and displacement have no unit that
/// could be stated. `v` is velocity beside `d`, a vertical component elsewhere.
fn is_other(names: &[String], name: &str) -> bool {
    OTHERS.contains(&name)
        || (matches!(name, "v" | "d")
            && names.iter().any(|n| n == "a")
            && names.iter().any(|n| n == "d"))
}
