//! One command a file.

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

use std::io::Write;

use clap::CommandFactory;

use crate::arguments::{Arguments, Command, ImpactCommand};
use crate::failure::Failure;

/// Carries a command out.
pub fn dispatch(command: Command) -> Result<(), Failure> {
    match command {
        Command::Run(arguments) => run::run(&arguments),
        Command::Check { case, json } => check::check(&case, json),
        Command::Models { name, json, pages } => {
            models::models(name.as_deref(), json, pages.as_deref())
        }
        Command::Impact(arguments) => match &arguments.command {
            Some(ImpactCommand::Calibrate(arguments)) => calibrate::calibrate(arguments),
            None => impact::impact(&arguments),
        },
        Command::Gap(arguments) => gap::gap(&arguments),
        Command::Compare(arguments) => compare::run(&arguments),
        Command::Hysteresis(arguments) => hysteresis::hysteresis(&arguments),
        Command::Verify(arguments) => verify::verify(&arguments),
        Command::Stiffness(arguments) => stiffness::stiffness(&arguments),
        Command::Motion(command) => motion::motion(&command),
        Command::Sweep(arguments) => sweep::sweep(&arguments),
        Command::Merge(arguments) => sweep::merge(&arguments),
        Command::Ida(arguments) => ida::ida(&arguments),
        Command::Report {
            result,
            output,
            accept_without_checksum,
        } => report::report(&result, output.as_deref(), accept_without_checksum),
        Command::Schema => print(&pretty(&pounding_case::schema())),
        Command::Completions { shell } => {
            let mut bytes = Vec::new();
            clap_complete::generate(shell, &mut Arguments::command(), "pounding", &mut bytes);
            print(&String::from_utf8_lossy(&bytes))
        }
    }
}

/// Prints to standard output. A reader that closed the pipe has seen enough.
pub fn print(text: &str) -> Result<(), Failure> {
    match writeln!(std::io::stdout().lock(), "{}", text.trim_end()) {
        Err(e) if e.kind() == std::io::ErrorKind::BrokenPipe => Ok(()),
        Err(e) => Err(Failure::output(&e, "to standard output")),
        Ok(()) => Ok(()),
    }
}

/// JSON for machines and people; numbers at full precision.
pub fn pretty(value: &serde_json::Value) -> String {
    format!("{value:#}")
}
