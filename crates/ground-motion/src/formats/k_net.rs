//! K-NET and KiK-net ASCII (National Research Institute for Earth Science and
//! Disaster Resilience, Japan): 17 lines `name value`, then counts, eight per line.

use crate::draft::{Draft, DraftPeak, DraftUnit, several};
use crate::error::GroundMotionError;
use crate::format::Format;
use crate::formats::rows::second_record;
use crate::fortran::Layout;
use crate::number;
use crate::origin::Processing;
use crate::quantity::SeriesUnit;
use crate::recording::Series;
use crate::row_widths::RowWidths;
use crate::source::{Keys, Source};
use crate::text::{Line, in_brackets};
use crate::time_column::Times;

/// Columns of the names; the values start after them.
const NAME: usize = 18;
/// Eight integers of eight columns and a blank.
const COUNTS: Layout = Layout::new(8, 9);
const REMEDY: &str = "the header is not that of K-NET: get the record again";

/// Maximum magnitude of a count: the recorders of K-NET and KiK-net give signed integers of
/// 24 bits, and the oldest scale factor, `2000(gal)/8388608`, puts their full range there.
const MOST_COUNTS: f64 = 8_388_608.0;
/// A number of samples that no record has.
const IMPOSSIBLE_SAMPLES: f64 = 2_147_483_648.0;

/// What the header says.
#[derive(Default)]
struct Header {
    frequency: Option<f64>,
    duration: Option<f64>,
    direction: String,
    scale: Option<f64>,
    peak: Option<(f64, f64)>,
    station: String,
    origin_time: String,
    record_time: String,
    keys: Keys,
}

pub(super) static FORMAT: Format = Format {
    name: "k_net",
    title: "K-NET and KiK-net ASCII",
    source: "National Research Institute for Earth Science and Disaster Resilience, Japan",
    recognised_by: "a first line that starts with Origin Time",
};

pub(super) fn matches(source: &Source<'_>) -> bool {
    source.lines().next().is_some_and(is_first)
}

fn is_first(line: Line<'_>) -> bool {
    // Headers of others have a colon behind the key.
    let first = line.lower();
    let behind = first.strip_prefix("origin time").map(str::trim_start);
    behind.is_some_and(|rest| !rest.starts_with([':', '=']))
}

