//! The shards of a study, which make one result.

use std::path::PathBuf;

use pounding_files::checksum::{Checksum, WithoutChecksum};

use super::{Description, ResultReader, Row, StudyFileError, Value};

/// How shards are merged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct MergeOptions {
    /// Shards that different builds of the program computed may be mixed; the result says which
    /// build computed which.
    pub mixed_builds: bool,
    /// What to do with shards that have no checksum.
    pub without_checksum: WithoutChecksum,
}

/// All shards of a study, in their order.
#[derive(Debug)]
pub struct Shards {
    ordered: Vec<ResultReader>,
    description: Description,
    unchecked: Vec<PathBuf>,
    builds: Vec<String>,
}

impl Shards {
    /// Opens the results of all shards of a study.
    ///
    /// # Errors
    /// [`StudyFileError::Checksum`] if a file is not as it was written,
    /// [`StudyFileError::Merge`] if the files are not all shards of one study,
    /// [`StudyFileError::MixedBuilds`], or [`StudyFileError::File`].
    pub fn open(files: &[PathBuf], options: MergeOptions) -> Result<Self, StudyFileError> {
        let readers = files
            .iter()
            .map(|f| ResultReader::open(f, options.without_checksum))
            .collect::<Result<Vec<_>, _>>()?;
        let order = ordered(files, &readers)?;
        let builds = builds(&order);
        if builds.len() > 1 && !options.mixed_builds {
            return Err(mixed(files, &readers, &builds));
        }
        let unchecked = unchecked(files, &readers)?;
        let mut description = Description {
            shard: (1, 1),
            ..order[0].description.clone()
        };
        let mut listed = Vec::new();
        if builds.len() > 1 {
            listed = with_shards(&order, &builds);
            description.build = listed.join("\n");
            description.version = versions(&order);
        }
        let mut ordered = readers;
        ordered.sort_by_key(|reader| reader.description.shard.0);
        Ok(Self {
            ordered,
            description,
            unchecked,
            builds: listed,
        })
    }

    /// What the result of the whole study says beside its rows.
    #[must_use]
    pub fn description(&self) -> &Description {
        &self.description
    }

    /// Shards without a checksum: damage that does not show in their form was not seen.
    #[must_use]
    pub fn unchecked(&self) -> &[PathBuf] {
        &self.unchecked
    }

    /// Builds that computed the shards, each with them, if there are several.
    #[must_use]
    pub fn builds(&self) -> &[String] {
        &self.builds
    }

    /// Hands out all rows with the values of their variables, in the order of the runs.
    ///
    /// # Errors
    /// [`StudyFileError::File`], [`StudyFileError::Merge`] if a shard lacks a run, and what
    /// `take` returns.
    pub fn rows<E: From<StudyFileError>>(
        &self,
        mut take: impl FnMut(Row, Vec<Value>) -> Result<(), E>,
    ) -> Result<(), E> {
        let (runs, chunk) = (self.description.runs, self.description.chunk);
        for (number, start) in (0..runs).step_by(chunk).enumerate() {
            let reader = &self.ordered[number % self.ordered.len()];
            let from = number / self.ordered.len() * chunk;
            let expected = chunk.min(runs - start);
            let rows = reader.block(from..(from + expected).min(reader.rows))?;
            let numbers = rows.iter().map(|(r, _)| r.run);
            if rows.len() != expected || !numbers.eq(start..start + expected) {
                return Err(E::from(StudyFileError::Merge {
                    reason: format!(
                        "a shard has not the runs {start} to {}",
                        start + expected - 1
                    ),
                }));
            }
            for (row, point) in rows {
                take(row, point)?;
            }
        }
        Ok(())
    }
}

/// Files without a checksum, each of them read to its end: if that fails, or brings the
/// HDF5 library down, nothing is written yet.
fn unchecked(files: &[PathBuf], readers: &[ResultReader]) -> Result<Vec<PathBuf>, StudyFileError> {
    let mut unchecked = Vec::new();
    for (file, reader) in files.iter().zip(readers) {
        if reader.checksum == Checksum::Absent {
            for start in (0..reader.rows).step_by(READ_AT_ONCE) {
                reader.block(start..(start + READ_AT_ONCE).min(reader.rows))?;
            }
            unchecked.push(file.clone());
        }
    }
    Ok(unchecked)
}

