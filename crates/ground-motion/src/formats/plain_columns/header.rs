//! Names and units of columns in the line before the rows: `time (s),acceleration (m/s2)`,
//! `t [s];a [g]`, `time_s acceleration_g`.

use crate::quantity::{NamedWithUnit, Quantity, SeriesUnit, named_with_unit, of_something_else};
use crate::text::Line;

/// What a column holds.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Role {
    /// Times; one of their unit (s).
    Time(f64),
    /// Accelerations with their name and, if it stands there, their unit.
    Acceleration(String, Option<SeriesUnit>),
    /// Velocities, displacements, row numbers: passed over.
    Other,
}

/// A header that names every column.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Header {
    /// Its line, from 1.
    pub line: usize,
    /// As it stands there.
    pub text: String,
    /// The columns in their order.
    pub columns: Vec<Role>,
    /// What stands between the names; `None`: blanks.
    pub separator: Option<char>,
    /// Names of columns that hold something else than motion, or nobody knows what.
    pub left_out: Vec<String>,
}

/// What may stand before names that other programs should pass over.
const COMMENT: [char; 7] = ['#', '%', '!', '*', '/', ' ', '\u{feff}'];
/// Bytes that a header may have: a row of numbers may be the whole file.
pub(super) const LONGEST: usize = 4000;
const TIME: [&str; 11] = [
    "t",
    "time",
    "times",
    "elapsed time",
    "zeit",
    "temps",
    "tiempo",
    "tempo",
    "zaman",
    "時間",
    "时间",
];
const ACCELERATION: [&str; 9] = [
    "a",
    "ag",
    "a g",
    "acc",
    "accel",
    "acceleration",
    "accelerations",
    "ground acceleration",
    "ground accel",
];
const MOTION: [&str; 8] = [
    "v",
    "vel",
    "velocity",
    "ground velocity",
    "d",
    "disp",
    "displacement",
    "ground displacement",
];
const COUNTER: [&str; 14] = [
    "-",
    "#",
    "n",
    "no",
    "nr",
    "row",
    "index",
    "sample",
    "id",
    "step",
    "point",
    "count",
    "line",
    "record no",
];
/// Words of names of columns that hold no motion.
const FOREIGN: [&str; 27] = [
    "force",
    "forces",
    "load",
    "loads",
    "moment",
    "shear",
    "pressure",
    "stress",
    "strain",
    "drift",
    "temp",
    "temperature",
    "humidity",
    "volt",
    "volts",
    "voltage",
    "current",
    "gyro",
    "rotation",
    "angle",
    "tilt",
    "flag",
    "status",
    "arias",
    "energy",
    "husid",
    "counts",
];
/// Names of columns of response spectra and Fourier spectra.
const SPECTRAL: [&str; 19] = [
    "sa",
    "psa",
    "spa",
    "s a",
    "sv",
    "psv",
    "sd",
    "period",
    "periods",
    "natural period",
    "frequency",
    "freq",
    "damping",
    "damping ratio",
    "spectrum",
    "response spectrum",
    "psd",
    "power",
    "response acceleration",
];
/// Words that stand in sentences, and in no name of a column between blanks.
const PROSE: [&str; 17] = [
    "history",
    "histories",
    "series",
    "of",
    "in",
    "the",
    "and",
    "for",
    "at",
    "with",
    "from",
    "by",
    "record",
    "data",
    "motion",
    "component",
    "is",
];
/// Units that no acceleration has.
const FOREIGN_UNITS: [&str; 23] = [
    "count", "counts", "cts", "lsb", "adc", "v", "mv", "uv", "volt", "volts", "n", "kn", "mn",
    "lbf", "kip", "kips", "pa", "kpa", "mpa", "rad/s", "deg/s", "strain", "deg",
];
/// Names behind which a unit may follow after a blank or an underscore alone. `a_g` is not
/// one: it may be the symbol of the ground's acceleration, or an acceleration in g.
const LONG: [&str; 10] = [
    "t",
    "time",
    "times",
    "elapsed time",
    "acc",
    "accel",
    "acceleration",
    "accelerations",
    "ground acceleration",
    "ground accel",
];

/// Whether a name says that a column holds accelerations, and nothing else of it.
pub(super) fn is_acceleration(name: &str) -> bool {
    ACCELERATION.contains(&plain(name).as_str())
}

/// Whether a name is that of a column of times; they may be numbered, `t1` and `t2`.
fn is_time(known: &str) -> bool {
    TIME.contains(
        &known
            .trim_end_matches(|c: char| c.is_ascii_digit())
            .trim_end(),
    )
}

/// Units of time (s).
pub(super) fn time_unit(text: &str) -> Option<f64> {
    match text.trim().trim_end_matches('.').to_lowercase().as_str() {
        "s" | "sec" | "secs" | "second" | "seconds" | "seg" | "segs" | "segundos" | "saniye"
        | "sn" => Some(1.0),
        "ms" | "msec" | "millisecond" | "milliseconds" => Some(1.0e-3),
        _ => None,
    }
}

