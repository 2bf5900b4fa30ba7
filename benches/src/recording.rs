//! What recording all responses costs beside the run alone.

use std::fmt::Write as _;

use pounding_time_history::{
    GridRecorder, GroundAcceleration, History, MethodChoice, Recorder, RunOptions, Sample,
    SampleSink, System, TimeHistoryError, run,
};
use verification::{Failure, REFERENCE_MODELS, ReferenceCases, reference_system};

use crate::clock::{median, thread_seconds};

/// Interleaved runs of each kind.
const RUNS: usize = 15;
/// Step of the output grid (s): that of the examples.
const GRID: f64 = 0.01;

/// Responses in blocks, as what writes them to a file takes them.
#[derive(Default)]
struct Blocks(History);

impl SampleSink for Blocks {
    fn take(&mut self, sample: &Sample) -> Result<(), TimeHistoryError> {
        self.0.push(sample);
        if self.0.len() == 1024 {
            self.0.clear();
        }
        Ok(())
    }
}

/// Time of a run with all histories but their writing over that of the run alone, for every
/// case and model, or for those that are named.
pub(crate) fn ratios(
    reference: &ReferenceCases,
    ground: &GroundAcceleration,
    only: &[&str],
) -> Result<String, Failure> {
    let wanted = |place: usize, name: &str| only.get(place).is_none_or(|o| *o == name);
    let mut text = String::from(
        "| case | model | run (ms) | with histories (ms) | ratio |\n|---|---|---|---|---|\n",
    );
    for (name, case) in reference.cases.iter().filter(|c| wanted(0, c.0)) {
        for model in REFERENCE_MODELS.into_iter().filter(|m| wanted(1, m)) {
            let system = reference_system(case, model, ground.clone(), 1.0)?;
            let (alone, recorded) = times(&system)?;
            writeln!(
                text,
                "| {name} | {model} | {:.3} | {:.3} | {:.2} |",
                1e3 * alone,
                1e3 * recorded,
                recorded / alone
            )?;
        }
    }
    Ok(text)
}

fn times(system: &System) -> Result<(f64, f64), Failure> {
    let options = RunOptions {
        method: MethodChoice::EventDriven {
            relative_tolerance: 1e-10,
        },
        ..RunOptions::default()
    };
    let (mut alone, mut recorded) = (Vec::new(), Vec::new());
    for _ in 0..RUNS {
        let start = thread_seconds();
        run(system, &options, &mut [], &mut |_| {})?;
        alone.push(thread_seconds() - start);
        let start = thread_seconds();
        let mut recorder = GridRecorder::into_sink(GRID, Blocks::default())?;
        let mut recorders: [&mut dyn Recorder; 1] = [&mut recorder];
        run(system, &options, &mut recorders, &mut |_| {})?;
        recorded.push(thread_seconds() - start);
    }
    Ok((median(&alone), median(&recorded)))
}
