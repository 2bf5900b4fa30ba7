//! Building and Housing Research Center of Iran: the headers of Volume 1, cut at 72 columns, and
//! accelerations at even steps.

use crate::draft::{Draft, DraftUnit, StatedDuration, several};
use crate::error::{GroundMotionError, bound};
use crate::format::Format;
use crate::fortran::Layout;
use crate::number;
use crate::origin::Processing;
use crate::quantity::SeriesUnit;
use crate::recording::Series;
use crate::source::{HeaderNumbers, Source};
use crate::text::{Line, Lines};
use crate::time_column::Times;
use crate::volume::REMEDY_UNIT;

const TEXT_LINES: usize = 13;
/// Cards of 80 columns of which 72 are left: whole fields alone are read.
const INTEGERS: Layout = Layout::new(16, 5);
const REALS: Layout = Layout::new(8, 13);
/// `10E13.6`.
const DATA: Layout = Layout::new(10, 13).with_exponents();
/// Integer that holds the count; reals that hold the length (s), the unit (g) and the rate (1/s).
const COUNT: usize = 28;
const LENGTH: usize = 3;
const UNIT: usize = 5;
const RATE: usize = 9;
const REMEDY: &str = "the header contradicts itself: get the record again";

pub(super) static FORMAT: Format = Format {
    name: "bhrc",
    title: "Building and Housing Research Center, Iran: Volume 1",
    source: "Road, Housing and Urban Development Research Center (BHRC), Iran",
    recognised_by: "a first line that starts with * VOL and a digit",
};

pub(super) fn matches(source: &Source<'_>) -> bool {
    is_first(&source.first_line())
}

fn is_first(lower: &str) -> bool {
    let rest = lower.trim_start().strip_prefix('*').map(str::trim_start);
    let volume = rest.and_then(|rest| rest.strip_prefix("vol"));
    volume.is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit()))
}

pub(super) fn read(source: &Source<'_>) -> Result<Vec<Series>, GroundMotionError> {
    let mut lines = source.lines();
    let mut series = Vec::new();
    while let Some(first) = lines.next() {
        if first.is_blank() {
            continue;
        }
        let lower = first.lower();
        if !is_first(&lower) {
            return Err(source.error(
                first.number,
                0,
                "text where a channel or the end of the file must be",
                "the file is damaged: get it again",
            ));
        }
        if !lower.contains("vol1") {
            return Err(GroundMotionError::Unsupported {
                file: source.file.to_owned(),
                what: "of this agency's files only Volume 1 is read".to_owned(),
                remedy: "use the Volume 1 file (.V1) of the same record",
            });
        }
        let mut draft = channel(source, &mut lines, first)?;
        draft.channel = series.len() + 1;
        series.push(draft.finish(source)?);
        let end = |l: &Line<'_>| l.bytes.trim_ascii_start().starts_with(b"/");
        match lines.peek() {
            Some(line) if end(&line) => {
                lines.next();
            }
            _ => source.warn("a channel does not end in a line that starts with /&"),
        }
    }
    Ok(series)
}

fn channel<'a>(
    source: &Source<'a>,
    lines: &mut Lines<'a>,
    first: Line<'a>,
) -> Result<Draft, GroundMotionError> {
    let mut text = vec![first];
    while text.len() < TEXT_LINES {
        text.push(source.expect(lines, "the header of a channel")?);
    }
    let integers = source.header_numbers(lines, INTEGERS, 100)?;
    let reals = source.header_numbers(lines, REALS, 50)?;
    let in_words = text.iter().find_map(|line| {
        let count = number::stated(&line.lower(), "of points")?.0;
        let whole = count.fract() == 0.0 && (1.0..1.0e9).contains(&count);
        whole.then_some((line.number, count as usize))
    });
    let in_numbers = integers.count(COUNT);
    let Some(count) = in_words.map(|(_, count)| count).or(in_numbers) else {
        return Err(source.error(
            integers.line_of(COUNT),
            0,
            format!("the header has no number of points (integer {COUNT})"),
            "the header is damaged: get the record again",
        ));
    };
    // Five columns keep the last five digits of a count.
    let other = in_numbers.filter(|n| *n != count % 100_000);
    let other_counts = other.map(|n| (integers.line_of(COUNT), n));
    let start = lines.number() + 1;
    full_row(source, lines)?;
    let numbers = source.block(lines, DATA, Some(count), None)?;
    let places = (reals.line_of(LENGTH), start, lines.number());
    let unit = DraftUnit::Stated(unit(source, &text, &reals)?);
    let mut draft = if is_pairs(&numbers, count) {
        let mut draft = Draft::new(every_second(&numbers, 1), unit, places);
        draft.times = Times::Each(every_second(&numbers, 0));
        draft.row = several(DATA.per_line / 2);
        draft
    } else {
        let mut draft = Draft::new(numbers, unit, places);
        draft.times = Times::Step(step(source, &text, count, &reals)?);
        draft.row = several(DATA.per_line);
        draft
    };
    draft.header_count = Some(count);
    draft.other_counts = other_counts.into_iter().collect();
    draft.header_durations = duration_in_words(&text)
        .into_iter()
        .chain(reals.positive(LENGTH).map(|seconds| StatedDuration {
            seconds,
            line: Some(reals.line_of(LENGTH)),
        }))
        .collect();
    draft.processing = Processing::Raw;
    draft.component = component(&text);
    let station = text[7].text();
    let station = station.split("Station").next().unwrap_or_default();
    let number = first.text();
    let number = number.split_once(':').map_or("", |(_, rest)| rest).trim();
    draft.title = format!("{}; {number}", station.trim());
    Ok(draft)
}

