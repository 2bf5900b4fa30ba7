//! One result from the results of all shards.

use std::path::{Path, PathBuf};

use pounding_files::FileUse;
use pounding_files::checksum::{Checksum, WithoutChecksum};

use super::table::RunTable;
use super::{Description, ResultReader, ResultWriter};
use crate::error::StudyError;

/// How shards are merged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct MergeOptions {
    /// Shards that different builds of the program computed may be mixed; the result says which
    /// build computed which.
    pub mixed_builds: bool,
    /// What to do with shards that have no checksum.
    pub without_checksum: WithoutChecksum,
}

/// What a merged result holds.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct MergeReport {
    /// Its runs.
    pub runs: usize,
    /// Failed ones among them.
    pub failed: usize,
    /// Those in which a building collapsed.
    pub collapsed: usize,
    /// Shards without a checksum: damage that does not show in their form was not seen.
    pub unchecked: Vec<PathBuf>,
    /// Builds that computed the shards, each with them, if there are several.
    pub builds: Vec<String>,
}

/// Merges the results of all shards of a study into one, and into a table if `csv` names
/// a file. The result is that of one call for the whole study.
///
/// # Errors
/// [`StudyError::FileUse`] if the output or the table is one of the files,
/// [`StudyError::Checksum`] if a file is not as it was written, [`StudyError::Merge`] if the
/// files are not all shards of one study, [`StudyError::MixedBuilds`], or
/// [`StudyError::ResultFile`].
pub fn merge(
    files: &[PathBuf],
    output: &Path,
    csv: Option<&Path>,
    options: MergeOptions,
) -> Result<MergeReport, StudyError> {
    let mut used = FileUse::new();
    for file in files {
        used.reads("shard", file);
    }
    used.writes("output", output);
    if let Some(path) = csv {
        used.writes("table", path);
    }
    used.check()?;
    let readers = files
        .iter()
        .map(|f| ResultReader::open(f, options.without_checksum))
        .collect::<Result<Vec<_>, _>>()?;
    let ordered = ordered(files, &readers)?;
    let builds = builds(&ordered);
    if builds.len() > 1 && !options.mixed_builds {
        return Err(mixed(files, &readers, &builds));
    }
    let mut report = MergeReport {
        unchecked: unchecked(files, &readers)?,
        ..MergeReport::default()
    };
    let mut whole = Description {
        shard: (1, 1),
        ..ordered[0].description.clone()
    };
    if builds.len() > 1 {
        report.builds = with_shards(&ordered, &builds);
        whole.build = report.builds.join("\n");
        whole.version = versions(&ordered);
    }
    let (runs, chunk) = (whole.runs, whole.chunk);
    let mut writer = ResultWriter::create(output, &whole, runs)?;
    let mut table = csv.map(|path| RunTable::create(path, &whole)).transpose()?;
    for (number, start) in (0..runs).step_by(chunk).enumerate() {
        let reader = ordered[number % ordered.len()];
        let from = number / ordered.len() * chunk;
        let expected = chunk.min(runs - start);
        let rows = reader.block(from..(from + expected).min(reader.rows))?;
        let fits = rows.len() == expected
            && rows
                .iter()
                .enumerate()
                .all(|(i, (r, _))| r.run == start + i);
        if !fits {
            return Err(StudyError::Merge {
                reason: format!(
                    "a shard has not the runs {start} to {}",
                    start + expected - 1
                ),
            });
        }
        for (row, point) in rows {
            report.runs += 1;
            report.failed += usize::from(row.ending.failed());
            report.collapsed += usize::from(row.ending.collapsed());
            if let Some(table) = &mut table {
                table.push(&row, &point)?;
            }
            writer.push(row, point)?;
        }
    }
    if let Some(table) = table {
        table.finish()?;
    }
    writer.finish()?;
    Ok(report)
}

/// Files without a checksum, each of them read to its end: if that fails, or brings the
/// HDF5 library down, nothing is written yet.
fn unchecked(files: &[PathBuf], readers: &[ResultReader]) -> Result<Vec<PathBuf>, StudyError> {
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
fn mixed(files: &[PathBuf], readers: &[ResultReader], builds: &[&str]) -> StudyError {
    let line = |build: &&str| {
        let its = files.iter().zip(readers);
        let its = its.filter(|(_, r)| r.description.build == *build);
        let its: Vec<String> = its.map(|(f, _)| f.display().to_string()).collect();
        format!("{}: {}", named(build), its.join(", "))
    };
    StudyError::MixedBuilds {
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
) -> Result<Vec<&'r ResultReader>, StudyError> {
    let wrong = |reason: String| StudyError::Merge { reason };
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
