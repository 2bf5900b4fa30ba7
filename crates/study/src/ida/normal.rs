//! The normal distribution.

use std::f64::consts::{FRAC_1_SQRT_2, PI};

/// Distribution function of the standard normal law, to about fifteen digits also far in
/// its tails: by the series and the continued fraction of the complementary error function
/// (NIST Digital Library of Mathematical Functions, 7.6.2 and 7.9.2).
#[must_use]
pub fn normal_distribution(x: f64) -> f64 {
    0.5 * complementary_error_function(-x * FRAC_1_SQRT_2)
}

/// Density of the standard normal law.
pub(super) fn normal_density(x: f64) -> f64 {
    (-0.5 * x * x).exp() / (2.0 * PI).sqrt()
}

/// The number that a standard normal variable stays below with this probability; minus
/// and plus infinity at zero and one, NaN outside.
#[must_use]
pub fn normal_quantile(probability: f64) -> f64 {
    if !(0.0..=1.0).contains(&probability) {
        return f64::NAN;
    }
    if probability == 0.0 || probability == 1.0 {
        return if probability == 0.0 {
            f64::NEG_INFINITY
        } else {
            f64::INFINITY
        };
    }
    // The tail is the side where differences are not lost.
    if probability > 0.5 {
        return -normal_quantile(1.0 - probability);
    }
    // From a bracket: far enough for the least positive number.
    let (mut low, mut high) = (-39.0_f64, 0.0_f64);
    let mut x = -(-2.0 * (2.0 * probability).ln()).max(0.0).sqrt() / 1.3;
    for _ in 0..100 {
        let value = normal_distribution(x);
        if value < probability {
            low = low.max(x);
        } else {
            high = high.min(x);
        }
        // Newton on the logarithm, which is nearly straight in the tail.
        let step = (value / probability).ln() * value / normal_density(x);
        let newton = x - step;
        let next = if newton >= low && newton <= high {
            newton
        } else {
            0.5 * (low + high)
        };
        if (next - x).abs() <= 1.0e-16 * x.abs() || next == x {
            return next;
        }
        x = next;
    }
    x
}

/// `erfc(x)`.
fn complementary_error_function(x: f64) -> f64 {
    if x < 0.0 {
        return 2.0 - complementary_error_function(-x);
    }
    if x < 2.0 {
        // erf x = 2/sqrt(pi) exp(-x^2) sum 2^n x^(2n+1) / (1 3 5 ... (2n+1)): no cancellation.
        let (mut term, mut sum) = (x, x);
        for n in 1..200 {
            term *= 2.0 * x * x / f64::from(2 * n + 1);
            sum += term;
            if term < sum * 1.0e-17 {
                break;
            }
        }
        return 1.0 - 2.0 / PI.sqrt() * (-x * x).exp() * sum;
    }
    // exp(-x^2)/sqrt(pi) / (x + (1/2)/(x + 1/(x + (3/2)/(x + ...)))).
    let mut tail = x;
    for k in (1..=120).rev() {
        tail = x + 0.5 * f64::from(k) / tail;
    }
    (-x * x).exp() / (PI.sqrt() * tail)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values by SciPy 1.17, `scipy.special.ndtr`.
    const TABLE: [(f64, f64); 9] = [
        (-20.0, 2.7536241186061556e-89),
        (-8.0, 6.22096057427174e-16),
        (-3.0, 0.0013498980316300933),
        (-2.5, 0.006209665325776132),
        (-1.0, 0.15865525393145707),
        (0.0, 0.5),
        (0.3, 0.6179114221889526),
        (2.7, 0.9965330261969594),
        (5.0, 0.9999997133484281),
    ];

    #[test]
    fn the_distribution_is_that_of_an_independent_program() {
        for (x, expected) in TABLE {
            let relative = normal_distribution(x) / expected - 1.0;
            assert!(relative.abs() < 3e-14, "{x}: {relative:e}");
        }
    }

    #[test]
    fn the_quantile_inverts_the_distribution() {
        for (x, expected) in TABLE {
            if x < 4.0 {
                let back = normal_quantile(expected);
                assert!((back - x).abs() < 1e-13 * (1.0 + x.abs()), "{x}: {back}");
            }
        }
        // 97.5 %: 1.959963984540054 (any table of the normal law).
        assert!((normal_quantile(0.975) - 1.959_963_984_540_054).abs() < 1e-14);
        assert_eq!(normal_quantile(0.5), 0.0);
        assert!(normal_quantile(1.5).is_nan());
        assert_eq!(normal_quantile(1.0), f64::INFINITY);
    }
}
