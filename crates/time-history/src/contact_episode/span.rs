//! What happens inside a step of the pair: polynomials through both ends.

use super::clock::Clock;
use super::point::Point;
use crate::polynomial::{COEFFICIENTS, Polynomial, septic};
use crate::system::modes::ModalRow;

/// An accurate step, open to interpolation; theta runs over its variable `s`.
#[derive(Clone, Copy)]
pub(crate) struct Span<'a> {
    pub start: &'a Point,
    pub end: &'a Point,
    pub clock: &'a Clock,
    /// Three derivatives of time with respect to theta at both ends.
    pub rates: [[f64; 3]; 2],
}

impl<'a> Span<'a> {
    pub(crate) fn new([start, end]: [&'a Point; 2], clock: &'a Clock) -> Self {
        Self {
            start,
            end,
            clock,
            // Every function of the step asks for them.
            rates: [clock.derivatives(false), clock.derivatives(true)],
        }
    }

    /// A function with three derivatives with respect to time at both ends.
    pub(crate) fn displacement(&self, start: [f64; 4], end: [f64; 4]) -> Polynomial {
        let by_theta = |[f, v, a, j]: [f64; 4], [r, r2, r3]: [f64; 3]| {
            [
                f,
                v * r,
                a * r * r + v * r2,
                j * r * r * r + 3.0 * a * r * r2 + v * r3,
            ]
        };
        let [first, last] = self.rates;
        septic(by_theta(start, first), by_theta(end, last))
    }

    /// Its rate of change in time.
    pub(crate) fn velocity(&self, start: [f64; 4], end: [f64; 4]) -> Polynomial {
        let by_theta =
            |[_, v, a, j]: [f64; 4], [r, r2, _]: [f64; 3]| [v, a * r, j * r * r + a * r2];
        let [first, last] = self.rates;
        quintic(by_theta(start, first), by_theta(end, last))
    }

    /// A row of the motion at both ends, less `width`.
    pub(crate) fn row(&self, row: &ModalRow, width: f64) -> ([f64; 4], [f64; 4]) {
        let [mut start, mut end] = [self.start, self.end].map(|p| row.dot_motion(&p.motion));
        start[0] -= width;
        end[0] -= width;
        (start, end)
    }

    /// A closed level at both ends.
    pub(crate) fn touch(&self, k: usize) -> ([f64; 4], [f64; 4]) {
        (self.start.touches[k].motion, self.end.touches[k].motion)
    }
}

/// The polynomial of degree 5 through values and two derivatives at both ends.
fn quintic(start: [f64; 3], end: [f64; 3]) -> Polynomial {
    let [y, d, e] = [start[0], start[1], 0.5 * start[2]];
    let r0 = end[0] - (y + d + e);
    let r1 = end[1] - (d + 2.0 * e);
    let r2 = end[2] - 2.0 * e;
    let mut p = [0.0; COEFFICIENTS];
    p[..6].copy_from_slice(&[
        y,
        d,
        e,
        10.0 * r0 - 4.0 * r1 + 0.5 * r2,
        -15.0 * r0 + 7.0 * r1 - r2,
        6.0 * r0 - 3.0 * r1 + 0.5 * r2,
    ]);
    p
}
