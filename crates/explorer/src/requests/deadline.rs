//! Ends runs that take too long.

use std::cell::Cell;

use pounding_time_history::{History, Impact, Recorder, StepView, System, TimeHistoryError};
use web_time::Instant;

use crate::limits::LONGEST_RUN;

/// Steps between two looks at the clock.
const STEPS: u32 = 32;

/// A recorder that ends the run when its time is up. It is asked before every step, and shown
/// none until then.
#[derive(Debug)]
pub(super) struct Deadline {
    until: Instant,
    steps: Cell<u32>,
    is_over: Cell<bool>,
}

impl Deadline {
    /// For runs that begin now.
    pub(super) fn from_now() -> Self {
        Self {
            until: Instant::now() + LONGEST_RUN,
            steps: Cell::new(0),
            is_over: Cell::new(false),
        }
    }

    /// Whether there is no time left.
    pub(super) fn is_over(&self) -> bool {
        self.is_over
            .set(self.is_over.get() || Instant::now() > self.until);
        self.is_over.get()
    }

    fn checked(&self) -> Result<(), TimeHistoryError> {
        match self.is_over.get() {
            false => Ok(()),
            true => Err(TimeHistoryError::Recorder(format!(
                "the run takes more than {} s; run the case with `pounding run`",
                LONGEST_RUN.as_secs()
            ))),
        }
    }
}

impl Recorder for Deadline {
    fn begin(&mut self, _system: &System, _start: &History) -> Result<(), TimeHistoryError> {
        self.is_over();
        self.checked()
    }

    fn next_time(&self) -> f64 {
        let steps = self.steps.get().wrapping_add(1);
        self.steps.set(steps);
        if steps.is_multiple_of(STEPS) && self.is_over() {
            return f64::NEG_INFINITY;
        }
        f64::INFINITY
    }

    fn step(&mut self, _step: &mut StepView<'_, '_, '_>) -> Result<(), TimeHistoryError> {
        self.checked()
    }

    fn impact(&mut self, _impact: &Impact) -> Result<(), TimeHistoryError> {
        // Impacts can follow one another without a step.
        self.next_time();
        self.checked()
    }
}
