//! The motions of a study: files, and synthetic motions from seeds.

use std::borrow::Cow;
use std::ops::Range;
use std::path::Path;
use std::sync::LazyLock;

use pounding_assembly::nothing_to_move_across;
use pounding_case::document::{
    Cycles, Dimensioned, Entry, Field, FreeKeys, List, Number, Optional, Reader, Signed, TableOr,
    Time, Velocity,
};
use pounding_case::{Case, CaseError, CaseTree, Dimension, Located};
use pounding_catalogue::suggestion;
use pounding_catalogue::wording::one_line;
use pounding_ground_motion::generators::{RezaeianDerKiureghian2010, TimeGrid};

use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::Deserialize;
use serde::de::IgnoredAny;
use serde_json::{Value, json};
use toml::Spanned;
use toml::de::DeValue;

use super::context::Context;
use super::values::{Whole, all};
use super::{RecordKind, RecordSource, Study};
use crate::case_text::{Edit, KEPT, Variant, with_motion};
use crate::gap_check::{across_of_another, name_of_record};

/// A record: the name of its file, or a table.
pub(super) type Record = TableOr<RecordTable, String>;

/// A record with the keys of `[ground_motion]` of a case but `scale`.
#[derive(Debug, Deserialize)]
#[serde(rename = "a record")]
pub(super) struct RecordTable {
    name: Optional<String>,
    file: Field<String>,
    #[serde(rename = "*")]
    others: FreeKeys<IgnoredAny>,
}

impl JsonSchema for RecordTable {
    fn schema_name() -> Cow<'static, str> {
        "record".into()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let mut schema = pounding_case::ground_motion_schema(generator);
        schema.insert("description".to_owned(), "A record".into());
        if let Some(Value::Object(keys)) = schema.get_mut("properties") {
            keys.remove("scale");
            let name = json!({"type": "string", "description": "Name in the results, by default that of the file"});
            keys.insert("name".to_owned(), name);
        }
        schema
    }
}

/// Keys that a record may have.
static KEYS: LazyLock<Vec<String>> = LazyLock::new(|| {
    let schema = RecordTable::json_schema(&mut SchemaGenerator::default());
    let keys = schema.get("properties").and_then(Value::as_object);
    keys.into_iter()
        .flatten()
        .map(|(key, _)| key.clone())
        .collect()
});

/// A file of a study, as a case in any folder names it.
fn absolute(file: &str, folder: &Path) -> String {
    let path = folder.join(file);
    let path = std::path::absolute(&path).unwrap_or(path);
    toml::Value::String(path.display().to_string()).to_string()
}

/// The value of a key of a record with the files that it names, which are relative to the folder
/// of the study, as a case in any folder names them.
fn with_files(key: &str, text: &str, folder: &Path) -> String {
    let Ok(value) = DeValue::parse(text) else {
        return text.to_owned();
    };
    let mut named = Vec::new();
    files_in(key, &value, &mut named);
    // From the last one on, so that the places of the others stay.
    named.sort_by_key(|(place, _)| std::cmp::Reverse(place.start));
    let mut text = text.to_owned();
    for (place, name) in named {
        text.replace_range(place, &absolute(name, folder));
    }
    text
}

/// The names of files in the value of a key of a record, with their places.
fn files_in<'v>(
    key: &str,
    value: &'v Spanned<DeValue<'_>>,
    named: &mut Vec<(Range<usize>, &'v str)>,
) {
    match (key, value.get_ref()) {
        ("file" | "response" | "across" | "target", DeValue::String(name)) => {
            named.push((value.span(), name));
        }
        ("across" | "scale", DeValue::Table(table)) => {
            for (key, value) in table {
                files_in(key.get_ref(), value, named);
            }
        }
        ("process", DeValue::Array(steps)) => {
            for step in steps {
                let scale = step.get_ref().as_table().and_then(|step| step.get("scale"));
                scale.into_iter().for_each(|s| files_in("scale", s, named));
            }
        }
        _ => {}
    }
}

impl RecordKind {
    /// Whether a record across the row comes with it, in the place of that of the case.
    pub(crate) fn brings_across(&self) -> bool {
        let is_across = |edit: &Edit| edit.entry.path.to_string() == "ground_motion.across";
        match self {
            Self::File { edits, .. } => edits.iter().any(is_across),
            Self::Made { .. } | Self::Refused(_) => false,
        }
    }
}

impl Study {
    /// For each record the first of those that are the same file, read in the same way: in a list, where each stands at
    /// one intensity, they have names of their own.
    pub(crate) fn same_records(&self) -> Vec<usize> {
        let same = |a: &RecordSource, b: &RecordSource| match (&a.kind, &b.kind) {
            (RecordKind::File { edits: a, .. }, RecordKind::File { edits: b, .. }) => a == b,
            _ => false,
        };
        let records = self.records.iter().enumerate();
        let first = |(i, record)| {
            let mut earlier = self.records[..i].iter();
            earlier.position(|other| same(other, record)).unwrap_or(i)
        };
        records.map(first).collect()
    }
}

