//! Shards of a study.

use std::str::FromStr;

use pounding_results::study::{MOST_SHARDS, Part};

use crate::error::StudyError;

/// Part `index` of `count` of a study.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    /// Which, from 1.
    pub index: usize,
    /// Of how many.
    pub count: usize,
}

impl Shard {
    /// All runs.
    pub const WHOLE: Self = Self { index: 1, count: 1 };

    /// Whether there can be such a one.
    pub(crate) fn exists(self) -> bool {
        self.count <= MOST_SHARDS && (1..=self.count).contains(&self.index)
    }

    /// What its result holds; the whole study if its numbers cannot be.
    pub(crate) fn part(self) -> Part {
        Part::of(vec![self.index], self.count).unwrap_or_else(Part::whole)
    }
}

impl FromStr for Shard {
    type Err = StudyError;

    /// Reads `i/n`.
    fn from_str(text: &str) -> Result<Self, StudyError> {
        let parts = text.split_once('/');
        let numbers =
            parts.and_then(|(i, n)| Some((i.trim().parse().ok()?, n.trim().parse().ok()?)));
        match numbers.map(|(index, count)| Self { index, count }) {
            Some(shard) if shard.exists() => Ok(shard),
            _ => Err(StudyError::Shard {
                text: text.to_owned(),
            }),
        }
    }
}

/// What holds these shards of this study.
pub(crate) fn of_this_study(part: &Part) -> String {
    match part.is_whole() {
        true => "it is the result of the whole study".to_owned(),
        false => format!("it is {part} of this study"),
    }
}
