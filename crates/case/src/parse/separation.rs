//! What provisions for the gap need to know beside the buildings themselves.

use pounding_catalogue::wording::{agreeing, counted};
use toml::de::DeValue;

use super::spread;
use crate::error::{CaseError, Errors};
use crate::reader::{Reader, Table, Value};
use crate::schema;
use crate::types::{Located, Separation};
use crate::units::Dimension;

/// Reads `[separation]` for so many buildings.
pub(super) fn separation(
    reader: &Reader<'_>,
    value: &Value<'_>,
    buildings: usize,
) -> Result<Separation, CaseError> {
    let table = reader.section(value, "[separation]", schema::SEPARATION)?;
    Ok(from_table(&table, buildings))
}

/// Reads the keys of `[separation]` alone, from an argument.
pub(crate) fn keys(text: &str, buildings: usize) -> Result<Separation, CaseError> {
    let errors = Errors::default();
    let reader = Reader {
        file: "--set",
        source: text,
        errors: &errors,
    };
    let read = reader
        .document("write key=value as in the case file, texts in quotes, such as --set 'soil_zone=\"II\"'")
        .map(|tree| {
            let keys = schema::SEPARATION;
            let table = Table::new(reader, tree.get_ref(), 0..0, "[separation]", keys);
            from_table(&table, buildings)
        });
    errors.finish(read)
}

fn from_table(table: &Table<'_, '_>, buildings: usize) -> Separation {
    let reader = &table.reader;
    let keep = reader.errors;
    let numbers = |key: &str, dimension: Dimension| -> Option<Vec<f64>> {
        let read = |v: &Value<'_>| reader.positive(v, key, dimension);
        let list = keep.keep(reader.list(table.get(key)?, key, read))?;
        keep.keep(spread(reader, list, buildings, "building"))
    };
    let flag = |key: &str| {
        table
            .get(key)
            .and_then(|v| keep.keep(reader.boolean(v, key)))
    };
    let texts = |key: &str, count| keep.or_default(texts(table, key, count));
    Separation {
        response_modification: numbers("response_modification", Dimension::NUMBER),
        displacement_amplification: numbers("displacement_amplification", Dimension::NUMBER),
        importance: numbers("importance", Dimension::NUMBER),
        yield_amplification: numbers("yield_amplification", Dimension::NUMBER),
        ductility: numbers("ductility", Dimension::NUMBER),
        structural_system: texts("structural_system", Some(buildings)),
        floors_aligned: flag("floors_aligned"),
        same_owner: flag("same_owner"),
        fortification_intensity: table
            .get("fortification_intensity")
            .and_then(|v| keep.keep(reader.count(v, "fortification_intensity", 1))),
        soil_zone: keep.or_default(table.optional_text("soil_zone")),
        design_ground_acceleration: keep.or_default(
            table.optional_positive("design_ground_acceleration", Dimension::ACCELERATION),
        ),
        seismic_coefficient: keep
            .or_default(table.optional_positive("seismic_coefficient", Dimension::NUMBER)),
        provisions: texts("provisions", None),
    }
}

/// A text for all, or a list of texts; of this length, if one is given.
fn texts(
    table: &Table<'_, '_>,
    key: &str,
    count: Option<usize>,
) -> Result<Option<Vec<Located<String>>>, CaseError> {
    let reader = &table.reader;
    let Some(value) = table.get(key) else {
        return Ok(None);
    };
    let DeValue::Array(items) = value.get_ref() else {
        let text = reader.text(value, key)?;
        return Ok(Some(vec![text; count.unwrap_or(1)]));
    };
    let texts = items.iter().map(|v| reader.text(v, key));
    let texts = texts.collect::<Result<Vec<_>, _>>()?;
    match count {
        Some(count) if count != texts.len() => Err(reader.error(
            value.span(),
            format!(
                "{} where there {} {}",
                counted(texts.len(), "value"),
                agreeing(&count, "is", "are"),
                counted(count, "building")
            ),
            "give one value per building, or a single value for all",
        )),
        _ => Ok(Some(texts)),
    }
}
