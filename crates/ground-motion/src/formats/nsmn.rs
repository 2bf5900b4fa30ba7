//! National Strong-Motion Network of Turkey, the layout of 2017: lines `KEY : value`, a line
//! that names the columns, then a column for each component.

use crate::cut_numbers::Forms;
use crate::draft::{Draft, DraftPeak, DraftUnit};
use crate::error::GroundMotionError;
use crate::format::Format;
use crate::formats::rows::not_of_format;
use crate::number::{self, Bare, Printed};
use crate::origin::Processing;
use crate::quantity::SeriesUnit;
use crate::recording::Series;
use crate::source::Source;
use crate::text::{Line, Lines, in_brackets};
use crate::time_column::Times;

const REMEDY: &str =
    "the header is not that of the national network of Turkey: get the record again";
/// Lines that a header may have; 18 in the files seen.
const HEADER_LINES: usize = 100;
/// Components that a file may have.
const MOST_COLUMNS: usize = 12;

/// What the header says.
#[derive(Default)]
struct Header {
    place: String,
    station: String,
    start: String,
    count: Option<usize>,
    step: Option<f64>,
    unit: Option<SeriesUnit>,
    /// Peak of each component by its name, with the line.
    peaks: Vec<(String, Printed, usize)>,
    names: Vec<String>,
}

pub(super) static FORMAT: Format = Format {
    name: "nsmn",
    title: "National Strong-Motion Network of Turkey, 2017",
    source: "Disaster and Emergency Management Authority (AFAD), Turkey",
    recognised_by: "a first line that starts with STRONG GROUND MOTION RECORDS OF TURK",
};

pub(super) fn matches(source: &Source<'_>) -> bool {
    source
        .first_line()
        .trim_start()
        .starts_with("strong ground motion records of turk")
}

pub(super) fn read(source: &Source<'_>) -> Result<Vec<Series>, GroundMotionError> {
    let mut lines = source.lines();
    let header = Header::read(source, &mut lines)?;
    let end = lines.number();
    let count = header.names.len();
    let room = lines.remaining() / (2 * count) + 1;
    let room = room.min(header.count.unwrap_or(0));
    let mut columns: Vec<Vec<f64>> = (0..count).map(|_| Vec::with_capacity(room)).collect();
    let mut forms: Vec<Forms> = columns.iter().map(|_| Forms::default()).collect();
    for line in lines.by_ref().filter(|l| !l.is_blank()) {
        row(source, line, &mut columns, &mut forms)?;
    }
    match source.ends_whole()? {
        true => forms.iter().try_for_each(|forms| forms.are_whole(source))?,
        // The components are of one length.
        false => columns
            .iter_mut()
            .for_each(|column| column.truncate(column.len().saturating_sub(1))),
    }
    let mut series = Vec::new();
    for (k, samples) in columns.into_iter().enumerate() {
        let unit = header.unit.map_or(DraftUnit::Unstated, DraftUnit::Stated);
        let mut draft = Draft::new(samples, unit, (end, end + 1, lines.number()));
        header.fill(k, &mut draft);
        series.push(draft.finish(source)?);
    }
    Ok(series)
}

