//! Dimension scales through HDF5's high-level C interface, which the safe
//! bindings do not cover.
#![allow(unsafe_code)]

use std::ffi::{CString, c_char, c_int, c_uint};

use hdf5::types::VarLenArray;
use hdf5::{Dataset, ObjectReference, ObjectReference1};
use hdf5_sys::h5i::hid_t;

// The C library is linked by the feature `hl` of the system bindings.
unsafe extern "C" {
    fn H5DSset_scale(dataset: hid_t, name: *const c_char) -> c_int;
    fn H5DSattach_scale(dataset: hid_t, scale: hid_t, dimension: c_uint) -> c_int;
}

/// Makes a one-dimensional dataset the scale of a dimension.
///
/// # Errors
/// What HDF5 says, for example if the dataset is attached to a scale itself.
pub fn make_scale(data: &Dataset, name: &str) -> hdf5::Result<()> {
    let name = CString::new(name).map_err(|e| hdf5::Error::from(e.to_string()))?;
    // SAFETY: the identifier is open as long as `data` lives, the name is a C
    // string that outlives the call, and the library's global lock is held.
    let status = hdf5::sync::sync(|| unsafe { H5DSset_scale(data.id(), name.as_ptr()) });
    checked(status, "set")
}

/// What a scale lists of the dimensions that it is attached to: an attribute, which in files of the oldest form has 64 KiB at
/// most, of 16 bytes each.
const MOST_LISTED: usize = 4000;
/// The attribute, and that of a dataset which names the scales of its dimensions.
const LISTED: &str = "REFERENCE_LIST";
const NAMED: &str = "DIMENSION_LIST";

/// Attaches a scale to a dimension, from zero, of a dataset. Of what has many histories, those beyond 4000 name
/// their scale, which readers ask for, and are not listed by it.
///
/// # Errors
/// What HDF5 says, for example if the dataset has no such dimension.
pub fn attach(data: &Dataset, scale: &Dataset, dimension: u32) -> hdf5::Result<()> {
    attach_up_to(MOST_LISTED, data, (scale, dimension))
}

/// The same where a scale lists so many at most.
fn attach_up_to(
    most: usize,
    data: &Dataset,
    (scale, dimension): (&Dataset, u32),
) -> hdf5::Result<()> {
    let listed = scale.attr(LISTED).map_or(0, |list| list.size());
    if listed >= most && dimension == 0 && data.attr(NAMED).is_err() {
        return name(data, scale);
    }
    // SAFETY: both identifiers are open as long as their datasets live, and the
    // library's global lock is held.
    let status = hdf5::sync::sync(|| unsafe { H5DSattach_scale(data.id(), scale.id(), dimension) });
    checked(status, "attach")
}

/// Names the scale of the first dimension in a dataset that names none yet.
fn name(data: &Dataset, scale: &Dataset) -> hdf5::Result<()> {
    let scale = ObjectReference1::create(scale, ".")?;
    let mut scales = vec![VarLenArray::from_slice(&[]); data.ndim()];
    if let Some(first) = scales.first_mut() {
        *first = VarLenArray::from_slice(&[scale]);
    }
    let attribute = data.new_attr::<VarLenArray<ObjectReference1>>();
    attribute.shape(scales.len()).create(NAMED)?.write(&scales)
}

fn checked(status: c_int, what: &str) -> hdf5::Result<()> {
    if status < 0 {
        Err(hdf5::Error::from(format!(
            "cannot {what} a dimension scale"
        )))
    } else {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hdf5::ReferencedObject;

    /// More histories than a scale can list: each names its scales, of all its dimensions.
    #[test]
    fn many_datasets_have_their_scales() {
        let folder = tempfile::tempdir().unwrap();
        let file = crate::hdf5_file::create(&folder.path().join("a.h5")).unwrap();
        let scale = |name: &str| {
            let scale = file.new_dataset::<f64>().shape(2).create(name).unwrap();
            make_scale(&scale, name).unwrap();
            scale
        };
        let (time, level) = (scale("time"), scale("level"));
        let named = |data: &Dataset| {
            let list = data.attr(NAMED).unwrap();
            let list = list.read_1d::<VarLenArray<ObjectReference1>>().unwrap();
            let name = |scale: &ObjectReference1| match scale.dereference(data).unwrap() {
                ReferencedObject::Dataset(scale) => scale.name(),
                other => panic!("{other:?}"),
            };
            let names = list.iter().map(|of| of.iter().map(name).collect());
            names.collect::<Vec<Vec<String>>>()
        };
        for k in 0..100 {
            let data = file.new_dataset::<f64>().shape((2, 2));
            let data = data.create(format!("history_{k}").as_str()).unwrap();
            attach_up_to(50, &data, (&time, 0)).unwrap();
            // Some are by level as well.
            if k % 3 == 0 {
                attach_up_to(50, &data, (&level, 1)).unwrap();
                assert_eq!(named(&data), [["/time"], ["/level"]], "{k}");
            } else {
                assert_eq!(named(&data), [vec!["/time"], vec![]], "{k}");
            }
        }
        assert_eq!(time.attr(LISTED).unwrap().size(), 50);
    }
}
