//! `pounding run`: the main job.

use std::io::IsTerminal;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};
use pounding_case::Case;
use pounding_time_history::{
    Assembly, GridRecorder, Outcome, Recorder, RunRecord, TimeHistoryError, assemble,
    run as integrate, write_result,
};

use super::{pretty, print};
use crate::arguments::RunArguments;
use crate::failure::Failure;
use crate::{json, plot, tables};

/// Runs a case with and without its gaps, writes the result, prints the answer.
pub fn run(arguments: &RunArguments) -> Result<(), Failure> {
    let case = read_case(&arguments.case)?;
    let failed = |e| Failure::time_history(e, &case.source);
    let assembly = assemble(&case).map_err(failed)?;
    let output = (!arguments.no_output).then(|| output_path(arguments));
    if let Some(path) = &output {
        writable(path)?;
    }
    fits_into_memory(&assembly)?;
    let started = Instant::now();
    let (outcome, isolated, recorder) = integrate_both(&assembly).map_err(failed)?;
    let wall_time = started.elapsed().as_secs_f64();
    let record = RunRecord {
        title: &case.title,
        case: &case.source,
        version: env!("CARGO_PKG_VERSION"),
        build: pounding_study::BUILD,
        assembly: &assembly,
        outcome: &outcome,
        isolated: &isolated,
        samples: &recorder.samples,
        wall_time,
    };
    if let Some(path) = &output {
        write_result(path, &record).map_err(failed)?;
    }
    if let Some(path) = &arguments.plot {
        plot::responses(path, &record)?;
    }
    if arguments.json {
        return print(&pretty(&json::outcome(
            &assembly.system,
            &outcome,
            &isolated,
        )));
    }
    let mut text = tables::report(&record);
    if let Some(path) = &output {
        text.push_str(&format!(
            "\nStorey responses written to {}\n",
            path.display()
        ));
    }
    print(&text)
}

/// Reads and validates a case file.
pub fn read_case(path: &Path) -> Result<Case, Failure> {
    Case::read(path).map_err(|e| {
        let source = pounding_case::read_text(path).unwrap_or_default();
        Failure::case(e, &source)
    })
}

fn output_path(arguments: &RunArguments) -> PathBuf {
    arguments.output.clone().unwrap_or_else(|| {
        // Examples are all called case.toml: their folder names them better.
        let stem = arguments.case.file_stem().unwrap_or_default();
        let folder = arguments
            .case
            .canonicalize()
            .ok()
            .and_then(|p| Some(p.parent()?.file_name()?.to_owned()));
        let name = match folder {
            Some(folder) if stem == "case" => folder,
            _ => stem.to_owned(),
        };
        PathBuf::from(name).with_extension("h5")
    })
}

/// Recorded responses that a run may hold (bytes): far more than any record needs, and
/// less than most machines have.
const LARGEST_RECORDING: f64 = 2.0e9;

/// Refuses a run whose recorded responses would not fit, before it begins.
fn fits_into_memory(assembly: &Assembly) -> Result<(), Failure> {
    let system = &assembly.system;
    let duration = assembly.options.duration;
    let duration = duration.unwrap_or_else(|| system.record_duration());
    let samples = duration / assembly.output_step;
    let numbers =
        4 * system.degrees_of_freedom() + 2 * system.levels().len() + 3 * system.elements().len();
    // A sample has nine lists, each with a header of three words, and ten numbers.
    let bytes = samples * 8.0 * (numbers + 37) as f64;
    if bytes <= LARGEST_RECORDING {
        return Ok(());
    }
    Err(Failure::input(
        format!(
            "{samples:.0} samples of the responses over {duration} s would take {:.1} GB of memory",
            bytes * 1e-9
        ),
        Some("raise `output_step` in [analysis], or shorten `duration`; peaks and impacts do not depend on `output_step`".to_owned()),
    ))
}

/// Finds out before the run, not after it, that the result has no place.
fn writable(path: &Path) -> Result<(), Failure> {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(".part");
    let part = path.with_file_name(name);
    // A result replaces what has its name: never a folder or a device.
    if path.exists() && !path.is_file() {
        let e = std::io::Error::other("it is not a regular file");
        return Err(Failure::output(&e, &path.display().to_string()));
    }
    std::fs::File::create(&part)
        .and_then(|_| std::fs::remove_file(&part))
        .map_err(|e| Failure::output(&e, &path.display().to_string()))
}

/// The run, and the same buildings without gaps.
fn integrate_both(
    assembly: &Assembly,
) -> Result<(Outcome, Outcome, GridRecorder), TimeHistoryError> {
    let bar = progress_bar();
    let mut recorder = GridRecorder::new(assembly.output_step)?;
    let mut recorders: [&mut dyn Recorder; 1] = [&mut recorder];
    let outcome = integrate(
        &assembly.system,
        &assembly.options,
        &mut recorders,
        &mut |done| {
            bar.set_position((done * 900.0) as u64);
        },
    )?;
    let isolated = integrate(
        &assembly.system.isolated(),
        &assembly.options,
        &mut [],
        &mut |done| {
            bar.set_position(900 + (done * 100.0) as u64);
        },
    )?;
    bar.finish_and_clear();
    Ok((outcome, isolated, recorder))
}

/// A bar on a terminal, nothing elsewhere.
fn progress_bar() -> ProgressBar {
    if !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::new(1000);
    if let Ok(style) =
        ProgressStyle::with_template("{elapsed:>4} {wide_bar} {percent:>3} %  {eta} left")
    {
        bar.set_style(style);
    }
    bar.enable_steady_tick(Duration::from_millis(200));
    bar
}