/// A unit of motion in any of its spellings: `m/s²`, `m/s^2`, `m s-2`, `m_s2`, `m/s**2`.
pub(in crate::formats) fn motion_unit(text: &str) -> Option<SeriesUnit> {
    let plain = text
        .trim()
        .to_lowercase()
        .replace('²', "2")
        .replace(['−', '⁻'], "-");
    let spaced = ["s-2", "s^-2", "sec-2", "sec^-2"].iter().find_map(|end| {
        let length = plain.strip_suffix(end)?;
        let length = length.strip_suffix([' ', '.', '·', '*', '_'])?;
        Some(format!("{length}/s2"))
    });
    if plain == "g/1000" {
        return Some(SeriesUnit::MILLI_G);
    }
    // SeriesUnit takes stops out, which are none of a unit of a header.
    let known = |text: &str| SeriesUnit::parse(text).filter(|_| !text.contains('.'));
    known(&spaced.unwrap_or_else(|| plain.clone())).or_else(|| known(&plain.replacen('_', "/", 1)))
}

/// A line cut into the names of columns.
pub(super) struct Cells {
    /// Line, from 1.
    pub line: usize,
    text: String,
    names: Vec<String>,
    separator: Option<char>,
}

fn cells(line: &Line<'_>) -> Option<Cells> {
    if line.bytes.len() > LONGEST {
        return None;
    }
    let text = match std::str::from_utf8(line.bytes) {
        Ok(text) => text.to_owned(),
        Err(_) => line.text(),
    };
    // What programs write before a header that others should pass over.
    let bare = text.trim_start_matches(COMMENT);
    let separator = ['|', ';', '\t', ',']
        .into_iter()
        .find(|s| bare.contains(*s));
    let cells: Vec<String> = match separator {
        Some(separator) => bare.split(separator).map(str::to_owned).collect(),
        None => words(bare),
    };
    // Separators may close the line.
    let mut names = cells;
    while names.len() > 1 && names.last().is_some_and(|last| last.trim().is_empty()) {
        names.pop();
    }
    Some(Cells {
        line: line.number,
        text: text.trim().to_owned(),
        names,
        separator,
    })
}

/// The header, if every cell of the line names a column and one is an acceleration.
pub(super) fn parse(line: &Line<'_>) -> Option<Header> {
    cells(line)?.parse()
}

/// Lines that may name columns. Units in a line of their own below the names, `s,m/s2` below
/// `Time,Acc`, are those of the names; rules between the lines are none.
pub(super) fn name_lines<'a>(lines: impl Iterator<Item = Line<'a>>) -> Vec<Cells> {
    let mut found: Vec<Cells> = Vec::new();
    for line in lines {
        if is_rule(&line) {
            continue;
        }
        let Some(cells) = cells(&line) else {
            continue;
        };
        if let Some(both) = found.last().and_then(|names| names.with_units(&cells)) {
            found.pop();
            found.push(both);
        } else {
            found.push(cells);
        }
    }
    found
}

/// Whether a line is a rule, `---` or `=== ===`.
fn is_rule(line: &Line<'_>) -> bool {
    let rule = |b: &u8| b"-=_+|".contains(b);
    let bare = line.bytes.trim_ascii_start();
    let bare = bare.strip_prefix(b"#").unwrap_or(bare);
    let fields = || {
        bare.split(|b| matches!(b, b' ' | b'\t' | b',' | b';'))
            .filter(|f| !f.is_empty())
    };
    fields().next().is_some() && fields().all(|f| f.len() > 1 && f.iter().all(rule))
}

/// The cells of a row between separators, with their places; those that are blank at its end
/// are none. Without a separator, its fields.
pub(super) fn row_cells<'a>(line: &Line<'a>, separator: Option<u8>) -> Vec<(usize, &'a [u8])> {
    let Some(separator) = separator else {
        return line.fields().collect();
    };
    let mut at = 0;
    let mut found: Vec<_> = line
        .bytes
        .split(|b| *b == separator)
        .map(|cell| {
            let blank = cell.iter().take_while(|b| b.is_ascii_whitespace()).count();
            let place = at + blank;
            at += cell.len() + 1;
            (place, cell.trim_ascii())
        })
        .collect();
    while found.last().is_some_and(|(_, cell)| cell.is_empty()) {
        found.pop();
    }
    found
}

/// The byte that stands between the cells of rows below names between `separator`.
pub(super) fn separator_of_rows(separator: Option<char>, row: &Line<'_>) -> Option<u8> {
    // Bars were taken out of the rows.
    let byte = match separator? {
        '|' => b';',
        other => u8::try_from(other).ok()?,
    };
    row.bytes.contains(&byte).then_some(byte)
}

/// What a cell of a line that names a column of times says.
enum Kind {
    /// Understood as it stands.
    Known(Role),
    /// An acceleration by its name, without a unit.
    Component,
    /// Something else than motion.
    Foreign,
    /// A name of which nothing is known.
    Unknown,
}

