//! `pounding merge`: one result from the results of shards.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use pounding_catalogue::wording::counted;
use pounding_files::FileUse;
use pounding_files::checksum::WithoutChecksum;
use pounding_report::page::SweepAnswer;
use pounding_results::{Kind, Label};
use pounding_study::{Fault, MergeOptions, Survey, ranges, read_by_study, survey, writable};
use serde::Serialize;

use crate::arguments::MergeArguments;
use crate::failure::Failure;
use crate::files::{Replaced, reads_too, shard_files};
use crate::output::{pretty, print, warn};
use crate::page;
use crate::separate::{Reading, by_child, limited_memory, reading, warnings};
use crate::study::{none_succeeded, shows_a_run, summary_lines, table_has_a_place};

/// Merges the results of shards, or says whether they can be merged.
pub fn merge(arguments: &MergeArguments, mut files: FileUse) -> Result<(), Failure> {
    let shards = shard_files(&arguments.shards)?;
    if arguments.output.is_some() {
        reads_too(&mut files, read_by_study(&shards))?;
    }
    if let Some(output) = &arguments.output {
        writable(output)?;
        // Of what it goes on with nothing is said; what is replaced is known when the shards are.
        replaced(output, None).spared(true)?.say();
    }
    if let Some(csv) = &arguments.csv {
        table_has_a_place(csv)?;
    }
    let child = arguments.read_in_this_process;
    let without_checksum = match &arguments.output {
        Some(_) => reading(&shards, &files, child)?,
        None => looked_at(&shards, &files, child)?,
    };
    let without_checksum = match without_checksum {
        Reading::Here(without) => without,
        Reading::Done => return Ok(()),
    };
    match &arguments.output {
        Some(output) => merged(arguments, &shards, output, without_checksum),
        None => checked(arguments, &shards, without_checksum),
    }
}

/// What stands where shards of a study of this text are merged into.
fn replaced(output: &Path, text_sha256: Option<String>) -> Replaced<'_> {
    Replaced {
        output,
        kind: Kind::Study,
        file: None,
        text_sha256,
        named: true,
    }
}

/// Has a child look at all files, and another one at all but those at which the first came to no
/// answer: they are named among the faults.
fn looked_at(shards: &[PathBuf], files: &FileUse, child: bool) -> Result<Reading, Failure> {
    let mut known: Vec<OsString> = Vec::new();
    let mut unreadable = Vec::new();
    loop {
        let none = match by_child(shards, files, child, &known)? {
            Ok(reading) => return Ok(reading),
            Err(none) => none,
        };
        match none.file.filter(|number| !unreadable.contains(number)) {
            // The others would come to no answer either.
            Some(_) if limited_memory().is_some() => return Err(none.failure(shards)),
            Some(number) => {
                unreadable.push(number);
                known.push(format!("--unreadable={number}").into());
                known.push(format!("--because={}", none.reason()).into());
            }
            None => return Err(none.failure(shards)),
        }
    }
}

fn merged(
    arguments: &MergeArguments,
    shards: &[PathBuf],
    output: &Path,
    without_checksum: WithoutChecksum,
) -> Result<(), Failure> {
    // Not before, where another process may read them, and say it once more.
    let label = shards.first().and_then(|shard| Label::of(shard)?.study);
    let ahead = replaced(output, label.map(|study| study.text_sha256)).spared(false)?;
    let merged = pounding_study::merge_saying(
        shards,
        output,
        arguments.csv.as_deref(),
        MergeOptions {
            mixed_builds: arguments.allow_mixed_builds,
            without_checksum,
            partial: arguments.partial,
        },
        || ahead.say(),
    )?;
    let mut reported = warnings(&merged.unchecked);
    if !merged.builds.is_empty() {
        reported.push(format!(
            "the shards were computed by different builds of the program:\n{}",
            merged.builds.join("\n")
        ));
    }
    for text in &reported {
        warn(text);
    }
    let (missing, count) = &merged.missing;
    // What some of the shards come to is nobody's question.
    let answer = match missing.is_empty() {
        true => Some(page::answer_of_sweep(&page::read_sweep(output)?)?),
        false => None,
    };
    // A study of which all runs failed, as one call would say; of some shards that is not known.
    let ending = match merged.failed == merged.runs && missing.is_empty() {
        true => Err(Failure::computation(
            none_succeeded(merged.runs),
            Some(shows_a_run(0)),
        )),
        false => Ok(()),
    };
    if arguments.json {
        print(&pretty(&MergedShards {
            runs: merged.runs,
            failed: merged.failed,
            collapsed: merged.collapsed,
            output: output.display().to_string(),
            missing,
            warnings: reported,
            answer: answer.as_ref(),
        })?)?;
        return ending;
    }
    let mut text = format!(
        "{}, {} of them failed and {} collapsed, merged from {} into {}",
        counted(merged.runs, "run"),
        merged.failed,
        merged.collapsed,
        counted(count - missing.len(), "shard"),
        output.display()
    );
    if !missing.is_empty() {
        text.push_str(&format!(
            "\n{} of {count} shards are still missing: {}",
            missing.len(),
            ranges(missing)
        ));
    }
    text.push('\n');
    text.push_str(&answer.iter().flat_map(summary_lines).collect::<String>());
    print(&text)?;
    ending
}

