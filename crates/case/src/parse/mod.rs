//! From the TOML tree to a case.

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::Path;

use pounding_catalogue::wording::{agreeing, counted};
use pounding_shear_building::{NAMES, is_name};
use toml::de::DeValue;

use crate::error::{CaseError, Errors};
use crate::reader::{List, Reader, Table, Value, Values};
use crate::schema;
use crate::types::{Analysis, Building, Case, Draft, Gap, Link, Located, Refusal, Separation};
use crate::units::Dimension;

mod building;
mod gap;
mod ground_motion;
mod law;
mod scale;
mod separation;

pub use ground_motion::process_steps;
pub(crate) use separation::keys as separation_keys;

pub(crate) fn case(source: &str, file: &Path) -> Result<Case, Box<Refusal>> {
    let name = file.display().to_string();
    let errors = Errors::default();
    let read = whole(
        Reader {
            file: &name,
            source,
            errors: &errors,
        },
        file,
    );
    let draft = errors.keep(read);
    let incomplete = errors.all_incomplete();
    match (errors.finish(Ok(())), draft) {
        (Ok(()), Some(draft)) => Ok(draft.case),
        (Err(error), draft) => {
            let draft = draft.map(|draft| Draft {
                incomplete,
                ..draft
            });
            Err(Box::new(Refusal { error, draft }))
        }
        // Without a draft there is an error, which was recorded.
        (Ok(()), None) => {
            let error = CaseError::new(&name, source, 0..0, "the file cannot be read", None);
            Err(Box::new(Refusal { error, draft: None }))
        }
    }
}

fn whole(reader: Reader<'_>, file: &Path) -> Result<Draft, CaseError> {
    let tree = reader.document("see the example in docs/reference/case-file.md")?;
    let root = Table::new(reader, tree.get_ref(), 0..0, "the case", schema::CASE);
    let keep = reader.errors;
    let title = keep.or_default(root.optional_text("title"));
    let row = buildings(&reader, &root);
    let gaps = gaps(&reader, &root, &row);
    let links = links(&reader, &root, &row);
    let before = keep.count();
    let ground_motion = keep.keep(
        root.required("ground_motion")
            .and_then(|v| ground_motion::ground_motion(&reader, v)),
    );
    let motion_is_known = keep.count() == before;
    let ground_motion = ground_motion.unwrap_or_else(ground_motion::unknown);
    let analysis = root.get("analysis");
    let analysis = analysis.and_then(|value| keep.keep(analysis_of(&reader, value)));
    let analysis = analysis.unwrap_or_else(default_analysis);
    let separation = match root.get("separation") {
        Some(value) if row.count > 0 => {
            keep.or_default(separation::separation(&reader, value, row.count))
        }
        _ => Separation::default(),
    };
    Ok(Draft {
        case: Case {
            title: title.map_or(String::new(), |t| t.value),
            buildings: row.readable,
            gaps,
            links,
            ground_motion,
            analysis,
            separation,
            source: reader.source.to_owned(),
            file: file.to_owned(),
        },
        incomplete: Vec::new(),
        motion_is_known,
    })
}

/// The row of buildings as far as it could be read.
pub(super) struct Row {
    /// How many there are.
    count: usize,
    /// Their names, if all are sound.
    names: Option<Vec<String>>,
    /// The buildings that could be read, with stand-ins for values that are wrong.
    readable: Vec<Building>,
    /// Whether these are all, and their storey heights sound.
    heights: bool,
}

impl Row {
    /// The names of the buildings.
    fn names(&self, reader: &Reader<'_>) -> Result<&[String], CaseError> {
        self.names.as_deref().ok_or_else(|| reader.lost())
    }

    /// The buildings: sound as far as names and storey heights go.
    fn buildings(&self, reader: &Reader<'_>) -> Result<&[Building], CaseError> {
        if self.heights {
            Ok(&self.readable)
        } else {
            Err(reader.lost())
        }
    }
}

