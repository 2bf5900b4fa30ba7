//! COSMOS 1.20: blocks that announce their count and their Fortran format; raw counts and
//! volts by the sensitivities of recorder and sensor in the header.

use crate::direction::Direction;
use crate::draft::{Draft, DraftPeak, DraftUnit, NamedQuantity, StatedDuration, several};
use crate::error::{GroundMotionError, bound};
use crate::format::Format;
use crate::fortran::Layout;
use crate::number;
use crate::origin::Processing;
use crate::quantity::{Quantity, SeriesUnit};
use crate::recording::Series;
use crate::source::{HeaderNumbers, Source};
use crate::text::{Line, Lines};
use crate::time_column::Times;
use crate::volume::unit_of_number;

const TEXT_LINES: usize = 13;
/// Numbers that a header block may have: the format defines 100.
const MOST_NUMBERS: usize = 1000;
/// Counts before and behind one, with which it is compared; times the largest step between them from which on it is
/// no count of the record, and a step that instruments at rest have.
const AROUND: usize = 20;
const APART: f64 = 4.0;
const STEP_AT_REST: f64 = 10.0;
const REMEDY: &str = "the header is not that of COSMOS 1.20: get the record again";

pub(super) static FORMAT: Format = Format {
    name: "cosmos",
    title: "COSMOS 1.20: V0c, V1c and V2c",
    source: "Consortium of Organizations for Strong-Motion Observation Systems",
    recognised_by: "(Format v in the first line",
};

pub(super) fn matches(source: &Source<'_>) -> bool {
    is_first(&source.first_line())
}

fn is_first(lower: &str) -> bool {
    lower.contains("(format v")
}

