//! How far a run is, and whether it goes on.

use std::cell::Cell;
use std::ops::ControlFlow;

use pounding_time_history::{History, Recorder, StepView, System, TimeHistoryError};

/// Parts of the duration after each of which it is asked.
const PARTS: f64 = 250.0;
/// Steps after which it is asked before a part is done: those of a contact may be short.
const STEPS: u32 = 10_000;

/// Asks from time to time whether a run goes on, and ends it where it shall not.
pub(crate) struct Progress<'p> {
    ask: &'p mut dyn FnMut(f64) -> ControlFlow<()>,
    /// Duration of the run (s).
    duration: f64,
    /// Parts of it that are done.
    parts: f64,
    /// Steps since it was asked last.
    steps: Cell<u32>,
    /// Part of the duration (-) with which the run was ended.
    stopped: Option<f64>,
}

impl<'p> Progress<'p> {
    pub(crate) fn new(duration: f64, ask: &'p mut dyn FnMut(f64) -> ControlFlow<()>) -> Self {
        Self {
            ask,
            duration,
            parts: 0.0,
            steps: Cell::new(0),
            stopped: None,
        }
    }

    pub(crate) fn stopped(&self) -> Option<f64> {
        self.stopped
    }
}

impl Recorder for Progress<'_> {
    fn begin(&mut self, _system: &System, _start: &History) -> Result<(), TimeHistoryError> {
        Ok(())
    }

    fn next_time(&self) -> f64 {
        // Asked of every step.
        let steps = self.steps.get() + 1;
        self.steps.set(steps);
        match steps < STEPS {
            true => self.duration * (self.parts + 1.0) / PARTS,
            false => f64::NEG_INFINITY,
        }
    }

    fn step(&mut self, step: &mut StepView<'_, '_, '_>) -> Result<(), TimeHistoryError> {
        self.steps.set(0);
        let done = step.end() / self.duration;
        self.parts = (done * PARTS).floor();
        if step.is_last() || done >= 1.0 || (self.ask)(done).is_continue() {
            return Ok(());
        }
        self.stopped = Some(done);
        Err(TimeHistoryError::Recorder("stopped".to_owned()))
    }
}
