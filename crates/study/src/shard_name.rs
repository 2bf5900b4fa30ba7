//! Results of shards by their names.

use std::path::{Path, PathBuf};

use pounding_results::study::MOST_SHARDS;

use crate::sweep::{Shard, study_name};

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
