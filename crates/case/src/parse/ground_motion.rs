//! The record of a case and what is done to it.

use std::f64::consts::TAU;
use std::path::PathBuf;

use toml::Spanned;
use toml::de::DeValue;

use crate::error::{CaseError, Errors};
use crate::parse::not_negative;
use crate::parse::scale::scale;
use crate::process::{BaselineKind, ProcessStep, RemovedOffset};
use crate::reader::{Reader, Table, Value};
use crate::schema;
use crate::types::{GroundMotion, Located, Offset, Rotation, Scale};
use crate::units::Dimension;

/// Counts per m/s2.
const SENSITIVITY: Dimension = Dimension {
    mass: 0.0,
    length: -1.0,
    time: 2.0,
};

/// In place of a motion of which nothing could be read.
pub(super) fn unknown() -> GroundMotion {
    GroundMotion {
        file: no_file(),
        format: None,
        time_step: None,
        unit: None,
        layout: None,
        component: None,
        rotation: None,
        quantity: None,
        skip_lines: 0,
        skip_columns: 0,
        prepend_zero: false,
        lenient: false,
        sensitivity: None,
        gravity: None,
        offset: Offset::Automatic,
        process: Vec::new(),
        scale: Scale::None,
    }
}

/// In place of a file name that could not be read.
fn no_file() -> Located<PathBuf> {
    Located {
        value: PathBuf::new(),
        span: 0..0,
    }
}

pub(crate) fn ground_motion(
    reader: &Reader<'_>,
    value: &Value<'_>,
) -> Result<GroundMotion, CaseError> {
    let table = reader.section(value, "[ground_motion]", schema::GROUND_MOTION)?;
    let keep = reader.errors;
    let file = keep.keep(table.required("file").and_then(|v| path(reader, v, "file")));
    let text = |key: &str| keep.or_default(table.optional_text(key));
    let plain = |key: &str| text(key).map(|t| t.value);
    let positive = |key: &str, dimension| keep.or_default(table.optional_positive(key, dimension));
    let flag = |key: &str| keep.or_default(table.flag(key));
    let count =
        |key: &str| keep.or_default(table.get(key).map_or(Ok(0), |v| reader.count(v, key, 0)));
    let process = table.get("process").map(|v| process(reader, v)).transpose();
    let scale = table
        .get("scale")
        .map_or(Ok(Scale::None), |v| scale(reader, v));
    Ok(GroundMotion {
        file: file.unwrap_or_else(no_file),
        format: text("format"),
        time_step: positive("time_step", Dimension::TIME),
        unit: text("unit"),
        layout: plain("layout"),
        component: plain("component"),
        rotation: keep.or_default(rotation(reader, &table)),
        quantity: text("quantity"),
        skip_lines: count("skip_lines"),
        skip_columns: count("skip_columns"),
        prepend_zero: flag("prepend_zero"),
        lenient: flag("lenient"),
        sensitivity: positive("sensitivity", SENSITIVITY),
        gravity: positive("gravity", Dimension::ACCELERATION),
        offset: keep
            .keep(offset(reader, &table))
            .unwrap_or(Offset::Automatic),
        process: keep.or_default(process).unwrap_or_default(),
        scale: keep.keep(scale).unwrap_or(Scale::None),
    })
}

/// Reads a text `process = [...]`, the same list as in a case file: for programs that
/// offer the steps elsewhere. `name` stands in messages.
///
/// # Errors
/// All that is wrong in the text, with its places.
pub fn process_steps(source: &str, name: &str) -> Result<Vec<Located<ProcessStep>>, CaseError> {
    let errors = Errors::default();
    let reader = Reader {
        file: name,
        source,
        errors: &errors,
    };
    let read = reader
        .document("write process = [{ remove_offset = \"mean\" }, ...]")
        .and_then(|tree| {
            let root = Table::new(reader, tree.get_ref(), 0..0, "the steps", schema::STEPS);
            process(&reader, root.required("process")?)
        });
    errors.finish(read)
}

pub(super) fn path(
    reader: &Reader<'_>,
    value: &Value<'_>,
    key: &str,
) -> Result<Located<PathBuf>, CaseError> {
    let file = reader.text(value, key)?;
    if file.value.is_empty() {
        return Err(reader.error(
            file.span,
            format!("`{key}` is empty"),
            "name the file, relative to the folder of the case file",
        ));
    }
    Ok(Located {
        value: PathBuf::from(file.value),
        span: file.span,
    })
}

/// One of some words.
fn word<T: Copy>(
    reader: &Reader<'_>,
    value: &Value<'_>,
    key: &str,
    words: &[(&str, T)],
) -> Result<T, CaseError> {
    let text = reader.text(value, key)?;
    let found = words.iter().find(|(w, _)| *w == text.value);
    found.map(|(_, meaning)| *meaning).ok_or_else(|| {
        let known: Vec<_> = words.iter().map(|(w, _)| format!("\"{w}\"")).collect();
        reader.error(
            text.span,
            format!("`{key}` cannot be \"{}\"", text.value),
            format!("write {}", known.join(" or ")),
        )
    })
}

