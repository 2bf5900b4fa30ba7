//! `pounding motion process`: steps in the order of the command line.

use std::path::{Path, PathBuf};

use pounding_assembly::read_target;
use pounding_case::{BandSource, SpectrumSource};
use pounding_files::FileUse;
use pounding_ground_motion::processing::{ProcessingStep, distinct, process as carry_out, rotate};

use super::code::warn_of_parameters;
use super::words::Words;
use super::{reading, writing};
use crate::arguments::ProcessArguments;
use crate::failure::Failure;
use crate::files::reads_too;
use crate::output::warn;

/// Does the steps and writes the motion with their numbers in its header.
pub fn process(arguments: &ProcessArguments, mut files: FileUse) -> Result<(), Failure> {
    if arguments.steps.0.is_empty() && arguments.rotate.is_none() {
        return Err(Failure::input(
            "no step is asked for",
            Some(
                "see `pounding motion process --help`; `motion convert` changes the format alone"
                    .into(),
            ),
        ));
    }
    let (mut steps, mut targets) = (Vec::new(), Vec::new());
    for (key, text) in &arguments.steps.0 {
        let (step, target) = step(key, text)?;
        steps.push((option(key), step));
        targets.extend(target.map(|path| ("target spectrum", path)));
    }
    reads_too(&mut files, targets)?;
    let mut record = reading::acceleration(&arguments.file, &arguments.read)?;
    if let (Some(angle), Some(second)) = (arguments.rotate, &arguments.second_component) {
        let mut read = arguments.read.clone();
        read.component = Some(second.clone());
        let other = reading::acceleration(&arguments.file, &read)?;
        distinct(&record, &other)?;
        record = rotate(&record, &other, angle)?.first;
    }
    for (option, step) in steps {
        record = carry_out(&record, &[step])
            .map_err(|e| Failure::input(format!("--{option}: {e}"), e.help()))?
            .accelerogram;
    }
    let title = format!("{}, processed", arguments.file.display());
    writing::finish(&arguments.output, &record, &title, None)
}

/// The name of a step's option.
fn option(key: &str) -> String {
    key.replace('_', "-")
}

/// A step from its words, those of the case file's `process` list; and the file of a
/// spectrum that it names.
fn step(key: &str, text: &str) -> Result<(ProcessingStep, Option<PathBuf>), Failure> {
    let option = option(key);
    let words = Words::of(&option, text)?;
    let line = format!("process = [{{ {} }}]", words.as_toml(key)?);
    let (read, asked) = pounding_case::process_steps(&line, "process")
        .map_err(|e| Failure::input(format!("--{option}: {}", e.message), e.help))?;
    for question in asked {
        warn(&question);
    }
    let [step] = read.as_slice() else {
        return Err(Failure::input(
            format!("--{option}: \"{text}\" is no step"),
            None,
        ));
    };
    let target = |band: &BandSource| read_target(band, Path::to_owned);
    let made = step
        .value
        .with_target(target)
        .map_err(|e| Failure::input(format!("--{option}: {e}"), e.help()))?;
    if let Some(SpectrumSource::Code(code)) = step.value.target().map(|band| &band.spectrum) {
        warn_of_parameters(&code.value);
    }
    let file = step
        .value
        .target()
        .and_then(|band| band.spectrum.file())
        .map(|spectrum| spectrum.file.value.clone());
    Ok((made, file))
}
