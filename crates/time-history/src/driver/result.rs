//! The end of a run.

use super::Driver;
use crate::error::TimeHistoryError;
use crate::ledger;
use crate::outcome::{BuildingOutcome, GapOutcome, Outcome};
use crate::recorder::Recorder;

impl Driver<'_> {
    pub(super) fn finish(
        mut self,
        duration: f64,
        recorders: &mut [&mut dyn Recorder],
    ) -> Result<Outcome, TimeHistoryError> {
        self.leave_for_good(duration)?;
        let layout = self.dynamics.layout;
        let n = layout.dofs;
        for l in 0..layout.levels {
            let stored = ledger::stored_energy(self.system, &self.contacts, l, &self.state[..n]);
            self.log
                .open(l, None, &self.peaks, layout, &self.state, stored);
        }
        self.hand_out_impacts(recorders)?;
        if self.ledger.largest_input > 0.0 {
            self.ledger.residual_ratio = self.largest_residual / self.ledger.largest_input;
        }
        let allowed = self.options.energy_tolerance();
        if self.ledger.residual_ratio > allowed {
            return Err(TimeHistoryError::EnergyResidual {
                residual: self.ledger.residual_ratio,
                allowed,
                time: duration,
                method: self.method.information().title,
            });
        }
        let counts = self.method.counts();
        self.statistics.evaluations = counts.evaluations + self.evaluations_in_modes();
        self.statistics.newton_iterations = counts.newton_iterations;
        let buildings = self
            .system
            .buildings()
            .iter()
            .zip(self.system.offsets().windows(2))
            .map(|(b, range)| BuildingOutcome {
                name: b.name().to_owned(),
                storeys: self.peaks.storeys[range[0]..range[1]].to_vec(),
            })
            .collect();
        let (levels, impacts) = self.log.into_outcome();
        let gaps = self
            .system
            .gaps()
            .iter()
            .map(|g| GapOutcome {
                name: g.name.clone(),
                levels: levels[g.first_level..g.first_level + g.levels].to_vec(),
            })
            .collect();
        Ok(Outcome {
            method: self.method.information(),
            end_time: duration,
            buildings,
            gaps,
            impacts,
            energy: self.ledger,
            final_displacement: self.state[..n].to_vec(),
            final_velocity: self.state[n..2 * n].to_vec(),
            statistics: self.statistics,
            warnings: Vec::new(),
        })
    }
}
