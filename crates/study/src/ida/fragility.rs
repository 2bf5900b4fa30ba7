//! Fragility from counts: a lognormal curve by maximum likelihood.

use pounding_ground_motion::distributions::{
    beta_quantile, normal_density, normal_distribution, normal_quantile,
};

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

impl Counts {
    /// Runs that did not reach it; none where more reached it than were made.
    fn missed(&self) -> usize {
        self.runs.saturating_sub(self.reached)
    }
}

/// `P(state | intensity) = Phi(ln(intensity/median)/dispersion)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fragility {
    /// Intensity at which half of the records reach the state (SI).
    pub median: f64,
    /// Standard deviation of the logarithm.
    pub dispersion: f64,
    /// Standard errors of the logarithm of the median and of the dispersion: of runs that do not depend on one another from
    /// the observed information of the likelihood, else those of independent records with all their runs.
    pub standard_errors: [f64; 2],
    /// Covariance of the two.
    pub covariance: f64,
    /// Independent records that the errors are of, by whose number bounds are Student's; `None`: normal ones.
    pub records: Option<usize>,
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
        normal_distribution(libm::log(intensity / self.median) / self.dispersion)
    }

    /// How many standard errors bounds with this confidence lie off on either side.
    fn reach(&self, confidence: f64) -> f64 {
        match self.records {
            Some(records) if records > 1 => {
                // Student's t from the beta distribution (Abramowitz and Stegun 1964, 26.5.27).
                let freedom = records as f64 - 1.0;
                let x = beta_quantile(0.5 * freedom, 0.5, 1.0 - confidence);
                (freedom * (1.0 - x) / x).sqrt()
            }
            _ => normal_quantile(0.5 * (1.0 + confidence)),
        }
    }

    /// Bounds of the median, in its unit, with this confidence (-): even in its logarithm.
    #[must_use]
    pub fn median_bounds(&self, confidence: f64) -> [f64; 2] {
        let reach = self.reach(confidence) * self.standard_errors[0];
        [
            self.median * libm::exp(-reach),
            self.median * libm::exp(reach),
        ]
    }

    /// Bounds of the dispersion, with this confidence: even in its logarithm.
    #[must_use]
    pub fn dispersion_bounds(&self, confidence: f64) -> [f64; 2] {
        let reach = self.reach(confidence) * self.standard_errors[1] / self.dispersion;
        [
            self.dispersion * libm::exp(-reach),
            self.dispersion * libm::exp(reach),
        ]
    }

    /// Bounds of the probability at an intensity, with this confidence, from the
    /// covariance of the parameters by the delta method on the scale of the quantile.
    #[must_use]
    pub fn probability_bounds(&self, intensity: f64, confidence: f64) -> [f64; 2] {
        let z = libm::log(intensity / self.median) / self.dispersion;
        let (a, b) = (-1.0 / self.dispersion, -z / self.dispersion);
        let [s, t] = self.standard_errors;
        let variance = a * a * s * s + b * b * t * t + 2.0 * a * b * self.covariance;
        let reach = self.reach(confidence) * variance.max(0.0).sqrt();
        [
            normal_distribution(z - reach),
            normal_distribution(z + reach),
        ]
    }
}

/// Intensities (SI), rising, at which one motion was run, with the number of runs at each.
pub(super) type CurveOfRuns = Vec<(f64, f64)>;

