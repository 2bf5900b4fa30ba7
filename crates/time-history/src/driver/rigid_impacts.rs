//! Rigid impacts: velocities jump at a located instant.
//!
//! All rigid levels that close, or are closed, at one instant are solved together
//! as a linear complementarity problem: impulses `P >= 0`, and every pair of floors
//! that an impulse acts on parts with `e` times its approach velocity (Newton's
//! restitution in every contact; Jean and Moreau 1992, Brogliato, Nonsmooth
//! Mechanics, 3rd edition 2016, section 5.3). Floors that touch but part take no part in it:
//! they have not met, and an impulse upon them could give energy. Where it lets them approach,
//! they meet next, at the same instant. Which of them stay together afterwards is
//! decided by their accelerations (`held_contacts`).

use pounding_gap_element::{Memory, Phase};

use super::{Driver, SIMULTANEOUS};
use crate::complementarity::{Complementarity, row};
use crate::contact::Contact;
use crate::dynamics::{Instant, coupling};
use crate::error::TimeHistoryError;
use crate::events::{Candidate, EventKind};
use crate::peak::Peak;
use crate::system::Segment;

/// Height (m) of a hop below which impacts that follow one another ever faster are
/// taken as accomplished: the floors then stay in contact. Positions carry their
/// own round-off of about 1e-17 m, in which lower hops would drown.
const LOWEST_HOP: f64 = 1.0e-12;

/// Round-off of a velocity, as a part of the maximum one, or of the terms that it is the sum of.
const ROUND_OFF: f64 = 1.0e-14;

/// Relative velocity (m/s) up to which floors in touch move alike, and meet what hits one of them together:
/// what steps gather of round-off.
const ALIKE: f64 = 1.0e-12;

/// Solutions of one instant, each of which may let other floors approach, before it is given up. A
/// light body between heavy ones that lose much is thrown to and fro without end, ever more slowly,
/// until round-off is left.
const JUMPS_AT_ONCE: usize = 100_000;

/// Open floors closer than this (m) take part in an impact of their neighbours.
pub(super) const TOUCHING: f64 = 1.0e-12;

/// Floors that hold no distance worth the name (m).
const ALL_BUT_IN_TOUCH: f64 = 1.0e-6;

/// Work space of the jumps.
#[derive(Debug, Default)]
pub(super) struct RigidImpacts {
    /// Levels that close at this instant.
    pub closing: Vec<usize>,
    active: Vec<usize>,
    /// Approach velocity of every active level before the jump (m/s), zero of floors that are
    /// held together: what they have of one is round-off.
    before: Vec<f64>,
    /// Restitution in force: zero where the impacts accumulate.
    restitution: Vec<f64>,
    /// Time until the accumulation ends (s); NaN where there is none.
    accumulation: Vec<f64>,
    /// Round-off of the velocities before the jump (m/s), which it may bring to rest.
    round_off: f64,
    matrix: Vec<f64>,
    right: Vec<f64>,
    problem: Complementarity,
    /// Impulse of every active level (N s), and whether its floors part after it.
    impulses: Vec<f64>,
    part: Vec<bool>,
}

