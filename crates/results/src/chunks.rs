//! Whether every chunk of a dataset is in the file, by HDF5's C interface, which the safe
//! bindings do not cover.
#![allow(unsafe_code)]

use std::ffi::c_int;

use hdf5::{Dataset, Error, Result};
use hdf5_sys::h5i::hid_t;

// The C library is linked by the system bindings.
unsafe extern "C" {
    fn H5Dget_chunk_storage_size(dataset: hid_t, offset: *const u64, size: *mut u64) -> c_int;
}

/// Whether HDF5 finds every chunk by its place, as it does to read it. The number of chunks
/// alone does not tell: HDF5 reads a chunk whose place is damaged as zeros.
pub(crate) fn are_stored(data: &Dataset, shape: &[usize], chunk: &[usize]) -> Result<bool> {
    if chunk.len() != shape.len() || chunk.contains(&0) {
        return Err(Error::from("its chunks do not have its dimensions"));
    }
    let along: Vec<usize> = shape
        .iter()
        .zip(chunk)
        .map(|(n, c)| n.div_ceil(*c))
        .collect();
    let count = along.iter().try_fold(1_usize, |n, m| n.checked_mul(*m));
    // Compared first: a damaged size would ask for any number of places.
    let Some(count) = count.filter(|n| data.num_chunks() == Some(*n)) else {
        return Ok(false);
    };
    let mut offset = vec![0_u64; shape.len()];
    for mut number in 0..count {
        for dimension in (0..shape.len()).rev() {
            offset[dimension] = (number % along[dimension] * chunk[dimension]) as u64;
            number /= along[dimension];
        }
        let mut size = 0;
        // SAFETY: the identifier is open as long as `data` lives, `offset` has a number for
        // each dimension of the dataset, and the library's global lock is held.
        let status = hdf5::sync::sync(|| unsafe {
            H5Dget_chunk_storage_size(data.id(), offset.as_ptr(), &raw mut size)
        });
        if status < 0 || size == 0 {
            return Ok(false);
        }
    }
    Ok(true)
}
