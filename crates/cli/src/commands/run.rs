//! `pounding run`: the main job.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use pounding_assembly::Assembly;
use pounding_files::FileUse;
use pounding_report::pictures::run::Responses;
use pounding_results::{Kind, RunEnding, RunHead, RunWriter, WriteError};
use pounding_time_history::{
    GridRecorder, HistorySink, IsolatedRun, Outcome, Recorder, Summary, TimeHistoryError,
    run as integrate, run_isolated,
};

use crate::arguments::RunArguments;
use crate::failure::Failure;
use crate::faults::{assembled, read_case, responses_fit};
use crate::files::{Replaced, has_a_place, have_a_place, name_left_over, reads_too};
use crate::output::{pretty, print};
use crate::progress::{Progress, Unit};
use crate::{page, plot, tables};

/// Runs a case with and without its gaps, writes the result, prints the answer.
pub fn run(arguments: &RunArguments, mut files: FileUse) -> Result<(), Failure> {
    let case = read_case(&arguments.case, true)?;
    let failed = |e: TimeHistoryError| Failure::of_case(e, &case);
    let output = (!arguments.no_output).then(|| output_path(arguments));
    if let (Some(path), None) = (&output, &arguments.output) {
        files.writes("result", path);
        name_left_over(path);
    }
    reads_too(&mut files, case.files())?;
    let assembly = assembled(&case)?;
    have_a_place([arguments.plot.as_deref(), arguments.report.as_deref()])?;
    if let Some(output) = &output {
        has_a_place(output)?;
        let replaced = Replaced {
            output,
            kind: Kind::Run,
            file: Some(&arguments.case),
            text_sha256: None,
            named: arguments.output.is_some(),
        };
        let ahead = replaced.spared(false)?;
        responses_fit(&assembly, &case)?;
        ahead.say();
    }
    let started = Instant::now();
    let progress = Progress::begin(Unit::Part)?;
    let head = RunHead {
        title: &case.title,
        case: &case.source,
        version: env!("CARGO_PKG_VERSION"),
        build: pounding_study::BUILD,
        system: &assembly.system,
        accelerogram: &assembly.accelerogram,
    };
    let writer = output.as_deref().map(|path| {
        let writer = RunWriter::begin(path, &head)?;
        Ok::<_, WriteError>(writer.of_case_file(&arguments.case))
    });
    let mut writer = recorder(&assembly, writer.transpose()?).map_err(failed)?;
    let picture = arguments.plot.as_ref();
    let picture = picture.map(|_| Responses::of(&assembly.system));
    let mut picture = recorder(&assembly, picture).map_err(failed)?;
    let mut recorders: Vec<&mut dyn Recorder> = Vec::new();
    recorders.extend(writer.as_mut().map(|w| w as &mut dyn Recorder));
    recorders.extend(picture.as_mut().map(|p| p as &mut dyn Recorder));
    let span = tracing::info_span!("integrate").entered();
    let outcomes = integrate_both(&assembly, &mut recorders, &progress);
    let (outcome, isolated) = outcomes.map_err(|error| {
        let written = writer.as_ref().and_then(|w| w.responses.failure());
        written.map_or_else(|| failed(error), Failure::from)
    })?;
    drop((progress, span));
    let span = tracing::info_span!("write").entered();
    let wall_time = started.elapsed().as_secs_f64();
    let mut warnings = assembly.with_those_of_the_record(&outcome.warnings);
    let (isolated, told) = IsolatedRun::beside(&outcome, isolated);
    warnings.extend(told);
    if let Some(writer) = writer {
        writer.responses.finish(&RunEnding {
            outcome: &outcome,
            isolated: &isolated,
            warnings: &warnings,
            wall_time,
        })?;
    }
    if let (Some(result), Some(output)) = (&output, &arguments.report) {
        page::of_run(result, output)?;
    }
    if let (Some(path), Some(picture)) = (&arguments.plot, picture) {
        let drawn = picture.responses.picture(&outcome.impacts);
        plot::write_drawn(path, drawn, &arguments.figure)?;
    }
    drop(span);
    if arguments.json {
        let summary = Summary::of(&assembly.system, (&outcome, &isolated), &warnings);
        return print(&pretty(&summary)?);
    }
    let mut text = tables::report(&tables::Run {
        case: &case,
        assembly: &assembly,
        outcome: &outcome,
        isolated: &isolated,
        warnings: &warnings,
        wall_time,
    });
    if let Some(path) = &output {
        text.push_str(&format!(
            "\nStorey responses written to {}\n",
            path.display()
        ));
    }
    print(&text)
}

/// A recorder on the grid of the case for a sink, if there is one.
fn recorder<S: HistorySink>(
    assembly: &Assembly,
    sink: Option<S>,
) -> Result<Option<GridRecorder<S>>, TimeHistoryError> {
    sink.map(|s| GridRecorder::into_sink(assembly.output_step, s))
        .transpose()
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
        // Appended: of a name with a dot, such as gap_0.5, all of it tells the runs apart.
        let mut name = name;
        name.push(".h5");
        PathBuf::from(name)
    })
}

/// The buildings without gaps, or why there is no such run.
type Isolated = Result<IsolatedRun, TimeHistoryError>;

/// The run and, at the same time, the same buildings without gaps. Neither depends on the
/// other, so that threads do not change a bit of either. The second may fail by itself.
fn integrate_both(
    assembly: &Assembly,
    recorders: &mut [&mut dyn Recorder],
    progress: &Progress,
) -> Result<(Outcome, Isolated), TimeHistoryError> {
    let options = &assembly.options;
    // Thousandths: both run at the same time, and the slower one says how long it takes.
    let shares = [AtomicUsize::new(0), AtomicUsize::new(0)];
    let done = |run: usize, part: f64| {
        shares[run].store((part * 1000.0) as usize, Ordering::Relaxed);
        let [with, without] = shares.each_ref().map(|s| s.load(Ordering::Relaxed));
        progress.show(with.min(without), 1000, "");
    };
    let without = || {
        run_isolated(&assembly.system, options, &mut [], &mut |part| {
            done(1, part)
        })
    };
    std::thread::scope(|scope| {
        let thread = std::thread::Builder::new().spawn_scoped(scope, without);
        let outcome = integrate(&assembly.system, options, recorders, &mut |part| {
            done(0, part);
        });
        let isolated = match thread.map(|thread| thread.join()) {
            Ok(Ok(isolated)) => isolated,
            Ok(Err(panic)) => std::panic::resume_unwind(panic),
            // No thread to be had.
            Err(_) => without(),
        };
        Ok((outcome?, isolated))
    })
}
