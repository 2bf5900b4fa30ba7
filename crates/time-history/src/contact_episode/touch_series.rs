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
    /// Of penetration and force: values at the end, and bounds of the distance from the chord.
    pub delta_end: (f64, f64),
    pub force_end: (f64, f64),
    /// Rate of the penetration (m/s) at the end, as the modes have it.
    pub rate_end: f64,
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
            delta_end: (0.0, 0.0),
            force_end: (0.0, 0.0),
            rate_end: 0.0,
            works: (0.0, 0.0),
        }
    }

    /// Takes term `k` of penetration and rate in. Returns that of the force, whose powers
    /// `powers` has from the terms before.
    #[inline(always)]
    pub(super) fn push(&mut self, powers: &mut Powers, k: usize, (delta, rate): (f64, f64)) -> f64 {
        (self.delta[k], self.rate[k]) = (delta, rate);
        self.force[k] = match &self.law {
            Law::Affine {
                constant,
                stiffness,
                dashpot,
            } => {
                let constant = if k == 0 { *constant } else { 0.0 };
                constant + stiffness * delta + dashpot * rate
            }
            Law::Powers(law) => powers.term(law, k, (delta, rate)),
        };
        self.force[k]
    }
}