fn buildings(reader: &Reader<'_>, root: &Table<'_, '_>) -> Row {
    let keep = reader.errors;
    let values = keep.or_default(tables(root, "building"));
    if values.is_empty() && root.get("building").is_none_or(|v| v.get_ref().is_array()) {
        let none = || reader.error(0..0, "the case has no building", "add a [[building]]");
        keep.record(root.misspelt("building").unwrap_or_else(none));
    }
    let mut names: Vec<Option<Located<String>>> = Vec::new();
    let mut readable = Vec::new();
    let mut heights = !values.is_empty();
    for value in &values {
        let (name, building) = building::building(reader, value);
        let twice = name.as_ref().and_then(|name| {
            let first = names.iter().flatten().find(|n| n.value == name.value)?;
            Some(reader.error(
                name.span.clone(),
                format!(
                    "building \"{}\" is given twice, first in line {}",
                    name.value,
                    reader.line(&first.span)
                ),
                "give every building its own name",
            ))
        });
        let unique = twice.map(|e| keep.record(e)).is_none();
        names.push(name.filter(|_| unique));
        let building = keep.keep(building);
        heights &= building.as_ref().is_some_and(|(_, heights)| *heights);
        readable.extend(building.map(|(building, _)| building));
    }
    let sound = !values.is_empty();
    let names = names.into_iter().map(|n| Some(n?.value)).collect();
    Row {
        count: values.len(),
        names: if sound { names } else { None },
        readable,
        heights,
    }
}

fn gaps(reader: &Reader<'_>, root: &Table<'_, '_>, row: &Row) -> Vec<Gap> {
    let keep = reader.errors;
    let mut gaps: Vec<(Gap, Range<usize>)> = Vec::new();
    let mut without_place = Vec::new();
    for value in keep.or_default(tables(root, "gap")) {
        let Some((gap, span)) = keep.keep(gap::gap(reader, value, row)) else {
            continue;
        };
        let Some(span) = span else {
            without_place.push(gap);
            continue;
        };
        if let Some((_, first)) = gaps.iter().find(|(g, _)| g.between == gap.between) {
            keep.record(reader.error(
                span,
                format!(
                    "gap given twice: the first is in line {}",
                    reader.line(first)
                ),
                "remove one; several levels of one gap go into its `levels` and `width`",
            ));
        } else if let Some((_, first)) = gaps.iter().find(|(g, _)| g.name == gap.name) {
            keep.record(reader.error(
                span,
                format!(
                    "two gaps have the name \"{}\", the first in line {}",
                    gap.name,
                    reader.line(first)
                ),
                "give every gap its own `name`",
            ));
        } else {
            gaps.push((gap, span));
        }
    }
    let gaps = gaps.into_iter().map(|(gap, _)| gap);
    gaps.chain(without_place).collect()
}

fn links(reader: &Reader<'_>, root: &Table<'_, '_>, row: &Row) -> Vec<Link> {
    let keep = reader.errors;
    let mut links: Vec<(Link, Range<usize>)> = Vec::new();
    let mut without_place = Vec::new();
    for value in keep.or_default(tables(root, "link")) {
        let Some((link, span)) = keep.keep(law::link(reader, value, row)) else {
            continue;
        };
        let Some(span) = span else {
            without_place.push(link);
            continue;
        };
        if let Some((_, first)) = links.iter().find(|(l, _)| l.name == link.name) {
            keep.record(reader.error(
                span,
                format!(
                    "two links have the name \"{}\", the first in line {}",
                    link.name,
                    reader.line(first)
                ),
                "give every link its own `name`",
            ));
        } else {
            links.push((link, span));
        }
    }
    let links = links.into_iter().map(|(link, _)| link);
    links.chain(without_place).collect()
}

/// Refuses names that cannot stand in messages or as a group of the result file.
fn check_name(
    reader: &Reader<'_>,
    name: Located<String>,
    what: &str,
) -> Result<Located<String>, CaseError> {
    let text = &name.value;
    if is_name(text) {
        return Ok(name);
    }
    Err(reader.error(name.span, format!("{text:?} cannot name a {what}"), NAMES))
}

