//! PEER strong-motion database: AT2 (acceleration), VT2 (velocity) and DT2
//! (displacement) in all header forms that were met: `NPTS=, DT=`, numbers first,
//! four or seven header lines, and the free header of Peknold's El Centro.

use crate::accelerogram::Processing;
use crate::draft::{Draft, DraftPeak, DraftUnit, NamedQuantity, Times};
use crate::error::GroundMotionError;
use crate::formats::Format;
use crate::number::{self, Bare};
use crate::quantity::{Quantity, SeriesUnit};
use crate::recording::Series;
use crate::source::Source;
use crate::text::{Line, Lines};
use crate::writers::peer_at2::RAW;

/// Lines looked through for the header.
const HEADER_LINES: usize = 12;
/// Lines looked through for the start of the data after a free header.
const FREE_LINES: usize = 60;
const REMEDY: &str =
    "an AT2 header has a line such as `NPTS=  4000, DT= .01000 SEC` or `4000  0.0100  NPTS, DT`";

/// What the header says.
struct Header {
    line: usize,
    count: usize,
    step: Option<f64>,
    text: Vec<String>,
}

fn is_counts(line: &Line<'_>) -> bool {
    let lower = line.lower();
    lower.contains("npts") && lower.contains("dt")
}

/// `1559 points at equal spacing of 0.02 sec`.
fn is_spaced(line: &Line<'_>) -> bool {
    line.lower().contains("points at equal spacing of")
}

pub(super) static FORMAT: Format = Format {
    name: "peer_at2",
    title: "PEER AT2, VT2 and DT2 with all header forms",
    source: "Pacific Earthquake Engineering Research Center",
    recognised_by: "a line with NPTS and DT, or points at equal spacing of",
    matches,
    read,
};

fn matches(source: &Source<'_>) -> bool {
    source.lines().take(HEADER_LINES).any(|l| is_counts(&l))
        || source.lines().take(FREE_LINES).any(|l| is_spaced(&l))
}

fn read(source: &Source<'_>) -> Result<Vec<Series>, GroundMotionError> {
    let mut lines = source.lines();
    let header = header(source, &mut lines)?;
    let unit = unit(source, &header)?;
    let first = lines.number() + 1;
    // A value takes two bytes at least.
    let mut samples = Vec::with_capacity((lines.remaining() / 2 + 1).min(header.count + 1));
    let mut last_row = 0;
    for line in lines.by_ref() {
        if line.is_text() {
            if line.lower().contains("end data") {
                break;
            }
        } else if line.is_blank() {
            continue;
        }
        let before = samples.len();
        for (column, field) in line.fields() {
            samples.push(source.number(line, column, field)?);
        }
        last_row = samples.len() - before;
    }
    source.ends_whole()?;
    let mut draft = Draft::new(samples, unit, (header.line, first, lines.number()));
    draft.times = Times::Step(header.step);
    draft.header_count = Some(header.count);
    // One value a row has nothing to fill.
    draft.last_row = Some(last_row).filter(|n| *n > 1);
    draft.processing = match header.text.first() {
        // Written by this program, which says so.
        Some(first) if first == RAW => Processing::Raw,
        _ => Processing::Corrected,
    };
    draft.quantities = quantities(&header.text);
    let all = header.text.join(" ");
    draft.peak = peak(&draft.unit, &all);
    draft.corners = (
        number::after(&all, "hp=").map(|n| n.0).filter(|f| *f > 0.0),
        number::after(&all, "lp=").map(|n| n.0).filter(|f| *f > 0.0),
    );
    let shown = header.text.len().saturating_sub(1).min(2);
    draft.title = header.text[..shown].join("; ");
    Ok(vec![draft.finish(source)?])
}

/// Reads the header; `lines` are at the data afterwards.
fn header(source: &Source<'_>, lines: &mut Lines<'_>) -> Result<Header, GroundMotionError> {
    let position = source.lines().take(HEADER_LINES).find(is_counts);
    let spaced = source.lines().take(FREE_LINES).find(is_spaced);
    let Some(line) = position.or(spaced) else {
        return Err(source.error(1, 0, "no line with NPTS and DT", REMEDY));
    };
    let last = match position {
        Some(line) => line.number,
        None => source
            .lines()
            .take(FREE_LINES)
            .find(|l| l.lower().contains("begin data"))
            .map_or(line.number, |l| l.number),
    };
    let mut text = Vec::new();
    while lines.number() < last
        && let Some(l) = lines.next()
    {
        text.push(l.text().trim().to_owned());
    }
    let (count, step) = counts(source, line)?;
    let Some(count) = count else {
        return Err(source.error(
            line.number,
            0,
            format!("no count of samples in \"{}\"", number::shown(line.bytes)),
            REMEDY,
        ));
    };
    Ok(Header {
        line: line.number,
        count,
        step,
        text,
    })
}

