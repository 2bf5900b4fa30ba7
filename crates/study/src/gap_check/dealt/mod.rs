//! Runs of a gap check or of a comparison that several processes share.
//!
//! The demands of the records, which decide what all other runs are, are computed by each of them;
//! the other runs, many for each record, are dealt out one by one and stored in a file a shard.

#[cfg(feature = "results")]
mod files;

#[cfg(feature = "results")]
use std::path::PathBuf;

use super::error::CheckError;
use super::parallel::{Ending, Progress, runs_in_parallel};
#[cfg(feature = "results")]
use crate::shard::Shard;

#[cfg(feature = "results")]
pub(crate) use files::identity;
#[cfg(feature = "results")]
pub use files::is_shard_of_check;

/// Who makes the runs of a check.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum Deal {
    /// This process makes all of them.
    #[default]
    All,
    #[cfg(feature = "results")]
    /// It makes those of a shard and stores them in a file; the answer of the check has no
    /// meaning then.
    Part {
        /// Which shard.
        shard: Shard,
        /// The file; one that holds the same shard of the same check is left as it is.
        file: PathBuf,
    },
    #[cfg(feature = "results")]
    /// They were made by others, who stored them in these files.
    Merged {
        /// The files of all shards, in any order.
        files: Vec<PathBuf>,
    },
}

/// A run that is stored as numbers.
#[cfg_attr(not(feature = "results"), expect(dead_code))]
pub(crate) trait Stored: Sized + Send {
    /// Adds its numbers.
    fn to_numbers(&self, numbers: &mut Vec<f64>);
    /// Takes them back; `None` if they are not those of a run.
    fn from_numbers(numbers: &mut Numbers<'_>) -> Option<Self>;
}

/// Numbers that are taken one after another.
pub(crate) struct Numbers<'n>(&'n [f64]);

impl Numbers<'_> {
    /// The next number.
    pub(crate) fn take(&mut self) -> Option<f64> {
        let (first, rest) = self.0.split_first()?;
        self.0 = rest;
        Some(*first)
    }

    /// The next number, as one of things that are left.
    pub(crate) fn count(&mut self) -> Option<usize> {
        let count = self.take()?;
        (count >= 0.0 && count <= self.0.len() as f64 && count.fract() == 0.0)
            .then_some(count as usize)
    }

    /// As many things as the next number says.
    pub(crate) fn list<T>(
        &mut self,
        mut one: impl FnMut(&mut Self) -> Option<T>,
    ) -> Option<Vec<T>> {
        (0..self.count()?).map(|_| one(self)).collect()
    }
}

/// What a run is, or why it failed.
type Made<T> = Result<T, String>;

impl Deal {
    /// The runs from zero to `count - 1`, made by `make` here or taken from those who made them.
    ///
    /// # Errors
    /// [`CheckError::Shards`] for files that are not all shards of this check.
    pub(crate) fn runs<T: Stored>(
        &self,
        identity: impl FnOnce() -> String,
        count: usize,
        (threads, progress): (usize, Progress<'_>),
        make: impl Fn(usize, &mut Ending<'_>) -> Made<T> + Sync,
    ) -> Result<Vec<Made<T>>, CheckError> {
        #[cfg(not(feature = "results"))]
        let _ = identity;
        match self {
            Self::All => runs_in_parallel(count, threads, progress, make),
            #[cfg(feature = "results")]
            Self::Part { shard, file } => {
                let on = (threads, progress);
                files::part((*shard, file), &identity(), count, on, make)
            }
            #[cfg(feature = "results")]
            Self::Merged { files } => files::merged(files, &identity(), count),
        }
    }
}

/// Nothing is stored, and so nothing has to be known again.
#[cfg(not(feature = "results"))]
pub(crate) fn identity(
    _what: &str,
    _asked: &dyn std::fmt::Debug,
    _case: &pounding_case::Case,
    _records: &[super::CaseUnderRecord],
) -> String {
    String::new()
}
