//! What provisions for the gap need to know beside the buildings themselves.

use toml::de::{DeTable, DeValue};

use super::spread;
use crate::error::CaseError;
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
    let table = reader.table(value, "[separation]", schema::SEPARATION)?;
    from_table(&table, buildings)
}

/// Reads the keys of `[separation]` alone, from an argument.
pub(crate) fn keys(text: &str, buildings: usize) -> Result<Separation, CaseError> {
    let name = "--set";
    let reader = Reader {
        file: name,
        source: text,
    };
    let tree = DeTable::parse(text).map_err(|e| {
        reader.error(
            e.span().unwrap_or(0..0),
            format!("this is not TOML: {}", e.message()),
            "write key=value as in the case file, texts in quotes, such as --set 'soil_zone=\"II\"'",
        )
    })?;
    let table = Table::new(
        reader,
        tree.get_ref(),
        0..0,
        "[separation]",
        schema::SEPARATION,
    )?;
    from_table(&table, buildings)
}

fn from_table(table: &Table<'_, '_>, buildings: usize) -> Result<Separation, CaseError> {
    let reader = &table.reader;
    let numbers = |key: &str, dimension: Dimension| -> Result<Option<Vec<f64>>, CaseError> {
        let Some(value) = table.get(key) else {
            return Ok(None);
        };
        let read = |v: &Value<'_>| reader.positive(v, key, dimension);
        let list = reader.list(value, key, read)?;
        spread(reader, list, buildings, "building").map(Some)
    };
    let flag = |key: &str| -> Result<Option<bool>, CaseError> {
        table.get(key).map(|v| reader.boolean(v, key)).transpose()
    };
    Ok(Separation {
        response_modification: numbers("response_modification", Dimension::NUMBER)?,
        displacement_amplification: numbers("displacement_amplification", Dimension::NUMBER)?,
        importance: numbers("importance", Dimension::NUMBER)?,
        yield_amplification: numbers("yield_amplification", Dimension::NUMBER)?,
        ductility: numbers("ductility", Dimension::NUMBER)?,
        structural_system: texts(table, "structural_system", Some(buildings))?,
        floors_aligned: flag("floors_aligned")?,
        same_owner: flag("same_owner")?,
        fortification_intensity: table
            .get("fortification_intensity")
            .map(|v| reader.count(v, "fortification_intensity", 1))
            .transpose()?,
        soil_zone: table.optional_text("soil_zone")?,
        design_ground_acceleration: table
            .optional_positive("design_ground_acceleration", Dimension::ACCELERATION)?,
        seismic_coefficient: table.optional_positive("seismic_coefficient", Dimension::NUMBER)?,
        provisions: texts(table, "provisions", None)?,
    })
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
            format!("{} values where there are {count} buildings", texts.len()),
            "give one value a building, or a single value for all",
        )),
        _ => Ok(Some(texts)),
    }
}
