//! Series of laws in powers of the penetration.
//!
//! `p = delta^a` solves `delta p' = a p delta'`, which gives every term of its series from
//! those before it (Knuth, The Art of Computer Programming, volume 2, section 4.7):
//! `k delta_0 p_k = sum (a (k - j) - j) delta_(k-j) p_j` over `j < k`.

use pounding_gap_element::PowerLaw;

use super::tables::{PARTS, TERMS, Terms};

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

/// One power: its terms but the newest, and these times their number.
#[derive(Debug, Clone, Copy)]
struct Power {
    terms: Terms,
    weighted: Terms,
    newest: f64,
}

/// Series of the powers in a law. Those of the penetration and of its rate stand in
/// reverse, so that sums of products run the same way through both.
#[derive(Debug, Clone, Copy)]
pub(super) struct Powers {
    spring: Power,
    dashpot: Power,
    delta: Terms,
    /// Terms of the penetration times their number.
    weighted: Terms,
    rate: Terms,
    /// One over the first term of the penetration, and the first term of the rate.
    inverse: f64,
    first_rate: f64,
}

impl Powers {
    pub(super) const NONE: Self = {
        let none = Power {
            terms: [0.0; TERMS],
            weighted: [0.0; TERMS],
            newest: 0.0,
        };
        Self {
            spring: none,
            dashpot: none,
            delta: [0.0; TERMS],
            weighted: [0.0; TERMS],
            rate: [0.0; TERMS],
            inverse: 0.0,
            first_rate: 0.0,
        }
    };

    /// Term `k` of the force, from that of the penetration and of its rate.
    #[inline(always)]
    pub(super) fn term(&mut self, law: &PowerLaw, k: usize, (delta, rate): (f64, f64)) -> f64 {
        let place = TERMS - 1 - k;
        self.delta[place] = delta;
        self.weighted[place] = k as f64 * delta;
        if k == 0 {
            (self.inverse, self.first_rate) = (1.0 / delta, rate);
        }
        let motion = Motion {
            delta: &self.delta[place..],
            weighted: &self.weighted[place..],
            part: PARTS[k] * self.inverse,
        };
        let force = law.stiffness * self.spring.term(law.exponent, k, motion);
        if law.dashpot == 0.0 {
            return force;
        }
        let power = if law.dashpot_exponent == law.exponent {
            &self.spring
        } else {
            self.dashpot.term(law.dashpot_exponent, k, motion);
            &self.dashpot
        };
        // What is known last comes last.
        self.rate[place] = rate;
        let mut sum = self.first_rate * power.newest;
        if let Some(before) = k.checked_sub(1) {
            let inner = dot(&self.rate[place + 1..], &power.terms[1..], before);
            sum = (inner + sum) + rate * power.terms[0];
        }
        force + law.dashpot * sum
    }
}

/// The penetration up to one of its terms, in reverse.
#[derive(Clone, Copy)]
struct Motion<'a> {
    delta: &'a [f64],
    weighted: &'a [f64],
    /// One over the number of the term times the first of all.
    part: f64,
}

impl Power {
    /// Term `k` of `delta^exponent`.
    #[inline(always)]
    fn term(&mut self, exponent: f64, k: usize, motion: Motion<'_>) -> f64 {
        let Some(before) = k.checked_sub(1) else {
            let first = motion.delta[0];
            self.newest = if exponent == 1.5 {
                first * first.sqrt()
            } else if exponent == 0.25 {
                first.sqrt().sqrt()
            } else {
                libm::pow(first, exponent)
            };
            return self.newest;
        };
        let rising = dot(motion.weighted, &self.terms, before);
        let falling = dot(motion.delta, &self.weighted, before);
        let order = before as f64;
        // What is known last comes last.
        let last = motion.delta[before] * self.newest * (exponent - order);
        self.terms[before] = self.newest;
        self.weighted[before] = order * self.newest;
        self.newest = ((exponent * rising - falling) + last) * motion.part;
        self.newest
    }
}

/// Sum of the products of the first `count` terms, one by one: a vector would wait for
/// terms that were stored one by one just before.
#[inline(always)]
fn dot(a: &[f64], b: &[f64], count: usize) -> f64 {
    let mut sum = 0.0;
    for (x, y) in a[..count].iter().zip(&b[..count]) {
        sum += x * y;
    }
    sum
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