pub(super) fn read(source: &Source<'_>) -> Result<Vec<Series>, GroundMotionError> {
    let mut lines = source.lines();
    let mut series = Vec::new();
    while let Some(first) = lines.next() {
        if is_first(&first.lower()) {
            let mut draft = channel(source, &mut lines, first)?;
            draft.channel = series.len() + 1;
            series.push(draft.finish(source)?);
        } else if !(first.is_blank() || ends_channel(first)) {
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

/// `End-of-data for Chan  1`, or `/&` with words behind it.
fn ends_channel(line: Line<'_>) -> bool {
    line.lower().starts_with("end-of-data") || line.bytes.trim_ascii_start().starts_with(b"/&")
}

/// Refuses samples that are the value of which the header says that it stands for unknown, as
/// `Values used when parameter or data value is unknown/unspecified:   -999, -999.00`. Counts
/// are whole numbers, of which it is one: among them it is refused where it does not follow its neighbours.
fn without_unknown(
    source: &Source<'_>,
    text: &[Line<'_>],
    draft: &Draft,
    layout: Layout,
) -> Result<(), GroundMotionError> {
    let declared = text.iter().find_map(|line| {
        let lower = line.lower();
        let (_, values) = lower.split_once("unknown/unspecified:")?;
        Some((
            line.number,
            number::first_in(values.split(',').next_back()?)?.0,
        ))
    });
    let Some((line, value)) = declared else {
        return Ok(());
    };
    let count = draft.header_count.unwrap_or(usize::MAX);
    let used = &draft.samples[..draft.samples.len().min(count)];
    let is_stated = matches!(draft.unit, DraftUnit::Stated(_));
    // Of those that follow one another the first, as a record may be full of them.
    let is_first = |at: &usize| used[*at] == value && (*at == 0 || used[*at - 1] != value);
    let mut marked = (0..used.len()).filter(is_first);
    let Some(at) = marked.find(|at| is_stated || is_apart(used, *at)) else {
        return Ok(());
    };
    let message = format!(
        "sample {} is {value}, by which line {line} marks a value that is unknown",
        at + 1
    );
    if source.options.lenient {
        source.warn(&message);
        return Ok(());
    }
    Err(source.error(
        draft.lines.1 + at / layout.per_line,
        at % layout.per_line * layout.width,
        message,
        "the record has gaps: get it again, or set `lenient = true` to use the value as it is",
    ))
}

/// Whether a count lies farther from both neighbours than any step of the record around it, several times; those equal
/// to it are none of the record either.
fn is_apart(counts: &[f64], at: usize) -> bool {
    let value = counts[at];
    let other = |c: &&f64| **c != value;
    let before: Vec<f64> = counts[..at]
        .iter()
        .rev()
        .filter(other)
        .take(AROUND)
        .copied()
        .collect();
    let behind: Vec<f64> = counts[at..]
        .iter()
        .filter(other)
        .take(AROUND)
        .copied()
        .collect();
    let steps = [&before, &behind]
        .into_iter()
        .flat_map(|side| side.windows(2));
    let largest = steps.map(|w| (w[1] - w[0]).abs()).fold(0.0, f64::max);
    let neighbours = [before.first(), behind.first()];
    let mut jumps = neighbours.into_iter().flatten().map(|c| (c - value).abs());
    before.len() + behind.len() >= AROUND
        && jumps.all(|jump| jump > APART * largest.max(STEP_AT_REST))
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
    let unit = unit(source, announcement, &data, (&integers, &reals))?;
    let mut draft = Draft::new(
        samples,
        unit,
        (reals.first, announcement.number + 1, lines.number()),
    );
    draft.header_count = Some(expected);
    draft.row = several(layout.per_line);
    without_unknown(source, &text, &draft, layout)?;
    draft.times = Times::Step(step(source, &integers, &reals)?);
    draft.processing = match stage_agrees(source, first, &integers)? {
        Some(2.0) => Processing::Corrected,
        Some(s) if s < 2.0 => Processing::Raw,
        _ => Processing::Unstated,
    };
    let before = |line: Line<'_>, words: &str| {
        let at = line.lower().find(words).unwrap_or(0);
        NamedQuantity::of(line.number, &line.columns(0, at))
    };
    draft.quantities = before(first, "(format")
        .into_iter()
        .chain(before(announcement, "units="))
        .chain(by_sensor(&integers))
        .collect();
    draft.component = component(source, &text, &integers)?;
    draft.title = format!(
        "{}; {}",
        text[1].text().trim(),
        text[4 % text.len()].columns(40, 80)
    );
    draft.corners = (reals.positive(54), reals.positive(57));
    draft.start_time = text
        .iter()
        .map(Line::text)
        .find_map(|l| {
            let at = l.to_ascii_lowercase().find("start time:")? + "start time:".len();
            Some(l.get(at..)?.trim().to_owned())
        })
        .unwrap_or_default();
    draft.peak = reals.get(64).map(|value| DraftPeak {
        value: (value, 5.0e-5 * value.abs()),
        time: reals.get(65).map(|t| (t, 1.0e-3)),
        unit: None,
        shift: 0.0,
        line: None,
        of_sign: false,
    });
    let counts = matches!(
        draft.unit,
        DraftUnit::Scaled { of: "counts", .. } | DraftUnit::Counts
    );
    draft.other_peaks = peak_in_words(source, &text, counts).into_iter().collect();
    durations(&mut draft, &text, &reals, announcement);
    Ok(draft)
}

/// Reals that hold the step of the series in this file (ms) and that of the raw record (s).
const STEP: usize = 62;
const RAW_STEP: usize = 34;

/// The step (s): in a file of raw values both steps are that of the series.
fn step(
    source: &Source<'_>,
    integers: &HeaderNumbers,
    reals: &HeaderNumbers,
) -> Result<Option<f64>, GroundMotionError> {
    let own = reals.positive(STEP).map(|ms| ms / 1000.0);
    let raw = reals
        .positive(RAW_STEP)
        .filter(|_| integers.get(1) == Some(0.0));
    if let (Some(own), Some(raw)) = (own, raw)
        && (own - raw).abs() > 1.0e-3 * own
        && !source.options.lenient
    {
        return Err(source.error(
            reals.line_of(STEP),
            0,
            format!(
                "the step of the raw values is {own} s here, but {raw} s in line {}",
                reals.line_of(RAW_STEP)
            ),
            "the header contradicts itself: get the record again, or set `lenient = true` to use the first",
        ));
    }
    Ok(own.or(raw))
}

/// Reals that hold the recorder's volts a count (in millionths), the sensor's volts per unit of
/// motion, and the gain between them.
const MICROVOLTS_A_COUNT: usize = 22;
const SENSITIVITY: usize = 42;
const GAIN: usize = 47;
/// Reals that hold the sensor's output at its full scale (V), and that full scale (g).
const FULL_OUTPUT: usize = 43;
const FULL_SCALE: usize = 44;
/// Part by which the sensitivity may differ from that over the full scale: agencies state one as it was
/// calibrated beside the other as it was designed.
const SENSITIVITY_TOLERANCE: f64 = 0.05;

/// Refuses a sensitivity that is not the output over the full scale, where the header has all three.
fn sensitivity_agrees(source: &Source<'_>, reals: &HeaderNumbers) -> Result<(), GroundMotionError> {
    let size = |index: usize| reals.get(index).map(f64::abs).filter(|v| *v > 0.0);
    let (Some(stated), Some(output), Some(scale)) =
        (size(SENSITIVITY), size(FULL_OUTPUT), size(FULL_SCALE))
    else {
        return Ok(());
    };
    let by_scale = output / scale;
    if (stated - by_scale).abs() <= SENSITIVITY_TOLERANCE * by_scale {
        return Ok(());
    }
    let message = format!(
        "the sensor gives {stated} V/g (real {SENSITIVITY}), but {output} V at {scale} g (reals {FULL_OUTPUT} and {FULL_SCALE}), which are {} V/g",
        bound(by_scale)
    );
    let line = reals.line_of(SENSITIVITY);
    // One of them may be of a single line to ground, the other between both lines of a sensor.
    let halves = [2.0, 0.5].map(|ratio| (stated / by_scale / ratio - 1.0).abs());
    if halves.iter().any(|part| *part <= SENSITIVITY_TOLERANCE) {
        source.warn(&format!("line {line}: {message}"));
        return Ok(());
    }
    source.contradiction(line, message)
}

/// Raw counts or volts, by what the header says of recorder and sensor: the sensor's
/// sensitivity is in volts per g, per cm/s or per cm, as the quantity is.
fn instrument(
    source: &Source<'_>,
    line: Line<'_>,
    quantity: Quantity,
    (of, volts): (&'static str, Option<f64>),
    reals: &HeaderNumbers,
) -> Result<DraftUnit, GroundMotionError> {
    let of_user = source.options.sensitivity.is_some() && volts.is_none();
    if of_user && quantity == Quantity::Acceleration {
        // The user knows better, of accelerations.
        return Ok(DraftUnit::Counts);
    }
    if quantity == Quantity::Acceleration {
        sensitivity_agrees(source, reals)?;
    }
    let nonzero = |index: usize| reals.get(index).filter(|v| *v != 0.0 && v.is_finite());
    let recorder = volts.is_none().then_some(MICROVOLTS_A_COUNT);
    let volts = volts.or_else(|| nonzero(MICROVOLTS_A_COUNT).map(|v| v * 1.0e-6));
    let (Some(volts), Some(sensitivity)) = (volts, nonzero(SENSITIVITY)) else {
        let missing = if volts.is_none() {
            format!("how many volts a count is (real {MICROVOLTS_A_COUNT})")
        } else {
            format!("the sensitivity of the sensor (real {SENSITIVITY})")
        };
        return Err(source.error(
            line.number,
            0,
            format!("the values are {of}, and the header does not give {missing}"),
            "give `sensitivity` in counts per m/s2, or use the V1 file of the same record",
        ));
    };
    if reals.get(GAIN) == Some(0.0) {
        return Err(source.error(
            reals.line_of(GAIN),
            0,
            format!("the gain (real {GAIN}) is zero"),
            "give `sensitivity` in counts per m/s2, or use the V1 file of the same record",
        ));
    }
    let gain = nonzero(GAIN).unwrap_or(1.0);
    let each = volts / sensitivity / gain;
    let turned = match each < 0.0 {
        true => format!(": the samples have the opposite sign of the {of}"),
        false => String::new(),
    };
    for index in recorder.into_iter().chain([SENSITIVITY, GAIN]) {
        if let Some(value) = nonzero(index).filter(|v| *v < 0.0) {
            let line = reals.line_of(index);
            source.warn(&format!(
                "line {line}: real {index} is negative, {value}{turned}"
            ));
        }
    }
    let unit = match quantity {
        Quantity::Acceleration => SeriesUnit::G,
        Quantity::Velocity => SeriesUnit::CM_S,
        Quantity::Displacement => SeriesUnit::CM,
    };
    Ok(DraftUnit::Scaled {
        unit,
        each,
        of,
        by: "by the recorder and the sensor in the header".to_owned(),
    })
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
        Some((line.number, number::stated(&lower, "record length")?.0))
    });
    if let Some((line, seconds)) = in_words.filter(|(_, seconds)| *seconds > 0.0) {
        let words = StatedDuration {
            seconds,
            line: Some(line),
        };
        draft.state_in_words(words, reals.positive(RAW_LENGTH), own);
    }
    let approximate = number::stated(&announcement.lower(), "approx").map(|n| n.0);
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
    as_announced(source, line, (count, layout), lines.peek())?;
    source.header_numbers(lines, layout, count)
}

/// Refuses numbers that stand on other lines, or in other columns, than the line before them says:
/// each means what its place says.
fn as_announced(
    source: &Source<'_>,
    line: Line<'_>,
    (count, layout): (usize, Layout),
    first: Option<Line<'_>>,
) -> Result<(), GroundMotionError> {
    let lower = line.lower();
    let stated = lower.split_once(" on ").and_then(|(_, rest)| {
        let (number, behind) = rest.trim_start().split_once(' ')?;
        let lines: usize = number.parse().ok()?;
        behind.trim_start().starts_with("line").then_some(lines)
    });
    let lines = count.div_ceil(layout.per_line);
    if let Some(stated) = stated.filter(|stated| *stated != lines) {
        let message = format!(
            "{count} numbers, {} a line, stand on {lines} lines, not {stated}",
            layout.per_line
        );
        return Err(source.error(line.number, 0, message, REMEDY));
    }
    let Some(first) = first.filter(|_| count >= layout.per_line) else {
        return Ok(());
    };
    let columns = (layout.per_line - 1) * layout.width + 1..=layout.per_line * layout.width;
    if columns.contains(&first.bytes.len()) {
        return Ok(());
    }
    let message = format!(
        "the row has {} columns, where line {} announces {} numbers of {} columns",
        first.bytes.len(),
        line.number,
        layout.per_line,
        layout.width
    );
    Err(source.error(first.number, 0, message, REMEDY))
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
    (integers, reals): (&HeaderNumbers, &HeaderNumbers),
) -> Result<DraftUnit, GroundMotionError> {
    if integers.get(1).is_some_and(|stage| stage >= 3.0) {
        return Err(GroundMotionError::Unsupported {
            file: source.file.to_owned(),
            what: "the file holds spectra, no time series".to_owned(),
            remedy: "use the V2 file of the same record",
        });
    }
    let (word, printed) = unit_stated(lower).unwrap_or_default();
    let in_header = integers.get(3);
    // 4 and 10 are two names of one unit.
    let same = |a: f64, b: f64| a == b || unit_of(a).is_some() && unit_of(a) == unit_of(b);
    if let (Some(printed), Some(code)) = (printed, in_header)
        && !same(printed, code)
    {
        return Err(source.error(
            line.number,
            0,
            format!(
                "the unit code is {printed} here, but {code} in line {}",
                integers.line_of(3)
            ),
            "the header contradicts itself: get the record again",
        ));
    }
    let known = symbol_of_word(word);
    if let (None, Some(code), false) = (known, printed.or(in_header), word.is_empty())
        && let Some(symbol) = symbol_of(code)
    {
        source.warn(&format!(
            "line {}: the unit \"{word}\" is not known here; the values are taken as {symbol}, by the code {code} of the unit",
            line.number
        ));
    }
    if let (Some(word), Some(code)) = (known, printed.or(in_header))
        && symbol_of(code).is_some_and(|symbol| symbol != word)
    {
        return Err(source.error(
            line.number,
            0,
            format!(
                "the unit is {word} in words here, but {} by its code {code}",
                symbol_of(code).unwrap_or("none")
            ),
            "the header contradicts itself: get the record again",
        ));
    }
    let code = printed.or(in_header);
    let said = match integers.get(2) {
        Some(1.0) => Some(Quantity::Acceleration),
        Some(2.0) => Some(Quantity::Velocity),
        Some(3.0 | 4.0) => Some(Quantity::Displacement),
        Some(other) if code.is_some_and(|c| INSTRUMENT_CODES.contains(&c)) => {
            return Err(GroundMotionError::Unsupported {
                file: source.file.to_owned(),
                what: format!("physical parameter {other} is not one of translation"),
                remedy: "use the file of a channel that records acceleration",
            });
        }
        _ => None,
    };
    let quantity = said.or_else(|| sensor(lower, integers));
    let values = |of, volts| match quantity {
        Some(quantity) => instrument(source, line, quantity, (of, volts), reals),
        None => Err(source.error(
            line.number,
            0,
            format!("the values are {of}, and neither integer 2 nor this line says of what"),
            REMEDY,
        )),
    };
    let unit = match (code, code.and_then(unit_of)) {
        (_, Some(unit)) => unit,
        (Some(50.0), _) => return values("counts", None),
        (Some(51.0), _) => return values("V", Some(1.0)),
        (Some(52.0), _) => return values("mV", Some(1.0e-3)),
        (Some(other), None) => {
            return Err(source.error(
                line.number,
                0,
                format!("unit code {other} is not one of ground motion"),
                "use the V1 or V2 file of the same record",
            ));
        }
        (None, None) => return Ok(DraftUnit::Unstated),
    };
    match said {
        Some(quantity) if quantity != unit.quantity => Err(source.error(
            line.number,
            0,
            format!(
                "the unit {} here is one of {}, but integer 2 in line {} says {quantity}",
                unit.symbol,
                unit.quantity,
                integers.line_of(2)
            ),
            "header and data contradict one another: get the record again",
        )),
        _ => Ok(DraftUnit::Stated(unit)),
    }
}

/// The unit of motion of a code (table 2 of the format).
fn unit_of(code: f64) -> Option<SeriesUnit> {
    Some(match code {
        2.0 => SeriesUnit::G,
        4.0 | 10.0 => SeriesUnit::CM_S2,
        5.0 => SeriesUnit::CM_S,
        6.0 => SeriesUnit::CM,
        7.0 => SeriesUnit::IN_S2,
        8.0 => SeriesUnit::IN_S,
        9.0 => SeriesUnit::IN,
        11.0 => SeriesUnit::MILLI_G,
        12.0 => SeriesUnit::MICRO_G,
        _ => return None,
    })
}

/// The symbol of what a code stands for: a unit of motion, or of what an instrument gives.
fn symbol_of(code: f64) -> Option<&'static str> {
    let of_instrument = INSTRUMENT_CODES
        .into_iter()
        .zip(INSTRUMENT_UNITS)
        .find(|(known, _)| *known == code);
    unit_of(code)
        .map(|unit| unit.symbol)
        .or(of_instrument.map(|(_, symbol)| symbol))
}

/// Word and code of `units=cm/sec2(04)` or `units= counts(50)` in the line before the data, in lower case: brackets
/// behind the word, not those of the layout that follows.
fn unit_stated(lower: &str) -> Option<(&str, Option<f64>)> {
    let (_, rest) = lower.split_once("units=")?;
    let rest = rest.split(',').next()?;
    let rest = rest.split("format").next()?;
    Some(match rest.split_once('(') {
        Some((word, code)) => (word.trim(), number::first_in(code).map(|n| n.0)),
        None => (rest.trim(), None),
    })
}

/// The symbol of a unit in words.
fn symbol_of_word(word: &str) -> Option<&'static str> {
    match word {
        "count" | "counts" => Some("counts"),
        "v" | "volt" | "volts" => Some("V"),
        "mv" | "millivolt" | "millivolts" => Some("mV"),
        word => SeriesUnit::parse(word).map(|unit| unit.symbol),
    }
}

