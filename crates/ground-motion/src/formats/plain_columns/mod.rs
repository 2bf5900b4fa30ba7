//! Plain columns of numbers: one column, a series wrapped along the rows, times
//! and one or more series, `npts dt` before the values, card images with row
//! numbers; with any number of comment and text lines before them, of which one may name
//! the columns with their units.

use crate::cut_numbers::Forms;
use crate::draft::{Draft, DraftUnit};
use crate::error::GroundMotionError;
use crate::format::Format;
use crate::fortran::Layout;
use crate::header_keys::{Entry, keyed, states_number};
use crate::recording::Series;
use crate::row_widths;
use crate::source::Source;
use crate::text::Line;
use crate::time_column::{Times, mostly_times};

mod blocks;
mod column_name;
mod columns;
mod counter;
mod decimal;
mod faults;
mod header;
mod names;
mod stated;
mod stated_unit;
mod survey;
mod thousands;
mod titles;
mod two_units;

use column_name::{Role, unit_beside};
use columns::{Columns, columns};
use counter::Counter;
use faults::Fault;
use header::Header;
use stated::{Stated, is_history};
use survey::{Arrangement, Head, Survey};
use thousands::Thousands;

use super::pounding_csv::Keys;
use crate::quantity::{SeriesUnit, speaks_of_spectrum};

const COMMENTS: [&[u8]; 6] = [b"#", b"%", b"*", b"!", b"//", b"$"];
/// Names of columns that are not accelerations.
const OTHERS: [&str; 4] = ["-", "row", "velocity", "displacement"];

fn is_comment(line: &Line<'_>) -> bool {
    let start = line.bytes.trim_ascii_start();
    // A row may start with a Fortran overflow.
    COMMENTS.iter().any(|c| start.starts_with(c)) && (!start.starts_with(b"**") || line.is_text())
}

/// Whether a field starts as a number does.
fn starts_a_number(field: &[u8]) -> bool {
    let field = field.trim_ascii();
    // Bars may stand around the cells of a row.
    let field = field.strip_prefix(b"|").unwrap_or(field);
    let bare = field.strip_prefix(b"\"").unwrap_or(field);
    let digits = bare
        .strip_prefix(b"+")
        .or(bare.strip_prefix(b"-"))
        .unwrap_or(bare);
    let digits = digits.strip_prefix(b".").unwrap_or(digits);
    digits
        .first()
        .is_some_and(|b| b.is_ascii_digit() || *b == b'*')
        || digits.len() >= 3
            && [&b"nan"[..], b"inf"]
                .iter()
                .any(|w| digits[..3].eq_ignore_ascii_case(w))
}

/// Rows of numbers: no comments, no blank lines, no text before the first row;
/// each with the characters cut off that the user wants cut off.
fn rows<'a>(source: &Source<'a>) -> impl Iterator<Item = Line<'a>> + use<'a> {
    let columns = source.options.skip_columns;
    let cut = move |l: &Line<'a>| Line {
        number: l.number,
        bytes: l.bytes.get(columns..).unwrap_or(&[]),
    };
    source
        .all_lines()
        .skip(source.options.skip_lines)
        .map(move |l| (l, cut(&l)))
        .filter(|(_, l)| !l.is_blank() && l.fields().next().is_some() && !is_comment(l))
        .skip_while(move |(whole, l)| {
            let words = !l.fields().any(|(_, field)| starts_a_number(field));
            let is_stated = || columns > 0 && states_number(&whole.lower());
            words
                || l.is_text()
                || is_key(l)
                || is_letter_n(l)
                || is_stated()
                || header::parse(l).is_some()
        })
        .map(|(_, l)| l)
}

/// Whether a line is a symbol with its value, `\u{394}t = 0.01 s`.
fn is_key(line: &Line<'_>) -> bool {
    let first = line.fields().next();
    let named = first.is_some_and(|(_, field)| {
        !starts_a_number(field)
            && field
                .first()
                .is_some_and(|b| b.is_ascii_alphabetic() || !b.is_ascii())
    });
    named && line.bytes.iter().any(|b| b"=:".contains(b))
}

