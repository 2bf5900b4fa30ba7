//! First crossings of functions that are known by their values alone.

use super::through::{fit, fit_nodes};
use super::{COEFFICIENTS, bernstein, first_rise_near, value};

/// Part of the largest value by which the polynomial through the nodes may miss the function between
/// them.
const FAITHFUL: f64 = 1.0e-6;
/// An interval is halved so often at most: to a thousandth of the step, at which a kink is what
/// the steps that locate the event see too.
const HALVINGS: usize = 10;
/// Intervals that are halved at most, as values that are round-off alone follow no polynomial.
const HALVED: usize = 32;

/// First `theta` in `[0, 1]` at which a function becomes positive that is known to start on the
/// negative side, or on the root, as [`first_rise_near`] has it of polynomials. Where no polynomial
/// through its values follows it, as where a law has a kink, the interval is halved.
pub(crate) fn first_rise_of(function: impl Fn(f64) -> f64, precision: f64) -> Option<f64> {
    let mut left = HALVED;
    look(&function, (0.0, 1.0), precision, HALVINGS, &mut left)
}

fn look(
    function: &impl Fn(f64) -> f64,
    (from, to): (f64, f64),
    precision: f64,
    halvings: usize,
    left: &mut usize,
) -> Option<f64> {
    let at = |x: f64| function(from + x * (to - from));
    let nodes = fit_nodes();
    let samples: [f64; COEFFICIENTS] = nodes.map(at);
    let fitted = fit(&samples);
    let mut highest = samples.into_iter().fold(f64::MIN, f64::max);
    let mut size = samples.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    let mut error = 0.0_f64;
    for pair in nodes.windows(2) {
        let between = 0.5 * (pair[0] + pair[1]);
        let known = at(between);
        highest = highest.max(known);
        size = size.max(known.abs());
        error = error.max((value(&fitted, between) - known).abs());
    }
    let bound = bernstein(&fitted).into_iter().fold(f64::MIN, f64::max);
    if bound + 2.0 * error < 0.0 {
        return None;
    }
    // What is no number has no crossing that halving would find.
    let faithful = error <= FAITHFUL * size || !error.is_finite();
    let shortest = halvings == 0 || *left == 0;
    if faithful || (shortest && highest > 0.0) {
        let theta = first_rise_near(&fitted, precision)?;
        return Some(from + theta * (to - from));
    }
    if shortest {
        // The polynomial swings beyond a function that is negative wherever it is known.
        return None;
    }
    *left -= 1;
    let middle = 0.5 * (from + to);
    look(function, (from, middle), precision, halvings - 1, left)
        .or_else(|| look(function, (middle, to), precision, halvings - 1, left))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    /// Positive for a hundredth of the step, at a kink between two points: the polynomial through all
    /// points of the step stays negative.
    #[test]
    fn a_rise_to_a_kink_is_found() {
        let tent = |x: f64| 0.005 - (x - 0.313).abs();
        assert_eq!(first_rise_near(&fit(&fit_nodes().map(tent)), 1e-15), None);
        let theta = first_rise_of(tent, 1e-15).unwrap();
        assert!((theta - 0.308).abs() < 1e-3, "{theta}");
        assert_eq!(first_rise_of(|x| tent(x) - 0.006, 1e-15), None);
    }

    #[test]
    fn smooth_functions_rise_where_their_polynomials_do() {
        let theta = first_rise_of(|x| (x - 0.25) * (x - 0.75) * (x - 2.0), 1e-15).unwrap();
        assert!((theta - 0.25).abs() < 1e-12, "{theta}");
        assert_eq!(first_rise_of(|x| x * (x - 2.0), 1e-15), None);
        assert_eq!(first_rise_of(|x| x, 1e-15), Some(0.0));
        assert_eq!(first_rise_of(|_| f64::NAN, 1e-15), None);
    }
}
