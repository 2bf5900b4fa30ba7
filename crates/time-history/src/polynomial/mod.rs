//! Polynomials on the unit interval: certified signs, first crossings, extrema.
//!
//! Inside a step every displacement and velocity is a polynomial in
//! `theta = offset / step`. Its Bernstein coefficients bound it rigorously (the
//! curve lies in their convex hull), so a crossing inside the step cannot be
//! stepped over, however short: either the coefficients exclude it, or the
//! interval is halved until they decide. Source: G. Farin, Curves and Surfaces
//! for CAGD, 5th edition, 2002, chapters 4 and 5 (hull property, de Casteljau).

mod remainder;
mod sampled;
mod through;

pub(crate) use remainder::hermite_range;
pub(crate) use sampled::first_rise_of;
pub(crate) use through::{combine, fit, fit_basis, fit_nodes, hermite, septic, values_at_nodes};

/// Number of power-basis coefficients (degree 7).
pub(crate) const COEFFICIENTS: usize = 8;

/// Power-basis coefficients, lowest first.
pub(crate) type Polynomial = [f64; COEFFICIENTS];

const DEGREE: usize = COEFFICIENTS - 1;

/// Intervals shorter than this part of a step are not halved again.
const SHORTEST: f64 = 1.0e-13;

/// Relative size below which a leading coefficient is round-off.
const ROUND_OFF: f64 = 1.0e-13;

/// Precision (of theta) of a crossing that nothing corrects afterwards.
pub(crate) const EXACT: f64 = 1.0e-15;

/// Nodes and weights of the Gauss rule with six points on (0, 1), exact to degree 11.
pub(crate) const GAUSS: [(f64, f64); 6] = [
    (0.033_765_242_898_423_99, 0.085_662_246_189_585_17),
    (0.169_395_306_766_867_74, 0.180_380_786_524_069_3),
    (0.380_690_406_958_401_56, 0.233_956_967_286_345_52),
    (0.619_309_593_041_598_5, 0.233_956_967_286_345_52),
    (0.830_604_693_233_132_3, 0.180_380_786_524_069_3),
    (0.966_234_757_101_576, 0.085_662_246_189_585_17),
];

/// Value at `theta`.
pub(crate) fn value(p: &Polynomial, theta: f64) -> f64 {
    p.iter().rev().fold(0.0, |sum, c| sum * theta + c)
}

/// Derivative with respect to theta.
pub(crate) fn derivative(p: &Polynomial) -> Polynomial {
    let mut d = [0.0; COEFFICIENTS];
    for k in 1..COEFFICIENTS {
        d[k - 1] = k as f64 * p[k];
    }
    d
}

/// `a - b`, coefficient by coefficient.
pub(crate) fn difference(a: &Polynomial, b: &Polynomial) -> Polynomial {
    std::array::from_fn(|k| a[k] - b[k])
}

/// Coefficients with their signs changed. A loop, where closures over an array are calls.
pub(crate) fn negated<const COUNT: usize>(mut p: [f64; COUNT]) -> [f64; COUNT] {
    for c in &mut p {
        *c = -*c;
    }
    p
}

/// Cheap bound of the absolute value on the unit interval.
pub(crate) fn bound(p: &Polynomial) -> f64 {
    p.iter().map(|c| c.abs()).sum()
}

/// Bound of the distance from the chord: an eighth of that of the second derivative.
pub(crate) fn sagitta(p: &Polynomial) -> f64 {
    const EIGHTHS: Polynomial = [0.0, 0.0, 0.25, 0.75, 1.5, 2.5, 3.75, 5.25];
    let terms = p.iter().zip(&EIGHTHS);
    terms.map(|(c, k)| c.abs() * k).sum()
}