/// Unit codes of values that an instrument gives: counts, volts, millivolts.
const INSTRUMENT_CODES: [f64; 3] = [50.0, 51.0, 52.0];
const INSTRUMENT_UNITS: [&str; 3] = ["counts", "V", "mV"];

/// What a raw record is of, where integer 2 does not say: the words of the line before the data,
/// else the kind of the sensor.
fn sensor(lower: &str, integers: &HeaderNumbers) -> Option<Quantity> {
    let of_sensor = || by_sensor(integers).map(|named| named.quantity);
    Quantity::in_words(lower).or_else(of_sensor)
}

/// Integer that holds the kind of the sensor.
const SENSOR: usize = 52;

/// What the sensor of a raw record feels: kinds 1 to 999 acceleration, 1001 to 1999 velocity.
fn by_sensor(integers: &HeaderNumbers) -> Option<NamedQuantity> {
    // A processed series need not be of what was felt.
    let kind = integers
        .get(SENSOR)
        .filter(|_| integers.get(1) == Some(0.0))?;
    let quantity = match kind {
        kind if (1.0..1000.0).contains(&kind) => Quantity::Acceleration,
        kind if (1001.0..2000.0).contains(&kind) => Quantity::Velocity,
        _ => return None,
    };
    Some(NamedQuantity {
        quantity,
        text: format!("sensor of kind {kind}"),
        line: integers.line_of(SENSOR),
    })
}

