//! PEER strong-motion database: AT2 (acceleration), VT2 (velocity) and DT2
//! (displacement) in all header forms that were met: `NPTS=, DT=`, numbers first,
//! four or seven header lines, and the free header of Peknold's El Centro.

use crate::accelerogram::Processing;
use crate::draft::{Draft, DraftPeak, DraftUnit, NamedQuantity, Times};
use crate::error::GroundMotionError;
use crate::formats::Format;
use crate::number;
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
    for line in lines.by_ref() {
        if line.is_text() {
            if line.lower().contains("end data") {
                break;
            }
        } else if line.is_blank() {
            continue;
        }
        for (column, field) in line.fields() {
            samples.push(source.number(line, column, field)?);
        }
    }
    source.ends_whole()?;
    let mut draft = Draft::new(samples, unit, (header.line, first, lines.number()));
    draft.times = Times::Step(header.step);
    draft.header_count = Some(header.count);
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
    let (count, step) = counts(line).map_err(|word| {
        source.error(
            line.number,
            0,
            format!("\"{word}\" is not a unit of a time step"),
            "correct the header: the step is in seconds, as in `DT= .01000 SEC`, in milliseconds (MSEC), or a rate (HZ)",
        )
    })?;
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

/// The step (s) behind `DT =`: in seconds, with or without the word, in milliseconds, or as a rate;
/// another word is an error.
fn step(lower: &str) -> Result<Option<f64>, String> {
    let behind_key = || {
        let at = lower.find("dt")? + "dt".len();
        let rest = lower.get(at..)?.trim_start().strip_prefix('=')?;
        Some(rest.trim_start())
    };
    let Some(rest) = behind_key() else {
        return Ok(None);
    };
    let end = rest.find([' ', ',', '\t']).unwrap_or(rest.len());
    let (first, behind) = rest.split_at(end);
    // `100HZ`: the number ends where the word begins. An `e` alone is of the number.
    let glued = first.len()
        - first
            .trim_start_matches(|c: char| !c.is_ascii_alphabetic() || "ed".contains(c))
            .len();
    let (number, word) = first.split_at(glued);
    let word = match word {
        "" => behind.trim_start_matches([' ', '\t']),
        word => word,
    };
    let ends = |c: char| !(c.is_ascii_alphabetic() || c == '/');
    let (word, after) = word.split_at(word.find(ends).unwrap_or(word.len()));
    let Ok(value) = number::parse(number.as_bytes()) else {
        return Ok(None);
    };
    Ok(Some(match word {
        "hz" | "sps" | "samples/s" | "samples/sec" | "points/sec" => 1.0 / value,
        "ms" | "msec" | "milliseconds" => 1.0e-3 * value,
        "" | "s" | "sec" | "secs" | "second" | "seconds" => value,
        // The next key.
        _ if after.trim_start().starts_with('=') => value,
        _ => return Err(word.to_ascii_uppercase()),
    }))
}

fn counts(line: Line<'_>) -> Result<(Option<usize>, Option<f64>), String> {
    let lower = line.lower();
    let after = |key: &str| {
        let at = lower.find(key)? + key.len();
        let rest = lower.get(at..)?.trim_start().strip_prefix('=')?;
        rest.trim_start().split([' ', ',', '\t']).next()
    };
    if let Some(count) = after("npts") {
        return Ok((count.parse().ok(), step(&lower)?));
    }
    let mut numbers = line.fields().filter_map(|(_, f)| number::parse(f).ok());
    let count = numbers
        .next()
        .filter(|n| n.fract() == 0.0 && (0.0..1.0e9).contains(n));
    Ok((count.map(|n| n as usize), numbers.next()))
}

/// Unit from the header's text: `IN UNITS OF G`, `The units are (g)`.
fn unit(source: &Source<'_>, header: &Header) -> Result<DraftUnit, GroundMotionError> {
    let all = header.text.join(" ").to_ascii_lowercase();
    let stated = all.split("units").skip(1).find_map(|after| {
        let after = after.trim_start();
        let word = after
            .strip_prefix("of")
            .or_else(|| after.strip_prefix("are"))
            .or_else(|| after.strip_prefix(':'))?;
        let word = word.trim_start_matches([' ', '(', ':']);
        let end = word.find([' ', ',', ')', '\t', ';']).unwrap_or(word.len());
        SeriesUnit::parse(&word[..end])
    });
    if let Some(unit) = stated {
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
