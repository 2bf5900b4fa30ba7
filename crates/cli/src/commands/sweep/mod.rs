//! `pounding sweep` and `pounding merge`: many runs of one case.

mod plan;

use pounding_catalogue::wording::counted;
use pounding_files::FileUse;
use pounding_study::{MergeOptions, Shard, Study, case_of_run, writable};
use serde::Serialize;

use crate::arguments::{MergeArguments, SweepArguments};
use crate::failure::Failure;
use crate::files::have_a_place;
use crate::output::{pretty, print, print_as_it_is, warn};
use crate::page;
use crate::separate::{Reading, reading, warnings};
use crate::study::{Finished, all_failed, options, run, summary};

/// Runs a study, or shows what it would run.
pub fn sweep(arguments: &SweepArguments, mut files: FileUse) -> Result<(), Failure> {
    let study = Study::read(&arguments.study)?;
    if let Some(run) = arguments.show {
        return print_as_it_is(&case_of_run(&study, run)?);
    }
    if arguments.plan {
        return plan::plan(&study, arguments);
    }
    let shard = match &arguments.shard {
        Some(text) => text.parse()?,
        None => Shard::WHOLE,
    };
    let options = options(&study, &arguments.running, shard, &mut files)?;
    have_a_place([arguments.running.report.as_deref()])?;
    let report = run(&study, &options)?;
    if let Some(path) = &arguments.running.report {
        page::of_sweep(&options.output, path)?;
    }
    if arguments.json {
        print(&pretty(&Finished::of(&report, &options))?)?;
    } else {
        print(&summary(&study, &report, &options))?;
    }
    all_failed(&report)
}

/// Merges the results of all shards.
pub fn merge(arguments: &MergeArguments) -> Result<(), Failure> {
    writable(&arguments.output)?;
    let shards: Vec<_> = arguments.shards.iter().map(|p| p.to_path_buf()).collect();
    let without_checksum = match reading(&shards, arguments.accept_without_checksum)? {
        Reading::Here(without) => without,
        Reading::Done => return Ok(()),
    };
    let merged = pounding_study::merge(
        &shards,
        &arguments.output,
        arguments.csv.as_deref(),
        MergeOptions {
            mixed_builds: arguments.allow_mixed_builds,
            without_checksum,
        },
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
    if arguments.json {
        return print(&pretty(&MergedShards {
            runs: merged.runs,
            failed: merged.failed,
            collapsed: merged.collapsed,
            output: arguments.output.display().to_string(),
            warnings: reported,
        })?);
    }
    print(&format!(
        "{}, {} of them failed and {} collapsed, merged from {} into {}",
        counted(merged.runs, "run"),
        merged.failed,
        merged.collapsed,
        counted(arguments.shards.len(), "shard"),
        arguments.output.display()
    ))
}

/// What `merge --json` prints.
#[derive(Serialize)]
struct MergedShards {
    runs: usize,
    failed: usize,
    collapsed: usize,
    output: String,
    warnings: Vec<String>,
}
