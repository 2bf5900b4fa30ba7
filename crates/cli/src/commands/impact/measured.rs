//! A measured force history: columns time and force, with units.

use std::ops::Range;
use std::path::Path;

use pounding_case::{Dimension, parse_quantity};
use pounding_catalogue::wording::{agreeing, counted};

use crate::failure::Failure;

/// Two columns: rows of what they say.
pub(in crate::commands) type Columns = Vec<String>;

/// The two units: sizes in SI.
#[derive(Clone, Copy, PartialEq)]
struct Units {
    time: f64,
    force: f64,
}

/// A file on its way to numbers.
struct Source<'a> {
    name: String,
    text: &'a str,
}

/// Reads time (s) and force (N). Lines that start with `#` are comments; a header
/// names the columns with their units, unless `units` gives them as `"ms,kN"`.
pub fn read(path: &Path, units: Option<&str>) -> Result<Vec<(f64, f64)>, Failure> {
    let name = path.display().to_string();
    let text = std::fs::read_to_string(path).map_err(|e| {
        Failure::input(
            format!("cannot read {name}: {e}"),
            Some("--against takes a text file with the columns time, force".to_owned()),
        )
    })?;
    let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
    Source { name, text }.samples(units)
}

impl Source<'_> {
    fn samples(&self, option: Option<&str>) -> Result<Vec<(f64, f64)>, Failure> {
        let option = option.map(from_option).transpose()?;
        let mut units = option;
        let mut samples: Vec<(f64, f64)> = Vec::new();
        let mut lines = self.lines().peekable();
        if let Some((place, fields)) = lines.peek()
            && !fields.iter().any(|f| looks_numeric(f))
        {
            units = Some(self.header(place.clone(), fields, option)?);
            lines.next();
        }
        let mut end = 0..0;
        for (place, fields) in lines {
            let units = units.ok_or_else(|| self.no_units(place.clone()))?;
            let (time, force) = self.row(place.clone(), &fields)?;
            let time = time * units.time;
            if samples.last().is_some_and(|(before, _)| !(time > *before)) {
                return Err(self.error(
                    place,
                    "time does not increase here".to_owned(),
                    "sort the rows by time, and leave out rows that repeat a time",
                ));
            }
            samples.push((time, force * units.force));
            end = place;
        }
        if samples.len() < 3 {
            return Err(self.error(
                end,
                format!(
                    "{} of numbers {} too few",
                    counted(samples.len(), "row"),
                    agreeing(&samples.len(), "is", "are")
                ),
                "a force history takes three rows at least, better fifty",
            ));
        }
        Ok(samples)
    }

    /// Lines with content: their places and fields.
    fn lines(&self) -> impl Iterator<Item = (Range<usize>, Columns)> {
        let mut start = 0;
        self.text.split_inclusive('\n').filter_map(move |line| {
            let content = line.trim_end();
            let place = start..start + content.len();
            start += line.len();
            let skipped = content.trim().is_empty() || content.trim_start().starts_with('#');
            (!skipped).then(|| (place, fields(content)))
        })
    }

    fn header(
        &self,
        place: Range<usize>,
        fields: &[String],
        option: Option<Units>,
    ) -> Result<Units, Failure> {
        let [time, force] = fields else {
            return Err(self.columns(place, fields.len()));
        };
        let found = [time, force].map(|f| unit_in(f));
        let units = match (found, option) {
            ([Some(time), Some(force)], option) => {
                let units = sizes(time, force)
                    .map_err(|(message, help)| self.error(place.clone(), message, &help))?;
                if option.is_some_and(|o| o != units) {
                    return Err(self.error(
                        place,
                        "--against-units contradicts the units of the header".to_owned(),
                        "leave --against-units out, or correct the header",
                    ));
                }
                units
            }
            (_, Some(option)) => option,
            _ => return Err(self.no_units(place)),
        };
        Ok(units)
    }

    fn row(&self, place: Range<usize>, fields: &[String]) -> Result<(f64, f64), Failure> {
        let [time, force] = fields else {
            return Err(self.columns(place, fields.len()));
        };
        let number = |text: &str| {
            match text.parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(value),
            _ => Err(self.error(
                place.clone(),
                format!("\"{text}\" is not a finite number"),
                "write numbers as 12.5 or 1.25e1 with a decimal point; leave out rows without a value",
            )),
        }
        };
        Ok((number(time)?, number(force)?))
    }

    fn columns(&self, place: Range<usize>, found: usize) -> Failure {
        self.error(
            place,
            format!(
                "there {} {} here, but two are wanted: time, force",
                agreeing(&found, "is", "are"),
                counted(found, "column")
            ),
            "keep the columns time and force; separate them by comma, semicolon, tab or blanks, and write numbers with a decimal point",
        )
    }

    fn no_units(&self, place: Range<usize>) -> Failure {
        self.error(
            place,
            "the units of time and force are not known".to_owned(),
            "write a header line such as `time_ms,force_kN` or `time (ms), force (kN)`, or add --against-units \"ms,kN\"",
        )
    }

    fn error(&self, place: Range<usize>, message: String, help: &str) -> Failure {
        Failure::in_file(&self.name, self.text, place, message, help)
    }
}

