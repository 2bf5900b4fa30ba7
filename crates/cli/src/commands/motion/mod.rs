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
mod spectrum_places;
mod spectrum_tables;
mod synth;
mod words;
mod writing;

use std::path::PathBuf;

use pounding_files::FileUse;

use crate::arguments::{InputPath, MotionCommand, ReadArguments};
use crate::failure::Failure;
use crate::files::{metadata_beside, reads_too};

/// Carries a command on motions out.
pub fn motion(command: &MotionCommand, mut files: FileUse) -> Result<(), Failure> {
    reads_too(&mut files, metadata(command))?;
    match command {
        MotionCommand::Info(arguments) => info::info(arguments),
        MotionCommand::Spectrum(arguments) => spectrum::spectrum(arguments),
        MotionCommand::Convert(arguments) => convert::convert(arguments),
        MotionCommand::Process(arguments) => process::process(arguments, files),
        MotionCommand::Synth(arguments) => synth::synth(arguments),
        MotionCommand::Match(arguments) => matching::matching(arguments),
    }
}

/// The metadata of stations that lie beside the records, which are read where none is named.
fn metadata(command: &MotionCommand) -> Vec<(&'static str, PathBuf)> {
    let (read, records): (&ReadArguments, Vec<&InputPath>) = match command {
        MotionCommand::Info(a) => (&a.read, a.files.iter().collect()),
        MotionCommand::Spectrum(a) => (&a.read, a.file.iter().chain(&a.second_file).collect()),
        MotionCommand::Convert(a) => (&a.read, vec![&a.file]),
        MotionCommand::Process(a) => (&a.read, vec![&a.file]),
        MotionCommand::Match(a) => (&a.read, vec![&a.file]),
        MotionCommand::Synth(_) => return Vec::new(),
    };
    if read.response.is_some() {
        return Vec::new();
    }
    metadata_beside(records.into_iter().map(|record| &**record))
}
