//! Variables: what varies, and every value tried in the case.

use std::path::Path as FilePath;

use pounding_assembly::{AssemblyError, assemble_with_record, parameter_dimension};
use pounding_case::{Case, CaseError, Dimension};
use pounding_ground_motion::{AccelerationUnit, Accelerogram};

use super::intensity::{FirstPeriods, intensity};
use super::reader::{Reader, Result, Table, Value};
use super::values::{Values, numbers, unit_of};
use super::{RecordSource, Target, Variable, records};
use crate::case_text::{Edits, Entry, Lost, Path, apply, entry, options_of_gap};
use crate::runs::written;

const VARIABLE: [&str; 14] = [
    "name",
    "path",
    "values",
    "from",
    "to",
    "count",
    "spacing",
    "records",
    "synthetic",
    "intensity",
    "building",
    "period",
    "damping",
    "long_name",
];

/// Names that results use themselves.
const RESERVED: [&str; 5] = ["run", "storey", "level", "status", "run_id"];

/// What the variables are read against.
pub(super) struct Context<'c> {
    pub base: &'c Case,
    pub folder: &'c FilePath,
    pub first_periods: &'c FirstPeriods,
}

/// Reads a `[[variable]]`; with the records, if it is the one that names them.
pub(super) fn variable(
    reader: &Reader<'_>,
    value: &Value<'_>,
    context: &Context<'_>,
) -> Result<(Variable, Option<Vec<RecordSource>>)> {
    let table = reader.table(value, "[[variable]]", &VARIABLE)?;
    let given = ["path", "records", "synthetic", "intensity"];
    let kinds: Vec<&str> = given
        .into_iter()
        .filter(|k| table.get(k).is_some())
        .collect();
    match kinds.as_slice() {
        ["path"] => Ok((of_path(&table, context)?, None)),
        ["intensity"] => Ok((of_intensity(&table, context)?, None)),
        ["records" | "synthetic"] | ["records", "synthetic"] => {
            let (variable, records) = of_records(&table, context)?;
            Ok((variable, Some(records)))
        }
        _ => Err(reader.error(
            value.span(),
            "a variable is one of `path`, `records` with `synthetic`, and `intensity`",
            "for example path = \"gap.0.width\"",
        )),
    }
}

/// The name of a variable, by default as given, and how people call it.
fn names(table: &Table<'_, '_>, default: &str, title: &str) -> Result<(String, String)> {
    let reader = table.reader;
    let name = match table.get("name") {
        Some(value) => reader.text(value, "name")?,
        None => default.to_owned(),
    };
    let plain = name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
    let begins = name.chars().next().is_some_and(|c| c.is_ascii_alphabetic());
    let taken = RESERVED.contains(&name.as_str()) || crate::runs::is_result(&name);
    if !plain || !begins || taken {
        let place = table
            .get("name")
            .map_or_else(|| table.span.clone(), Value::span);
        return Err(reader.error(
            place,
            format!("\"{name}\" cannot name a coordinate of the results"),
            "a name begins with a letter, has letters, digits and underscores, and is not that of a result; write `name = ...`",
        ));
    }
    let long = match table.get("long_name") {
        Some(value) => reader.text(value, "long_name")?,
        None => title.to_owned(),
    };
    Ok((name, long))
}

fn of_records(
    table: &Table<'_, '_>,
    context: &Context<'_>,
) -> Result<(Variable, Vec<RecordSource>)> {
    let (name, long_name) = names(table, "record", "ground motion")?;
    let records = records::records(table, context.base, context.folder)?;
    let labels = records.iter().map(|r| r.name.clone()).collect();
    let variable = Variable {
        name,
        long_name,
        unit: String::new(),
        values: Values::Choices(labels),
        target: Target::Record,
    };
    Ok((variable, records))
}

fn of_intensity(table: &Table<'_, '_>, context: &Context<'_>) -> Result<Variable> {
    let reader = table.reader;
    let measure = intensity(table, context.base, context.first_periods)?;
    let dimension = measure.dimension();
    let (values, _) = numbers(table, &|v, key| reader.positive(v, key, dimension))?;
    let (name, long_name) = names(table, "intensity", &measure.title())?;
    Ok(Variable {
        name,
        long_name,
        unit: unit_of(dimension),
        values,
        target: Target::Intensity(measure),
    })
}

