//! Time series of EarthScope (IRIS) as text: a line `TIMESERIES NET_STA_LOC_CHA_Q, 600 samples, 100 sps,
//! 2020-01-01T00:00:00.000000, SLIST, FLOAT, M/S**2`, then values (SLIST) or rows of time and value
//! (TSPAIR).

use crate::cut_numbers::Forms;
use crate::draft::{Draft, DraftUnit};
use crate::error::{GroundMotionError, bound};
use crate::format::Format;
use crate::formats::rows::DecimalCommas;
use crate::instrument;
use crate::number;
use crate::origin::Processing;
use crate::quantity::SeriesUnit;
use crate::recording::Series;
use crate::row_widths::RowWidths;
use crate::source::Source;
use crate::start_times::apart;
use crate::text::{Line, Lines};
use crate::time_column::Times;

const REMEDY: &str = "the line must be like `TIMESERIES NET_STA_LOC_CHA_Q, 600 samples, 100 sps, 2020-01-01T00:00:00.000000, SLIST, FLOAT, M/S**2`: get the record again";
const REMEDY_UNIT: &str =
    "write the unit of motion, such as M/S**2, or Counts behind the last comma of the line";
/// Part of the step by which a printed time may miss the one after the time before it.
const TIME_TOLERANCE: f64 = 0.5;
/// Part by which the times of all samples may contradict the rate.
const RATE_TOLERANCE: f64 = 0.01;

pub(super) static FORMAT: Format = Format {
    name: "iris_ascii",
    title: "Time series as text: SLIST and TSPAIR",
    source: "EarthScope Consortium (IRIS), United States; also written by ObsPy",
    recognised_by: "a first line that starts with TIMESERIES and has SLIST or TSPAIR",
};

pub(super) fn matches(source: &Source<'_>) -> bool {
    let first = source.first_line();
    is_header(&first) && first.split(',').any(|word| kind(word).is_some())
}

fn is_header(lower: &str) -> bool {
    lower.trim_start().starts_with("timeseries ")
}

/// What follows the header.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Values,
    Pairs,
}

fn kind(word: &str) -> Option<Kind> {
    match word.trim() {
        "slist" => Some(Kind::Values),
        "tspair" => Some(Kind::Pairs),
        _ => None,
    }
}

/// What the header says.
struct Header {
    line: usize,
    /// Network and station.
    station: String,
    channel: String,
    count: usize,
    /// Time step (s).
    step: f64,
    start: String,
    kind: Kind,
    unit: DraftUnit,
}

pub(super) fn read(source: &Source<'_>) -> Result<Vec<Series>, GroundMotionError> {
    let mut lines = source.lines();
    let header = Header::of(source, source.expect(&mut lines, "the header")?)?;
    let is_of_counts = matches!(header.unit, DraftUnit::Counts);
    if is_of_counts && source.options.sensitivity.is_none() {
        return Err(GroundMotionError::Unsupported {
            file: source.file.to_owned(),
            what: "the record is in counts and does not state how many make 1 m/s2; files of response are read for miniSEED records alone".to_owned(),
            remedy: "give `sensitivity` in counts per m/s2, or the record as miniSEED with its StationXML as `response`; where the values are in a unit, write it behind the last comma of the header",
        });
    }
    let samples = match header.kind {
        Kind::Values => values(source, &mut lines, header.count)?,
        Kind::Pairs => pairs(source, &mut lines, &header)?,
    };
    let lines = (header.line, header.line + 1, lines.number());
    let mut draft = Draft::new(samples, header.unit, lines);
    draft.header_count = Some(header.count);
    // No row is filled.
    draft.row = Some(1);
    draft.times = Times::Step(Some(header.step));
    draft.component = header.channel;
    draft.title = header.station;
    draft.start_time = format!("{} UTC", header.start);
    if is_of_counts {
        draft.processing = Processing::Raw;
    }
    Ok(vec![draft.finish(source)?])
}

impl Header {
    fn of(source: &Source<'_>, line: Line<'_>) -> Result<Self, GroundMotionError> {
        let text = line.text();
        let fields: Vec<&str> = text.split(',').map(str::trim).collect();
        let wrong = |what: &str| source.error(line.number, 0, what, REMEDY);
        let [first, count, rate, start, kind_of, of, rest @ ..] = &fields[..] else {
            return Err(wrong("the header has too few commas"));
        };
        let name = first.split_whitespace().nth(1).unwrap_or_default();
        let (station, channel) = match name.split('_').collect::<Vec<_>>()[..] {
            [network, station, _, channel, _] => (format!("{network}.{station}"), channel),
            _ => (name.to_owned(), ""),
        };
        let number = |field: &str, units: &[&str]| {
            let (number, unit) = field.split_once(' ')?;
            let unit = unit.trim().to_ascii_lowercase();
            let value = number::parse(number.as_bytes()).ok()?;
            (units.contains(&unit.as_str()) && value > 0.0).then_some(value)
        };
        let count = number(count, &["samples", "sample"])
            .filter(|n| n.fract() == 0.0 && *n < 1.0e9)
            .ok_or_else(|| wrong("the header does not say how many samples follow"))?;
        let rate = number(rate, &["sps", "hz"])
            .ok_or_else(|| wrong("the header has no rate in samples per second (sps)"))?;
        let kind = kind(&kind_of.to_ascii_lowercase())
            .ok_or_else(|| wrong("the header says neither SLIST nor TSPAIR"))?;
        if !["float", "integer"].contains(&of.to_ascii_lowercase().as_str()) {
            return Err(wrong("the values are neither FLOAT nor INTEGER"));
        }
        let unit = unit(source, line, &rest.join(","), channel)?;
        Ok(Self {
            line: line.number,
            station,
            channel: channel.to_owned(),
            count: count as usize,
            step: 1.0 / rate,
            start: (*start).to_owned(),
            kind,
            unit,
        })
    }
}

