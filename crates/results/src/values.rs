//! Attributes and datasets, of the type that was written and of a size that is stored.

use std::any::type_name;

use hdf5::dataset::Layout;
use hdf5::types::{IntSize, TypeDescriptor, VarLenUnicode};
use hdf5::{Container, Dataset, Datatype, Error, Group, H5Type, Location, LocationType, Result};

use crate::chunks::are_stored;

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

/// The number of a dataset that holds a single one.
///
/// # Errors
/// What HDF5 says; another type, more than one value, a value that is not stored.
pub fn value<T: H5Type>(group: &Group, name: &str) -> Result<T> {
    let data = group.dataset(name)?;
    if !data.is_scalar() || data.space()?.extents()?.is_null() {
        return Err(Error::from("it is no single value"));
    }
    has_type::<T>(&data)?;
    has_storage(&data)?;
    data.read_scalar()
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
    is_stored(&data)?;
    Ok(data)
}

/// Whether all values of a dataset are in the file.
fn is_stored(data: &Dataset) -> Result<()> {
    let shape = data.shape();
    if shape.is_empty() || data.space()?.extents()?.is_null() {
        return Err(Error::from("it has no rows"));
    }
    has_storage(data)
}

/// The same for a dataset of any shape.
fn has_storage(data: &Dataset) -> Result<()> {
    let shape = data.shape();
    let product = |sizes: &[usize]| sizes.iter().try_fold(1_usize, |n, m| n.checked_mul(*m));
    let bytes = product(&shape).and_then(|n| n.checked_mul(data.dtype().ok()?.size()));
    let bytes = bytes.ok_or_else(too_many)?;
    if bytes == 0 {
        return Ok(());
    }
    let stored = match data.layout() {
        // A text of variable length takes more in the file than in memory.
        Layout::Contiguous => data.offset().is_some() && data.storage_size() >= bytes as u64,
        Layout::Chunked => are_stored(data, &shape, &data.chunk().unwrap_or_default())?,
        _ => return Err(Error::from("it is stored as no result is")),
    };
    match stored {
        true => Ok(()),
        false => Err(Error::from("some of its values are not in the file")),
    }
}

/// Reads every dataset below a group, whatever it is for: of a file without checksum,
/// damage anywhere is a reason to trust nothing in it.
///
/// # Errors
/// The first dataset that cannot be read, with its name; groups within groups without end.
pub fn read_all(group: &Group) -> Result<()> {
    below(group, DEEPEST)
}

/// Groups within groups of a result, and some more: damaged links may go round in circles.
const DEEPEST: usize = 8;

fn below(group: &Group, levels: usize) -> Result<()> {
    for name in group.member_names()? {
        let named = |e: Error| Error::from(format!("{}/{name}: {e}", group.name()));
        match (group.loc_type_by_name(&name)?, levels.checked_sub(1)) {
            (LocationType::Group, Some(left)) => below(&group.group(&name)?, left)?,
            (LocationType::Dataset, _) => any(group, &name).map_err(named)?,
            _ => return Err(named(Error::from("it is nothing that a result has"))),
        }
    }
    Ok(())
}

/// Reads a dataset of any type that results have.
fn any(group: &Group, name: &str) -> Result<()> {
    let data = group.dataset(name)?;
    match data.dtype()?.to_descriptor()? {
        TypeDescriptor::Float(_) if data.is_scalar() => value::<f64>(group, name).map(drop),
        TypeDescriptor::Float(_) => values::<f64>(group, name).map(drop),
        TypeDescriptor::Integer(IntSize::U1) => values::<i8>(group, name).map(drop),
        TypeDescriptor::Integer(IntSize::U4) => values::<i32>(group, name).map(drop),
        TypeDescriptor::Integer(_) => values::<i64>(group, name).map(drop),
        TypeDescriptor::VarLenUnicode => texts(group, name).map(drop),
        // Columns, which whoever knows them reads.
        TypeDescriptor::Compound(_) | TypeDescriptor::FixedAscii(_) => {
            is_stored(&group.dataset(name)?)
        }
        _ => Err(Error::from("its type is that of no result")),
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

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    fn with_file(test: impl FnOnce(&hdf5::File)) {
        let folder = tempfile::tempdir().unwrap();
        test(&hdf5::File::create(folder.path().join("a.h5")).unwrap());
    }

    #[test]
    fn values_come_back() {
        with_file(|file| {
            let data = file.new_dataset::<f64>().chunk((2, 2)).shape((5, 3));
            let data = data.create("a").unwrap();
            let written: Vec<f64> = (0..15).map(f64::from).collect();
            data.write_raw(&written).unwrap();
            assert_eq!(values::<f64>(file, "a").unwrap(), written);
            file.new_dataset::<f64>().shape(0).create("none").unwrap();
            assert_eq!(values::<f64>(file, "none").unwrap(), [0.0; 0]);
            read_all(file).unwrap();
        });
    }

    #[test]
    fn other_types_and_values_that_are_not_there_are_told() {
        with_file(|file| {
            let told = |name: &str| values::<f64>(file, name).unwrap_err().to_string();
            let single = file.new_dataset::<f32>().shape(2).create("single").unwrap();
            single.write_raw(&[1.0_f32, 2.0]).unwrap();
            assert_eq!(told("single"), "its type is not f64");
            file.new_dataset::<f64>().shape(2).create("empty").unwrap();
            assert_eq!(told("empty"), "some of its values are not in the file");
            let huge = file.new_dataset::<f64>().chunk(1024).shape(1_usize << 60);
            huge.create("huge").unwrap();
            assert_eq!(told("huge"), "some of its values are not in the file");
            let partly = file.new_dataset::<f64>().chunk(2).shape(6).create("partly");
            partly.unwrap().write_slice(&[1.0, 2.0], 0..2).unwrap();
            assert_eq!(told("partly"), "some of its values are not in the file");
            assert!(read_all(file).is_err());
        });
    }

    /// One flipped bit in the index of the chunks: HDF5 finds none in its place, and reads
    /// zeros without a word.
    #[test]
    fn a_chunk_that_is_not_found_is_not_zeros() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.h5");
        let file = hdf5::File::create(&path).unwrap();
        let builder = file.new_dataset::<f64>().chunk((2, 2));
        let data = builder.shape((2, 2)).create("a").unwrap();
        data.write_raw(&[1.0, 2.0, 3.0, 4.0]).unwrap();
        drop((data, file));
        let mut bytes = std::fs::read(&path).unwrap();
        let index = bytes.windows(6).position(|w| w == b"TREE\x01\0").unwrap();
        // Signature and siblings; size and filters of the chunk; its row and column; then
        // its place along the bytes of a value, which is always zero.
        let place = index + 24 + 8 + 16;
        assert_eq!(bytes[place..place + 8], [0; 8]);
        bytes[place + 5] ^= 2;
        std::fs::write(&path, bytes).unwrap();
        let file = hdf5::File::open(&path).unwrap();
        let zeros = file.dataset("a").unwrap().read_raw::<f64>().unwrap();
        assert_eq!(zeros, [0.0; 4]);
        let told = values::<f64>(&file, "a").unwrap_err().to_string();
        assert_eq!(told, "some of its values are not in the file");
    }
}