/// Whether a line is the letter N with a count, `N,300`.
fn is_letter_n(line: &Line<'_>) -> bool {
    let mut fields = line.fields().map(|(_, field)| field);
    fields
        .next()
        .is_some_and(|key| key.eq_ignore_ascii_case(b"n"))
        && fields
            .next()
            .is_some_and(|n| n.iter().all(u8::is_ascii_digit))
        && fields.next().is_none()
}

/// The lines before the first row, comments among them.
fn before<'a>(source: &Source<'a>) -> impl Iterator<Item = Line<'a>> + use<'a> {
    let first = rows(source).next().map_or(0, |l| l.number);
    let lines = source.all_lines().skip(source.options.skip_lines);
    lines.take_while(move |l| l.number < first)
}

/// The line before the rows, comments among them, that names their columns.
fn header(source: &Source<'_>) -> Option<Header> {
    let first = rows(source).next()?;
    let names = header::name_lines(before(source));
    names.iter().rev().find_map(|cells| cells.header_of(&first))
}

/// What to do about a spectrum.
const NO_SPECTRUM: &str = "give the acceleration over the time, not a spectrum; if the line says nothing of the values, take it out, or pass it over by `skip_lines`";

/// Refuses values of which none is below zero under a title that speaks of a spectrum: a motion has both signs,
/// the ordinates of a spectrum have one.
fn is_no_spectrum(source: &Source<'_>, series: &[Series]) -> Result<(), GroundMotionError> {
    let mut values = series.iter().flat_map(|s| &s.samples);
    let title = before(source).find(|line| {
        let lower = line.lower();
        !is_history(&lower) && speaks_of_spectrum(&lower)
    });
    let Some(title) = title.filter(|_| values.all(|a| *a >= 0.0)) else {
        return Ok(());
    };
    Err(source.error(
        title.number,
        0,
        format!(
            "the line \"{}\" speaks of a spectrum, and no value is below zero, as of a spectrum: they are no record",
            title.text().trim().chars().take(60).collect::<String>()
        ),
        NO_SPECTRUM,
    ))
}

/// A line that names columns and could not be used.
struct Faulty {
    line: usize,
    text: String,
    fault: Fault,
}

/// The last such line before the rows, if no header follows it; one of another quantity before
/// others. A header that states the unit of an acceleration goes before titles.
fn fault(source: &Source<'_>, header: Option<&Header>) -> Option<Faulty> {
    let accelerates = |role: &Role| matches!(role, Role::Acceleration(_, Some(_)));
    let after = header.map_or(0, |h| h.line);
    let stated = header.is_some_and(|h| h.columns.iter().any(accelerates));
    let is_other = |f: &Faulty| matches!(f.fault, Fault::NoAcceleration(..));
    let row = rows(source).next();
    let lines = header::name_lines(before(source));
    let last = lines.last().map_or(0, |cells| cells.line);
    lines
        .iter()
        .filter(|cells| cells.line != after)
        .filter_map(|cells| {
            let line = cells.line;
            let of_rows = || {
                let fits = row.as_ref().is_some_and(|row| cells.fits(row));
                let alone = cells.names.len() == 1 && line == last;
                faults::of_no_acceleration(cells).filter(|_| fits && cells.names.len() > 1 || alone)
            };
            let of_rows = of_rows().map(|fault| (cells.text.clone(), fault));
            let (text, fault) = of_rows.or_else(|| faults::fault_of(cells))?;
            let of_names = matches!(
                fault,
                Fault::Column(..) | Fault::MotionUnit(..) | Fault::TimeUnit(..)
            );
            (!of_names || !cells.is_key()).then_some(Faulty { line, text, fault })
        })
        .filter(|f| f.line > after || is_other(f) && !stated)
        .max_by_key(|f| match f.fault {
            Fault::NoAcceleration(..) => 2,
            Fault::Spectrum(..) | Fault::Foreign(..) => 1,
            _ => 0,
        })
}

