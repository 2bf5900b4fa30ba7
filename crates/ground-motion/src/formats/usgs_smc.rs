//! SMC of the United States Geological Survey: eleven lines of text, 48 integers,
//! 50 reals, comments, then values of ten columns that touch; uncorrected records at even
//! steps, or, where the header has no rate, as pairs of time and value.

use crate::direction::Direction;
use crate::draft::{Draft, DraftPeak, DraftUnit, NamedQuantity, ROW, several};
use crate::error::{GroundMotionError, bound};
use crate::format::Format;
use crate::fortran::Layout;
use crate::number;
use crate::origin::Processing;
use crate::quantity::{Quantity, SeriesUnit};
use crate::recording::Series;
use crate::source::{HeaderNumbers, Source};
use crate::text::{Line, Lines};
use crate::time_column::{Times, mostly_times, part_ties, tied_times};

const TEXT_LINES: usize = 11;
/// Rates from which a header's rate is nonsense, as some are.
const MOST_SAMPLES_A_SECOND: f64 = 1.0e5;
/// Numbers among which times that increase are no chance.
const FEW_NUMBERS: usize = 20;
/// Integers that hold the direction, the number of comment lines and that of values; the real that
/// holds the samples a second.
const FROM_VERTICAL: usize = 13;
const AZIMUTH: usize = 14;
const COMMENTS: usize = 16;
const COUNT: usize = 17;
const RATE: usize = 2;
/// Integer that holds the digits of the values where they are not five.
const DIGITS: usize = 47;
const INTEGERS: Layout = Layout::new(8, 10);
const REALS: Layout = Layout::new(5, 15);
const DATA: Layout = Layout::new(8, 10);
const DATA_OF_EIGHT_DIGITS: Layout = Layout::new(5, 14);

pub(super) static FORMAT: Format = Format {
    name: "usgs_smc",
    title: "SMC of the United States Geological Survey",
    source: "United States Geological Survey",
    recognised_by: "a digit and a title in capitals in the first line, and -32768 as the first integer of line 12",
};

pub(super) fn matches(source: &Source<'_>) -> bool {
    let mut lines = source.lines();
    let (Some(first), Some(second)) = (lines.next(), lines.next()) else {
        return false;
    };
    let kind = first.columns(0, 2);
    let title = first.columns(2, 80);
    let digit = ["0", "1", "2", "3", "4", "5"].contains(&kind.as_str());
    let known = digit
        && title.starts_with(|c: char| c.is_ascii_uppercase())
        && title.chars().take(4).all(|c| c.is_ascii_uppercase());
    // A comment may stand before plain columns, too: the null value settles it.
    let mut null = || {
        lines
            .nth(TEXT_LINES - 2)
            .is_some_and(|l| l.columns(0, 10) == "-32768")
    };
    second.bytes.starts_with(b"*") && (known || (digit || kind == "*") && null())
}

pub(super) fn read(source: &Source<'_>) -> Result<Vec<Series>, GroundMotionError> {
    let mut lines = source.lines();
    let mut text = Vec::with_capacity(TEXT_LINES);
    for _ in 0..TEXT_LINES {
        text.push(source.expect(&mut lines, "the header's text")?);
    }
    let kind = Kind::read(source, text[0], text[6])?;
    let integers = source.header_numbers(&mut lines, INTEGERS, 48)?;
    let reals = source.header_numbers(&mut lines, REALS, 50)?;
    let mut quantities: Vec<NamedQuantity> = kind.quantities.into_iter().collect();
    quantities.extend(comments(source, &mut lines, &integers)?);
    let Some(count) = integers.count(COUNT) else {
        return Err(source.error(
            integers.line_of(COUNT),
            0,
            format!(
                "the number of values (integer {COUNT}) {}",
                integers.shown(COUNT)
            ),
            "the header is damaged: get the record again",
        ));
    };
    let first = lines.number() + 1;
    let layout = match integers.get(DIGITS) {
        Some(8.0) => DATA_OF_EIGHT_DIGITS,
        _ => DATA,
    };
    let numbers = source.block(&mut lines, layout, Some(count), None)?;
    if let Some(line) = lines.text_ahead() {
        return Err(source.second_series(line));
    }
    let rate = known(reals.positive(RATE)).filter(|rate| *rate < MOST_SAMPLES_A_SECOND);
    let places = (reals.line_of(RATE), first, lines.number());
    let unit = DraftUnit::Stated(kind.unit);
    let rows = (places.0, first, layout.per_line);
    let mut draft = if is_film(source, &kind.stage, rate, &numbers, count, rows)? {
        // The agency adds rows of pairs.
        pairs(source, numbers, unit, places, (&integers, count))?
    } else {
        let mut draft = Draft::new(numbers, unit, places);
        draft.times = Times::Step(rate.map(|rate| 1.0 / rate));
        draft.header_count = Some(count);
        draft.row = several(layout.per_line);
        draft
    };
    if let (Some(rate), Times::Each(_)) = (rate, &draft.times) {
        draft.warnings.push(format!(
            "the header says {} samples/s, but every value has its time in the file, which is used",
            bound(rate)
        ));
    }
    draft.warnings.extend(kind.warning);
    if integers.get(18) == Some(1.0) {
        draft.warnings.push(
            "the agency marks the record as one with a problem: read its comments".to_owned(),
        );
    }
    draft.quantities = quantities;
    draft.processing = kind.stage;
    draft.component = component(source, text[5], &integers)?;
    draft.title = format!("{}; {}", text[3].text().trim(), text[5].columns(0, 40));
    match integers.unread(&[2, 3, 4, 5, 6, 7], "the time of the first sample") {
        Some(warning) => draft.warnings.push(warning),
        None => draft.start_time = start_time(&integers),
    }
    draft.corners.0 = known(reals.positive(33));
    let line = (!kind.stale_peak).then_some(text[6]);
    peaks(&mut draft, line, &reals);
    Ok(vec![draft.finish(source)?])
}

