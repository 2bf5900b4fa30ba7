//! Volume 1, uncorrected: pairs of time and acceleration, or even steps.

use crate::draft::{Draft, DraftPeak, DraftUnit, NamedQuantity, StatedDuration, several};
use crate::error::{GroundMotionError, bound};
use crate::fortran::Layout;
use crate::number;
use crate::origin::Processing;
use crate::quantity::SeriesUnit;
use crate::recording::Series;
use crate::source::Source;
use crate::stated_step::{STEP_TOLERANCE, StatedStep, state_step};
use crate::text::{Line, Lines};
use crate::time_column::{PrintedDigits, Times, even_step_of_rounded, part_ties, tied_times};
use crate::volume::{ChannelHeader, end_of_channel, unit_of_number};

const TEXT_LINES: usize = 13;
const REALS: usize = 50;
/// Five pairs per line: CDMG prints seven columns per number, USC eight, or seven after a
/// blank one. The decimal points of the first line tell; this is for lines that do not.
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
        let (channel, component) = header.agreed_component(source, 7)?;
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
        let of_unit = header.find_line("units ");
        let of_unit = of_unit.and_then(|(line, text)| NamedQuantity::of(line, before_peak(&text)));
        draft.quantities.extend(of_unit);
        draft.header_durations = durations(&header);
        series.push(draft.finish(source)?);
        end_of_channel(source, &mut lines);
        if ends_in_a_remark(source, &lines, &header) {
            break;
        }
    }
    Ok(series)
}

/// Bytes of a line behind the last channel that is no header of another one.
const REMARK: usize = 20;

/// Whether a short line or two end the file that have nothing of the header of a channel, as `VLEE $` of an old
/// computer's job: they are passed over.
fn ends_in_a_remark(source: &Source<'_>, lines: &Lines<'_>, header: &ChannelHeader<'_>) -> bool {
    let rest: Vec<Line<'_>> = lines.clone().filter(|l| !l.is_blank()).take(3).collect();
    let first = header.text.first().map_or(String::new(), Line::lower);
    let alike = |line: &Line<'_>| {
        let lower = line.lower();
        let mut words = lower.split(|c: char| !c.is_alphanumeric());
        words.any(|word| word.len() > 2 && first.contains(word))
    };
    let short = |line: &Line<'_>| line.bytes.len() < REMARK && line.is_text() && !alike(line);
    let Some(line) = rest
        .first()
        .filter(|_| rest.len() < 3 && rest.iter().all(short))
    else {
        return false;
    };
    source.warn(&format!(
        "line {}: \"{}\" behind the last channel is no header of another one, and is not read",
        line.number,
        line.text().trim()
    ));
    true
}

/// The count in the header: integer 33 where it is there, for 28 is an I5 field
/// that new files overrun; held against the text.
fn count(
    header: &ChannelHeader<'_>,
    warnings: &mut Vec<String>,
) -> (Option<usize>, Vec<(usize, usize)>) {
    let stated = header
        .integers
        .count(33)
        .or_else(|| header.integers.count(28));
    let text = header.find_line("of points").and_then(|(line, text)| {
        let count = number::stated(&text, "of points")?.0;
        let whole = count.fract() == 0.0 && (1.0..1.0e9).contains(&count);
        whole.then_some((line, count as usize))
    });
    if let (Some(a), Some((_, b))) = (stated, text)
        && a != b
    {
        warnings.push(format!("the header says {a} samples, its text {b}"));
    }
    (
        stated.or(text.map(|(_, count)| count)),
        text.into_iter().collect(),
    )
}

const REMEDY_UNIT: &str = "the unit of the values must be certain: get the record again, or say which it is, `unit = \"g\"` in [ground_motion] of a case, `--unit g` with `pounding motion`";

/// Words before a unit, the surest first.
const BEFORE_UNIT: [&str; 8] = [
    " and ",
    " is ",
    " are ",
    "units:",
    "units =",
    "units=",
    "units of ",
    ", in ",
];

/// What stands before the peak in the line of the unit.
fn before_peak(text: &str) -> &str {
    text.split("max").next().unwrap_or_default()
}

/// The words of a text that may be its unit, the surest first: `SEC AND G/10`, `sec and g.`,
/// `IS G`, `(UNITS: G)`, `in units of g.`.
fn unit_words(text: &str) -> impl Iterator<Item = &str> {
    let before_peak = before_peak(text);
    BEFORE_UNIT.iter().filter_map(move |key| {
        let at = before_peak.rfind(key)? + key.len();
        let word = before_peak.get(at..)?.split_whitespace().next()?;
        // A code may touch it: `cm/sec2(04)`.
        let word = word.split(['(', ')', ',', ';']).next()?;
        Some(word.trim_end_matches('.'))
    })
}

