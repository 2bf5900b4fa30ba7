//! SMC of the United States Geological Survey: eleven lines of text, 48 integers,
//! 50 reals, comments, then values of ten columns that touch; uncorrected records at even
//! steps, or, where the header has no rate, as pairs of time and value.

use crate::accelerogram::Processing;
use crate::draft::{Draft, DraftPeak, DraftUnit, Times};
use crate::error::{GroundMotionError, bound};
use crate::formats::Format;
use crate::fortran::Layout;
use crate::quantity::SeriesUnit;
use crate::recording::Series;
use crate::source::{HeaderNumbers, Source};
use crate::text::Line;
use crate::time_column::{part_ties, tied_times};

const TEXT_LINES: usize = 11;
/// Rates from which a header's rate is nonsense, as some are.
const MOST_SAMPLES_A_SECOND: f64 = 1.0e5;
/// Numbers among which times that increase are no chance.
const FEW_NUMBERS: usize = 20;
const INTEGERS: Layout = Layout::new(8, 10);
const REALS: Layout = Layout::new(5, 15);
const DATA: Layout = Layout::new(8, 10);

pub(super) static FORMAT: Format = Format {
    name: "usgs_smc",
    title: "SMC of the United States Geological Survey",
    source: "United States Geological Survey",
    recognised_by: "a digit and a title in capitals in the first line, and -32768 as the first integer of line 12",
    matches,
    read,
};

fn matches(source: &Source<'_>) -> bool {
    let mut lines = source.lines();
    let (Some(first), Some(second)) = (lines.next(), lines.next()) else {
        return false;
    };
    let kind = first.columns(0, 2);
    let title = first.columns(2, 80);
    let known = ["0", "1", "2", "3", "4", "5"].contains(&kind.as_str())
        && title.starts_with(|c: char| c.is_ascii_uppercase())
        && title.chars().take(4).all(|c| c.is_ascii_uppercase());
    // A comment may stand before plain columns, too: the null value settles it.
    let mut null = || {
        lines
            .nth(TEXT_LINES - 2)
            .is_some_and(|l| l.columns(0, 10) == "-32768")
    };
    second.bytes.starts_with(b"*") && (known || kind == "*" && null())
}

fn read(source: &Source<'_>) -> Result<Vec<Series>, GroundMotionError> {
    let mut lines = source.lines();
    let mut text = Vec::with_capacity(TEXT_LINES);
    for _ in 0..TEXT_LINES {
        text.push(source.expect(&mut lines, "the header's text")?);
    }
    let unit = unit(source, text[0])?;
    let integers = source.header_numbers(&mut lines, INTEGERS, 48)?;
    let reals = source.header_numbers(&mut lines, REALS, 50)?;
    for _ in 0..integers.count(16).unwrap_or(0) {
        source.expect(&mut lines, "a comment line")?;
    }
    let Some(count) = integers.count(17) else {
        return Err(source.error(
            integers.first + 2,
            0,
            "the header has no number of values (integer 17)",
            "the header is damaged: get the record again",
        ));
    };
    let first = lines.number() + 1;
    let numbers = source.block(&mut lines, DATA, Some(count), None)?;
    let kind = text[0].bytes.first();
    let corrected = matches!(kind, Some(b'2'..=b'4'));
    let rate = known(reals.positive(2)).filter(|rate| *rate < MOST_SAMPLES_A_SECOND);
    let places = (reals.line_of(2), first, lines.number());
    // Film is digitised at uneven times, printed before their values; uncorrected records
    // at even steps state the rate. Times are known by their order, whatever the header says.
    let unrated = kind == Some(&b'1') && rate.is_none();
    let timed = !corrected && (unrated || times_increase(&numbers, count));
    let mut draft = if timed {
        pairs(numbers, unit, places, count)
    } else {
        let mut draft = Draft::new(numbers, unit, places);
        draft.times = Times::Step(rate.map(|rate| 1.0 / rate));
        draft.header_count = Some(count);
        draft
    };
    if let (true, Some(rate), Times::Each(_)) = (timed, rate, &draft.times) {
        draft.warnings.push(format!(
            "the header says {} samples/s, but every value has its time in the file, which is used",
            bound(rate)
        ));
    }
    if integers.get(18) == Some(1.0) {
        draft.warnings.push(
            "the agency marks the record as one with a problem: read its comments".to_owned(),
        );
    }
    draft.processing = match text[0].bytes.first() {
        Some(b'1') => Processing::Raw,
        Some(b'2'..=b'4') => Processing::Corrected,
        _ => Processing::Unstated,
    };
    draft.component = component(text[5], integers.get(13), integers.get(14));
    draft.title = format!("{}; {}", text[3].text().trim(), text[5].columns(0, 40));
    draft.start_time = start_time(&integers);
    draft.corners.0 = known(reals.positive(33));
    draft.peak = peak(known(reals.get(29)), known(reals.get(30)), false)
        .into_iter()
        .chain(peak(known(reals.get(31)), known(reals.get(32)), true))
        .max_by(|a, b| a.value.0.abs().total_cmp(&b.value.0.abs()));
    Ok(vec![draft.finish(source)?])
}