/// What the file holds, by its first line and the peak of line 7.
struct Kind {
    unit: SeriesUnit,
    stage: Processing,
    /// Words of line 7, `pk acc`, held against the unit.
    quantities: Option<NamedQuantity>,
    /// Whether line 7 may be that of another series.
    stale_peak: bool,
    warning: Option<String>,
}

impl Kind {
    /// The digit of the first line is the stage, its words are what was recorded: an uncorrected
    /// record may be one of velocity.
    fn read(
        source: &Source<'_>,
        first: Line<'_>,
        peak: Line<'_>,
    ) -> Result<Self, GroundMotionError> {
        let digit = first.bytes.first().copied().unwrap_or(b' ');
        let words = first.lower();
        if digit == b'5' || words.contains("spectr") {
            return Err(GroundMotionError::Unsupported {
                file: source.file.to_owned(),
                what: "the file holds response spectra, no time series".to_owned(),
                remedy: "use the file of type 2 (corrected accelerogram) of the same record",
            });
        }
        let in_words = Quantity::in_words(&words);
        let by_digit = match digit {
            b'2' => Some(Quantity::Acceleration),
            b'3' => Some(Quantity::Velocity),
            b'4' => Some(Quantity::Displacement),
            _ => None,
        };
        let contradicts = |by_digit: &str, in_words: &str| {
            let message = format!(
                "kind {} is {by_digit}, but the words beside it say {in_words}",
                char::from(digit)
            );
            source.error(
                first.number,
                0,
                message,
                "the header contradicts itself: get the record again",
            )
        };
        if let (Some(digit), Some(words)) = (by_digit, in_words)
            && digit != words
        {
            return Err(contradicts(digit.name(), words.name()));
        }
        let stage = match digit {
            b'1' => Processing::Raw,
            b'2'..=b'4' => Processing::Corrected,
            _ => Processing::Unstated,
        };
        match (digit, words.contains("uncorrected")) {
            (b'1', false) if words.contains("corrected") => {
                return Err(contradicts("an uncorrected record", "corrected"));
            }
            (b'2', true) => return Err(contradicts("a corrected record", "uncorrected")),
            _ => {}
        }
        let lower = peak.lower();
        let of_peak = ["pk acc", "pk vel", "pk dis"].into_iter().zip([
            Quantity::Acceleration,
            Quantity::Velocity,
            Quantity::Displacement,
        ]);
        let of_peak = of_peak
            .into_iter()
            .find(|(words, _)| lower.contains(words))
            .map(|(words, quantity)| NamedQuantity {
                quantity,
                text: words.to_owned(),
                line: peak.number,
            });
        let said = in_words.or(by_digit);
        let warning = said.is_none().then(|| {
            let by = match &of_peak {
                Some(named) => format!("by \"{}\" in line {}", named.text, named.line),
                None => "as most files of the format are".to_owned(),
            };
            format!(
                "the first line does not say what the values are: taken by the format's units, {by}"
            )
        });
        let quantity = said.or(of_peak.as_ref().map(|named| named.quantity));
        // A velocity that was made of an acceleration may keep the peak of that.
        let integrated = !matches!(quantity, Some(Quantity::Acceleration) | None);
        let stale = integrated && of_peak.as_ref().map(|named| named.quantity) != quantity;
        Ok(Self {
            unit: match quantity {
                Some(Quantity::Velocity) => SeriesUnit::CM_S,
                Some(Quantity::Displacement) => SeriesUnit::CM,
                Some(Quantity::Acceleration) | None => SeriesUnit::CM_S2,
            },
            stage,
            quantities: of_peak.filter(|_| !stale),
            stale_peak: stale,
            warning,
        })
    }
}