pub(super) fn read(source: &Source<'_>) -> Result<Vec<Series>, GroundMotionError> {
    let mut lines = source.lines();
    let mut header = Header::default();
    loop {
        let line = source.expect(&mut lines, "the header line \"Memo.\"")?;
        header.take(source, line)?;
        if line.lower().starts_with("memo") {
            break;
        }
    }
    let end = lines.number();
    let (Some(frequency), Some(scale)) = (header.frequency, header.scale) else {
        return Err(source.error(
            end,
            0,
            "the header has no sampling frequency or no scale factor",
            REMEDY,
        ));
    };
    let said = header.duration.unwrap_or(0.0) * frequency;
    if !(said < IMPOSSIBLE_SAMPLES) {
        return Err(source.error(
            end,
            0,
            format!("the header says {said:e} samples, which no record has"),
            REMEDY,
        ));
    }
    let mut samples = Vec::with_capacity(lines.remaining() / 5 + 1);
    let (mut rows, mut others) = (0, 0);
    let mut last = None;
    let mut widths = RowWidths::default();
    for line in lines.by_ref() {
        if line.is_text() && is_first(line) {
            return Err(second_record(source, line));
        }
        last = Some(line);
        let before = samples.len();
        if in_columns(line) {
            fixed_row(source, line, &mut samples)?;
            rows += 1;
        } else {
            others += 1;
            for (column, field) in line.fields() {
                samples.push(count(source, line, column, field)?);
            }
        }
        if samples.len() > before {
            widths.see(line.number, samples.len() - before);
        }
    }
    // Counts end at the last column but one of theirs.
    if let Some(line) = last.filter(|line| !in_columns(*line) && !source.ends_in_a_line_end())
        && rows > 0
        && others == 1
        && line.bytes.len() <= COUNTS.width * COUNTS.per_line
        && line.bytes.trim_ascii_end().len() % COUNTS.width != COUNTS.width - 1
        && let Some((column, field)) = line.fields().last()
    {
        source.is_cut_off(line, column, field, "digits in the last columns")?;
        samples.pop();
    }
    widths.are_even(source)?;
    // The count follows from the duration, which the agency prints as whole seconds: what is
    // more than the rest of a second belongs to another rate or duration, and beyond a
    // duration with decimals so is more than one sample.
    if let Some(duration) = header.duration
        && !source.options.lenient
    {
        let found = samples.len() as f64 / frequency;
        let rest = if duration.fract() == 0.0 {
            1.0
        } else {
            1.5 / frequency
        };
        if found > 1.01 * duration && found > duration + rest {
            return Err(source.error(
                end,
                0,
                format!(
                    "the header says a duration of {duration} s, but {} samples at {frequency} Hz last {found} s",
                    samples.len()
                ),
                "duration or sampling frequency of the header is wrong: get the record again, or set `lenient = true`",
            ));
        }
    }
    let mut draft = Draft::new(
        samples,
        DraftUnit::counts_of(SeriesUnit::CM_S2, scale),
        (end, end + 1, lines.number()),
    );
    draft.component = direction(&header.direction);
    draft.times = Times::Step(Some(1.0 / frequency));
    draft.header_count = header
        .duration
        .map(|d| (d * frequency).round())
        .filter(|n| (1.0..1.0e9).contains(n))
        .map(|n| n as usize);
    draft.row = several(COUNTS.per_line);
    draft.peak = header.peak.map(|value| DraftPeak {
        value,
        time: None,
        unit: Some(SeriesUnit::CM_S2),
        shift: 0.0,
        line: None,
        of_sign: false,
    });
    draft.processing = Processing::Raw;
    draft.title = format!("{}; earthquake of {}", header.station, header.origin_time);
    if !header.record_time.is_empty() {
        draft.start_time = format!("{} JST less 15 s", header.record_time);
    }
    Ok(vec![draft.finish(source)?])
}

/// Whether a row has integers of eight columns with a blank after each, of which the last
/// one is trimmed. Where there are digits in its place, the fields between blanks alone say
/// what the numbers are: cut into columns, longer ones would pass for several.
fn in_columns(line: Line<'_>) -> bool {
    let blanks = line.bytes.iter().skip(COUNTS.width - 1);
    line.bytes.len() % COUNTS.width == COUNTS.width - 1
        && !line.bytes.contains(&b'\t')
        && blanks.step_by(COUNTS.width).all(|b| *b == b' ')
}

fn fixed_row(
    source: &Source<'_>,
    line: Line<'_>,
    samples: &mut Vec<f64>,
) -> Result<(), GroundMotionError> {
    for (i, field) in line.bytes.chunks(COUNTS.width).enumerate() {
        samples.push(count(source, line, i * COUNTS.width, field)?);
    }
    Ok(())
}

/// One count.
fn count(
    source: &Source<'_>,
    line: Line<'_>,
    column: usize,
    field: &[u8],
) -> Result<f64, GroundMotionError> {
    let digits = field.trim_ascii();
    let digits = digits.strip_prefix(b"-").unwrap_or(digits);
    let count = match source.number(line, column, field) {
        Ok(count) if count.abs() <= MOST_COUNTS => return Ok(count),
        Ok(count) if count.abs() < 1.0e15 => count.to_string(),
        Ok(count) => format!("{count:e}"),
        // So many digits that they would stand for a missing value in other formats.
        Err(_) if digits.len() > COUNTS.width && digits.iter().all(u8::is_ascii_digit) => {
            number::shown(field)
        }
        Err(error) => return Err(error),
    };
    Err(source.error(
        line.number,
        column,
        format!("a count of {count} is more than the 24 bits of the recorder hold, 8388608"),
        "the file is damaged: get the record again",
    ))
}

