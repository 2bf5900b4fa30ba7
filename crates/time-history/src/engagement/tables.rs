//! Powers of the points at which series are sampled.

use crate::free_flight::{Lane, WIDTH};
use crate::polynomial::fit_nodes;

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

/// Powers of the nodes of a fit, and of Gauss's rule with its weights.
#[derive(Debug, Clone)]
pub(super) struct Tables {
    pub fit: [Lane; TERMS],
    pub gauss: [Lane; TERMS],
    pub weights: Lane,
}

impl Tables {
    pub(super) fn new() -> Self {
        let (points, weights) = (
            Lane(GAUSS.map(|(node, _)| node)),
            Lane(GAUSS.map(|(_, weight)| weight)),
        );
        let powers = |points: Lane| -> [Lane; TERMS] {
            std::array::from_fn(|k| points.map(|x| x.powi(k as i32)))
        };
        Self {
            fit: powers(Lane(fit_nodes())),
            gauss: powers(points),
            weights,
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

/// Value and derivative of a series at `theta`.
#[inline(always)]
pub(super) fn value_and_slope(terms: &Terms, last: usize, theta: f64) -> (f64, f64) {
    let (mut value, mut slope) = (0.0, 0.0);
    for k in (0..=last).rev() {
        slope = slope * theta + value;
        value = value * theta + terms[k];
    }
    (value, slope)
}
