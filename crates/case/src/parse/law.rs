//! Laws with memory: of storeys, and of links between neighbours.

use std::ops::Range;

use toml::de::DeValue;

use super::gap::{Faced, between, levels, useless_tolerance};
use super::{check_name, one_each};
use crate::error::CaseError;
use crate::reader::{Reader, Table, Value, distance};
use crate::schema::{self, Key};
use crate::types::{Building, LawParameter, Link, Located, StoreyLaw};

/// Reads `law` of a building: one table, or several that name their storeys.
pub(super) fn storey_laws(
    reader: &Reader<'_>,
    value: &Value<'_>,
    storeys: usize,
) -> Result<Vec<StoreyLaw>, CaseError> {
    let tables: Vec<&Value<'_>> = match value.get_ref() {
        DeValue::Array(items) => items.iter().collect(),
        _ => vec![value],
    };
    let mut taken: Vec<Option<Range<usize>>> = vec![None; storeys];
    let mut laws = Vec::new();
    for value in tables {
        let table = reader.table(value, "law", schema::STOREY_LAW)?;
        let law = storey_law(reader, &table, storeys)?;
        for storey in &law.storeys {
            if let Some(first) = &taken[*storey] {
                return Err(reader.error(
                    law.model.span.clone(),
                    format!(
                        "storey {} has two laws, the first in line {}",
                        storey + 1,
                        reader.line(first)
                    ),
                    "name the storeys of each law with `storeys = [...]`",
                ));
            }
            taken[*storey] = Some(law.model.span.clone());
        }
        laws.push(law);
    }
    Ok(laws)
}

fn storey_law(
    reader: &Reader<'_>,
    table: &Table<'_, '_>,
    storeys: usize,
) -> Result<StoreyLaw, CaseError> {
    // First, as a misspelt key says more than the absence of the right one.
    let near = misspelt(table, schema::STOREY_LAW);
    near.map_or(Ok(()), Err)?;
    let listed = match table.get("storeys") {
        None => (0..storeys).collect(),
        Some(value) => listed_storeys(reader, value, storeys)?,
    };
    Ok(StoreyLaw {
        parameters: parameters(table, schema::STOREY_LAW, listed.len())?,
        storeys: listed,
        model: reader.text(table.required("model")?, "model")?,
    })
}

fn listed_storeys(
    reader: &Reader<'_>,
    value: &Value<'_>,
    storeys: usize,
) -> Result<Vec<usize>, CaseError> {
    let DeValue::Array(items) = value.get_ref() else {
        return Err(reader.wrong_type(value, "storeys", "a list of storeys, from 1"));
    };
    let mut listed = Vec::new();
    for item in items.iter() {
        let storey = reader.count(item, "storeys", 1)?;
        if storey > storeys || listed.contains(&(storey - 1)) {
            return Err(reader.error(
                item.span(),
                format!("storey {storey} is not one of {storeys}, or stands here twice"),
                "name each storey of this law once, from 1 at the bottom",
            ));
        }
        listed.push(storey - 1);
    }
    if listed.is_empty() {
        return Err(reader.error(
            value.span(),
            "`storeys` is empty",
            "name at least one storey, or leave the key out for all",
        ));
    }
    Ok(listed)
}

/// Reads a link.
pub(super) fn link(
    reader: &Reader<'_>,
    value: &Value<'_>,
    buildings: &[Building],
) -> Result<(Link, Range<usize>), CaseError> {
    let table = reader.table(value, "[[link]]", schema::LINK)?;
    let near = misspelt(&table, schema::LINK);
    near.map_or(Ok(()), Err)?;
    let place = table.required("between")?;
    let (between, names) = between(reader, place, buildings)?;
    let name = match table.optional_text("name")? {
        Some(name) => check_name(reader, name, "link")?.value,
        None => names.join("-"),
    };
    let Faced { pairs, listed, .. } = levels(&table, between, buildings, place.span())?;
    // A link may join floors at any elevations.
    if let (Some(value), true) = (table.get("elevation_tolerance"), listed) {
        return Err(useless_tolerance(
            reader,
            value,
            "listed `levels` of a link",
        ));
    }
    let mut levels: Vec<_> = pairs.into_iter().map(|(pair, _)| pair).collect();
    levels.sort_unstable();
    let link = Link {
        name,
        between,
        parameters: parameters(&table, schema::LINK, levels.len())?,
        levels,
        model: reader.text(table.required("model")?, "model")?,
    };
    Ok((link, place.span()))
}

/// An unknown key next to one of the table's own is a slip, not a parameter.
fn misspelt(table: &Table<'_, '_>, keys: &[Key]) -> Option<CaseError> {
    let own = |text: &str| keys.iter().any(|k| k.name == text);
    table.entries().into_iter().find_map(|(key, _)| {
        let near = keys
            .iter()
            .find(|k| k.name != "*" && distance(&key.value, k.name) <= 2)?;
        (!own(&key.value)).then(|| {
            table.reader.error(
                key.span,
                format!("unknown key `{}` in {}", key.value, table.name),
                format!("did you mean `{}`?", near.name),
            )
        })
    })
}

/// All keys but those of the table itself: one value for each of `count` places.
fn parameters(
    table: &Table<'_, '_>,
    keys: &[Key],
    count: usize,
) -> Result<Vec<LawParameter>, CaseError> {
    let reader = &table.reader;
    let mut parameters = Vec::new();
    for (key, value) in table.entries() {
        if keys.iter().any(|k| k.name == key.value) {
            continue;
        }
        let one = |v: &Value<'_>| {
            Ok::<_, CaseError>(Located {
                value: reader.any_quantity(v, &key.value)?,
                span: v.span(),
            })
        };
        let values = match value.get_ref() {
            DeValue::Array(items) => {
                let values = items.iter().map(one).collect::<Result<Vec<_>, _>>()?;
                one_each(reader, values, value.span(), count)?
            }
            _ => vec![one(value)?; count],
        };
        parameters.push(LawParameter { key, values });
    }
    Ok(parameters)
}