impl Cells {
    fn parse(&self) -> Option<Header> {
        let columns: Vec<Role> = self.names.iter().map(|c| role(c)).collect::<Option<_>>()?;
        let times = columns
            .iter()
            .filter(|c| matches!(c, Role::Time(_)))
            .count();
        let found = columns.iter().any(|c| matches!(c, Role::Acceleration(..)));
        (found && times <= 1).then(|| self.header(columns, Vec::new()))
    }

    fn header(&self, columns: Vec<Role>, left_out: Vec<String>) -> Header {
        Header {
            line: self.line,
            text: self.text.clone(),
            columns,
            separator: self.separator,
            left_out,
        }
    }

    /// The header of rows like the first one: every cell names a column, or one is that of times,
    /// and the names need no units.
    pub(super) fn header_of(&self, row: &Line<'_>) -> Option<Header> {
        self.parse().or_else(|| self.beside_times(row))
    }

    /// Whether the rows have as many cells as there are names.
    fn fits(&self, row: &Line<'_>) -> bool {
        let separator = separator_of_rows(self.separator, row);
        let filled = row_cells(row, separator).len();
        // Tabs at the end of a line are cut off with its blanks.
        let all = match separator {
            None => filled,
            Some(b'\t') => filled.max(self.names.len()),
            Some(separator) => row.bytes.split(|b| *b == separator).count(),
        };
        (filled..=all).contains(&self.names.len())
    }

    fn beside_times(&self, row: &Line<'_>) -> Option<Header> {
        let prose = |name: &String| PROSE.contains(&plain(name).as_str());
        if self.names.len() < 2
            || !self.fits(row)
            || self.separator.is_none() && self.names.iter().any(prose)
        {
            return None;
        }
        let mut kinds: Vec<Kind> = self.names.iter().map(|c| kind(c)).collect::<Option<_>>()?;
        // North, not a number of the rows, beside east or up.
        let single = |of: &[&str]| {
            self.names
                .iter()
                .position(|n| of.contains(&plain(n).as_str()))
        };
        if let (Some(north), Some(_)) = (single(&["n"]), single(&["e", "z"])) {
            kinds[north] = Kind::Unknown;
        }
        if !kinds
            .iter()
            .any(|k| matches!(k, Kind::Known(Role::Time(_))))
        {
            return None;
        }
        let accelerates =
            |k: &Kind| matches!(k, Kind::Known(Role::Acceleration(..)) | Kind::Component);
        let sure = kinds.iter().any(accelerates);
        let mut left_out = Vec::new();
        let columns = self.names.iter().zip(kinds).map(|(name, kind)| {
            let name = unquoted(name).to_owned();
            match kind {
                Kind::Known(role) => role,
                Kind::Component => Role::Acceleration(name, None),
                Kind::Unknown if !sure => Role::Acceleration(name, None),
                Kind::Unknown | Kind::Foreign => {
                    left_out.push(name);
                    Role::Other
                }
            }
        });
        let columns: Vec<Role> = columns.collect();
        let found = columns.iter().any(|c| matches!(c, Role::Acceleration(..)));
        found.then(|| self.header(columns, left_out))
    }

    /// The same names with units that stand in the line below them.
    fn with_units(&self, below: &Self) -> Option<Self> {
        // Brackets between blanks belong to no name before them here.
        let text = below.text.trim_start_matches(COMMENT);
        let fields = || text.split_whitespace().map(bare_unit).collect();
        let units: Vec<String> = match below.separator {
            Some(_) => below.names.iter().map(|unit| bare_unit(unit)).collect(),
            None => fields(),
        };
        let is_unit = |unit: &&String| time_unit(unit).is_some() || motion_unit(unit).is_some();
        let known = units.iter().filter(is_unit).count();
        let named = |name: &&String| {
            let known = plain(name);
            TIME.contains(&known.as_str())
                || ACCELERATION.contains(&known.as_str())
                || is_channel(&known)
        };
        let may = units.len() == self.names.len()
            && known > 0
            && 2 * known >= units.len()
            && units.iter().all(|u| u.chars().count() <= 8)
            && self.names.iter().all(|n| !n.contains(['(', '[']))
            && self.names.iter().any(|n| named(&n));
        let both = |(name, unit): (&String, &String)| match unit.as_str() {
            "" | "-" => name.clone(),
            unit => format!("{} ({unit})", unquoted(name)),
        };
        may.then(|| Self {
            line: self.line,
            text: format!("{} / {}", self.text, below.text),
            names: self.names.iter().zip(&units).map(both).collect(),
            separator: self.separator,
        })
    }

    /// Whether the cells name the columns of rows without saying that one has the times: `NS EW
    /// UD`, `Roof,Base,Mid,Free field`.
    pub(super) fn names_columns(&self, row: &Line<'_>) -> bool {
        let number = |name: &String| name.trim().bytes().all(|b| b.is_ascii_digit() || b == b'.');
        let known = |name: &&String| {
            let known = plain(name);
            is_channel(&known) || ACCELERATION.contains(&known.as_str())
        };
        let known = self.names.iter().filter(known).count();
        let as_many = self.names.len() == row.fields().count();
        if self.names.len() < 2 || !as_many {
            return false;
        }
        if known == self.names.len() {
            return true;
        }
        if self.names.iter().any(number) {
            return false;
        }
        separator_of_rows(self.separator, row).is_some() || 2 * known >= self.names.len()
    }