impl Driver<'_> {
    pub(super) fn is_rigid(&self, level: usize) -> bool {
        let model = &self.system.levels()[level].model;
        model.rigid_restitution().is_some()
    }

    /// Whether the floors of a level approach by more than round-off.
    pub(super) fn approaches(&self, l: usize) -> bool {
        let n = self.dynamics.layout.dofs;
        let level = &self.system.levels()[l];
        level.relative(&self.state[n..2 * n]) > self.velocity_round_off()
    }

    /// Round-off of a relative velocity (m/s). Floors at rest have it from those that
    /// move: storeys and impacts connect them.
    pub(super) fn velocity_round_off(&self) -> f64 {
        let n = self.dynamics.layout.dofs;
        let fastest = |m: f64, v: &f64| m.max(v.abs());
        2.0 * ROUND_OFF * self.state[n..2 * n].iter().fold(0.0, fastest)
    }

    /// The first of the other events of the whole step that is over at the end of the trial
    /// step, which was cut at this one: rigid floors overlap there. The gap of floors at rest is
    /// round-off, and the root of such a function may be found far behind where it was expected.
    pub(super) fn passed_over(&self, event: Candidate, whole: f64) -> Option<Candidate> {
        let passed = |other: &&Candidate| {
            other.level != event.level
                && other.kind == EventKind::Close
                && (other.theta - event.theta).abs() * whole > SIMULTANEOUS
                && self.comes_to_overlap(other.level)
        };
        let others = self.finder.candidates.iter().filter(passed);
        others
            .copied()
            .reduce(|a, b| if b.theta < a.theta { b } else { a })
    }

    /// Applies the jumps of all rigid levels in touch at this instant.
    ///
    /// # Errors
    /// Contacts that leave no velocity to part with.
    pub(super) fn rigid_impacts(
        &mut self,
        segment: &Segment,
        tau: f64,
    ) -> Result<(), TimeHistoryError> {
        let mut work = std::mem::take(&mut self.rigid);
        let time = segment.start + tau;
        self.gather(&mut work, segment, tau);
        // Floors that parted without a gap yet may be thrown back by the impact of others.
        for _ in 0..JUMPS_AT_ONCE {
            if !self.solve_impacts(&mut work) {
                return Err(self.wedged(time));
            }
            self.begin_impacts(&work, time);
            self.jump(&work.active, &work.impulses);
            let layout = self.dynamics.layout;
            let elements = &mut self.contacts.elements;
            elements.settle(self.system, layout, &self.state);
            for k in 0..work.active.len() {
                self.settle(&work, k, time);
            }
            self.follow_jump(time);
            work.closing.clear();
            self.gather(&mut work, segment, tau);
            let approaches = |v: &f64| *v > work.round_off;
            if !work.before.iter().any(approaches) {
                self.rigid = work;
                return Ok(());
            }
        }
        Err(self.wedged(time))
    }

    /// Contacts that leave nothing to part with. A row that is squeezed between two walls is thrown
    /// to and fro between them: the one that it does not touch at this instant is one of them.
    pub(super) fn wedged(&self, time: f64) -> TimeHistoryError {
        let place = self.places_closer_than(ALL_BUT_IN_TOUCH);
        TimeHistoryError::Wedged { time, place }
    }

    /// Levels that take part, with their approach velocities and restitutions.
    fn gather(&mut self, work: &mut RigidImpacts, segment: &Segment, tau: f64) {
        let n = self.dynamics.layout.dofs;
        work.active.clear();
        work.before.clear();
        work.restitution.clear();
        work.accumulation.clear();
        work.round_off = self.velocity_round_off();
        for l in 0..self.dynamics.layout.levels {
            let in_touch = self.contacts.contact(l).is_some()
                || self.contacts.penetration(self.system, l, &self.state[..n]) > -TOUCHING;
            if !(self.is_rigid(l) && in_touch) {
                continue;
            }
            let level = &self.system.levels()[l];
            let approach = level.relative(&self.state[n..2 * n]);
            let held = self.contacts.contact(l).is_some();
            if held || approach >= -ALIKE {
                work.active.push(l);
                work.before.push(if held { 0.0 } else { approach });
            }
        }
        for k in 0..work.active.len() {
            let l = work.active[k];
            let asked = self.system.levels()[l].model.rigid_restitution();
            let restitution = asked.unwrap_or(0.0);
            let approaches = work.before[k] >= -work.round_off;
            let left = if self.contacts.contact(l).is_none() && approaches {
                let approach = work.before[k].max(0.0);
                self.accumulation(segment, tau, l, approach, restitution)
            } else {
                f64::NAN
            };
            work.accumulation.push(left);
            // Floors in lasting contact have nothing to give back but round-off.
            let plastic = left.is_finite() || self.contacts.contact(l).is_some();
            work.restitution
                .push(if plastic { 0.0 } else { restitution });
        }
    }

    /// Time (s) that the infinite sequence of impacts still takes, if the next hop
    /// is too low to be followed; NaN otherwise. The relative acceleration is taken
    /// as constant over that time.
    fn accumulation(
        &mut self,
        segment: &Segment,
        tau: f64,
        l: usize,
        approach: f64,
        restitution: f64,
    ) -> f64 {
        let level = &self.system.levels()[l];
        self.contacts.close(
            l,
            lasting(level.model.begin(approach, level.effective_mass)),
        );
        let holding = self.holding_force(segment, tau, l);
        self.contacts.open(l);
        let pressing = holding / level.effective_mass;
        let rebound = restitution * approach;
        let low = rebound * rebound <= 2.0 * pressing * LOWEST_HOP;
        if !(pressing > 0.0 && low) {
            return f64::NAN;
        }
        // Without any loss in the impacts it is the dashpots of the storeys that end the
        // sequence, too late for a constant acceleration to tell when.
        if rebound == 0.0 || restitution == 1.0 {
            return 0.0;
        }
        2.0 * rebound / (pressing * (1.0 - restitution))
    }

    /// Force (N) that would hold the floors of a level together now.
    fn holding_force(&mut self, segment: &Segment, tau: f64, l: usize) -> f64 {
        let n = self.dynamics.layout.dofs;
        self.dynamics.accelerations(
            &self.contacts,
            Instant::committed(segment.ground(tau)),
            &self.state,
            &mut self.interpolated[..n],
        );
        self.dynamics.forces[l]
    }

    /// Opens the log of every impact that begins here: of floors that approach, and of those at
    /// rest that impulses of others press together.
    fn begin_impacts(&mut self, work: &RigidImpacts, time: f64) {
        for (k, &l) in work.active.iter().enumerate() {
            let meets = work.before[k] > 0.0 || work.impulses[k] > 0.0;
            let closing = work.closing.contains(&l) || meets;
            if self.contacts.contact(l).is_some() || !closing {
                continue;
            }
            let level = &self.system.levels()[l];
            let approach = work.before[k].max(0.0);
            let collision = level.model.begin(approach, level.effective_mass);
            self.contacts.close(l, lasting(collision));
            self.log
                .close(l, time, &collision, self.dynamics.layout, &self.state);
            let value = f64::NAN;
            self.peaks.force[l] = Peak { value, time };
            self.peaks.penetration[l] = Peak { value: 0.0, time };
        }
    }

    /// Solves for the impulses, and tells whose floors part: those that an impulse acts on by
    /// their restitution, the others if what is added to their velocity, all by other impulses,
    /// is more than the round-off of that sum. False if there is no solution.
    fn solve_impacts(&self, work: &mut RigidImpacts) -> bool {
        let (levels, mass) = (self.system.levels(), self.system.mass());
        let count = work.active.len();
        work.matrix.clear();
        work.right.clear();
        for (k, &a) in work.active.iter().enumerate() {
            for &b in &work.active {
                work.matrix.push(coupling(&levels[a], &levels[b], mass));
            }
            let restored = work.restitution[k] * work.before[k];
            work.right.push(-(work.before[k] + restored));
        }
        let Some(impulses) = work.problem.solve(&work.matrix, &work.right) else {
            return false;
        };
        work.impulses.clear();
        work.impulses.extend_from_slice(impulses);
        work.part.clear();
        for k in 0..count {
            let parts = if work.problem.is_active(k) {
                work.restitution[k] * work.before[k] > 0.0
            } else {
                let of_level = &work.matrix[k * count..(k + 1) * count];
                let (parting, size) = row(of_level, &work.impulses, -work.before[k]);
                let held = self.contacts.contact(work.active[k]).is_some();
                let margin = if held { 0.0 } else { work.round_off };
                parting > margin + ROUND_OFF * size
            };
            work.part.push(parts);
        }
        true
    }

    /// Applies impulses (N s) to the floors of levels; elements are to follow. The work of an impulse is its mean
    /// velocity times itself, which is the kinetic energy lost to the last bit of theory.
    pub(super) fn jump(&mut self, active: &[usize], impulses: &[f64]) {
        let (levels, mass) = (self.system.levels(), self.system.mass());
        let (n, layout) = (self.dynamics.layout.dofs, self.dynamics.layout);
        for (&l, impulse) in active.iter().zip(impulses) {
            let before = levels[l].relative(&self.state[n..2 * n]);
            self.state[layout.work(l)] += 0.5 * impulse * before;
        }
        let velocity = &mut self.state[n..2 * n];
        for (&l, impulse) in active.iter().zip(impulses) {
            if let Some(left) = levels[l].left {
                velocity[left] -= impulse / mass[left];
            }
            if let Some(right) = levels[l].right {
                velocity[right] += impulse / mass[right];
            }
            for (i, weight) in &levels[l].terms.pushed {
                velocity[*i] -= weight * impulse / mass[*i];
            }
        }
        for (&l, impulse) in active.iter().zip(impulses) {
            let after = levels[l].relative(&self.state[n..2 * n]);
            self.state[layout.work(l)] += 0.5 * impulse * after;
            self.state[layout.impulse(l)] += impulse;
            let of_ground = levels[l].terms.ground_of(|i| self.state[n + i]);
            self.state[layout.input()] += impulse * of_ground;
        }
    }

    /// Ends the impact of a level whose floors part; leaves the others in lasting
    /// contact.
    fn settle(&mut self, work: &RigidImpacts, k: usize, time: f64) {
        let l = work.active[k];
        if self.contacts.contact(l).is_none() {
            return;
        }
        if work.part[k] {
            self.open(l, time);
            return;
        }
        if !self.log.is_lasting(l) {
            self.log.begin_lasting(l);
            self.peaks.force[l] = Peak { value: 0.0, time };
            if work.accumulation[k].is_finite() {
                self.log.closed_at(l, time + work.accumulation[k]);
            }
        }
    }
}

/// A contact that holds.
pub(super) fn lasting(collision: pounding_gap_element::Collision) -> Contact {
    Contact {
        phase: Phase::Stuck,
        collision,
        memory: Memory::default(),
    }
}
