//! Fragility from counts: a lognormal curve by maximum likelihood.

use pounding_ground_motion::distributions::{normal_density, normal_distribution, normal_quantile};

/// How often a state was reached at one intensity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Counts {
    /// Intensity (SI).
    pub intensity: f64,
    /// Runs that were made and did not fail; collapses count and have reached every state.
    pub runs: usize,
    /// Runs among them that reached the state.
    pub reached: usize,
}

/// `P(state | intensity) = Phi(ln(intensity/median)/dispersion)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fragility {
    /// Intensity at which half of the records reach the state (SI).
    pub median: f64,
    /// Standard deviation of the logarithm.
    pub dispersion: f64,
    /// Standard errors of the logarithm of the median and of the dispersion, from the
    /// observed information of the likelihood.
    pub standard_errors: [f64; 2],
    /// Covariance of the two.
    pub covariance: f64,
    /// Logarithm of the likelihood, without the binomial coefficients.
    pub log_likelihood: f64,
}

/// What counts say of a lognormal fragility.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FragilityFit {
    /// The likelihood has a maximum.
    Lognormal(Fragility),
    /// All runs up to one intensity stay below the state and all from another on reach it,
    /// or only one intensity lies between: any narrow curve there is as likely.
    Step {
        /// Maximum intensity at which no run reaches the state; zero if there is none.
        lower: f64,
        /// Least intensity from which on all runs reach it; infinite if there is none.
        upper: f64,
    },
    /// No run reaches the state, up to this intensity.
    Never {
        /// Maximum intensity of the analysis.
        up_to: f64,
    },
    /// Every run reaches it, from this intensity on.
    Always {
        /// Least intensity of the analysis.
        from: f64,
    },
    /// The state becomes rarer as the intensity grows or does not depend on it, or no run was
    /// made.
    None,
}

impl Fragility {
    /// Probability of the state at an intensity.
    #[must_use]
    pub fn probability(&self, intensity: f64) -> f64 {
        if intensity <= 0.0 {
            return 0.0;
        }
        normal_distribution((intensity / self.median).ln() / self.dispersion)
    }

    /// Bounds of the median, with this confidence: normal in its logarithm.
    #[must_use]
    pub fn median_bounds(&self, confidence: f64) -> [f64; 2] {
        let reach = normal_quantile(0.5 * (1.0 + confidence)) * self.standard_errors[0];
        [self.median * (-reach).exp(), self.median * reach.exp()]
    }

    /// Bounds of the dispersion, with this confidence: normal in its logarithm.
    #[must_use]
    pub fn dispersion_bounds(&self, confidence: f64) -> [f64; 2] {
        let reach =
            normal_quantile(0.5 * (1.0 + confidence)) * self.standard_errors[1] / self.dispersion;
        [
            self.dispersion * (-reach).exp(),
            self.dispersion * reach.exp(),
        ]
    }

    /// Bounds of the probability at an intensity, with this confidence, from the
    /// covariance of the parameters by the delta method on the scale of the quantile.
    #[must_use]
    pub fn probability_bounds(&self, intensity: f64, confidence: f64) -> [f64; 2] {
        let z = (intensity / self.median).ln() / self.dispersion;
        let (a, b) = (-1.0 / self.dispersion, -z / self.dispersion);
        let [s, t] = self.standard_errors;
        let variance = a * a * s * s + b * b * t * t + 2.0 * a * b * self.covariance;
        let reach = normal_quantile(0.5 * (1.0 + confidence)) * variance.max(0.0).sqrt();
        [
            normal_distribution(z - reach),
            normal_distribution(z + reach),
        ]
    }
}

impl FragilityFit {
    /// The same from runs of which the variance of a fraction is so many times that of independent ones: errors are
    /// larger by its root.
    pub(super) fn of_alike_runs(self, design_effect: f64) -> Self {
        match self {
            Self::Lognormal(fit) => Self::Lognormal(Fragility {
                standard_errors: fit
                    .standard_errors
                    .map(|error| error * design_effect.sqrt()),
                covariance: fit.covariance * design_effect,
                ..fit
            }),
            other => other,
        }
    }
}

