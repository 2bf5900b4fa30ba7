//! PEER AT2 in all header forms that were met: `NPTS=, DT=`, numbers first, four
//! or seven header lines, and the free header of Peknold's El Centro.

use super::{Found, Source, fields};
use crate::error::GroundMotionError;
use crate::number;
use crate::unit::AccelerationUnit;

/// Lines looked through for the header.
const HEADER_LINES: usize = 12;
const REMEDY: &str =
    "an AT2 header has a line such as `NPTS=  4000, DT= .01000 SEC` or `4000  0.0100  NPTS, DT`";

/// Line of the header's counts: index, count, step.
struct Counts {
    line: usize,
    count: Option<usize>,
    step: Option<f64>,
}

pub(crate) fn matches(source: &Source<'_>) -> bool {
    counts_line(source).is_some() || spaced_line(source).is_some()
}

fn counts_line(source: &Source<'_>) -> Option<usize> {
    source.lines.iter().take(HEADER_LINES).position(|l| {
        let upper = l.to_ascii_uppercase();
        upper.contains("NPTS") && upper.contains("DT")
    })
}

/// `1559 points at equal spacing of 0.02 sec`.
fn spaced_line(source: &Source<'_>) -> Option<usize> {
    source.lines.iter().take(60).position(|l| {
        l.to_ascii_lowercase()
            .contains("points at equal spacing of")
    })
}

pub(crate) fn read(source: &Source<'_>) -> Result<Found, GroundMotionError> {
    let (counts, first) = if let Some(line) = counts_line(source) {
        (counts(source, line), line + 1)
    } else if let Some(line) = spaced_line(source) {
        let begin = source
            .lines
            .iter()
            .position(|l| l.to_ascii_lowercase().contains("begin data"));
        (numbers_first(source, line), begin.unwrap_or(line) + 1)
    } else {
        return Err(source.error(0, 0, "no line with NPTS and DT".to_owned(), REMEDY));
    };
    if counts.count.is_none() {
        return Err(source.error(
            counts.line,
            0,
            format!("no count of samples in \"{}\"", source.lines[counts.line]),
            REMEDY,
        ));
    }
    let stated = unit(source, first)?;
    let mut samples = Vec::new();
    for (i, line) in source.lines.iter().enumerate().skip(first) {
        if line.to_ascii_lowercase().contains("end data") {
            break;
        }
        for (column, field) in fields(line) {
            samples.push(source.number(i, column, field)?);
        }
    }
    let mut warnings = Vec::new();
    source.count(&mut samples, counts.count, &mut warnings)?;
    let (time_step, time_step_source) = source.time_step(counts.step, counts.line)?;
    let peak = samples.iter().fold(0.0_f64, |m, a| m.max(a.abs()));
    let (unit, unit_source) = source.unit(stated, first, peak)?;
    Ok(Found {
        samples,
        unit,
        unit_source,
        time_step,
        time_step_source,
        title: source
            .lines
            .iter()
            .take(counts.line.min(2))
            .map(|l| l.trim())
            .collect::<Vec<_>>()
            .join("; "),
        header_count: counts.count,
        warnings,
    })
}

fn counts(source: &Source<'_>, line: usize) -> Counts {
    let upper = source.lines[line].to_ascii_uppercase();
    let after = |key: &str| {
        let at = upper.find(key)? + key.len();
        let rest = upper[at..].trim_start().strip_prefix('=')?;
        rest.trim_start().split([' ', ',', '\t']).next()
    };
    if let Some(count) = after("NPTS") {
        return Counts {
            line,
            count: count.parse().ok(),
            step: after("DT").and_then(|t| number::parse(t).ok()),
        };
    }
    numbers_first(source, line)
}

/// The first two numbers of a line: count and step.
fn numbers_first(source: &Source<'_>, line: usize) -> Counts {
    let mut numbers = fields(source.lines[line]).filter_map(|(_, f)| number::parse(f).ok());
    Counts {
        line,
        count: numbers
            .next()
            .filter(|n| n.fract() == 0.0 && *n >= 0.0)
            .map(|n| n as usize),
        step: numbers.next(),
    }
}

/// Unit from the header's text; velocities and displacements are refused.
fn unit(source: &Source<'_>, first: usize) -> Result<Option<AccelerationUnit>, GroundMotionError> {
    let header = source.lines[..first].join(" ").to_ascii_uppercase();
    let not = |quantity| GroundMotionError::NotAcceleration {
        file: source.file.to_owned(),
        quantity,
    };
    let Some(at) = header.find("UNITS OF") else {
        return Ok(None);
    };
    let unit = header[at + "UNITS OF".len()..].trim_start();
    if unit.starts_with("CM/SEC/SEC")
        || unit.starts_with("CM/S/S")
        || unit.starts_with("CM/S2")
        || unit.starts_with("CM/SEC2")
    {
        Ok(Some(AccelerationUnit::Gal))
    } else if unit.starts_with("CM/S") {
        Err(not("velocity"))
    } else if unit.starts_with("CM") {
        Err(not("displacement"))
    } else if unit.starts_with('G') {
        Ok(Some(AccelerationUnit::StandardGravity))
    } else if unit.starts_with("M/S") {
        Ok(Some(AccelerationUnit::MetrePerSecondSquared))
    } else {
        Ok(None)
    }
}
