//! COSMOS 1.20: blocks that announce their count and their Fortran format.

use crate::accelerogram::Processing;
use crate::draft::{Draft, DraftPeak, DraftUnit, StatedDuration, Times};
use crate::error::GroundMotionError;
use crate::formats::Format;
use crate::fortran::Layout;
use crate::number;
use crate::quantity::{Quantity, SeriesUnit};
use crate::recording::Series;
use crate::source::{HeaderNumbers, Source};
use crate::text::{Line, Lines};

const TEXT_LINES: usize = 13;
/// Numbers that a header block may have: the format defines 100.
const MOST_NUMBERS: usize = 1000;
const REMEDY: &str = "the header is not that of COSMOS 1.20: get the record again";

pub(super) static FORMAT: Format = Format {
    name: "cosmos",
    title: "COSMOS 1.20: V1c and V2c",
    source: "Consortium of Organizations for Strong-Motion Observation Systems",
    recognised_by: "(Format v in the first line",
    matches,
    read,
};

fn matches(source: &Source<'_>) -> bool {
    is_first(&source.first_line())
}

fn is_first(lower: &str) -> bool {
    lower.contains("(format v")
}

fn read(source: &Source<'_>) -> Result<Vec<Series>, GroundMotionError> {
    let mut lines = source.lines();
    let mut series = Vec::new();
    while let Some(first) = lines.next() {
        if is_first(&first.lower()) {
            let mut draft = channel(source, &mut lines, first)?;
            draft.channel = series.len() + 1;
            series.push(draft.finish(source)?);
        } else if !first.is_blank() && !first.lower().starts_with("end-of-data") {
            return Err(source.error(
                first.number,
                0,
                "text where a channel or the end of the file must be",
                REMEDY,
            ));
        }
    }
    Ok(series)
}

fn channel(
    source: &Source<'_>,
    lines: &mut Lines<'_>,
    first: Line<'_>,
) -> Result<Draft, GroundMotionError> {
    let lower = first.lower();
    let stated = number::after(&lower, " with ").map(|n| n.0);
    let count = stated
        .filter(|n| n.fract() == 0.0 && (2.0..100.0).contains(n))
        .map_or(TEXT_LINES, |n| n as usize);
    let mut text = vec![first];
    while text.len() < count {
        text.push(source.expect(lines, "the header's text")?);
    }
    let integers = numbers(source, lines, "integer")?;
    let reals = numbers(source, lines, "real")?;
    comments(source, lines)?;
    let announcement = source.expect(lines, "the line before the data")?;
    let data = announcement.lower();
    let (expected, layout) = announced(source, announcement)?;
    let samples = source.block(lines, layout, Some(expected), None)?;
    let unit = unit(source, announcement, &data, &integers)?;
    let mut draft = Draft::new(
        samples,
        unit,
        (reals.first, announcement.number + 1, lines.number()),
    );
    draft.header_count = Some(expected);
    draft.times = Times::Step(reals.positive(62).map(|ms| ms / 1000.0));
    draft.processing = match integers.get(1) {
        Some(2.0) => Processing::Corrected,
        Some(s) if s < 2.0 => Processing::Raw,
        _ => Processing::Unstated,
    };
    draft.component = component(&text, &integers);
    draft.title = format!(
        "{}; {}",
        text[1].text().trim(),
        text[4 % text.len()].columns(40, 80)
    );
    draft.corners = (reals.positive(54), reals.positive(57));
    draft.start_time = text
        .iter()
        .map(Line::text)
        .find_map(|l| Some(l.split_once("start time:")?.1.trim().to_owned()))
        .unwrap_or_default();
    draft.peak = reals.get(64).map(|value| DraftPeak {
        value: (value, 5.0e-5 * value.abs()),
        time: reals.get(65).map(|t| (t, 1.0e-3)),
        unit: None,
        shift: 0.0,
    });
    durations(&mut draft, &text, &reals, announcement);
    Ok(draft)
}

/// Reals that hold the length (s) of the raw record and of the series in this file.
const RAW_LENGTH: usize = 35;
const LENGTH: usize = 63;