/// Takes a row of one number for each column, with decimal points or commas.
fn row(
    source: &Source<'_>,
    line: Line<'_>,
    columns: &mut [Vec<f64>],
    forms: &mut [Forms],
) -> Result<(), GroundMotionError> {
    let count = columns.len();
    let has = |sign: u8| line.bytes.contains(&sign);
    if has(b',') && has(b'.') {
        let mut both = divided(line).filter(|f| f.contains(&b',') && f.contains(&b'.'));
        // Where commas part nothing, a number that has both signs is none.
        if let Some(field) = both.next().filter(|_| divided(line).count() == count) {
            return Err(source.error(
                line.number,
                0,
                format!(
                    "\"{}\" has both a decimal point and a comma",
                    number::shown(field)
                ),
                "write numbers with a decimal point alone",
            ));
        }
    }
    let pointed = if has(b',') && !has(b'.') {
        Some(decimal_commas(source, line, count)?)
    } else {
        None
    };
    let pointed = pointed.as_deref().map_or(line, |bytes| Line {
        number: line.number,
        bytes,
    });
    let mut fields = pointed.fields();
    for (column, forms) in columns.iter_mut().zip(forms) {
        let (at, field) = fields.next().ok_or_else(|| {
            source.error(
                line.number,
                line.bytes.len(),
                format!("fewer than {count} numbers, one for each component"),
                "the file is damaged or truncated: get it again",
            )
        })?;
        column.push(source.number(line, at, field)?);
        forms.see(line.number, at, field);
    }
    match fields.next() {
        None => Ok(()),
        Some((at, _)) => Err(source.error(
            line.number,
            at,
            format!("more than {count} numbers, one for each component"),
            REMEDY,
        )),
    }
}

/// What stands between blanks, tabs and semicolons.
fn divided<'a>(line: Line<'a>) -> impl Iterator<Item = &'a [u8]> {
    let divider = |b: &u8| matches!(b, b' ' | b'\t' | b';');
    line.bytes.split(divider).filter(|f| !f.is_empty())
}

/// A row without decimal points, whose commas are taken for them where blanks, tabs or semicolons
/// part as many numbers as there are components.
fn decimal_commas(
    source: &Source<'_>,
    line: Line<'_>,
    count: usize,
) -> Result<Vec<u8>, GroundMotionError> {
    let commas = |field: &[u8]| field.iter().filter(|b| **b == b',').count();
    if divided(line).count() != count || divided(line).any(|field| commas(field) > 1) {
        // Whole numbers between commas.
        if line.fields().count() == count {
            return Ok(line.bytes.to_vec());
        }
        return Err(source.error(
            line.number,
            line.bytes.iter().position(|b| *b == b',').unwrap_or(0),
            format!("commas, no decimal point, and not {count} numbers: decimal commas, or commas between the numbers?"),
            "write decimal points, or separate the columns by blanks or semicolons",
        ));
    }
    source.warn("the numbers have decimal commas");
    let point = |b: &u8| if *b == b',' { b'.' } else { *b };
    Ok(line.bytes.iter().map(point).collect())
}

/// A header's value, whose comma is a decimal one: it lists nothing.
fn with_point(value: &str) -> String {
    value.replace(',', ".")
}

/// Whether a key is one of which some stand in every header of the format.
fn is_known(key: &str) -> bool {
    let upper = key.trim().to_ascii_uppercase();
    ["PLACE", "STATION ID", "RECORD TIME", "NUMBER OF DATA"].contains(&upper.as_str())
        || upper.starts_with("SAMPLING INTERVAL")
        || upper.contains("PGA")
}