/// Unit in a text.
fn unit_in(text: &str) -> Option<SeriesUnit> {
    unit_words(text).find_map(SeriesUnit::parse)
}

/// What follows `(UNITS: ` in the line before the data.
fn unit_word(label: &str) -> Option<&str> {
    let (_, rest) = label
        .split_once("units:")
        .or_else(|| label.split_once("units="))?;
    rest.split([')', '(', ',']).next().map(str::trim)
}

/// Real that holds the unit as a part of g, in volumes of the University of Southern California.
const UNIT: usize = 5;

/// The unit in numbers. CSMIP leaves the field to chance: it is read where the first line is that
/// of a Volume I.
fn unit_in_numbers(header: &ChannelHeader<'_>) -> Option<(usize, SeriesUnit)> {
    let first = header.text.first()?.lower();
    let unit = match header.reals.positive(UNIT) {
        Some(0.1) => SeriesUnit::TENTH_G,
        Some(1.0) => SeriesUnit::G,
        _ => return None,
    };
    let volume_1 = first.contains("data of vol");
    volume_1.then_some((header.reals.line_of(UNIT), unit))
}

/// The unit of the values, which header and line before the data may both state. The
/// volume fixes none, and both are copied from one value by the agencies' programs: where
/// they differ neither is certain, and the user must say.
fn unit(
    source: &Source<'_>,
    header: &ChannelHeader<'_>,
    label: Option<(usize, &str)>,
    warnings: &mut Vec<String>,
) -> Result<DraftUnit, GroundMotionError> {
    let line = header.find_line("units ");
    let in_header = match &line {
        Some((line, text)) => match (unit_in(text), unit_words(text).next()) {
            (Some(unit), _) => Some((*line, unit)),
            // Who says the unit knows it.
            (None, Some(word)) if source.options.unit.is_none() => {
                return Err(source.unknown_unit(*line, word, REMEDY_UNIT));
            }
            (None, _) => None,
        },
        None => None,
    };
    let in_label = label.and_then(|(_, text)| unit_in(text));
    if let (Some((line, words)), Some((at, number))) = (in_header, unit_in_numbers(header))
        && words != number
    {
        return Err(source.error(
            line,
            0,
            format!(
                "the unit is {} here, but {} in line {at}",
                words.symbol, number.symbol
            ),
            "the header contradicts itself: get the record again",
        ));
    }
    let unknown = label.and_then(|(_, text)| unit_word(text));
    let (Some((line, above)), Some((at, _))) = (in_header, label) else {
        let stated = in_header.map(|u| u.1).or(in_label);
        return Ok(stated.map_or(DraftUnit::Unstated, DraftUnit::Stated));
    };
    let below = match (in_label, unknown) {
        (Some(below), _) if below != above => below.symbol.to_owned(),
        (None, Some(word)) => word.to_owned(),
        _ => return Ok(DraftUnit::Stated(above)),
    };
    let message = format!(
        "the unit of the values is {below} here, but {} in line {line}",
        above.symbol
    );
    let given = source.options.unit.and_then(|given| {
        let stated = [Some(above), in_label].into_iter().flatten();
        stated.into_iter().find(|unit| unit.is(given))
    });
    if let Some(given) = given {
        warnings.push(format!("line {at}: {message}; {} was given", given.symbol));
        return Ok(DraftUnit::Stated(given));
    }
    Err(source.error(at, 0, message, REMEDY_UNIT))
}

/// Every sampling rate in the text of the header, and the step on the line that counts the
/// points; elsewhere `at .. sec` is the time of something.
fn steps_of_header(header: &ChannelHeader<'_>) -> Vec<StatedStep> {
    let mut found = Vec::new();
    for line in &header.text {
        let text = line.lower();
        let on_points = text.contains("of points") || text.contains("record length");
        let step = number::time_step(&text).filter(|_| on_points);
        let all = step.into_iter().chain(number::rates(&text));
        found.extend(all.map(|(step, _)| StatedStep {
            line: line.number,
            step,
        }));
    }
    found
}

/// Takes the step of the line before the data, else of the header; all must be the same.
fn state_steps(
    draft: &mut Draft,
    source: &Source<'_>,
    header: &ChannelHeader<'_>,
    (line, label): (usize, &str),
) {
    let of_label = number::time_step(label)
        .into_iter()
        .chain(number::rates(label));
    let mut stated: Vec<StatedStep> = of_label
        .map(|(step, _)| StatedStep { line, step })
        .collect();
    stated.extend(steps_of_header(header));
    state_step(draft, source, &stated);
}

