//! Volume 1, uncorrected: pairs of time and acceleration, or even steps.

use crate::accelerogram::Processing;
use crate::draft::{Draft, DraftPeak, DraftUnit, Times};
use crate::error::GroundMotionError;
use crate::fortran::Layout;
use crate::number;
use crate::quantity::SeriesUnit;
use crate::recording::Series;
use crate::source::Source;
use crate::text::{Line, Lines};
use crate::volume::{ChannelHeader, end_of_channel};

const TEXT_LINES: usize = 13;
const REALS: usize = 50;
/// Five pairs a line: CDMG prints seven columns a number, USC eight.
const PAIRS: [Layout; 2] = [Layout::new(10, 7), Layout::new(10, 8)];
const EVEN: Layout = Layout::new(8, 9);

/// Reads all channels.
pub(crate) fn read(source: &Source<'_>) -> Result<Vec<Series>, GroundMotionError> {
    let mut lines = source.lines();
    let mut series = Vec::new();
    while let Some(header) = ChannelHeader::read(source, &mut lines, TEXT_LINES, REALS)? {
        let mut draft = match lines.peek() {
            Some(line) if line.is_text() => even(source, &mut lines, &header)?,
            _ => pairs(source, &mut lines, &header)?,
        };
        let (channel, component) = header.component(7);
        let (_, other) = header.component(8);
        draft.component = if component.is_empty() {
            other
        } else {
            component
        };
        draft.channel = channel.unwrap_or(series.len() + 1);
        draft.processing = Processing::Raw;
        draft.title = header.title(6, 2);
        draft.start_time = header.start_time();
        draft.peak = peak(&header);
        draft.header_duration = duration(&header);
        series.push(draft.finish(source)?);
        end_of_channel(source, &mut lines);
    }
    Ok(series)
}

/// The count in the header: integer 33 where it is there, for 28 is an I5 field
/// that new files overrun; held against the text.
fn count(header: &ChannelHeader<'_>, warnings: &mut Vec<String>) -> Option<usize> {
    let stated = header
        .integers
        .count(33)
        .or_else(|| header.integers.count(28));
    let text = header
        .find("of points")
        .and_then(|l| number::after(&l, "of points"))
        .filter(|n| n.0.fract() == 0.0 && (1.0..1.0e9).contains(&n.0))
        .map(|n| n.0 as usize);
    match (stated, text) {
        (Some(a), Some(b)) if a != b => {
            warnings.push(format!("the header says {a} samples, its text {b}"));
        }
        _ => {}
    }
    stated.or(text)
}

/// Unit in the text: `SEC AND G/10`, `sec and g.`, `IS G`.
fn unit(header: &ChannelHeader<'_>, label: &str) -> DraftUnit {
    let line = header.find("units ").unwrap_or_default();
    let line = if line.is_empty() { label } else { &line };
    let before_peak = line.split("max").next().unwrap_or_default();
    let word = [" and ", " is ", " of g"]
        .iter()
        .find_map(|key| {
            let at = before_peak.rfind(key)? + key.len();
            let at = if *key == " of g" { at - 1 } else { at };
            before_peak.get(at..)?.split_whitespace().next()
        })
        .unwrap_or_default();
    let word = word.trim_end_matches(['.', ',']);
    SeriesUnit::parse(word).map_or(DraftUnit::Unstated, DraftUnit::Stated)
}

/// `MAX = -.200 G, AT 11.576 SEC.`: in g whatever the unit of the samples.
fn peak(header: &ChannelHeader<'_>) -> Option<DraftPeak> {
    let line = header.find("max ")?;
    let at = line.find("max ")?;
    let rest = line.get(at..)?;
    if !rest.contains(" g,") {
        return None;
    }
    Some(DraftPeak {
        value: number::after(rest, "=")?,
        time: number::after(rest, " at "),
        unit: Some(SeriesUnit::G),
        shift: 0.0,
    })
}

/// Even steps after a line such as ` 31932 Accelerogram points at 100 pts/sec in
/// units of g.  Format: (8f9.6)`.
fn even(
    source: &Source<'_>,
    lines: &mut Lines<'_>,
    header: &ChannelHeader<'_>,
) -> Result<Draft, GroundMotionError> {
    let label = source.expect(lines, "the line before the data")?;
    let text = label.lower();
    let layout = Layout::find(&text).unwrap_or(EVEN);
    let mut warnings = Vec::new();
    let in_header = count(header, &mut warnings);
    let in_label = number::first_in(&text)
        .filter(|n| n.0.fract() == 0.0 && (1.0..1.0e9).contains(&n.0))
        .map(|n| n.0 as usize);
    if let (Some(a), Some(b)) = (in_header, in_label)
        && a != b
    {
        warnings.push(format!(
            "the header says {a} samples, the line before the data {b}"
        ));
    }
    let expected = in_label.or(in_header);
    let step = number::time_step(&text)
        .or_else(|| number::time_step(&header.find("samples/sec")?))
        .map(|step| step.0);
    let samples = source.block(lines, layout, expected, None)?;
    let mut draft = Draft::new(
        samples,
        unit(header, &text),
        (label.number, label.number + 1, lines.number()),
    );
    draft.times = Times::Step(step);
    draft.header_count = expected;
    draft.warnings = warnings;
    Ok(draft)
}

fn pairs(
    source: &Source<'_>,
    lines: &mut Lines<'_>,
    header: &ChannelHeader<'_>,
) -> Result<Draft, GroundMotionError> {
    let first = lines.number() + 1;
    let mut warnings = Vec::new();
    let expected = count(header, &mut warnings);
    let length = lines.peek().map_or(0, |l: Line<'_>| l.bytes.len());
    // The first row tells the width: it is full unless the record is tiny.
    let layout = match (length % PAIRS[0].width, length % PAIRS[1].width) {
        (0, _) if length <= 70 => PAIRS[0],
        (_, 0) => PAIRS[1],
        _ => PAIRS[0],
    };
    let numbers = source.block(lines, layout, expected.map(|n| 2 * n), None)?;
    if !numbers.len().is_multiple_of(2) {
        return Err(source.error(
            lines.number(),
            0,
            "a time without its acceleration",
            "the file is damaged or truncated: get it again",
        ));
    }
    let times: Vec<f64> = numbers.chunks_exact(2).map(|p| p[0]).collect();
    let samples = numbers.chunks_exact(2).map(|p| p[1]).collect();
    let mut draft = Draft::new(samples, unit(header, ""), (first, first, lines.number()));
    draft.times = Times::Each(times);
    draft.header_count = expected;
    draft.warnings = warnings;
    Ok(draft)
}

/// The length of the record in the header (s): real 3, else the text.
fn duration(header: &ChannelHeader<'_>) -> Option<f64> {
    header.reals.positive(3).or_else(|| {
        let line = header.find("record length")?;
        let stated = number::after(&line, "record length").map(|n| n.0);
        stated.filter(|s| *s > 0.0)
    })
}