impl Header {
    /// Reads up to the line that names the columns.
    fn read<'a>(source: &Source<'a>, lines: &mut Lines<'a>) -> Result<Self, GroundMotionError> {
        let mut header = Self::default();
        let mut is_keyed = false;
        let foreign = |line: usize| {
            let keys = "\"STATION ID : \", \"NUMBER OF DATA : \" or \"SAMPLING INTERVAL (sec) : \"";
            not_of_format(source, line, &FORMAT, (keys, "components"))
        };
        while header.names.is_empty() {
            if lines.number() >= HEADER_LINES {
                return Err(source.error(
                    lines.number(),
                    0,
                    format!("no line such as N-S E-W U-D in the first {HEADER_LINES}"),
                    REMEDY,
                ));
            }
            let line = source.expect(lines, "the names of the components")?;
            match line.text().split_once(':') {
                Some((key, value)) => {
                    is_keyed |= is_known(key);
                    header.take(source, line, key, value.trim())?;
                }
                None if line.is_blank() || line.bytes.iter().any(u8::is_ascii_alphabetic) => {
                    header.names = names(line);
                    if !(is_keyed || header.names.is_empty()) {
                        return Err(foreign(line.number));
                    }
                }
                None if !is_keyed => return Err(foreign(line.number)),
                None => {
                    return Err(source.error(
                        line.number,
                        0,
                        "numbers before a line such as N-S E-W U-D",
                        REMEDY,
                    ));
                }
            }
        }
        Ok(header)
    }

    fn take(
        &mut self,
        source: &Source<'_>,
        line: Line<'_>,
        key: &str,
        value: &str,
    ) -> Result<(), GroundMotionError> {
        let at = line
            .bytes
            .iter()
            .position(|b| *b == b':')
            .map_or(0, |n| n + 1);
        let upper = key.trim().to_ascii_uppercase();
        match upper.as_str() {
            "PLACE" => value.clone_into(&mut self.place),
            "STATION ID" => value.clone_into(&mut self.station),
            "RECORD TIME" => value.clone_into(&mut self.start),
            "NUMBER OF DATA" => {
                self.count = Some(value.parse().map_err(|_| {
                    source.error(
                        line.number,
                        at,
                        format!(
                            "\"{}\" is not a number of samples",
                            number::shown(value.as_bytes())
                        ),
                        REMEDY,
                    )
                })?);
            }
            k if k.starts_with("SAMPLING INTERVAL") => {
                let printed = with_point(value);
                source.number(line, at, printed.as_bytes())?;
                let unit = in_brackets(k).unwrap_or_default();
                self.step = source.step_or_rate(line, &format!("{printed} {unit}"), Bare::Step)?;
            }
            k if k.contains("PGA") => {
                if let Some(unit) = in_brackets(key) {
                    self.unit = Some(SeriesUnit::parse(unit).ok_or_else(|| {
                        source.error(
                            line.number,
                            0,
                            format!(
                                "\"{}\" is not a unit of acceleration",
                                number::shown(unit.as_bytes())
                            ),
                            REMEDY,
                        )
                    })?);
                }
                // `(N-S) 13.2 (E-W) 12.1 (U-D) 9.8`
                for part in value.split('(').skip(1) {
                    if let Some((name, rest)) = part.split_once(')')
                        && let Some(peak) = source.header_number(
                            line.number,
                            &format!("the peak ({})", name.trim()),
                            &with_point(rest),
                        )
                    {
                        self.peaks.push((name.trim().to_owned(), peak, line.number));
                    }
                }
            }
            _ => {}
        }
        Ok(())
    }

    fn fill(&self, k: usize, draft: &mut Draft) {
        let name = &self.names[k];
        draft.component.clone_from(name);
        draft.channel = k + 1;
        draft.times = Times::Step(self.step);
        draft.header_count = self.count;
        draft.processing = Processing::Raw;
        draft.title = format!("{}; {}", self.place, self.station);
        draft.start_time.clone_from(&self.start);
        let peak = self
            .peaks
            .iter()
            .find(|(of, ..)| of.eq_ignore_ascii_case(name));
        draft.peak = peak.map(|(_, value, line)| DraftPeak {
            value: *value,
            time: None,
            unit: self.unit,
            shift: 0.0,
            line: Some(*line),
            of_sign: false,
        });
    }
}

/// Names of columns: words of letters that say a direction, such as `N-S`, `E-W` and `U-D`.
fn names(line: Line<'_>) -> Vec<String> {
    let direction = |word: &str| {
        // `.123E-02` is a number.
        if word.contains(|c: char| c.is_ascii_digit()) {
            return false;
        }
        let plain: String = word.chars().filter(|c| c.is_ascii_alphabetic()).collect();
        let plain = plain.to_ascii_uppercase();
        ["NS", "EW", "UD", "N", "E", "U", "Z", "V", "SN", "WE", "DU"].contains(&plain.as_str())
    };
    let text = line.text();
    let words: Vec<String> = text.split_whitespace().map(str::to_owned).collect();
    if words.len() <= MOST_COLUMNS && words.iter().all(|w| direction(w)) {
        words
    } else {
        Vec::new()
    }
}
