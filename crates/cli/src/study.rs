//! Running a study: options, progress, and what is said at the end.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::time::Duration;

use pounding_case::Dimension;
use pounding_catalogue::wording::{agreeing, counted};
use pounding_files::checksum::{ChecksumError, WithoutChecksum, check, hexadecimal};
use pounding_files::{FileUse, free_name};
use pounding_report::page::SweepAnswer;
use pounding_results::{Kind, Label};
use pounding_study::{
    Progress as Stand, Shard, ShardName, Study, StudyError, StudyFileError, SweepOptions,
    SweepReport, default_result, parts_folder, study_name, sweep as make, writable, writable_table,
};
use serde::Serialize;
use sha2::{Digest, Sha256};

use crate::arguments::{RunningArguments, ShardArguments, value};
use crate::command_words::{is_child, shell_line, this_command, this_command_resumed};
use crate::exit_code::RUNS_ARE_LEFT;
use crate::failure::Failure;
use crate::files::{Replaced, name_left_over, no_result_comes, reads_too};
use crate::heartbeat::{Heartbeat, State};
use crate::interruption;
use crate::output::note;
use crate::progress::{Progress, Unit};
use crate::separate::{Reading, reading};
use crate::tables::warning_lines;

/// The shard that arguments name; `None` for the whole study. The only shard of a study is one as any
/// other: a plan that has no more of them merges it.
pub fn shard(
    sharing: &ShardArguments,
    running: &RunningArguments,
) -> Result<Option<Shard>, Failure> {
    let refused = |message: &str, help: &str| Err(Failure::input(message, Some(help.to_owned())));
    if sharing.into.is_some() {
        if sharing.shard.is_none() {
            return refused(
                "--into is a folder of shards, and the whole study is none",
                "add --shard I/N or --plan, or name the result with -o",
            );
        }
        if running.output.is_some() {
            return refused(
                "a shard has a name of its own in the folder --into",
                "leave -o away, or --into",
            );
        }
    }
    match &sharing.shard {
        Some(text) => Ok(Some(text.parse()?)),
        None => Ok(None),
    }
}

/// Reads a study; one whose values take long to try in its case says so.
pub fn read(path: &Path) -> Result<Study, Failure> {
    let _progress = Progress::working(format!("reading {}", path.display()))?;
    Ok(Study::read(path)?)
}

/// How a study is run, as the arguments say; finds out before the runs that the result
/// has no place, or would have that of a file that is read.
pub fn options(
    study: &Study,
    running: &RunningArguments,
    (shard, into): (Option<Shard>, Option<&Path>),
    files: &mut FileUse,
) -> Result<SweepOptions, Failure> {
    let output = match (&running.output, into) {
        (Some(output), _) => output.to_path_buf(),
        (None, into) => {
            let output = default_output(&study.file, shard);
            match into {
                // Nothing that is read lies in that folder, and no other output.
                Some(folder) => {
                    let made = std::fs::create_dir_all(folder);
                    made.map_err(|e| Failure::output(&e, &folder.display().to_string()))?;
                    folder.join(output)
                }
                None => {
                    files.writes("result", &output);
                    output
                }
            }
        }
    };
    if running.output.is_none() {
        name_left_over(&output);
    }
    if into.is_none() {
        let folder = "the folder of its finished runs, which is removed at the end";
        files.fills(folder, parts_folder(&output));
    }
    reads_too(files, study.files())?;
    // What stands there and is gone on with is left as it is where it is complete, and refused else.
    let goes_on = running.resume || into.is_some();
    if !(goes_on && output.is_file()) {
        writable(&output)?;
    }
    let replaced = Replaced {
        output: &output,
        kind: Kind::Study,
        file: Some(&study.file),
        text_sha256: Some(text_sha256(study)),
        named: running.output.is_some() || into.is_some(),
    };
    let ahead = replaced.spared(goes_on)?;
    if let Some(csv) = &running.csv {
        table_has_a_place(csv)?;
    }
    let seconds = value(&running.store_every, "store-every", Dimension::TIME)?;
    let store_every = Duration::try_from_secs_f64(seconds).map_err(|_| {
        Failure::input(
            format!(
                "--store-every: {:?} is no time to wait",
                running.store_every
            ),
            Some("give a time such as \"5 s\"".to_owned()),
        )
    })?;
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    ahead.say();
    Ok(SweepOptions {
        output,
        csv: running.csv.as_deref().map(Path::to_owned),
        threads: running.threads.map_or(cores, |n| n as usize),
        shard: shard.unwrap_or(Shard::WHOLE),
        // What stands in a folder of shards is gone on with, or refused.
        resume: goes_on,
        store_every,
        keep_going: running.keep_going,
        shared: into.map(Path::to_owned),
    })
}

