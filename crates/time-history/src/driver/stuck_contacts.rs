//! Which contacts friction still holds where forces jump.
//!
//! A contact that begins to stick, or is let go, changes the forces that hold others at once. The
//! event finder looks for functions that become positive; the margin of another contact that a
//! jump made so would be found too late, or never.

use pounding_gap_element::Phase;

use super::{Driver, Mute};
use crate::contact::Contact;
use crate::dynamics::Instant;
use crate::system::Segment;

/// Part of the range of friction that a holding force may exceed it by in round-off.
const ROUND_OFF: f64 = 1.0e-9;

impl Driver<'_> {
    /// Lets go those contacts that need more to be held than friction has, the farthest first.
    pub(super) fn settle_stuck(&mut self, segment: &Segment, tau: f64) {
        let n = self.dynamics.layout.dofs;
        for _ in 0..self.dynamics.layout.levels {
            let Some((l, phase)) = self.torn(segment, tau) else {
                return;
            };
            self.contacts.enter(self.system, l, phase, &self.state[..n]);
            self.mute[l] = Mute::Step;
            self.statistics.events += 1;
        }
    }

    /// The contact whose holding force is farthest beyond its range, with the phase that it goes on in.
    fn torn(&mut self, segment: &Segment, tau: f64) -> Option<(usize, Phase)> {
        let n = self.dynamics.layout.dofs;
        if !self.contacts.closed().iter().any(|l| self.is_stuck(*l)) {
            return None;
        }
        self.dynamics.accelerations(
            &self.contacts,
            Instant::committed(segment.ground(tau)),
            &self.state,
            &mut self.interpolated[..n],
        );
        let mut farthest = (ROUND_OFF, None);
        for &l in self.contacts.closed() {
            let Some(contact) = self.contacts.contact(l).filter(|_| self.is_stuck(l)) else {
                continue;
            };
            let delta = self.contacts.penetration(self.system, l, &self.state[..n]);
            let model = &self.system.levels()[l].model;
            let (low, high) = model.stick_range(&contact.collision, &contact.memory, delta);
            let holding = self.dynamics.forces[l];
            let size = low.abs().max(high.abs());
            for (beyond, phase) in [
                (holding - high, Phase::Approach),
                (low - holding, Phase::Restitution),
            ] {
                if beyond > farthest.0 * size {
                    farthest = (beyond / size, Some((l, phase)));
                }
            }
        }
        farthest.1
    }

    /// Whether friction holds a contact.
    fn is_stuck(&self, l: usize) -> bool {
        let contact = self.contacts.contact(l);
        !self.is_rigid(l) && contact.is_some_and(Contact::is_stuck)
    }
}
