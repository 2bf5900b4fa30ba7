//! Series of laws in powers of the penetration.
//!
//! `p = delta^a` solves `delta p' = a p delta'`, which gives every term of its series from
//! those before it (Knuth, The Art of Computer Programming, volume 2, section 4.7).

use pounding_gap_element::PowerLaw;

use super::tables::{TERMS, Terms};

/// The law of a closed level as it is expanded.
#[derive(Debug, Clone, Copy)]
pub(super) enum Law {
    /// `constant + stiffness delta + dashpot v`.
    Affine {
        constant: f64,
        stiffness: f64,
        dashpot: f64,
    },
    Powers(PowerLaw),
}

/// Series of the powers in a law.
#[derive(Debug, Clone, Copy)]
pub(super) struct Powers {
    spring: Terms,
    dashpot: Terms,
}

impl Powers {
    pub(super) const NONE: Self = Self {
        spring: [0.0; TERMS],
        dashpot: [0.0; TERMS],
    };

    /// Term `k` of the force, from the penetration and its rate up to that term.
    #[inline(always)]
    pub(super) fn term(&mut self, law: &PowerLaw, k: usize, delta: &Terms, rate: &Terms) -> f64 {
        self.spring[k] = power(&self.spring, law.exponent, k, delta);
        let force = law.stiffness * self.spring[k];
        if law.dashpot == 0.0 {
            return force;
        }
        if law.dashpot_exponent == law.exponent {
            self.dashpot[k] = self.spring[k];
        } else {
            self.dashpot[k] = power(&self.dashpot, law.dashpot_exponent, k, delta);
        }
        let mut sum = 0.0;
        for j in 0..=k {
            sum += self.dashpot[j] * rate[k - j];
        }
        force + law.dashpot * sum
    }
}

/// Term `k` of `delta^exponent`.
#[inline(always)]
fn power(terms: &Terms, exponent: f64, k: usize, delta: &Terms) -> f64 {
    if k == 0 {
        return match exponent {
            1.5 => delta[0] * delta[0].sqrt(),
            0.25 => delta[0].sqrt().sqrt(),
            _ => delta[0].powf(exponent),
        };
    }
    let mut sum = 0.0;
    for j in 0..k {
        sum += (exponent * (k - j) as f64 - j as f64) * delta[k - j] * terms[j];
    }
    sum / (k as f64 * delta[0])
}
