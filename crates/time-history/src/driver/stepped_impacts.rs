//! Impacts of a method that does not locate them: told from the impulses of its steps.

use super::Driver;
use super::rigid_impacts::lasting;
use crate::dynamics::Instant;
use crate::peak::Peak;
use crate::system::{ContactLevel, Segment};

/// Part of an impulse that shocks of other floors may be where it still tells the force that holds floors together.
const SHOCK: f64 = 1.0e-3;

impl Driver<'_> {
    /// Closes, for what is recorded of an accepted step, the levels whose floors it holds together:
    /// those to which it gives an impulse as the step before did, that do not meet in it, and whose
    /// forces push. The method itself knows of impulses alone.
    pub(super) fn hold_for_step(&mut self, segment: &Segment, tau: f64, step: f64) {
        let Some(impulses) = self.method.step_impulses() else {
            return;
        };
        let n = self.dynamics.layout.dofs;
        for (l, impulse) in impulses.iter().enumerate() {
            let level = &self.system.levels()[l];
            let met = momentum_of_meeting(level, level.relative(&self.state[n..2 * n]).abs());
            let holds = *impulse > 0.0 && self.log.is_running(l) && met <= SHOCK * impulse;
            if holds == self.contacts.contact(l).is_some() {
                continue;
            }
            if holds {
                let collision = level.model.begin(0.0, level.effective_mass);
                self.contacts.close(l, lasting(collision));
            } else {
                self.contacts.open(l);
            }
        }
        // Floors that would pull in a part of the step part in it.
        let pulls = |driver: &mut Self, tau: f64, at_end: bool| {
            let now = Instant::committed(segment.ground(tau));
            let state = if at_end {
                &driver.new_state
            } else {
                &driver.state
            };
            let out = &mut driver.interpolated[..n];
            driver
                .dynamics
                .accelerations(&driver.contacts, now, state, out);
            let forces = &driver.dynamics.forces;
            let closed = driver.contacts.closed().iter().copied();
            let least = closed.min_by(|a, b| forces[*a].total_cmp(&forces[*b]));
            least.filter(|l| forces[*l] < 0.0)
        };
        while !self.contacts.closed().is_empty() {
            let pulling = pulls(self, tau, false).or_else(|| pulls(self, tau + step, true));
            let Some(l) = pulling else {
                break;
            };
            self.contacts.open(l);
        }
    }

    /// Logs what an accepted step did at every level. An impact is a run of steps with
    /// impulses; its times are ends of steps. From the first of them on in which the floors no
    /// longer meet they are held together. `self.new_state` holds the state before the step.
    pub(super) fn stepped_impacts(&mut self, segment: &Segment, tau: f64, step: f64) {
        let Some(impulses) = self.method.step_impulses() else {
            return;
        };
        let n = self.dynamics.layout.dofs;
        let time = segment.start + tau + step;
        let levels = self.system.levels();
        let met = |l: usize, velocity: &[f64]| {
            momentum_of_meeting(&levels[l], levels[l].relative(velocity).max(0.0))
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
                let relative = level.relative(&self.new_state[n..2 * n]).abs();
                let is_held = momentum_of_meeting(level, relative) <= SHOCK * impulse;
                if is_held && !self.log.is_lasting(l) {
                    self.log.begin_lasting(l);
                    self.peaks.force[l] = Peak { value: 0.0, time };
                }
                // What holds them is what is left beside the momentum with which they met. Where others met, their shock
                // goes through these floors too, and how much of the impulse it is nobody knows.
                let own = met(l, &self.new_state[n..2 * n]);
                if self.log.is_lasting(l) && shock - own <= SHOCK * impulse {
                    self.peaks.force[l].raise((impulse - own).max(0.0) / step, time);
                }
            } else if running {
                let separation = -level.relative(&self.new_state[n..2 * n]);
                let end = Some((segment.start + tau, separation));
                let layout = self.dynamics.layout;
                self.log
                    .open(l, end, &self.peaks, layout, &self.new_state, 0.0);
            }
            if *impulse > 0.0 {
                self.peaks.penetration[l].raise(overlap, time);
            }
        }
    }
}

/// The momentum with which floors meet that approach one another so fast (m/s), by Newton's law.
fn momentum_of_meeting(level: &ContactLevel, approach: f64) -> f64 {
    let restitution = level.model.rigid_restitution().unwrap_or(0.0);
    level.effective_mass * (1.0 + restitution) * approach
}