/// Fits a lognormal fragility to counts by maximum likelihood: binomial at every
/// intensity, a probit in the logarithm of the intensity (Baker 2015, Earthq. Spectra 31,
/// 579, equations 9 and 11). The likelihood of a probit is concave: Newton's method finds
/// its one maximum, if there is one.
#[must_use]
pub fn fit(counts: &[Counts]) -> FragilityFit {
    let used: Vec<&Counts> = counts
        .iter()
        .filter(|c| c.runs > 0 && c.intensity > 0.0)
        .collect();
    let extremes = |pick: &dyn Fn(&Counts) -> bool| {
        let some = used.iter().filter(|c| pick(c)).map(|c| c.intensity);
        some.fold(None, |range: Option<(f64, f64)>, x| {
            Some(range.map_or((x, x), |(low, high)| (low.min(x), high.max(x))))
        })
    };
    let reached = extremes(&|c| c.reached > 0);
    let missed = extremes(&|c| c.reached < c.runs);
    let (reached, missed) = match (reached, missed) {
        (None, None) => return FragilityFit::None,
        (None, Some((_, up_to))) => return FragilityFit::Never { up_to },
        (Some((from, _)), None) => return FragilityFit::Always { from },
        (Some(a), Some(b)) => (a, b),
    };
    // Where runs with and without the state do not overlap in intensity, the likelihood
    // has no maximum (Albert and Anderson 1984, Biometrika 71, 1).
    if missed.1 <= reached.0 {
        let intensities = || used.iter().map(|c| c.intensity);
        let below = intensities().filter(|x| *x < reached.0);
        let above = intensities().filter(|x| *x > missed.1);
        return FragilityFit::Step {
            lower: below.fold(0.0, f64::max),
            upper: above.fold(f64::INFINITY, f64::min),
        };
    }
    if reached.1 <= missed.0 {
        return FragilityFit::None;
    }
    maximum(&used).map_or(FragilityFit::None, FragilityFit::Lognormal)
}

/// A greater dispersion says that the state does not depend on the intensity.
const WIDEST: f64 = 20.0;

/// Log-likelihood with gradient and Hessian in intercept and slope.
struct Likelihood {
    value: f64,
    gradient: [f64; 2],
    hessian: [f64; 3],
}

fn likelihood(used: &[&Counts], a: f64, b: f64, centre: f64) -> Likelihood {
    let mut l = Likelihood {
        value: 0.0,
        gradient: [0.0; 2],
        hessian: [0.0; 3],
    };
    for c in used {
        let x = c.intensity.ln() - centre;
        let z = a + b * x;
        let density = normal_density(z);
        // Both sides of the law by themselves, so that neither tail is lost.
        for (count, side, sign) in [
            (c.reached, normal_distribution(z), 1.0),
            (c.runs - c.reached, normal_distribution(-z), -1.0),
        ] {
            if count == 0 {
                continue;
            }
            let n = count as f64;
            let ratio = density / side.max(f64::MIN_POSITIVE);
            l.value += n * side.max(f64::MIN_POSITIVE).ln();
            let first = sign * n * ratio;
            let second = -n * ratio * (ratio + sign * z);
            l.gradient[0] += first;
            l.gradient[1] += first * x;
            l.hessian[0] += second;
            l.hessian[1] += second * x;
            l.hessian[2] += second * x * x;
        }
    }
    l
}

