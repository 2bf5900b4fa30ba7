//! The pounding command line.
//!
//! Exit codes: 0 done, 1 the answer is "no", 2 bad input, 3 the computation
//! failed, 4 output could not be written, 5 interrupted by a signal.

mod arguments;
mod columns;
mod commands;
mod descriptor;
mod failure;
mod faults;
mod files;
mod interruption;
mod output;
mod page;
mod plot;
mod progress;
mod separate;
mod study;
mod tables;

use std::process::ExitCode;

use clap::{CommandFactory, FromArgMatches};

pub use arguments::PathKind;

/// All commands with their arguments, as the program knows them.
#[must_use]
pub fn command() -> clap::Command {
    arguments::Arguments::command()
}

/// Does what the arguments of this process ask for.
#[must_use]
pub fn run() -> ExitCode {
    let command = command();
    let matches = command.clone().get_matches();
    let arguments = arguments::Arguments::from_arg_matches(&matches).unwrap_or_else(|e| e.exit());
    let files = arguments::file_use(&command, &matches);
    let done = files
        .check()
        .map_err(failure::Failure::from)
        .and_then(|()| interruption::listen())
        .and_then(|()| commands::dispatch(arguments.command, files));
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}
