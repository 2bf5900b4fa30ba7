//! `pounding sweep`: many runs of one case.

use pounding_files::FileUse;
use pounding_study::case_of_run;

use crate::arguments::SweepArguments;
use crate::failure::Failure;
use crate::files::have_a_place;
use crate::output::{pretty, print, print_as_it_is};
use crate::page;
use crate::plan::{self, Planned};
use crate::study::{
    Finished, all_failed, options, read, run, shard, stands_complete, summary, summary_lines,
};

/// Runs a study, or shows what it would run.
pub fn sweep(arguments: &SweepArguments, mut files: FileUse) -> Result<(), Failure> {
    let study = read(&arguments.study)?;
    if let Some(run) = arguments.show {
        return print_as_it_is(&case_of_run(&study, run)?);
    }
    if let Some(scheduler) = arguments.planning.plan {
        let planned = Planned {
            command: "sweep",
            at_the_end: Vec::new(),
            written_at_the_end: &[arguments.running.report.as_deref()],
            running: &arguments.running,
            into: arguments.sharing.into.as_deref(),
            planning: &arguments.planning,
        };
        return plan::print_plan(&study, &planned, (scheduler, arguments.json), &mut files);
    }
    let shard = shard(&arguments.sharing, &arguments.running)?;
    let into = arguments.sharing.into.as_deref();
    let options = options(&study, &arguments.running, (shard, into), &mut files)?;
    if stands_complete(&options, &arguments.running, &files)? {
        return Ok(());
    }
    have_a_place([arguments.running.report.as_deref()])?;
    let report = run(&study, &options, into)?;
    // What a shard comes to is nobody's question, and its result is read for a page alone.
    let result = match (shard, &arguments.running.report) {
        (Some(_), None) => None,
        _ => Some(page::read_sweep(&options.output)?),
    };
    if let (Some(result), Some(path)) = (&result, &arguments.running.report) {
        page::write_sweep(result, &options.output, path)?;
    }
    let whole = result.as_ref().filter(|_| shard.is_none());
    let answer = whole.map(page::answer_of_sweep).transpose()?;
    if arguments.json {
        let finished = Finished::of(&report, &options);
        print(&pretty(&finished.with_answer(answer))?)?;
    } else {
        let mut text = summary(&study, &report, &options);
        text.push_str(&answer.iter().flat_map(summary_lines).collect::<String>());
        print(&text)?;
    }
    all_failed(&report, shard)
}
