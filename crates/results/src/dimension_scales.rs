//! Dimension scales through HDF5's high-level C interface, which the safe
//! bindings do not cover.
#![allow(unsafe_code)]

use std::ffi::{CString, c_char, c_int, c_uint};

use hdf5::Dataset;
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

/// Attaches a scale to a dimension, from zero, of a dataset.
///
/// # Errors
/// What HDF5 says, for example if the dataset has no such dimension.
pub fn attach(data: &Dataset, scale: &Dataset, dimension: u32) -> hdf5::Result<()> {
    // SAFETY: both identifiers are open as long as their datasets live, and the
    // library's global lock is held.
    let status = hdf5::sync::sync(|| unsafe { H5DSattach_scale(data.id(), scale.id(), dimension) });
    checked(status, "attach")
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
