//! What recording all responses costs beside the run alone.

use std::fmt::Write as _;
use std::process::Command;

use pounding_time_history::{
    GridRecorder, GroundAcceleration, History, HistorySink, MethodChoice, RunOptions, System,
    TimeHistoryError, run,
};
use verification::{Failure, REFERENCE_MODELS, ReferenceCases, reference_system};

use crate::cases::uniform_row;
use crate::clock::{median, thread_seconds};
use crate::scaling::{MODEL, WIDE};

/// Interleaved runs of each kind.
const RUNS: usize = 15;
/// Step of the output grid (s): that of the examples.
const GRID: f64 = 0.01;

/// Relative tolerance where none is named.
const TOLERANCE: &str = "1e-10";

/// Name of two towers that never touch, before the number of their storeys; and what tells apart a
/// run on buildings on which others were before.
const TOWERS: &str = "towers-";
const AGAIN: &str = "again";

/// Takes blocks of responses where a file would be written.
struct Nowhere;

impl HistorySink for Nowhere {
    fn take(&mut self, _rows: &mut History) -> Result<(), TimeHistoryError> {
        Ok(())
    }
}

/// A case of the reference, and which of them are wanted.
struct Runs<'a> {
    reference: &'a ReferenceCases,
    ground: &'a GroundAcceleration,
    only: &'a [&'a str],
}

impl Runs<'_> {
    /// A line for every case and model that is wanted: what a run costs alone and with all
    /// histories.
    fn table(
        &self,
        unit: &str,
        mut costs: impl FnMut(&str, &str, &System) -> Result<(f64, f64), Failure>,
    ) -> Result<String, Failure> {
        let wanted = |place: usize, name: &str| self.only.get(place).is_none_or(|o| *o == name);
        let mut text = format!(
            "| case | model | run ({unit}) | with histories ({unit}) | ratio |\n|---|---|---|---|---|\n"
        );
        for (name, case) in self.reference.cases.iter().filter(|c| wanted(0, c.0)) {
            for model in REFERENCE_MODELS.into_iter().filter(|m| wanted(1, m)) {
                let system = reference_system(case, model, self.ground.clone(), 1.0)?;
                let (alone, recorded) = costs(name, model, &system)?;
                let ratio = recorded / alone;
                writeln!(
                    text,
                    "| {name} | {model} | {alone:.3} | {recorded:.3} | {ratio:.2} |"
                )?;
            }
        }
        Ok(text)
    }
}

/// What a run with all histories, but without their writing, costs beside the run alone, for every
/// case and model or for those that are named, to a tolerance that may be named after them: time, or
/// with `instructions` before them the instructions that callgrind counts.
pub(crate) fn ratios(
    reference: &ReferenceCases,
    ground: &GroundAcceleration,
    only: &[&str],
) -> Result<String, Failure> {
    let runs = |only| Runs {
        reference,
        ground,
        only,
    };
    match only {
        ["instructions", only @ ..] => {
            let tolerance = only.get(2).unwrap_or(&TOLERANCE);
            runs(only).table("million instructions", |case, model, _| {
                let of = |kind: &str| instructions([case, model, kind, tolerance]);
                Ok((of("alone")?, of("recorded")?))
            })
        }
        _ => {
            let options = options(only.get(2).unwrap_or(&TOLERANCE))?;
            runs(only).table("ms", |_, _, system| times(system, &options))
        }
    }
}

fn times(system: &System, options: &RunOptions) -> Result<(f64, f64), Failure> {
    let (mut alone, mut recorded) = (Vec::new(), Vec::new());
    for _ in 0..RUNS {
        let start = thread_seconds();
        once(system, "alone", options)?;
        alone.push(1e3 * (thread_seconds() - start));
        let start = thread_seconds();
        once(system, "recorded", options)?;
        recorded.push(1e3 * (thread_seconds() - start));
    }
    Ok((median(&alone), median(&recorded)))
}

/// Instructions (millions) of one run in a process of its own.
fn instructions(words: [&str; 4]) -> Result<f64, Failure> {
    let mut command = Command::new("valgrind");
    command.args(["--tool=callgrind", "--callgrind-out-file=/dev/null"]);
    command.arg("--toggle-collect=*recording*once*");
    command
        .arg(std::env::current_exe()?)
        .arg("recorded")
        .args(words);
    let output = command.output().map_err(|e| format!("valgrind: {e}"))?;
    let said = String::from_utf8_lossy(&output.stderr);
    let counted = said.lines().find_map(|line| line.split_once("Collected :"));
    let (_, count) = counted.ok_or_else(|| format!("callgrind counts nothing: {said}"))?;
    Ok(1e-6 * count.trim().parse::<f64>()?)
}

/// One run of a case and a model, `alone` or with all histories, to a tolerance: what callgrind
/// looks at.
pub(crate) fn child(
    reference: &ReferenceCases,
    ground: &GroundAcceleration,
    [case, model, kind, tolerance]: [&str; 4],
) -> Result<String, Failure> {
    let case = match case.strip_prefix(TOWERS) {
        Some(storeys) => &uniform_row(2, storeys.parse()?, WIDE),
        None => reference.cases.get(case).ok_or("no such case")?,
    };
    let system = reference_system(case, model, ground.clone(), 1.0)?;
    let options = options(tolerance)?;
    if kind == AGAIN {
        // What runs on the same buildings share is made by the second one.
        one_run(&system, &options)?;
        one_run(&system, &options)?;
    }
    once(&system, kind, &options)?;
    Ok(String::new())
}

/// One more run of two towers that never touch, of each of these numbers of storeys: instructions
/// and least processor time (ns) a floor and sample.
pub(crate) fn towers(ground: &GroundAcceleration, storeys: &[&str]) -> Result<String, Failure> {
    let mut text = "| storeys of each | instructions | ns |\n|---|---|---|\n".to_owned();
    for storeys in storeys {
        let case = format!("{TOWERS}{storeys}");
        let count: usize = storeys.parse()?;
        let floor_samples = (2 * count * (ground.samples.len() - 1)) as f64;
        let counted = 1e6 * instructions([&case, MODEL, AGAIN, TOLERANCE])?;
        let system = reference_system(&uniform_row(2, count, WIDE), MODEL, ground.clone(), 1.0)?;
        let mut least = f64::INFINITY;
        let options = options(TOLERANCE)?;
        for _ in 0..RUNS {
            let start = thread_seconds();
            one_run(&system, &options)?;
            least = least.min(1e9 * (thread_seconds() - start));
        }
        let (counted, least) = (counted / floor_samples, least / floor_samples);
        writeln!(text, "| {count} | {counted:.0} | {least:.2} |")?;
    }
    Ok(text)
}

fn one_run(system: &System, options: &RunOptions) -> Result<(), Failure> {
    run(system, options, &mut [], &mut |_| {})?;
    Ok(())
}

/// A function of its own, by whose name callgrind counts.
#[inline(never)]
fn once(system: &System, kind: &str, options: &RunOptions) -> Result<(), Failure> {
    if kind == "recorded" {
        let mut recorder = GridRecorder::into_sink(GRID, Nowhere)?;
        run(system, options, &mut [&mut recorder], &mut |_| {})?;
        return Ok(());
    }
    one_run(system, options)
}

/// To this relative tolerance, whatever it makes of the balance of energy.
fn options(tolerance: &str) -> Result<RunOptions, Failure> {
    Ok(RunOptions {
        method: MethodChoice::EventDriven {
            relative_tolerance: tolerance.parse()?,
        },
        energy_tolerance: Some(1.0),
        ..RunOptions::default()
    })
}
