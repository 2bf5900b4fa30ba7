//! Attributes and datasets, of the type that was written and of a size that is stored.

use std::any::type_name;

use hdf5::dataset::Layout;
use hdf5::types::VarLenUnicode;
use hdf5::{Container, Dataset, Datatype, Error, Group, H5Type, Location, Result};

/// More values than are read at once.
const MOST_VALUES: usize = 300_000_000;

/// The text of an attribute.
///
/// # Errors
/// What HDF5 says; an attribute that is no single text or not UTF-8.
pub fn text(place: &Location, name: &str) -> Result<String> {
    utf8(&scalar::<VarLenUnicode>(place, name)?)
}

/// The number of an attribute.
///
/// # Errors
/// What HDF5 says; an attribute that is no single number of this type.
pub fn number<T: H5Type + Copy>(place: &Location, name: &str) -> Result<T> {
    scalar(place, name)
}

fn scalar<T: H5Type>(place: &Location, name: &str) -> Result<T> {
    let attribute = place.attr(name)?;
    if !attribute.is_scalar() || attribute.space()?.extents()?.is_null() {
        return Err(Error::from("it is no single value"));
    }
    has_type::<T>(&attribute)?;
    attribute.read_scalar()
}

/// All values of a dataset.
///
/// # Errors
/// As [`dataset`], and more values than are read at once.
pub fn values<T: H5Type>(group: &Group, name: &str) -> Result<Vec<T>> {
    let data = dataset::<T>(group, name)?;
    if data.size() > MOST_VALUES {
        return Err(too_many());
    }
    data.read_raw()
}

/// All texts of a dataset.
///
/// # Errors
/// As [`values`], and texts that are not UTF-8.
pub fn texts(group: &Group, name: &str) -> Result<Vec<String>> {
    let texts = values::<VarLenUnicode>(group, name)?;
    texts.iter().map(utf8).collect()
}

/// A dataset of values of this type, all of which are stored in the file.
///
/// # Errors
/// What HDF5 says; another type, more values than can be, values that are not stored.
pub fn dataset<T: H5Type>(group: &Group, name: &str) -> Result<Dataset> {
    let data = group.dataset(name)?;
    has_type::<T>(&data)?;
    let shape = data.shape();
    if shape.is_empty() || data.space()?.extents()?.is_null() {
        return Err(Error::from("it has no rows"));
    }
    let product = |sizes: &[usize]| sizes.iter().try_fold(1_usize, |n, m| n.checked_mul(*m));
    let bytes = product(&shape).and_then(|n| n.checked_mul(data.dtype().ok()?.size()));
    let bytes = bytes.ok_or_else(too_many)?;
    if bytes == 0 {
        return Ok(data);
    }
    let stored = match data.layout() {
        // A text of variable length takes more in the file than in memory.
        Layout::Contiguous => data.offset().is_some() && data.storage_size() >= bytes as u64,
        Layout::Chunked => {
            let chunk = data.chunk().unwrap_or_default();
            if chunk.len() != shape.len() || chunk.contains(&0) {
                return Err(Error::from("its chunks do not have its dimensions"));
            }
            let along = shape.iter().zip(&chunk).map(|(n, c)| n.div_ceil(*c));
            let chunks = product(&along.collect::<Vec<_>>()).ok_or_else(too_many)?;
            data.num_chunks() == Some(chunks)
        }
        _ => return Err(Error::from("it is stored as no result is")),
    };
    match stored {
        true => Ok(data),
        false => Err(Error::from("some of its values are not in the file")),
    }
}

/// HDF5 converts between types, and out of a damaged one makes zeros.
fn has_type<T: H5Type>(place: &Container) -> Result<()> {
    match place.dtype()? == Datatype::from_type::<T>()? {
        true => Ok(()),
        false => {
            let name = type_name::<T>();
            let name = name.rsplit("::").next().unwrap_or(name);
            Err(Error::from(format!("its type is not {name}")))
        }
    }
}

fn utf8(text: &VarLenUnicode) -> Result<String> {
    // Whatever HDF5 calls UTF-8 need not be.
    String::from_utf8(text.as_bytes().to_vec()).map_err(|_| Error::from("it is not UTF-8"))
}

/// The number would say nothing: it is what damage has left of one.
fn too_many() -> Error {
    Error::from("it claims more values than a result holds")
}
