//! A measured force history: columns time and force, with units.

use std::ops::Range;
use std::path::Path;

use pounding_case::{Dimension, unit_in};
use pounding_catalogue::wording::{agreeing, counted};

use crate::columns::{Column, Source, looks_numeric};
use crate::failure::Failure;

/// A header as it should be.
const EXAMPLE: &str = "time_ms,force_kN";

/// The two units: sizes in SI.
#[derive(Clone, Copy, PartialEq)]
struct Units {
    time: f64,
    force: f64,
}

/// Reads time (s) and force (N). Lines that start with `#` are comments; a header
/// names the columns with their units, unless `units` gives them as `"ms,kN"`.
pub fn read(path: &Path, units: Option<&str>) -> Result<Vec<(f64, f64)>, Failure> {
    let help = "--against takes a text file with the columns time, force";
    let source = Source::open(path, help, EXAMPLE)?;
    let option = units.map(from_option).transpose()?;
    let mut units = option;
    let mut samples: Vec<(f64, f64)> = Vec::new();
    let mut lines = source.lines().peekable();
    if let Some((place, fields)) = lines.peek()
        && !fields.iter().any(|f| looks_numeric(f))
    {
        units = Some(header(&source, place.clone(), fields, option)?);
        lines.next();
    }
    let mut end = 0..0;
    for (place, fields) in lines {
        let units = units.ok_or_else(|| no_units(&source, place.clone()))?;
        let [time, force] = fields.as_slice() else {
            return Err(columns(&source, place, fields.len()));
        };
        let (time, force) = (source.number(&place, time)?, source.number(&place, force)?);
        let time = time * units.time;
        if samples.last().is_some_and(|(before, _)| !(time > *before)) {
            return Err(source.error(
                place,
                "time does not increase here".to_owned(),
                "sort the rows by time, and leave out rows that repeat a time",
            ));
        }
        samples.push((time, force * units.force));
        end = place;
    }
    if samples.len() < 3 {
        return Err(source.error(
            end,
            format!(
                "{} of numbers {} too few",
                counted(samples.len(), "row"),
                agreeing(&samples.len(), "is", "are")
            ),
            "a force history takes three rows at least, better fifty",
        ));
    }
    Ok(samples)
}

fn header(
    source: &Source,
    place: Range<usize>,
    fields: &[String],
    option: Option<Units>,
) -> Result<Units, Failure> {
    let [time, force] = fields else {
        return Err(columns(source, place, fields.len()));
    };
    match ([time, force].map(|f| unit_in(f)), option) {
        ([Some(time), Some(force)], option) => {
            let units = sizes(time, force)
                .map_err(|(message, help)| source.error(place.clone(), message, &help))?;
            if option.is_some_and(|o| o != units) {
                return Err(source.error(
                    place,
                    "--against-units contradicts the units of the header".to_owned(),
                    "leave --against-units out, or correct the header",
                ));
            }
            Ok(units)
        }
        (_, Some(option)) => Ok(option),
        _ => Err(no_units(source, place)),
    }
}

fn columns(source: &Source, place: Range<usize>, found: usize) -> Failure {
    source.error(
        place,
        format!(
            "there {} {} here, but two are wanted: time, force",
            agreeing(&found, "is", "are"),
            counted(found, "column")
        ),
        "keep the columns time and force; separate them by comma, semicolon, tab or blanks, and write numbers with a decimal point",
    )
}

fn no_units(source: &Source, place: Range<usize>) -> Failure {
    source.error(
        place,
        "the units of time and force are not known".to_owned(),
        "write a header line such as `time_ms,force_kN` or `time (ms), force (kN)`, or add --against-units \"ms,kN\"",
    )
}

fn from_option(text: &str) -> Result<Units, Failure> {
    let example = || Some("write them as --against-units \"ms,kN\"".to_owned());
    let Some((time, force)) = text.split_once(',') else {
        return Err(Failure::input(
            format!("--against-units is \"{text}\", but two units are wanted: time, force"),
            example(),
        ));
    };
    sizes(time.trim(), force.trim()).map_err(|(message, help)| {
        Failure::input(format!("--against-units: {message}"), Some(help))
    })
}

/// Sizes of the two units in SI, or message and remedy.
fn sizes(time: &str, force: &str) -> Result<Units, (String, String)> {
    let size = |unit: &str, name, dimension| {
        Column { name, dimension }
            .size(unit)
            .map_err(|(message, help)| {
                let columns = || format!("the columns are time, force: for example `{EXAMPLE}`");
                (message, help.unwrap_or_else(columns))
            })
    };
    Ok(Units {
        time: size(time, "time", Dimension::TIME)?,
        force: size(force, "force", Dimension::FORCE)?,
    })
}
