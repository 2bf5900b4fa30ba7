//! Normal, gamma and beta distributions, for generators and for the statistics of many
//! motions.
//!
//! They come from `statrs`, as far as it has the digits (0.19.1, against 50-digit arithmetic):
//! its normal quantile is right to 2e-16, its gamma distribution to 2e-13 (shapes up to 100),
//! its beta distribution to 1e-14 (2e-12 with parameters of 400). Its normal distribution
//! function is wrong by up to 9e-11 of its value, since its error function adds constants that
//! are rounded to ten digits: here `erfc` of `libm` stands in its place. Its quantiles of gamma
//! and beta distributions stop within 5e-10: here they are found by bisection on its
//! distribution functions.

use std::f64::consts::FRAC_1_SQRT_2;

use statrs::distribution::{Continuous, ContinuousCDF, Normal};
use statrs::function::beta::beta_reg;
use statrs::function::gamma::gamma_lr;
use statrs::function::gamma::gamma_ur;
pub(crate) use statrs::function::gamma::ln_gamma;

/// Distribution function of the standard normal distribution, relative error 2e-16 near
/// its middle, 1e-13 in its farthest tails.
#[must_use]
pub fn normal_distribution(x: f64) -> f64 {
    0.5 * libm::erfc(-x * FRAC_1_SQRT_2)
}

/// Probability that a standard normal variable exceeds this number, over the density there
/// (Mills' ratio): relative error 2e-15 for numbers above zero, however far in the tail, where
/// both underflow. Infinite from -39 down.
#[must_use]
pub fn mills_ratio(x: f64) -> f64 {
    if x < 2.5 {
        let density_of_zero = 0.5 * std::f64::consts::FRAC_2_SQRT_PI * FRAC_1_SQRT_2;
        return normal_distribution(-x) * libm::exp(0.5 * x * x) / density_of_zero;
    }
    // Laplace's continued fraction, which has all digits after that many terms.
    let terms = 10 + (500.0 / (x * x)) as u32;
    let rest = (1..=terms)
        .rev()
        .fold(x, |below, n| x + f64::from(n) / below);
    1.0 / rest
}

/// Density of the standard normal distribution.
#[must_use]
pub fn normal_density(x: f64) -> f64 {
    Normal::standard().pdf(x)
}

/// The number that a standard normal variable stays below with this probability; minus and
/// plus infinity at zero and one, NaN outside.
#[must_use]
pub fn normal_quantile(probability: f64) -> f64 {
    if (0.0..=1.0).contains(&probability) {
        Normal::standard().inverse_cdf(probability)
    } else {
        f64::NAN
    }
}

/// Probability that a chi-square variable of so many degrees of freedom, at least one, exceeds
/// this number; one for zero and below.
#[must_use]
pub fn chi_square_exceedance(x: f64, degrees_of_freedom: usize) -> f64 {
    if x > 0.0 {
        gamma_ur(0.5 * degrees_of_freedom as f64, 0.5 * x)
    } else {
        1.0
    }
}

/// The number that a beta variable with parameters `a` and `b`, both positive, stays below
/// with this probability, which is between 0 and 1.
#[must_use]
pub fn beta_quantile(a: f64, b: f64, probability: f64) -> f64 {
    argument_at(probability, 0.0, 1.0, |x| beta_reg(a, b, x))
}

/// The number that a gamma variable with this positive shape and unit rate stays below with
/// this probability, which is below 1.
pub(crate) fn gamma_quantile(shape: f64, probability: f64) -> f64 {
    let mut high = shape + 10.0;
    while gamma_lr(shape, high) < probability {
        high *= 2.0;
    }
    argument_at(probability, 0.0, high, |x| gamma_lr(shape, x))
}

/// Probability that a gamma variable with this positive shape and unit rate exceeds this number;
/// one for zero and below.
pub(crate) fn gamma_exceedance(shape: f64, x: f64) -> f64 {
    if x > 0.0 { gamma_ur(shape, x) } else { 1.0 }
}