/// Bernstein coefficients on the unit interval.
fn bernstein(p: &Polynomial) -> Polynomial {
    // b_i = sum_k C(i,k) / C(n,k) a_k, built by binomial sums of scaled terms.
    let mut b = [0.0; COEFFICIENTS];
    let mut scaled = [0.0; COEFFICIENTS];
    let mut choose_n = 1.0;
    for k in 0..COEFFICIENTS {
        scaled[k] = p[k] / choose_n;
        choose_n = choose_n * (DEGREE - k) as f64 / (k + 1) as f64;
    }
    for (i, out) in b.iter_mut().enumerate() {
        let mut choose = 1.0;
        let mut sum = 0.0;
        for (k, s) in scaled.iter().enumerate().take(i + 1) {
            sum += choose * s;
            choose = choose * (i - k) as f64 / (k + 1) as f64;
        }
        *out = sum;
    }
    b
}

/// De Casteljau at the middle: coefficients of the left and right halves.
fn halves(b: &Polynomial) -> (Polynomial, Polynomial) {
    let mut left = [0.0; COEFFICIENTS];
    let mut right = *b;
    for (level, out) in left.iter_mut().enumerate() {
        *out = right[0];
        for i in 0..DEGREE - level {
            right[i] = 0.5 * (right[i] + right[i + 1]);
        }
    }
    (left, right)
}

/// First `theta` in `[0, 1]` at which a function that is *known* to start on the
/// negative side becomes positive; `None` if it does not.
///
/// Where the constant coefficient is zero, round-off, or on the wrong side (the
/// step starts at an event of this very function), it is taken as an exact root
/// at `theta = 0` and divided out: the same root is not found again, while a
/// function that truly leaves through it is reported at once.
pub(crate) fn first_rise(p: &Polynomial) -> Option<f64> {
    first_rise_near(p, EXACT)
}

/// The same to this precision only, for what is corrected by the function itself.
pub(crate) fn first_rise_near(p: &Polynomial, precision: f64) -> Option<f64> {
    let mut q = *p;
    for level in 0..COEFFICIENTS {
        let largest = largest(&q);
        if largest == 0.0 {
            return None;
        }
        if q[0] < -ROUND_OFF * largest {
            let end: f64 = q.iter().sum();
            if q[0].max(end) + sagitta(&q) < 0.0 {
                return None;
            }
            let bracket = search_rise(&bernstein(&q), 0.0, 1.0);
            return bracket.map(|bracket| polish(&q, bracket, precision));
        }
        // The deflated function decides; only its first clear sign counts.
        if q[0] > ROUND_OFF * largest && level > 0 {
            return Some(0.0);
        }
        q.copy_within(1.., 0);
        q[DEGREE] = 0.0;
    }
    None
}

/// Maximum magnitude of the coefficients: four at once, which do not wait for each other.
fn largest(p: &Polynomial) -> f64 {
    let larger = |a: f64, b: f64| if a > b { a } else { b };
    let mut most = [0.0; 4];
    for four in p.as_chunks::<4>().0 {
        for l in 0..4 {
            most[l] = larger(four[l].abs(), most[l]);
        }
    }
    larger(larger(most[0], most[1]), larger(most[2], most[3]))
}

/// First sub-interval in which the Bernstein form changes from negative to
/// positive, given that it is negative at its left end.
fn search_rise(b: &Polynomial, left: f64, right: f64) -> Option<(f64, f64)> {
    if b.iter().all(|c| *c <= 0.0) {
        return None;
    }
    if right - left < SHORTEST || sign_changes(b) == 1 {
        return (b[DEGREE] > 0.0).then_some((left, right));
    }
    let middle = 0.5 * (left + right);
    let (first, second) = halves(b);
    if first[0] <= 0.0
        && let Some(found) = search_rise(&first, left, middle)
    {
        return Some(found);
    }
    search_rise(&second, middle, right)
}

fn sign_changes(b: &Polynomial) -> usize {
    let mut changes = 0;
    let mut last = 0.0_f64;
    for c in b {
        if *c != 0.0 {
            if last * *c < 0.0 {
                changes += 1;
            }
            last = *c;
        }
    }
    changes
}

