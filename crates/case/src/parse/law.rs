//! Laws with memory: of storeys, and of links between neighbours.

use std::ops::Range;

use toml::de::DeValue;

use super::gap::{Faced, Pair, between, levels, name, useless_tolerance};
use super::{Row, one_each};
use crate::error::CaseError;
use crate::reader::{Reader, Table, Value};
use crate::schema::{self, Key};
use crate::types::{LawParameter, Link, Located, Side, StoreyLaw};

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
    let listed = match (table.misspelt("storeys"), table.get("storeys")) {
        (Some(error), _) => Err(error),
        (None, None) => Ok((0..storeys).collect()),
        (None, Some(value)) => listed_storeys(reader, value, storeys),
    };
    let listed: Option<Vec<usize>> = reader.errors.keep(listed);
    let count = listed.as_ref().map(Vec::len);
    let (parameters, whole) = parameters(table, schema::STOREY_LAW, count);
    let model = model.ok_or_else(|| reader.lost())?;
    if !whole {
        reader.errors.incomplete(model.span.clone());
    }
    Ok(StoreyLaw {
        parameters,
        // Without its storeys a law can be judged by its name.
        storeys: listed.unwrap_or_default(),
        model,
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

/// Reads a link; also returns where its `between` stands. Where neighbours or levels are
/// wrong there is no such place, and the link lies between walls: its law can be judged.
pub(super) fn link(
    reader: &Reader<'_>,
    value: &Value<'_>,
    row: &Row,
) -> Result<(Link, Option<Range<usize>>), CaseError> {
    let table = reader.section(value, "[[link]]", schema::LINK)?;
    let keep = reader.errors;
    let model = keep.keep(
        table
            .required("model")
            .and_then(|v| reader.text(v, "model")),
    );
    let name = keep.or_default(name(&table, "link"));
    let placed = keep.keep(placed(&table, row));
    let levels = placed.as_ref().map(|p| p.levels.len());
    let (parameters, whole) = parameters(&table, schema::LINK, levels);
    let model = model.ok_or_else(|| reader.lost())?;
    if !whole {
        keep.incomplete(model.span.clone());
    }
    let place = placed.as_ref().map(|p| p.place.clone());
    let placed = placed.unwrap_or(Placed {
        place: 0..0,
        between: [Side::Wall; 2],
        names: Default::default(),
        levels: vec![(None, None)],
    });
    let link = Link {
        name: name.unwrap_or_else(|| placed.names.join("-")),
        between: placed.between,
        parameters,
        levels: placed.levels,
        model,
    };
    Ok((link, place))
}

/// Where a link lies.
struct Placed {
    /// Where its `between` stands.
    place: Range<usize>,
    between: [Side; 2],
    names: [String; 2],
    levels: Vec<Pair>,
}

fn placed(table: &Table<'_, '_>, row: &Row) -> Result<Placed, CaseError> {
    let reader = &table.reader;
    let place = table.required("between")?;
    let (between, names) = between(reader, place, row)?;
    let Faced { pairs, listed, .. } = levels(table, between, row.buildings(reader)?, place.span())?;
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
    Ok(Placed {
        place: place.span(),
        between,
        names,
        levels,
    })
}

/// All keys but those of the table itself, and whether all of them could be read: one value
/// for each of `count` places, or for one where their number is not known.
fn parameters(
    table: &Table<'_, '_>,
    keys: &[Key],
    count: Option<usize>,
) -> (Vec<LawParameter>, bool) {
    let reader = &table.reader;
    let mut whole = true;
    let keep = reader.errors;
    let mut parameters = Vec::new();
    for (key, value) in table.entries() {
        let own = keys.iter().any(|k| k.name == key.value);
        if own || table.is_unknown(&key.value) {
            whole &= own;
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
                keep.keep(values.and_then(|v| match count {
                    Some(count) => one_each(reader, v, value.span(), count),
                    None => Ok(v),
                }))
            }
            _ => keep
                .keep(one(value))
                .map(|value| vec![value; count.unwrap_or(1)]),
        };
        let values = values.filter(|values| !values.is_empty());
        whole &= values.is_some();
        parameters.extend(values.map(|values| LawParameter { key, values }));
    }
    (parameters, whole)
}
