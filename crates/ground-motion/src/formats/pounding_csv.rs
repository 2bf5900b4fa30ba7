//! Our CSV layout: `# Key: value` lines, a header `time_s,acceleration_g`, rows.

use super::{Found, Source};
use crate::error::GroundMotionError;
use crate::unit::AccelerationUnit;

const REMEDY: &str = "the layout is in ground_motions/README.md";

pub(crate) fn matches(source: &Source<'_>) -> bool {
    source
        .lines
        .iter()
        .find(|l| !l.starts_with('#') && !l.trim().is_empty())
        .is_some_and(|l| l.starts_with("time_s,acceleration_"))
}

pub(crate) fn read(source: &Source<'_>) -> Result<Found, GroundMotionError> {
    let key = |name: &str| {
        source.lines.iter().enumerate().find_map(|(i, l)| {
            let value = l.strip_prefix('#')?.trim().strip_prefix(name)?;
            Some((i, value.trim_start_matches(':').trim()))
        })
    };
    let Some(header) = source
        .lines
        .iter()
        .position(|l| !l.starts_with('#') && !l.is_empty())
    else {
        return Err(source.error(0, 0, "the file has no data".to_owned(), REMEDY));
    };
    let Some(suffix) = source.lines[header].strip_prefix("time_s,acceleration_") else {
        return Err(source.error(
            header,
            0,
            format!(
                "column header \"{}\" is not \"time_s,acceleration_<unit>\"",
                source.lines[header]
            ),
            REMEDY,
        ));
    };
    let unit = unit_of_header(suffix)?;
    if let Some((line, text)) = key("Unit") {
        let stated: AccelerationUnit = text.parse()?;
        if stated != unit {
            return Err(source.error(
                line,
                0,
                format!(
                    "unit \"{text}\" contradicts the column header \"{}\"",
                    source.lines[header]
                ),
                "make both the same",
            ));
        }
    }
    let (unit, unit_source) = source.unit(Some(unit), header, 0.0)?;
    let stated = match key("dt") {
        None => None,
        Some((line, text)) => {
            let number = text.strip_suffix('s').unwrap_or(text).trim();
            Some(source.number(line, 0, number)?)
        }
    };
    let (time_step, time_step_source) = source.time_step(stated, header)?;
    let samples = rows(source, header, time_step)?;
    let title = ["Event", "Station", "Component"]
        .iter()
        .filter_map(|k| key(k).map(|(_, v)| v))
        .collect::<Vec<_>>()
        .join("; ");
    Ok(Found {
        samples,
        unit,
        unit_source,
        time_step,
        time_step_source,
        title,
        header_count: None,
        warnings: Vec::new(),
    })
}

fn unit_of_header(suffix: &str) -> Result<AccelerationUnit, GroundMotionError> {
    match suffix {
        "m_s2" => Ok(AccelerationUnit::MetrePerSecondSquared),
        "cm_s2" => Ok(AccelerationUnit::Gal),
        other => other.parse(),
    }
}

fn rows(source: &Source<'_>, header: usize, time_step: f64) -> Result<Vec<f64>, GroundMotionError> {
    let text = source.lines[header + 1..].join("\n");
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .comment(Some(b'#'))
        .trim(csv::Trim::All)
        .from_reader(text.as_bytes());
    let mut samples = Vec::new();
    for record in reader.records() {
        let record = record.map_err(|e| source.error(header, 0, e.to_string(), REMEDY))?;
        let line = header + record.position().map_or(0, csv::Position::line) as usize;
        if record.len() != 2 {
            return Err(source.error(
                line,
                0,
                format!("{} columns where there must be two", record.len()),
                REMEDY,
            ));
        }
        let time = source.number(line, 0, &record[0])?;
        let expected = samples.len() as f64 * time_step;
        if (time - expected).abs() > 0.51 * time_step {
            return Err(source.error(
                line,
                0,
                format!("time {time} s where {expected} s follows from dt = {time_step} s"),
                "a row is missing or dt is wrong",
            ));
        }
        samples.push(source.number(line, record[0].len() + 1, &record[1])?);
    }
    Ok(samples)
}
