//! The pounding command line.
//!
//! Exit codes: 0 done, 1 the answer is "no", 2 bad input, 3 the computation
//! failed, 4 output could not be written, 5 interrupted by a signal.

mod arguments;
mod asked_separation;
mod color;
mod columns;
mod command_words;
mod commands;
mod deal;
mod descriptor;
mod excerpt;
mod exit_code;
mod failure;
mod faults;
mod files;
mod heartbeat;
mod interruption;
mod logging;
mod output;
mod page;
mod plan;
mod plot;
mod progress;
mod separate;
mod study;
mod tables;
mod terminal;
mod tip;
mod version;

use std::ffi::OsString;
use std::io::Write;
use std::path::PathBuf;

use clap::{CommandFactory, FromArgMatches};
use pounding_files::FileUse;

pub use arguments::PathKind;
pub use failure::Failure;

use version::Version;

/// What commands read and answer, without printing: for the Python package, whose objects say
/// the same.
pub mod answers {
    pub use crate::asked_separation::{Asked as AskedOfGaps, overridden};
    pub use crate::commands::check::Understood;
    pub use crate::commands::compare::numbers::Compared;
    pub use crate::commands::gap::numbers::Check;
    pub use crate::commands::ida::numbers::Analysis;
    pub use crate::commands::models::descriptor::Described as DescribedModel;
    pub use crate::faults::of_check;
    pub use crate::files::{Replaced, inputs_stay_meanwhile, page_judged};
    pub use crate::separate::{Answer as AnswerOfChild, answered as answered_by_child};
    pub use crate::study::{Finished, text_sha256};
}

/// All commands with their arguments, as the program knows them.
#[must_use]
pub fn command() -> clap::Command {
    arguments::Arguments::command()
}

/// Does what these arguments ask for, the first of which is the name of the program, and
/// returns the exit code.
#[must_use]
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    let given: Vec<OsString> = arguments.into_iter().collect();
    let command = color::apply(color::among(&given), command());
    let matches = command.clone().try_get_matches_from(&given);
    let whole = |m| arguments::all_is_there(&command, &given).map(|()| m);
    let matches = matches.and_then(whole);
    let read = matches.and_then(|m| Ok((arguments::Arguments::from_arg_matches(&m)?, m)));
    let (arguments, matches) = match read {
        Ok(read) => read,
        Err(error) => {
            let error = tip::that_works(error, &command, &given);
            let printed = error.print().and_then(|()| std::io::stdout().flush());
            return match (error.use_stderr(), printed) {
                // Where nobody can read a complaint, the exit code still says it.
                (true, _) => u8::try_from(error.exit_code()).unwrap_or(2),
                // Help that was asked for is an output as any other.
                (false, printed) => output::to_standard_output(printed)
                    .map_or_else(|failure| failure.report(), |()| 0),
            };
        }
    };
    let files = arguments::file_use(&command, &matches);
    files::say_what_is_replaced(&files);
    let done = files::inputs_stay(&files)
        .and_then(|()| files::shards_stay(&files))
        .and_then(|()| logging::begin(arguments.verbose, arguments.color))
        .and_then(|()| interruption::listen())
        .and_then(|()| answer(arguments, files));
    match done {
        Ok(()) => 0,
        Err(failure) => failure.report(),
    }
}

/// The same within a program that interprets another one, to which this process gave its own arguments.
#[must_use]
pub fn run_within(interpreter: PathBuf, arguments: impl IntoIterator<Item = OsString>) -> u8 {
    separate::take_program(interpreter);
    run(arguments)
}

/// The version, or what a command answers.
fn answer(arguments: arguments::Arguments, files: FileUse) -> Result<(), Failure> {
    if arguments.version {
        let version = Version::of_this_program();
        return if arguments.json {
            output::print(&output::pretty(&version)?)
        } else {
            output::print(&format!("pounding {}", version.version))
        };
    }
    match arguments.command {
        Some(command) => commands::dispatch(command, files),
        None => Err(Failure::input(
            "no command is given",
            Some("see `pounding --help` for the commands".to_owned()),
        )),
    }
}
