//! What program this is: `pounding --version`, with `--json` for machines.

use serde::Serialize;

/// Version, commit, target, features and HDF5 library of this program.
#[derive(Debug, Serialize)]
pub struct Version {
    /// Version of the program.
    pub version: &'static str,
    /// Commit from which it was built; none where it was built outside of a repository.
    pub commit: Option<&'static str>,
    /// Machine for which it was built.
    pub target: &'static str,
    /// Features of the build beside the usual ones.
    pub features: Vec<&'static str>,
    /// Version of the HDF5 library that writes its results.
    pub hdf5: String,
}

impl Version {
    /// That of this program.
    pub fn of_this_program() -> Self {
        let (major, minor, release) = hdf5::library_version();
        let features = [("static", cfg!(feature = "static"))];
        Self {
            version: env!("CARGO_PKG_VERSION"),
            commit: option_env!("POUNDING_COMMIT"),
            target: env!("POUNDING_TARGET"),
            features: features
                .into_iter()
                .filter_map(|(name, used)| used.then_some(name))
                .collect(),
            hdf5: format!("{major}.{minor}.{release}"),
        }
    }
}
