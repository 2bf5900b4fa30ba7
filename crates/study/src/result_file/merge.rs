//! One result from the results of all shards.

use std::path::{Path, PathBuf};

use pounding_files::FileUse;

use super::table::RunTable;
use super::{Description, ResultReader, ResultWriter};
use crate::error::StudyError;

/// What a merged result holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct MergeReport {
    /// Its runs.
    pub runs: usize,
    /// Failed ones among them.
    pub failed: usize,
    /// Those in which a building collapsed.
    pub collapsed: usize,
}

/// Merges the results of all shards of a study into one, and into a table if `csv` names
/// a file. The result is that of one call for the whole study.
///
/// # Errors
/// [`StudyError::FileUse`] if the output or the table is one of the files,
/// [`StudyError::Merge`] if the files are not all shards of one study, or
/// [`StudyError::ResultFile`].
pub fn merge(
    files: &[PathBuf],
    output: &Path,
    csv: Option<&Path>,
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
        .map(|f| ResultReader::open(f))
        .collect::<Result<Vec<_>, _>>()?;
    let ordered = ordered(files, &readers)?;
    let whole = Description {
        shard: (1, 1),
        ..ordered[0].description.clone()
    };
    let (runs, chunk) = (whole.runs, whole.chunk);
    let mut writer = ResultWriter::create(output, &whole, runs)?;
    let mut table = csv.map(|path| RunTable::create(path, &whole)).transpose()?;
    let mut report = MergeReport::default();
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
