//! Certified first crossing of a power series of any degree, as `polynomial` has it for
//! degree 7: by the Bernstein hull of the series itself, halved until it decides.

/// Coefficients at most.
const MOST: usize = 48;

/// Intervals shorter than this part of a step are not halved again.
const SHORTEST: f64 = 1.0e-13;

type Hull = [f64; MOST];

/// First `theta` in `[0, 1]` at which a series that starts negative becomes positive.
pub(crate) fn first_rise_of_series(terms: &[f64]) -> Option<f64> {
    let mut hull = [0.0; MOST];
    bernstein(terms, &mut hull);
    search(&hull, terms.len(), (0.0, 1.0))
}

/// What a search for the first rise of a series came to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Rise {
    /// The series stays negative.
    Never,
    /// It changes its sign once between these, for the first time.
    Within(f64, f64),
    /// It touches zero, or comes so close that halving does not tell.
    Unclear,
}

/// First rise of a series that starts negative, isolated.
pub(crate) fn isolated_rise_of_series(terms: &[f64]) -> Rise {
    if terms.len() > MOST {
        return Rise::Unclear;
    }
    let mut hull = [0.0; MOST];
    bernstein(terms, &mut hull);
    isolate(&hull, terms.len(), (0.0, 1.0))
}

/// Intervals shorter than this part of a step are not halved to isolate a rise.
const SHORTEST_ISOLATED: f64 = 1.0e-4;

fn isolate(hull: &Hull, count: usize, (left, right): (f64, f64)) -> Rise {
    let inner = &hull[..count];
    if inner.iter().all(|c| *c < 0.0) {
        return Rise::Never;
    }
    let signs = inner.windows(2).filter(|c| (c[0] < 0.0) != (c[1] < 0.0));
    if inner[0] < 0.0 && inner[count - 1] > 0.0 && signs.count() == 1 {
        return Rise::Within(left, right);
    }
    // What is not a number ends here too.
    if right - left < SHORTEST_ISOLATED || !inner[0].is_finite() {
        return Rise::Unclear;
    }
    let middle = 0.5 * (left + right);
    let (first, second) = halved(hull, count);
    match isolate(&first, count, (left, middle)) {
        Rise::Never => isolate(&second, count, (middle, right)),
        found => found,
    }
}

/// Coefficients of both halves.
fn halved(hull: &Hull, count: usize) -> (Hull, Hull) {
    let (mut first, mut second) = ([0.0; MOST], *hull);
    for (level, out) in first.iter_mut().enumerate().take(count) {
        *out = second[0];
        for i in 0..count - 1 - level {
            second[i] = 0.5 * (second[i] + second[i + 1]);
        }
    }
    (first, second)
}

/// Binomial coefficients, by the lower number and then the upper one: exact, as whole numbers below
/// `2^53` are.
static CHOOSE: [Hull; MOST] = {
    let mut all = [[0.0; MOST]; MOST];
    let mut upper = 0;
    while upper < MOST {
        all[0][upper] = 1.0;
        let mut lower = 1;
        while lower <= upper {
            all[lower][upper] = all[lower - 1][upper - 1] + all[lower][upper - 1];
            lower += 1;
        }
        upper += 1;
    }
    all
};

/// Bernstein coefficients on the unit interval from those of the powers.
fn bernstein(terms: &[f64], hull: &mut Hull) {
    let count = terms.len();
    for (k, (choose, term)) in CHOOSE.iter().zip(terms).enumerate() {
        let scaled = term / choose[count - 1];
        for (out, choose) in hull[k..count].iter_mut().zip(&choose[k..count]) {
            *out += choose * scaled;
        }
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
    let (first, second) = halved(hull, count);
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

    #[test]
    fn a_rise_is_isolated_and_a_graze_is_not_decided() {
        // Rises at 0.28 and falls at 0.52.
        let Rise::Within(left, right) = isolated_rise_of_series(&graze(0.0144)) else {
            panic!("no rise");
        };
        assert!(
            left < 0.28 && right > 0.28 && right < 0.52,
            "{left} {right}"
        );
        assert_eq!(isolated_rise_of_series(&graze(1e-12)), Rise::Unclear);
        assert_eq!(isolated_rise_of_series(&graze(-0.01)), Rise::Never);
        assert_eq!(isolated_rise_of_series(&[0.0; MOST + 1]), Rise::Unclear);
        assert_eq!(isolated_rise_of_series(&[f64::NAN, 1.0]), Rise::Unclear);
    }
}