/// The lengths that the header states: real 63; in words `Raw record length = 210.000 sec`,
/// which may be that of the record before it was processed; and `approx  210 secs` in the line
/// before the data, a whole number of seconds.
fn durations(draft: &mut Draft, text: &[Line<'_>], reals: &HeaderNumbers, announcement: Line<'_>) {
    let own = reals.positive(LENGTH);
    draft.header_durations = own
        .map(|seconds| StatedDuration {
            seconds,
            line: Some(reals.line_of(LENGTH)),
        })
        .into_iter()
        .collect();
    let in_words = text.iter().find_map(|line| {
        let lower = line.lower();
        let (_, rest) = lower.split_once("record length")?;
        Some((line.number, number::first_in(rest)?.0))
    });
    if let Some((line, seconds)) = in_words.filter(|(_, seconds)| *seconds > 0.0) {
        let words = StatedDuration {
            seconds,
            line: Some(line),
        };
        draft.state_in_words(words, reals.positive(RAW_LENGTH), own);
    }
    let approximate = number::after(&announcement.lower(), "approx").map(|n| n.0);
    let step = match draft.times {
        Times::Step(step) => step,
        Times::Each(_) => None,
    };
    if let (Some(seconds), Some(step)) = (approximate.filter(|s| *s > 0.0), step) {
        let found = draft.samples.len() as f64 * step;
        // Rounded or cut off to whole seconds.
        if (found - seconds).abs() > 1.0 {
            draft.header_durations.push(StatedDuration {
                seconds,
                line: Some(announcement.number),
            });
        }
    }
}

/// Count and format of a line such as ` 100 Real-header values follow on  20
/// lines, Format= (5F15.6)`.
fn announced(source: &Source<'_>, line: Line<'_>) -> Result<(usize, Layout), GroundMotionError> {
    let text = line.text();
    let count = number::first_in(&text)
        .map(|n| n.0)
        .filter(|n| n.fract() == 0.0 && (1.0..1.0e9).contains(n));
    match (count, Layout::find(&text)) {
        (Some(count), Some(layout)) => Ok((count as usize, layout)),
        _ => Err(source.error(
            line.number,
            0,
            "the line must hold a count and a format in parentheses",
            REMEDY,
        )),
    }
}

fn numbers(
    source: &Source<'_>,
    lines: &mut Lines<'_>,
    kind: &str,
) -> Result<HeaderNumbers, GroundMotionError> {
    let line = source.expect(lines, "the header's numbers")?;
    let (count, layout) = announced(source, line)?;
    if !line.lower().contains(kind) || count > MOST_NUMBERS {
        return Err(source.error(
            line.number,
            0,
            format!("the line must announce the {kind} numbers of the header"),
            REMEDY,
        ));
    }
    source.header_numbers(lines, layout, count)
}

fn comments(source: &Source<'_>, lines: &mut Lines<'_>) -> Result<(), GroundMotionError> {
    if !lines.peek().is_some_and(|l| l.lower().contains("comment")) {
        return Ok(());
    }
    let line = source.expect(lines, "comments")?;
    let count = number::first_in(&line.text()).map_or(0.0, |n| n.0).max(0.0);
    for _ in 0..count as usize {
        source.expect(lines, "a comment line")?;
    }
    Ok(())
}

/// `units=cm/sec2(04)`: the code counts; the header's integer 3 repeats it.
fn unit(
    source: &Source<'_>,
    line: Line<'_>,
    lower: &str,
    integers: &HeaderNumbers,
) -> Result<DraftUnit, GroundMotionError> {
    if integers.get(1).is_some_and(|stage| stage >= 3.0) {
        return Err(GroundMotionError::Unsupported {
            file: source.file.to_owned(),
            what: "the file holds spectra, no time series".to_owned(),
            remedy: "use the V2 file of the same record",
        });
    }
    let printed = lower
        .split_once("units=")
        .and_then(|(_, rest)| number::after(rest, "("))
        .map(|n| n.0);
    let code = printed.or_else(|| integers.get(3));
    let unit = match code {
        Some(2.0) => SeriesUnit::G,
        Some(4.0 | 10.0) => SeriesUnit::CM_S2,
        Some(5.0) => SeriesUnit::CM_S,
        Some(6.0) => SeriesUnit::CM,
        Some(7.0) => SeriesUnit::IN_S2,
        Some(8.0) => SeriesUnit::IN_S,
        Some(9.0) => SeriesUnit::IN,
        Some(11.0) => SeriesUnit::MILLI_G,
        Some(12.0) => SeriesUnit::MICRO_G,
        Some(50.0) => return Ok(DraftUnit::Counts),
        Some(other) => {
            return Err(source.error(
                line.number,
                0,
                format!("unit code {other} is not one of ground motion"),
                "use the V1 or V2 file of the same record",
            ));
        }
        None => return Ok(DraftUnit::Unstated),
    };
    let said = match integers.get(2) {
        Some(1.0) => Some(Quantity::Acceleration),
        Some(2.0) => Some(Quantity::Velocity),
        Some(3.0 | 4.0) => Some(Quantity::Displacement),
        _ => None,
    };
    match said {
        Some(quantity) if quantity != unit.quantity => Err(source.error(
            line.number,
            0,
            format!("{quantity} in {}", unit.symbol),
            "header and data contradict one another: get the record again",
        )),
        _ => Ok(DraftUnit::Stated(unit)),
    }
}

/// Azimuth of integer 54, or the words of the header's line `Sta Chan`.
fn component(text: &[Line<'_>], integers: &HeaderNumbers) -> String {
    match integers.get(54) {
        Some(400.0) => "Up".to_owned(),
        Some(401.0) => "Down".to_owned(),
        Some(402.0) => "Vertical".to_owned(),
        Some(azimuth) if (1.0..=360.0).contains(&azimuth) => format!("{azimuth} deg"),
        _ => text
            .iter()
            .map(Line::text)
            .find(|l| l.starts_with("Sta Chan"))
            .and_then(|l| {
                l.get(8..)?
                    .split_once(':')?
                    .1
                    .split('(')
                    .next()
                    .map(str::to_owned)
            })
            .unwrap_or_default()
            .trim()
            .to_owned(),
    }
}