/// The tables of an array of tables; none if the key is absent.
fn tables<'v, 'a>(root: &Table<'v, 'a>, key: &str) -> Result<Vec<&'v Value<'a>>, CaseError> {
    match root.get(key) {
        None => Ok(Vec::new()),
        Some(value) => match value.get_ref() {
            DeValue::Array(items) => Ok(items.iter().collect()),
            _ => Err(root.reader.error(
                value.span(),
                format!("`{key}` must be a list of tables"),
                format!("write [[{key}]] with double brackets"),
            )),
        },
    }
}

fn not_negative(
    reader: &Reader<'_>,
    value: &Value<'_>,
    key: &str,
    dimension: Dimension,
) -> Result<f64, CaseError> {
    let number = reader.quantity(value, key, dimension)?;
    if number >= 0.0 {
        Ok(number)
    } else {
        Err(reader.error(
            value.span(),
            format!("`{key}` = {number} must be zero or more"),
            "correct the value",
        ))
    }
}

/// One value for each of `count` places.
fn spread(
    reader: &Reader<'_>,
    list: List,
    count: usize,
    place: &str,
) -> Result<Vec<f64>, CaseError> {
    match list.values {
        Values::Scalar(x) => Ok(vec![x; count]),
        Values::List(values) if values.len() == count => Ok(values),
        Values::List(values) => Err(reader.error(
            list.span,
            format!(
                "{} where there {} {}",
                counted(values.len(), "value"),
                agreeing(&count, "is", "are"),
                counted(count, place)
            ),
            format!("give one value per {place}, or a single value for all"),
        )),
    }
}

/// A list of anything that was read one by one: as many as there are places, as a list
/// that holds one value is more likely short than meant for all.
fn one_each<T>(
    reader: &Reader<'_>,
    values: Vec<T>,
    span: Range<usize>,
    count: usize,
) -> Result<Vec<T>, CaseError> {
    if values.len() == count {
        return Ok(values);
    }
    Err(reader.error(
        span,
        format!(
            "{} where there {} {}",
            counted(values.len(), "value"),
            agreeing(&count, "is", "are"),
            counted(count, "place")
        ),
        "give one value per storey or level of this law, or a single value without brackets for all",
    ))
}

fn default_analysis() -> Analysis {
    Analysis {
        method: Located {
            value: "event_driven".to_owned(),
            span: 0..0,
        },
        duration: None,
        output_step: 0.01,
        step: None,
        beta: None,
        gamma: None,
        alpha: None,
        theta: None,
        relative_tolerance: None,
        energy_tolerance: None,
        places: BTreeMap::new(),
    }
}

/// A step (s) in place of one that could not be read.
const STEP: f64 = 1.0e-3;

fn analysis_of(reader: &Reader<'_>, value: &Value<'_>) -> Result<Analysis, CaseError> {
    let table = reader.section(value, "[analysis]", schema::ANALYSIS)?;
    let keep = reader.errors;
    let default = default_analysis();
    let positive = |key: &str, dimension| keep.or_default(table.optional_positive(key, dimension));
    let number = |key: &str| keep.or_default(table.optional_number(key));
    // Any step stands in for one that is wrong: a method that needs one has it.
    let step = match keep.keep(table.optional_positive("step", Dimension::TIME)) {
        Some(None) => table.misspelt("step").map(|_| STEP),
        Some(step) => step,
        None => Some(STEP),
    };
    Ok(Analysis {
        method: keep
            .or_default(table.optional_text("method"))
            .unwrap_or(default.method),
        duration: positive("duration", Dimension::TIME),
        output_step: positive("output_step", Dimension::TIME).unwrap_or(default.output_step),
        step,
        beta: number("beta"),
        gamma: number("gamma"),
        alpha: number("alpha"),
        theta: number("theta"),
        relative_tolerance: positive("relative_tolerance", Dimension::NUMBER),
        energy_tolerance: positive("energy_tolerance", Dimension::NUMBER),
        places: table
            .entries()
            .into_iter()
            .map(|(key, value)| (key.value, value.span()))
            .collect(),
    })
}