/// Passes over the comments, whose lines start with a bar, as many as integer 16 says or not.
/// Returns the quantity of a factor such as `4.7E-04 cm/s/s/count` in them.
fn comments(
    source: &Source<'_>,
    lines: &mut Lines<'_>,
    integers: &HeaderNumbers,
) -> Result<Option<NamedQuantity>, GroundMotionError> {
    let stated = integers.count(COMMENTS).unwrap_or(0);
    let mut found = 0;
    let mut factor = None;
    while let Some(line) = lines.peek() {
        let barred = line.bytes.trim_ascii_start().starts_with(b"|");
        // Some programs leave out the bar, never before a row of numbers.
        if !(barred || found < stated && (line.is_text() || line.is_blank())) {
            break;
        }
        lines.next();
        found += 1;
        factor = factor.or_else(|| factor_in(line));
    }
    if found < stated && lines.peek().is_none() {
        source.expect(lines, "a comment line")?;
    }
    if found != stated {
        source.warn(&format!(
            "line {}: the number of comment lines (integer {COMMENTS}) {}, but {found} stand in the file",
            integers.line_of(COMMENTS),
            integers.shown(COMMENTS)
        ));
    }
    Ok(factor)
}

/// The unit of `re-scaled using the factor 4.67E-04 cm/s/s/count`.
fn factor_in(line: Line<'_>) -> Option<NamedQuantity> {
    let lower = line.lower();
    let before = lower.split_once("/count")?.0;
    let unit = SeriesUnit::parse(before.rsplit(' ').next()?)?;
    let text = line.text();
    Some(NamedQuantity {
        quantity: unit.quantity,
        text: text.trim_start_matches('|').trim().to_owned(),
        line: line.number,
    })
}

/// Whether the numbers are pairs of time and value, as of digitised film: times are known by
/// their order, whatever the header says. `rows`: lines of the rate and of the first row, numbers
/// a row.
///
/// # Errors
/// Pairs of which a time goes back; an uncorrected record without a rate, of which every other
/// number is no time.
fn is_film(
    source: &Source<'_>,
    stage: &Processing,
    rate: Option<f64>,
    numbers: &[f64],
    count: usize,
    (line, first, per_line): (usize, usize, usize),
) -> Result<bool, GroundMotionError> {
    if *stage == Processing::Corrected {
        return Ok(false);
    }
    let unrated = *stage == Processing::Raw && rate.is_none();
    let used = numbers.len().min(count);
    let Some((value, before, time)) = times_go_back(numbers, count) else {
        return Ok(unrated || used >= FEW_NUMBERS && numbers[0] >= 0.0 && increases(numbers, used));
    };
    if mostly_times(&numbers[..used], 2) {
        return Err(source.error(
            first + 2 * (value - 1) / per_line,
            0,
            format!(
                "nearly every other number is a time, but that of value {value}, {}, is not after {}: a row is missing, doubled or out of its place, here or before",
                bound(time),
                bound(before)
            ),
            "the file is damaged: get the record again; no time step mends it",
        ));
    }
    if !unrated || source.options.time_step.is_some() {
        return Ok(false);
    }
    Err(source.error(
        line,
        0,
        format!(
            "the header has no sampling rate (real {RATE}), and every other number is no time: {} of value {value} is not after {}",
            bound(time),
            bound(before)
        ),
        "give the step: `time_step = \"0.005 s\"` in [ground_motion] of a case, `--time-step \"0.005 s\"` with `pounding motion`; or get the record again",
    ))
}

/// Where every other number does not go forward, as times do: value (from 1), the number before
/// it and itself.
fn times_go_back(numbers: &[f64], count: usize) -> Option<(usize, f64, f64)> {
    let used = &numbers[..numbers.len().min(count)];
    let mut times = used.iter().step_by(2).copied();
    let mut last = times.next()?;
    for (i, time) in times.enumerate() {
        if time < last {
            return Some((i + 2, last, time));
        }
        last = time;
    }
    None
}

/// Whether the last of every other number lies above the first.
fn increases(numbers: &[f64], used: usize) -> bool {
    let last = (used - 1) / 2 * 2;
    numbers[last] > numbers[0]
}