/// The study's name, or that of its folder where it is called `study.toml`.
pub fn name(study: &Path) -> String {
    study_name(study).to_string_lossy().into_owned()
}

/// Finds out before the runs are made or merged that their table has no place.
pub fn table_has_a_place(csv: &Path) -> Result<(), Failure> {
    no_result_comes(csv)?;
    writable_table(csv)?;
    Ok(())
}

fn default_output(study: &Path, shard: Option<Shard>) -> PathBuf {
    match shard {
        None => default_result(study),
        Some(shard) => ShardName::of_study_file(study, shard).result(),
    }
}

/// Has another process read the result that a call stands before which goes on, and do all that is
/// asked of it; false where runs are left to be made, which is the work of this process.
pub fn stands_complete(
    options: &SweepOptions,
    running: &RunningArguments,
    files: &FileUse,
) -> Result<bool, Failure> {
    if !options.resume || !options.output.is_file() {
        return Ok(false);
    }
    if options.shared.is_some() && !running.read_in_this_process {
        damaged_goes_aside(&options.output)?;
    }
    let read = [options.output.clone()];
    match reading(&read, files, running.read_in_this_process) {
        Ok(reading) => Ok(matches!(reading, Reading::Done)),
        Err(Failure::Reported(RUNS_ARE_LEFT)) => Ok(false),
        Err(failure) => Err(failure),
    }
}

/// In a folder of shards nobody looks at each: a result that is damaged makes room for a new one, and
/// is kept beside it.
fn damaged_goes_aside(output: &Path) -> Result<(), Failure> {
    match check(output, WithoutChecksum::Refuse) {
        // Another program has opened it for writing since: what it is of is not known any more.
        Err(error) if error.is_damage() || matches!(error, ChecksumError::Absent) => {
            let aside = free_name(output);
            std::fs::rename(output, &aside)
                .map_err(|e| Failure::output(&e, &aside.display().to_string()))?;
            note(&format!(
                "{}: {error}; it is now {}, and its runs are made again",
                output.display(),
                aside.display()
            ));
            Ok(())
        }
        _ => Ok(()),
    }
}

/// Runs a study and shows how far it is, beside a terminal or a log also in the folder of its
/// shards. Asked to end, it stores what has finished, says how to go on, and ends the process.
pub fn run(
    study: &Study,
    options: &SweepOptions,
    into: Option<&Path>,
) -> Result<SweepReport, Failure> {
    // Until the folder of the finished runs is there, there is nothing to go on with.
    interruption::resume_with(shell_line(&this_command()));
    let mut begun = false;
    let name = ShardName::of_study_file(&study.file, options.shard);
    let mut heartbeat = match into.map(|folder| Heartbeat::begin(folder, &name)) {
        // A finished shard is read where nothing can be written any more.
        Some(Err(_)) if options.output.is_file() => None,
        begun => begun.transpose()?,
    };
    let progress = Progress::begin(Unit::Runs)?;
    let report = make(study, options, &mut |now| {
        if is_child() {
            // It was to read a result, and finds runs of an interrupted call instead.
            interruption::end_with(RUNS_ARE_LEFT);
        }
        if !std::mem::replace(&mut begun, true) {
            interruption::resume_with(this_command_resumed());
        }
        show(&progress, now);
        if let Some(heartbeat) = &mut heartbeat {
            heartbeat.beat(now);
        }
        // Once all runs are stored nobody looks any more: a signal ends the process at once.
        if !interruption::wait(now.stored < now.total) {
            return ControlFlow::Continue(());
        }
        if now.all_stored() {
            let stored = format!(
                "{} of {} {} stored",
                now.stored,
                counted(now.total, "run"),
                agreeing(&now.total, "is", "are")
            );
            if let Some(heartbeat) = &mut heartbeat {
                heartbeat.end(State::Interrupted, &stored);
            }
            interruption::leave(&stored);
        }
        ControlFlow::Break(())
    });
    drop(progress);
    if let Some(heartbeat) = &mut heartbeat {
        match &report {
            Ok(report) => heartbeat.done(report),
            Err(e @ StudyError::Interrupted { .. }) => {
                heartbeat.end(State::Interrupted, &e.to_string());
            }
            // The process that is at work there says how far it is.
            Err(StudyError::Busy { .. }) => {}
            Err(e) => heartbeat.failed(&e.to_string(), stands(options, study)),
        }
    }
    Ok(report?)
}

