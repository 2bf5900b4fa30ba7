//! One command per file.

mod calibrate;
mod check;
mod compare;
mod gap;
mod hysteresis;
mod ida;
mod impact;
mod models;
mod motion;
mod progress;
mod report;
mod run;
mod separate;
mod stiffness;
mod sweep;
mod verify;

pub use gap::failure as gap_failure;

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::CommandFactory;
use pounding_files::{FileUse, LeftOver, PartFile, left_over};
use pounding_study::gap_check::{self, CheckError, SkippedFile};

use self::separate::{is_child, note};
use crate::arguments::{Arguments, Command, ImpactCommand, InputPath};
use crate::failure::Failure;
use crate::tables::paragraphs;

/// Carries a command out. `files` are those of its arguments, held against one another
/// already; a command that reads or writes more adds them and checks again.
pub fn dispatch(command: Command, files: FileUse) -> Result<(), Failure> {
    if !is_child() {
        files.outputs().for_each(name_left_over);
    }
    match command {
        Command::Run(arguments) => run::run(&arguments, files),
        Command::Check { case, json } => check::check(&case, json),
        Command::Models { name, json, pages } => {
            models::models(name.as_deref(), json, pages.as_deref())
        }
        Command::Impact(arguments) => match &arguments.command {
            Some(ImpactCommand::Calibrate(arguments)) => calibrate::calibrate(arguments),
            None => impact::impact(&arguments),
        },
        Command::Gap(arguments) => gap::gap(&arguments, files),
        Command::Compare(arguments) => compare::run(&arguments, files),
        Command::Hysteresis(arguments) => hysteresis::hysteresis(&arguments),
        Command::Verify(arguments) => verify::verify(&arguments),
        Command::Stiffness(arguments) => stiffness::stiffness(&arguments),
        Command::Motion(command) => motion::motion(&command, files),
        Command::Sweep(arguments) => sweep::sweep(&arguments, files),
        Command::Merge(arguments) => sweep::merge(&arguments),
        Command::Ida(arguments) => ida::ida(&arguments, files),
        Command::Report {
            result,
            output,
            accept_without_checksum,
        } => report::report(&result, output.as_deref(), accept_without_checksum, files),
        Command::Schema => print(&pretty(&pounding_case::schema())),
        Command::Completions { shell } => {
            let mut bytes = Vec::new();
            clap_complete::generate(shell, &mut Arguments::command(), "pounding", &mut bytes);
            print_as_it_is(&String::from_utf8_lossy(&bytes))
        }
    }
}

/// Names the part files of an output that a killed process has left behind. They stay: on a
/// file system that several machines share, another one may write them.
pub fn name_left_over(output: &Path) {
    for LeftOver { path, process } in left_over(output) {
        note(&format!(
            "{} is an unfinished file of process {process}, which does not run on this machine: unless another machine is writing it, delete it",
            path.display()
        ));
    }
}

/// The records that arguments name, with those in folders; files in folders that are no records
/// are named.
pub fn record_files(given: &[InputPath]) -> Result<Vec<PathBuf>, CheckError> {
    let given: Vec<PathBuf> = given.iter().map(|p| p.to_path_buf()).collect();
    let found = gap_check::record_files(&given)?;
    for SkippedFile { path, what } in &found.skipped {
        note(&format!(
            "{} is {what}, not a record: it is left out",
            path.display()
        ));
    }
    Ok(found.files)
}

/// Adds files that a case or a study names to those of the arguments, and holds all against
/// one another: before any work is done.
pub fn reads_too(
    files: &mut FileUse,
    more: impl IntoIterator<Item = (&'static str, PathBuf)>,
) -> Result<(), Failure> {
    for (role, path) in more {
        files.reads(role, path);
    }
    Ok(files.check()?)
}

/// Finds out before the work, not after it, that outputs have no place.
pub fn have_a_place<'p>(
    outputs: impl IntoIterator<Item = Option<&'p Path>>,
) -> Result<(), Failure> {
    for path in outputs.into_iter().flatten() {
        PartFile::beside(path).map_err(|e| Failure::output(&e, &path.display().to_string()))?;
    }
    Ok(())
}

/// Prints to standard output: a text for people, whose lines are broken where the terminal
/// ends, or JSON, as it is.
pub fn print(text: &str) -> Result<(), Failure> {
    if text.starts_with(['{', '[']) {
        print_as_it_is(text)
    } else {
        print_as_it_is(&paragraphs(text))
    }
}

/// Prints to standard output what programs read. A reader that closed the pipe has seen
/// enough.
pub fn print_as_it_is(text: &str) -> Result<(), Failure> {
    let mut out = std::io::stdout().lock();
    match writeln!(out, "{}", text.trim_end()).and_then(|()| out.flush()) {
        Err(e) if e.kind() == std::io::ErrorKind::BrokenPipe => Ok(()),
        Err(e) => Err(Failure::output(&e, "to standard output")),
        Ok(()) => Ok(()),
    }
}

/// JSON for machines and people; numbers at full precision.
pub fn pretty(value: &serde_json::Value) -> String {
    format!("{value:#}")
}
