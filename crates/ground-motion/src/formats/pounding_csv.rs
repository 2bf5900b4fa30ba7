//! Our CSV layout: `# Key: value` lines, a header `time_s,acceleration_g`, rows.

use crate::draft::{Draft, DraftUnit, Times};
use crate::error::{GroundMotionError, bound};
use crate::number;
use crate::quantity::SeriesUnit;
use crate::recording::Series;
use crate::source::Source;
use crate::text::{Line, Lines};
use crate::unit::AccelerationUnit;

const REMEDY: &str = "the layout is in ground_motions/README.md";
const START: &str = "time_s,acceleration_";

/// `# Key: value` lines that mean something.
#[derive(Default)]
struct Keys {
    title: Vec<String>,
    component: String,
    history: Vec<String>,
    unit: Option<(usize, String)>,
    step: Option<f64>,
}

pub(crate) fn matches(source: &Source<'_>) -> bool {
    source
        .lines()
        .find(|l| !l.bytes.starts_with(b"#") && !l.is_blank())
        .is_some_and(|l| l.bytes.starts_with(START.as_bytes()))
}

pub(crate) fn read(source: &Source<'_>) -> Result<Vec<Series>, GroundMotionError> {
    let mut lines = source.lines();
    let mut keys = Keys::default();
    let header = loop {
        let line = source.expect(&mut lines, "the column header")?;
        if line.bytes.starts_with(b"#") {
            keys.take(source, line)?;
        } else if !line.is_blank() {
            break line;
        }
    };
    let text = header.text();
    let Some(suffix) = text.strip_prefix(START) else {
        return Err(source.error(
            header.number,
            0,
            format!("column header \"{text}\" is not \"{START}<unit>\""),
            REMEDY,
        ));
    };
    let unit = unit_of_header(suffix)?;
    if let Some((line, stated)) = &keys.unit {
        let other: AccelerationUnit = stated.parse()?;
        if other != unit {
            return Err(source.error(
                *line,
                0,
                format!("unit \"{stated}\" contradicts the column header \"{text}\""),
                "make both the same",
            ));
        }
    }
    let Some(step) = keys.step.or(source.options.time_step) else {
        return Err(GroundMotionError::MissingTimeStep {
            file: source.file.to_owned(),
            line: header.number,
        });
    };
    let first = lines.number() + 1;
    let samples = rows(source, &mut lines, step)?;
    let mut draft = Draft::new(
        samples,
        DraftUnit::Stated(SeriesUnit::from(unit)),
        (header.number, first, lines.number()),
    );
    draft.times = Times::Step(keys.step);
    draft.title = keys.title.join("; ");
    draft.component = keys.component;
    let mut series = draft.finish(source)?;
    series.origin.history = keys.history;
    Ok(vec![series])
}

impl Keys {
    fn take(&mut self, source: &Source<'_>, line: Line<'_>) -> Result<(), GroundMotionError> {
        let text = line.columns(1, line.bytes.len());
        let Some((key, value)) = text.split_once(':') else {
            return Ok(());
        };
        let value = value.trim();
        match key.trim() {
            "Event" | "Station" => self.title.push(value.to_owned()),
            "Component" => value.clone_into(&mut self.component),
            "Source" | "Step" | "Read" | "Note" => self.history.push(text.trim().to_owned()),
            "Unit" => self.unit = Some((line.number, value.to_owned())),
            "dt" => {
                let number = value.strip_suffix('s').unwrap_or(value);
                self.step = Some(source.number(line, 0, number.as_bytes())?);
            }
            _ => {}
        }
        Ok(())
    }
}

fn unit_of_header(suffix: &str) -> Result<AccelerationUnit, GroundMotionError> {
    match suffix {
        "m_s2" => Ok(AccelerationUnit::MetrePerSecondSquared),
        "cm_s2" => Ok(AccelerationUnit::Gal),
        other => other.parse(),
    }
}

fn rows(
    source: &Source<'_>,
    lines: &mut Lines<'_>,
    step: f64,
) -> Result<Vec<f64>, GroundMotionError> {
    let mut samples = Vec::with_capacity(lines.remaining() / 4 + 1);
    for line in lines {
        if line.is_blank() || line.bytes.starts_with(b"#") {
            continue;
        }
        let mut row = line.bytes.split(|b| *b == b',');
        let (Some(time), Some(value), None) = (row.next(), row.next(), row.next()) else {
            return Err(source.error(
                line.number,
                0,
                "there must be two columns, time and acceleration",
                REMEDY,
            ));
        };
        let expected = samples.len() as f64 * step;
        let found = source.number(line, 0, time)?;
        // Half the step, or what the time's digits leave open.
        if (found - expected).abs() > (0.51 * step).min(1.01 * number::resolution(time) + 1e-9) {
            return Err(source.error(
                line.number,
                0,
                format!(
                    "time {found} s where {} s follows from dt = {step} s",
                    bound(expected)
                ),
                "a row is missing or dt is wrong",
            ));
        }
        samples.push(source.number(line, time.len() + 1, value)?);
    }
    Ok(samples)
}
