//! Distribution functions that generators need.
//!
//! Formulas: NIST Digital Library of Mathematical Functions, 8.7, 8.9, 8.17; log-gamma
//! by Lanczos (1964), SIAM J. Numer. Anal. B 1, 86, with g = 7 and nine terms.

use std::f64::consts::PI;

const LANCZOS: [f64; 9] = [
    0.999_999_999_999_809_9,
    676.520_368_121_885_1,
    -1_259.139_216_722_402_8,
    771.323_428_777_653_1,
    -176.615_029_162_140_6,
    12.507_343_278_686_905,
    -0.138_571_095_265_720_12,
    9.984_369_578_019_572e-6,
    1.505_632_735_149_311_6e-7,
];
/// Replaces zero in continued fractions.
const TINY: f64 = 1.0e-300;

/// `ln Gamma(x)`, x > 0.
pub(crate) fn ln_gamma(x: f64) -> f64 {
    if x < 0.5 {
        return (PI / (PI * x).sin()).ln() - ln_gamma(1.0 - x);
    }
    let x = x - 1.0;
    let t = x + 7.5;
    let sum: f64 = LANCZOS
        .iter()
        .enumerate()
        .map(|(i, c)| if i == 0 { *c } else { c / (x + i as f64) })
        .sum();
    0.5 * (2.0 * PI).ln() + (x + 0.5) * t.ln() - t + sum.ln()
}

/// Distribution function of the gamma law of a shape and unit rate.
pub(crate) fn gamma_distribution(shape: f64, x: f64) -> f64 {
    if x <= 0.0 {
        return 0.0;
    }
    let factor = (shape * x.ln() - x - ln_gamma(shape)).exp();
    if x < shape + 1.0 {
        let (mut term, mut sum) = (1.0 / shape, 1.0 / shape);
        for k in 1..10_000 {
            term *= x / (shape + f64::from(k));
            sum += term;
            if term < sum * 1.0e-17 {
                break;
            }
        }
        return factor * sum;
    }
    let tail = continued_fraction(x + 1.0 - shape, |k| {
        let n = f64::from(k);
        (n * (shape - n), x + 2.0 * n + 1.0 - shape)
    });
    1.0 - factor / tail
}

/// Distribution function of the beta law on (0, 1).
pub(crate) fn beta_distribution(a: f64, b: f64, x: f64) -> f64 {
    if x <= 0.0 {
        return 0.0;
    }
    if x >= 1.0 {
        return 1.0;
    }
    if x > (a + 1.0) / (a + b + 2.0) {
        return 1.0 - beta_distribution(b, a, 1.0 - x);
    }
    let front = (ln_gamma(a + b) - ln_gamma(a) - ln_gamma(b) + a * x.ln() + b * (-x).ln_1p()).exp();
    let fraction = continued_fraction(1.0, |k| {
        let m = f64::from(k / 2);
        let numerator = if k % 2 == 0 {
            m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m))
        } else {
            -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0))
        };
        (numerator, 1.0)
    });
    front / (a * fraction)
}

/// `b0 + n1/(b1 + n2/(b2 + ...))` by Lentz's method; `terms(k)` is `(n_k, b_k)`, k >= 1.
fn continued_fraction(b0: f64, terms: impl Fn(u32) -> (f64, f64)) -> f64 {
    let mut value = if b0 == 0.0 { TINY } else { b0 };
    let (mut c, mut d) = (value, 0.0);
    for k in 1..10_000 {
        let (numerator, denominator) = terms(k);
        d = denominator + numerator * d;
        c = denominator + numerator / c;
        if d == 0.0 {
            d = TINY;
        }
        if c == 0.0 {
            c = TINY;
        }
        d = 1.0 / d;
        value *= c * d;
        if (c * d - 1.0).abs() < 1.0e-16 {
            break;
        }
    }
    value
}

/// Distribution function of the normal law.
pub(crate) fn normal_distribution(x: f64) -> f64 {
    let half = 0.5 * gamma_distribution(0.5, 0.5 * x * x);
    if x < 0.0 { 0.5 - half } else { 0.5 + half }
}

/// Where a distribution function between two ends reaches a probability, by bisection
/// down to rounding.
pub(crate) fn quantile(
    probability: f64,
    mut low: f64,
    mut high: f64,
    distribution: impl Fn(f64) -> f64,
) -> f64 {
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if distribution(middle) < probability {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

/// Where the gamma law of a shape and unit rate reaches a probability.
pub(crate) fn gamma_quantile(shape: f64, probability: f64) -> f64 {
    let mut high = shape + 10.0;
    while gamma_distribution(shape, high) < probability {
        high *= 2.0;
    }
    quantile(probability, 0.0, high, |x| gamma_distribution(shape, x))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(found: f64, exact: f64, tolerance: f64) {
        assert!(
            (found - exact).abs() <= tolerance * exact.abs(),
            "{found} for {exact}"
        );
    }

    /// Closed forms: factorials, Gamma(1/2), exponential and Erlang laws, polynomials.
    #[test]
    fn closed_forms() {
        near(ln_gamma(0.5), PI.sqrt().ln(), 1e-13);
        near(ln_gamma(11.0), 3_628_800.0_f64.ln(), 1e-14);
        for x in [0.1_f64, 1.0, 3.0, 12.0] {
            near(gamma_distribution(1.0, x), 1.0 - (-x).exp(), 1e-13);
            near(
                gamma_distribution(3.0, x),
                1.0 - (-x).exp() * (1.0 + x + x * x / 2.0),
                1e-11,
            );
        }
        for x in [0.05_f64, 0.3, 0.8] {
            near(beta_distribution(2.0, 1.0, x), x * x, 1e-13);
            near(
                beta_distribution(2.0, 3.0, x),
                6.0 * x * x - 8.0 * x.powi(3) + 3.0 * x.powi(4),
                1e-12,
            );
            near(
                beta_distribution(0.5, 0.5, x),
                2.0 / PI * x.sqrt().asin(),
                1e-12,
            );
        }
        // Abramowitz and Stegun, table 26.1.
        near(normal_distribution(1.0), 0.841_344_746_068_543, 1e-14);
        near(normal_distribution(-2.0), 0.022_750_131_948_179, 1e-12);
        near(gamma_quantile(1.0, 0.95), -(0.05_f64.ln()), 1e-13);
    }
}
