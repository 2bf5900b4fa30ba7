//! Closings of the contact levels over whole intervals without contact, side by side.

use multiversion::multiversion;

use super::functions::Row;
use crate::propagation::{Ends, NARROW, padded};

/// Values and rates of the closings at the start of an interval and at its end, bounds of their
/// fourth derivatives, and what they stay below while the gaps are open; all filled up to whole
/// blocks.
#[derive(Debug)]
pub(super) struct Closings {
    start: [Vec<f64>; 2],
    end: [Vec<f64>; 2],
    fourth: Vec<f64>,
    widths: Vec<f64>,
}

impl Closings {
    pub(super) fn new(levels: usize) -> Self {
        let zeros = || vec![0.0; padded(levels)];
        Self {
            start: [zeros(), zeros()],
            end: [zeros(), zeros()],
            fourth: zeros(),
            widths: vec![f64::INFINITY; padded(levels)],
        }
    }

    /// Begins anew where an interval does that starts with these displacements and velocities.
    pub(super) fn begin(
        &mut self,
        levels: &[Row],
        start: [&[f64]; 2],
        width: impl Fn(usize) -> f64,
    ) {
        let [x, v] = &mut self.end;
        for (l, row) in levels.iter().enumerate() {
            [x[l], v[l]] = row.at(start);
            self.widths[l] = width(l);
        }
    }

    /// Advances over an interval; false if that is no proof that no gap closes in it.
    pub(super) fn advance(&mut self, levels: &[Row], ends: &Ends) -> bool {
        std::mem::swap(&mut self.start, &mut self.end);
        let [u, rates, ..] = &ends.end;
        let [x, v] = &mut self.end;
        let places = x.iter_mut().zip(v).zip(&mut self.fourth);
        for (row, ((x, v), fourth)) in levels.iter().zip(places) {
            [*x, *v] = row.at([u, rates]);
            *fourth = row.bound(ends, 4);
        }
        let values = [&self.start, &self.end].map(|of| of.each_ref().map(Vec::as_slice));
        let limits = (self.fourth.as_slice(), self.widths.as_slice());
        stay_below(values, limits, ends.length)
    }
}

/// Whether functions stay below limits, by values and slopes at both ends and bounds of their
/// fourth derivatives, as [`crate::polynomial::hermite_range`] has it for one.
#[multiversion(targets(
    "x86_64+avx512f+avx512vl+avx512dq",
    "x86_64+avx2",
    "x86_64+avx",
    "aarch64+neon"
))]
fn stay_below(
    [[x0, v0], [x1, v1]]: [[&[f64]; 2]; 2],
    (fourth, limits): (&[f64], &[f64]),
    h: f64,
) -> bool {
    let (third, remainder) = (h / 3.0, h * h * h * h / 144.0);
    let limits = limits.as_chunks::<NARROW>().0;
    let n = limits.len();
    let [x0, v0, x1, v1, fourth] =
        [x0, v0, x1, v1, fourth].map(|of| &of.as_chunks::<NARROW>().0[..n]);
    let mut above = [0.0; NARROW];
    for k in 0..n {
        for i in 0..NARROW {
            let (x0, x1) = (x0[k][i], x1[k][i]);
            let (a, b) = (x0 + third * v0[k][i], x1 - third * v1[k][i]);
            let (early, late) = (0.25 * x0 + 0.75 * a, 0.25 * x1 + 0.75 * b);
            let middle = 0.5 * (a + b) + remainder * fourth[k][i];
            // What is not a number is no proof.
            let over = |x: f64| if x < limits[k][i] { 0.0 } else { 1.0 };
            above[i] += over(x0) + over(x1) + (over(early) + over(late)) + over(middle);
        }
    }
    above == [0.0; NARROW]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_touch_between_the_ends_is_no_proof() {
        // theta (1 - theta) over an interval of one second, which reaches a quarter.
        let block = |x: f64| [x, 0.0, 0.0, 0.0];
        let (x, v0, v1) = (block(0.0), block(1.0), block(-1.0));
        let stays = |fourth: f64, limit: f64| {
            let limits = [limit, 1.0, 1.0, 1.0];
            stay_below([[&x, &v0], [&x, &v1]], (&block(fourth), &limits), 1.0)
        };
        assert!(stays(0.0, 0.34) && !stays(0.0, 0.24));
        assert!(!stays(144.0 * 0.01, 0.34) && stays(144.0 * 0.005, 0.34));
        assert!(!stays(f64::NAN, 0.34) && !stays(0.0, f64::NAN));
    }
}