/// The stage of the processing in the first line, which integer 1 repeats: 0 raw, 1 uncorrected,
/// 2 corrected. The first of both is used.
fn stage_agrees(
    source: &Source<'_>,
    first: Line<'_>,
    integers: &HeaderNumbers,
) -> Result<Option<f64>, GroundMotionError> {
    let lower = first.lower();
    let words = lower.trim_start();
    let in_words = ["raw", "uncorrected", "corrected"]
        .into_iter()
        .zip([0.0, 1.0, 2.0])
        .find(|(word, _)| words.starts_with(word));
    match (in_words, integers.get(1)) {
        (Some((word, stage)), Some(code)) if stage != code => {
            source.contradiction(
                first.number,
                format!(
                    "the record is {word} here, but of stage {code} (0 raw, 1 uncorrected, 2 corrected) in line {}",
                    integers.line_of(1)
                ),
            )?;
            Ok(Some(stage))
        }
        (_, code) => Ok(code),
    }
}

/// `Max =  -6.852 cm/sec2 at 76.215 sec` on the line of the processing.
fn peak_in_words(source: &Source<'_>, text: &[Line<'_>], of_counts: bool) -> Option<DraftPeak> {
    let lines = text.iter().map(|l| (l.number, l.lower()));
    let (line, lower) = lines
        .into_iter()
        .find(|(_, lower)| lower.starts_with("processed") && lower.contains("max ="))?;
    let value = source.header_number(line, "Max", number::number_behind(&lower, "max =")?)?;
    let unit = unit_of_number(&lower, "max =");
    let counts = of_counts && lower.split_once("max =")?.1.contains("count");
    (unit.is_some() || counts).then_some(DraftPeak {
        value,
        time: None,
        unit,
        shift: 0.0,
        line: Some(line),
        of_sign: false,
    })
}

