//! Variables: what varies, and every value tried in the case.

use pounding_assembly::{AssemblyError, assemble_with_record, parameter_dimension};
use pounding_case::{Case, CaseError, Dimension};
use pounding_ground_motion::{AccelerationUnit, Accelerogram};

use super::context::Context;
use super::intensity::intensity;
use super::reader::{Reader, Result, Table, Value, Wrong};
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

/// What a variable is one of.
const KINDS: [&str; 4] = ["path", "records", "synthetic", "intensity"];

/// Reads a `[[variable]]`; with the records, if it is the one that names them.
pub(super) fn variable(
    reader: &Reader<'_>,
    value: &Value<'_>,
    context: &Context<'_>,
) -> Result<(Variable, Option<Vec<RecordSource>>)> {
    let table = reader.table(value, "[[variable]]", &VARIABLE)?;
    let kinds: Vec<&str> = KINDS
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
        [] if KINDS.iter().any(|k| table.lacks(k)) => {
            // What it is of is not known, but its numbers can be looked at.
            if first_value(&table).is_none_or(|v| reader.maybe_quantity(v).is_some()) {
                numbers(&table, &|v, key| Ok(reader.any_quantity(v, key)?.value))?;
            }
            Err(Wrong::Recorded)
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
    let long = table.or("long_name", title.to_owned(), |v| {
        reader.text(v, "long_name")
    });
    let long = reader.keep(long);
    let name = table.or("name", default.to_owned(), |v| reader.text(v, "name"))?;
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
    Ok((name, long.ok_or(Wrong::Recorded)?))
}

fn of_records(
    table: &Table<'_, '_>,
    context: &Context<'_>,
) -> Result<(Variable, Vec<RecordSource>)> {
    let reader = table.reader;
    let names = reader.keep(names(table, "record", "ground motion"));
    let records = records::records(table, context)?;
    let (name, long_name) = names.ok_or(Wrong::Recorded)?;
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
    let measure = reader.keep(intensity(table, context));
    let read = |v: &Value<'_>, key: &str| match &measure {
        Some(measure) => reader.positive(v, key, measure.dimension()),
        None => Ok(reader.any_quantity(v, key)?.value),
    };
    let values = reader.keep(numbers(table, &read));
    let title = measure.as_ref().map_or_else(String::new, |m| m.title());
    let (name, long_name) = names(table, "intensity", &title)?;
    let (measure, (values, _)) = measure.zip(values).ok_or(Wrong::Recorded)?;
    Ok(Variable {
        name,
        long_name,
        unit: unit_of(measure.dimension()),
        values,
        target: Target::Intensity(measure),
    })
}