/// What the user should know of a study whose records stand beside the record across the row
/// that its case names: the two may be of different earthquakes.
pub(crate) fn beside_that_across(study: &Study) -> Option<String> {
    let across = &study.base.ground_motion.across.as_ref()?.value.file.value;
    if !study.has_records() {
        return None;
    }
    let kept = study.records.iter().filter(|r| !r.kind.brings_across());
    let kept: Vec<&str> = kept.map(|record| record.name.as_str()).collect();
    let remedy = "give a record its own";
    across_of_another(&kept, study.records.len(), (across, remedy))
}

/// The same of buildings with records of their own.
pub(crate) fn on_grounds_of_their_own(study: &Study) -> Option<String> {
    let records = if study.has_records() {
        study.records.len()
    } else {
        0
    };
    crate::gap_check::on_grounds_of_their_own(&study.base, records)
}

/// Reads `records` and `synthetic` of a variable.
pub(super) fn records(
    reader: &Reader<'_>,
    records: Optional<List<Record>>,
    synthetic: Optional<SyntheticTable>,
    context: &Context,
) -> Option<Vec<RecordSource>> {
    let files = records.stated().and_then(|list| {
        let items = list.map_or_else(Vec::new, |list| list.value.0);
        all(items.into_iter().map(|item| {
            let item = item.located()?;
            let span = item.span.clone();
            Some((record(reader, item, context)?, span))
        }))
    });
    let made = synthetic.stated().and_then(|table| {
        let Some(table) = table else {
            return Some(Vec::new());
        };
        let span = table.span.clone();
        let made = table.value.read(reader, &table.span)?;
        Some(made.into_iter().map(|m| (m, span.clone())).collect())
    });
    let (mut records, made) = files.zip(made)?;
    records.extend(made);
    for (i, (record, place)) in records.iter().enumerate() {
        if records[..i].iter().any(|(r, _)| r.name == record.name) {
            let message = format!("two records have the name \"{}\"", record.name);
            let help = "write { name = \"...\", file = \"...\" }";
            return reader.refuse(place.clone(), message, help);
        }
    }
    Some(records.into_iter().map(|(record, _)| record).collect())
}

/// The record that the case itself names.
pub(super) fn of_case(base: &Case) -> RecordSource {
    let file = &base.ground_motion.file.value;
    RecordSource {
        name: name_of_record(file),
        kind: RecordKind::File {
            case: Box::new(base.clone()),
            edits: Vec::new(),
        },
        missing: None,
    }
}

fn record(reader: &Reader<'_>, item: Located<Record>, context: &Context) -> Option<RecordSource> {
    let Located { value, span } = item;
    // What the case file would hold, as it is written here.
    let mut options = Vec::new();
    let (name, file, others) = match value {
        TableOr::Value(file) => {
            let span = span.clone();
            (None, Located { value: file, span }, Vec::new())
        }
        TableOr::Table(table) => (
            table.name.value().map(one_line),
            table.file.located()?,
            table.others.0,
        ),
    };
    let Located {
        value: file,
        span: place,
    } = file;
    for (Located { value: key, span }, value) in others {
        if KEYS.contains(&key) {
            let Some(place) = value.span() else { continue };
            let text = with_files(&key, &reader.source[place], &context.folder);
            options.push((key, text));
        } else if !value.is_wrong() {
            let nearest = suggestion::misspelt(&key, KEYS.iter());
            let guess = nearest.map_or_else(String::new, |k| format!("did you mean `{k}`? "));
            let help = format!("{guess}known keys: {}", KEYS.join(", "));
            reader.refuse::<()>(span, format!("unknown key `{key}` in a record"), help);
        }
    }
    options.insert(0, ("file".to_owned(), absolute(&file, &context.folder)));
    let base = &context.base.as_ref()?.case;
    // What the case does to its own record it does to all, and its record across the row stays
    // beside all, unless one says otherwise.
    let own = |key: &str| options.iter().any(|(known, _)| known == key);
    let mut kept = vec!["scale"];
    kept.extend(KEPT.into_iter().filter(|key| !own(key)));
    let edits = match with_motion(&base.source, &kept, options) {
        Ok(edits) => edits,
        Err((message, help)) => return reader.refuse(span, message, help),
    };
    let tree = CaseTree::parse(&base.source, &base.file);
    let case = match tree.and_then(|tree| Variant::new(&tree, &edits).case()) {
        Ok(case) => case,
        Err(e) => {
            let message = format!("in a case, this record: {}", e.message);
            return reader.refuse(span, message, e.help.unwrap_or_default());
        }
    };
    if let Some((message, help)) = nothing_to_move_across(&case) {
        return reader.refuse(span, message, help);
    }
    let name = name.unwrap_or_else(|| name_of_record(Path::new(&file)));
    let missing = missing(reader, &name, (&case, base), (place, span));
    context.missing.borrow_mut().extend(missing.clone());
    Some(RecordSource {
        name,
        kind: RecordKind::File {
            case: Box::new(case),
            edits,
        },
        missing: missing.map(Box::new),
    })
}