/// The unit behind the last comma. Where it is none of motion, the channel's code says what was recorded.
fn unit(
    source: &Source<'_>,
    line: Line<'_>,
    word: &str,
    channel: &str,
) -> Result<DraftUnit, GroundMotionError> {
    let lower = word.trim().to_ascii_lowercase();
    if let Some(unit) = SeriesUnit::parse(&lower) {
        return Ok(DraftUnit::Stated(unit));
    }
    let unit = match lower.as_str() {
        "count" | "counts" => DraftUnit::Counts,
        // A sensitivity says that there are counts.
        "" if source.options.sensitivity.is_some() => DraftUnit::Counts,
        "" => DraftUnit::Unstated,
        _ => return Err(source.unknown_unit(line.number, word.trim(), REMEDY_UNIT)),
    };
    instrument::may_accelerate(
        source,
        channel,
        "the header does not say what the values are",
        "use the channel of an accelerograph, or write the unit of the values, such as M/S**2, behind the last comma of the header",
    )?;
    Ok(unit)
}

/// Refuses another header within the file.
fn is_one_segment(source: &Source<'_>, line: Line<'_>) -> Result<(), GroundMotionError> {
    let lower = line.lower();
    if !is_header(&lower) {
        return Ok(());
    }
    let name = lower.split([' ', ',']).nth(1).unwrap_or_default();
    Err(source.error(
        line.number,
        0,
        format!(
            "a second segment starts here, of {}: the record is interrupted, or another channel follows",
            name.to_ascii_uppercase()
        ),
        "put each channel into a file of its own; where one is interrupted, take the segment that holds the strong motion, or get the record without gaps",
    ))
}

fn values(
    source: &Source<'_>,
    lines: &mut Lines<'_>,
    count: usize,
) -> Result<Vec<f64>, GroundMotionError> {
    let mut commas = DecimalCommas::default();
    let mut samples = Vec::with_capacity(lines.remaining() / 2 + 1);
    let mut forms = Forms::default();
    let mut widths = RowWidths::default();
    for line in lines.by_ref() {
        is_one_segment(source, line)?;
        commas.see(line);
        let before = samples.len();
        for (column, field) in line.fields() {
            samples.push(source.number(line, column, field)?);
            forms.see(line.number, column, field);
        }
        if samples.len() > before {
            widths.see(line.number, samples.len() - before);
        }
    }
    commas.part_values(source, samples.len(), Some(count))?;
    widths.are_even(source)?;
    match source.ends_whole()? {
        true => forms.are_whole(source)?,
        false => drop(samples.pop()),
    }
    Ok(samples)
}

/// Rows of a time and a value, each a step after the one before it.
fn pairs(
    source: &Source<'_>,
    lines: &mut Lines<'_>,
    header: &Header,
) -> Result<Vec<f64>, GroundMotionError> {
    let mut samples = Vec::with_capacity(lines.remaining() / 20 + 1);
    let mut forms = Forms::default();
    let mut before = header.start.clone();
    let mut total = 0.0;
    for line in lines.by_ref().filter(|line| !line.is_blank()) {
        is_one_segment(source, line)?;
        let mut fields = line.fields();
        let (Some((_, time)), Some((column, field)), None) =
            (fields.next(), fields.next(), fields.next())
        else {
            return Err(source.error(
                line.number,
                0,
                "there must be two columns, time and value",
                "the file is damaged: get it again",
            ));
        };
        let time = String::from_utf8_lossy(time).into_owned();
        // The first one is that of the header.
        let expected = if samples.is_empty() { 0.0 } else { header.step };
        let found = apart(&before, &time).filter(|_| before <= time);
        let Some(found) =
            found.filter(|found| (found - expected).abs() <= TIME_TOLERANCE * header.step)
        else {
            return Err(source.error(
                line.number,
                0,
                format!(
                    "the time {time} is not {} s after {before}, as the rate and the start of line {} say",
                    bound(expected),
                    header.line
                ),
                "a row is missing, doubled or out of its place, or the header is wrong: get the record again",
            ));
        };
        total += found;
        before = time;
        samples.push(source.number(line, column, field)?);
        forms.see(line.number, column, field);
    }
    forms.are_whole(source)?;
    let steps = samples.len().saturating_sub(1) as f64;
    let by_rate = steps * header.step;
    if (total - by_rate).abs() > (RATE_TOLERANCE * by_rate).max(header.step) {
        let message = format!(
            "the rate is {} samples per second here, but the times are {} s apart on average",
            bound(1.0 / header.step),
            bound(total / steps)
        );
        source.contradiction(header.line, message)?;
    }
    Ok(samples)
}