/// Integer that holds the azimuth, or a code above 360.
const AZIMUTH: usize = 54;

/// Azimuth of integer 54, or the words of the header's line `Sta Chan`, which say the same.
fn component(
    source: &Source<'_>,
    text: &[Line<'_>],
    integers: &HeaderNumbers,
) -> Result<String, GroundMotionError> {
    let of_channel = |line: &&Line<'_>| line.lower().starts_with("sta chan");
    let in_words = text.iter().find(of_channel).and_then(|line| {
        let text = line.columns(8, line.bytes.len());
        let name = text.split_once(':')?.1.split('(').next()?.trim().to_owned();
        Some((line.number, name))
    });
    let in_numbers = match integers.get(AZIMUTH) {
        Some(400.0) => Some("Up".to_owned()),
        Some(401.0) => Some("Down".to_owned()),
        Some(402.0) => Some("Vertical".to_owned()),
        Some(azimuth) if (1.0..=360.0).contains(&azimuth) => Some(format!("{azimuth} deg")),
        Some(azimuth) if azimuth < 0.0 || (360.0..400.0).contains(&azimuth) => {
            let message = format!("the azimuth (integer {AZIMUTH}) is {azimuth} degrees");
            source.contradiction(integers.line_of(AZIMUTH), message)?;
            None
        }
        _ => None,
    };
    // `900 Deg` is no direction, nor is `-90 Deg`.
    let degrees = |name: &str| name.split(' ').next()?.parse::<f64>().ok();
    let beyond = |name: &str| degrees(name).is_some_and(|a| !(0.0..=360.0).contains(&a));
    let in_words = match in_words {
        Some((line, name)) if beyond(&name) => {
            let message =
                format!("the component is \"{name}\", where an azimuth is from 0 to 360 degrees");
            source.contradiction(line, message)?;
            None
        }
        others => others,
    };
    let (Some((line, words)), Some(numbers)) = (&in_words, &in_numbers) else {
        let words = in_words.map(|(_, name)| name);
        return Ok(in_numbers.or(words).unwrap_or_default());
    };
    if Direction::differ(words, numbers) {
        let message = format!(
            "the component is \"{words}\" here, but {numbers} by integer {AZIMUTH} in line {}",
            integers.line_of(AZIMUTH)
        );
        source.contradiction(*line, message)?;
        return Ok(words.clone());
    }
    Ok(numbers.clone())
}
