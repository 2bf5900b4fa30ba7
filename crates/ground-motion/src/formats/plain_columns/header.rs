//! Names and units of columns in the line before the rows: `time (s),acceleration (m/s2)`,
//! `t [s];a [g]`, `time_s acceleration_g`.

use super::OTHERS;
use super::column_name::{Kind, Role, divided_at_brackets, is_quantity, kind, quantity, role};
use super::names::{
    ACCELERATION, COUNTER, PROSE, TIME, are_of_spectrum, bare_unit, before_unit, is_channel,
    motion_unit, plain, time_unit, unquoted,
};
use super::stated_unit::has_unit;
use crate::error::GroundMotionError;
use crate::fortran::Layout;
use crate::header_keys::{Entry, keyed, states_number};
use crate::source::Source;
use crate::text::Line;

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

/// A line cut into the names of columns.
pub(super) struct Cells {
    /// Line, from 1.
    pub line: usize,
    pub text: String,
    pub names: Vec<String>,
    pub separator: Option<char>,
}

pub(super) fn cells(line: &Line<'_>) -> Option<Cells> {
    if line.bytes.len() > LONGEST {
        return None;
    }
    let text = line.text();
    // What programs write before a header that others should pass over.
    let bare = text.trim_start_matches(COMMENT);
    let plain = without_formats(bare);
    let bare = if plain.is_empty() {
        bare
    } else {
        plain.as_str()
    };
    let mut separators = ['|', ';', '\t', ','].into_iter();
    let separator = separators.find(|s| bare.contains(*s));
    let (separator, cells) = match quoted_cells(bare) {
        Some((separator, cells)) => (Some(separator), cells),
        None => {
            let cells = match separator {
                Some(separator) => bare.split(separator).map(str::to_owned).collect(),
                None => words(bare),
            };
            (separator, cells)
        }
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

/// The cells of a line and what separates them, where quotes hold separators together: `Time (s),"Acc, NS (g)"`. One
/// in quotes as a whole, or with a quote that nothing closes, has none.
fn quoted_cells(line: &str) -> Option<(char, Vec<String>)> {
    const QUOTE: char = '"';
    let quotes = line.matches(QUOTE).count();
    if quotes == 0 || !quotes.is_multiple_of(2) {
        return None;
    }
    // Every second piece stands in quotes.
    let outside = || line.split(QUOTE).step_by(2);
    let separator = ['|', ';', '\t', ','];
    let separator = separator
        .into_iter()
        .find(|s| outside().any(|piece| piece.contains(*s)))?;
    let mut cells = vec![String::new()];
    let mut in_quotes = false;
    for c in line.chars() {
        in_quotes ^= c == QUOTE;
        match cells.last_mut() {
            Some(cell) if in_quotes || c != separator => cell.push(c),
            _ => cells.push(String::new()),
        }
    }
    Some((separator, cells))
}

/// A line without Fortran formats in brackets, `(8F9.6)`, `[8(F9.6)]`, `(format: 5E14.7)`, which are no units.
pub(super) fn without_formats(text: &str) -> String {
    let mut kept = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(at) = rest.find(['(', '[']) {
        let mut depth = 0_usize;
        let end = rest[at..].char_indices().find(|(_, c)| {
            match c {
                '(' | '[' => depth += 1,
                ')' | ']' => depth = depth.saturating_sub(1),
                _ => {}
            }
            depth == 0
        });
        let Some((length, _)) = end else {
            break;
        };
        let (before, inside) = (&rest[..at], &rest[at + 1..at + length]);
        match is_format(inside) {
            true => kept.push_str(before.trim_end()),
            false => kept.push_str(&rest[..=at + length]),
        }
        rest = &rest[at + length + 1..];
    }
    kept + rest
}

/// Whether what stands in brackets is a Fortran format of numbers.
fn is_format(inside: &str) -> bool {
    let lower = inside.trim().to_ascii_lowercase();
    let named = ["fortran format", "format", "fmt"];
    let named = named.iter().find_map(|name| lower.strip_prefix(name));
    let format = named.map_or(lower.as_str(), |rest| {
        rest.trim_start_matches([':', '=', ' ', '\t'])
    });
    // `(D5-95)` is none, and `(E100)` may be a direction.
    let of_format = |c: char| c.is_ascii_digit() || " .,/()efgdipxsn".contains(c);
    let is_sure = format.contains('.') || format.starts_with(|c: char| c.is_ascii_digit());
    is_sure && format.chars().all(of_format) && Layout::parse(format).is_some()
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

impl Cells {
    fn parse(&self) -> Option<Header> {
        // `Acceleration Time Series (g)` names no three columns.
        let prose = |name: &String| PROSE.contains(&plain(before_unit(name)).as_str());
        let is_prose = self.separator.is_none() && self.names.iter().any(prose);
        if is_prose || are_of_spectrum(&self.names, self.separator) {
            return None;
        }
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
        if !self.fits(row)
            && let Some(names) = self.several_words().find(|names| names.fits(row))
        {
            return names.header_of(row);
        }
        self.parse().or_else(|| self.beside_times(row)).or_else(|| {
            self.with_units_apart()
                .filter(|both| both.fits(row))?
                .header_of(row)
        })
    }

    /// The same names where they may have several words: each ends in brackets, `Time (s) Roof acc (g)`, but for the
    /// first, `Time Roof acc (g)`; or they stand more than a blank apart, `Time   Roof acc   Base acc`.
    pub(super) fn several_words(&self) -> impl Iterator<Item = Self> {
        let ends = |word: &str| word.ends_with([')', ']']);
        let is_key = self.text.contains([':', '=']);
        let last = self.names.last().is_some_and(|last| ends(last));
        let between = |names: &[String]| -> Vec<String> {
            let names = names.split_inclusive(|name| ends(name));
            names.map(|words| words.join(" ")).collect()
        };
        let mut found = Vec::new();
        if self.separator.is_none() && last {
            found.push(between(&self.names));
            if let Some((first, rest)) = self.names.split_first()
                && (TIME.contains(&plain(first).as_str())
                    || COUNTER.contains(&plain(first).as_str()))
            {
                found.push([vec![first.clone()], between(rest)].concat());
            }
        }
        if self.separator.is_none_or(|separator| separator == ',') {
            found.push(self.between_gaps());
        }
        let names = found
            .into_iter()
            .filter(move |names| !is_key && names.len() > 1);
        names.map(|names| Self {
            line: self.line,
            text: self.text.clone(),
            names,
            separator: None,
        })
    }

    /// What stands more than a blank apart on the line, with units behind commas in brackets: `Roof acc, g`.
    fn between_gaps(&self) -> Vec<String> {
        let text = without_formats(self.text.trim_start_matches(COMMENT));
        let names = text
            .split("  ")
            .map(str::trim)
            .filter(|name| !name.is_empty());
        let with_unit = |name: &str| match name.rsplit_once(',') {
            Some((name, unit)) => format!("{} ({})", name.trim(), unit.trim()),
            None => name.to_owned(),
        };
        names.map(with_unit).collect()
    }

    /// The same names where units stand in cells of their own behind them: `Time, s,Acceleration, g`.
    pub(super) fn with_units_apart(&self) -> Option<Self> {
        let mut names: Vec<String> = Vec::new();
        for cell in &self.names {
            let unit = bare_unit(cell);
            let is_unit = time_unit(&unit).is_some() || motion_unit(&unit).is_some();
            let before = names.last_mut().filter(|name| {
                let known = plain(name);
                is_unit && known.len() > 1 && is_quantity(&known)
            });
            match before {
                Some(name) => *name = format!("{} ({unit})", unquoted(name)),
                None => names.push(cell.clone()),
            }
        }
        let fewer = names.len() < self.names.len();
        fewer.then(|| Self {
            line: self.line,
            text: self.text.clone(),
            names,
            separator: self.separator,
        })
    }

    /// Whether the rows have as many cells as there are names.
    pub(super) fn fits(&self, row: &Line<'_>) -> bool {
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
        // `Column 1: Time (s)` speaks of one column.
        let numbered = |name: &String| {
            let digits = name.strip_suffix(':').unwrap_or_default();
            !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_digit())
        };
        if self.names.len() < 2
            || self.is_key()
            || self.separator.is_none() && self.names.iter().any(numbered)
            || are_of_spectrum(&self.names, self.separator)
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
        let timed = |k: &Kind| matches!(k, Kind::Known(Role::Time(_)));
        if !kinds.iter().any(timed) && !self.is_without_times(&kinds) {
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

    /// Whether columns of something else than times and motion stand beside an acceleration with
    /// its unit: `Temp (C);acc (g)`. What is in seconds may be times by another name.
    fn is_without_times(&self, kinds: &[Kind]) -> bool {
        let accelerates = |k: &Kind| matches!(k, Kind::Known(Role::Acceleration(_, Some(_))));
        let told = |(name, kind): (&String, &Kind)| {
            let in_seconds = divided_at_brackets(name).is_some_and(|u| time_unit(&u).is_some());
            !in_seconds && !matches!(kind, Kind::Unknown)
        };
        kinds.iter().any(accelerates) && self.names.iter().zip(kinds).all(told)
    }

    /// The same names with units that stand in the line below them.
    fn with_units(&self, below: &Self) -> Option<Self> {
        let has_keys = |cells: &&Self| states_number(&cells.text) || has_unit(&cells.text);
        if [self, below].iter().any(has_keys) {
            return None;
        }
        // Brackets between blanks belong to no name before them here.
        let text = below.text.trim_start_matches(COMMENT);
        let fields = || text.split_whitespace().map(bare_unit).collect();
        let units: Vec<String> = match below.separator {
            Some(_) => below.names.iter().map(|unit| bare_unit(unit)).collect(),
            None => fields(),
        };
        // `Time   Roof acc   Base acc` above `(s)   (g)   (g)`.
        if self.separator.is_none() && units.len() < self.names.len() {
            let names = self.between_gaps();
            if names.len() != units.len() {
                return None;
            }
            let apart = Self {
                line: self.line,
                text: self.text.clone(),
                names,
                separator: None,
            };
            return apart.with_units(below);
        }
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

    /// Whether the line states something under a key, and names no acceleration beside it.
    pub(super) fn is_key(&self) -> bool {
        let accelerates = |name: &String| matches!(role(name), Some(Role::Acceleration(..)));
        // `Altitude (m) : 130`, whatever it is of.
        let is_parted = self.separator.is_none() && self.text.contains([':', '=']);
        let has_value = || {
            keyed(&self.text.to_lowercase())
                .iter()
                .any(Entry::has_number)
        };
        // `Altitude (m),130`: a key and its number in two cells. `000,090` names two columns.
        let is_pair = || match self.names.as_slice() {
            [key, value] => {
                let is_number = crate::number::parse(value.trim().as_bytes()).is_ok();
                let has_unit = key.contains(['(', '[']) && !is_channel(&plain(before_unit(key)));
                has_unit
                    && is_number
                    && !matches!(role(key), Some(Role::Time(_) | Role::Acceleration(..)))
            }
            _ => false,
        };
        let has_number = states_number(&self.text) || is_parted && has_value() || is_pair();
        has_unit(&self.text) || has_number && !self.names.iter().any(accelerates)
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
        if self.names.len() < 2 || !as_many || self.is_key() {
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

/// Refuses a layout that takes for an acceleration what the header says to be none, or that exchanges the
/// names of its components.
pub(super) fn layout_agrees(
    source: &Source<'_>,
    header: &Header,
    names: &[String],
) -> Result<(), GroundMotionError> {
    let Some(cells) = source
        .lines()
        .find(|l| l.number == header.line)
        .and_then(|l| cells(&l))
    else {
        return Ok(());
    };
    if cells.names.len() != names.len() {
        return Ok(());
    }
    let name_of = |role: &Role| match role {
        Role::Acceleration(name, _) => Some(name.to_ascii_lowercase()),
        _ => None,
    };
    let called: Vec<Option<String>> = header.columns.iter().map(name_of).collect();
    for (k, (name, cell)) in names.iter().zip(&cells.names).enumerate() {
        let lower = name.to_ascii_lowercase();
        if lower == "t" || OTHERS.contains(&&*lower) {
            continue;
        }
        let no_acceleration = match quantity(cell) {
            Some(quantity) => Some(format!("a {quantity}")),
            None => matches!(kind(cell), Some(Kind::Foreign)).then(|| "no acceleration".to_owned()),
        };
        let passed = "pass it over in `layout` by \"-\"; if the header is wrong, correct it";
        if let Some(what) = no_acceleration {
            let message = format!(
                "the layout takes column {} for an acceleration, and the header says that \"{}\" is {what}",
                k + 1,
                cell.trim()
            );
            return Err(source.error(header.line, 0, message, passed));
        }
        let mut others = called.iter().enumerate().filter(|(other, _)| *other != k);
        let own = called.get(k).and_then(|own| own.as_deref());
        if own.is_some_and(|own| own != lower)
            && let Some((other, _)) = others.find(|(_, other)| other.as_deref() == Some(&*lower))
        {
            let message = format!(
                "the layout calls column {} \"{name}\", which in the header is the name of column {}",
                k + 1,
                other + 1
            );
            let remedy = "give the names in the order of the columns, or leave `layout` out";
            return Err(source.error(header.line, 0, message, remedy));
        }
    }
    Ok(())
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

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::quantity::SeriesUnit;

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
            // Quotes hold commas together, but for a line that is one quotation.
            ("Time (s),\"Acc, NS (gal)\"", SeriesUnit::CM_S2),
            ("\"Time (s)\";\"Acc, m/s2\"", SeriesUnit::M_S2),
            ("\"Time (s), Acc (g)\"", SeriesUnit::G),
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