impl Faulty {
    /// The error where what the user says cannot mend it: no unit makes an acceleration of a
    /// displacement, and times in an unknown unit would pass for seconds unless the layout
    /// says what the columns are.
    fn refused(&self, source: &Source<'_>) -> Option<GroundMotionError> {
        let refused = match self.fault {
            Fault::NoAcceleration(..) | Fault::Spectrum(..) | Fault::Foreign(..) => true,
            Fault::MotionUnit(_, ref unit) => names::is_foreign_unit(unit),
            Fault::TimeUnit(..) | Fault::Factor(..) => source.options.layout.is_none(),
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
            Fault::Spectrum(name) => (
                format!(
                    "the header \"{text}\" is that of a spectrum, of which \"{name}\" is one column: it holds no record"
                ),
                NO_SPECTRUM,
            ),
            Fault::Foreign(name) => (
                format!("the header \"{text}\" names no acceleration: \"{name}\" is none"),
                "give a file that holds the accelerations; if the line says nothing of the values, take it out, or pass it over by `skip_lines`",
            ),
            Fault::MotionUnit(name, unit) if names::is_foreign_unit(unit) => (
                format!(
                    "the values of the column \"{name}\" are in {unit}, which is no unit of acceleration"
                ),
                "give the record in m/s2, cm/s2, g or the like; counts, volts and forces are not read",
            ),
            Fault::TimeUnit(name, unit) => (
                format!("the unit \"{unit}\" of the column \"{name}\" is not known"),
                "write the times in s or ms, as in `time (s)`; or pass them over, e.g. with `layout = \"-,a\"`, and give `time_step` and `unit`",
            ),
            Fault::MotionUnit(name, unit) => (
                format!("the unit \"{unit}\" of the column \"{name}\" is not known"),
                "write g, m/s2, cm/s2, mm/s2, gal, in/s2 or ft/s2, as in `acceleration (m/s2)`; or give `layout`, e.g. \"t,a\", and `unit`",
            ),
            Fault::Factor(name) => (
                format!(
                    "the name of the column \"{name}\" has a factor or a sign: whether its values are to be divided by it is not known"
                ),
                "bring the values to the unit and name the column without the factor, as in `acceleration (m/s2)`; if they are in the unit that you give, give `layout`, e.g. \"t,a\", and `unit`",
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
    let field = field.strip_prefix(b"\"").unwrap_or(field);
    let field = field.strip_suffix(b"\"").unwrap_or(field);
    if field.is_empty() || field == b"|" {
        return true;
    }
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
};

pub(super) fn matches(source: &Source<'_>) -> bool {
    let mut first = rows(source).take(30).peekable();
    // Bars may part numbers without blanks, `0.00|0.01`.
    let cells = |f: &[u8]| f.split(|b| *b == b'|').all(looks_numeric);
    first.peek().is_some() && first.all(|l| l.fields().all(|(_, f)| cells(f)))
}

pub(super) fn read(source: &Source<'_>) -> Result<Vec<Series>, GroundMotionError> {
    let bare = decimal::without_quotes(source);
    let outer = source;
    let source = &Source::new(outer.file, &bare, outer.options, outer.path);
    let decided = two_units::decided(source)?;
    let header = header(source);
    let faulty = fault(source, header.as_ref());
    if let Some(error) = faulty.as_ref().and_then(|f| f.refused(source)) {
        return Err(error);
    }
    blocks::are_of_one_record(outer)?;
    thousands::are_no_groups(source)?;
    let bytes = decimal::with_points(source, header.as_ref())?;
    let pointed = Source::new(source.file, &bytes, source.options, source.path);
    let said = Said::before(&pointed, header.as_ref(), &decided)?;
    agrees_with_names(source, header.as_ref(), &said.stated, &decided)?;
    let series = match (numbers(&pointed, header.as_ref(), &said), faulty) {
        // Unit and step may well be there: why they were not understood is the reason.
        (
            Err(GroundMotionError::MissingUnit { .. } | GroundMotionError::MissingTimeStep { .. }),
            Some(faulty),
        ) => return Err(faulty.error(source)),
        (series, _) => series?,
    };
    let mut series = series;
    is_no_spectrum(source, &series)?;
    if let Some((line, title, quantity)) = titles::titled(&header::name_lines(before(source))) {
        pointed.warn(&format!(
            "line {line}: the title \"{}\" speaks of a {quantity}, but the values are taken for accelerations: give the accelerations of the same record if they are none",
            title.chars().take(60).collect::<String>()
        ));
    }
    let is_one = series.len() == 1;
    for one in &mut series {
        said.keys.report(&mut one.origin);
        let unnamed = ["", "a"].contains(&one.component.as_str());
        if let Some(name) = said.keys.component().filter(|_| is_one && unnamed) {
            name.clone_into(&mut one.component);
            name.clone_into(&mut one.origin.component);
        }
        if !is_one && one.initial.take().is_some() {
            pointed.warn("the initial velocity or displacement is not used: it is that of one of several series");
        }
    }
    for warning in pointed.warnings() {
        outer.warn(&warning);
    }
    outer.uses(pointed.used());
    Ok(series)
}

/// Refuses another unit, given or stated, than one that the name of a column states in a line that
/// is not the header.
fn agrees_with_names(
    source: &Source<'_>,
    header: Option<&Header>,
    stated: &Stated,
    decided: &[usize],
) -> Result<(), GroundMotionError> {
    for cells in header::name_lines(before(source)) {
        let is_header = header.is_some_and(|h| h.line == cells.line);
        if is_header || cells.names.len() < 2 || decided.contains(&cells.line) {
            continue;
        }
        // `peak acceleration (m/s2): 2.9` is a key with its value.
        let is_key = |text: &str| keyed(&text.to_lowercase()).iter().any(Entry::has_number);
        if cells.separator.is_none() && is_key(&cells.text) {
            continue;
        }
        let names = cells.names.iter().filter(|name| !is_key(name));
        for unit in names.filter_map(|n| unit_beside(n)) {
            stated.agrees(source, unit, &cells.text)?;
            if let Some(given) = source.options.unit.filter(|given| !unit.is(*given)) {
                return Err(GroundMotionError::Contradiction {
                    file: source.file.to_owned(),
                    quantity: "unit",
                    stated: format!("{} (line {})", unit.symbol, cells.line),
                    given: SeriesUnit::from(given).symbol.to_owned(),
                });
            }
        }
    }
    Ok(())
}

/// What lines before the rows say of all of them.
struct Said {
    /// Keys of our CSV.
    keys: Keys,
    stated: Stated,
    /// Whether the user says the unit.
    is_given: bool,
}

impl Said {
    /// `decided`: lines that say nothing of the unit.
    fn before(
        source: &Source<'_>,
        header: Option<&Header>,
        decided: &[usize],
    ) -> Result<Self, GroundMotionError> {
        let line = header.map(|h| h.line);
        let without_unit = |at: usize| line == Some(at) || decided.contains(&at);
        Ok(Self {
            keys: Keys::before(source, before(source)),
            stated: Stated::before(source, before(source), without_unit)?,
            is_given: source.options.unit.is_some(),
        })
    }

    /// The unit of values for which a header says `unit`, with what to say of it: else that which the lines before
    /// the rows state, or that of a peak which the values have.
    fn unit(&self, unit: Option<SeriesUnit>, samples: &[f64]) -> (DraftUnit, Option<String>) {
        let unit = unit.or_else(|| self.stated.unit_of_values());
        let of_peak = || self.stated.unit_of_peak(samples);
        match unit {
            Some(unit) => (DraftUnit::Stated(unit), None),
            None if self.is_given => (DraftUnit::Unstated, None),
            None => match of_peak() {
                Some((unit, told)) => (DraftUnit::Stated(unit), Some(told)),
                None => (DraftUnit::Unstated, None),
            },
        }
    }

    /// A draft of values that stand in lines `first..=last` among so many numbers.
    fn draft(&self, samples: Vec<f64>, unit: Option<SeriesUnit>, survey: &Survey) -> Draft {
        let (unit, told) = self.unit(unit, &samples);
        let mut draft = Draft::new(samples, unit, (survey.first, survey.first, survey.last));
        draft.warnings.extend(told);
        draft.initial = self.keys.initial();
        draft.first_time = self.keys.first_time();
        self.stated.state(&mut draft, survey.numbers);
        draft
    }
}

/// Reads numbers with decimal points.
fn numbers(
    source: &Source<'_>,
    header: Option<&Header>,
    said: &Said,
) -> Result<Vec<Series>, GroundMotionError> {
    if let Some(text) = &source.options.layout {
        if let Some(layout) = Layout::parse(text) {
            return fixed(source, layout, said);
        }
        // No column has such a name.
        if text.contains(['(', ')', '.']) {
            let error = GroundMotionError::Unsupported {
                file: source.file.to_owned(),
                what: format!("the Fortran format \"{text}\" is not understood"),
                remedy: "give one of numbers of one width, such as \"8F10.5\", \"(1P5E14.6)\", \"2X,8F9.5\" or \"5(1X,E14.7)\"",
            };
            return Err(error.of_option("layout"));
        }
        let names: Vec<String> = text.split(',').map(|n| n.trim().to_owned()).collect();
        if let Some(header) = header {
            header::layout_agrees(source, header, &names).map_err(|e| e.of_option("layout"))?;
        }
        let survey = Survey::new(source, true)?;
        if names == ["a"] {
            let head = survey.head(source, true)?;
            survey.regular(source, head)?;
            return wrapped(source, &survey, head, said);
        }
        if let Some(below) = survey.head_of_columns(source, names.len())? {
            return below_head(source, header, said, below);
        }
        return columns(source, &survey, &Columns::new(names, header), said);
    }
    if let Some(header) = header {
        let survey = Survey::new(source, true)?;
        return headed(source, &survey, header, said);
    }
    let survey = Survey::new(source, false)?;
    if let Some(below) = survey.head_of_columns(source, 2)? {
        return below_head(source, header, said, below);
    }
    match survey.arrangement(source, &said.stated.counted())? {
        Arrangement::Wrapped => {
            let step = source.options.time_step.or(said.stated.first_step());
            survey.starts_as_samples(source, step)?;
            wrapped(source, &survey, None, said)
        }
        Arrangement::Headed(head) => wrapped(source, &survey, Some(head), said),
        Arrangement::Columns(names) => {
            let mut columns = Columns::new(names, None);
            columns.declared = false;
            match columns::columns(source, &survey, &columns, said) {
                Err(GroundMotionError::Contradiction {
                    quantity: "time_step",
                    stated,
                    given,
                    ..
                }) if stated == "1 s" => Err(counts_rows(source, &survey, &columns.names, &given)),
                found => found,
            }
        }
        Arrangement::Cards => cards(source, &survey, said),
    }
}

/// Columns below a row of their count, or of count and step, which they must bear out.
fn below_head(
    source: &Source<'_>,
    header: Option<&Header>,
    said: &Said,
    head: (usize, Head),
) -> Result<Vec<Series>, GroundMotionError> {
    let (line, Head { count, step, .. }) = head;
    let mut options = source.options.clone();
    options.skip_lines = line;
    let below = Source::new(source.file, source.bytes, &options, source.path);
    let series = numbers(&below, header, said)?;
    for warning in below.warnings() {
        source.warn(&warning);
    }
    source.uses(below.used());
    for one in &series {
        let found = one.samples.len();
        if found != count {
            return Err(source.error(
                line,
                0,
                format!("the first row says {count} samples, but {found} stand below it"),
                "get the record again; if the row says nothing of the values, pass it over by `skip_lines`",
            ));
        }
        let own = one.sampling.median_step();
        if let Some(step) = step.filter(|step| (step - own).abs() > 0.01 * step) {
            return Err(source.error(
                line,
                0,
                format!("the first row says a step of {step} s, but the values are {own} s apart"),
                "get the record again; if the row says nothing of the values, pass it over by `skip_lines`",
            ));
        }
    }
    Ok(series)
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

/// Columns that a header names, held against the lines before it.
fn headed(
    source: &Source<'_>,
    survey: &Survey,
    header: &Header,
    said: &Said,
) -> Result<Vec<Series>, GroundMotionError> {
    let mut columns = Columns::of_roles(&header.columns);
    for unit in columns.units.iter().flatten() {
        said.keys.agree(source, *unit, &header.text)?;
        said.stated.agrees(source, *unit, &header.text)?;
    }
    if let ([name], [Role::Acceleration(..)]) = (columns.names.as_slice(), &*header.columns) {
        // A title with the unit above columns that are told apart by their numbers.
        let counted = said.stated.counted();
        if survey.width() > 1
            && let Ok(Arrangement::Columns(names)) =
                Survey::new(source, false)?.arrangement(source, &counted)
        {
            let mut below = Columns::new(names, None);
            below.declared = false;
            let of = |name: &String| columns.units[0].filter(|_| name != "t" && name != "-");
            below.units = below.names.iter().map(of).collect();
            return columns::columns(source, survey, &below, said);
        }
        // Values may follow one another along the rows.
        survey.regular(source, None)?;
        survey.is_one_series(source, &counted)?;
        let samples = along(source, survey, 0)?;
        without_times(source, survey.first, &samples, survey.width())?;
        let mut draft = said.draft(samples, columns.units[0], survey);
        fills_a_row(&mut draft, survey.width());
        draft.times = Times::Step(said.stated.step(source, None)?);
        draft.component.clone_from(name);
        return Ok(vec![draft.finish(source)?]);
    }
    let first = rows(source).next();
    columns.separator = first.and_then(|row| header::separator_of_rows(header.separator, &row));
    let names = columns.names.len();
    let row = rows(source).find(|l| {
        let found = header::row_cells(l, columns.separator).len();
        let all = match columns.separator {
            None => found,
            Some(b'\t') => found.max(names),
            Some(separator) => l.bytes.split(|b| *b == separator).count(),
        };
        !(found..=all).contains(&names)
    });
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
    if !header.left_out.is_empty() {
        source.warn(&format!(
            "line {}: columns that are not read as accelerations: {}",
            header.line,
            header.left_out.join(", ")
        ));
    }
    let mut series = columns::columns(source, survey, &columns, said)?;
    for one in &mut series {
        one.origin.header_line = Some(header.line);
    }
    Ok(series)
}

/// A series along rows of fixed width.
fn fixed(
    source: &Source<'_>,
    layout: Layout,
    said: &Said,
) -> Result<Vec<Series>, GroundMotionError> {
    let room = source.bytes.len() / layout.width + 1;
    let mut samples = Vec::with_capacity(room);
    let mut first = 0;
    let mut last = 0;
    let mut cards = Counter::default();
    let mut usual = None;
    let mut forms = Forms::of(layout);
    let mut lines = rows(source).peekable();
    while let Some(line) = lines.next() {
        first = if first == 0 { line.number } else { first };
        last = line.number;
        // Row numbers of cards stand after the numbers, and are not data.
        let width = layout.margin + layout.per_line * layout.width;
        is_counted(source, line, width, layout, &mut cards)?;
        let before = samples.len();
        let mut bytes = &line.bytes[..width.min(line.bytes.len())];
        if lines.peek().is_none() && line.bytes.len() > width {
            // The last card may hold fewer numbers before its own.
            let filled = bytes.trim_ascii_end().len().saturating_sub(layout.margin);
            bytes = &bytes[..layout.margin + filled.next_multiple_of(layout.width)];
        }
        let read = source.row(Line { bytes, ..line }, layout, &mut samples);
        if line.number == first && lines.peek().is_some() && is_head(&line, layout.per_line) {
            return Err(source.error(
                line.number,
                0,
                format!(
                    "the first row, \"{}\", is no row of the layout: a count or a step?",
                    line.text().trim()
                ),
                &skipping(line.number),
            ));
        }
        read?;
        source.see_row(Line { bytes, ..line }, layout, &mut forms);
        let found = samples.len() - before;
        let usual = *usual.get_or_insert(found);
        if found > usual || found < usual && lines.peek().is_some() {
            let message = format!("{found} numbers, where the rows before have {usual}");
            return Err(source.error(line.number, 0, message, row_widths::REMEDY));
        }
    }
    cards.goes_on(source, layout.per_line + 1, true)?;
    forms.are_whole(source)?;
    if let Some(line) = cards.first_other().filter(|_| !layout.more)
        && let Some(line) = rows(source).find(|l| l.number == line)
    {
        let width = layout.margin + layout.per_line * layout.width;
        return Err(left_over(source, line, width));
    }
    without_times(source, first, &samples, layout.per_line)?;
    let (unit, told) = said.unit(None, &samples);
    let mut draft = Draft::new(samples, unit, (first, first, last));
    draft.warnings.extend(told);
    draft.initial = said.keys.initial();
    draft.first_time = said.keys.first_time();
    said.stated.state(&mut draft, 0);
    fills_a_row(&mut draft, layout.per_line);
    draft.times = Times::Step(said.stated.step(source, None)?);
    Ok(vec![draft.finish(source)?])
}

/// Whether a row is a whole number without a point, with at most one more, and has fewer numbers
/// than the rows of a layout: a count before the values.
fn is_head(line: &Line<'_>, per_line: usize) -> bool {
    let whole = |field: &[u8]| field.iter().all(u8::is_ascii_digit);
    let mut fields = line.fields().map(|(_, field)| field);
    fields.next().is_some_and(whole) && fields.count() < per_line.saturating_sub(1).min(2)
}

/// How to pass over the lines up to one.
fn skipping(line: usize) -> String {
    format!(
        "pass over what stands before the values: `skip_lines = {line}` in [ground_motion] of a case, `--skip-lines {line}` with `pounding motion`"
    )
}

/// Takes the number of a card that stands behind its numbers, which end at a column.
///
/// # Errors
/// Anything else there, unless the format goes on: the layout has fewer numbers than the rows.
fn is_counted(
    source: &Source<'_>,
    line: Line<'_>,
    width: usize,
    layout: Layout,
    cards: &mut Counter,
) -> Result<(), GroundMotionError> {
    let behind = line.columns(width, line.bytes.len());
    let is_number = !behind.is_empty() && behind.bytes().all(|b| b.is_ascii_digit());
    if !behind.is_empty() || layout.more {
        let column = width + source.options.skip_columns;
        cards.see(line.number, column, behind.as_bytes());
    }
    if behind.is_empty() || layout.more || is_number {
        return Ok(());
    }
    Err(left_over(source, line, width))
}

/// The error of a layout that has fewer numbers than the rows.
fn left_over(source: &Source<'_>, line: Line<'_>, width: usize) -> GroundMotionError {
    let behind = line.columns(width, line.bytes.len());
    source.error(
        line.number,
        width + source.options.skip_columns,
        format!(
            "the row has {} columns, of which the layout takes {width}: \"{}\" is left over, and does not count the rows",
            line.bytes.len(),
            crate::number::shown(behind.as_bytes())
        ),
        "give the format of all numbers of a row in `layout`, such as \"8F10.5\"; or that of what is to be passed over behind them, such as \"8F9.5,I7\"",
    )
}

/// A series along the rows, after rows of count and step if there are any.
fn wrapped(
    source: &Source<'_>,
    survey: &Survey,
    head: Option<Head>,
    said: &Said,
) -> Result<Vec<Series>, GroundMotionError> {
    let samples = along(source, survey, head.map_or(0, |head| head.rows))?;
    without_times(source, survey.first, &samples, survey.width())?;
    let mut draft = said.draft(samples, None, survey);
    fills_a_row(&mut draft, survey.width());
    let mut found = None;
    if let Some(head) = head {
        draft.header_count = Some(head.count);
        found = head.step;
    }
    draft.times = Times::Step(said.stated.step(source, found)?);
    Ok(vec![draft.finish(source)?])
}

/// Takes zeros off the end of a series along rows of several values, at most a row of them, that stand there beyond
/// the count of the header: programs write so many that the last row is whole.
fn fills_a_row(draft: &mut Draft, width: usize) {
    let found = draft.samples.len();
    let Some(stated) = draft.header_count.filter(|stated| *stated < found) else {
        return;
    };
    let surplus = found - stated;
    if width < 2 || surplus > width || draft.samples[stated..].iter().any(|a| *a != 0.0) {
        return;
    }
    draft.samples.truncate(stated);
    draft.warnings.push(format!(
        "header says {stated} samples, {found} found; the surplus, zeros that fill the last row, is not used"
    ));
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
    if survey.width() == 1 {
        without_blank_lines(source, survey)?;
    }
    let mut samples = Vec::with_capacity(survey.numbers);
    let mut forms = Forms::default();
    let mut thousands = Thousands::default();
    for line in rows(source).skip(skipped) {
        for (column, field) in line.fields() {
            let column = column + source.options.skip_columns;
            samples.push(source.number(line, column, field)?);
            forms.see(line.number, column, field);
            thousands.see(line.number, column, field);
        }
    }
    if ends_within_a_number(source) {
        let values = rows(source).skip(skipped).flat_map(|line| {
            let place = move |(column, field)| (line, column + source.options.skip_columns, field);
            line.fields().map(place)
        });
        if !source.is_last_whole(values)? {
            samples.truncate(samples.len() - 1);
        }
    }
    forms.are_whole(source)?;
    thousands.are_none(source)?;
    Ok(samples)
}

/// Whether the last number of the rows may go on behind the end of the file: what closes a row, a blank, a quote or a
/// separator, ends it.
fn ends_within_a_number(source: &Source<'_>) -> bool {
    let of_number = |b: &u8| b.is_ascii_digit() || b"+-.eEdD".contains(b);
    let last = source.all_lines().last().map(|line| line.number);
    source.bytes.last().is_some_and(of_number) && rows(source).last().map(|row| row.number) == last
}

/// Refuses a blank line among values that stand one in a row: one may be missing there.
fn without_blank_lines(source: &Source<'_>, survey: &Survey) -> Result<(), GroundMotionError> {
    let blank = |line: &Line<'_>| {
        (survey.first..survey.last).contains(&line.number) && line.fields().next().is_none()
    };
    // Lines may be double-spaced throughout.
    let count = source.all_lines().filter(blank).count();
    match source
        .all_lines()
        .find(blank)
        .filter(|_| 2 * count < survey.numbers)
    {
        Some(line) => Err(source.error(
            line.number,
            0,
            "a blank line among the values, of which one may be missing here",
            "write the value that is missing, or take the line out if none is",
        )),
        None => Ok(()),
    }
}

/// Card images: the last number of each row is the row's.
fn cards(
    source: &Source<'_>,
    survey: &Survey,
    said: &Said,
) -> Result<Vec<Series>, GroundMotionError> {
    let mut samples = Vec::with_capacity(survey.numbers);
    let mut forms = Forms::default();
    let mut thousands = Thousands::default();
    for line in rows(source) {
        let mut fields = line.fields().peekable();
        while let Some((column, field)) = fields.next() {
            let value = source.number(line, column, field)?;
            if fields.peek().is_some() {
                samples.push(value);
                forms.see(line.number, column, field);
                thousands.see(line.number, column, field);
            }
        }
    }
    forms.are_whole(source)?;
    thousands.are_none(source)?;
    without_times(source, survey.first, &samples, survey.width() - 1)?;
    let mut draft = said.draft(samples, None, survey);
    draft.times = Times::Step(said.stated.step(source, None)?);
    draft
        .warnings
        .push("the last column counts the rows and is not data".to_owned());
    Ok(vec![draft.finish(source)?])
}
