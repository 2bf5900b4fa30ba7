//! GeoNet (GNS Science, New Zealand) Volume 1 and Volume 2: 26 header lines for
//! each component, then values of eight columns without labels.

use crate::direction::Direction;
use crate::draft::{Draft, DraftPeak, DraftUnit, StatedDuration};
use crate::error::GroundMotionError;
use crate::format::Format;
use crate::fortran::Layout;
use crate::number;
use crate::origin::Processing;
use crate::quantity::{Quantity, SeriesUnit};
use crate::recording::Series;
use crate::source::{HeaderNumbers, Source};
use crate::start_times::later;
use crate::text::{Line, Lines};
use crate::time_column::Times;
use crate::volume::unit_of_number;

const TEXT_LINES: usize = 16;
const NUMBERS: Layout = Layout::new(10, 8);
/// Integer that holds the azimuth of the component (degrees).
const AZIMUTH: usize = 28;

/// The header of a component.
struct Header<'a> {
    text: Vec<Line<'a>>,
    integers: HeaderNumbers,
    reals: HeaderNumbers,
}

impl Header<'_> {
    fn is_corrected(&self) -> bool {
        !self.text[0].lower().starts_with("uncorrected")
    }
}

pub(super) static FORMAT: Format = Format {
    name: "geo_net",
    title: "GeoNet V1A and V2A",
    source: "GNS Science, New Zealand",
    recognised_by: "GNS Science and accelerogram in the first line",
};

pub(super) fn matches(source: &Source<'_>) -> bool {
    is_first(&source.first_line())
}

fn is_first(lower: &str) -> bool {
    lower.contains("gns science") && lower.contains("accelerogram")
}

pub(super) fn read(source: &Source<'_>) -> Result<Vec<Series>, GroundMotionError> {
    let mut lines = source.lines();
    let mut series: Vec<Series> = Vec::new();
    let mut channel = 0;
    while lines.clone().any(|l| !l.is_blank()) {
        let header = header(source, &mut lines)?;
        channel += 1;
        let first = series.len();
        let corrected = header.is_corrected();
        for (quantity, unit, count) in blocks(source, &header, corrected)? {
            let mut draft = block(source, &mut lines, &header, quantity, count)?;
            draft.unit = unit;
            draft.channel = channel;
            draft.processing = if corrected {
                Processing::Corrected
            } else {
                Processing::Raw
            };
            series.push(draft.finish(source)?);
        }
        if let [acceleration, velocity, displacement] = &mut series[first..] {
            acceleration.initial = Some((velocity.samples[0], displacement.samples[0]));
        }
    }
    Ok(series)
}

fn header<'a>(source: &Source<'a>, lines: &mut Lines<'a>) -> Result<Header<'a>, GroundMotionError> {
    while lines.peek().is_some_and(|l| l.is_blank()) {
        lines.next();
    }
    let mut text = Vec::with_capacity(TEXT_LINES);
    for i in 0..TEXT_LINES {
        let line = source.expect(lines, "the header of a component")?;
        if i == 0 && !is_first(&line.lower()) {
            return Err(source.error(
                line.number,
                0,
                "the header of a component must start here: more values than the header says",
                "the file is damaged: get it again",
            ));
        }
        text.push(line);
    }
    Ok(Header {
        text,
        integers: source.header_numbers(lines, NUMBERS, 40)?,
        reals: source.header_numbers(lines, NUMBERS, 60)?,
    })
}

/// Quantity, unit and count of each block.
fn blocks(
    source: &Source<'_>,
    header: &Header<'_>,
    corrected: bool,
) -> Result<Vec<(Quantity, DraftUnit, usize)>, GroundMotionError> {
    let none = || {
        source.error(
            header.integers.first + 3,
            0,
            "the header has no number of samples",
            "the header is damaged: get the record again",
        )
    };
    if !corrected {
        let unit = raw_unit(source, header)?;
        let count = header.integers.count(31).ok_or_else(none)?;
        return Ok(vec![(Quantity::Acceleration, unit, count)]);
    }
    let all = [
        (Quantity::Acceleration, SeriesUnit::MM_S2, 34),
        (Quantity::Velocity, SeriesUnit::MM_S, 35),
        (Quantity::Displacement, SeriesUnit::MM, 36),
    ];
    let found: Vec<_> = all
        .into_iter()
        .filter_map(|(q, unit, k)| Some((q, DraftUnit::Stated(unit), header.integers.count(k)?)))
        .collect();
    if found.is_empty() {
        Err(none())
    } else {
        Ok(found)
    }
}

/// `Raw readings in units of 1.00 mm/s/s`; without, the unit is not known.
fn raw_unit(source: &Source<'_>, header: &Header<'_>) -> Result<DraftUnit, GroundMotionError> {
    let line = header.text[10];
    let lower = line.lower();
    let Some((_, rest)) = lower.split_once("units of") else {
        return Ok(DraftUnit::Unstated);
    };
    let mut words = rest.split_whitespace();
    let each = words.next().and_then(|w| number::parse(w.as_bytes()).ok());
    let unit = words.next().and_then(SeriesUnit::parse);
    match (each, unit) {
        (Some(1.0), Some(unit)) => Ok(DraftUnit::Stated(unit)),
        (Some(each), Some(unit)) if each > 0.0 => Ok(DraftUnit::counts_of(unit, each)),
        _ => Err(source.error(
            line.number,
            0,
            "the unit of the readings is not understood",
            "a line like \"Raw readings in units of 1.00 mm/s/s\" must be here",
        )),
    }
}

