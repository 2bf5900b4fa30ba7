//! Distributions that bounds of small samples need.

use pounding_ground_motion::distributions::{
    argument_at, beta_quantile, normal_distribution, normal_quantile,
};

/// Distribution function of the noncentral t distribution: `P(Z + noncentrality <= t S)`
/// with `S^2` chi-square over its degrees of freedom, by equal steps of the logarithm of `S`, in which the
/// integrand dies away to both sides, so that the rule converges faster than any power of the step.
fn noncentral_t(t: f64, degrees: f64, noncentrality: f64) -> f64 {
    // Steps for each width of the steepest factor: the distribution function around `noncentrality / t`, and the density.
    let step = 0.2 / (1.0 + noncentrality.abs() + (2.0 * degrees).sqrt());
    // The density falls by the power `degrees` to the one side and by the exponential of a square to the other.
    let (low, high) = (
        -0.5 - 45.0 / degrees,
        libm::log(1.0 + 12.0 / degrees.sqrt()),
    );
    let intervals = ((high - low) / step).ceil();
    let (mut sum, mut whole) = (0.0, 0.0);
    for i in 0..=intervals as usize {
        let y = low + (high - low) * i as f64 / intervals;
        let density = libm::exp(degrees * (y - 0.5 * libm::expm1(2.0 * y)));
        whole += density;
        sum += density * normal_distribution(t * libm::exp(y) - noncentrality);
    }
    sum / whole
}

/// Factor `k` such that `mean + k deviation` of a normal sample of this size lies above
/// the quantile of this probability with this confidence. Source: Owen, Technometrics 10
/// (1968) 445: `k = t' / sqrt(n)`, noncentral t with `n - 1` degrees of freedom and
/// noncentrality `z sqrt(n)`.
pub(crate) fn tolerance_factor(size: usize, probability: f64, confidence: f64) -> f64 {
    let root = (size as f64).sqrt();
    let shift = normal_quantile(probability) * root;
    let degrees = size as f64 - 1.0;
    let mut reach = 10.0 + 2.0 * shift.abs();
    while noncentral_t(reach, degrees, shift) < confidence
        || noncentral_t(-reach, degrees, shift) > confidence
    {
        reach *= 2.0;
    }
    argument_at(confidence, -reach, reach, |t| {
        noncentral_t(t, degrees, shift)
    }) / root
}

/// Two-sided bounds of a probability of which `hits` of `trials` were seen. Source:
/// Clopper and Pearson, Biometrika 26 (1934) 404, as quantiles of beta distributions.
#[must_use]
pub fn binomial_bounds(hits: usize, trials: usize, confidence: f64) -> (f64, f64) {
    let tail = 0.5 * (1.0 - confidence);
    let (seen, missed) = (hits as f64, trials.saturating_sub(hits) as f64);
    let low = match hits {
        0 => 0.0,
        _ => beta_quantile(seen, missed + 1.0, tail),
    };
    let high = match missed {
        0.0 => 1.0,
        _ => beta_quantile(seen + 1.0, missed, 1.0 - tail),
    };
    (low, high)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One-sided tolerance factors of normal samples at 95 % confidence: Natrella,
    /// Experimental Statistics, NBS Handbook 91 (1963), table A-7.
    #[test]
    fn tolerance_factors() {
        for (size, probability, factor) in [
            (5, 0.90, 3.407),
            (10, 0.90, 2.355),
            (10, 0.95, 2.911),
            (10, 0.99, 3.981),
            (20, 0.95, 2.396),
            (50, 0.95, 2.065),
        ] {
            let found = tolerance_factor(size, probability, 0.95);
            assert!(
                (found - factor).abs() < 2.0e-3,
                "{size} {probability}: {found}"
            );
        }
    }

    /// Two records: P(T <= t) with one degree of freedom has the closed form of the
    /// central t for the median, `t = tan(pi (p - 1/2))`.
    #[test]
    fn two_records() {
        let found = tolerance_factor(2, 0.5, 0.95);
        let exact = libm::tan(std::f64::consts::PI * 0.45) / 2.0_f64.sqrt();
        assert!((found - exact).abs() < 1.0e-6, "{found} {exact}");
    }

    /// The same for confidences near zero and one, where the distribution reaches far.
    #[test]
    fn two_records_at_any_confidence() {
        for confidence in [1e-6, 1e-3, 0.005, 0.3, 0.995, 0.9995, 0.99995, 0.999999] {
            let found = tolerance_factor(2, 0.5, confidence);
            let exact = libm::tan(std::f64::consts::PI * (confidence - 0.5)) / 2.0_f64.sqrt();
            assert!(
                (found / exact - 1.0).abs() < 1e-8,
                "{confidence}: {found} {exact}"
            );
        }
    }

    /// Against `scipy.stats.nct.ppf(confidence, n - 1, z sqrt(n)) / sqrt(n)` (SciPy 1.17).
    #[test]
    fn tolerance_factors_of_few_records_and_many() {
        for (size, probability, confidence, factor) in [
            (2, 0.9, 0.025, -0.142_893_597_102),
            (2, 0.9, 0.975, 41.200_840_049_2),
            (2, 0.9, 0.99995, 20_606.732_386_5),
            (2, 0.99, 0.99995, 37_124.632_882_5),
            (3, 0.9, 0.00005, -4.426_822_200_79),
            (3, 0.9, 0.99995, 198.727_933_316),
            (3, 0.99, 0.975, 15.042_508_045_3),
            (7, 0.9, 0.00005, -0.215_477_465_429),
            (7, 0.99, 0.99995, 16.360_649_786),
            (40, 0.9, 0.99995, 2.489_002_490_3),
            (40, 0.99, 0.025, 1.822_560_708_88),
            (400, 0.5, 0.975, 0.098_296_364_796),
            (400, 0.99, 0.99995, 2.746_737_996_66),
        ] {
            let found = tolerance_factor(size, probability, confidence);
            assert!(
                (found / factor - 1.0).abs() < 1e-7,
                "{size} {probability} {confidence}: {found} {factor}"
            );
        }
    }

    /// No hit in ten: 1 - 0.025^(1/10). Five of ten: 0.1871 and 0.8129 in the paper's
    /// charts and every table since.
    #[test]
    fn clopper_pearson() {
        let (low, high) = binomial_bounds(0, 10, 0.95);
        assert!(low == 0.0 && (high - (1.0 - libm::pow(0.025_f64, 0.1))).abs() < 1.0e-12);
        let (low, high) = binomial_bounds(5, 10, 0.95);
        assert!((low - 0.187_1).abs() < 5.0e-5 && (high - 0.812_9).abs() < 5.0e-5);
        assert_eq!(binomial_bounds(3, 3, 0.9).1, 1.0);
    }
}
