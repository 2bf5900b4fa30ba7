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
    assembly.check_recording().map_err(failed)?;
    let started = Instant::now();
    let (outcome, isolated, recorder) = integrate_both(&assembly).map_err(failed)?;
    let wall_time = started.elapsed().as_secs_f64();
    let record = RunRecord {
        title: &case.title,
        case: &case.source,
        version: env!("CARGO_PKG_VERSION"),
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
            &record.warnings(),
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
    // Read once: a pipe has nothing to give a second time.
    let source = pounding_case::read_text(path, "case").map_err(|e| Failure::case(e, ""))?;
    Case::parse(&source, path).map_err(|e| Failure::case(e, &source))
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