/// The fields of a line: separated by tab, semicolon, comma or else blanks.
pub(in crate::commands) fn fields(line: &str) -> Columns {
    let Some(separator) = ['\t', ';', ','].into_iter().find(|s| line.contains(*s)) else {
        return blank_separated(line);
    };
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .delimiter(separator as u8)
        .trim(csv::Trim::All)
        .from_reader(line.as_bytes());
    let record = reader.records().next().and_then(Result::ok);
    record.map_or_else(Vec::new, |r| r.iter().map(str::to_owned).collect())
}

/// A unit in brackets belongs to the word before it.
fn blank_separated(line: &str) -> Columns {
    let mut fields: Columns = Vec::new();
    for word in line.split_whitespace() {
        match fields.last_mut() {
            Some(last) if word.starts_with(['(', '[']) => last.push_str(word),
            _ => fields.push(word.to_owned()),
        }
    }
    fields
}

/// Damaged values are still numbers to this question: their row is no header.
pub(in crate::commands) fn looks_numeric(field: &str) -> bool {
    field.parse::<f64>().is_ok() || field.starts_with(|c: char| c.is_ascii_digit())
}

/// `ms` in `time (ms)`, `time [ms]` and `time_ms`.
pub(in crate::commands) fn unit_in(field: &str) -> Option<&str> {
    if let Some((_, rest)) = field.split_once(['(', '[']) {
        return rest.split([')', ']']).next().map(str::trim);
    }
    field.rsplit_once('_').map(|(_, unit)| unit.trim())
}

fn from_option(text: &str) -> Result<Units, Failure> {
    let example = || Some("write them as --against-units \"ms,kN\"".to_owned());
    let Some((time, force)) = text.split_once(',') else {
        return Err(Failure::input(
            format!("--against-units is \"{text}\", but two units are wanted: time, force"),
            example(),
        ));
    };
    sizes(time.trim(), force.trim()).map_err(|(message, help)| {
        Failure::input(format!("--against-units: {message}"), Some(help))
    })
}

/// Sizes of the two units in SI, or message and remedy.
fn sizes(time: &str, force: &str) -> Result<Units, (String, String)> {
    let size = |unit: &str, wanted: Dimension, what: &str| {
        let quantity = parse_quantity(&format!("1 {unit}"));
        match quantity {
            Ok(q) if q.dimension == Some(wanted) => Ok(q.value),
            Ok(q) => Err((
                format!(
                    "the {what} column is in \"{unit}\", which is {}, not {wanted}",
                    q.dimension.unwrap_or(Dimension::NUMBER)
                ),
                "the columns are time, force: for example `time_ms,force_kN`".to_owned(),
            )),
            Err(e) => Err((
                format!("\"{unit}\" is no unit of the {what} column"),
                e.help(),
            )),
        }
    };
    Ok(Units {
        time: size(time, Dimension::TIME, "time")?,
        force: size(force, Dimension::FORCE, "force")?,
    })
}