/// Root in a bracket (negative left, positive right) by Newton kept inside it, to this precision or until
/// the value is the round-off of its own sum: steps beyond that go back and forth by chance.
fn polish(q: &Polynomial, bracket: (f64, f64), precision: f64) -> f64 {
    let (mut low, mut high) = bracket;
    let d = derivative(q);
    let sizes = q.map(f64::abs);
    let guess = if bracket == (0.0, 1.0) {
        // Where the chord has its root.
        q[0] / (q[0] - q.iter().sum::<f64>())
    } else {
        low - value(q, low) / value(&d, low)
    };
    let mut x = if guess > low && guess < high {
        guess
    } else {
        0.5 * (low + high)
    };
    for _ in 0..80 {
        let f = value(q, x);
        if f.abs() <= 0.5 * f64::EPSILON * value(&sizes, x) {
            return x;
        }
        if f > 0.0 {
            high = x;
        } else {
            low = x;
        }
        let newton = x - f / value(&d, x);
        let next = if newton > low && newton < high {
            newton
        } else {
            0.5 * (low + high)
        };
        if (next - x).abs() <= precision || high - low <= precision {
            return next;
        }
        x = next;
    }
    x
}

/// Largest value on the unit interval and where, if it exceeds `floor`.
pub(crate) fn maximum_above(p: &Polynomial, floor: f64) -> Option<(f64, f64)> {
    let (start, end) = (p[0], p.iter().sum::<f64>());
    let sagitta = sagitta(p);
    if start.max(end) + sagitta <= floor {
        return None;
    }
    if (end - start).abs() > 4.0 * sagitta {
        // No turning point: the greater end is the maximum value.
        let (theta, top) = if end > start {
            (1.0, end)
        } else {
            (0.0, start)
        };
        return (top > floor).then_some((theta, top));
    }
    let falling = negated(derivative(p));
    let mut search = Search {
        function: p,
        falling: &falling,
        level: floor,
        best: None,
    };
    search.look(&bernstein(p), (0.0, 1.0), 0);
    search.best.map(|theta| (theta, value(p, theta)))
}

/// Largest absolute value over the step, if it exceeds `floor`.
pub(crate) fn absolute_maximum(p: &Polynomial, floor: f64) -> Option<(f64, f64)> {
    let ends = p[0].abs().max(p.iter().sum::<f64>().abs());
    if ends + sagitta(p) <= floor {
        return None;
    }
    let up = maximum_above(p, floor);
    let level = up.map_or(floor, |(_, top)| top);
    maximum_above(&negated(*p), level).or(up)
}

/// Branch and bound on the Bernstein hull; `level` is the best value so far.
struct Search<'a> {
    function: &'a Polynomial,
    /// The derivative with its sign changed.
    falling: &'a Polynomial,
    level: f64,
    best: Option<f64>,
}

