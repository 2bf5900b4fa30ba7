//! Which rigid floors in touch are held together.
//!
//! Floors in touch and at rest relative to one another have a force `F >= 0` or part with an
//! acceleration `w >= 0`, not both: with `w = A F - b`, where `b` are the relative
//! accelerations without these forces, a linear complementarity problem of all such levels
//! together. `A = G M^-1 G'` of independent contacts is positive definite, so that the set of
//! those that hold is unique (Glocker and Pfeiffer, Multibody Dynamics with Unilateral
//! Contacts, 1996, chapter 6). Forces may jump at every event, and where the ground acceleration does:
//! the set is looked for at each of them, before anything is recorded of what follows.
//!
//! A held force that crosses zero is an event of its own. There `F`, `w` and `b` are zero and
//! only the direction of the crossing tells that the floors part.

use super::rigid_impacts::{TOUCHING, lasting};
use super::{Driver, Mute, PROGRESS_STEP};
use crate::complementarity::{Complementarity, row};
use crate::contact::Contact;
use crate::dynamics::{Instant, coupling};
use crate::error::TimeHistoryError;
use crate::peak::Peak;
use crate::small_solver::SmallSolver;
use crate::system::Segment;

/// Round-off of accelerations, as a part of the maximum one without the forces: those of stiff
/// storeys are differences of greater terms. What is smaller changes nothing: floors that are
/// held stay so with a force of that order until it crosses zero, those that are apart stay
/// apart.
const ROUND_OFF: f64 = 1.0e-12;

/// Work space.
#[derive(Debug, Default)]
pub(super) struct HeldContacts {
    /// Levels whose force crosses zero at this instant.
    pub leaving: Vec<usize>,
    /// Rigid levels in touch and at rest, then those of other laws that friction holds.
    levels: Vec<usize>,
    contacts: Vec<Option<Contact>>,
    matrix: Vec<f64>,
    right: Vec<f64>,
    /// Force of each level (N).
    forces: Vec<f64>,
    problem: Complementarity,
    solver: SmallSolver,
}