fn of_path(table: &Table<'_, '_>, context: &Context<'_>) -> Result<Variable> {
    let reader = table.reader;
    let place = table.required("path")?;
    let path = reader.keep(path(&reader, place));
    let default = path.as_ref().map_or_else(String::new, default_name);
    let names = match (&path, table.get("name")) {
        // What it would be called is not known, which is no fault of its name.
        (None, None) => None,
        _ => {
            let title = path.as_ref().map_or_else(String::new, Path::to_string);
            reader.keep(names(table, &default, &title))
        }
    };
    let entry = path.as_ref().and_then(|path| {
        let lost = |(message, help): Lost| reader.error(place.span(), message, help);
        let entry = context
            .text()
            .and_then(|text| entry(text, path).map_err(lost));
        reader.keep(entry)
    });
    let tried = context.base.as_ref().zip(path.as_ref().zip(entry));
    let tried = tried.map(|(base, (path, entry))| Trial {
        reader,
        base: &base.case,
        path,
        entry,
        place,
    });
    let (values, target) = match first_value(table) {
        Some(first) if first.get_ref().as_table().is_some() => {
            models(table, path.as_ref(), tried.as_ref())?
        }
        Some(first) if reader.maybe_quantity(first).is_none() => named(table, tried.as_ref())?,
        _ => counted(table, tried.as_ref())?,
    };
    let tried = tried.ok_or(Wrong::Recorded)?;
    let (name, long_name) = names.ok_or(Wrong::Recorded)?;
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

fn path(reader: &Reader<'_>, place: &Value<'_>) -> Result<Path> {
    let text = reader.text(place, "path")?;
    Path::parse(&text).map_err(|reason| {
        reader.error(
            place.span(),
            format!("\"{text}\" is not a path: {reason}"),
            "write paths such as gap.0.width or building.light.mass.2",
        )
    })
}

/// The name of a variable that states none.
fn default_name(path: &Path) -> String {
    let text = path.to_string();
    let parts = text.split(['.', '[', ']', '"', '-', ' ']);
    let parts: Vec<&str> = parts.filter(|p| !p.is_empty()).collect();
    parts.join("_")
}

/// Values that are texts of the case, such as methods.
fn named(table: &Table<'_, '_>, tried: Option<&Trial<'_, '_>>) -> Result<(Values, Target)> {
    let reader = table.reader;
    let items = reader.list(table.required("values")?, "values")?;
    let (labels, texts) = choices(&reader, items)?;
    let tried = tried.ok_or(Wrong::Recorded)?;
    tried.values(
        items
            .iter()
            .zip(texts.iter().map(|text| vec![text.clone()])),
    )?;
    Ok((Values::Choices(labels), tried.target(texts)))
}

/// Values that are numbers.
fn counted(table: &Table<'_, '_>, tried: Option<&Trial<'_, '_>>) -> Result<(Values, Target)> {
    let reader = table.reader;
    let (values, places) = numbers(table, &|v, key| Ok(reader.any_quantity(v, key)?.value))?;
    let tried = tried.ok_or(Wrong::Recorded)?;
    let texts = places.into_iter().map(|value| {
        // As it is written, so that its unit is checked, and as runs will have it.
        let number = reader.maybe_quantity(value).map(|q| written(q.value));
        let texts = std::iter::once(reader.source[value.span()].to_owned()).chain(number);
        (value, texts.collect())
    });
    tried.values(texts)?;
    Ok((values, tried.target(Vec::new())))
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
    Ok((reader.all(labels)?, texts.collect()))
}

/// Models with all their options.
fn models(
    table: &Table<'_, '_>,
    path: Option<&Path>,
    tried: Option<&Trial<'_, '_>>,
) -> Result<(Values, Target)> {
    let reader = table.reader;
    let list = table.required("values")?;
    let of_gap = |path: &Path| path.table() == "gap" && path.to_string().ends_with(".model");
    if path.is_some_and(|path| !of_gap(path)) {
        return Err(reader.error(
            list.span(),
            "tables are values of the model of a gap only",
            "write path = \"gap.0.model\", or give numbers",
        ));
    }
    let items = reader.list(list, "values")?;
    let mut labels: Vec<String> = Vec::new();
    let texts = reader.all(items.iter().map(|item| {
        let (label, text) = model(&reader, item)?;
        if labels.contains(&label) {
            return Err(reader.error(
                item.span(),
                format!("two values are called \"{label}\""),
                "add label = \"...\"",
            ));
        }
        labels.push(label);
        Ok((item, text))
    }))?;
    let tried = tried.ok_or(Wrong::Recorded)?;
    let gap = Path(tried.path.0[..tried.path.0.len() - 1].to_vec());
    let lost = |(message, help): Lost| reader.error(list.span(), message, help);
    let (old, header) = options_of_gap(&tried.base.source, &gap).map_err(lost)?;
    let edits = reader.all(texts.into_iter().map(|(item, text)| {
        let removed = old.iter().map(|place| (place.clone(), String::new()));
        let edits: Edits = removed.chain([(header..header, text)]).collect();
        tried.edits(edits.clone(), item)?;
        Ok(edits)
    }))?;
    Ok((Values::Choices(labels), Target::Model { edits }))
}

/// The label of a model, and its lines in a case.
fn model(reader: &Reader<'_>, item: &Value<'_>) -> Result<(String, String)> {
    // Keys are those of a gap: the case knows them.
    let Some(table) = item.get_ref().as_table() else {
        return Err(reader.error(
            item.span(),
            "give all models as tables, or none",
            "write { model = \"...\", ... }",
        ));
    };
    let (mut text, mut label, mut model) = (String::new(), None, None);
    for (key, value) in table.iter() {
        let key = key.get_ref();
        match key.as_ref() {
            "label" => label = Some(reader.text(value, "label")?),
            _ => text.push_str(&format!("\n{key} = {}", &reader.source[value.span()])),
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
    Ok((label.unwrap_or(model), text))
}

/// Tries values in the case.
struct Trial<'r, 'c> {
    reader: Reader<'r>,
    base: &'c Case,
    path: &'c Path,
    entry: Entry,
    /// Where the study names the path.
    place: &'c Value<'r>,
}

impl Trial<'_, '_> {
    /// What a variable of these values changes.
    fn target(&self, texts: Vec<String>) -> Target {
        Target::Entry {
            entry: self.entry.clone(),
            path: self.path.clone(),
            texts,
        }
    }

    /// Tries values, each with its texts. What is wrong with the entry itself is said once,
    /// where the study names it.
    fn values<'v, 'a: 'v>(
        &self,
        values: impl IntoIterator<Item = (&'v Value<'a>, Vec<String>)>,
    ) -> Result<()> {
        let mut sound = true;
        for (value, texts) in values {
            for text in texts {
                match self.refusal(vec![self.entry.with(&text)]) {
                    Ok(()) => {}
                    Err(refusal) if refusal.of_key => return Err(self.wrong(refusal, self.place)),
                    Err(refusal) => {
                        sound = false;
                        self.reader.check(Err(self.wrong(refusal, value)));
                        break;
                    }
                }
            }
        }
        if sound { Ok(()) } else { Err(Wrong::Recorded) }
    }

    /// Tries the case with these edits.
    fn edits(&self, edits: Edits, place: &Value<'_>) -> Result<()> {
        let refused = self.refusal(edits);
        refused.map_err(|refusal| self.wrong(refusal, place))
    }

    fn wrong(&self, refusal: Refusal, place: &Value<'_>) -> Wrong {
        let Refusal { message, help, .. } = refusal;
        let message = format!("the case refuses this for `{}`: {message}", self.path);
        self.reader
            .error(place.span(), message, help.unwrap_or_default())
    }

    /// Reads and assembles the case with these edits, without its record.
    fn refusal(&self, edits: Edits) -> std::result::Result<(), Refusal> {
        // An entry that the case leaves out brings its key with it.
        let key = self.entry.span.start..self.entry.span.start + self.entry.before.len();
        let of_text = |e: CaseError| Refusal {
            of_key: key.contains(&e.span.start),
            message: e.message,
            help: e.help,
        };
        let text = apply(&self.base.source, edits);
        let case = Case::parse(&text, &self.base.file).map_err(of_text)?;
        let of_file = |message: String, help| Refusal {
            of_key: false,
            message,
            help,
        };
        let unit = AccelerationUnit::MetrePerSecondSquared;
        let at_rest = Accelerogram::new(vec![0.0; 2], unit, 1.0);
        let at_rest = at_rest.map_err(|e| of_file(e.to_string(), e.help()))?;
        match assemble_with_record(&case, &at_rest) {
            Ok(_) => Ok(()),
            Err(AssemblyError::Case(e)) => Err(of_text(e)),
            Err(e) => Err(of_file(e.to_string(), e.help())),
        }
    }
}

/// Why the case is wrong with a value.
struct Refusal {
    message: String,
    help: Option<String>,
    /// Whether the key of the entry is what is wrong.
    of_key: bool,
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