/// Whether a result of the shard stands there, and whether it is of the study as its file says it now:
/// another text makes it one of an earlier version, which no call replaces.
fn stands(options: &SweepOptions, study: &Study) -> (bool, bool) {
    let found = Label::of(&options.output).and_then(|label| label.study);
    let Some(found) = found else {
        return (false, false);
    };
    let (shard, part) = (options.shard, &found.part);
    let is_shard = part.count() == shard.count && part.shards() == [shard.index];
    (is_shard, found.text_sha256 == text_sha256(study))
}

/// SHA-256 of the text of a study.
pub fn text_sha256(study: &Study) -> String {
    hexadecimal(&Sha256::digest(&study.source))
}

fn show(progress: &Progress, now: &Stand) {
    let mut more = String::new();
    for (count, what) in [(now.failed, "failed"), (now.collapsed, "collapsed")] {
        if count > 0 {
            more.push_str(&format!(", {count} {what}"));
        }
    }
    // Rate and remaining time are those of this call.
    tracing::debug!(made = now.made, of = now.total, failed = now.failed, "runs");
    progress.show(now.made, now.total - now.stored_before, &more);
}

/// A study of which no run succeeded has computed nothing. Of a shard that is not known: its
/// result is complete, and the whole decides.
pub fn all_failed(report: &SweepReport, shard: Option<Shard>) -> Result<(), Failure> {
    match report.failures.first() {
        _ if shard.is_some() => Ok(()),
        Some((run, reason)) if report.failed == report.runs => Err(Failure::computation(
            format!("{}; run {run}: {reason}", none_succeeded(report.runs)),
            Some(shows_a_run(*run)),
        )),
        _ => Ok(()),
    }
}

/// Of a study of which no run succeeded.
pub fn none_succeeded(runs: usize) -> String {
    match runs {
        1 => "the only run failed".to_owned(),
        runs => format!("all {runs} runs failed"),
    }
}

/// How to see the case of a run.
pub fn shows_a_run(run: usize) -> String {
    format!("pounding sweep STUDY --show {run} prints the case of run {run}")
}

/// The object that `--json` prints.
#[derive(Serialize)]
pub struct Finished<'s> {
    status: &'static str,
    runs: usize,
    made: usize,
    failed: usize,
    first_failures: Vec<Diagnosed<'s>>,
    collapsed: usize,
    first_collapses: Vec<Diagnosed<'s>>,
    unseated: usize,
    study_sha256: &'s str,
    warnings: &'s [String],
    records: Vec<Motion<'s>>,
    output: String,
    csv: Option<String>,
    /// What the runs come to; absent of a shard, and where they are evaluated otherwise.
    #[serde(skip_serializing_if = "Option::is_none")]
    answer: Option<SweepAnswer>,
}

/// A run by its number, and what is to be said of it.
#[derive(Serialize)]
struct Diagnosed<'s> {
    run: usize,
    diagnosis: &'s str,
}

/// A record of a study.
#[derive(Serialize)]
struct Motion<'s> {
    name: &'s str,
    sha256: &'s str,
    intensity_as_recorded: Option<f64>,
}