/// Refuses a first row with fewer numbers than the one behind it: it is the last one of the header,
/// which has a line more than it should.
fn full_row(source: &Source<'_>, lines: &Lines<'_>) -> Result<(), GroundMotionError> {
    let mut ahead = lines.clone();
    let (Some(first), Some(second)) = (ahead.next(), ahead.next()) else {
        return Ok(());
    };
    let numbers = |line: Line<'_>| match line.is_text() || line.bytes.contains(&b'\t') {
        true => 0,
        false => line.bytes.len().div_ceil(DATA.width),
    };
    let (found, behind) = (numbers(first), numbers(second));
    if found == 0 || found >= behind {
        return Ok(());
    }
    Err(source.error(
        first.number,
        0,
        format!("the data start with a row of {found} numbers, and {behind} stand in the next one"),
        "the header has lines too many or too few: get the record again",
    ))
}

fn every_second(numbers: &[f64], from: usize) -> Vec<f64> {
    numbers.iter().skip(from).step_by(2).copied().collect()
}

/// Whether twice as many numbers as points stand there, every other of which is a time: the
/// volume's other layout, "SECONDS AND G/10".
fn is_pairs(numbers: &[f64], count: usize) -> bool {
    count >= 2
        && numbers.len() == 2 * count
        && numbers[2..]
            .iter()
            .step_by(2)
            .zip(numbers.iter().step_by(2))
            .all(|(b, a)| b > a)
}

/// `UNITS ARE SECONDS AND G/10`, which real 5 repeats.
fn unit(
    source: &Source<'_>,
    text: &[Line<'_>],
    reals: &HeaderNumbers,
) -> Result<SeriesUnit, GroundMotionError> {
    let stated = text.iter().find_map(|line| {
        let lower = line.lower();
        let rest = lower.split_once("units are")?.1;
        let word = rest.rsplit_once(" and ").map_or(rest, |(_, word)| word);
        let word = word.split_whitespace().next()?;
        Some((line.number, word.trim_end_matches('.').to_owned()))
    });
    let in_words = stated
        .map(|(line, word)| match SeriesUnit::parse(&word) {
            Some(unit) => Ok((line, unit)),
            None => Err(source.unknown_unit(line, &word, REMEDY_UNIT)),
        })
        .transpose()?;
    let in_numbers = match reals.positive(UNIT) {
        Some(0.1) => Some(SeriesUnit::TENTH_G),
        Some(1.0) => Some(SeriesUnit::G),
        _ => None,
    };
    match (in_words, in_numbers) {
        (Some((line, words)), Some(numbers)) if words != numbers => Err(source.error(
            line,
            0,
            format!(
                "the unit is {} here, but {} in line {}",
                words.symbol,
                numbers.symbol,
                reals.line_of(UNIT)
            ),
            REMEDY,
        )),
        (words, numbers) => words.map(|w| w.1).or(numbers).ok_or_else(|| {
            source.error(
                text[0].number,
                0,
                "the header does not state the unit, as in UNITS ARE SECONDS AND G/10",
                REMEDY,
            )
        }),
    }
}

/// `NO. OF POINTS =   9472      DURATION =  47.360`
fn duration_in_words(text: &[Line<'_>]) -> Option<StatedDuration> {
    text.iter().find_map(|line| {
        let seconds = number::stated(&line.lower(), "duration")?.0;
        let line = Some(line.number);
        (seconds > 0.0).then_some(StatedDuration { seconds, line })
    })
}

/// The step: by the rate (real 9); where it is missing, by count and duration, if either counts
/// whole samples a second over all steps or over those between the samples.
fn step(
    source: &Source<'_>,
    text: &[Line<'_>],
    count: usize,
    reals: &HeaderNumbers,
) -> Result<Option<f64>, GroundMotionError> {
    if let Some(rate) = reals.positive(RATE) {
        return Ok(Some(1.0 / rate));
    }
    let stated = duration_in_words(text).map(|d| d.seconds);
    let Some(seconds) = stated.or_else(|| reals.positive(LENGTH)) else {
        return Ok(None);
    };
    let whole = [count as f64, count as f64 - 1.0]
        .map(|steps| steps / seconds)
        .into_iter()
        .find(|rate| (rate - rate.round()).abs() < 1.0e-4 * rate && *rate >= 1.0);
    if whole.is_none() && source.options.time_step.is_none() {
        return Err(source.error(
            reals.line_of(RATE),
            0,
            format!(
                "the header has no rate (real {RATE}), and {count} points in {} s are no whole number of samples a second",
                bound(seconds)
            ),
            "give the step: `time_step = \"0.005 s\"` in [ground_motion] of a case, `--time-step \"0.005 s\"` with `pounding motion`",
        ));
    }
    Ok(whole.map(|rate| 1.0 / rate.round()))
}

/// `L 50 deg`: the letter of line 5 (longitudinal, vertical, transverse; else that of `COMP L1`)
/// and its azimuth in `Azimuth L 50    T 140`.
fn component(text: &[Line<'_>]) -> String {
    let letter = text[4].text().trim().to_owned();
    let letter = if letter.is_empty() {
        let line = text[6].text();
        let word = line.split_whitespace().nth(1).unwrap_or_default();
        word.trim_end_matches(|c: char| c.is_ascii_digit())
            .to_owned()
    } else {
        letter
    };
    let azimuth = text.iter().map(Line::text).find_map(|line| {
        let at = line.to_ascii_lowercase().find("azimuth")? + "azimuth".len();
        let mut words = line.get(at..)?.split_whitespace();
        words.find(|w| w.eq_ignore_ascii_case(&letter))?;
        let word = words.next()?;
        word.parse::<f64>().ok().map(|_| word.to_owned())
    });
    match azimuth {
        Some(azimuth) => format!("{letter} {azimuth} deg"),
        None => letter,
    }
}
