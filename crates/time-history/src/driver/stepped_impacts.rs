//! Impacts of a method that does not locate them: told from the impulses of its steps.

use super::Driver;
use super::rigid_impacts::lasting;
use crate::dynamics::Segment;
use crate::outcome::Peak;

/// Part of an impulse that shocks of other floors may be where it still tells the force that holds floors together.
const SHOCK: f64 = 1.0e-3;

impl Driver<'_> {
    /// Logs what an accepted step did at every level. An impact is a run of steps with
    /// impulses; its times are ends of steps. From the second of them on the floors are held
    /// together. `self.new_state` holds the state before the step.
    pub(super) fn stepped_impacts(&mut self, segment: &Segment, tau: f64, step: f64) {
        let Some(impulses) = self.method.step_impulses() else {
            return;
        };
        let n = self.dynamics.layout.dofs;
        let time = segment.start + tau + step;
        let levels = self.system.levels();
        // The momentum with which the floors of a level met, by Newton's law.
        let met = |l: usize, velocity: &[f64]| {
            let approach = levels[l].relative(velocity).max(0.0);
            let restitution = levels[l].model.rigid_restitution().unwrap_or(0.0);
            levels[l].effective_mass * (1.0 + restitution) * approach
        };
        let before = &self.new_state[n..2 * n];
        let meeting = (0..levels.len()).filter(|l| impulses[*l] > 0.0);
        let shock: f64 = meeting.map(|l| met(l, before)).sum();
        for (l, impulse) in impulses.iter().enumerate() {
            let level = &levels[l];
            let overlap = self
                .contacts
                .penetration(self.system, l, &self.state[..n])
                .max(0.0);
            let running = self.log.is_running(l);
            if *impulse > 0.0 && !running {
                let approach = level.relative(&self.new_state[n..2 * n]).max(0.0);
                let collision = level.model.begin(approach, level.effective_mass);
                let layout = self.dynamics.layout;
                self.log.close(l, time, &collision, layout, &self.new_state);
                let value = f64::NAN;
                self.peaks.force[l] = Peak { value, time };
                self.peaks.penetration[l] = Peak { value: 0.0, time };
            } else if *impulse > 0.0 {
                if !self.log.is_lasting(l) {
                    self.log.begin_lasting(l);
                    self.peaks.force[l] = Peak { value: 0.0, time };
                }
                // What holds them is what is left beside the momentum with which they met. Where others met, their shock
                // goes through these floors too, and how much of the impulse it is nobody knows.
                let own = met(l, &self.new_state[n..2 * n]);
                if shock - own <= SHOCK * impulse {
                    self.peaks.force[l].raise((impulse - own).max(0.0) / step, time);
                }
                if self.contacts.contact(l).is_none() {
                    // For what is recorded of the next step, to which the method gives its own
                    // impulse.
                    let collision = level.model.begin(0.0, level.effective_mass);
                    self.contacts.close(l, lasting(collision));
                }
            } else if running {
                let separation = -level.relative(&self.new_state[n..2 * n]);
                let end = Some((segment.start + tau, separation));
                let layout = self.dynamics.layout;
                self.log
                    .open(l, end, &self.peaks, layout, &self.new_state, 0.0);
            }
            if *impulse <= 0.0 && self.contacts.contact(l).is_some() {
                self.contacts.open(l);
            }
            if *impulse > 0.0 {
                self.peaks.penetration[l].raise(overlap, time);
            }
        }
    }
}
