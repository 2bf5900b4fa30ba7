//! Many runs in one process: gaps times contact stiffnesses.

use std::time::Instant;

use pounding_time_history::{
    GroundAcceleration, MethodChoice, RunOptions, TimeHistoryError, run_many,
};
use verification::{Failure, ReferenceCase};

use crate::cases::vary;
use crate::clock::process_seconds;

/// A grid of gaps and stiffnesses; that of 1,000 runs is the compiled peer's.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Grid {
    gaps: usize,
    stiffnesses: usize,
}

impl Grid {
    /// A grid of about so many runs, in the proportion 40 to 25.
    pub(crate) fn of(runs: usize) -> Self {
        let factor = (runs as f64 / 1000.0).sqrt();
        let part = |n: f64| ((n * factor).round() as usize).max(1);
        Self {
            gaps: part(40.0),
            stiffnesses: part(25.0),
        }
    }

    pub(crate) fn runs(self) -> usize {
        self.gaps * self.stiffnesses
    }

    /// Factors of gap and stiffness of a run: 0.25 to 2.25 and `10^-0.5` to `10^0.5`.
    fn factors(self, run: usize) -> (f64, f64) {
        let (gap, stiffness) = (run / self.stiffnesses, run % self.stiffnesses);
        let last = (self.stiffnesses - 1).max(1) as f64;
        (
            0.25 + 2.0 * gap as f64 / self.gaps as f64,
            10.0_f64.powf(-0.5 + stiffness as f64 / last),
        )
    }
}

/// A sweep that was run.
pub(crate) struct Swept {
    /// Elapsed time (s).
    pub(crate) elapsed: f64,
    /// Processor time of all threads (s).
    pub(crate) processor: f64,
    /// Sum over runs of the largest contact force (N).
    pub(crate) force: f64,
}

/// Runs a sweep on so many threads; the runs share buildings and ground motion.
pub(crate) fn sweep(
    (case, model): (&ReferenceCase, &str),
    ground: &GroundAcceleration,
    method: MethodChoice,
    grid: Grid,
    threads: usize,
) -> Result<Swept, Failure> {
    let base = verification::reference_system(case, model, ground.clone(), 1.0)?;
    let options = RunOptions {
        method,
        duration: None,
        energy_tolerance: Some(1.0e9),
    };
    let (start, processor) = (Instant::now(), process_seconds());
    let forces = run_many(
        grid.runs(),
        threads,
        &options,
        |run| {
            let varied = vary(case, model, &base, grid.factors(run));
            varied.map_err(|e| TimeHistoryError::GapDefinition {
                gap: "sweep".to_owned(),
                reason: e.to_string(),
            })
        },
        |_, outcome| {
            let levels = outcome.map(|o| o.gaps.into_iter().flat_map(|g| g.levels));
            levels.map(|l| l.fold(0.0, |most, l| l.peak_force.value.max(most)))
        },
    );
    let mut force = 0.0;
    for peak in forces {
        force += peak?;
    }
    Ok(Swept {
        elapsed: start.elapsed().as_secs_f64(),
        processor: process_seconds() - processor,
        force,
    })
}