fn offset(reader: &Reader<'_>, table: &Table<'_, '_>) -> Result<Offset, CaseError> {
    let words = [
        ("automatic", Offset::Automatic),
        ("keep", Offset::Keep),
        ("remove", Offset::Remove),
    ];
    table
        .get("offset")
        .map_or(Ok(Offset::Automatic), |v| word(reader, v, "offset", &words))
}

fn rotation(reader: &Reader<'_>, table: &Table<'_, '_>) -> Result<Option<Rotation>, CaseError> {
    const EXAMPLE: &str =
        "for example component = \"360\", second_component = \"90\", rotate = 30, in degrees";
    for key in ["second_component", "rotate"] {
        table.misspelt(key).map_or(Ok(()), Err)?;
    }
    match (table.get("second_component"), table.get("rotate")) {
        (None, None) => Ok(None),
        (Some(second), Some(angle)) => {
            let turn = reader.any_quantity(angle, "rotate")?;
            if turn.dimension.is_some() {
                let message = "`rotate` is a plain number of degrees";
                return Err(reader.error(angle.span(), message, EXAMPLE));
            }
            Ok(Some(Rotation {
                second_component: reader.text(second, "second_component")?,
                angle: turn.value,
            }))
        }
        (one, other) => Err(reader.error(
            one.or(other).map_or(0..0, Spanned::span),
            "`rotate` and `second_component` belong together",
            EXAMPLE,
        )),
    }
}

fn process(reader: &Reader<'_>, value: &Value<'_>) -> Result<Vec<Located<ProcessStep>>, CaseError> {
    let DeValue::Array(items) = value.get_ref() else {
        return Err(reader.wrong_type(value, "process", "a list of steps"));
    };
    let steps = items.iter().map(|item| step(reader, item));
    reader.errors.all(steps)
}

fn step(reader: &Reader<'_>, item: &Value<'_>) -> Result<Located<ProcessStep>, CaseError> {
    let table = reader.table(item, "a step of `process`", schema::PROCESS)?;
    let entries = table.entries();
    let [(key, value)] = entries.as_slice() else {
        return Err(reader.error(
            item.span(),
            format!("a step of `process` has one key, not {}", entries.len()),
            "write one table per step: [{ remove_offset = \"mean\" }, { pad = { after = \"10 s\" } }]",
        ));
    };
    let made = match key.value.as_str() {
        "true_unit" => ProcessStep::Unit(reader.text(value, "true_unit")?),
        "sign" => {
            word(reader, value, "sign", &[("reversed", ())]).map(|()| ProcessStep::ReverseSign)?
        }
        "remove_offset" => ProcessStep::RemoveOffset(removed(reader, value)?),
        "filter" => filter(reader, value)?,
        "baseline" => ProcessStep::Baseline(baseline(reader, value)?),
        "trim" => trim(reader, value)?,
        "taper" => {
            let [start, end] = lengths(reader, value, "taper", schema::TAPER)?;
            ProcessStep::Taper { start, end }
        }
        "pad" => {
            let [before, after] = lengths(reader, value, "pad", schema::PAD)?;
            ProcessStep::Pad { before, after }
        }
        "resample" => resample(reader, value)?,
        _ => ProcessStep::Scale(scale(reader, value)?),
    };
    Ok(Located {
        value: made,
        span: item.span(),
    })
}

fn removed(reader: &Reader<'_>, value: &Value<'_>) -> Result<RemovedOffset, CaseError> {
    if !matches!(value.get_ref(), DeValue::Table(_)) {
        return word(
            reader,
            value,
            "remove_offset",
            &[("mean", RemovedOffset::Mean)],
        );
    }
    let table = reader.table(value, "remove_offset", schema::REMOVE_OFFSET)?;
    match (table.get("pre_event"), table.get("value")) {
        (Some(v), None) => {
            let length = reader.positive(v, "pre_event", Dimension::TIME)?;
            Ok(RemovedOffset::PreEventMean(length))
        }
        (None, Some(v)) => {
            let value = reader.quantity(v, "value", Dimension::ACCELERATION)?;
            Ok(RemovedOffset::Value(value))
        }
        _ => Err(one_of(
            reader,
            value,
            "remove_offset",
            "`pre_event` or `value`",
        )),
    }
}

fn one_of(reader: &Reader<'_>, value: &Value<'_>, name: &str, keys: &str) -> CaseError {
    reader.error(
        value.span(),
        format!("`{name}` needs {keys}, and nothing of the other kinds"),
        "write each kind as a step of its own",
    )
}