/// Pairs of time and value. Integer 17, the count, counts numbers, two a sample, or samples: what
/// stands in the file tells.
fn pairs(
    source: &Source<'_>,
    numbers: Vec<f64>,
    unit: DraftUnit,
    places: (usize, usize, usize),
    (integers, count): (&HeaderNumbers, usize),
) -> Result<Draft, GroundMotionError> {
    let holds = |stated: usize| (stated..=stated + ROW).contains(&numbers.len());
    let samples = match (holds(count), holds(2 * count)) {
        (true, _) if count.is_multiple_of(2) => count / 2,
        (false, true) => count,
        // Short, which is said of samples.
        _ if numbers.len() < count && count.is_multiple_of(2) => count / 2,
        _ if source.options.lenient => numbers.len().min(count) / 2,
        _ => {
            return Err(source.error(
                integers.line_of(COUNT),
                0,
                format!(
                    "the header says {count} values (integer {COUNT}), which in pairs of time and value are {count} or {} numbers, but {} stand in the file",
                    2 * count,
                    numbers.len()
                ),
                "the file is damaged or truncated, or its count is wrong: get it again, or set `lenient = true` to use what is there",
            ));
        }
    };
    let mut times: Vec<f64> = numbers.chunks_exact(2).map(|p| p[0]).collect();
    let values = numbers.chunks_exact(2).map(|p| p[1]).collect();
    // Behind the count a last row may hold anything.
    let used = times.len().min(samples);
    let tied = part_ties(&mut times[..used], digit);
    let mut draft = Draft::new(values, unit, places);
    draft.times = Times::Each(times);
    draft.header_count = Some(samples);
    if samples < count {
        draft.counted = format!(" ({count} numbers in integer {COUNT}, a time and a value each)");
    }
    if tied > 0 {
        draft.warnings.push(tied_times(tied));
    }
    Ok(draft)
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

/// The value unless it is the 1.7E+38 that stands for unknown.
fn known(value: Option<f64>) -> Option<f64> {
    value.filter(|v| v.abs() < 1.0e37)
}

/// `component=  133` in the text, or the integers, which say the same: 90 from vertical is
/// horizontal.
fn component(
    source: &Source<'_>,
    line: Line<'_>,
    integers: &HeaderNumbers,
) -> Result<String, GroundMotionError> {
    let text = line.text();
    let printed = text
        .rsplit_once("component=")
        .map(|(_, word)| word.trim().to_owned())
        .filter(|w| !w.is_empty());
    let (vertical, azimuth) = (integers.get(FROM_VERTICAL), integers.get(AZIMUTH));
    let numbers = match (vertical, azimuth) {
        (Some(0.0), _) => Some("Up".to_owned()),
        (Some(180.0), _) => Some("Down".to_owned()),
        (Some(90.0), Some(azimuth)) => Some(azimuth.to_string()),
        _ => None,
    };
    if let (Some(words), Some(numbers)) = (&printed, &numbers)
        && Direction::differ(words, numbers)
    {
        let message = format!(
            "the component is \"{words}\" here, but {numbers} by integers {FROM_VERTICAL} and {AZIMUTH} in line {}",
            integers.line_of(AZIMUTH)
        );
        source.contradiction(line.number, message)?;
    }
    let azimuth = azimuth.map(|azimuth| azimuth.to_string());
    Ok(printed.or(numbers).or(azimuth).unwrap_or_default())
}

/// The largest and the least value with their times (reals 29 to 32), and `pk acc = -263.5`.
fn peaks(draft: &mut Draft, line: Option<Line<'_>>, reals: &HeaderNumbers) {
    let of = |time: usize, value: usize, negative: bool| {
        let stated = known(reals.get(value)).filter(|v| (*v < 0.0) == negative)?;
        Some(DraftPeak {
            // Seven digits in the header, five in the samples.
            value: (stated, 1.0e-4 * stated.abs()),
            time: known(reals.get(time)).map(|t| (t, 1.0e-4)),
            unit: None,
            shift: 0.0,
            line: Some(reals.line_of(value)),
            of_sign: false,
        })
    };
    let mut both: Vec<DraftPeak> = of(29, 30, false)
        .into_iter()
        .chain(of(31, 32, true))
        .collect();
    both.sort_by(|a, b| a.value.0.abs().total_cmp(&b.value.0.abs()));
    draft.peak = both.pop();
    draft.other_peaks = both
        .into_iter()
        .map(|lesser| DraftPeak {
            of_sign: true,
            ..lesser
        })
        .collect();
    let Some(line) = line else {
        return;
    };
    let text = line.text();
    let words = text.split_once("pk ").and_then(|(_, rest)| {
        let (_, value) = rest.split_once('=')?;
        number::stated(value, "")
    });
    draft.other_peaks.extend(words.map(|value| DraftPeak {
        value,
        time: None,
        unit: None,
        shift: 0.0,
        line: Some(line.number),
        of_sign: false,
    }));
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
