//! What a function does between points where it is known, by the remainder of interpolation.

/// Least and greatest value of a function over a step of length `h`, from values and slopes
/// at both ends and a bound of its fourth derivative: the control
/// points of its cubic, raised to degree four, of which Hermite's remainder `f'''' h^4/24
/// theta^2 (1 - theta)^2` is a part of the middle one alone.
pub(crate) fn hermite_range([x0, v0, x1, v1]: [f64; 4], fourth: f64, h: f64) -> (f64, f64) {
    let (a, b) = (x0 + h * v0 / 3.0, x1 - h * v1 / 3.0);
    let (middle, error) = (0.5 * (a + b), h.powi(4) / 144.0 * fourth);
    let (first, last) = (0.25 * x0 + 0.75 * a, 0.25 * x1 + 0.75 * b);
    let least = x0.min(x1).min(first).min(last).min(middle - error);
    let most = x0.max(x1).max(first).max(last).max(middle + error);
    // The minimum of numbers passes over what is none.
    if error.is_finite() {
        (least, most)
    } else {
        (f64::NAN, f64::NAN)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sine_stays_within_its_range_and_comes_near_to_it() {
        let (mut inside, mut widest) = (0, 0.0_f64);
        for k in 0..200 {
            let (phase, h) = (0.1 * f64::from(k), 0.02 + 0.004 * f64::from(k));
            let [a, b] = [phase, phase + h];
            let ends = [libm::sin(a), libm::cos(a), libm::sin(b), libm::cos(b)];
            let (least, most) = hermite_range(ends, 1.0, h);
            for part in 0..=50 {
                let x = libm::sin(phase + h * f64::from(part) / 50.0);
                assert!(x >= least && x <= most, "{phase} {h}: {x}");
                inside += 1;
            }
            widest = widest.max((most - least) / (1.0 + h));
        }
        assert!(inside > 10_000 && widest < 1.5, "{widest}");
        let (least, most) = hermite_range([0.0; 4], f64::NAN, 1.0);
        assert!(least.is_nan() && most.is_nan());
    }
}
