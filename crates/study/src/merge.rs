//! One result from the results of all shards.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use pounding_files::FileUse;
use pounding_results::study::{Description, MergeOptions, ResultWriter, Shards};
use pounding_results::{Inputs, Label};

use crate::error::StudyError;
use crate::result_name::{has_default_name, refuse_name_of_shard};
use crate::shard::of_this_study;
use crate::study_file::Study;
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
/// [`StudyError::FileUse`] if the output or the table is one of the files, or one that the study reads,
/// or was made of ([`StudyError::Input`]), as [`Shards::open`], [`StudyError::NamedAsShard`], [`StudyError::NotMerged`] if runs of the study would be lost that stand
/// in the place of the output alone, or [`StudyError::ResultFile`].
pub fn merge(
    files: &[PathBuf],
    output: &Path,
    csv: Option<&Path>,
    options: MergeOptions,
) -> Result<MergeReport, StudyError> {
    merge_saying(files, output, csv, options, || ())
}

/// The same; `begins` is called once nothing refuses the output any more, before the runs are read.
///
/// # Errors
/// As [`merge`].
pub fn merge_saying(
    files: &[PathBuf],
    output: &Path,
    csv: Option<&Path>,
    options: MergeOptions,
    begins: impl FnOnce(),
) -> Result<MergeReport, StudyError> {
    let mut used = FileUse::new();
    for file in files {
        used.reads("shard", file);
    }
    for (role, file) in read_by_study(files) {
        used.reads(role, file);
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
        missing: (shards.missing().to_vec(), shards.shards()),
        ..MergeReport::default()
    };
    let whole = shards.description();
    refuse_name_of_shard(output, None)?;
    spare_what_is_not_merged(&shards, output)?;
    for path in [Some(output), csv].into_iter().flatten() {
        spare_inputs(whole, path)?;
    }
    let count = shards.count()?;
    begins();
    let mut writer = ResultWriter::create(output, whole, count)?;
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

/// The files that the study of these shards reads, as far as it is found where they say, with what
/// each is: merging reads none of them, and must replace none.
#[must_use]
pub fn read_by_study(shards: &[PathBuf]) -> Vec<(&'static str, PathBuf)> {
    let mut studies = BTreeSet::new();
    for label in shards.iter().filter_map(|shard| Label::of(shard)) {
        studies.insert(label.file);
    }
    let mut files = Vec::new();
    for study in studies.into_iter().map(PathBuf::from) {
        if study.is_file() {
            match Study::read(&study) {
                Ok(study) => files.extend(study.files()),
                Err(_) => files.push(("study", study)),
            }
        }
    }
    files
}

/// A file that the study was made of stays, even where the shards do not lead to it, as from another folder.
fn spare_inputs(whole: &Description, path: &Path) -> Result<(), StudyError> {
    let inputs = Inputs {
        texts: &[&whole.study, &whole.case],
        records: &whole.records,
    };
    match inputs.holds(path) {
        Some(what) => Err(StudyError::Input {
            path: path.to_owned(),
            what,
        }),
        None => Ok(()),
    }
}

/// The study file that the merged result says it is of, as one call would: that of the shards, under
/// the default name of the whole.
fn study_file(shards: &[PathBuf], merged: &Description, output: &Path) -> Option<PathBuf> {
    let mut labels = shards.iter().filter_map(|shard| Label::of(shard));
    let file = PathBuf::from(labels.find(|label| !label.file.is_empty())?.file);
    // As seen from this folder it may be another file, or none.
    let content = pounding_files::input::read(&file).ok()?;
    let says_it = !merged.part.is_whole() || has_default_name(output, &file);
    (says_it && content == merged.study.as_bytes()).then_some(file)
}

/// A result of the study stays where it holds shards that these files do not, of which those of
/// another dealing are: what has been computed is not lost by a wrong name, and no other set of shards
/// loses one.
fn spare_what_is_not_merged(shards: &Shards, output: &Path) -> Result<(), StudyError> {
    let merged = shards.description();
    let Some(label) = Label::of(output) else {
        return Ok(());
    };
    let Some(found) = label.study else {
        return Err(StudyError::NotMerged {
            path: output.to_owned(),
            reason: "another program has opened it for writing since, so that it may hold a shard"
                .to_owned(),
        });
    };
    let merges = |shard: &usize| merged.part.is_whole() || merged.part.shards().contains(shard);
    let held = match found.part.is_whole() {
        true => merged.part.is_whole(),
        false => found.part.count() == shards.dealing() && found.part.shards().iter().all(merges),
    };
    match found.sha256 == merged.study_sha256 && !held {
        true => Err(StudyError::NotMerged {
            path: output.to_owned(),
            reason: of_this_study(&found.part),
        }),
        false => Ok(()),
    }
}
