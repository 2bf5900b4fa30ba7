//! The result of a run whose responses are in memory already: as a file, or as the same file
//! without a disk.
#![allow(unsafe_code)]

use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};

use hdf5::File;
use pounding_time_history::History;

use super::{Result, RunEnding, RunHead, RunWriter, WriteError, begin_in, finish};
use crate::hdf5_file;

/// Bytes by which a file in memory grows.
const INCREMENT: usize = 1 << 20;

/// Writes the result of a run to a file: the same as what a [`RunWriter`] writes while the run
/// goes on. It says of which `case_file` it is, if there is one.
///
/// # Errors
/// [`WriteError`] if the file cannot be written; what stood under its name is untouched then.
pub fn write_run(
    (path, case_file): (&Path, Option<&Path>),
    head: &RunHead<'_>,
    history: &History,
    ending: &RunEnding<'_>,
) -> std::result::Result<(), WriteError> {
    let mut writer = RunWriter::begin(path, head)?;
    if let Some(file) = case_file {
        writer = writer.of_case_file(file);
    }
    writer.take_all(history)?;
    writer.finish(ending)
}

/// The same as a file that lives in memory alone, for whoever reads it there.
///
/// # Errors
/// Names of the system that cannot stand in it ([`System::check_names`](pounding_time_history::System::check_names)),
/// and what HDF5 says, for example that there is no memory.
pub fn run_in_memory(
    head: &RunHead<'_>,
    history: &History,
    ending: &RunEnding<'_>,
) -> Result<File> {
    let names = head.system.check_names();
    names.map_err(|e| hdf5::Error::from(e.to_string()))?;
    static COUNT: AtomicU64 = AtomicU64::new(0);
    // HDF5 tells open files apart by their names.
    let name = format!("run in memory {}", COUNT.fetch_add(1, Ordering::Relaxed));
    let mut builder = hdf5_file::builder();
    builder.with_fapl(|list| list.core_options(INCREMENT, false));
    let file = builder.create(&name)?;
    let mut tables = begin_in(&file, head)?;
    tables.write_rows(history)?;
    drop(tables);
    finish(&file, head.system, ending)?;
    file.flush()?;
    Ok(file)
}

/// The bytes of a file in memory, as it would stand on a disk, without a checksum.
///
/// # Errors
/// What HDF5 says.
pub fn image(file: &File) -> Result<Vec<u8>> {
    file.flush()?;
    let failed = || hdf5::Error::from("cannot copy a file that lives in memory");
    let id = file.id();
    // SAFETY: the identifier is open as long as `file` lives, a null buffer asks for the size
    // alone, and the library's global lock is held.
    let size = hdf5::sync::sync(|| unsafe {
        hdf5_sys::h5f::H5Fget_file_image(id, std::ptr::null_mut(), 0)
    });
    let size = usize::try_from(size).map_err(|_| failed())?;
    let mut bytes = vec![0_u8; size];
    // SAFETY: the buffer has the size that is passed with it and outlives the call.
    let copied = hdf5::sync::sync(|| unsafe {
        hdf5_sys::h5f::H5Fget_file_image(id, bytes.as_mut_ptr().cast(), size)
    });
    match usize::try_from(copied) {
        Ok(copied) if copied == size => Ok(bytes),
        _ => Err(failed()),
    }
}