/// Missing shards that are named.
const MOST_NAMED: usize = 1000;

/// Rows that are read at once to see whether they can be read.
const READ_AT_ONCE: usize = 1024;

/// The builds that computed the shards, in order of their first shards.
fn builds<'r>(ordered: &[&'r ResultReader]) -> Vec<&'r str> {
    let mut builds: Vec<&str> = Vec::new();
    for reader in ordered {
        let build = reader.description.build.as_str();
        if !builds.contains(&build) {
            builds.push(build);
        }
    }
    builds
}

/// A build as people read it.
fn named(build: &str) -> &str {
    match build {
        "" => "a version that did not record its build",
        build => build,
    }
}

/// Refuses builds that differ, with the files of each.
fn mixed(files: &[PathBuf], readers: &[ResultReader], builds: &[&str]) -> StudyFileError {
    let line = |build: &&str| {
        let its = files.iter().zip(readers);
        let its = its.filter(|(_, r)| r.description.build == *build);
        let its: Vec<String> = its.map(|(f, _)| f.display().to_string()).collect();
        format!("{}: {}", named(build), its.join(", "))
    };
    StudyFileError::MixedBuilds {
        list: builds.iter().map(line).collect::<Vec<_>>().join("\n"),
    }
}

/// Each build with its shards, as the result says it.
fn with_shards(ordered: &[&ResultReader], builds: &[&str]) -> Vec<String> {
    let line = |build: &&str| {
        let its = ordered.iter().filter(|r| r.description.build == *build);
        let its: Vec<String> = its.map(|r| r.description.shard.0.to_string()).collect();
        format!(
            "shards {} of {}: {}",
            its.join(", "),
            ordered.len(),
            named(build)
        )
    };
    builds.iter().map(line).collect()
}

/// The versions that computed the shards.
fn versions(ordered: &[&ResultReader]) -> String {
    let mut versions: Vec<&str> = Vec::new();
    for reader in ordered {
        let version = reader.description.version.as_str();
        if !versions.contains(&version) {
            versions.push(version);
        }
    }
    versions.join(", ")
}

/// The shards in order, if they are all there.
fn ordered<'r>(
    files: &[PathBuf],
    readers: &'r [ResultReader],
) -> Result<Vec<&'r ResultReader>, StudyFileError> {
    let wrong = |reason: String| StudyFileError::Merge { reason };
    let first = readers
        .first()
        .ok_or_else(|| wrong("no files are given".to_owned()))?;
    let count = first.description.shard.1;
    // A list of thousands would help nobody.
    let missing = count.saturating_sub(files.len());
    if missing > MOST_NAMED {
        return Err(wrong(format!("{missing} of {count} shards are missing")));
    }
    let mut ordered: Vec<Option<&ResultReader>> = vec![None; count];
    for (reader, file) in readers.iter().zip(files) {
        let shown = file.display();
        let (mine, its) = (&first.description, &reader.description);
        if its.study_sha256 != mine.study_sha256 {
            return Err(wrong(format!(
                "{shown} is of another study, or of another version of it, than {}",
                files[0].display()
            )));
        }
        if [its.runs, its.chunk] != [mine.runs, mine.chunk]
            || (&its.layout, &its.coordinates) != (&mine.layout, &mine.coordinates)
        {
            return Err(wrong(format!(
                "{shown} does not have the runs, variables, storeys and levels of {}",
                files[0].display()
            )));
        }
        if its.shard.1 != count {
            return Err(wrong(format!(
                "{shown} is one of {} shards, {} one of {count}",
                its.shard.1,
                files[0].display()
            )));
        }
        let place = its.shard.0.checked_sub(1).and_then(|i| ordered.get_mut(i));
        match place {
            Some(place) if place.is_none() => *place = Some(reader),
            _ => {
                return Err(wrong(format!(
                    "{shown} is shard {}/{count} once more",
                    its.shard.0
                )));
            }
        }
    }
    let missing: Vec<String> = ordered
        .iter()
        .enumerate()
        .filter(|(_, r)| r.is_none())
        .map(|(i, _)| format!("{}/{count}", i + 1))
        .collect();
    if !missing.is_empty() {
        return Err(wrong(format!("missing {}", missing.join(", "))));
    }
    Ok(ordered.into_iter().flatten().collect())
}