    /// The names as those of `layout`.
    pub(super) fn as_layout(&self) -> String {
        let name = |name: &String| -> String {
            let plain = unquoted(name).replace(['(', ')', '[', ']', '.', ','], " ");
            plain.split_whitespace().collect::<Vec<_>>().join("_")
        };
        self.names.iter().map(name).collect::<Vec<_>>().join(",")
    }
}

/// A unit without quotes and brackets around it.
pub(super) fn bare_unit(text: &str) -> String {
    let unit = unquoted(text);
    let inner = unit
        .strip_prefix(['(', '['])
        .and_then(|u| u.strip_suffix([')', ']']));
    inner.unwrap_or(unit).trim().to_owned()
}

/// What a cell of a header says; `None`: a unit that is not known, which is an error of its own.
fn kind(cell: &str) -> Option<Kind> {
    let cell = unquoted(cell);
    let whole = plain(cell);
    if cell.is_empty() || whole.starts_with("unnamed:") {
        return Some(Kind::Known(Role::Other));
    }
    if is_spectral(cell) {
        return Some(Kind::Foreign);
    }
    if let Some(role) = role(cell) {
        return Some(Kind::Known(role));
    }
    if is_channel(&whole) {
        return Some(Kind::Component);
    }
    let known = |name: &str| {
        let all: [&[&str]; 3] = [&TIME, &ACCELERATION, &MOTION];
        all.iter().any(|names| names.contains(&name))
    };
    if let Some((name, _)) = cell.split_once(['(', '[']) {
        let name = plain(name);
        return (!known(&name) && !is_channel(&name)).then_some(Kind::Foreign);
    }
    let word = |of: &dyn Fn(&str) -> bool| {
        whole
            .split(|c: char| !c.is_alphabetic())
            .filter(|w| !w.is_empty())
            .any(of)
    };
    if word(&|w| FOREIGN.contains(&w)) {
        return Some(Kind::Foreign);
    }
    let first = whole.split([' ', '-']).next().unwrap_or_default();
    if known(first) && whole != first {
        // `acc_furlongs` has a unit, `Acc roof` a name.
        return match cell.contains('_') || !ACCELERATION.contains(&first) {
            true => None,
            false => Some(Kind::Component),
        };
    }
    Some(match is_component(first) {
        true => Kind::Component,
        false => Kind::Unknown,
    })
}

/// Whether a name is that of a component or of one of several instruments: `ns`, `acc1`, `ch 3`.
fn is_channel(known: &str) -> bool {
    let base = known.trim_end_matches(|c: char| c.is_ascii_digit());
    let numbered = base.len() < known.len() && !base.is_empty();
    let base = base.trim_end_matches([' ', '#', '-']);
    let instrument = ["ch", "chan", "channel", "sensor", "rsn", "rec"].contains(&base);
    is_component(known)
        || numbered && (instrument || ACCELERATION.contains(&base) || is_component(base))
}

/// Whether a name is that of an ordinate or abscissa of a spectrum, with or without a unit.
fn is_spectral(cell: &str) -> bool {
    let cell = unquoted(cell);
    let name = cell.split(['(', '[']).next().unwrap_or(cell);
    let known = plain(&name.replace('-', " "));
    let words: Vec<&str> = known.split(' ').collect();
    let is_unit =
        |unit: &str| motion_unit(unit).is_some() || time_unit(unit).is_some() || unit == "hz";
    let named = |count: usize| SPECTRAL.contains(&words[..count].join(" ").as_str());
    let with_unit = |count: usize| named(count) && is_unit(&words[count..].join("_"));
    let starts = ["spectral", "pseudo", "rotd", "fourier", "gmrot"];
    let motions = [
        "acceleration",
        "acc",
        "velocity",
        "displacement",
        "amplitude",
        "sa",
        "psa",
    ];
    named(words.len())
        || (1..words.len()).any(with_unit)
        || starts.iter().any(|start| known.starts_with(start))
            && (words.len() == 1 || motions.iter().any(|motion| words.contains(motion)))
}

/// A cell without quotes and blanks around it.
fn unquoted(cell: &str) -> &str {
    cell.trim().trim_matches(['"', '\'']).trim()
}

/// Why a line that names columns is not the header of an acceleration.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Fault {
    /// Its columns are known, and none is an acceleration: the name of one that is not.
    NoAcceleration(Quantity, String),
    /// The columns of a spectrum: the name of one.
    Spectrum(String),
    /// Names of columns of which none is a motion: that of one.
    Foreign(String),
    /// A column of times in a unit that is not known: name of the column, unit.
    TimeUnit(String, String),
    /// A column of motion in a unit that is not known: name of the column, unit.
    MotionUnit(String, String),
    /// Two columns of times.
    TwoTimes,
    /// A column of which nothing is known: its number from 1, its name.
    Column(usize, String),
}