fn filter(reader: &Reader<'_>, value: &Value<'_>) -> Result<ProcessStep, CaseError> {
    let table = reader.table(value, "filter", schema::FILTER)?;
    let corner = |key: &str| -> Result<Option<f64>, CaseError> {
        let found = table.optional_positive(key, Dimension::FREQUENCY)?;
        // An angle per second is a circular frequency.
        let circular = table
            .get(key)
            .is_some_and(|v| matches!(v.get_ref(), DeValue::String(text) if text.contains("rad")));
        Ok(found.map(|f| if circular { f / TAU } else { f }))
    };
    let (high_pass, low_pass) = (corner("high_pass")?, corner("low_pass")?);
    if high_pass.is_none() && low_pass.is_none() {
        return Err(one_of(
            reader,
            value,
            "filter",
            "`high_pass`, `low_pass` or both",
        ));
    }
    Ok(ProcessStep::Filter {
        order: table
            .get("order")
            .map_or(Ok(4), |v| reader.count(v, "order", 1))?,
        high_pass,
        low_pass,
        causal: table.get("phase").map_or(Ok(false), |v| {
            word(reader, v, "phase", &[("zero", false), ("causal", true)])
        })?,
        keep_pads: table
            .get("keep_pads")
            .map_or(Ok(true), |v| reader.boolean(v, "keep_pads"))?,
    })
}

fn baseline(reader: &Reader<'_>, value: &Value<'_>) -> Result<BaselineKind, CaseError> {
    let table = reader.table(value, "baseline", schema::BASELINE)?;
    let degree = |key: &str, least| {
        let read = |v| reader.count(v, key, least);
        table.get(key).map(read).transpose()
    };
    let time = |key: &str| {
        let read = |v| not_negative(reader, v, key, Dimension::TIME);
        table.get(key).map(read).transpose()
    };
    let (acceleration, velocity) = (degree("acceleration", 0)?, degree("velocity", 1)?);
    let (start, end, fit_from) = (time("start")?, time("end")?, time("fit_from")?);
    let threshold = table.optional_positive("threshold", Dimension::ACCELERATION)?;
    match (acceleration, velocity, start, end, threshold, fit_from) {
        (Some(degree), None, None, None, None, None) => Ok(BaselineKind::Acceleration(degree)),
        (None, Some(degree), None, None, None, None) => Ok(BaselineKind::Velocity(degree)),
        (None, None, Some(start), Some(end), None, fit_from) => Ok(BaselineKind::Segments {
            start,
            end,
            fit_from,
        }),
        (None, None, None, None, Some(threshold), fit_from) => Ok(BaselineKind::Threshold {
            threshold,
            fit_from,
        }),
        _ => Err(one_of(
            reader,
            value,
            "baseline",
            "`acceleration` or `velocity` (a degree), `start` with `end`, or `threshold`",
        )),
    }
}

fn trim(reader: &Reader<'_>, value: &Value<'_>) -> Result<ProcessStep, CaseError> {
    let table = reader.table(value, "trim", schema::TRIM)?;
    let time = |key: &str| {
        let read = |v| not_negative(reader, v, key, Dimension::TIME);
        table.get(key).map(read).transpose()
    };
    let part = |key: &str| table.optional_positive(key, Dimension::NUMBER);
    let times = (time("start")?, time("end")?);
    let parts = (part("arias_from")?, part("arias_to")?);
    match (times, parts) {
        ((start, Some(end)), (None, None)) => Ok(ProcessStep::TrimTimes {
            start: start.unwrap_or(0.0),
            end,
        }),
        ((None, None), (Some(from), Some(to))) => Ok(ProcessStep::TrimArias { from, to }),
        _ => Err(one_of(
            reader,
            value,
            "trim",
            "`end` (and `start`), or `arias_from` with `arias_to`",
        )),
    }
}

/// Two lengths of time, zero where they are not given, not both.
fn lengths(
    reader: &Reader<'_>,
    value: &Value<'_>,
    name: &str,
    keys: &'static [schema::Key],
) -> Result<[f64; 2], CaseError> {
    let table = reader.table(value, name, keys)?;
    let mut found = [0.0; 2];
    for (length, key) in found.iter_mut().zip(keys) {
        if let Some(v) = table.get(key.name) {
            *length = not_negative(reader, v, key.name, Dimension::TIME)?;
        }
    }
    if found == [0.0; 2] {
        let either = format!("`{}`, `{}` or both", keys[0].name, keys[1].name);
        return Err(one_of(reader, value, name, &either));
    }
    Ok(found)
}

fn resample(reader: &Reader<'_>, value: &Value<'_>) -> Result<ProcessStep, CaseError> {
    let table = reader.table(value, "resample", schema::RESAMPLE)?;
    let words = [("linear", false), ("band_limited", true)];
    Ok(ProcessStep::Resample {
        time_step: reader.positive(table.required("time_step")?, "time_step", Dimension::TIME)?,
        band_limited: table
            .get("interpolation")
            .map_or(Ok(false), |v| word(reader, v, "interpolation", &words))?,
    })
}
