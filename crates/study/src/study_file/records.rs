//! The motions of a study: files, and synthetic motions from seeds.

use std::f64::consts::TAU;
use std::path::Path;

use pounding_case::{Case, Dimension};
use pounding_ground_motion::generators::{RezaeianDerKiureghian2010, TimeGrid};

use super::reader::{Reader, Result, Table, Value};
use super::{RecordKind, RecordSource};
use crate::case_text::{Edits, apply, options_of_motion};
use crate::error::StudyError;

/// Keys of a record beside `name`: those of `[ground_motion]` but `scale`.
const RECORD: [&str; 18] = [
    "name",
    "file",
    "format",
    "time_step",
    "unit",
    "layout",
    "component",
    "second_component",
    "rotate",
    "quantity",
    "skip_lines",
    "skip_columns",
    "prepend_zero",
    "lenient",
    "sensitivity",
    "gravity",
    "offset",
    "process",
];

/// Reads `records` and `synthetic` of a variable.
pub(super) fn records(
    table: &Table<'_, '_>,
    base: &Case,
    folder: &Path,
) -> Result<Vec<RecordSource>> {
    let reader = table.reader;
    let mut records: Vec<RecordSource> = Vec::new();
    let mut places = Vec::new();
    if let Some(value) = table.get("records") {
        let items = reader.list(value, "records")?;
        records = reader.all(items.iter().map(|item| record(&reader, item, base, folder)))?;
        places.extend(items.iter().map(|item| item.span()));
    }
    if let Some(value) = table.get("synthetic") {
        records.extend(synthetic(&reader, value)?);
        places.resize(records.len(), value.span());
    }
    for (i, record) in records.iter().enumerate() {
        if records[..i].iter().any(|r| r.name == record.name) {
            return Err(reader.error(
                places[i].clone(),
                format!("two records have the name \"{}\"", record.name),
                "write { name = \"...\", file = \"...\" }",
            ));
        }
    }
    Ok(records)
}

/// The record that the case itself names.
pub(super) fn of_case(base: &Case) -> RecordSource {
    let file = &base.ground_motion.file.value;
    RecordSource {
        name: stem(file),
        kind: RecordKind::File {
            case: Box::new(base.clone()),
            edits: Edits::new(),
        },
    }
}

fn stem(file: &Path) -> String {
    file.file_stem()
        .unwrap_or_default()
        .to_string_lossy()
        .into_owned()
}

fn record(
    reader: &Reader<'_>,
    item: &Value<'_>,
    base: &Case,
    folder: &Path,
) -> Result<RecordSource> {
    // What the case file would hold, a line each, as it is written here.
    let mut lines = String::new();
    let (mut name, mut file, mut processed) = (None, None, false);
    if item.get_ref().as_str().is_some() {
        file = Some(reader.text(item, "records")?);
    } else {
        let table = reader.table(item, "a record", &RECORD)?;
        table.required("file")?;
        for (key, value) in table.entries() {
            match key.as_str() {
                "name" => name = Some(reader.text(value, "name")?),
                "file" => file = Some(reader.text(value, "file")?),
                _ => {
                    processed |= key == "process";
                    lines.push_str(&format!("\n{key} = {}", &reader.source[value.span()]));
                }
            }
        }
    }
    let file = file.unwrap_or_default();
    let path = folder.join(&file);
    let path = std::path::absolute(&path).unwrap_or(path);
    let shown = toml::Value::String(path.display().to_string()).to_string();
    let new = format!("\nfile = {shown}{lines}");
    let lost = |(message, help): (String, String)| reader.error(item.span(), message, help);
    // What the case does to its own record it does to all, unless one says otherwise.
    let kept: &[&str] = if processed {
        &["scale"]
    } else {
        &["scale", "process"]
    };
    let (old, header) = options_of_motion(&base.source, kept).map_err(lost)?;
    let mut edits: Edits = old
        .into_iter()
        .map(|place| (place, String::new()))
        .collect();
    edits.push((header..header, new));
    let case = Case::parse(&apply(&base.source, edits.clone()), &base.file);
    let case = case.map_err(|e| {
        let help = e.help.unwrap_or_default();
        reader.error(
            item.span(),
            format!("in a case, this record: {}", e.message),
            help,
        )
    })?;
    Ok(RecordSource {
        name: name.unwrap_or_else(|| stem(Path::new(&file))),
        kind: RecordKind::File {
            case: Box::new(case),
            edits,
        },
    })
}