/// What is wrong with a line that names columns but is no header; `None` for prose, which
/// names no column with a unit.
#[cfg(test)]
fn fault(line: &Line<'_>) -> Option<(String, Fault)> {
    fault_of(&cells(line)?)
}

/// The same of a line that is cut into names.
pub(super) fn fault_of(cells: &Cells) -> Option<(String, Fault)> {
    let said = |fault| Some((cells.text.clone(), fault));
    if let Some(fault) = of_values(cells).or_else(|| of_spectrum(cells)) {
        return said(fault);
    }
    let names = &cells.names;
    let roles: Vec<Option<Role>> = names.iter().map(|c| role(c)).collect();
    let unknown_unit = names.iter().zip(&roles).find_map(|(name, role)| {
        let (known, unit) = divided(name).filter(|_| role.is_none())?;
        // What follows a blank is a word of a sentence unless it is known as a unit.
        if !name.contains(['(', '[', '_']) {
            return None;
        }
        let name = name.trim().to_owned();
        if TIME.contains(&known.as_str()) {
            return time_unit(&unit)
                .is_none()
                .then_some(Fault::TimeUnit(name, unit));
        }
        let moves = ACCELERATION.contains(&known.as_str())
            || MOTION.contains(&known.as_str())
            || name.contains(['(', '[']) && is_channel(&known);
        (moves && motion_unit(&unit).is_none()).then_some(Fault::MotionUnit(name, unit))
    });
    let bare = |name: &String| {
        let known = plain(name);
        TIME.contains(&known.as_str()) || MOTION.contains(&known.as_str())
    };
    // Names between blanks that have no unit may be words of a sentence, as may one alone.
    let with_unit = names.iter().zip(&roles).any(|(name, role)| {
        role.is_some() && (divided(name).is_some() || cells.separator.is_some() && bare(name))
    });
    // Unless all are names of columns, of which one is the time.
    let all_named = roles.iter().all(Option::is_some)
        && roles.iter().any(|r| matches!(r, Some(Role::Time(_))))
        && !roles
            .iter()
            .any(|r| matches!(r, Some(Role::Acceleration(..))));
    if names.len() < 2 || !(with_unit || all_named || unknown_unit.is_some()) {
        return None;
    }
    let fault = if let Some(fault) = unknown_unit {
        fault
    } else if let Some(k) = roles.iter().position(Option::is_none) {
        Fault::Column(k + 1, names[k].trim().to_owned())
    } else if roles
        .iter()
        .any(|r| matches!(r, Some(Role::Acceleration(..))))
    {
        // The header is wrong in that alone, or it is right.
        let times = roles.iter().filter(|r| matches!(r, Some(Role::Time(_))));
        (times.count() > 1).then_some(Fault::TwoTimes)?
    } else {
        let moving = |name: &String| Some((quantity(name)?, name.trim().to_owned()));
        let (quantity, name) = names.iter().find_map(moving)?;
        Fault::NoAcceleration(quantity, name)
    };
    said(fault)
}

/// The columns of a spectrum, or of times beside what is no motion.
fn of_spectrum(cells: &Cells) -> Option<Fault> {
    let names = &cells.names;
    let kinds: Vec<Kind> = names.iter().map(|c| kind(c)).collect::<Option<_>>()?;
    let accelerates = |k: &Kind| matches!(k, Kind::Known(Role::Acceleration(..)) | Kind::Component);
    if kinds.iter().any(accelerates) && !names.iter().any(|n| is_abscissa(n)) {
        return None;
    }
    // Words of a sentence are none of these.
    if kinds.iter().any(|k| matches!(k, Kind::Unknown)) {
        return None;
    }
    if let Some(name) = names.iter().find(|n| is_spectral(n)) {
        let with_unit = names.len() > 1 || name.contains(['(', '[', '_']);
        return with_unit.then(|| Fault::Spectrum(unquoted(name).to_owned()));
    }
    let timed = kinds
        .iter()
        .any(|k| matches!(k, Kind::Known(Role::Time(_))));
    let other = |k: &Kind| matches!(k, Kind::Known(Role::Time(_)) | Kind::Foreign);
    if !timed || !kinds.iter().all(other) {
        return None;
    }
    let (name, _) = names
        .iter()
        .zip(&kinds)
        .find(|(_, k)| matches!(k, Kind::Foreign))?;
    Some(Fault::Foreign(unquoted(name).to_owned()))
}

/// Whether a column is what the ordinates of a spectrum stand over.
fn is_abscissa(name: &str) -> bool {
    is_spectral(name)
        && ["period", "natural period", "freq"]
            .iter()
            .any(|n| plain(name).starts_with(n))
}

/// Whether a unit is that of something else than motion: counts, volts, forces.
pub(super) fn is_foreign_unit(unit: &str) -> bool {
    FOREIGN_UNITS.contains(&unit.trim().to_lowercase().as_str())
}