/// The quantities of the lines on the unit and on the kind of series, such as `VELOCITY TIME
/// HISTORY IN UNITS OF CM/S`.
fn quantities(text: &[String]) -> Vec<NamedQuantity> {
    let named = |(i, line): (usize, &String)| {
        let lower = line.to_ascii_lowercase();
        let says = ["units", "time history", "time series"];
        let says = says.iter().any(|words| lower.contains(words));
        says.then(|| NamedQuantity::of(i + 1, line))?
    };
    text.iter().enumerate().filter_map(named).collect()
}

/// What stands behind `DT =`.
fn behind_dt(lower: &str) -> Option<&str> {
    let at = lower.find("dt")? + "dt".len();
    let rest = lower.get(at..)?.trim_start().strip_prefix('=')?;
    Some(rest.trim_start())
}

fn counts(
    source: &Source<'_>,
    line: Line<'_>,
) -> Result<(Option<usize>, Option<f64>), GroundMotionError> {
    let lower = line.lower();
    let after = |key: &str| {
        let at = lower.find(key)? + key.len();
        let rest = lower.get(at..)?.trim_start().strip_prefix('=')?;
        rest.trim_start().split([' ', ',', '\t']).next()
    };
    if let Some(count) = after("npts") {
        let step = match behind_dt(&lower) {
            Some(text) => source.step_or_rate(line, text, Bare::Step)?,
            None => None,
        };
        return Ok((count.parse().ok(), step));
    }
    let mut numbers = line.fields().filter_map(|(_, f)| number::parse(f).ok());
    let count = numbers
        .next()
        .filter(|n| n.fract() == 0.0 && (0.0..1.0e9).contains(n));
    Ok((count.map(|n| n as usize), numbers.next()))
}

/// Words of the line that says what the values are.
const OF_VALUES: [&str; 2] = ["time series", "time history"];

/// The unit that a text in lower case states: `in units of g`, `the units are (g)`.
fn unit_in(lower: &str) -> Option<SeriesUnit> {
    lower.split("units").skip(1).find_map(|after| {
        let after = after.trim_start();
        let word = after
            .strip_prefix("of")
            .or_else(|| after.strip_prefix("are"))
            .or_else(|| after.strip_prefix(':'))?;
        let word = word.trim_start_matches([' ', '(', ':']);
        let end = word.find([' ', ',', ')', '\t', ';']).unwrap_or(word.len());
        SeriesUnit::parse(&word[..end])
    })
}

/// Unit from the header's text: that of the line that names the quantity of the values, such as
/// `ACCELERATION TIME SERIES IN UNITS OF G`, before those of others.
fn unit(source: &Source<'_>, header: &Header) -> Result<DraftUnit, GroundMotionError> {
    let lower: Vec<String> = header.text.iter().map(|l| l.to_ascii_lowercase()).collect();
    let all = lower.join(" ");
    let stated = |of_values: bool| -> Vec<(usize, SeriesUnit)> {
        let lines = lower.iter().enumerate();
        lines
            .filter(|(_, l)| !of_values || OF_VALUES.iter().any(|words| l.contains(words)))
            .filter_map(|(i, l)| Some((i + 1, unit_in(l)?)))
            .collect()
    };
    let mut units = stated(true);
    if units.is_empty() {
        units = stated(false);
    }
    if let [(first, unit), rest @ ..] = units.as_slice()
        && let Some((line, other)) = rest.iter().find(|(_, other)| other != unit)
    {
        return Err(source.error(
            *line,
            0,
            format!(
                "the unit is {} here, but {} in line {first}",
                other.symbol, unit.symbol
            ),
            "header lines contradict one another: a line such as `ACCELERATION TIME SERIES IN UNITS OF G` must say the unit of the values",
        ));
    }
    // Words may go on in the next line.
    let unit = units
        .first()
        .map(|(_, unit)| *unit)
        .or_else(|| unit_in(&all));
    if let Some(unit) = unit {
        return Ok(DraftUnit::Stated(unit));
    }
    let words = |q: Quantity| all.contains(&format!("{} time", q.name()));
    for quantity in [Quantity::Velocity, Quantity::Displacement] {
        if words(quantity) && !words(Quantity::Acceleration) {
            return Err(GroundMotionError::NotAcceleration {
                file: source.file.to_owned(),
                quantity: quantity.name(),
            });
        }
    }
    Ok(DraftUnit::Unstated)
}

/// `PGA=`, `PGV=` or `PGD=` of newer headers, in the unit of the samples.
fn peak(unit: &DraftUnit, text: &str) -> Option<DraftPeak> {
    let DraftUnit::Stated(unit) = unit else {
        return None;
    };
    let key = match unit.quantity {
        Quantity::Acceleration => "pga=",
        Quantity::Velocity => "pgv=",
        Quantity::Displacement => "pgd=",
    };
    Some(DraftPeak {
        value: number::stated(text, key)?,
        time: None,
        unit: None,
        shift: 0.0,
        line: None,
        of_sign: false,
    })
}