const SYNTHETIC: [&str; 12] = [
    "model",
    "count",
    "seed",
    "time_step",
    "duration",
    "arias_intensity",
    "significant_duration",
    "middle_time",
    "middle_frequency",
    "frequency_rate",
    "damping",
    "high_pass",
];

/// Motions of consecutive seeds.
fn synthetic(reader: &Reader<'_>, value: &Value<'_>) -> Result<Vec<RecordSource>> {
    let table = reader.table(value, "synthetic", &SYNTHETIC)?;
    let model = table.required("model")?;
    if reader.text(model, "model")? != "rezaeian_der_kiureghian_2010" {
        return Err(reader.error(
            model.span(),
            "unknown model of motions",
            "known is rezaeian_der_kiureghian_2010; motions of others are read from files",
        ));
    }
    let read = |key: &str, dimension| reader.quantity(table.required(key)?, key, dimension);
    let or = |key: &str, dimension, default: f64| match table.get(key) {
        Some(v) => reader.quantity(v, key, dimension),
        None => Ok(default),
    };
    // An angle per second, such as "15.6 rad/s", is a circular frequency.
    let frequency = |value: &Value<'_>, key: &str| {
        let text = value.get_ref().as_str().unwrap_or_default();
        let turns = if text.contains("rad") { TAU } else { 1.0 };
        Ok::<_, StudyError>(reader.quantity(value, key, Dimension::FREQUENCY)? / turns)
    };
    let usual = RezaeianDerKiureghian2010::usual(
        read("significant_duration", Dimension::TIME)?,
        read("middle_time", Dimension::TIME)?,
        frequency(table.required("middle_frequency")?, "middle_frequency")?,
    );
    let motion = RezaeianDerKiureghian2010 {
        arias_intensity: or(
            "arias_intensity",
            Dimension::VELOCITY,
            usual.arias_intensity,
        )?,
        frequency_rate: or("frequency_rate", per_second_squared(), usual.frequency_rate)?,
        damping: or("damping", Dimension::NUMBER, usual.damping)?,
        high_pass: match table.get("high_pass") {
            Some(v) => frequency(v, "high_pass")?,
            None => usual.high_pass,
        },
        ..usual
    };
    let grid = TimeGrid {
        time_step: or("time_step", Dimension::TIME, TimeGrid::USUAL_TIME_STEP)?,
        duration: read("duration", Dimension::TIME)?,
    };
    let count = reader.count(table.required("count")?, "count", 1)?;
    let first = table
        .get("seed")
        .map_or(Ok(1), |v| reader.count(v, "seed", 0))?;
    (first..first + count)
        .map(|seed| {
            let made = motion.generate(grid, seed as u64).map_err(|e| {
                reader.error(value.span(), e.to_string(), e.help().unwrap_or_default())
            })?;
            Ok(RecordSource {
                name: format!("seed_{seed}"),
                kind: RecordKind::Made {
                    record: Box::new(made.accelerogram),
                    command: command(&motion, grid, seed),
                },
            })
        })
        .collect()
}

/// The command that writes such a motion into a file; numbers to the last bit.
fn command(motion: &RezaeianDerKiureghian2010, grid: TimeGrid, seed: usize) -> String {
    let options = [
        ("arias-intensity", motion.arias_intensity),
        ("significant-duration", motion.significant_duration),
        ("middle-time", motion.middle_time),
        ("middle-frequency", motion.middle_frequency),
        ("frequency-rate", motion.frequency_rate),
        ("filter-damping", motion.damping),
        ("high-pass", motion.high_pass),
        ("time-step", grid.time_step),
        ("duration", grid.duration),
    ];
    let options = options.map(|(name, value)| format!("--{name} {value:?}"));
    format!(
        "pounding motion synth rezaeian_der_kiureghian_2010 {} --seed {seed}",
        options.join(" ")
    )
}

/// Hz/s.
fn per_second_squared() -> Dimension {
    Dimension {
        mass: 0.0,
        length: 0.0,
        time: -2.0,
    }
}