impl Header {
    fn take(&mut self, source: &Source<'_>, line: Line<'_>) -> Result<(), GroundMotionError> {
        let name = line.columns(0, NAME).to_ascii_lowercase();
        let value = line.columns(NAME, line.bytes.len());
        let first = number::first_in(&value);
        if !self.keys.is_new(source, line, &name, &value)? {
            return Ok(());
        }
        match name.as_str() {
            n if n.starts_with("sampling freq") => {
                in_hertz(source, line, &value)?;
                self.frequency = first.map(|n| n.0).filter(|f| *f > 0.0);
            }
            n if n.starts_with("duration") => {
                self.duration = first.map(|n| n.0).filter(|d| *d > 0.0);
            }
            n if n.starts_with("dir") => self.direction = value,
            n if n.starts_with("max") => {
                in_gal(source, line)?;
                self.peak = first;
            }
            n if n.starts_with("station code") => self.station = value,
            n if n.starts_with("origin time") => self.origin_time = value,
            n if n.starts_with("record time") => self.record_time = value,
            n if n.starts_with("scale") => self.scale = Some(scale(source, line, &value)?),
            _ => {}
        }
        Ok(())
    }
}

/// Refuses a unit in brackets other than that of the format: `Max. Acc. (gal)`, `3920(gal)/6182761`.
fn in_gal(source: &Source<'_>, line: Line<'_>) -> Result<(), GroundMotionError> {
    let text = line.text();
    match in_brackets(&text).filter(|unit| SeriesUnit::parse(unit) != Some(SeriesUnit::CM_S2)) {
        Some(unit) => Err(source.error(
            line.number,
            text.find('(').unwrap_or(0),
            format!(
                "\"{}\" where the format has gal",
                number::shown(unit.as_bytes())
            ),
            REMEDY,
        )),
        None => Ok(()),
    }
}

/// Refuses a time, or a multiple of Hz, behind a sampling frequency or in the brackets of its key.
fn in_hertz(source: &Source<'_>, line: Line<'_>, value: &str) -> Result<(), GroundMotionError> {
    const OTHERS: [&str; 9] = [
        "s", "ms", "us", "sec", "secs", "msec", "second", "seconds", "khz",
    ];
    let number = |c: char| c.is_ascii_digit() || c.is_ascii_whitespace() || "+-.".contains(c);
    let behind = value.trim_start_matches(number).trim();
    let text = line.text();
    let of_key = in_brackets(&text).unwrap_or_default().trim();
    let is_other = |unit: &&str| OTHERS.iter().any(|other| unit.eq_ignore_ascii_case(other));
    match [behind, of_key].into_iter().find(is_other) {
        Some(unit) => Err(source.error(
            line.number,
            text.find(unit).unwrap_or(NAME),
            format!(
                "\"{}\" where the format has a sampling frequency in Hz",
                number::shown(unit.as_bytes())
            ),
            REMEDY,
        )),
        None => Ok(()),
    }
}

/// `3920(gal)/6182761` in gal a count.
fn scale(source: &Source<'_>, line: Line<'_>, value: &str) -> Result<f64, GroundMotionError> {
    in_gal(source, line)?;
    // The unit may have a stroke of its own.
    let (above, rest) = value.split_at(value.find(['(', '/']).unwrap_or(value.len()));
    let behind_unit = match rest.strip_prefix('(') {
        Some(unit) => unit.split_once(')').map_or("", |(_, behind)| behind),
        None => rest,
    };
    let whole = |text: &str| number::parse(text.as_bytes()).ok();
    let parts = behind_unit
        .trim_start()
        .strip_prefix('/')
        .and_then(|below| Some((whole(above)?, whole(below)?)));
    match parts {
        Some((above, below)) if above > 0.0 && below > 0.0 => Ok(above / below),
        _ => Err(source.error(
            line.number,
            NAME,
            format!("scale factor \"{value}\" is not like \"3920(gal)/6182761\""),
            REMEDY,
        )),
    }
}

/// KiK-net numbers its directions: 1 to 3 in the borehole, 4 to 6 at the surface.
fn direction(text: &str) -> String {
    match text {
        "1" => "NS1",
        "2" => "EW1",
        "3" => "UD1",
        "4" => "NS2",
        "5" => "EW2",
        "6" => "UD2",
        "N-S" => "NS",
        "E-W" => "EW",
        "U-D" => "UD",
        other => other,
    }
    .to_owned()
}