/// Newton's method with halved steps.
fn maximum(used: &[&Counts]) -> Option<Fragility> {
    let runs: f64 = used.iter().map(|c| c.runs as f64).sum();
    // Around the mean logarithm intercept and slope hardly disturb one another.
    let centre = used
        .iter()
        .map(|c| c.runs as f64 * c.intensity.ln())
        .sum::<f64>()
        / runs;
    let (mut a, mut b) = (0.0, 1.0);
    let mut here = likelihood(used, a, b, centre);
    for _ in 0..200 {
        let [aa, ab, bb] = here.hessian;
        let determinant = aa * bb - ab * ab;
        if !(determinant > 0.0) {
            return None;
        }
        let [ga, gb] = here.gradient;
        let step = [
            -(bb * ga - ab * gb) / determinant,
            -(aa * gb - ab * ga) / determinant,
        ];
        let mut part = 1.0;
        let next = loop {
            let next = likelihood(used, a + part * step[0], b + part * step[1], centre);
            if next.value >= here.value || part < 1.0e-12 {
                break next;
            }
            part *= 0.5;
        };
        a += part * step[0];
        b += part * step[1];
        here = next;
        if step[0].abs() < 1.0e-13 * (1.0 + a.abs()) && step[1].abs() < 1.0e-13 * (1.0 + b.abs()) {
            break;
        }
    }
    (b * WIDEST > 1.0).then(|| parameters(&here, a, b, centre))
}

