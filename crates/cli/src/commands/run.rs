//! `pounding run`: the main job.

use std::path::{Path, PathBuf};
use std::time::Instant;

use pounding_files::FileUse;
use pounding_time_history::{
    Assembly, GridRecorder, Outcome, Recorder, RunRecord, TimeHistoryError, run as integrate,
    write_result,
};

use super::progress::{Progress, Unit};
use super::{have_a_place, name_left_over, pretty, print, reads_too};
use crate::arguments::RunArguments;
use crate::failure::Failure;
use crate::faults::{assembled, read_case};
use crate::{json, plot, tables};

/// Runs a case with and without its gaps, writes the result, prints the answer.
pub fn run(arguments: &RunArguments, mut files: FileUse) -> Result<(), Failure> {
    let case = read_case(&arguments.case, true)?;
    let failed = |e| Failure::of_case(e, &case);
    let output = (!arguments.no_output).then(|| output_path(arguments));
    if let (Some(path), None) = (&output, &arguments.output) {
        files.writes("result", path);
        name_left_over(path);
    }
    reads_too(&mut files, case.files())?;
    let assembly = assembled(&case)?;
    have_a_place([output.as_deref(), arguments.plot.as_deref()])?;
    assembly.check_recording().map_err(failed)?;
    let started = Instant::now();
    let progress = Progress::begin(Unit::Part)?;
    let (outcome, isolated, recorder) = integrate_both(&assembly, &progress).map_err(failed)?;
    drop(progress);
    let wall_time = started.elapsed().as_secs_f64();
    let record = RunRecord {
        title: &case.title,
        case: &case.source,
        version: env!("CARGO_PKG_VERSION"),
        build: pounding_study::BUILD,
        assembly: &assembly,
        outcome: &outcome,
        isolated: &isolated,
        history: &recorder.history,
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

fn output_path(arguments: &RunArguments) -> PathBuf {
    let given = arguments.output.as_deref().map(Path::to_owned);
    given.unwrap_or_else(|| {
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

/// The run, and the same buildings without gaps.
fn integrate_both(
    assembly: &Assembly,
    progress: &Progress,
) -> Result<(Outcome, Outcome, GridRecorder), TimeHistoryError> {
    let mut recorder = GridRecorder::new(assembly.output_step)?;
    let mut recorders: [&mut dyn Recorder; 1] = [&mut recorder];
    let outcome = integrate(
        &assembly.system,
        &assembly.options,
        &mut recorders,
        &mut |done| {
            progress.show((done * 900.0) as usize, 1000, "");
        },
    )?;
    let isolated = integrate(
        &assembly.system.isolated(),
        &assembly.options,
        &mut [],
        &mut |done| {
            progress.show(900 + (done * 100.0) as usize, 1000, "");
        },
    )?;
    Ok((outcome, isolated, recorder))
}