impl<'s> Finished<'s> {
    /// A finished study, with its files.
    pub fn of(report: &'s SweepReport, options: &SweepOptions) -> Self {
        let diagnosed = |first: &'s [(usize, String)]| {
            let runs = first.iter();
            runs.map(|(run, diagnosis)| Diagnosed {
                run: *run,
                diagnosis,
            })
            .collect()
        };
        let records = report.records.iter().map(|r| Motion {
            name: &r.name,
            sha256: &r.sha256,
            intensity_as_recorded: r.intensity,
        });
        Self {
            status: "complete",
            runs: report.runs,
            made: report.made,
            failed: report.failed,
            first_failures: diagnosed(&report.failures),
            collapsed: report.collapsed,
            first_collapses: diagnosed(&report.collapses),
            unseated: report.unseated,
            study_sha256: &report.study_sha256,
            warnings: &report.warnings,
            records: records.collect(),
            output: options.output.display().to_string(),
            csv: options.csv.as_ref().map(|p| p.display().to_string()),
            answer: None,
        }
    }

    /// The same with what the runs come to.
    pub fn with_answer(self, answer: Option<SweepAnswer>) -> Self {
        Self { answer, ..self }
    }
}

/// What a sweep prints at its end.
pub fn summary(study: &Study, report: &SweepReport, options: &SweepOptions) -> String {
    let mut text = String::new();
    if !study.title.is_empty() {
        text.push_str(&format!("{}\n", study.title));
    }
    text.push_str(&warning_lines(&report.warnings));
    let before = report.runs - report.made;
    text.push_str(&format!(
        "{} in {}",
        counted(report.runs, "run"),
        options.output.display()
    ));
    if before > 0 {
        text.push_str(&format!(", {before} of them stored by an earlier call"));
    }
    text.push_str(&match report.failed {
        0 => "; none failed\n".to_owned(),
        n => format!("; {n} failed:\n"),
    });
    text.push_str(&listed(&report.failures, report.failed));
    if report.collapsed > 0 {
        text.push_str(&format!(
            "Collapse in {}:\n",
            counted(report.collapsed, "run")
        ));
        text.push_str(&listed(&report.collapses, report.collapsed));
    }
    if report.unseated > 0 {
        text.push_str(&format!(
            "The deck falls in {}: joints open further than their seats are wide (peak_opening)\n",
            counted(report.unseated, "run")
        ));
    }
    if let Some(csv) = &options.csv {
        text.push_str(&format!("Table written to {}\n", csv.display()));
    }
    text
}

/// What the runs of a sweep come to, a line for each sentence.
pub fn summary_lines(answer: &SweepAnswer) -> Vec<String> {
    let sentences = answer.sentences();
    let lines = sentences.iter().map(|s| format!("{}\n", s.text()));
    lines.collect()
}

/// The first few runs of a kind, a line each.
fn listed(first: &[(usize, String)], all: usize) -> String {
    let mut text = String::new();
    for (run, reason) in first {
        text.push_str(&format!("  run {run}: {reason}\n"));
    }
    if all > first.len() {
        text.push_str("  ... all of them in the group failures of the result\n");
    }
    text
}

impl From<StudyError> for Failure {
    fn from(error: StudyError) -> Self {
        let help = error.help();
        match error {
            StudyError::Text { error, source_text } => Self::case(*error, &source_text),
            StudyError::Several { errors } => {
                Self::together(errors.into_iter().map(Self::from).collect())
            }
            StudyError::Base(error) => Self::assembly(error, ""),
            e @ (StudyError::Store { .. }
            | StudyError::Table { .. }
            | StudyError::NotOwn { .. }
            | StudyError::ResultFile(
                StudyFileError::File { what: "write", .. }
                | StudyFileError::NoPlace { .. }
                | StudyFileError::Aside { .. },
            )) => Self::unwritten(e.to_string(), help),
            e @ StudyError::File { what, .. }
                if what.starts_with("write") || what.starts_with("make") =>
            {
                Self::unwritten(e.to_string(), help)
            }
            e @ (StudyError::Evaluation { .. } | StudyError::NoDemand { .. }) => {
                Self::computation(e.to_string(), help)
            }
            e if e.is_short_of_files() => Self::computation(e.to_string(), help),
            e @ StudyError::Interrupted { .. } => Self::interrupted(e.to_string(), help),
            e => Self::input(e.to_string(), help),
        }
    }
}
