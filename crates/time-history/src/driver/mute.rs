//! Levels whose events do not count for a while: what round-off alone would make of them.

use super::rigid_impacts::TOUCHING;
use super::{Driver, EVENTS_AT_ONCE, PROGRESS_STEP, SIMULTANEOUS};
use crate::dynamics::{Context, Instant};
use crate::events::{Candidate, EventKind, penetration};
use crate::polynomial::maximum_above;
use crate::system::{Segment, TOUCH};

/// Closures of a level in touch before its gap is left open for a while, and the longest
/// such while (s).
const TOUCHES: usize = 8;
const LONGEST_TOUCH: f64 = 1.0e-3;

/// Longest time (s) for which rigid floors are let be.
const LONGEST_QUIET: f64 = 1.0e-4;

/// What events of a level do not count in the next step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Mute {
    /// All count.
    No,
    /// Not those at its very start: the level has to make progress.
    Start,
    /// None: the floors just broke loose, or are let be.
    Step,
}

impl Mute {
    /// Whether an event so long (s) after the start of the step does not count, at a level
    /// that had this many at the present instant.
    pub(super) fn hides(self, time: f64, at_once: usize) -> bool {
        match self {
            Self::No => false,
            // Round-off may put an event that comes again and again a trifle later.
            Self::Start if at_once > EVENTS_AT_ONCE => time <= SIMULTANEOUS,
            Self::Start => time == 0.0,
            Self::Step => true,
        }
    }
}

impl Driver<'_> {
    /// Lets rigid floors be for a while, ever longer if they do not come to rest.
    pub(super) fn keep_quiet(&mut self, l: usize) {
        if self.mute[l] != Mute::Step {
            self.eventful = true;
            self.mute[l] = Mute::Step;
            self.quiet[l] = (2.0 * self.quiet[l]).min(LONGEST_QUIET);
        }
    }

    /// Whether a closure is one of many between which the floors neither part nor overlap by
    /// more than a touch. Floors that lie against one another at rest leave, or are pressed
    /// together, like a high power of time, and neighbours of equal period and no gap move alike
    /// for ever: round-off decides on which side of zero they are. The gap then stays open for a
    /// while in which its floors cannot move by more than a touch; if they overlap after it and
    /// still approach, it closes.
    pub(super) fn goes_on_touching(
        &mut self,
        segment: &Segment,
        tau: f64,
        event: Candidate,
    ) -> bool {
        let (n, l) = (self.dynamics.layout.dofs, event.level);
        if event.kind != EventKind::Close {
            return false;
        }
        let level = &self.system.levels()[l];
        let rate = level.relative(&self.state[n..2 * n]);
        let overlap = self.contacts.penetration(self.system, l, &self.state[..n]);
        if event.theta == 0.0 && overlap > 0.0 && rate > 0.0 {
            return false;
        }
        let in_touch = self.log.stays_in_touch(l, segment.start + tau, rate);
        if !in_touch || self.peaks.penetration[l].value > TOUCH {
            self.touches[l] = 0;
            return false;
        }
        self.touches[l] += 1;
        let Some(beyond) = self.touches[l].checked_sub(TOUCHES) else {
            return false;
        };
        self.dynamics.accelerations(
            &self.contacts,
            Instant::committed(segment.ground(tau)),
            &self.state,
            &mut self.interpolated[..n],
        );
        let acceleration = level.relative(&self.interpolated[..n]).abs();
        let bounded = (TOUCH / rate.abs()).min((2.0 * TOUCH / acceleration).sqrt());
        let growing = PROGRESS_STEP * f64::from(1_u32 << beyond.min(10));
        self.quiet[l] = growing.min(LONGEST_TOUCH).min(bounded);
        // Floors that move by more than a touch soon are not torn by round-off.
        self.quiet[l] >= PROGRESS_STEP
    }

    /// Whether floors that are let be come to overlap in the trial step: it was not for round-off
    /// then.
    pub(super) fn overlaps_unseen(&mut self, segment: &Segment) -> bool {
        (0..self.mute.len()).any(|l| {
            self.mute[l] == Mute::Step
                && match self.is_rigid(l) {
                    true => self.comes_to_overlap(l),
                    false => self.comes_to_more_than_a_touch(segment, l),
                }
        })
    }

    /// Whether the floors of a rigid level overlap at the end of the trial step by more than
    /// they did.
    pub(super) fn comes_to_overlap(&self, l: usize) -> bool {
        let n = self.dynamics.layout.dofs;
        let overlap = |state: &[f64]| {
            let overlap = self.contacts.penetration(self.system, l, &state[..n]);
            overlap.max(TOUCHING)
        };
        self.is_rigid(l) && overlap(&self.new_state) > overlap(&self.state)
    }

    /// Whether floors with an open gap overlap anywhere in the trial step by more than they do, and
    /// by more than a touch.
    fn comes_to_more_than_a_touch(&mut self, segment: &Segment, l: usize) -> bool {
        if self.contacts.contact(l).is_some() {
            return false;
        }
        let context = Context {
            dynamics: &mut self.dynamics,
            contacts: &self.contacts,
            segment,
        };
        let overlap = penetration(&context, self.method.as_ref(), l);
        maximum_above(&overlap, overlap[0].max(TOUCH)).is_some()
    }
}