impl FragilityFit {
    /// The same with errors of runs that depend on one another, as each motion was run at several intensities: what has
    /// reached the state at one has reached it at higher ones. The likelihood of the counts takes them for independent, and
    /// the more intensities, the smaller its errors become, however few motions there are. These are from its derivatives,
    /// of which each motion is one independent sum (Liang and Zeger 1986, Biometrika 73, 13); the variance of a sum
    /// follows from the intensities between which the fitted curve expects the motion to reach the state.
    pub(super) fn of_curves(
        self,
        counts: &[Counts],
        (curves, records): (&[CurveOfRuns], usize),
    ) -> Self {
        let Self::Lognormal(fit) = self else {
            return self;
        };
        // About the logarithm of the median the intercept is zero.
        let (slope, centre) = (1.0 / fit.dispersion, libm::log(fit.median));
        let used = counts.iter().filter(|c| c.runs > 0 && c.intensity > 0.0);
        let here = likelihood(&used.collect::<Vec<_>>(), 0.0, slope, centre);
        let [aa, ab, bb] = here.hessian;
        let determinant = aa * bb - ab * ab;
        let inverse = [-bb / determinant, ab / determinant, -aa / determinant];
        let mut spread = [0.0; 3];
        for curve in curves {
            of_motion(curve, (slope, centre), &mut spread);
        }
        let [va, vab, vb] = inverse;
        let [sa, sab, sb] = spread;
        // Rows of the product of inverse and spread, then of that and the inverse.
        let rows = [[va, vab], [vab, vb]].map(|[x, y]| [x * sa + y * sab, x * sab + y * sb]);
        let variance = [
            rows[0][0] * va + rows[0][1] * vab,
            rows[0][0] * vab + rows[0][1] * vb,
            rows[1][0] * vab + rows[1][1] * vb,
        ];
        // ln median = centre - intercept / slope, and dispersion = 1 / slope.
        let (of_median, of_dispersion) = (1.0 / slope, 1.0 / (slope * slope));
        Self::Lognormal(Fragility {
            standard_errors: [
                of_median * variance[0].max(0.0).sqrt(),
                of_dispersion * variance[2].max(0.0).sqrt(),
            ],
            covariance: of_median * of_dispersion * variance[1],
            records: Some(records),
            ..fit
        })
    }

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
        let x = libm::log(c.intensity) - centre;
        let z = a + b * x;
        let density = normal_density(z);
        // Both sides of the law by themselves, so that neither tail is lost.
        for (count, side, sign) in [
            (c.reached, normal_distribution(z), 1.0),
            (c.missed(), normal_distribution(-z), -1.0),
        ] {
            if count == 0 {
                continue;
            }
            let n = count as f64;
            let ratio = density / side.max(f64::MIN_POSITIVE);
            l.value += n * libm::log(side.max(f64::MIN_POSITIVE));
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

/// Adds the variance of the derivatives of the likelihood, in intercept and slope, that the runs of one motion bring, of
/// which the curve with this slope about the centre expects where it first reaches the state.
fn of_motion(curve: &CurveOfRuns, (slope, centre): (f64, f64), spread: &mut [f64; 3]) {
    // What each run brings where the state is reached, and where not.
    let runs = curve.iter().map(|(intensity, runs)| {
        let x = libm::log(*intensity) - centre;
        let z = slope * x;
        let density = runs * normal_density(z);
        let [below, above] = [z, -z].map(|z| normal_distribution(z).max(f64::MIN_POSITIVE));
        (x, normal_distribution(z), density / below, -density / above)
    });
    let runs: Vec<(f64, f64, f64, f64)> = runs.collect();
    for first in 0..=runs.len() {
        let sums = runs.iter().enumerate().map(|(i, (x, _, reached, missed))| {
            let of = if i >= first { *reached } else { *missed };
            (of, of * x)
        });
        let (a, b) = sums.fold((0.0, 0.0), |(a, b), (da, db)| (a + da, b + db));
        let before = first.checked_sub(1).map_or(0.0, |before| runs[before].1);
        let by = runs.get(first).map_or(1.0, |run| run.1);
        let part = (by - before).max(0.0);
        spread[0] += part * a * a;
        spread[1] += part * a * b;
        spread[2] += part * b * b;
    }
}

/// A step of Newton's method, of one and the parameter, below which round-off decides which value is the higher.
const NEAR: f64 = 1.0e-6;
/// One after which there is nothing to gain.
const LAST: f64 = 1.0e-11;

/// Part of a step below which no part of it leads higher.
const LEAST_PART: f64 = 1.0e-12;

/// Newton's method with halved steps.
fn maximum(used: &[&Counts]) -> Option<Fragility> {
    let runs: f64 = used.iter().map(|c| c.runs as f64).sum();
    // Around the mean logarithm intercept and slope hardly disturb one another.
    let centre = used
        .iter()
        .map(|c| c.runs as f64 * libm::log(c.intensity))
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
        let size = (step[0].abs() / (1.0 + a.abs())).max(step[1].abs() / (1.0 + b.abs()));
        let mut part = 1.0;
        let next = loop {
            let next = likelihood(used, a + part * step[0], b + part * step[1], centre);
            if size < NEAR || next.value >= here.value || part < LEAST_PART {
                break next;
            }
            part *= 0.5;
        };
        a += part * step[0];
        b += part * step[1];
        here = next;
        if size < LAST || part < LEAST_PART {
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
        median: libm::exp(centre - a / b),
        dispersion: 1.0 / b,
        standard_errors: [variance.max(0.0).sqrt(), spread.abs() * vb.max(0.0).sqrt()],
        covariance: spread * (median[0] * vab + median[1] * vb),
        log_likelihood: here.value,
        records: None,
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

    /// Counts that cannot be are those of which all reached the state.
    #[test]
    fn more_that_reached_the_state_than_runs_are_all_of_them() {
        let more = fit(&counts(&[(0.2, 40, 6), (0.5, 40, 27), (0.8, 40, 41)]));
        let all = fit(&counts(&[(0.2, 40, 6), (0.5, 40, 27), (0.8, 40, 40)]));
        let median = |fit: FragilityFit| match fit {
            FragilityFit::Lognormal(fit) => fit.median,
            other => panic!("{other:?}"),
        };
        assert!((median(more) / median(all) - 1.0).abs() < 0.05);
    }

    /// With two intensities the curve goes through both fractions: a closed form.
    #[test]
    fn two_intensities_are_met() {
        let f = lognormal(&[(0.2, 40, 6), (0.5, 40, 27)]);
        let (z1, z2) = (normal_quantile(6.0 / 40.0), normal_quantile(27.0 / 40.0));
        let dispersion = libm::log(0.5_f64 / 0.2) / (z2 - z1);
        let median = 0.2 * libm::exp(-z1 * dispersion);
        assert!((f.dispersion / dispersion - 1.0).abs() < 1e-12);
        assert!((f.median / median - 1.0).abs() < 1e-12);
        assert!((f.probability(0.5) - 27.0 / 40.0).abs() < 1e-12);
        // Each quantile has the variance p (1 - p) / (n density^2), by the delta method
        // on its own fraction, and the two are independent.
        let variance = |p: f64| p * (1.0 - p) / (40.0 * normal_density(normal_quantile(p)).powi(2));
        let span = libm::log(0.5_f64 / 0.2);
        let spread =
            span / (z2 - z1).powi(2) * (variance(6.0 / 40.0) + variance(27.0 / 40.0)).sqrt();
        assert!((f.standard_errors[1] / spread - 1.0).abs() < 1e-10);
        let [low, high] = f.probability_bounds(0.5, 0.95);
        let reach = 1.959_963_984_540_054 * variance(27.0 / 40.0).sqrt();
        assert!((normal_quantile(high) - z2 - reach).abs() < 1e-9);
        assert!((normal_quantile(low) - z2 + reach).abs() < 1e-9);
    }

    /// The same of forty records at both intensities: fractions of the same records have the covariance
    /// p1 (1 - p2) / 40, and the rest is the delta method.
    #[test]
    fn fractions_of_the_same_records_go_together() {
        let table = counts(&[(0.2, 40, 6), (0.5, 40, 27)]);
        let curves = vec![vec![(0.2, 1.0), (0.5, 1.0)]; 40];
        let FragilityFit::Lognormal(f) = fit(&table).of_curves(&table, (&curves, 40)) else {
            panic!("a curve goes through two fractions");
        };
        let p = [6.0 / 40.0, 27.0 / 40.0];
        let z = p.map(normal_quantile);
        let density = z.map(normal_density);
        let variance = |i: usize| p[i] * (1.0 - p[i]) / (40.0 * density[i] * density[i]);
        let together = p[0] * (1.0 - p[1]) / (40.0 * density[0] * density[1]);
        let rise = z[1] - z[0];
        let span = libm::log(0.5_f64 / 0.2);
        let spread = span / (rise * rise) * (variance(0) + variance(1) - 2.0 * together).sqrt();
        assert!((f.standard_errors[1] / spread - 1.0).abs() < 1e-9, "{f:?}");
        // ln median = ln 0.2 - z1 span / (z2 - z1).
        let by = [-span * z[1] / (rise * rise), span * z[0] / (rise * rise)];
        let of_median = by[0] * by[0] * variance(0) + by[1] * by[1] * variance(1);
        let of_median = (of_median + 2.0 * by[0] * by[1] * together).sqrt();
        assert!(
            (f.standard_errors[0] / of_median - 1.0).abs() < 1e-9,
            "{f:?}"
        );
    }

    /// Sets of forty records that reach the state at random intensities of one lognormal distribution, all run at so many
    /// intensities: medians and dispersions of the fits have the mean standard errors, and bounds hold the true ones
    /// about as often as they say, however many intensities there are. The likelihood alone gives errors of half the size
    /// at 24 intensities.
    #[test]
    fn errors_are_those_of_sets_of_records() {
        use crate::mixing::unit;
        const SETS: u64 = 600;
        const DISPERSION: f64 = 0.3;
        for (records, levels) in [(40_u64, 8_u64), (40, 24), (10, 24)] {
            let intensity =
                |level| libm::pow(5.0_f64, 2.0 * level as f64 / (levels - 1) as f64 - 1.0);
            let intensities: Vec<f64> = (0..levels).map(intensity).collect();
            let curves = vec![intensities.iter().map(|i| (*i, 1.0)).collect(); records as usize];
            let (mut found, mut held, mut errors, mut alone) = (Vec::new(), [0; 2], [0.0; 2], 0.0);
            for set in 0..SETS {
                let first = (0..records).map(|record| {
                    let random = normal_quantile(unit(&[7, levels, set, records, record]));
                    libm::exp(DISPERSION * random)
                });
                let first: Vec<f64> = first.collect();
                let row = |intensity: &f64| Counts {
                    intensity: *intensity,
                    runs: records as usize,
                    reached: first.iter().filter(|x| *x < intensity).count(),
                };
                let table: Vec<Counts> = intensities.iter().map(row).collect();
                let (of_counts, of_curves) = (
                    fit(&table),
                    fit(&table).of_curves(&table, (&curves, records as usize)),
                );
                let (FragilityFit::Lognormal(counted), FragilityFit::Lognormal(f)) =
                    (of_counts, of_curves)
                else {
                    continue;
                };
                found.push([libm::log(f.median), f.dispersion]);
                let [low, high] = f.median_bounds(0.95);
                held[0] += usize::from(low < 1.0 && 1.0 < high);
                let [low, high] = f.dispersion_bounds(0.95);
                held[1] += usize::from(low < DISPERSION && DISPERSION < high);
                errors[0] += f.standard_errors[0];
                errors[1] += f.standard_errors[1];
                alone += counted.standard_errors[0];
            }
            let sets = found.len() as f64;
            assert!(sets > 0.95 * SETS as f64);
            for which in 0..2 {
                let mean = found.iter().map(|f| f[which]).sum::<f64>() / sets;
                let squares = found.iter().map(|f| (f[which] - mean).powi(2)).sum::<f64>();
                let deviation = (squares / (sets - 1.0)).sqrt();
                let error = errors[which] / sets;
                // Of few records the likelihood itself is off.
                assert!(
                    records == 10 || (error / deviation - 1.0).abs() < 0.1,
                    "{levels} {which}: {error} {deviation}"
                );
                let held = held[which] as f64 / sets;
                assert!((0.91..0.98).contains(&held), "{levels} {which}: {held}");
            }
            if (records, levels) == (40, 24) {
                assert!(alone < 0.55 * errors[0], "{alone} {errors:?}");
            }
        }
    }

    /// Quantiles of Student's t by SciPy 1.17 (`t.ppf(0.975, n - 1)`).
    #[test]
    fn few_records_have_wider_bounds() {
        let counted = lognormal(&EXAMPLE);
        for (records, reach) in [
            (7, 2.446_911_851_144_979),
            (10, 2.262_157_162_798_205),
            (40, 2.022_690_920_036_761),
        ] {
            let of_records = Fragility {
                records: Some(records),
                ..counted
            };
            assert!(
                (of_records.reach(0.95) / reach - 1.0).abs() < 1e-9,
                "{records}"
            );
        }
        assert!((counted.reach(0.95) - 1.959963984540054).abs() < 1e-12);
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
