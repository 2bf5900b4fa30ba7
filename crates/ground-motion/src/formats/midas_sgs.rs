//! midas ground-motion files (`.sgs`): `*SGSw`, `*TITLE`, `*UNIT&TYPE`, `*DATA`,
//! then rows of time and acceleration.

use crate::cut_numbers::Forms;
use crate::draft::{Draft, DraftUnit};
use crate::error::GroundMotionError;
use crate::format::Format;
use crate::number;
use crate::quantity::{Quantity, SeriesUnit};
use crate::recording::Series;
use crate::source::Source;
use crate::text::Line;
use crate::time_column::TimeColumn;

const REMEDY: &str = "the header contradicts itself: correct it, or get the file again";

pub(super) static FORMAT: Format = Format {
    name: "midas_sgs",
    title: "midas ground-motion file, sgs",
    source: "MIDAS IT",
    recognised_by: "a first line that starts with *SGS",
};

pub(super) fn matches(source: &Source<'_>) -> bool {
    source.first_line().trim_start().starts_with("*sgs")
}

/// What stands in the last brackets of a label, `Ground Accel. (g)`.
fn in_brackets(label: &str) -> Option<&str> {
    let (_, rest) = label.rsplit_once('(')?;
    Some(rest.split(')').next().unwrap_or(rest).trim())
}

/// Whether a line in lower case labels an axis of a spectrum.
fn is_of_spectrum(line: &str) -> bool {
    let of = |axis: &str, words: &[&str]| {
        let label = line.strip_prefix(axis);
        label.is_some_and(|label| words.iter().any(|word| label.contains(word)))
    };
    of("*x-axis", &["period", "freq"]) || of("*y-axis", &["spectr"])
}

/// Refuses a label of the times that says another unit than seconds.
fn time_in_seconds(
    source: &Source<'_>,
    line: Line<'_>,
    label: &str,
) -> Result<(), GroundMotionError> {
    let others = [
        "ms",
        "msec",
        "msecs",
        "millisecond",
        "milliseconds",
        "min",
        "minutes",
        "hz",
    ];
    match in_brackets(label).filter(|unit| others.contains(&unit.trim_end_matches('.'))) {
        Some(unit) => Err(source.error(
            line.number,
            0,
            format!("the label of the times says \"{unit}\", where the format has seconds"),
            REMEDY,
        )),
        None => Ok(()),
    }
}

pub(super) fn read(source: &Source<'_>) -> Result<Vec<Series>, GroundMotionError> {
    let mut lines = source.lines();
    let mut title = String::new();
    let (mut unit, mut label) = (None, None);
    loop {
        let line = source.expect(&mut lines, "*DATA")?;
        let lower = line.lower();
        let start = lower.trim_start();
        if start.starts_with("*data") {
            break;
        } else if let Some(text) = start.strip_prefix("*title") {
            title = text.trim_matches([',', ' ']).to_owned();
        } else if let Some(text) = start.strip_prefix("*unit&type") {
            let mut words = text.split(',').map(str::trim).filter(|w| !w.is_empty());
            let word = words.next().unwrap_or_default();
            if let Some(kind) = words.next().filter(|k| !k.starts_with("acc")) {
                return Err(GroundMotionError::Unsupported {
                    file: source.file.to_owned(),
                    what: format!("the file holds {kind}, not acceleration"),
                    remedy: "use the file of the accelerations",
                });
            }
            unit = match word {
                "grav" => Some(SeriesUnit::G),
                other => SeriesUnit::parse(other),
            };
            if let Some(other) = unit.filter(|u| u.quantity != Quantity::Acceleration) {
                return Err(source.error(
                    line.number,
                    0,
                    format!(
                        "accelerations in {}, a unit of {}",
                        other.symbol, other.quantity
                    ),
                    REMEDY,
                ));
            }
        } else if is_of_spectrum(start) {
            return Err(source.error(
                line.number,
                0,
                format!(
                    "\"{}\" is the axis of a spectrum: the file holds no record",
                    number::shown(line.bytes.trim_ascii())
                ),
                "give the accelerations over the time; if the label alone is wrong, correct it",
            ));
        } else if start.starts_with("*x-axis") {
            time_in_seconds(source, line, start)?;
        } else if start.starts_with("*y-axis") {
            label = in_brackets(start)
                .and_then(SeriesUnit::parse)
                .map(|unit| (line, unit));
        }
    }
    let unit = match (unit, label) {
        (Some(unit), Some((line, other))) if unit != other => {
            return Err(source.error(
                line.number,
                0,
                format!(
                    "the label of the values says {}, but *UNIT&TYPE {}",
                    other.symbol, unit.symbol
                ),
                REMEDY,
            ));
        }
        (Some(unit), _) => DraftUnit::Stated(unit),
        (None, Some((line, other))) if source.options.unit.is_some_and(|u| !other.is(u)) => {
            return Err(source.error(
                line.number,
                0,
                format!(
                    "the label of the values says {}, which the unit that is given is not",
                    other.symbol
                ),
                REMEDY,
            ));
        }
        (None, _) => DraftUnit::Unstated,
    };
    let data = lines.number();
    let mut times = TimeColumn::with_capacity(lines.remaining() / 4 + 1);
    let mut samples = Vec::with_capacity(lines.remaining() / 4 + 1);
    let mut forms = Forms::default();
    let mut ends = false;
    while let Some(line) = lines.next() {
        if line.is_blank() {
            continue;
        }
        if line.bytes.trim_ascii_start().starts_with(b"*") {
            let is_end = line.lower().trim_start().starts_with("*end");
            if let Some(line) = (!is_end).then_some(line).or(lines.text_ahead()) {
                return Err(source.second_series(line));
            }
            ends = true;
            break;
        }
        let mut fields = line.fields();
        let (Some(time), Some(value), None) = (fields.next(), fields.next(), fields.next()) else {
            return Err(source.error(
                line.number,
                0,
                "there must be two columns, time and acceleration",
                "correct the row",
            ));
        };
        times.push(line, source.number(line, time.0, time.1)?, time.1);
        samples.push(source.number(line, value.0, value.1)?);
        forms.see(line.number, value.0, value.1);
    }
    forms.are_whole(source)?;
    let mut draft = Draft::new(samples, unit, (data, data + 1, lines.number()));
    if !ends {
        let message = "the file ends without *ENDDATA";
        if !source.options.lenient {
            return Err(source.error(
                lines.number(),
                0,
                message,
                "the file is probably truncated: get it again, or set `lenient = true` to use what is there",
            ));
        }
        draft.warnings.push(message.to_owned());
    }
    draft.title = title;
    draft.first_time = times.first();
    draft.times = times.finish(source, draft.lines.1, &mut draft.warnings)?;
    Ok(vec![draft.finish(source)?])
}
