//! `pounding motion`: recorded and synthetic motions.

mod code;
mod convert;
mod generators;
mod info;
mod info_output;
mod matching;
mod measures;
mod process;
mod reading;
mod spectrum;
mod spectrum_of_code;
mod spectrum_tables;
mod synth;
mod words;
mod writing;

use pounding_files::FileUse;

use crate::arguments::MotionCommand;
use crate::failure::Failure;

/// Carries a command on motions out.
pub fn motion(command: &MotionCommand, files: FileUse) -> Result<(), Failure> {
    match command {
        MotionCommand::Info(arguments) => info::info(arguments),
        MotionCommand::Spectrum(arguments) => spectrum::spectrum(arguments),
        MotionCommand::Convert(arguments) => convert::convert(arguments),
        MotionCommand::Process(arguments) => process::process(arguments, files),
        MotionCommand::Synth(arguments) => synth::synth(arguments),
        MotionCommand::Match(arguments) => matching::matching(arguments),
    }
}