fn of_path(table: &Table<'_, '_>, context: &Context<'_>) -> Result<Variable> {
    let reader = table.reader;
    let place = table.required("path")?;
    let text = reader.text(place, "path")?;
    let path = Path::parse(&text).map_err(|reason| {
        reader.error(
            place.span(),
            format!("\"{text}\" is not a path: {reason}"),
            "write paths such as gap.0.width or building.light.mass.2",
        )
    })?;
    let default: Vec<String> = path
        .to_string()
        .split(['.', '[', ']', '"', '-', ' '])
        .filter(|p| !p.is_empty())
        .map(str::to_owned)
        .collect();
    let (name, long_name) = names(table, &default.join("_"), &path.to_string())?;
    let lost = |(message, help): Lost| reader.error(place.span(), message, help);
    let entry = entry(&context.base.source, &path).map_err(lost)?;
    let tried = Trial {
        reader,
        base: context.base,
        path: &path,
    };
    let (values, target) = match first_value(table) {
        Some(first) if first.get_ref().as_table().is_some() => models(table, &tried)?,
        Some(first) if reader.maybe_quantity(first).is_none() => named(table, &tried, entry)?,
        _ => counted(table, &tried, entry)?,
    };
    let numeric = !matches!(values, Values::Choices(_));
    Ok(Variable {
        name,
        long_name,
        unit: if numeric {
            unit(table, &tried)
        } else {
            String::new()
        },
        values,
        target,
    })
}

/// Values that are texts of the case, such as methods.
fn named(table: &Table<'_, '_>, tried: &Trial<'_, '_>, entry: Entry) -> Result<(Values, Target)> {
    let reader = table.reader;
    let items = reader.list(table.required("values")?, "values")?;
    let (labels, texts) = choices(&reader, items)?;
    let each = items.iter().zip(&texts);
    reader.all(each.map(|(item, text)| tried.edits(vec![entry.with(text)], item)))?;
    let path = tried.path.clone();
    let target = Target::Entry { entry, path, texts };
    Ok((Values::Choices(labels), target))
}

/// Values that are numbers.
fn counted(table: &Table<'_, '_>, tried: &Trial<'_, '_>, entry: Entry) -> Result<(Values, Target)> {
    let reader = table.reader;
    let (values, places) = numbers(table, &|v, key| Ok(reader.any_quantity(v, key)?.value))?;
    reader.all(places.into_iter().map(|value| {
        // As it is written, so that its unit is checked, and as runs will have it.
        let number = reader.any_quantity(value, "values")?.value;
        for text in [reader.source[value.span()].to_owned(), written(number)] {
            tried.edits(vec![entry.with(&text)], value)?;
        }
        Ok(())
    }))?;
    let path = tried.path.clone();
    let texts = Vec::new();
    let target = Target::Entry { entry, path, texts };
    Ok((values, target))
}

fn first_value<'v, 'a>(table: &Table<'v, 'a>) -> Option<&'v Value<'a>> {
    table.get("values")?.get_ref().as_array()?.first()
}

/// Names of choices and the texts that they stand for in a case.
fn choices(reader: &Reader<'_>, items: &[Value<'_>]) -> Result<(Vec<String>, Vec<String>)> {
    let labels = items.iter().map(|item| match item.get_ref().as_bool() {
        Some(flag) => Ok(flag.to_string()),
        None => reader.text(item, "values"),
    });
    let texts = items
        .iter()
        .map(|item| reader.source[item.span()].to_owned());
    Ok((labels.collect::<Result<_>>()?, texts.collect()))
}

/// Models with all their options.
fn models(table: &Table<'_, '_>, tried: &Trial<'_, '_>) -> Result<(Values, Target)> {
    let (reader, path) = (table.reader, tried.path);
    let list = table.required("values")?;
    let of_gap = path.table() == "gap" && path.to_string().ends_with(".model");
    if !of_gap {
        return Err(reader.error(
            list.span(),
            "tables are values of the model of a gap only",
            "write path = \"gap.0.model\", or give numbers",
        ));
    }
    let gap = Path(path.0[..path.0.len() - 1].to_vec());
    let lost = |(message, help): Lost| reader.error(list.span(), message, help);
    let (old, header) = options_of_gap(&tried.base.source, &gap).map_err(lost)?;
    let (mut labels, mut all) = (Vec::<String>::new(), Vec::new());
    for item in reader.list(list, "values")? {
        let mut edits: Edits = old
            .iter()
            .map(|place| (place.clone(), String::new()))
            .collect();
        let (mut new, mut label, mut model) = (String::new(), None, None);
        // Keys are those of a gap: the case knows them.
        let entries = item.get_ref().as_table().map(|t| {
            t.iter()
                .map(|(k, v)| (k.get_ref().to_string(), v))
                .collect::<Vec<_>>()
        });
        let Some(entries) = entries else {
            return Err(reader.error(
                item.span(),
                "give all models as tables, or none",
                "write { model = \"...\", ... }",
            ));
        };
        for (key, value) in entries {
            match key.as_str() {
                "label" => label = Some(reader.text(value, "label")?),
                _ => new.push_str(&format!("\n{key} = {}", &reader.source[value.span()])),
            }
            if key == "model" {
                model = Some(reader.text(value, "model")?);
            }
        }
        let Some(model) = model else {
            return Err(reader.error(
                item.span(),
                "this says not which model",
                "add model = \"...\"",
            ));
        };
        let label = label.unwrap_or(model);
        if labels.contains(&label) {
            return Err(reader.error(
                item.span(),
                format!("two values are called \"{label}\""),
                "add label = \"...\"",
            ));
        }
        labels.push(label);
        edits.push((header..header, new));
        tried.edits(edits.clone(), item)?;
        all.push(edits);
    }
    Ok((Values::Choices(labels), Target::Model { edits: all }))
}

