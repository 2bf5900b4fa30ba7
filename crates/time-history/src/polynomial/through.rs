//! Polynomials through values and derivatives.

use std::sync::LazyLock;

use super::{COEFFICIENTS, DEGREE, Polynomial};

/// The cubic through values and derivatives (with respect to time) at both ends
/// of a step.
pub(crate) fn hermite(step: f64, y0: f64, y1: f64, d0: f64, d1: f64) -> Polynomial {
    let (a, b) = (step * d0, step * d1);
    let change = y1 - y0;
    let mut p = [0.0; COEFFICIENTS];
    p[0] = y0;
    p[1] = a;
    p[2] = 3.0 * change - 2.0 * a - b;
    p[3] = a + b - 2.0 * change;
    p
}

/// The polynomial of degree 7 through values and three derivatives (with respect to
/// theta) at both ends of a step.
pub(crate) fn septic(start: [f64; 4], end: [f64; 4]) -> Polynomial {
    let [y, d, e, f] = [start[0], start[1], 0.5 * start[2], start[3] / 6.0];
    let r0 = end[0] - (y + d + e + f);
    let r1 = end[1] - (d + 2.0 * e + 3.0 * f);
    let r2 = end[2] - (2.0 * e + 6.0 * f);
    let r3 = end[3] - 6.0 * f;
    [
        y,
        d,
        e,
        f,
        35.0 * r0 - 15.0 * r1 + 2.5 * r2 - r3 / 6.0,
        -84.0 * r0 + 39.0 * r1 - 7.0 * r2 + 0.5 * r3,
        70.0 * r0 - 34.0 * r1 + 6.5 * r2 - 0.5 * r3,
        -20.0 * r0 + 10.0 * r1 - 2.0 * r2 + r3 / 6.0,
    ]
}

/// Nodes at which [`fit`] wants a function sampled: Chebyshev points with both
/// ends, on the unit interval.
pub(crate) fn fit_nodes() -> [f64; COEFFICIENTS] {
    static NODES: LazyLock<[f64; COEFFICIENTS]> = LazyLock::new(|| {
        std::array::from_fn(|i| {
            0.5 * (1.0 - libm::cos(std::f64::consts::PI * i as f64 / DEGREE as f64))
        })
    });
    *NODES
}

/// Values of a polynomial at [`fit_nodes`], node by node as [`value`](super::value) has them.
pub(crate) fn values_at_nodes(p: &Polynomial) -> [f64; COEFFICIENTS] {
    let nodes = fit_nodes();
    let mut sums = [0.0; COEFFICIENTS];
    for c in p.iter().rev() {
        for (sum, node) in sums.iter_mut().zip(&nodes) {
            *sum = *sum * node + c;
        }
    }
    sums
}

/// Coefficients of the polynomials that are one at one node of a fit and zero at the
/// others.
static FIT: LazyLock<[Polynomial; COEFFICIENTS]> = LazyLock::new(|| {
    std::array::from_fn(|node| {
        let mut samples = [0.0; COEFFICIENTS];
        samples[node] = 1.0;
        divided_differences(&samples)
    })
});

/// [`FIT`], for tables.
pub(crate) fn fit_basis() -> &'static [Polynomial; COEFFICIENTS] {
    &FIT
}

/// The polynomial through samples at [`fit_nodes`].
pub(crate) fn fit(samples: &[f64; COEFFICIENTS]) -> Polynomial {
    combine(samples, &FIT)
}

/// The polynomial through samples, from those of a [`fit_basis`].
#[inline(always)]
pub(crate) fn combine(
    samples: &[f64; COEFFICIENTS],
    basis: &[Polynomial; COEFFICIENTS],
) -> Polynomial {
    let mut p = [0.0; COEFFICIENTS];
    for (sample, basis) in samples.iter().zip(basis) {
        for (c, b) in p.iter_mut().zip(basis) {
            *c += sample * b;
        }
    }
    p
}

/// The same by divided differences.
fn divided_differences(samples: &[f64; COEFFICIENTS]) -> Polynomial {
    let x = fit_nodes();
    let mut divided = *samples;
    for order in 1..COEFFICIENTS {
        for i in (order..COEFFICIENTS).rev() {
            divided[i] = (divided[i] - divided[i - 1]) / (x[i] - x[i - order]);
        }
    }
    let mut p = [0.0; COEFFICIENTS];
    for i in (0..COEFFICIENTS).rev() {
        for k in (1..COEFFICIENTS).rev() {
            p[k] = p[k - 1] - x[i] * p[k];
        }
        p[0] = divided[i] - x[i] * p[0];
    }
    p
}
