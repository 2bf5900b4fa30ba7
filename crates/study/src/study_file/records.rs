//! The motions of a study: files, and synthetic motions from seeds.

use std::f64::consts::TAU;
use std::path::Path;

use pounding_case::{Case, Dimension};
use pounding_ground_motion::generators::{RezaeianDerKiureghian2010, TimeGrid};

use super::context::Context;
use super::reader::{Reader, Result, Table, Value, Wrong};
use super::{RecordKind, RecordSource};
use crate::case_text::{Edits, apply, options_of_motion};

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
pub(super) fn records(table: &Table<'_, '_>, context: &Context<'_>) -> Result<Vec<RecordSource>> {
    let reader = table.reader;
    let files = table.or("records", Vec::new(), |value| {
        let items = reader.list(value, "records")?;
        let read = |item| Ok((record(&reader, item, context)?, Value::span(item)));
        reader.all(items.iter().map(read))
    });
    let made = table.or("synthetic", Vec::new(), |value| {
        let made = synthetic(&reader, value)?;
        Ok(made.into_iter().map(|m| (m, value.span())).collect())
    });
    let (files, made) = (reader.keep(files), reader.keep(made));
    let (mut records, made) = files.zip(made).ok_or(Wrong::Recorded)?;
    records.extend(made);
    for (i, (record, place)) in records.iter().enumerate() {
        if records[..i].iter().any(|(r, _)| r.name == record.name) {
            return Err(reader.error(
                place.clone(),
                format!("two records have the name \"{}\"", record.name),
                "write { name = \"...\", file = \"...\" }",
            ));
        }
    }
    Ok(records.into_iter().map(|(record, _)| record).collect())
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

fn record(reader: &Reader<'_>, item: &Value<'_>, context: &Context<'_>) -> Result<RecordSource> {
    // What the case file would hold, a line each, as it is written here.
    let mut lines = String::new();
    let (mut name, mut file, mut processed) = (None, None, false);
    if item.get_ref().as_str().is_some() {
        file = Some(reader.text(item, "records")?);
    } else {
        let table = reader.table(item, "a record", &RECORD)?;
        for (key, value) in table.entries() {
            match key.as_str() {
                "name" => name = reader.keep(reader.text(value, "name")),
                "file" => file = reader.keep(reader.text(value, "file")),
                // Said before.
                key if !RECORD.contains(&key) => {}
                _ => {
                    processed |= key == "process";
                    lines.push_str(&format!("\n{key} = {}", &reader.source[value.span()]));
                }
            }
        }
        table.required("file")?;
        if file.is_none() {
            return Err(Wrong::Recorded);
        }
    }
    let file = file.unwrap_or_default();
    let path = context.folder.join(&file);
    let path = std::path::absolute(&path).unwrap_or(path);
    let shown = toml::Value::String(path.display().to_string()).to_string();
    let new = format!("\nfile = {shown}{lines}");
    let lost = |(message, help): (String, String)| reader.error(item.span(), message, help);
    let base = &context.base()?.case;
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
    let model = table.required("model").and_then(|model| {
        if reader.text(model, "model")? == "rezaeian_der_kiureghian_2010" {
            return Ok(());
        }
        Err(reader.error(
            model.span(),
            "unknown model of motions",
            "known is rezaeian_der_kiureghian_2010; motions of others are read from files",
        ))
    });
    let model = reader.keep(model);
    // An angle per second, such as "15.6 rad/s", is a circular frequency.
    let number = |value: &Value<'_>, key: &str, dimension| {
        let text = value.get_ref().as_str().unwrap_or_default();
        let angle = dimension == Dimension::FREQUENCY && text.contains("rad");
        let turns = if angle { TAU } else { 1.0 };
        Ok(reader.quantity(value, key, dimension)? / turns)
    };
    let needed = |key, dimension| {
        let value = table.required(key);
        reader.keep(value.and_then(|v| number(v, key, dimension)))
    };
    let or = |key, dimension, default| {
        reader.keep(table.or(key, default, |v| number(v, key, dimension)))
    };
    let count = table.required("count");
    let count = reader.keep(count.and_then(|v| reader.count(v, "count", 1)));
    let first = reader.keep(table.or("seed", 1, |v| reader.count(v, "seed", 0)));
    let duration = needed("duration", Dimension::TIME);
    let time_step = or("time_step", Dimension::TIME, TimeGrid::USUAL_TIME_STEP);
    let significant_duration = needed("significant_duration", Dimension::TIME);
    let middle_time = needed("middle_time", Dimension::TIME);
    let middle_frequency = needed("middle_frequency", Dimension::FREQUENCY);
    // What stands in for a missing one is not seen: all are read, and nothing is made.
    let usual = RezaeianDerKiureghian2010::usual(
        significant_duration.unwrap_or(1.0),
        middle_time.unwrap_or(1.0),
        middle_frequency.unwrap_or(1.0),
    );
    let arias_intensity = or(
        "arias_intensity",
        Dimension::VELOCITY,
        usual.arias_intensity,
    );
    let frequency_rate = or("frequency_rate", per_second_squared(), usual.frequency_rate);
    let damping = or("damping", Dimension::NUMBER, usual.damping);
    let high_pass = or("high_pass", Dimension::FREQUENCY, usual.high_pass);
    let read = [significant_duration, middle_time, middle_frequency];
    let (
        Some(()),
        true,
        Some(arias_intensity),
        Some(frequency_rate),
        Some(damping),
        Some(high_pass),
        Some(time_step),
        Some(duration),
        Some(count),
        Some(first),
    ) = (
        model,
        read.iter().all(Option::is_some),
        arias_intensity,
        frequency_rate,
        damping,
        high_pass,
        time_step,
        duration,
        count,
        first,
    )
    else {
        return Err(Wrong::Recorded);
    };
    let motion = RezaeianDerKiureghian2010 {
        arias_intensity,
        frequency_rate,
        damping,
        high_pass,
        ..usual
    };
    let grid = TimeGrid {
        time_step,
        duration,
    };
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
