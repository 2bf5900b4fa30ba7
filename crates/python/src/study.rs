//! Studies of many runs: sweeps, incremental dynamic analysis, gap checks, comparisons.

use std::ffi::OsString;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::time::Duration;

use pounding_case::{Dimension, Separation};
use pounding_catalogue::numbers::{rounded_up_beside, six_digits};
use pounding_cli::Failure;
use pounding_cli::answers::{
    Analysis, AskedOfGaps, Check, Compared, Finished, Replaced, answered_by_child,
    inputs_stay_meanwhile, of_check, overridden, text_sha256,
};
use pounding_files::FileUse;
use pounding_files::checksum::WithoutChecksum;
use pounding_report::page::SweepAnswer;
use pounding_results::Kind;
use pounding_study::comparison::{ComparisonOptions, RestitutionRule, StiffnessRule, compare};
use pounding_study::gap_check::{GapCheckOptions, SweepOptions as WidthOptions, gap_check};
use pounding_study::{
    ResultReader, Shard, Study, StudyError, SweepOptions, evaluate, parts_folder, sweep, writable,
};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::case::PyCase;
use crate::errors::{Problem, warn};
use crate::suite::Suite;
use crate::values::{json, optional, quantity, text_of};
use crate::watch::{Watch, watched};

/// How long a finished run waits at most until it is stored.
const STORE_EVERY: Duration = Duration::from_secs(10);

fn failed(error: StudyError) -> Problem {
    Failure::from(error).into()
}

