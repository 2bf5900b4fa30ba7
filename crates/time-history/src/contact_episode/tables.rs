//! Powers of the points at which series are sampled.

use std::sync::OnceLock;

use crate::polynomial::{COEFFICIENTS, GAUSS as GAUSS_OF_SIX, Polynomial, fit_basis, fit_nodes};
use crate::system::modes::{Lane, WIDTH};

/// Terms of a series at most, that of order zero included.
pub(super) const TERMS: usize = 28;

/// Terms of a scalar series.
pub(super) type Terms = [f64; TERMS];

/// Nodes and weights of the Gauss rule with eight points on (0, 1), exact to degree 15: a
/// place of a lane each.
const GAUSS: [(f64, f64); WIDTH] = [
    (0.019_855_071_751_231_912, 0.050_614_268_145_188_53),
    (0.101_666_761_293_186_64, 0.111_190_517_226_687_21),
    (0.237_233_795_041_835_5, 0.156_853_322_938_943_44),
    (0.408_282_678_752_175_1, 0.181_341_891_689_180_83),
    (0.591_717_321_247_824_8, 0.181_341_891_689_180_83),
    (0.762_766_204_958_164_5, 0.156_853_322_938_943_44),
    (0.898_333_238_706_813_4, 0.111_190_517_226_687_21),
    (0.980_144_928_248_768_1, 0.050_614_268_145_188_53),
];

/// One over the number of a term.
pub(super) const PARTS: Terms = {
    let mut parts = [0.0; TERMS];
    let mut k = 1;
    while k < TERMS {
        parts[k] = 1.0 / k as f64;
        k += 1;
    }
    parts
};

/// Nodes of Gauss's rule for slow motions.
pub(super) const FEW: usize = GAUSS_OF_SIX.len();

/// A rule of Gauss: powers of its nodes, its nodes, and its weights.
#[derive(Debug, Clone)]
pub(super) struct Rule {
    pub powers: [Lane; TERMS],
    pub points: Lane,
    pub weights: Lane,
}

/// Powers of the nodes of a fit, with the polynomials it is made of, and rules of eight nodes and of [`FEW`].
#[derive(Debug, Clone)]
pub(super) struct Tables {
    pub fit: [Lane; TERMS],
    pub basis: [Polynomial; COEFFICIENTS],
    pub rule: Rule,
    pub few: Rule,
}

impl Tables {
    /// Made once.
    pub(super) fn all() -> &'static Self {
        static TABLES: OnceLock<Tables> = OnceLock::new();
        TABLES.get_or_init(Self::new)
    }

    fn new() -> Self {
        let powers = |points: Lane| -> [Lane; TERMS] {
            std::array::from_fn(|k| points.map(|x| x.powi(k as i32)))
        };
        let rule = |nodes: &[(f64, f64)]| {
            let value = |node: usize| nodes.get(node).copied().unwrap_or_default();
            let points = Lane::from_fn(|node| value(node).0);
            Rule {
                powers: powers(points),
                points,
                weights: Lane::from_fn(|node| value(node).1),
            }
        };
        Self {
            fit: powers(Lane(fit_nodes())),
            basis: *fit_basis(),
            rule: rule(&GAUSS),
            few: rule(&GAUSS_OF_SIX),
        }
    }
}

/// A series at the points of a table.
#[inline(always)]
pub(super) fn sample(terms: &Terms, last: usize, powers: &[Lane; TERMS]) -> Lane {
    // Even and odd terms apart: two chains of additions, not one.
    let (mut even, mut odd) = (Lane::ZERO, Lane::ZERO);
    let pairs = terms[..=last].chunks_exact(2).zip(powers.chunks_exact(2));
    for (t, p) in pairs {
        for l in 0..WIDTH {
            even[l] += t[0] * p[0][l];
            odd[l] += t[1] * p[1][l];
        }
    }
    if last.is_multiple_of(2) {
        for l in 0..WIDTH {
            even[l] += terms[last] * powers[last][l];
        }
    }
    Lane::from_fn(|l| even[l] + odd[l])
}