/// Start of the recorder's buffer: integers 9, 10, 19, 20 and 39 are year, month, day, hour and
/// minute, integer 40 thousandths of a second. The line of text has the time of the earthquake.
fn start_of_buffer(integers: &HeaderNumbers) -> Option<String> {
    let whole = |index, least: f64, most: f64| {
        let number = integers.get(index)?;
        let inside = number.fract() == 0.0 && (least..=most).contains(&number);
        inside.then_some(number)
    };
    let (year, month) = (whole(9, 1900.0, 2200.0)?, whole(10, 1.0, 12.0)?);
    let (day, hour) = (whole(19, 1.0, 31.0)?, whole(20, 0.0, 23.0)?);
    let (minute, thousandths) = (whole(39, 0.0, 59.0)?, whole(40, 0.0, 1.0e7)?);
    later(
        &format!("{year}-{month:02}-{day:02} {hour:02}:{minute:02}:00.000 UT"),
        thousandths / 1000.0,
    )
}

/// The peak of a block in the real numbers: of a Volume 1 real 31 and its time in the next one, of a
/// Volume 2 reals 36, 41 and 46.
fn peak_in_numbers(header: &Header<'_>, quantity: Quantity, pad: f64) -> Option<DraftPeak> {
    let corrected = header.is_corrected();
    let (index, unit) = match quantity {
        Quantity::Acceleration if !corrected => (31, SeriesUnit::MM_S2),
        Quantity::Acceleration => (36, SeriesUnit::MM_S2),
        Quantity::Velocity => (41, SeriesUnit::MM_S),
        Quantity::Displacement => (46, SeriesUnit::MM),
    };
    Some(DraftPeak {
        value: header.reals.printed(index)?,
        time: header.reals.printed(index + 1),
        unit: Some(unit),
        shift: pad,
        line: Some(header.reals.line_of(index)),
        of_sign: false,
    })
}

fn block(
    source: &Source<'_>,
    lines: &mut Lines<'_>,
    header: &Header<'_>,
    quantity: Quantity,
    count: usize,
) -> Result<Draft, GroundMotionError> {
    let first = lines.number() + 1;
    let samples = source.block(lines, NUMBERS, Some(count), Some(count))?;
    // The unit is set by the caller.
    let mut draft = Draft::new(
        samples,
        DraftUnit::Unstated,
        (header.reals.first + 2, first, lines.number()),
    );
    draft.header_count = Some(count);
    // "Number of points  5800    Duration 115.98 sec", pads included.
    let in_words = header.text[9].lower();
    let points = number::stated(&in_words, "number of points").map(|n| n.0);
    let points = points.filter(|n| n.fract() == 0.0 && (1.0..1.0e9).contains(n));
    draft.other_counts = points
        .map(|n| (header.text[9].number, n as usize))
        .into_iter()
        .collect();
    let stated = number::stated(&in_words, "duration").map(|n| n.0);
    draft.header_durations = stated
        .filter(|d| *d > 0.0)
        .map(|seconds| StatedDuration {
            seconds,
            line: Some(header.text[9].number),
        })
        .into_iter()
        .collect();
    let step = header.reals.positive(26);
    draft.times = Times::Step(step);
    let component = header.text[12].text();
    let mut words = component.split_whitespace().peekable();
    words.next_if(|word| word.eq_ignore_ascii_case("component"));
    draft.component = words.next().unwrap_or_default().to_owned();
    let in_numbers = header.integers.get(AZIMUTH);
    if let Some(other) = in_numbers.and_then(|n| Direction::contradicts(&draft.component, n)) {
        source.contradiction(
            header.text[12].number,
            format!(
                "the component is \"{}\" here, but {other} by integer {AZIMUTH} in line {}",
                draft.component,
                header.integers.line_of(AZIMUTH)
            ),
        )?;
    }
    draft.title = format!(
        "{}; {}",
        header.text[1].columns(0, 14),
        header.text[2].text().trim()
    );
    // Text counts times from the end of the leading pad.
    let pad = header.integers.count(32).unwrap_or(0) as f64 * step.unwrap_or(0.0);
    let start = [9, 10, 19, 20, 39, 40];
    if let Some(warning) = header
        .integers
        .unread(&start, "the time of the first sample")
    {
        source.warn(&warning);
    }
    draft.start_time = start_of_buffer(&header.integers)
        .and_then(|start| later(&start, -pad))
        .unwrap_or_default();
    let lines = header.text[13..].iter().map(|l| (l.number, l.lower()));
    let of_quantity = |l: &(usize, String)| l.1.trim_start().starts_with(quantity.name());
    draft.peak = lines.into_iter().find(of_quantity).and_then(|(line, l)| {
        Some(DraftPeak {
            value: source.header_number(line, "the peak", number::number_behind(&l, "peak")?)?,
            time: number::stated(&l, " at "),
            unit: unit_of_number(&l, "peak"),
            shift: pad,
            line: Some(line),
            of_sign: false,
        })
    });
    draft.other_peaks = peak_in_numbers(header, quantity, pad).into_iter().collect();
    let eleven = header.text[10].lower();
    let printed = match number::number_behind(&eleven, "intervals of") {
        Some(text) => source.header_number(header.text[10].number, "the step", text),
        None => number::after(&eleven, "intervals of").or_else(|| number::after(&eleven, " at ")),
    };
    if let (Some(step), Some((text, digit))) = (step, printed)
        && eleven.contains("interval")
        && (step - text).abs() > digit
    {
        source.contradiction(
            header.text[10].number,
            format!("the step is {text} s here, but {step} s in the numbers of the header"),
        )?;
    }
    if pad > 0.0 && quantity == Quantity::Acceleration {
        draft.warnings.push(format!(
            "the agency put {pad:.3} s of zeros before the record"
        ));
    }
    Ok(draft)
}
