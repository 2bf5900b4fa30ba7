//! One closed level as a series.

use super::powers::{Law, Powers};
use super::tables::{TERMS, Terms};

/// One closed level: penetration, its rate of change and force as series in theta.
#[derive(Debug, Clone)]
pub(crate) struct TouchSeries {
    pub level: usize,
    pub delta: Terms,
    pub rate: Terms,
    pub force: Terms,
    pub(super) law: Law,
    powers: Powers,
    /// Term of the rate to be taken in next.
    pub(super) next_rate: f64,
    /// Work on the contact over the step (J), and its impulse (N s).
    pub works: (f64, f64),
}

impl TouchSeries {
    pub(super) fn new(level: usize, law: Law) -> Self {
        Self {
            level,
            delta: [0.0; TERMS],
            rate: [0.0; TERMS],
            force: [0.0; TERMS],
            law,
            powers: Powers::NONE,
            next_rate: 0.0,
            works: (0.0, 0.0),
        }
    }

    /// Takes the next term of the rate in.
    #[inline(always)]
    pub(super) fn push(&mut self, k: usize, scale: f64) {
        self.delta[k + 1] = scale * self.rate[k];
        self.rate[k + 1] = self.next_rate;
        self.force[k + 1] = self.next_force(k + 1);
    }

    #[inline(always)]
    pub(super) fn next_force(&mut self, k: usize) -> f64 {
        match &self.law {
            Law::Affine {
                constant,
                stiffness,
                dashpot,
            } => {
                let constant = if k == 0 { *constant } else { 0.0 };
                constant + stiffness * self.delta[k] + dashpot * self.rate[k]
            }
            Law::Powers(law) => {
                let motion = (self.delta[k], self.rate[k]);
                self.powers.term(law, k, motion)
            }
        }
    }
}
