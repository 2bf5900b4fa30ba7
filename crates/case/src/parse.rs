//! From the TOML tree to a case.

use std::ops::Range;
use std::path::Path;

use toml::de::{DeTable, DeValue};

use crate::error::CaseError;
use crate::reader::{List, Reader, Table, Value, Values};
use crate::schema;
use crate::types::{Analysis, Building, Case, Gap, Link, Located, Separation};
use crate::units::Dimension;

mod building;
mod gap;
mod ground_motion;
mod law;
mod scale;
mod separation;

pub use ground_motion::process_steps;
pub(crate) use separation::keys as separation_keys;

pub(crate) fn case(source: &str, file: &Path) -> Result<Case, CaseError> {
    let name = file.display().to_string();
    let reader = Reader {
        file: &name,
        source,
    };
    let tree = DeTable::parse(source).map_err(|e| {
        reader.error(
            e.span().unwrap_or(0..0),
            format!("this is not TOML: {}", e.message()),
            "see the example in the README",
        )
    })?;
    let root = Table::new(reader, tree.get_ref(), 0..0, "the case", schema::CASE)?;
    let title = root
        .optional_text("title")?
        .map_or(String::new(), |t| t.value);
    let buildings = buildings(&reader, &root)?;
    let gaps = gaps(&reader, &root, &buildings)?;
    let links = links(&reader, &root, &buildings)?;
    let ground_motion = ground_motion::ground_motion(&reader, root.required("ground_motion")?)?;
    let analysis = match root.get("analysis") {
        Some(value) => analysis(&reader, value)?,
        None => default_analysis(),
    };
    let separation = match root.get("separation") {
        Some(value) => separation::separation(&reader, value, buildings.len())?,
        None => Separation::default(),
    };
    Ok(Case {
        title,
        buildings,
        gaps,
        links,
        ground_motion,
        analysis,
        separation,
        source: source.to_owned(),
        file: file.to_owned(),
    })
}

fn buildings(reader: &Reader<'_>, root: &Table<'_, '_>) -> Result<Vec<Building>, CaseError> {
    let mut buildings: Vec<Building> = Vec::new();
    for value in tables(root, "building")? {
        let building = building::building(reader, value)?;
        let name = &building.name;
        if let Some(first) = buildings.iter().find(|b| b.name.value == name.value) {
            return Err(reader.error(
                name.span.clone(),
                format!(
                    "building \"{}\" is given twice, first in line {}",
                    name.value,
                    reader.line(&first.name.span)
                ),
                "give every building its own name",
            ));
        }
        buildings.push(building);
    }
    if buildings.is_empty() {
        return Err(reader.error(0..0, "the case has no building", "add a [[building]]"));
    }
    Ok(buildings)
}

fn gaps(
    reader: &Reader<'_>,
    root: &Table<'_, '_>,
    buildings: &[Building],
) -> Result<Vec<Gap>, CaseError> {
    let mut gaps: Vec<(Gap, Range<usize>)> = Vec::new();
    for value in tables(root, "gap")? {
        let (gap, span) = gap::gap(reader, value, buildings)?;
        if let Some((_, first)) = gaps.iter().find(|(g, _)| g.between == gap.between) {
            return Err(reader.error(
                span,
                format!(
                    "gap given twice: the first is in line {}",
                    reader.line(first)
                ),
                "remove one; several levels of one gap go into its `levels` and `width`",
            ));
        }
        if let Some((_, first)) = gaps.iter().find(|(g, _)| g.name == gap.name) {
            return Err(reader.error(
                span,
                format!(
                    "two gaps have the name \"{}\", the first in line {}",
                    gap.name,
                    reader.line(first)
                ),
                "give every gap its own `name`",
            ));
        }
        gaps.push((gap, span));
    }
    Ok(gaps.into_iter().map(|(gap, _)| gap).collect())
}

fn links(
    reader: &Reader<'_>,
    root: &Table<'_, '_>,
    buildings: &[Building],
) -> Result<Vec<Link>, CaseError> {
    let mut links: Vec<(Link, Range<usize>)> = Vec::new();
    for value in tables(root, "link")? {
        let (link, span) = law::link(reader, value, buildings)?;
        if let Some((_, first)) = links.iter().find(|(l, _)| l.name == link.name) {
            return Err(reader.error(
                span,
                format!(
                    "two links have the name \"{}\", the first in line {}",
                    link.name,
                    reader.line(first)
                ),
                "give every link its own `name`",
            ));
        }
        links.push((link, span));
    }
    Ok(links.into_iter().map(|(link, _)| link).collect())
}

/// Refuses names that cannot stand in messages or as a group of the result file.
fn check_name(
    reader: &Reader<'_>,
    name: Located<String>,
    what: &str,
) -> Result<Located<String>, CaseError> {
    let text = &name.value;
    let bad = text.trim() != text
        || matches!(text.as_str(), "" | "." | "..")
        || text.contains(|c: char| c == '/' || c.is_control());
    if !bad {
        return Ok(name);
    }
    Err(reader.error(
        name.span,
        format!("{text:?} cannot name a {what}"),
        "a name is not empty, not \".\" or \"..\", and has no slash, no control characters and no blanks at its ends",
    ))
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
            format!("{} values where there are {count} {place}s", values.len()),
            format!("give one value a {place}, or a single value for all"),
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
        format!("{} values where there are {count} places", values.len()),
        "give one value a storey or level of this law, or a single value without brackets for all",
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
    }
}

fn analysis(reader: &Reader<'_>, value: &Value<'_>) -> Result<Analysis, CaseError> {
    let table = reader.table(value, "[analysis]", schema::ANALYSIS)?;
    let default = default_analysis();
    Ok(Analysis {
        method: table.optional_text("method")?.unwrap_or(default.method),
        duration: table.optional_positive("duration", Dimension::TIME)?,
        output_step: table
            .optional_positive("output_step", Dimension::TIME)?
            .unwrap_or(default.output_step),
        step: table.optional_positive("step", Dimension::TIME)?,
        beta: table.optional_number("beta")?,
        gamma: table.optional_number("gamma")?,
        alpha: table.optional_number("alpha")?,
        theta: table.optional_number("theta")?,
        relative_tolerance: table.optional_positive("relative_tolerance", Dimension::NUMBER)?,
        energy_tolerance: table.optional_positive("energy_tolerance", Dimension::NUMBER)?,
    })
}