/// The first file of a record that is not there, at the place of its name, or of the record if it
/// stands elsewhere in that. What the case names itself is not a matter of the record.
fn missing(
    reader: &Reader<'_>,
    name: &str,
    (case, base): (&Case, &Case),
    (file, record): (Range<usize>, Range<usize>),
) -> Option<CaseError> {
    let known = base.files();
    let mut own = case.files().into_iter().filter(|f| !known.contains(f));
    own.find_map(|(what, path)| {
        let error = match std::fs::metadata(&path) {
            Err(error) => error.to_string(),
            Ok(found) if found.is_dir() => "it is a folder, not a file".to_owned(),
            Ok(_) => return None,
        };
        let place = match path == case.resolve(&case.ground_motion.file.value) {
            true => file.clone(),
            false => record.clone(),
        };
        let message = format!("record {name}: cannot read its {what} {}: {error}", path.display());
        let message = message.replace("its record ", "");
        let help = "correct the name, which is relative to the folder of the study; with --keep-going the runs of a record that cannot be read are recorded as failed and all others are computed";
        Some(CaseError::new(reader.file, reader.source, place, message, Some(help.to_owned())))
    })
}

/// Generator of synthetic motions
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(
    rename = "model of motions",
    expecting = "a text in quotes\nmotions of others are read from files"
)]
enum Generator {
    #[serde(rename = "rezaeian_der_kiureghian_2010")]
    RezaeianDerKiureghian2010,
}

/// Most motions that a table makes, and their samples together: they are kept as long as the study
/// runs.
const MOST_MADE: i64 = 10_000;
const MOST_SAMPLES: usize = 100_000_000;

/// Hz/s.
#[derive(Debug)]
struct FrequencyRate;

impl Dimensioned for FrequencyRate {
    const DIMENSION: Dimension = Dimension {
        mass: 0.0,
        length: 0.0,
        time: -2.0,
    };
}

/// Synthetic motions of consecutive seeds
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(rename = "synthetic")]
pub(super) struct SyntheticTable {
    /// Generator
    model: Field<Generator>,
    /// How many motions, at most 10000 and of 100 million samples together
    count: Field<Whole<1, MOST_MADE>>,
    /// Seed of the first, by default 1
    seed: Optional<Whole<0>>,
    /// Time step (s), by default 0.01
    time_step: Optional<Signed<Time>>,
    /// Duration (s)
    duration: Field<Signed<Time>>,
    /// Arias intensity (m/s), by default 1
    arias_intensity: Optional<Signed<Velocity>>,
    /// Time from 5 to 95 % of the Arias intensity (s)
    significant_duration: Field<Signed<Time>>,
    /// Time at 45 % of the Arias intensity (s)
    middle_time: Field<Signed<Time>>,
    /// Frequency at the middle time (Hz)
    middle_frequency: Field<Signed<Cycles>>,
    /// Change of the frequency (Hz/s), by default -0.1
    frequency_rate: Optional<Signed<FrequencyRate>>,
    /// Damping ratio of the filter, by default 0.3
    damping: Optional<Signed<Number>>,
    /// Corner of the high-pass filter (Hz), by default 0.15
    high_pass: Optional<Signed<Cycles>>,
}

impl SyntheticTable {
    /// The motions of a table that stands here.
    fn read(self, reader: &Reader<'_>, span: &Range<usize>) -> Option<Vec<RecordSource>> {
        self.model.value()?;
        let usual = RezaeianDerKiureghian2010::usual(
            self.significant_duration.number()?,
            self.middle_time.number()?,
            self.middle_frequency.number()?,
        );
        let motion = RezaeianDerKiureghian2010 {
            arias_intensity: self.arias_intensity.number_or(usual.arias_intensity)?,
            frequency_rate: self.frequency_rate.number_or(usual.frequency_rate)?,
            damping: self.damping.number_or(usual.damping)?,
            high_pass: self.high_pass.number_or(usual.high_pass)?,
            ..usual
        };
        let grid = TimeGrid {
            time_step: self.time_step.number_or(TimeGrid::USUAL_TIME_STEP)?,
            duration: self.duration.number()?,
        };
        let first = self.seed.value_or(Whole(1))?.0;
        let place = self.count.span();
        let count = self.count.value()?.0;
        // What is wrong with the grid is said by the generator.
        let samples = grid.count().unwrap_or_default();
        if samples.saturating_mul(count) > MOST_SAMPLES {
            return reader.refuse(
                place.unwrap_or_else(|| span.clone()),
                format!(
                    "{count} motions of {samples} samples are more than {MOST_SAMPLES} samples, which are kept in memory"
                ),
                "make fewer motions, or shorter ones with a longer `time_step`",
            );
        }
        let made = |seed| match motion.generate(grid, seed as u64) {
            Ok(made) => Some(RecordSource {
                name: format!("seed_{seed}"),
                kind: RecordKind::Made {
                    warnings: made.warnings().map(str::to_owned).collect(),
                    record: Box::new(made.accelerogram),
                    command: command(&motion, grid, seed),
                },
                missing: None,
            }),
            Err(e) => reader.refuse(span.clone(), e.to_string(), e.help().unwrap_or_default()),
        };
        (first..first + count).map(made).collect()
    }
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