/// The velocity or displacement that a line names as the quantity of the values below it: alone,
/// `Velocity (cm/s)`, at the end of a title, `EL CENTRO NS VELOCITY CM/SEC`, or as a series,
/// `VELOCITY TIME HISTORY`. Titles of accelerations may speak of velocities, too: `shear wave
/// velocity 200 m/s`.
fn of_values(cells: &Cells) -> Option<Fault> {
    if let [name] = cells.names.as_slice() {
        let (known, unit) = divided(name).unwrap_or_else(|| (plain(name), String::new()));
        let moves = MOTION.contains(&known.as_str()) || is_component(&known);
        // A letter alone is no name of a quantity.
        let says = moves && !unit.is_empty() || MOTION.contains(&known.as_str()) && known.len() > 1;
        if let Some(quantity) = quantity(name).filter(|_| says) {
            return Some(Fault::NoAcceleration(quantity, name.trim().to_owned()));
        }
    }
    let lower = cells.text.to_ascii_lowercase();
    let series = ["time history", "time series"];
    let of_series = || {
        let found = Quantity::in_words(&lower)?;
        series
            .iter()
            .any(|words| lower.contains(words))
            .then_some(found)
    };
    let by_unit = || {
        let NamedWithUnit {
            quantity,
            unit,
            rest,
        } = named_with_unit(&lower)?;
        let rest = rest.trim_matches([' ', '\t', '.', ',', ';']);
        let key = rest.trim_start_matches(|c: char| c.is_ascii_alphabetic());
        let ends = rest.is_empty() || key.len() < rest.len() && key.trim_start().starts_with('=');
        let both = [quantity, unit.quantity];
        let other = both.into_iter().find(|q| *q != Quantity::Acceleration);
        other.filter(|_| ends)
    };
    // An acceleration may stand beside it under a name of its own.
    let beside = |name: &String| matches!(role(name), Some(Role::Acceleration(..)));
    let columns = cells.names.len() > 1 && cells.names.iter().any(beside);
    let found = of_series()
        .or_else(|| by_unit().filter(|_| !columns))
        .or_else(|| {
            // Names of columns are looked at one by one.
            let times = |name: &String| matches!(role(name), Some(Role::Time(_)));
            let title = cells.separator.is_none() || cells.names.len() < 3;
            ends_a_title(&lower).filter(|_| title && !cells.names.iter().any(times))
        });
    let other = found.filter(|quantity| *quantity != Quantity::Acceleration)?;
    Some(Fault::NoAcceleration(other, cells.text.clone()))
}

/// The quantity that a title in lower case ends in: `corrected velocity`, `type: velocity`.
fn ends_a_title(lower: &str) -> Option<Quantity> {
    let named = Quantity::in_words(lower)?;
    let words = || {
        lower
            .split(|c: char| !c.is_alphanumeric())
            .filter(|w| !w.is_empty())
    };
    let last = words().next_back()?;
    let ends = ["velocity", "velocities", "displacement", "displacements"].contains(&last);
    let of_else = words().any(|w| of_something_else(w) || NO_TITLE.contains(&w));
    (ends && !of_else).then_some(named)
}

/// Words of titles that speak of a velocity or a displacement of something else, or of none.
const NO_TITLE: [&str; 14] = [
    "no", "not", "without", "with", "of", "and", "or", "high", "low", "soil", "rock", "layer",
    "pulse", "site",
];

/// Name, in lower case, and unit of a cell that has both.
fn divided(cell: &str) -> Option<(String, String)> {
    let cell = cell.trim().trim_matches(['"', '\'']).trim();
    if let Some((name, rest)) = cell.split_once(['(', '[']) {
        let unit = rest.strip_suffix([')', ']'])?;
        return Some((plain(name.trim_end_matches('/')), unit.trim().to_owned()));
    }
    let (name, unit) = cell
        .split_once(" in ")
        .or_else(|| cell.split_once(['_', ' ', '/']))?;
    let unit = unit.trim();
    let known = plain(name);
    let takes = |names: &[&str]| names.contains(&known.as_str());
    let may = takes(&LONG) || takes(&MOTION) || is_component(&known);
    (may && !unit.is_empty()).then(|| (known, unit.to_owned()))
}

/// What a column of velocities or displacements holds, by its unit or else by its name.
fn quantity(cell: &str) -> Option<Quantity> {
    if role(cell) != Some(Role::Other) {
        return None;
    }
    let (known, unit) = divided(cell).unwrap_or_else(|| (plain(cell), String::new()));
    let by_unit = motion_unit(&unit).map(|unit| unit.quantity);
    let by_name = || {
        let name = known.trim_start_matches("ground ");
        match name.chars().next() {
            _ if !MOTION.contains(&known.as_str()) => None,
            Some('v') => Some(Quantity::Velocity),
            _ => Some(Quantity::Displacement),
        }
    };
    by_unit.or_else(by_name)
}