/// Pairs of time and value; integer 17, `count`, counts numbers, two per sample.
fn pairs(numbers: Vec<f64>, unit: DraftUnit, places: (usize, usize, usize), count: usize) -> Draft {
    let mut times: Vec<f64> = numbers.chunks_exact(2).map(|p| p[0]).collect();
    let samples = numbers.chunks_exact(2).map(|p| p[1]).collect();
    // Behind the count a last row may hold anything.
    let used = times.len().min(count / 2);
    let tied = part_ties(&mut times[..used], digit);
    let mut draft = Draft::new(samples, unit, places);
    draft.times = Times::Each(times);
    draft.header_count = Some(count / 2);
    if tied > 0 {
        draft.warnings.push(tied_times(tied));
    }
    draft
}

/// One unit of the last of the five digits that a time is printed with.
fn digit(time: f64) -> f64 {
    let exponent = if time > 0.0 {
        libm::log10(time).floor()
    } else {
        0.0
    };
    libm::pow(10.0, exponent - 4.0)
}

/// Whether every other number is a time: they go forward from the start to the end, as no
/// ground motion does.
fn times_increase(numbers: &[f64], count: usize) -> bool {
    let used = &numbers[..numbers.len().min(count)];
    let mut times = used.iter().step_by(2);
    let Some(first) = times.next() else {
        return false;
    };
    let mut last = *first;
    for time in times {
        if *time < last {
            return false;
        }
        last = *time;
    }
    used.len() >= FEW_NUMBERS && last > *first && *first >= 0.0
}

/// The value unless it is the 1.7E+38 that stands for unknown.
fn known(value: Option<f64>) -> Option<f64> {
    value.filter(|v| v.abs() < 1.0e37)
}

fn unit(source: &Source<'_>, first: Line<'_>) -> Result<DraftUnit, GroundMotionError> {
    Ok(DraftUnit::Stated(match first.bytes.first() {
        Some(b'3') => SeriesUnit::CM_S,
        Some(b'4') => SeriesUnit::CM,
        Some(b'5') => {
            return Err(GroundMotionError::Unsupported {
                file: source.file.to_owned(),
                what: "the file holds response spectra, no time series".to_owned(),
                remedy: "use the file of type 2 (corrected accelerogram) of the same record",
            });
        }
        _ => SeriesUnit::CM_S2,
    }))
}

/// `component=  133` in the text, or the integers: 90 from vertical is horizontal.
fn component(line: Line<'_>, vertical: Option<f64>, azimuth: Option<f64>) -> String {
    let text = line.text();
    let printed = text
        .rsplit_once("component=")
        .map(|(_, word)| word.trim().to_owned())
        .filter(|w| !w.is_empty());
    printed.unwrap_or_else(|| match (vertical, azimuth) {
        (Some(0.0), _) => "Up".to_owned(),
        (Some(180.0), _) => "Down".to_owned(),
        (_, Some(azimuth)) => format!("{azimuth}"),
        _ => String::new(),
    })
}

/// Year, day of the year and time of day of the first sample, where the header has them all.
fn start_time(integers: &HeaderNumbers) -> String {
    let whole = |index| integers.get(index).filter(|n| *n >= 0.0);
    let (Some(year), Some(day), Some(hour), Some(minute)) = (
        integers.positive(2),
        integers.positive(3),
        whole(4),
        whole(5),
    ) else {
        return String::new();
    };
    let second = whole(6).unwrap_or(0.0) + whole(7).unwrap_or(0.0) * 1.0e-3;
    format!("{year} day {day} {hour:02}:{minute:02}:{second:06.3}")
}

fn peak(time: Option<f64>, value: Option<f64>, negative: bool) -> Option<DraftPeak> {
    let value = value.filter(|v| (*v < 0.0) == negative)?;
    Some(DraftPeak {
        // Seven digits in the header, five in the samples.
        value: (value, 1.0e-4 * value.abs()),
        time: time.map(|t| (t, 1.0e-4)),
        unit: None,
        shift: 0.0,
        line: None,
    })
}
