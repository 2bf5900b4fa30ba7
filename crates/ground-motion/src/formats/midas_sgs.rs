//! midas ground-motion files (`.sgs`): `*SGSw`, `*TITLE`, `*UNIT&TYPE`, `*DATA`,
//! then rows of time and acceleration.

use crate::draft::{Draft, DraftUnit};
use crate::error::GroundMotionError;
use crate::formats::Format;
use crate::quantity::SeriesUnit;
use crate::recording::Series;
use crate::source::Source;
use crate::time_column::TimeColumn;

pub(super) static FORMAT: Format = Format {
    name: "midas_sgs",
    title: "midas ground-motion file, sgs",
    source: "MIDAS IT",
    recognised_by: "a first line that starts with *SGS",
    matches,
    read,
};

fn matches(source: &Source<'_>) -> bool {
    source.first_line().trim_start().starts_with("*sgs")
}

fn read(source: &Source<'_>) -> Result<Vec<Series>, GroundMotionError> {
    let mut lines = source.lines();
    let mut title = String::new();
    let mut unit = DraftUnit::Unstated;
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
                "grav" => DraftUnit::Stated(SeriesUnit::G),
                other => SeriesUnit::parse(other).map_or(DraftUnit::Unstated, DraftUnit::Stated),
            };
        }
    }
    let data = lines.number();
    let mut times = TimeColumn::with_capacity(lines.remaining() / 4 + 1);
    let mut samples = Vec::with_capacity(lines.remaining() / 4 + 1);
    for line in lines.by_ref() {
        if line.is_blank() {
            continue;
        }
        if line.bytes.trim_ascii_start().starts_with(b"*") {
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
        times.push(source.number(line, time.0, time.1)?, time.1);
        samples.push(source.number(line, value.0, value.1)?);
    }
    let mut draft = Draft::new(samples, unit, (data, data + 1, lines.number()));
    draft.title = title;
    draft.times = times.finish(source, draft.lines.1, &mut draft.warnings)?;
    Ok(vec![draft.finish(source)?])
}
