//! From a fragility and the hazard at a site to a mean annual frequency.

use pounding_ground_motion::distributions::normal_distribution;

use super::fragility::{Fragility, FragilityFit};
use crate::study_file::HazardCurve;

impl HazardCurve {
    /// Power law `factor intensity^-slope` between two neighbouring points.
    fn segment(a: (f64, f64), b: (f64, f64)) -> (f64, f64) {
        let slope = (a.1 / b.1).ln() / (b.0 / a.0).ln();
        (a.1 * a.0.powf(slope), slope)
    }

    /// Mean annual frequency (1/year) with which an intensity is exceeded: a power law
    /// between points, that of the last two above them; below the first point the
    /// frequency of the first.
    #[must_use]
    pub fn frequency(&self, intensity: f64) -> f64 {
        let first = self.points[0];
        if intensity <= first.0 {
            return first.1;
        }
        let above = self.points.partition_point(|p| p.0 < intensity);
        let i = above.clamp(1, self.points.len() - 1);
        let (factor, slope) = Self::segment(self.points[i - 1], self.points[i]);
        factor * intensity.powf(-slope)
    }

    fn with_fragility(&self, f: &Fragility) -> f64 {
        let last = self.points.len() - 2;
        let segments = self.points.windows(2).enumerate();
        segments
            .map(|(i, p)| {
                let (factor, slope) = Self::segment(p[0], p[1]);
                let end = if i == last { f64::INFINITY } else { p[1].0 };
                part(f, (factor, slope), p[0].0, end)
            })
            .sum()
    }
}

/// `int P(x) |d lambda(x)|` over a stretch where `lambda = factor x^-slope`, exactly: by
/// parts, completing the square in the logarithm.
fn part(f: &Fragility, (factor, slope): (f64, f64), from: f64, to: f64) -> f64 {
    let (theta, beta) = (f.median, f.dispersion);
    let z = |x: f64| (x / theta).ln() / beta;
    let shift = slope * beta;
    let at = |x: f64| {
        if x.is_infinite() {
            return (0.0, 1.0);
        }
        (
            factor * x.powf(-slope) * normal_distribution(z(x)),
            normal_distribution(z(x) + shift),
        )
    };
    let (low, high) = (at(from), at(to));
    let whole = factor * theta.powf(-slope) * (0.5 * shift * shift).exp();
    // Differences of the upper tail, where the lower one has no digits left.
    let between = if z(from) + shift > 0.0 {
        let upper = |x: f64| {
            if x.is_infinite() {
                0.0
            } else {
                normal_distribution(-z(x) - shift)
            }
        };
        upper(from) - upper(to)
    } else {
        high.1 - low.1
    };
    whole * between - (high.0 - low.0)
}

/// Mean annual frequency (1/year) of a state, `int P(state | x) |d lambda(x)|`, without
/// error of quadrature.
///
/// Intensities below the first point of the curve count nothing; above the last point its
/// last power law goes on. A step counts with its lower end and a state that is never
/// reached as if it were reached right above the last intensity, both of which err on the
/// safe side; `None` where the counts give no curve, or are above zero already at the
/// least intensity.
#[must_use]
pub fn mean_annual_frequency(fit: &FragilityFit, hazard: &HazardCurve) -> Option<f64> {
    match fit {
        FragilityFit::Lognormal(f) => Some(hazard.with_fragility(f)),
        FragilityFit::Step { lower, .. } => Some(hazard.frequency(*lower)),
        FragilityFit::Never { up_to } => Some(hazard.frequency(*up_to)),
        FragilityFit::Always { .. } | FragilityFit::None => None,
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    fn fragility(median: f64, dispersion: f64) -> Fragility {
        Fragility {
            median,
            dispersion,
            standard_errors: [0.0; 2],
            covariance: 0.0,
            log_likelihood: 0.0,
        }
    }

    /// Lognormal fragility on `lambda = k0 x^-k`: `k0 median^-k exp(k^2 beta^2 / 2)`
    /// (Cornell, Jalayer, Hamburger and Foutch 2002, J. Struct. Eng. 128, 526).
    #[test]
    fn a_power_law_has_a_closed_form() {
        for (k, median, beta) in [(2.5, 0.4, 0.45), (1.7, 3.0, 0.8), (3.2, 1.0, 0.2)] {
            let k0 = 2.0e-4;
            let grid = (0..400).map(|i| 1e-6 * 1.1_f64.powi(i));
            let curve = HazardCurve::new(grid.map(|x| (x, k0 * x.powf(-k))).collect()).unwrap();
            let expected = k0 * f64::powf(median, -k) * (0.5 * k * k * beta * beta).exp();
            let found = curve.with_fragility(&fragility(median, beta));
            assert!((found / expected - 1.0).abs() < 1e-10, "{found} {expected}");
        }
    }

    /// Two power laws: against an integral by a million trapezoids in the logarithm.
    #[test]
    fn a_bent_curve_agrees_with_a_fine_sum() {
        let points = vec![(0.05, 0.1), (0.3, 4e-3), (1.0, 1.5e-4), (2.0, 5e-6)];
        let curve = HazardCurve::new(points).unwrap();
        let f = fragility(0.5, 0.5);
        let count = 1_000_000;
        let (from, to) = (0.05_f64.ln(), 60.0_f64.ln());
        let h = (to - from) / f64::from(count);
        let mut sum = 0.0;
        for i in 0..count {
            let (a, b) = (from + h * f64::from(i), from + h * f64::from(i + 1));
            let fall = curve.frequency(a.exp()) - curve.frequency(b.exp());
            sum += fall * f.probability((0.5 * (a + b)).exp());
        }
        let found = curve.with_fragility(&f);
        assert!((found / sum - 1.0).abs() < 1e-8, "{found} {sum}");
    }

    #[test]
    fn steps_take_their_safe_side() {
        let curve = HazardCurve::new(vec![(0.1, 1e-2), (1.0, 1e-4)]).unwrap();
        let step = FragilityFit::Step {
            lower: 0.5,
            upper: 0.7,
        };
        let expected = 1e-2 * 5.0_f64.powf(-2.0);
        assert!((mean_annual_frequency(&step, &curve).unwrap() / expected - 1.0).abs() < 1e-12);
        let never = FragilityFit::Never { up_to: 1.0 };
        assert!((mean_annual_frequency(&never, &curve).unwrap() / 1e-4 - 1.0).abs() < 1e-12);
        assert_eq!(
            mean_annual_frequency(&FragilityFit::Always { from: 0.1 }, &curve),
            None
        );
    }
}