/// Tries values in the case.
struct Trial<'r, 'c> {
    reader: Reader<'r>,
    base: &'c Case,
    path: &'c Path,
}

impl Trial<'_, '_> {
    /// Reads and assembles the case with these edits, without its record.
    fn edits(&self, edits: Edits, place: &Value<'_>) -> Result<Case> {
        let text = apply(&self.base.source, edits);
        let refused = |message: String, help: Option<String>| {
            let message = format!("the case refuses this for `{}`: {message}", self.path);
            self.reader
                .error(place.span(), message, help.unwrap_or_default())
        };
        let of_text = |e: CaseError| refused(e.message, e.help);
        let case = Case::parse(&text, &self.base.file).map_err(of_text)?;
        match assemble_with_record(&case, &at_rest()?) {
            Ok(_) => Ok(case),
            Err(AssemblyError::Case(e)) => Err(of_text(e)),
            Err(e) => Err(refused(e.to_string(), e.help())),
        }
    }
}

/// A motion of no strength, to assemble a case with.
fn at_rest() -> Result<Accelerogram> {
    let unit = AccelerationUnit::MetrePerSecondSquared;
    Ok(Accelerogram::new(vec![0.0; 2], unit, 1.0)?)
}

/// Unit of the numbers of a variable: that of its texts, or that of the entry in the
/// case; empty if neither states one.
fn unit(table: &Table<'_, '_>, tried: &Trial<'_, '_>) -> String {
    let reader = table.reader;
    let list = table.get("values").and_then(|v| v.get_ref().as_array());
    let items = list.into_iter().flatten();
    let ends = ["from", "to"].into_iter().filter_map(|k| table.get(k));
    let mut stated = items
        .chain(ends)
        .filter_map(|v| reader.maybe_quantity(v)?.dimension);
    if let Some(dimension) = stated.next() {
        return unit_of(dimension);
    }
    known_dimension(tried).map_or_else(String::new, unit_of)
}

/// Dimension of an entry by its key, for the entries that studies vary most.
fn known_dimension(tried: &Trial<'_, '_>) -> Option<Dimension> {
    let text = tried.path.to_string();
    let words: Vec<&str> = text
        .split('.')
        .filter(|w| w.parse::<usize>().is_err())
        .collect();
    let key = *words.last()?;
    if tried.path.table() == "gap" && !matches!(key, "width" | "elevation_tolerance") {
        let gap = tried.base.gaps.iter().find(|g| {
            let name = &g.name;
            text.contains(name.as_str())
        });
        let gap = gap.or_else(|| {
            let index = text.split('.').nth(1)?.parse::<usize>().ok()?;
            tried.base.gaps.get(index)
        })?;
        let model = pounding_gap_element::registry::find(&gap.model.value).ok()?;
        let known = model.parameters.iter().find(|p| p.name == key)?;
        let exponent = gap.parameters.iter().find(|p| p.key.value == "exponent");
        return Some(parameter_dimension(
            model,
            known,
            exponent.map(|p| p.value.value.value),
        ));
    }
    Some(match key {
        "mass" => Dimension::MASS,
        "stiffness" => Dimension::STIFFNESS,
        "width" | "height" | "initial_displacement" | "elevation_tolerance" => Dimension::LENGTH,
        "initial_velocity" => Dimension::VELOCITY,
        "pga" => Dimension::ACCELERATION,
        "duration" | "step" | "output_step" | "time_step" => Dimension::TIME,
        _ => Dimension::NUMBER,
    })
}