/// `MAX = -.200 G, AT 11.576 SEC.`: in its own unit, whatever that of the samples.
fn peak(header: &ChannelHeader<'_>) -> Option<DraftPeak> {
    let (number, line) = header.find_line("max ")?;
    let at = line.find("max ")?;
    let rest = line.get(at..)?;
    Some(DraftPeak {
        value: number::stated(rest, "=")?,
        time: number::stated(rest, " at "),
        unit: Some(unit_of_number(rest, "=")?),
        shift: 0.0,
        line: Some(number),
        of_sign: false,
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
    let (in_header, in_words) = count(header, &mut warnings);
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
    let place = (label.number, text.as_str());
    let unit = unit(source, header, Some(place), &mut warnings)?;
    let samples = source.block(lines, layout, expected, None)?;
    let mut draft = Draft::new(
        samples,
        unit,
        (label.number, label.number + 1, lines.number()),
    );
    draft.header_count = expected;
    draft.row = several(layout.per_line);
    draft.other_counts = in_words;
    draft.quantities = NamedQuantity::of(label.number, &text).into_iter().collect();
    draft.warnings = warnings;
    state_steps(&mut draft, source, header, place);
    Ok(draft)
}

fn pairs(
    source: &Source<'_>,
    lines: &mut Lines<'_>,
    header: &ChannelHeader<'_>,
) -> Result<Draft, GroundMotionError> {
    let first = lines.number() + 1;
    let mut warnings = Vec::new();
    let (expected, in_words) = count(header, &mut warnings);
    let row: &[u8] = lines.peek().map_or(&[], |l: Line<'_>| l.bytes);
    // The first row tells the width: it is full unless the record is tiny.
    let by_length = match (row.len() % PAIRS[0].width, row.len() % PAIRS[1].width) {
        (0, _) if row.len() <= 70 => PAIRS[0],
        (_, 0) => PAIRS[1],
        _ => PAIRS[0],
    };
    let layout = Layout::of_points(row).unwrap_or(by_length);
    let decimals = row.rsplit(|b| *b == b'.').next().map_or(0, <[u8]>::len);
    let numbers = source.block(lines, layout, expected.map(|n| 2 * n), None)?;
    if !numbers.len().is_multiple_of(2) {
        return Err(source.error(
            lines.number(),
            0,
            "a time without its acceleration",
            "the file is damaged or truncated: get it again",
        ));
    }
    let mut times: Vec<f64> = numbers.chunks_exact(2).map(|p| p[0]).collect();
    let samples = numbers.chunks_exact(2).map(|p| p[1]).collect();
    let digit = 10.0_f64.powi(-(decimals.min(9) as i32));
    let printed = PrintedDigits::of_decimals(decimals, &times);
    // Of recorders that are digital, as those of RENADIC: film was read at uneven times.
    let even = even_step_of_rounded(&times, printed).filter(|_| times[0] == 0.0);
    let tied = part_ties(&mut times, |_| digit);
    if tied > 0 {
        warnings.push(tied_times(tied));
    }
    rate_of_pairs(header, &times, &mut warnings);
    let unit = unit(source, header, None, &mut warnings)?;
    let mut draft = Draft::new(samples, unit, (first, first, lines.number()));
    draft.times = match even {
        Some(step) => Times::Step(Some(step)),
        None => Times::Each(times),
    };
    draft.header_count = expected;
    draft.row = several(layout.per_line / 2);
    draft.other_counts = in_words;
    draft.warnings = warnings;
    Ok(draft)
}

/// Names a rate in the header that is not that of the times. The times are the data: every
/// value has its own, and a nominal rate changes none of them.
fn rate_of_pairs(header: &ChannelHeader<'_>, times: &[f64], warnings: &mut Vec<String>) {
    let (Some(first), Some(last)) = (times.first(), times.last()) else {
        return;
    };
    let mean = (last - first) / (times.len().max(2) - 1) as f64;
    for stated in steps_of_header(header) {
        if (stated.step - mean).abs() > STEP_TOLERANCE * stated.step {
            warnings.push(format!(
                "line {} says {} samples/s, the times are {} s apart on average",
                stated.line,
                bound(1.0 / stated.step),
                bound(mean)
            ));
            return;
        }
    }
}

/// The lengths of the record in the header: real 3, and the text, which is printed apart
/// from it and may have been changed alone.
fn durations(header: &ChannelHeader<'_>) -> Vec<StatedDuration> {
    let words = header.duration_in_words();
    words
        .into_iter()
        .chain(header.duration_in_numbers(3))
        .collect()
}