/// Value and derivative of a series at `theta`: four chains side by side, of every fourth
/// term each. Terms after the last one, up to a number that four divides, are zero.
#[inline(always)]
pub(super) fn value_and_slope(terms: &Terms, last: usize, theta: f64) -> (f64, f64) {
    let square = theta * theta;
    let fourth = square * square;
    let (mut values, mut slopes) = ([0.0; 4], [0.0; 4]);
    let (fours, _) = terms[..TERMS].as_chunks::<4>();
    for four in fours[..last / 4 + 1].iter().rev() {
        for l in 0..4 {
            slopes[l] = slopes[l] * fourth + values[l];
            values[l] = values[l] * fourth + four[l];
        }
    }
    let [a, b, c, d] = values;
    let value = (a + b * theta) + square * (c + d * theta);
    let outer = (b + 2.0 * c * theta) + 3.0 * d * square;
    let [a, b, c, d] = slopes;
    let inner = (a + b * theta) + square * (c + d * theta);
    (value, outer + 4.0 * theta * square * inner)
}

/// Weights of terms in the bound of the second derivative.
const BENDS: Terms = {
    let mut weights = [0.0; TERMS];
    let mut k = 2;
    while k < TERMS {
        weights[k] = (k * (k - 1)) as f64;
        k += 1;
    }
    weights
};

/// Sum of the terms, and that of `k (k - 1) |term k|`. Terms after the last one are as in
/// [`value_and_slope`].
#[inline(always)]
pub(super) fn sum_and_bend(terms: &Terms, last: usize) -> (f64, f64) {
    let (mut sums, mut bends) = ([0.0; 4], [0.0; 4]);
    let (fours, _) = terms.as_chunks::<4>();
    let (weights, _) = BENDS.as_chunks::<4>();
    for (four, weight) in fours[..last / 4 + 1].iter().zip(weights).rev() {
        for l in 0..4 {
            sums[l] += four[l];
            bends[l] += weight[l] * four[l].abs();
        }
    }
    let total = |x: [f64; 4]| (x[0] + x[2]) + (x[1] + x[3]);
    (total(sums), total(bends))
}

/// Maximum magnitude of the terms from this one on.
#[inline(always)]
pub(super) fn maximum(terms: &[f64]) -> f64 {
    let mut most = [0.0; 4];
    let (fours, rest) = terms.as_chunks::<4>();
    for four in fours {
        for l in 0..4 {
            let x = four[l].abs();
            most[l] = if x > most[l] { x } else { most[l] };
        }
    }
    rest.iter()
        .chain(&most)
        .fold(0.0, |m: f64, x| m.max(x.abs()))
}

/// Value of a scalar series at the end, and the bound of the distance from the chord.
#[inline(always)]
pub(super) fn end_and_bend(terms: &Terms, last: usize) -> (f64, f64) {
    let (end, bend) = sum_and_bend(terms, last);
    (end, 0.125 * bend)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The square of `v = cos(x theta + phase)`, whose derivatives are the fastest for its rate.
    #[test]
    fn six_nodes_are_exact_for_slow_motions() {
        let x = super::super::series::SLOW;
        for place in 0..60 {
            let phase = 0.1 * f64::from(place);
            let integral = |rule: &Rule| -> f64 {
                let nodes = rule.points.0.iter().zip(&rule.weights.0);
                let square = |point: f64| {
                    let v = libm::cos(x * point + phase);
                    v * v
                };
                nodes.map(|(point, weight)| weight * square(*point)).sum()
            };
            let tables = Tables::all();
            let sine = |theta: f64| libm::sin(2.0 * (x * theta + phase));
            let exact = 0.5 + 0.25 * (sine(1.0) - sine(0.0)) / x;
            for rule in [&tables.few, &tables.rule] {
                let found = integral(rule);
                assert!((found - exact).abs() < 1e-15, "{phase}: {found} {exact}");
            }
        }
    }

    /// Against sums term by term, for every number of terms.
    #[test]
    fn sums_in_chains_are_sums() {
        for last in 0..TERMS {
            let mut terms = [0.0; TERMS];
            for (k, term) in terms[..=last].iter_mut().enumerate() {
                *term = libm::sin(1.7 * k as f64 + 0.3);
            }
            let theta = 0.83_f64;
            let (mut value, mut slope, mut sum, mut bend) = (0.0, 0.0, 0.0, 0.0);
            for (k, term) in terms.iter().enumerate() {
                let order = k as f64;
                value += term * theta.powi(k as i32);
                slope += order * term * theta.powi(k as i32 - 1);
                sum += term;
                bend += order * (order - 1.0) * term.abs();
            }
            let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-12 * (1.0 + b.abs()), "{a} {b}");
            let found = value_and_slope(&terms, last, theta);
            near(found.0, value);
            near(found.1, slope);
            let found = sum_and_bend(&terms, last);
            near(found.0, sum);
            near(found.1, bend);
            let most = terms.iter().fold(0.0_f64, |m, t| m.max(t.abs()));
            assert_eq!(maximum(&terms[..=last]), most);
        }
    }
}