/// Where an increasing function reaches a value between two bounds, by bisection down to
/// rounding; it is called strictly between them.
#[must_use]
pub fn argument_at(value: f64, mut low: f64, mut high: f64, of: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if of(middle) < value {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(found: f64, exact: f64, tolerance: f64) {
        assert!(
            (found - exact).abs() <= tolerance * exact.abs(),
            "{found:e} for {exact:e}"
        );
    }

    /// By 50-digit arithmetic (mpmath).
    const NORMAL: [(f64, f64); 9] = [
        (-20.0, 2.753_624_118_606_233_7e-89),
        (-8.0, 6.220_960_574_271_784e-16),
        (-3.0, 0.001_349_898_031_630_094_5),
        (-2.5, 0.006_209_665_325_776_135),
        (-1.0, 0.158_655_253_931_457_05),
        (0.0, 0.5),
        (0.3, 0.617_911_422_188_952_7),
        (2.7, 0.996_533_026_196_959_3),
        (5.0, 0.999_999_713_348_428_1),
    ];

    #[test]
    fn normal_distribution_and_its_inverse() {
        for (x, expected) in NORMAL {
            near(normal_distribution(x), expected, 3e-14);
            if x < 4.0 {
                near(normal_quantile(expected), x, 1e-13);
            }
        }
        // 97.5 %: any table of the normal distribution.
        near(normal_quantile(0.975), 1.959_963_984_540_054, 1e-15);
        assert_eq!(normal_quantile(0.5), 0.0);
        assert_eq!(normal_quantile(0.0), f64::NEG_INFINITY);
        assert_eq!(normal_quantile(1.0), f64::INFINITY);
        assert!(normal_quantile(1.5).is_nan() && normal_quantile(f64::NAN).is_nan());
        near(normal_density(0.0), 0.398_942_280_401_432_7, 1e-15);
    }

    /// By 50-digit arithmetic (mpmath).
    #[test]
    fn tails_over_their_density() {
        for (x, expected) in [
            (-5.0, 672_621.636_722_879_3),
            (-1.0, 3.477_051_811_703_694_5),
            (0.0, 1.253_314_137_315_500_3),
            (0.3, 1.001_837_400_992_155_7),
            (1.0, 0.655_679_542_418_798_5),
            (2.4, 0.366_050_808_687_150_3),
            (2.6, 0.343_164_145_005_869_1),
            (5.0, 0.192_808_104_715_315_76),
            (12.0, 0.082_766_286_501_369_18),
            (40.0, 0.024_984_404_205_720_57),
            (1e3, 9.999_990_000_029_999e-4),
            (1e8, 1e-8),
        ] {
            near(mills_ratio(x), expected, 3e-15);
        }
        assert_eq!(mills_ratio(f64::INFINITY), 0.0);
        assert_eq!(mills_ratio(-60.0), f64::INFINITY);
    }

    /// Closed forms for two and four degrees, the normal distribution for one, and the 5 % points
    /// of the tables (Pearson and Hartley, Biometrika Tables for Statisticians I, table 8).
    #[test]
    fn chi_square() {
        for x in [0.1_f64, 1.0, 7.5, 40.0] {
            near(chi_square_exceedance(x, 2), libm::exp(-0.5 * x), 1e-12);
            let four = libm::exp(-0.5 * x) * (1.0 + 0.5 * x);
            near(chi_square_exceedance(x, 4), four, 1e-12);
            let one = 2.0 * normal_distribution(-x.sqrt());
            near(chi_square_exceedance(x, 1), one, 1e-9);
        }
        for (degrees, point) in [(1, 3.841_46), (5, 11.070_5), (10, 18.307_0), (30, 43.773_0)] {
            near(chi_square_exceedance(point, degrees), 0.05, 2e-5);
        }
        assert_eq!(chi_square_exceedance(0.0, 3), 1.0);
    }

    /// Closed forms: factorials, Gamma(1/2), exponential law, polynomials, arc sine.
    #[test]
    fn gamma_and_beta() {
        near(ln_gamma(0.5), 0.5 * libm::log(std::f64::consts::PI), 1e-13);
        near(ln_gamma(11.0), libm::log(3_628_800.0_f64), 1e-14);
        near(gamma_quantile(1.0, 0.95), -(libm::log(0.05)), 1e-13);
        // 1 - exp(-x)(1 + x + x^2/2) at 2, by 50-digit arithmetic.
        near(gamma_quantile(3.0, 0.323_323_583_816_936_5), 2.0, 1e-13);
        // What `statrs` itself finds differs by 4.8e-10.
        near(gamma_quantile(2.0, 0.45), 1.523_473_212_136_418, 1e-13);
        for x in [0.05_f64, 0.3, 0.8] {
            near(beta_quantile(2.0, 1.0, x * x), x, 1e-13);
            let cubic = 6.0 * x * x - 8.0 * x.powi(3) + 3.0 * x.powi(4);
            near(beta_quantile(2.0, 3.0, cubic), x, 1e-13);
            let arc = std::f64::consts::FRAC_2_PI * libm::asin(x.sqrt());
            near(beta_quantile(0.5, 0.5, arc), x, 1e-13);
        }
        // 1 - 0.25^(1/398); what `statrs` itself finds differs by 4.2e-10.
        let exact = -libm::expm1(libm::log(0.25) / 398.0);
        near(beta_quantile(1.0, 398.0, 0.75), exact, 5e-12);
    }
}
