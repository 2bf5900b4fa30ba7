//! Certified first crossing of a power series of any degree, as `polynomial` has it for
//! degree 7: by the Bernstein hull of the series itself, halved until it decides.

/// Coefficients at most.
const MOST: usize = 32;

/// Intervals shorter than this part of a step are not halved again.
const SHORTEST: f64 = 1.0e-13;

type Hull = [f64; MOST];

/// First `theta` in `[0, 1]` at which a series that starts negative becomes positive.
pub(crate) fn first_rise_of_series(terms: &[f64]) -> Option<f64> {
    let mut hull = [0.0; MOST];
    bernstein(terms, &mut hull);
    search(&hull, terms.len(), (0.0, 1.0))
}

/// Bernstein coefficients on the unit interval from those of the powers.
fn bernstein(terms: &[f64], hull: &mut Hull) {
    let degree = terms.len() - 1;
    let mut scaled = [0.0; MOST];
    let mut choose = 1.0;
    for (k, c) in terms.iter().enumerate() {
        scaled[k] = c / choose;
        choose = choose * (degree - k) as f64 / (k + 1) as f64;
    }
    for (i, out) in hull.iter_mut().enumerate().take(terms.len()) {
        let (mut choose, mut sum) = (1.0, 0.0);
        for (k, s) in scaled.iter().enumerate().take(i + 1) {
            sum += choose * s;
            choose = choose * (i - k) as f64 / (k + 1) as f64;
        }
        *out = sum;
    }
}

fn search(hull: &Hull, count: usize, (left, right): (f64, f64)) -> Option<f64> {
    let inner = &hull[..count];
    if inner.iter().all(|c| *c <= 0.0) {
        return None;
    }
    let middle = 0.5 * (left + right);
    if right - left < SHORTEST {
        return (inner[count - 1] > 0.0).then_some(middle);
    }
    let (mut first, mut second) = ([0.0; MOST], *hull);
    for (level, out) in first.iter_mut().enumerate().take(count) {
        *out = second[0];
        for i in 0..count - 1 - level {
            second[i] = 0.5 * (second[i] + second[i + 1]);
        }
    }
    if first[0] <= 0.0
        && let Some(found) = search(&first, count, (left, middle))
    {
        return Some(found);
    }
    search(&second, count, (middle, right))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `-(theta - 0.4)^2 + height`, times a factor that has no root there.
    fn graze(height: f64) -> Vec<f64> {
        let square = [height - 0.16, 0.8, -1.0];
        let factor = [
            1.0, 0.5, 0.25, 0.125, 0.0625, 0.03125, 0.015625, 0.0078125, 0.004, 0.002,
        ];
        let mut product = vec![0.0; square.len() + factor.len() - 1];
        for (i, a) in square.iter().enumerate() {
            for (j, b) in factor.iter().enumerate() {
                product[i + j] += a * b;
            }
        }
        product
    }

    #[test]
    fn a_graze_is_told_from_a_near_miss() {
        let touch = first_rise_of_series(&graze(1e-12));
        assert!(touch.is_some_and(|theta| (theta - (0.4 - 1e-6)).abs() < 1e-9));
        assert_eq!(first_rise_of_series(&graze(-1e-12)), None);
    }
}
