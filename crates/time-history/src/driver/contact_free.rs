//! Leaving contact-free motion to the exact step of the modes.

use super::contact_episode::Open;
use super::exact_steps::ExactSteps;
use super::parts::Parts;
use super::{Driver, Mute};
use crate::contact_free::{EnergyAccounts, SampleRange};
use crate::error::TimeHistoryError;
use crate::observers::Observers;
use crate::system::{Grounds, System};

/// Storeys of the largest building from which terms of tridiagonal matrices cost less than
/// full matrices of mode shapes. Two seconds of a record at 20 ms, of which the series takes 360 steps a sample, took 0.2 s by
/// the modes and 3.7 s by the series for 401 storeys, 2.5 and 10.6 s for 1,000, and over 100 and 37 s for 2,000; beside a
/// building of 300 storeys that is hit 9 and 19 s for 600, 65 and 40 s for 1,000.
const TALL: usize = 800;

/// Whether the series with tridiagonal matrices, whose work grows with the storeys, is
/// cheaper than exact steps of the modes, whose work grows with their square.
fn is_cheaper_by_series(system: &System) -> bool {
    let tallest = system.buildings().iter().map(|b| b.storeys()).max();
    system.bands().is_some() && tallest.is_some_and(|n| n > TALL)
}

impl Driver<'_> {
    pub(super) fn ready_for_contact_free(mut self) -> Self {
        if self.method.flies() && !is_cheaper_by_series(self.system) {
            self.open = Open::new(self.system, &self.options.method).map(Box::new);
            let open = self.open.as_ref();
            let parts = open.and_then(|open| {
                let tolerance = open.contact_episode.tolerance;
                Parts::new(self.system, &open.constants, tolerance)
            });
            self.parts = parts.map(Box::new);
        }
        if self.method.flies() && self.system.contact_free().is_none() {
            self.exact = ExactSteps::new(self.system);
        }
        self
    }

    /// Advances from this sample on while no gap can close and no peak can lie between
    /// samples. Returns the number of samples advanced.
    pub(super) fn propagate(
        &mut self,
        sample: usize,
        duration: f64,
        observers: &mut Observers<'_, '_>,
    ) -> Result<usize, TimeHistoryError> {
        let Some(Open {
            constants,
            phase,
            contact_episode,
        }) = self.open.as_deref_mut()
        else {
            return Ok(0);
        };
        let ground = self.system.ground();
        let whole = (duration / ground.time_step * (1.0 + 1.0e-12)).floor() as usize;
        let range = SampleRange {
            system: self.system,
            contacts: &self.contacts,
            from: sample,
            to: whole.min(ground.samples.len().saturating_sub(1)),
        };
        let quiet = self.mute.iter().all(|m| *m == Mute::No);
        if !self.contacts.closed().is_empty() || !quiet || range.from >= range.to {
            return Ok(0);
        }
        phase.take_state(
            constants,
            (self.system, &self.contacts),
            &self.peaks,
            &self.state,
        );
        let mut accounts = EnergyAccounts {
            state: &mut self.state,
            largest_input: &mut self.ledger.largest_input,
            residual: 0.0,
        };
        let watched = (&contact_episode.rows, observers);
        let advanced = phase.propagate(constants, &range, &mut accounts, watched)?;
        if advanced > 0 {
            let residual = self.residual.abs() + accounts.residual;
            if !residual.is_finite() {
                return Err(self.not_finite((sample + advanced) as f64 * ground.time_step));
            }
            self.largest_residual = self.largest_residual.max(residual);
            self.last_ground = Some(Grounds {
                first: ground.samples[sample + advanced],
                interval: sample + advanced - 1,
                tau: ground.time_step,
            });
            self.statistics.steps += advanced as u64;
            self.at_once.fill(0);
            self.stalled = 0;
        }
        Ok(advanced)
    }
}
