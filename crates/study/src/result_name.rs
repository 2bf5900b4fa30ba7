//! Names of the results of studies and of their shards.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use pounding_results::study::MOST_SHARDS;

use crate::error::StudyError;
use crate::shard::Shard;

/// The name of the result of a shard.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct ShardName {
    /// Name of the study.
    pub study: String,
    /// Of how many shards.
    pub count: usize,
    /// Which shard, from 1.
    pub index: usize,
}

impl ShardName {
    /// Reads the name of a result.
    #[must_use]
    pub fn of(file: &str) -> Option<Self> {
        let (study, rest) = file.strip_suffix(".h5")?.rsplit_once(".shard-")?;
        let (index, count) = rest.split_once("-of-")?;
        let (index, count) = (index.parse().ok()?, count.parse().ok()?);
        let is_shard = count <= MOST_SHARDS && (1..=count).contains(&index);
        is_shard.then(|| Self {
            study: study.to_owned(),
            count,
            index,
        })
    }

    /// The name that the result of a shard has if no other is given.
    #[must_use]
    pub fn result(&self) -> PathBuf {
        PathBuf::from(format!("{self}.h5"))
    }

    /// The shard of a study file.
    #[must_use]
    pub fn of_study_file(study: &Path, shard: Shard) -> Self {
        Self {
            study: study_name(study).to_string_lossy().into_owned(),
            count: shard.count,
            index: shard.index,
        }
    }
}

impl std::fmt::Display for ShardName {
    /// The name of the result without its ending.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}.shard-{}-of-{}", self.study, self.index, self.count)
    }
}

/// What is no shard, or is another one, has no name of a shard: in a folder of shards it would be
/// taken for that.
///
/// # Errors
/// [`StudyError::NamedAsShard`].
pub fn refuse_name_of_shard(output: &Path, own: Option<Shard>) -> Result<(), StudyError> {
    let name = output.file_name().map(|name| name.to_string_lossy());
    let is_other = |named: &ShardName| {
        own.is_none_or(|own| (own.index, own.count) != (named.index, named.count))
    };
    match name.and_then(|name| ShardName::of(&name)).filter(is_other) {
        Some(shard) => Err(StudyError::NamedAsShard {
            path: output.to_owned(),
            shard: format!("{} of {}", shard.index, shard.count),
        }),
        None => Ok(()),
    }
}

/// The name of a study: that of its file, or of its folder where the file is called `study.toml`.
#[must_use]
pub fn study_name(study: &Path) -> OsString {
    let stem = study.file_stem().unwrap_or_default();
    let folder = || Some(study.canonicalize().ok()?.parent()?.file_name()?.to_owned());
    match stem == GENERIC {
        true => folder().unwrap_or_else(|| stem.to_owned()),
        false => stem.to_owned(),
    }
}

/// Where the result of a whole study is written if no other name is given: in the current
/// folder. A folder with a `study.toml` may hold a `case.toml` as well, whose result has the
/// folder's name: that of the study is told apart.
#[must_use]
pub fn default_result(study: &Path) -> PathBuf {
    default_result_of(study_name(study), study)
}

/// The same for a study whose name is known, though its file may be elsewhere: only what the file is
/// called counts.
#[must_use]
pub fn default_result_of(mut name: OsString, study: &Path) -> PathBuf {
    if study.file_stem().unwrap_or_default() == GENERIC {
        name.push(".");
        name.push(GENERIC);
    }
    name.push(".h5");
    PathBuf::from(name)
}

/// Whether an output is called as results of the study are by default: that of the command line, in
/// the current folder, or in another one that of Python, beside the study file.
pub(crate) fn has_default_name(output: &Path, study: &Path) -> bool {
    let elsewhere = study
        .parent()
        .is_some_and(|folder| !folder.as_os_str().is_empty() && folder != Path::new("."));
    output == default_result(study) || elsewhere && output == study.with_extension("h5")
}

/// What a study file is called where its folder says more.
const GENERIC: &str = "study";