/// From intercept and slope to median and dispersion.
fn parameters(here: &Likelihood, a: f64, b: f64, centre: f64) -> Fragility {
    let [aa, ab, bb] = here.hessian;
    let determinant = aa * bb - ab * ab;
    // Inverse of minus the Hessian.
    let (va, vab, vb) = (-bb / determinant, ab / determinant, -aa / determinant);
    // ln median = centre - a/b and dispersion = 1/b.
    let median = [-1.0 / b, a / (b * b)];
    let spread = -1.0 / (b * b);
    let variance =
        median[0] * median[0] * va + 2.0 * median[0] * median[1] * vab + median[1] * median[1] * vb;
    Fragility {
        median: (centre - a / b).exp(),
        dispersion: 1.0 / b,
        standard_errors: [variance.max(0.0).sqrt(), spread.abs() * vb.max(0.0).sqrt()],
        covariance: spread * (median[0] * vab + median[1] * vb),
        log_likelihood: here.value,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn counts(table: &[(f64, usize, usize)]) -> Vec<Counts> {
        table
            .iter()
            .map(|&(intensity, runs, reached)| Counts {
                intensity,
                runs,
                reached,
            })
            .collect()
    }

    fn lognormal(table: &[(f64, usize, usize)]) -> Fragility {
        match fit(&counts(table)) {
            FragilityFit::Lognormal(f) => f,
            other => panic!("{other:?}"),
        }
    }

    /// With two intensities the curve goes through both fractions: a closed form.
    #[test]
    fn two_intensities_are_met() {
        let f = lognormal(&[(0.2, 40, 6), (0.5, 40, 27)]);
        let (z1, z2) = (normal_quantile(6.0 / 40.0), normal_quantile(27.0 / 40.0));
        let dispersion = (0.5_f64 / 0.2).ln() / (z2 - z1);
        let median = 0.2 * (-z1 * dispersion).exp();
        assert!((f.dispersion / dispersion - 1.0).abs() < 1e-12);
        assert!((f.median / median - 1.0).abs() < 1e-12);
        assert!((f.probability(0.5) - 27.0 / 40.0).abs() < 1e-12);
        // Each quantile has the variance p (1 - p) / (n density^2), by the delta method
        // on its own fraction, and the two are independent.
        let variance = |p: f64| p * (1.0 - p) / (40.0 * normal_density(normal_quantile(p)).powi(2));
        let span = (0.5_f64 / 0.2).ln();
        let spread =
            span / (z2 - z1).powi(2) * (variance(6.0 / 40.0) + variance(27.0 / 40.0)).sqrt();
        assert!((f.standard_errors[1] / spread - 1.0).abs() < 1e-10);
        let [low, high] = f.probability_bounds(0.5, 0.95);
        let reach = 1.959_963_984_540_054 * variance(27.0 / 40.0).sqrt();
        assert!((normal_quantile(high) - z2 - reach).abs() < 1e-9);
        assert!((normal_quantile(low) - z2 + reach).abs() < 1e-9);
    }

    /// Values by SciPy 1.17: the binomial likelihood brought to its maximum without
    /// derivatives (`minimize`, Nelder-Mead, to 1e-14), in median and dispersion
    /// themselves, and the Hessian there by `scipy.differentiate.hessian`.
    #[test]
    fn many_intensities_agree_with_an_independent_program() {
        let f = lognormal(&EXAMPLE);
        assert!((f.median / EXPECTED[0] - 1.0).abs() < 1e-8, "{f:?}");
        assert!((f.dispersion / EXPECTED[1] - 1.0).abs() < 1e-8, "{f:?}");
        assert!(
            (f.standard_errors[0] / EXPECTED[2] - 1.0).abs() < 1e-6,
            "{f:?}"
        );
        assert!(
            (f.standard_errors[1] / EXPECTED[3] - 1.0).abs() < 1e-6,
            "{f:?}"
        );
        assert!((f.log_likelihood - EXPECTED[4]).abs() < 1e-9, "{f:?}");
    }

    const EXAMPLE: [(f64, usize, usize); 9] = [
        (0.1, 40, 0),
        (0.2, 40, 1),
        (0.3, 40, 4),
        (0.4, 40, 9),
        (0.5, 38, 16),
        (0.6, 40, 22),
        (0.8, 40, 31),
        (1.0, 39, 36),
        (1.2, 40, 39),
    ];
    const EXPECTED: [f64; 5] = [
        0.5482331760111939,
        0.4542277001260076,
        0.04028409625819557,
        0.04264947764692699,
        -129.56283577359068,
    ];

    #[test]
    fn counts_without_a_maximum_say_so() {
        let of = |table: &[(f64, usize, usize)]| fit(&counts(table));
        assert_eq!(
            of(&[(0.1, 5, 0), (0.2, 5, 5)]),
            FragilityFit::Step {
                lower: 0.1,
                upper: 0.2
            }
        );
        assert_eq!(
            of(&[(0.1, 5, 0), (0.2, 5, 3), (0.4, 5, 5)]),
            FragilityFit::Step {
                lower: 0.1,
                upper: 0.4
            }
        );
        assert_eq!(
            of(&[(0.1, 5, 0), (0.2, 5, 0)]),
            FragilityFit::Never { up_to: 0.2 }
        );
        assert_eq!(
            of(&[(0.1, 5, 5), (0.2, 5, 5)]),
            FragilityFit::Always { from: 0.1 }
        );
        assert_eq!(of(&[(0.1, 5, 4), (0.2, 5, 1)]), FragilityFit::None);
        assert_eq!(of(&[(0.1, 0, 0)]), FragilityFit::None);
    }

    proptest! {
        /// Other units of the intensity scale the median and nothing else.
        #[test]
        fn units_do_not_matter(
            unit in 1e-3_f64..1e3,
            mut reached in proptest::collection::vec(0_usize..=20, 6)
        ) {
            // Falling counts have no curve, with a slope near zero that rounding decides.
            reached.sort_unstable();
            prop_assume!(reached[5] > reached[0] + 2);
            let table = |unit: f64| -> Vec<Counts> {
                let row = |(i, n): (usize, &usize)| Counts {
                    intensity: unit * 0.1 * 1.4_f64.powi(i as i32), runs: 20, reached: *n,
                };
                reached.iter().enumerate().map(row).collect()
            };
            match (fit(&table(1.0)), fit(&table(unit))) {
                (FragilityFit::Lognormal(a), FragilityFit::Lognormal(b)) => {
                    prop_assert!((b.median / a.median / unit - 1.0).abs() < 1e-6);
                    prop_assert!((b.dispersion / a.dispersion - 1.0).abs() < 1e-6);
                }
                (a, b) => prop_assert_eq!(std::mem::discriminant(&a), std::mem::discriminant(&b)),
            }
        }
    }
}