impl Driver<'_> {
    /// Closes rigid levels that are pressed together, and opens those that would pull.
    ///
    /// # Errors
    /// Contacts whose forces are not unique.
    pub(super) fn settle_held(
        &mut self,
        segment: &Segment,
        tau: f64,
    ) -> Result<(), TimeHistoryError> {
        if !self.any_rigid {
            return Ok(());
        }
        let mut work = std::mem::take(&mut self.held);
        let rigid = self.list_at_rest(&mut work);
        let solved = rigid == 0 || self.choose_held(&mut work, rigid, segment, tau);
        self.held = work;
        if solved {
            Ok(())
        } else {
            Err(self.wedged(segment.start + tau))
        }
    }

    /// Lists the levels of the problem; returns how many of them are rigid.
    fn list_at_rest(&self, work: &mut HeldContacts) -> usize {
        let n = self.dynamics.layout.dofs;
        let (u, v) = (&self.state[..n], &self.state[n..2 * n]);
        let round_off = self.velocity_round_off();
        work.levels.clear();
        for (l, level) in self.system.levels().iter().enumerate() {
            let at_rest = self.is_rigid(l)
                && (self.contacts.contact(l).is_some()
                    || (!work.leaving.contains(&l)
                        && self.contacts.penetration(self.system, l, u) > -TOUCHING
                        && level.relative(v).abs() <= round_off));
            if at_rest {
                work.levels.push(l);
            }
        }
        let rigid = work.levels.len();
        if rigid == 0 {
            return 0;
        }
        let stuck = |l: &&usize| {
            !self.is_rigid(**l) && self.contacts.contact(**l).is_some_and(Contact::is_stuck)
        };
        work.levels
            .extend(self.contacts.closed().iter().filter(stuck));
        rigid
    }

    /// Solves the problem and acts on it; false if there is no solution.
    fn choose_held(
        &mut self,
        work: &mut HeldContacts,
        rigid: usize,
        segment: &Segment,
        tau: f64,
    ) -> bool {
        let (n, count) = (self.dynamics.layout.dofs, work.levels.len());
        work.contacts.clear();
        for &l in &work.levels {
            let contact = self.contacts.contact(l).copied();
            work.contacts.push(contact);
            if contact.is_some() {
                self.contacts.open(l);
            }
        }
        let out = &mut self.interpolated[..n];
        let now = Instant::committed(segment.ground(tau));
        let contacts = &self.contacts;
        self.dynamics.accelerations(contacts, now, &self.state, out);
        for (&l, contact) in work.levels.iter().zip(&work.contacts) {
            if let Some(contact) = contact {
                self.contacts.close(l, *contact);
            }
        }
        let (levels, mass) = (self.system.levels(), self.system.mass());
        let accelerations = &self.interpolated[..n];
        let largest = accelerations.iter().fold(0.0_f64, |m, a| m.max(a.abs()));
        work.matrix.clear();
        work.right.clear();
        for &a in &work.levels {
            for &b in &work.levels {
                work.matrix.push(coupling(&levels[a], &levels[b], mass));
            }
            work.right.push(-levels[a].relative(accelerations));
        }
        let solution = (work.problem).solve_mixed(&work.matrix, &work.right, rigid);
        let Some(forces) = solution else {
            return false;
        };
        work.forces.clear();
        work.forces.extend_from_slice(forces);
        let time = segment.start + tau;
        for k in 0..rigid {
            let l = work.levels[k];
            let of_level = &work.matrix[k * count..(k + 1) * count];
            let (parting, size) = row(of_level, &work.forces, work.right[k]);
            let margin = ROUND_OFF * largest.max(size);
            if work.contacts[k].is_none() {
                if work.forces[k] * of_level[k] > margin {
                    self.hold_together(l, time);
                }
            } else if !work.problem.is_active(k) && parting > margin {
                self.open(l, time);
                self.keep_quiet(l);
            }
        }
        true
    }

    /// Floors at rest in touch are pressed together from now on.
    fn hold_together(&mut self, l: usize, time: f64) {
        let level = &self.system.levels()[l];
        let collision = level.model.begin(0.0, level.effective_mass);
        self.contacts.close(l, lasting(collision));
        let layout = self.dynamics.layout;
        self.log.close(l, time, &collision, layout, &self.state);
        self.log.begin_lasting(l);
        self.peaks.force[l] = Peak { value: 0.0, time };
        self.peaks.penetration[l] = Peak { value: 0.0, time };
        self.mute[l] = Mute::No;
        self.quiet[l] = PROGRESS_STEP;
    }

    /// Takes from held floors what round-off gave them of a relative velocity: forces keep
    /// their relative acceleration zero, and a sum over many steps is not zero to the last bit.
    pub(super) fn bring_to_rest(&mut self) {
        if !self.any_rigid {
            return;
        }
        let n = self.dynamics.layout.dofs;
        let mut work = std::mem::take(&mut self.held);
        work.levels.clear();
        let closed = self.contacts.closed().iter().copied();
        work.levels.extend(closed.filter(|l| self.is_rigid(*l)));
        let (levels, mass) = (self.system.levels(), self.system.mass());
        work.matrix.clear();
        work.right.clear();
        for &a in &work.levels {
            for &b in &work.levels {
                work.matrix.push(coupling(&levels[a], &levels[b], mass));
            }
            work.right.push(levels[a].relative(&self.state[n..2 * n]));
        }
        let moves = work.right.iter().any(|v| *v != 0.0);
        if moves && work.solver.solve(&work.matrix, &mut work.right) {
            self.jump(&work.levels, &work.right);
            // Round-off leads no element off its branch: what is to be passed is an event.
            let layout = self.dynamics.layout;
            let elements = &mut self.contacts.elements;
            elements.take_in(self.system, layout, &self.state);
        }
        self.held = work;
    }
}
