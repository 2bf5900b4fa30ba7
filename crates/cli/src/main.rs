//! The pounding command line.
//!
//! Exit codes: 0 done, 1 the answer is "no", 2 bad input, 3 the computation
//! failed, 4 output could not be written.

mod arguments;
mod commands;
mod failure;
mod json;
mod plot;
mod tables;

use std::process::ExitCode;

use clap::Parser;

fn main() -> ExitCode {
    let arguments = arguments::Arguments::parse();
    match commands::dispatch(arguments.command) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}
