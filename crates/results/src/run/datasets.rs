//! Datasets and attributes with their units and names.

use hdf5::types::VarLenUnicode;
use hdf5::{Dataset, Group, H5Type};

use super::Result;
use crate::attributes::{describe, text, unicode};

/// Rows of a chunk at most: a few hundred kilobytes for tall buildings, few chunks for
/// short runs.
pub(super) const CHUNK_ROWS: usize = 1024;

/// A one-dimensional dataset with units and long name.
pub(super) fn series<T: H5Type>(
    group: &Group,
    name: &str,
    units: &str,
    long_name: &str,
    values: &[T],
) -> Result<Dataset> {
    let builder = group.new_dataset::<T>();
    let data = if values.is_empty() {
        builder.shape(0).create(name)?
    } else {
        let rows = CHUNK_ROWS.min(values.len());
        builder
            .chunk(rows)
            .shuffle()
            .deflate(1)
            .fletcher32()
            .shape(values.len())
            .create(name)?
    };
    if !values.is_empty() {
        data.write_raw(values)?;
    }
    describe(&data, units, long_name)?;
    Ok(data)
}

/// A dataset of a single number with units and long name.
pub(super) fn single(
    group: &Group,
    name: &str,
    units: &str,
    long_name: &str,
    value: f64,
) -> Result<Dataset> {
    let data = group.new_dataset::<f64>().create(name)?;
    data.write_scalar(&value)?;
    describe(&data, units, long_name)?;
    Ok(data)
}

/// A dataset of rows of several columns, one after another.
pub(super) fn table<T: H5Type>(group: &Group, name: &str, rows: &[T]) -> Result<Dataset> {
    let builder = group.new_dataset::<T>();
    if rows.is_empty() {
        return builder.shape(0).create(name);
    }
    let data = builder
        .chunk(CHUNK_ROWS.min(rows.len()))
        .shuffle()
        .deflate(1)
        .fletcher32()
        .shape(rows.len())
        .create(name)?;
    data.write_raw(rows)?;
    Ok(data)
}

/// A one-dimensional dataset of texts with a long name.
pub(super) fn labels(
    group: &Group,
    name: &str,
    long_name: &str,
    values: &[String],
) -> Result<Dataset> {
    let texts = values.iter().map(|v| unicode(v));
    let texts = texts.collect::<Result<Vec<_>>>()?;
    let builder = group.new_dataset::<VarLenUnicode>();
    let data = builder.shape(texts.len()).create(name)?;
    if !texts.is_empty() {
        data.write_raw(&texts)?;
    }
    text(&data, "long_name", long_name)?;
    Ok(data)
}

/// What long names of peaks say of the run that they are of.
pub(super) fn without(prefix: &str) -> &'static str {
    match prefix {
        "" => "",
        _ => " without gaps and links",
    }
}
