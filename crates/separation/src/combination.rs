//! Rules that combine the peak displacements of two buildings.

use crate::error::SeparationError;
use pounding_catalogue::Verification;

/// How two peak displacements make a gap.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CombinationRule {
    /// `uA + uB`: both peaks at once, towards one another.
    AbsoluteSum,
    /// SRSS, `sqrt(uA^2 + uB^2)`: two uncorrelated motions.
    SquareRootOfSumOfSquares,
    /// Double difference combination (DDC), `sqrt(uA^2 + uB^2 - 2 rho uA uB)` with
    /// [`correlation_coefficient`].
    DoubleDifference,
}

/// Period and damping of a building as the rules see it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Oscillator {
    /// Period (s).
    pub period: f64,
    /// Damping ratio (-).
    pub damping_ratio: f64,
}

impl CombinationRule {
    /// All rules.
    pub const ALL: [Self; 3] = [
        Self::AbsoluteSum,
        Self::SquareRootOfSumOfSquares,
        Self::DoubleDifference,
    ];

    /// Name in tables and arguments.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::AbsoluteSum => "absolute_sum",
            Self::SquareRootOfSumOfSquares => "square_root_of_sum_of_squares",
            Self::DoubleDifference => "double_difference",
        }
    }

    /// Name in the literature, where it has a usual abbreviation.
    #[must_use]
    pub fn abbreviation(self) -> Option<&'static str> {
        match self {
            Self::AbsoluteSum => None,
            Self::SquareRootOfSumOfSquares => Some("SRSS"),
            Self::DoubleDifference => Some("DDC"),
        }
    }

    /// Name with its abbreviation and more in brackets, for tables.
    #[must_use]
    pub fn title(self, more: Option<&str>) -> String {
        let brackets: Vec<&str> = self.abbreviation().into_iter().chain(more).collect();
        if brackets.is_empty() {
            self.name().to_owned()
        } else {
            format!("{} ({})", self.name(), brackets.join(", "))
        }
    }

    /// Formula, and whose.
    #[must_use]
    pub fn formula(self) -> &'static str {
        match self {
            Self::AbsoluteSum => "uA + uB",
            Self::SquareRootOfSumOfSquares => "sqrt(uA^2 + uB^2)",
            Self::DoubleDifference => {
                "sqrt(uA^2 + uB^2 - 2 rho uA uB), rho as in the complete quadratic combination (CQC) (Jeng, Kasai and Maison, Earthquake Spectra 8 (1992) 201)"
            }
        }
    }

    /// How far the rule has been checked.
    #[must_use]
    pub fn status(self) -> Verification {
        match self {
            Self::AbsoluteSum => Verification::Verified("triangle inequality: never unsafe"),
            Self::SquareRootOfSumOfSquares => {
                Verification::Verified("variance of a difference of uncorrelated motions")
            }
            Self::DoubleDifference => Verification::Verified(
                "rho against the exact covariance of two responses to the same white noise",
            ),
        }
    }

    /// The gap (m) for peak displacements (m) of two buildings and their correlation
    /// coefficient (-), from -1 to 1, which only [`CombinationRule::DoubleDifference`] uses; NaN for what is
    /// no number.
    #[must_use]
    pub fn gap(self, left: f64, right: f64, correlation: f64) -> f64 {
        match self {
            Self::AbsoluteSum => left.abs() + right.abs(),
            Self::SquareRootOfSumOfSquares => libm::hypot(left, right),
            Self::DoubleDifference => {
                let product = 2.0 * (1.0 - correlation) * left.abs() * right.abs();
                // (a - b)^2 + 2 (1 - rho) a b: exactly zero for identical buildings.
                let squares = (left.abs() - right.abs()).powi(2) + product;
                // What is no number stays none.
                match squares < 0.0 {
                    true => 0.0,
                    false => squares.sqrt(),
                }
            }
        }
    }
}

