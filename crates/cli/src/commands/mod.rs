//! One command per file.

mod calibrate;
pub mod check;
pub mod compare;
mod explore;
mod floor_spectrum;
pub mod gap;
mod hysteresis;
pub mod ida;
mod impact;
mod man;
mod merge;
pub mod models;
mod motion;
mod report;
mod run;
mod status;
mod stiffness;
mod sweep;
mod verify;

use clap::CommandFactory;
use pounding_files::FileUse;

use crate::arguments::{Arguments, Command, ImpactCommand, SchemaOf};
use crate::command_words::is_child;
use crate::failure::Failure;
use crate::files::name_left_over;
use crate::output::{pretty, print, print_as_it_is};

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
        Command::FloorSpectrum(arguments) => floor_spectrum::floor_spectrum(&arguments, files),
        Command::Compare(arguments) => compare::run(&arguments, files),
        Command::Hysteresis(arguments) => hysteresis::hysteresis(&arguments),
        Command::Verify(arguments) => verify::verify(&arguments, files),
        Command::Stiffness(arguments) => stiffness::stiffness(&arguments),
        Command::Motion(command) => motion::motion(&command, files),
        Command::Sweep(arguments) => sweep::sweep(&arguments, files),
        Command::Merge(arguments) => merge::merge(&arguments, files),
        Command::Status(arguments) => status::status(&arguments),
        Command::Ida(arguments) => ida::ida(&arguments, files),
        Command::Explore(arguments) => explore::explore(&arguments, files),
        Command::Report {
            result,
            output,
            study,
            read_in_this_process,
        } => {
            let asked = report::Asked {
                result: &result,
                output: output.as_deref(),
                study: study.as_deref(),
            };
            report::report(&asked, ida::page_of_result, read_in_this_process, files)
        }
        Command::Schema { file } => print(&pretty(&match file {
            SchemaOf::Case => pounding_assembly::case_schema(),
            SchemaOf::Study => pounding_study::study_schema(),
            SchemaOf::Hazard => pounding_study::hazard_schema(),
        })?),
        Command::Man { pages } => man::man(&pages),
        Command::Completions { shell } => {
            let mut bytes = Vec::new();
            clap_complete::generate(shell, &mut Arguments::command(), "pounding", &mut bytes);
            print_as_it_is(&String::from_utf8_lossy(&bytes))
        }
    }
}