impl Search<'_> {
    fn look(&mut self, b: &Polynomial, (left, right): (f64, f64), depth: usize) {
        let upper = b.iter().fold(f64::NEG_INFINITY, |m, c| m.max(*c));
        if upper <= self.level {
            return;
        }
        self.take(b[0], left);
        self.take(b[DEGREE], right);
        if depth >= 40 || upper - self.level <= 1.0e-15 * upper.abs() {
            return;
        }
        // Differences of the coefficients bound the slope.
        let mut slopes = [0.0; COEFFICIENTS];
        for i in 0..DEGREE {
            slopes[i] = b[i] - b[i + 1];
        }
        let rising = slopes[..DEGREE].iter().find(|d| **d != 0.0);
        match (sign_changes(&slopes), rising) {
            (0, _) => {}
            (1, Some(first)) if *first < 0.0 => {
                // At a maximum the value errs by the square of this.
                let theta = polish(self.falling, (left, right), 1.0e-9);
                self.take(value(self.function, theta), theta);
            }
            // It falls and rises: an end is the maximum.
            (1, _) => {}
            _ => {
                let middle = 0.5 * (left + right);
                let (first, second) = halves(b);
                self.look(&first, (left, middle), depth + 1);
                self.look(&second, (middle, right), depth + 1);
            }
        }
    }

    fn take(&mut self, value: f64, theta: f64) {
        if value > self.level {
            (self.level, self.best) = (value, Some(theta));
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    fn from_roots(roots: &[f64], factor: f64) -> Polynomial {
        let mut p = [0.0; COEFFICIENTS];
        p[0] = factor;
        for r in roots {
            for k in (1..COEFFICIENTS).rev() {
                p[k] = p[k - 1] - r * p[k];
            }
            p[0] *= -r;
        }
        p
    }

    #[test]
    fn a_touch_shorter_than_any_sampling_is_found() {
        // Positive only between 0.5 and 0.5 + 1e-7, negative at both ends.
        let p = from_roots(&[0.5, 0.500_000_1], -1.0);
        let theta = first_rise(&p).expect("crossing");
        assert!((theta - 0.5).abs() < 1e-9, "{theta}");
    }

    /// The root is as near as the round-off of the polynomial's sum allows, also close to the start and
    /// between others.
    #[test]
    fn a_crossing_is_placed_to_its_round_off() {
        for root in [1.0e-9, 1.0e-5, 0.013, 0.25, 0.7, 0.999_999] {
            for others in [
                &[][..],
                &[1.5, 2.0],
                &[-1.0e-3, 1.0 + 1.0e-3],
                &[3.0, -2.0, 1.2, -0.4],
            ] {
                let roots: Vec<f64> = others.iter().copied().chain([root]).collect();
                let mut p = from_roots(&roots, 1.0);
                if p[0] > 0.0 {
                    p = p.map(|c| -c);
                }
                let slope = value(&derivative(&p), root).abs();
                // Sums and the coefficients themselves are rounded, each a few times.
                let noise = 16.0 * f64::EPSILON * value(&p.map(f64::abs), root) / slope;
                let theta = first_rise(&p).unwrap();
                assert!(
                    (theta - root).abs() <= noise + EXACT,
                    "{roots:?}: {theta:e}"
                );
            }
        }
    }

    #[test]
    fn a_near_miss_is_no_touch() {
        let mut p = from_roots(&[0.5, 0.5], -1.0);
        p[0] -= 1e-12;
        assert_eq!(first_rise(&p), None);
    }

    #[test]
    fn the_root_just_fired_is_not_found_again() {
        // Just separated at theta = 0 and closing again at 0.7.
        let p = from_roots(&[0.0, 0.7], 1.0);
        let theta = first_rise(&p).expect("second crossing");
        assert!((theta - 0.7).abs() < 1e-14);
        // On the wrong side by round-off.
        let mut q = p;
        q[0] = 1e-18;
        assert!((first_rise(&q).expect("second crossing") - 0.7).abs() < 1e-12);
    }

    #[test]
    fn leaving_through_the_start_is_reported_at_once() {
        let p = from_roots(&[0.0], 1.0);
        assert_eq!(first_rise(&p), Some(0.0));
        // At rest at the root, then accelerating through it.
        let p = from_roots(&[0.0, 0.0], 1.0);
        assert_eq!(first_rise(&p), Some(0.0));
    }

    #[test]
    fn interior_maximum() {
        let p = from_roots(&[0.0, 0.6], -1.0);
        let (theta, top) = maximum_above(&p, 0.0).expect("maximum");
        assert!((theta - 0.3).abs() < 1e-7 && (top - 0.09).abs() < 1e-15);
        assert!(maximum_above(&p, 0.1).is_none());
    }

    #[test]
    fn fit_reproduces_a_polynomial() {
        let p = [0.3, -1.0, 2.0, 0.5, -0.7, 0.2, 1.1, -0.4];
        let fitted = fit(&fit_nodes().map(|x| value(&p, x)));
        for (a, b) in p.iter().zip(fitted) {
            assert!((a - b).abs() < 1e-11, "{a} {b}");
        }
    }
}