/// Correlation coefficient (-) of the responses of two oscillators to the same white
/// noise, with `r = TB / TA`:
/// `rho = 8 sqrt(xA xB) (xB + xA r) r^(3/2) / ((1 - r^2)^2 + 4 xA xB (1 + r^2) r + 4 (xA^2 + xB^2) r^2)`.
///
/// This is the coefficient of the complete quadratic combination (CQC). Source: Der
/// Kiureghian, Earthquake Engineering and Structural Dynamics 8 (1980) 419, as used by
/// Jeng, Kasai and Maison 1992. A variant with `xA + xB r` is in print; it
/// gives the coefficient of the pair with exchanged damping. Undamped oscillators have the
/// limits of the formula: no correlation, and 1 for equal periods and dampings that vanish
/// alike.
///
/// # Errors
/// A period that is not positive and finite, a damping ratio that is negative or not
/// finite.
pub fn correlation_coefficient(a: Oscillator, b: Oscillator) -> Result<f64, SeparationError> {
    for (quantity, value, allowed, range) in [
        ("period", a.period, a.period > 0.0, "(0, inf)"),
        ("period", b.period, b.period > 0.0, "(0, inf)"),
        (
            "damping ratio",
            a.damping_ratio,
            a.damping_ratio >= 0.0,
            "[0, inf)",
        ),
        (
            "damping ratio",
            b.damping_ratio,
            b.damping_ratio >= 0.0,
            "[0, inf)",
        ),
    ] {
        if !(value.is_finite() && allowed) {
            return Err(SeparationError::OutOfRange {
                quantity,
                value,
                range,
            });
        }
    }
    let (xa, xb, r) = (a.damping_ratio, b.damping_ratio, b.period / a.period);
    let r2 = r * r;
    let above = 8.0 * (xa * xb).sqrt() * (xb + xa * r) * r * r.sqrt();
    let below =
        (1.0 - r2).powi(2) + 4.0 * xa * xb * (1.0 + r2) * r + 4.0 * (xa * xa + xb * xb) * r2;
    if below == 0.0 {
        return Ok(1.0);
    }
    Ok(above / below)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use proptest::prelude::*;

    use super::*;

    fn oscillator(period: f64, damping_ratio: f64) -> Oscillator {
        Oscillator {
            period,
            damping_ratio,
        }
    }

    fn rho(ta: f64, tb: f64, xa: f64, xb: f64) -> f64 {
        correlation_coefficient(oscillator(ta, xa), oscillator(tb, xb)).unwrap()
    }

    /// What is no number is no gap of zero.
    #[test]
    fn what_is_no_number_stays_none() {
        for rule in CombinationRule::ALL {
            assert!(rule.gap(f64::NAN, 0.2, 0.0).is_nan(), "{}", rule.name());
            assert!(rule.gap(0.1, f64::NAN, 0.0).is_nan(), "{}", rule.name());
        }
        let rule = CombinationRule::DoubleDifference;
        assert!(rule.gap(0.1, 0.2, f64::NAN).is_nan());
        assert_eq!(rule.gap(0.1, 0.1, 1.0), 0.0);
    }

    /// Covariance of two responses to the same white noise (Lyapunov equation), six
    /// printed digits.
    #[test]
    fn correlation_of_white_noise_responses() {
        for (ta, tb, xa, xb, expected) in [
            (1.0, 0.5, 0.05, 0.05, 0.018_486),
            (1.0, 0.8, 0.02, 0.10, 0.178_119),
            (1.0, 0.8, 0.10, 0.02, 0.153_551),
            (1.2, 0.3, 0.05, 0.02, 0.001_167),
            (0.5, 1.0, 0.02, 0.10, 0.015_322),
        ] {
            let found = rho(ta, tb, xa, xb);
            assert!((found - expected).abs() < 5.0e-7, "{found} {expected}");
        }
    }

    /// The three-storey pair under El Centro: roof peaks and gaps by an independent
    /// solution, six printed digits.
    #[test]
    fn worked_example() {
        let (left, right) = (0.114_253, 0.020_696);
        let rho = rho(1.2, 0.3, 0.05, 0.05);
        assert!((rho - 0.003_540).abs() < 5.0e-7, "{rho}");
        for (rule, expected) in CombinationRule::ALL
            .into_iter()
            .zip([0.134_949, 0.116_112, 0.116_040])
        {
            let gap = rule.gap(left, right, rho);
            assert!((gap - expected).abs() < 1.0e-6, "{rule:?}: {gap}");
        }
    }

    #[test]
    fn identical_buildings() {
        let u = 0.123_4;
        let rho = rho(0.7, 0.7, 0.03, 0.03);
        assert!((rho - 1.0).abs() < 1.0e-15);
        assert!((CombinationRule::AbsoluteSum.gap(u, u, rho) - 2.0 * u).abs() < 1.0e-16);
        let root = CombinationRule::SquareRootOfSumOfSquares.gap(u, u, rho);
        assert!((root - std::f64::consts::SQRT_2 * u).abs() < 1.0e-15);
        assert!(CombinationRule::DoubleDifference.gap(u, u, 1.0) == 0.0);
        assert!(CombinationRule::DoubleDifference.gap(u, u, rho) < 1.0e-8 * u);
    }

    #[test]
    fn oscillators_out_of_range() {
        let good = oscillator(1.0, 0.05);
        assert!(correlation_coefficient(oscillator(0.0, 0.05), good).is_err());
        for bad in [-1.0, f64::NAN, f64::INFINITY] {
            assert!(correlation_coefficient(oscillator(bad, 0.05), good).is_err());
            assert!(correlation_coefficient(good, oscillator(1.0, bad)).is_err());
        }
    }

    #[test]
    fn undamped_oscillators() {
        assert_eq!(rho(1.0, 0.5, 0.0, 0.0), 0.0);
        assert_eq!(rho(1.0, 0.5, 0.0, 0.05), 0.0);
        assert_eq!(rho(1.0, 1.0, 0.0, 0.0), 1.0);
        assert!((rho(1.0, 1.0, 1.0e-6, 1.0e-6) - 1.0).abs() < 1.0e-12);
    }

    proptest! {
        #[test]
        fn symmetric_and_a_correlation(
            ta in 0.05..5.0_f64, tb in 0.05..5.0_f64, xa in 0.001..0.5_f64, xb in 0.001..0.5_f64,
        ) {
            let (ab, ba) = (rho(ta, tb, xa, xb), rho(tb, ta, xb, xa));
            prop_assert!((ab - ba).abs() < 1.0e-12 * ab.abs());
            prop_assert!((0.0..=1.0 + 1.0e-12).contains(&ab));
        }

        /// Absolute sum above square root above double difference, for motions that
        /// are correlated at all.
        #[test]
        fn order_of_the_rules(a in 0.0..1.0_f64, b in 0.0..1.0_f64, rho in 0.0..1.0_f64) {
            let [sum, root, difference] = CombinationRule::ALL.map(|r| r.gap(a, b, rho));
            prop_assert!(sum >= root * (1.0 - 1.0e-15));
            prop_assert!(root >= difference * (1.0 - 1.0e-12));
            prop_assert!(difference >= (a - b).abs() * (1.0 - 1.0e-12));
        }
    }
}
