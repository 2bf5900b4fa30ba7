//! Laws with memory: of storeys, and of links between neighbours.

use std::ops::Range;

use toml::de::DeValue;

use super::gap::{Faced, between, levels, name, useless_tolerance};
use super::{Row, one_each};
use crate::error::CaseError;
use crate::reader::{Reader, Table, Value};
use crate::schema::{self, Key};
use crate::types::{LawParameter, Link, Located, StoreyLaw};

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
        let table = reader.section(value, "law", schema::STOREY_LAW)?;
        let Some(law) = reader.errors.keep(storey_law(reader, &table, storeys)) else {
            continue;
        };
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
    let model = table
        .required("model")
        .and_then(|v| reader.text(v, "model"));
    let model = reader.errors.keep(model);
    table.misspelt("storeys").map_or(Ok(()), Err)?;
    let listed = match table.get("storeys") {
        None => (0..storeys).collect(),
        Some(value) => listed_storeys(reader, value, storeys)?,
    };
    let parameters = parameters(table, schema::STOREY_LAW, listed.len());
    Ok(StoreyLaw {
        parameters,
        storeys: listed,
        model: model.ok_or_else(|| reader.lost())?,
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
    row: &Row,
) -> Result<(Link, Range<usize>), CaseError> {
    let table = reader.section(value, "[[link]]", schema::LINK)?;
    let keep = reader.errors;
    let model = keep.keep(
        table
            .required("model")
            .and_then(|v| reader.text(v, "model")),
    );
    let name = keep.or_default(name(&table, "link"));
    let place = table.required("between")?;
    let (between, names) = between(reader, place, row)?;
    let Faced { pairs, listed, .. } =
        levels(&table, between, row.buildings(reader)?, place.span())?;
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
        name: name.unwrap_or_else(|| names.join("-")),
        between,
        parameters: parameters(&table, schema::LINK, levels.len()),
        levels,
        model: model.ok_or_else(|| reader.lost())?,
    };
    Ok((link, place.span()))
}

/// All keys but those of the table itself: one value for each of `count` places.
fn parameters(table: &Table<'_, '_>, keys: &[Key], count: usize) -> Vec<LawParameter> {
    let reader = &table.reader;
    let keep = reader.errors;
    let mut parameters = Vec::new();
    for (key, value) in table.entries() {
        if keys.iter().any(|k| k.name == key.value) || table.is_unknown(&key.value) {
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
                let values = keep.all(items.iter().map(one));
                keep.keep(values.and_then(|v| one_each(reader, v, value.span(), count)))
            }
            _ => keep.keep(one(value)).map(|value| vec![value; count]),
        };
        parameters.extend(values.map(|values| LawParameter { key, values }));
    }
    parameters
}
