//! Series of laws in powers of the penetration.
//!
//! `p = delta^a` solves `delta p' = a p delta'`, which gives every term of its series from
//! those before it (Knuth, The Art of Computer Programming, volume 2, section 4.7):
//! `k delta_0 p_k = sum (a (k - j) - j) delta_(k-j) p_j` over `j < k`.

use pounding_gap_element::PowerLaw;

use super::tables::{PARTS, TERMS};
use crate::system::modes::{Lane, WIDTH, add};

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

/// Series of the powers in a law, all sums of whose recurrences run side by side: the places
/// of a lane are the two sums of the spring's power, the two of the dashpot's, and the product
/// of the dashpot's with the rate.
#[derive(Debug, Clone, Copy)]
pub(super) struct Powers {
    /// Terms of the powers by their number: a term of the spring's and the same times its
    /// number, both of the dashpot's, and once more that of the dashpot's.
    terms: [Lane; TERMS],
    /// What they are multiplied by, in reverse, so that both run the same way: a term of the
    /// penetration times its number and the term, twice, and that of the rate.
    motion: [Lane; TERMS],
    /// One over the first term of the penetration, and the first term of the rate.
    inverse: f64,
    first_rate: f64,
    /// The first terms of the powers of spring and dashpot.
    first: [f64; 2],
}

impl Powers {
    pub(super) const NONE: Self = Self {
        terms: [Lane::ZERO; TERMS],
        motion: [Lane::ZERO; TERMS],
        inverse: 0.0,
        first_rate: 0.0,
        first: [0.0; 2],
    };

    /// Term `k` of the force, from that of the penetration and of its rate.
    #[inline(always)]
    pub(super) fn term(&mut self, law: &PowerLaw, k: usize, (delta, rate): (f64, f64)) -> f64 {
        if k == 0 {
            return self.begin(law, (delta, rate));
        }
        let sums = self.sums(k);
        let (order, part) = (k as f64, PARTS[k] * self.inverse);
        let weighted = order * delta;
        self.motion[TERMS - k] = Lane([weighted, delta, weighted, delta, rate, 0.0, 0.0, 0.0]);
        // What is known last comes last.
        let next = |exponent: f64, first: f64, rising: f64, falling: f64| {
            (exponent * (rising + weighted * first) - falling) * part
        };
        let spring = next(law.exponent, self.first[0], sums[0], sums[1]);
        let (dashpot, force) = if law.dashpot == 0.0 {
            (0.0, law.stiffness * spring)
        } else {
            let dashpot = if law.dashpot_exponent == law.exponent {
                spring
            } else {
                next(law.dashpot_exponent, self.first[1], sums[2], sums[3])
            };
            let product = (sums[4] + self.first_rate * dashpot) + rate * self.first[1];
            (dashpot, law.stiffness * spring + law.dashpot * product)
        };
        let both = [order * spring, order * dashpot];
        self.terms[k] = Lane([spring, both[0], dashpot, both[1], dashpot, 0.0, 0.0, 0.0]);
        force
    }

    /// The first term of the force.
    #[inline(always)]
    fn begin(&mut self, law: &PowerLaw, (delta, rate): (f64, f64)) -> f64 {
        (self.inverse, self.first_rate) = (1.0 / delta, rate);
        let spring = power(delta, law.exponent);
        let dashpot = if law.dashpot == 0.0 {
            0.0
        } else if law.dashpot_exponent == law.exponent {
            spring
        } else {
            power(delta, law.dashpot_exponent)
        };
        self.first = [spring, dashpot];
        law.stiffness * spring + law.dashpot * rate * dashpot
    }

    /// Sums over the terms between the first and term `k`.
    #[inline(always)]
    fn sums(&self, k: usize) -> Lane {
        let (terms, motion) = (&self.terms[1..k], &self.motion[TERMS + 1 - k..]);
        // Two chains of additions, not one.
        let (mut even, mut odd) = (Lane::ZERO, Lane::ZERO);
        let (pairs, rest) = terms.as_chunks::<2>();
        let (others, other) = motion.as_chunks::<2>();
        for (t, m) in pairs.iter().zip(others) {
            for l in 0..WIDTH {
                even[l] += t[0][l] * m[0][l];
                odd[l] += t[1][l] * m[1][l];
            }
        }
        for (t, m) in rest.iter().zip(other) {
            for l in 0..WIDTH {
                even[l] += t[l] * m[l];
            }
        }
        let sums = add(even, odd);
        // Keeps the compiler from taking the vectors before it apart.
        *std::hint::black_box(&sums)
    }
}

/// A power of a positive penetration.
#[inline(always)]
fn power(delta: f64, exponent: f64) -> f64 {
    if exponent == 1.5 {
        delta * delta.sqrt()
    } else if exponent == 0.25 {
        delta.sqrt().sqrt()
    } else {
        libm::pow(delta, exponent)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against the binomial series of `(d + v t)^a` and its products.
    #[test]
    fn agrees_with_the_binomial_series() {
        let (d, v) = (2.0e-3_f64, 0.3e-3_f64);
        let law = PowerLaw {
            stiffness: 3.0,
            exponent: 1.5,
            dashpot: 0.7,
            dashpot_exponent: 0.25,
        };
        let mut powers = Powers::NONE;
        let binomial = |a: f64, k: usize| -> f64 {
            let ratio = v / d;
            (0..k).fold(libm::pow(d, a), |c, j| {
                c * (a - j as f64) / (j + 1) as f64 * ratio
            })
        };
        for k in 0..20 {
            let motion = match k {
                0 => (d, 0.4),
                1 => (v, -0.9),
                _ => (0.0, 0.0),
            };
            let term = powers.term(&law, k, motion);
            let before = if k > 0 { binomial(0.25, k - 1) } else { 0.0 };
            let dashpot = 0.4 * binomial(0.25, k) - 0.9 * before;
            let expected = 3.0 * binomial(1.5, k) + 0.7 * dashpot;
            let size = 3.0 * binomial(1.5, k).abs() + 0.7 * before.abs();
            assert!(
                (term - expected).abs() <= 1e-13 * size,
                "{k}: {term} {expected}"
            );
        }
    }
}
