//! One result from the results of all shards.

use std::path::{Path, PathBuf};

use pounding_files::FileUse;
use pounding_results::Label;
use pounding_results::study::{Description, MergeOptions, ResultWriter, Shards};

use crate::error::StudyError;
use crate::sweep::{default_result, of_this_study};
use crate::table::RunTable;

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
    /// Shards that are still missing, ascending, and of how many.
    pub missing: (Vec<usize>, usize),
}

/// Merges the results of all shards of a study into one, and into a table if `csv` names
/// a file. The result is that of one call for the whole study; one of several shards, if a partial
/// merge lacks some.
///
/// # Errors
/// [`StudyError::FileUse`] if the output or the table is one of the files,
/// as [`Shards::open`], [`StudyError::NotMerged`] if runs of the study would be lost that stand
/// in the place of the output alone, or [`StudyError::ResultFile`].
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
    let shards = Shards::open(files, options)?;
    let mut report = MergeReport {
        unchecked: shards.unchecked().to_vec(),
        builds: shards.builds().to_vec(),
        missing: (shards.missing().to_vec(), shards.description().part.count()),
        ..MergeReport::default()
    };
    let whole = shards.description();
    spare_what_is_not_merged(whole, output)?;
    let mut writer = ResultWriter::create(output, whole, shards.count()?)?;
    if let Some(study) = study_file(files, whole, output) {
        writer = writer.of_study_file(whole, &study);
    }
    let mut table = csv.map(|path| RunTable::create(path, whole)).transpose()?;
    shards.rows(|row, point| {
        report.runs += 1;
        report.failed += usize::from(row.ending.failed());
        report.collapsed += usize::from(row.ending.collapsed());
        if let Some(table) = &mut table {
            table.push(&row, &point)?;
        }
        writer.push(row, point).map_err(StudyError::from)
    })?;
    if let Some(table) = table {
        table.finish()?;
    }
    writer.finish()?;
    Ok(report)
}

/// The study file that the merged result says it is of, as one call would: that of the shards, under
/// the default name of the whole.
fn study_file(shards: &[PathBuf], merged: &Description, output: &Path) -> Option<PathBuf> {
    let mut labels = shards.iter().filter_map(|shard| Label::of(shard));
    let file = PathBuf::from(labels.find(|label| !label.file.is_empty())?.file);
    // As seen from this folder it may be another file, or none.
    let content = pounding_files::input::read(&file).ok()?;
    let says_it = !merged.part.is_whole() || output == default_result(&file);
    (says_it && content == merged.study.as_bytes()).then_some(file)
}

/// A result of the study stays where it holds shards that these files do not: what has been
/// computed is not lost by a wrong name.
fn spare_what_is_not_merged(merged: &Description, output: &Path) -> Result<(), StudyError> {
    let Some(found) = Label::of(output).and_then(|label| label.study) else {
        return Ok(());
    };
    let held = merged.part.is_whole()
        || found.part.count() == merged.part.count()
            && found
                .part
                .shards()
                .iter()
                .all(|shard| merged.part.shards().contains(shard));
    match found.sha256 == merged.study_sha256 && !held {
        true => Err(StudyError::NotMerged {
            path: output.to_owned(),
            reason: of_this_study(&found.part),
        }),
        false => Ok(()),
    }
}