/// Whether a name is one of a component and of nothing else, so that what follows an
/// underscore is its unit: `ns_g`, `up_m_s2`, `hne_gal`, `acc_x_g`. Single letters are not:
/// `x_g` and `z_g` may be symbols of the ground's displacement.
fn is_component(known: &str) -> bool {
    const DIRECTIONS: [&str; 22] = [
        "ns",
        "ew",
        "ud",
        "sn",
        "we",
        "n-s",
        "e-w",
        "u-d",
        "north",
        "east",
        "south",
        "west",
        "up",
        "vert",
        "vertical",
        "north south",
        "east west",
        "h1",
        "h2",
        "longitudinal",
        "transverse",
        "radial",
    ];
    let code = |name: &str| {
        // Band, instrument and orientation of SEED.
        let [band, instrument, orientation] = name.as_bytes() else {
            return false;
        };
        b"hbesc".contains(band) && b"nlg".contains(instrument) && b"enz123".contains(orientation)
    };
    let azimuth = |name: &str| {
        let digits = name.strip_suffix(" deg").unwrap_or(name);
        (2..=3).contains(&digits.len()) && digits.parse().is_ok_and(|a: u16| a <= 360)
    };
    let own = |name: &str| DIRECTIONS.contains(&name) || code(name) || azimuth(name);
    let single = |name: &str| ["x", "y", "z", "n", "e", "s", "w", "1", "2", "3"].contains(&name);
    let of_motion = known
        .split_once(' ')
        .filter(|(motion, _)| ["a", "acc", "accel", "acceleration"].contains(motion))
        .is_some_and(|(_, rest)| own(rest) || single(rest));
    own(known) || of_motion
}

/// Names between blanks; a unit in brackets belongs to the name before it.
fn words(text: &str) -> Vec<String> {
    let mut words: Vec<String> = Vec::new();
    let mut depth = 0_usize;
    for word in text.split_whitespace() {
        match words.last_mut() {
            Some(last) if depth > 0 || word.starts_with(['(', '[']) => {
                last.push(' ');
                last.push_str(word);
            }
            _ => words.push(word.to_owned()),
        }
        let opened = word.matches(['(', '[']).count();
        depth = (depth + opened).saturating_sub(word.matches([')', ']']).count());
    }
    words
}

fn role(cell: &str) -> Option<Role> {
    let cell = unquoted(cell);
    if is_spectral(cell) {
        return None;
    }
    let named = |name: &str, unit: &str| of_unit(&plain(name), name.trim(), unit);
    if let Some((name, rest)) = cell.split_once(['(', '[']) {
        let unit = rest.strip_suffix([')', ']'])?;
        // `a/(m/s2)`, as standards on quantities write.
        return named(name.trim_end_matches('/'), unit);
    }
    let whole = plain(cell);
    if is_time(&whole) {
        return Some(Role::Time(1.0));
    }
    if ACCELERATION.contains(&whole.as_str()) {
        return Some(Role::Acceleration(cell.to_owned(), None));
    }
    if MOTION.contains(&whole.as_str()) || COUNTER.contains(&whole.as_str()) {
        return Some(Role::Other);
    }
    if let Some((name, unit)) = cell.split_once(" in ") {
        return named(name, unit);
    }
    cell.match_indices(['_', ' ', '/'])
        .find_map(|(at, divider)| {
            let (name, unit) = (&cell[..at], &cell[at + 1..]);
            let known = plain(name);
            let takes = |names: &[&str]| names.contains(&known.as_str());
            let may = takes(&LONG)
                || takes(&MOTION)
                || is_component(&known)
                || divider == "/" && takes(&ACCELERATION);
            if may { named(name, unit) } else { None }
        })
}

/// Lower case, blanks for underscores, without a stop at the end.
fn plain(name: &str) -> String {
    let lower = name.trim().trim_end_matches(['.', ':', '_']).to_lowercase();
    let words: Vec<&str> = lower.split(['_', ' ']).filter(|w| !w.is_empty()).collect();
    words.join(" ")
}

