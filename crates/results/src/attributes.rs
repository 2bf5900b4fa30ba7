//! Texts that are written: attributes of files, groups and datasets.

use std::str::FromStr;

use hdf5::types::VarLenUnicode;
use hdf5::{Dataset, File, Location, Result};

use crate::{CHECKSUM, CHECKSUM_FORM};

/// What every result says of itself.
pub(crate) fn head(file: &File, title: &str, version: &str, build: &str) -> Result<()> {
    for (name, value) in [
        ("Conventions", "CF-1.10"),
        ("title", title),
        ("program", "pounding"),
        ("version", version),
        ("build", build),
        (CHECKSUM, CHECKSUM_FORM),
    ] {
        text(file, name, value)?;
    }
    Ok(())
}

/// Units and long name of a dataset.
pub(crate) fn describe(data: &Dataset, units: &str, long_name: &str) -> Result<()> {
    text(data, "units", units)?;
    text(data, "long_name", long_name)
}

/// A UTF-8 text attribute.
pub(crate) fn text(location: &Location, name: &str, value: &str) -> Result<()> {
    location
        .new_attr::<VarLenUnicode>()
        .create(name)?
        .write_scalar(&unicode(value)?)
}

/// A text of HDF5, which ends at its first zero.
pub(crate) fn unicode(value: &str) -> Result<VarLenUnicode> {
    VarLenUnicode::from_str(&value.replace('\0', " ")).map_err(|e| hdf5::Error::from(e.to_string()))
}