/// Runs a study, or a shard of it, into its result file. Returns what `pounding sweep --json`
/// prints; with `evaluated` what the incremental dynamic analysis says of it as well.
#[pyfunction]
#[pyo3(signature = (study, output, threads, named=true, shard=None, resume=false, keep_going=false, evaluated=false, progress=None))]
#[expect(clippy::too_many_arguments, reason = "keywords of Python")]
fn run_study(
    py: Python<'_>,
    study: PathBuf,
    output: PathBuf,
    threads: usize,
    named: bool,
    shard: Option<&str>,
    resume: bool,
    keep_going: bool,
    evaluated: bool,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<(String, Option<String>)> {
    let interpreter: PathBuf = py.import("sys")?.getattr("executable")?.extract()?;
    let part = shard;
    let shard = shard.map_or(Ok(Shard::WHOLE), str::parse).map_err(failed)?;
    let begun = watched(py, None, |_| {
        let read = Study::read(&study).map_err(failed)?;
        let mut files = FileUse::new();
        files.reads("study", study.clone());
        for (role, path) in read.files() {
            files.reads(role, path);
        }
        files.writes("result", &output);
        files.fills("the folder of its finished runs", parts_folder(&output));
        let inputs_stay = inputs_stay_meanwhile(&files)?;
        writable(&output).map_err(failed)?;
        let replaced = Replaced {
            output: &output,
            kind: Kind::Study,
            file: Some(&read.file),
            text_sha256: Some(text_sha256(&read)),
            named,
        };
        let going = replaced.judged(resume)?;
        let asked = (inputs_stay, replaced.judged_again());
        Ok::<_, Problem>((read, files, going, asked))
    })?;
    let (read, files, going, _asked) = begun?;
    // Above this are `_run_study` and `sweep` or `ida`.
    going.map_or(Ok(()), |going| warn(py, &going.ahead(), 3))?;
    let made = watched(py, progress, |watch| {
        if resume && output.is_file() {
            let mut arguments = call(&study, &output, evaluated && read.ida.is_some());
            arguments.push(format!("--threads={}", threads.max(1)).into());
            arguments.extend(part.map(|part| format!("--shard={part}").into()));
            arguments.extend(keep_going.then(|| "--keep-going".into()));
            if let Some((finished, analysis)) = stands(&interpreter, &arguments, &output, &files)? {
                return Ok((finished, analysis));
            }
        }
        let options = SweepOptions {
            output,
            csv: None,
            threads: threads.max(1),
            shard,
            resume,
            store_every: STORE_EVERY,
            keep_going,
            shared: None,
        };
        let report = sweep(&read, &options, &mut |now| {
            watch.tell(now.made + now.stored_before, now.total);
            match watch.stopped() {
                true => ControlFlow::Break(()),
                false => ControlFlow::Continue(()),
            }
        });
        let report = report.map_err(failed)?;
        let answer = match (evaluated && read.ida.is_some(), part) {
            (false, None) => {
                let result = ResultReader::open(&options.output, WithoutChecksum::Refuse);
                let result = result.map_err(|e| failed(e.into()))?;
                Some(SweepAnswer::of(&result).map_err(|e| failed(e.into()))?)
            }
            _ => None,
        };
        let finished = json(&Finished::of(&report, &options).with_answer(answer))?;
        let settings = read.ida.as_ref().filter(|_| evaluated);
        let analysis = settings.map(|settings| {
            let result = ResultReader::open(&options.output, WithoutChecksum::Refuse);
            let result = result.map_err(|e| failed(e.into()))?;
            let tell: &dyn Fn(usize, usize) = &|_, _| ();
            let report = evaluate(&read, &result, (options.threads, tell)).map_err(failed)?;
            json(&Analysis::of(&report, settings))
        });
        Ok::<_, Problem>((finished, analysis.transpose()?))
    })?;
    Ok(made?)
}

/// How the command line is asked to go on with a study.
fn call(study: &Path, output: &Path, evaluated: bool) -> Vec<OsString> {
    let command = match evaluated {
        true => "ida",
        false => "sweep",
    };
    // A name that begins with a dash is no option.
    let study = std::path::absolute(study).unwrap_or_else(|_| study.to_owned());
    let mut arguments: Vec<OsString> = ["-m", "pounding", command].map(Into::into).into();
    arguments.extend([study.into(), "--output".into(), output.into()]);
    arguments.extend(["--resume", "--json"].map(OsString::from));
    arguments
}

/// What another process answers of a result that stands, which may be no result at all whatever
/// its checksum says: the runs and what was evaluated of them; `None` where runs are left to be
/// made.
fn stands(
    interpreter: &Path,
    arguments: &[OsString],
    output: &Path,
    files: &FileUse,
) -> Result<Option<(String, Option<String>)>, Problem> {
    let answer = answered_by_child(interpreter, arguments, &[output.to_owned()], files)?;
    if answer.leaves_runs() {
        return Ok(None);
    }
    let printed = serde_json::from_slice::<serde_json::Value>(&answer.printed);
    let Ok(serde_json::Value::Object(mut printed)) = printed else {
        return Err(answer.failure().into());
    };
    Ok(Some(match printed.remove("sweep") {
        Some(finished) => (json(&finished)?, Some(json(&printed)?)),
        None => (json(&printed)?, None),
    }))
}

/// Whether a study has a part `ida`.
#[pyfunction]
fn has_ida(study: PathBuf) -> Result<bool, Problem> {
    Ok(Study::read(&study).map_err(failed)?.ida.is_some())
}

/// Entries of the table `separation` of a case.
fn entries_of(case: &PyCase, entries: &Bound<'_, PyDict>) -> PyResult<Separation> {
    let text = text_of(entries)?;
    let read = Separation::parse(&text, case.case.buildings.len());
    let named = Some("--set".to_owned());
    read.map_err(|e| Problem::from(Failure::case(e, &text)).by_keys(named).into())
}

/// Checks the gaps of a case: what `pounding gap --json` prints.
#[pyfunction]
#[pyo3(signature = (case, motions, code, country, date, rules, provisions, entries, probability, confidence, points, widths, gap, threads, progress=None))]
#[expect(clippy::too_many_arguments, reason = "keywords of Python")]
fn gap_check_json(
    py: Python<'_>,
    case: &Bound<'_, PyCase>,
    motions: Vec<(String, Bound<'_, PyAny>)>,
    code: Option<&str>,
    country: Option<&str>,
    date: Option<&str>,
    rules: Option<PathBuf>,
    provisions: Vec<String>,
    entries: Option<&Bound<'_, PyDict>>,
    probability: &Bound<'_, PyAny>,
    confidence: &Bound<'_, PyAny>,
    points: usize,
    widths: [Option<Bound<'_, PyAny>>; 2],
    gap: Option<String>,
    threads: usize,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<String> {
    let case = case.get();
    let suite = Suite::of(py, case, motions)?;
    let asked = AskedOfGaps {
        code,
        country,
        date,
        provisions: &provisions,
        rules: rules.as_deref(),
    };
    let mut separation = case.case.separation.clone();
    if let Some(entries) = entries {
        separation = separation.overridden_by(entries_of(case, entries)?);
    }
    let separation = overridden(separation, &asked).map_err(Problem::from)?;
    let [from, to] = &widths;
    let (from, to) = (
        optional(from.as_ref(), "from_", Dimension::LENGTH)?,
        optional(to.as_ref(), "to", Dimension::LENGTH)?,
    );
    let sweep = WidthOptions {
        gap,
        from,
        to,
        points,
    };
    let of_sweep = sweep.gap.is_some() || from.is_some() || to.is_some();
    if of_sweep && points == 0 {
        let message = "without a sweep there is nothing that `from_`, `to` and `gap` could say";
        let help = "give `points`, how many widths it has".to_owned();
        return Err(Problem::from(Failure::input(message, Some(help))).into());
    }
    let options = GapCheckOptions {
        target_probability: quantity(probability, "probability", Dimension::NUMBER)?,
        confidence: quantity(confidence, "confidence", Dimension::NUMBER)?,
        sweep: (points > 0).then_some(sweep),
        threads: threads.max(1),
    };
    let made = watched(py, progress, |watch| {
        let records = suite.under(case)?;
        let ask = |done, total| watch.ask(done, total);
        let check = gap_check(&case.case, &separation, &records, &options, &ask);
        let check = check.map_err(|e| case.problem(of_check(e, &case.case)))?;
        json(&Check::of(&check))
    })?;
    Ok(made?)
}

/// A width of a gap (m) in mm: one that is provided, or, beside that, one that is required, so that it suffices as
/// it is shown.
#[pyfunction]
#[pyo3(signature = (width, provided=None))]
fn shown_width(width: f64, provided: Option<f64>) -> String {
    match provided {
        None => six_digits(1e3 * width),
        Some(provided) => rounded_up_beside(1e3 * width, 1e3 * provided, 2),
    }
}

/// Compares impact models: what `pounding compare --json` prints.
#[pyfunction]
#[pyo3(signature = (case, models, motions, restitution, approach_velocity, same_duration, exact, threads, progress=None))]
#[expect(clippy::too_many_arguments, reason = "keywords of Python")]
fn compare_json(
    py: Python<'_>,
    case: &Bound<'_, PyCase>,
    models: Vec<String>,
    motions: Vec<(String, Bound<'_, PyAny>)>,
    restitution: Option<&Bound<'_, PyAny>>,
    approach_velocity: Option<&Bound<'_, PyAny>>,
    same_duration: bool,
    exact: bool,
    threads: usize,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<String> {
    let case = case.get();
    let suite = Suite::of(py, case, motions)?;
    let velocity = optional(approach_velocity, "approach_velocity", Dimension::VELOCITY)?;
    if velocity.is_some_and(|velocity| velocity.is_nan() || velocity <= 0.0) {
        let help = "bodies that do not approach each other do not touch".to_owned();
        let message = "approach_velocity must be greater than zero";
        return Err(Problem::from(Failure::input(message, Some(help))).into());
    }
    let options = ComparisonOptions {
        models,
        stiffness_rule: match same_duration {
            true => StiffnessRule::Duration,
            false => StiffnessRule::Penetration,
        },
        restitution_rule: match exact {
            true => RestitutionRule::Exact,
            false => RestitutionRule::AsPublished,
        },
        restitution: optional(restitution, "restitution", Dimension::NUMBER)?,
        approach_velocity: velocity,
        threads: threads.max(1),
    };
    let made = watched(py, progress, |watch: &Watch| {
        let records = suite.under(case)?;
        let ask = |done, total| watch.ask(done, total);
        let comparison = compare(&case.case, &records, &options, &ask);
        let comparison = comparison.map_err(|e| case.problem(of_check(e, &case.case)))?;
        json(&Compared::of(&comparison))
    })?;
    Ok(made?)
}

/// Adds the functions of this file.
pub fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(run_study, module)?)?;
    module.add_function(wrap_pyfunction!(has_ida, module)?)?;
    module.add_function(wrap_pyfunction!(gap_check_json, module)?)?;
    module.add_function(wrap_pyfunction!(shown_width, module)?)?;
    module.add_function(wrap_pyfunction!(compare_json, module)?)
}