/// A name with its unit: both must mean the same quantity.
fn of_unit(known: &str, name: &str, unit: &str) -> Option<Role> {
    if is_time(known) {
        return time_unit(unit).map(Role::Time);
    }
    let unit = motion_unit(unit)?;
    let accelerates = unit.quantity == Quantity::Acceleration;
    if ACCELERATION.contains(&known) {
        return accelerates.then(|| Role::Acceleration(name.to_owned(), Some(unit)));
    }
    if MOTION.contains(&known) {
        // `d (g)` is no displacement, `v (g)` may be the vertical component.
        return match accelerates {
            true if known == "v" => Some(Role::Acceleration(name.to_owned(), Some(unit))),
            true => None,
            false => Some(Role::Other),
        };
    }
    // A component or channel by its own name.
    Some(match accelerates {
        true => Role::Acceleration(name.to_owned(), Some(unit)),
        false => Role::Other,
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    fn of(text: &str) -> Option<Vec<Role>> {
        let line = Line {
            number: 1,
            bytes: text.as_bytes(),
        };
        parse(&line).map(|h| h.columns)
    }

    #[test]
    fn names_with_units_in_every_spelling() {
        for (text, unit) in [
            ("time_s,acceleration_g", SeriesUnit::G),
            ("time_s;acceleration_m_s2", SeriesUnit::M_S2),
            ("time (s),acceleration (m/s2)", SeriesUnit::M_S2),
            ("t [s];a [g]", SeriesUnit::G),
            ("t [s]\ta [cm/s^2]", SeriesUnit::CM_S2),
            ("Time (sec)  Accel (g)", SeriesUnit::G),
            ("# t [s], a [m/s²]", SeriesUnit::M_S2),
            ("\"Time (s)\",\"Acceleration (mm/s²)\"", SeriesUnit::MM_S2),
            ("t/s;a/(m/s2)", SeriesUnit::M_S2),
            ("t/s;a/g", SeriesUnit::G),
            ("time_s acc_gal", SeriesUnit::CM_S2),
            ("Time in s,Acceleration in g", SeriesUnit::G),
            ("time (s);a (m s-2);", SeriesUnit::M_S2),
            ("t (s), NS (gal)", SeriesUnit::CM_S2),
        ] {
            let found = of(text).unwrap_or_else(|| panic!("{text}"));
            assert_eq!(found[0], Role::Time(1.0), "{text}");
            let Role::Acceleration(_, found) = &found[1] else {
                panic!("{text}: {found:?}");
            };
            assert_eq!(*found, Some(unit), "{text}");
        }
        assert_eq!(of("time_ms,acceleration_g").unwrap()[0], Role::Time(1.0e-3));
        let several = of("n,t (s),NS (g),EW (g),velocity (m/s)").unwrap();
        assert_eq!(several[0], Role::Other);
        assert_eq!(
            several[3],
            Role::Acceleration("EW".to_owned(), Some(SeriesUnit::G))
        );
        assert_eq!(several[4], Role::Other);
        // Named, but without a unit: never guessed.
        assert_eq!(
            of("t,a_g").unwrap()[1],
            Role::Acceleration("a_g".to_owned(), None)
        );
        assert_eq!(of("time,acceleration").unwrap()[0], Role::Time(1.0));
    }

    #[test]
    fn components_with_units() {
        for (text, name) in [
            ("time_s,ns_g,ew_g", "ns"),
            ("time_s;UP_m_s2", "UP"),
            ("t [s],HNE_gal", "HNE"),
            ("time_s,090_g", "090"),
            ("time_s,acc_x_g", "acc_x"),
            ("time_s,acceleration_ns_m_s2", "acceleration_ns"),
        ] {
            let found = of(text).unwrap_or_else(|| panic!("{text}"));
            assert!(
                matches!(&found[1], Role::Acceleration(found, Some(_)) if found == name),
                "{text}: {found:?}"
            );
        }
        // Displacements of the ground, or none known at all.
        for text in ["time_s,x_g", "time_s,u_g", "time_s,station_g"] {
            assert_eq!(of(text), None, "{text}");
        }
    }

    #[test]
    fn what_is_wrong_with_a_header() {
        let fault_of = |text: &str| {
            let bytes = text.as_bytes();
            fault(&Line { number: 1, bytes }).map(|f| f.1)
        };
        let unit = |name: &str, unit: &str| (name.to_owned(), unit.to_owned());
        let (name, min) = unit("time (min)", "min");
        let time = Some(Fault::TimeUnit(name, min));
        assert_eq!(fault_of("time (min),acceleration (m/s2)"), time);
        let (name, furlongs) = unit("acceleration_furlongs", "furlongs");
        let motion = Some(Fault::MotionUnit(name, furlongs));
        assert_eq!(fault_of("time_s,acceleration_furlongs"), motion);
        let column = Some(Fault::Column(1, "dt=0.01 s".to_owned()));
        assert_eq!(fault_of("dt=0.01 s;a [m/s2]"), column);
        for (text, quantity, name) in [
            (
                "time_s;displacement_m",
                Quantity::Displacement,
                "displacement_m",
            ),
            ("# t [s], u [mm]", Quantity::Displacement, "u [mm]"),
            ("time,velocity", Quantity::Velocity, "velocity"),
            ("t (s)  v (cm/s)", Quantity::Velocity, "v (cm/s)"),
        ] {
            let expected = Fault::NoAcceleration(quantity, name.to_owned());
            assert_eq!(fault_of(text), Some(expected), "{text}");
        }
        assert_eq!(fault_of("t (s),t (s),a (g)"), Some(Fault::TwoTimes));
        for text in [
            "El Centro 1940, north-south",
            "the velocity and the displacement at a time t",
            "Unit: g",
            "time_s,acceleration_g",
            "t,a",
            "0.0,0.1",
        ] {
            assert_eq!(fault_of(text), None, "{text}");
        }
    }

    #[test]
    fn what_is_no_header() {
        for text in [
            "El Centro 1940, north-south",
            "Acceleration of Kobe, 1995",
            "0.0,0.1",
            "time (s),displacement (m)",
            "time (years),acceleration (g)",
            "t (s),t (s),a (g)",
            "time_s,acceleration_furlongs",
            "acceleration (m)",
            "Unit: g",
            "",
        ] {
            assert_eq!(of(text), None, "{text}");
        }
    }
}