/// What `merge --json` prints.
#[derive(Serialize)]
struct MergedShards<'m> {
    runs: usize,
    failed: usize,
    collapsed: usize,
    output: String,
    missing: &'m [usize],
    warnings: Vec<String>,
    /// What the runs come to; absent where shards are missing.
    #[serde(skip_serializing_if = "Option::is_none")]
    answer: Option<&'m SweepAnswer>,
}

/// Says what the files are; exit code 1 if they do not make one result.
fn checked(
    arguments: &MergeArguments,
    shards: &[PathBuf],
    without_checksum: WithoutChecksum,
) -> Result<(), Failure> {
    let known = |number: &usize| arguments.unreadable.contains(number);
    let all = shards.iter().enumerate();
    let readable = all.filter(|(number, _)| !known(number));
    let readable: Vec<PathBuf> = readable.map(|(_, file)| file.clone()).collect();
    let mut survey = survey(&readable, without_checksum);
    for (number, reason) in arguments.unreadable.iter().zip(&arguments.because) {
        if let Some(path) = shards.get(*number) {
            survey.faults.push(Fault::unreadable(path, reason));
        }
    }
    let merges = survey.faults.is_empty()
        && survey.count > 0
        && (survey.builds.len() < 2 || arguments.allow_mixed_builds)
        && (survey.missing.is_empty() || arguments.partial);
    if arguments.json {
        let faults = survey.faults.iter();
        print(&pretty(&Checked {
            merges,
            shards: survey.count,
            present: &survey.present,
            missing: &survey.missing,
            faults: faults
                .map(|f| Faulty {
                    file: f.path.display().to_string(),
                    reason: f.error.to_string(),
                })
                .collect(),
            builds: survey
                .builds
                .iter()
                .map(|(build, shards)| OfBuild { build, shards })
                .collect(),
            warnings: warnings(&survey.unchecked),
        })?)?;
    } else {
        print(&summary(&survey, merges))?;
    }
    match merges {
        true => Ok(()),
        false => Err(Failure::No),
    }
}

fn summary(survey: &Survey, merges: bool) -> String {
    let mut text = format!(
        "{} of {} are there",
        survey.present.len(),
        counted(survey.count, "shard")
    );
    if !survey.missing.is_empty() {
        text.push_str(&format!("; missing: {}", ranges(&survey.missing)));
    }
    text.push('\n');
    for fault in &survey.faults {
        text.push_str(&format!("  {}\n", fault.error));
    }
    if survey.builds.len() > 1 {
        text.push_str("The shards were computed by different builds of the program:\n");
        for (build, shards) in &survey.builds {
            text.push_str(&format!("  shards {}: {build}\n", ranges(shards)));
        }
    }
    for warning in warnings(&survey.unchecked) {
        text.push_str(&format!("warning: {warning}\n"));
    }
    text.push_str(match merges {
        true => "They can be merged.\n",
        false => "They cannot be merged.\n",
    });
    text
}

/// What `merge --check --json` prints.
#[derive(Serialize)]
struct Checked<'s> {
    merges: bool,
    shards: usize,
    present: &'s [usize],
    missing: &'s [usize],
    faults: Vec<Faulty>,
    builds: Vec<OfBuild<'s>>,
    warnings: Vec<String>,
}

#[derive(Serialize)]
struct Faulty {
    file: String,
    reason: String,
}

#[derive(Serialize)]
struct OfBuild<'s> {
    build: &'s str,
    shards: &'s [usize],
}
