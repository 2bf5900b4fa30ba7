//! How well a fitted fragility describes what the runs say.

use std::fmt;

use pounding_ground_motion::distributions::chi_square_exceedance;

use super::fragility::{Counts, Fragility, FragilityFit};

/// Below this probability a fit is poor.
pub const POOR: f64 = 0.05;
/// Records that are expected in a class at least: classes with fewer are joined to the next
/// (Cochran 1954, Biometrics 10, 417).
const LEAST_EXPECTED: f64 = 1.0;
/// Records that must reach a state, and that must miss it, for a fit that rests on more than a
/// few.
const FEW: usize = 5;
/// Intensities over which a fraction that stays the same is a plateau.
const PLATEAU: usize = 3;

/// Where one record reaches a state: between two neighbouring intensities.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Capacity {
    /// Number of the first intensity at which it reaches the state; the number of intensities
    /// if it never does.
    pub first: usize,
    /// Whether it misses the state again at a higher intensity.
    pub returns: bool,
}

/// Pearson's test of a lognormal fragility on the capacities of the records.
///
/// Counts at different intensities come from the same records and depend on one another;
/// the intensities at which records first reach the state do not. They are counted between the
/// intensities of the analysis and held against what the curve expects there. Two parameters
/// were fitted, which leaves classes less three degrees of freedom.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GoodnessOfFit {
    /// Pearson's sum of squares over expectations (-).
    pub statistic: f64,
    /// Degrees of freedom.
    pub degrees_of_freedom: usize,
    /// Probability of a greater sum if the curve holds, by the chi-square distribution.
    pub p_value: f64,
    /// Greatest distance of a fraction from the curve (-), with its intensity (SI).
    pub distance: (f64, f64),
}

/// What a reader of a fragility must know.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FitRemark {
    /// The test refuses the curve.
    Poor {
        /// Its probability.
        p_value: f64,
    },
    /// Too few records reach the state.
    FewReach {
        /// Records that reach it at some intensity.
        records: usize,
        /// Of so many.
        of: usize,
    },
    /// Too few records miss the state.
    FewMiss {
        /// Records that miss it at some intensity.
        records: usize,
        /// Of so many.
        of: usize,
    },
    /// The median lies beyond the intensities of the analysis: the curve is extrapolated.
    MedianBeyond {
        /// Highest intensity (SI).
        highest: f64,
    },
    /// The fraction stays the same over the last intensities, which no lognormal curve does.
    Plateau {
        /// Fraction (-).
        fraction: f64,
        /// Intensity from which on (SI).
        from: f64,
    },
    /// Records that reach the state miss it again at a higher intensity.
    Returns {
        /// Records that do.
        records: usize,
        /// Of so many.
        of: usize,
    },
    /// Too few classes for a test.
    NotTested,
}

impl fmt::Display for FitRemark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Poor { p_value } => write!(
                f,
                "the lognormal curve does not describe the records (p = {p_value:.1e}): use the counts"
            ),
            Self::FewReach { records, of } => {
                write!(f, "only {records} of {of} records reach it")
            }
            Self::FewMiss { records, of } => write!(f, "only {records} of {of} records miss it"),
            Self::MedianBeyond { .. } => write!(
                f,
                "the median lies beyond the intensities: the curve is extrapolated"
            ),
            Self::Plateau { fraction, .. } => write!(
                f,
                "the fraction stays at {fraction:.2} over the last intensities, which no lognormal curve does"
            ),
            Self::Returns { records, of } => write!(
                f,
                "{records} of {of} records reach it and miss it again at a higher intensity"
            ),
            Self::NotTested => write!(
                f,
                "too few intensities at which some records reach it and others do not: the fit cannot be tested"
            ),
        }
    }
}

/// The test of a fitted curve on the capacities of records, between intensities that rise;
/// `None` with fewer than four classes.
pub(super) fn test(
    fragility: &Fragility,
    counts: &[Counts],
    capacities: &[Capacity],
) -> Option<GoodnessOfFit> {
    let records = capacities.len() as f64;
    let below = |class: usize| match counts.get(class) {
        Some(c) => fragility.probability(c.intensity),
        None => 1.0,
    };
    // Expected and observed in each class; classes that expect too few are joined.
    let mut classes: Vec<(f64, f64)> = Vec::new();
    let mut open = (0.0, 0.0);
    let mut reached = 0.0;
    for class in 0..=counts.len() {
        let upper = below(class);
        open.0 += records * (upper - reached).max(0.0);
        open.1 += capacities.iter().filter(|c| c.first == class).count() as f64;
        reached = upper;
        if open.0 >= LEAST_EXPECTED {
            classes.push(open);
            open = (0.0, 0.0);
        }
    }
    if let Some(last) = classes.last_mut() {
        last.0 += open.0;
        last.1 += open.1;
    }
    let degrees_of_freedom = classes.len().checked_sub(3).filter(|d| *d > 0)?;
    let statistic = classes.iter().map(|(e, o)| (o - e).powi(2) / e).sum();
    let distances = counts.iter().filter(|c| c.runs > 0).map(|c| {
        let fraction = c.reached as f64 / c.runs as f64;
        (
            (fraction - fragility.probability(c.intensity)).abs(),
            c.intensity,
        )
    });
    let distance = distances.max_by(|a, b| a.0.total_cmp(&b.0));
    Some(GoodnessOfFit {
        statistic,
        degrees_of_freedom,
        p_value: chi_square_exceedance(statistic, degrees_of_freedom),
        distance: distance.unwrap_or((f64::NAN, f64::NAN)),
    })
}

/// What must be said of a fit.
pub(super) fn remarks(
    fit: &FragilityFit,
    goodness: Option<&GoodnessOfFit>,
    counts: &[Counts],
    capacities: &[Capacity],
) -> Vec<FitRemark> {
    let of = capacities.len();
    let mut remarks = Vec::new();
    let returns = capacities.iter().filter(|c| c.returns).count();
    if returns > 0 {
        remarks.push(FitRemark::Returns {
            records: returns,
            of,
        });
    }
    let FragilityFit::Lognormal(fragility) = fit else {
        return remarks;
    };
    match goodness {
        Some(test) if test.p_value < POOR => remarks.push(FitRemark::Poor {
            p_value: test.p_value,
        }),
        Some(_) => {}
        None => remarks.push(FitRemark::NotTested),
    }
    let reach = capacities.iter().filter(|c| c.first < counts.len()).count();
    if reach < FEW {
        remarks.push(FitRemark::FewReach { records: reach, of });
    }
    let miss = capacities.iter().filter(|c| c.first > 0).count();
    if miss < FEW {
        remarks.push(FitRemark::FewMiss { records: miss, of });
    }
    let highest = counts.iter().fold(0.0_f64, |m, c| m.max(c.intensity));
    if fragility.median > highest {
        remarks.push(FitRemark::MedianBeyond { highest });
    }
    remarks.extend(plateau(counts));
    remarks
}

/// Whether the fraction of records stays the same, between none and all, over the last
/// intensities.
fn plateau(counts: &[Counts]) -> Option<FitRemark> {
    let made: Vec<&Counts> = counts.iter().filter(|c| c.runs > 0).collect();
    let last = made.last()?;
    let fraction = last.reached as f64 / last.runs as f64;
    let same =
        |c: &&&Counts| (c.reached as f64 / c.runs as f64 - fraction).abs() < 0.5 / c.runs as f64;
    let level = made.iter().rev().take_while(same).count();
    let from = made[made.len() - level].intensity;
    let between = last.reached > 0 && last.reached < last.runs;
    (between && level >= PLATEAU).then_some(FitRemark::Plateau { fraction, from })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use crate::ida::fit;

    fn capacities(classes: &[usize]) -> Vec<Capacity> {
        let classes = classes.iter().enumerate();
        classes
            .flat_map(|(first, n)| {
                let one = Capacity {
                    first,
                    returns: false,
                };
                vec![one; *n]
            })
            .collect()
    }

    /// Counts of records by the intensity at which they reach the state.
    fn counts(intensities: &[f64], classes: &[usize]) -> Vec<Counts> {
        let runs = classes.iter().sum();
        let reached = |level: usize| classes[..=level].iter().sum();
        let intensities = intensities.iter().enumerate();
        intensities
            .map(|(level, intensity)| Counts {
                intensity: *intensity,
                runs,
                reached: reached(level),
            })
            .collect()
    }

    fn curve(median: f64, dispersion: f64) -> Fragility {
        Fragility {
            median,
            dispersion,
            standard_errors: [0.0; 2],
            covariance: 0.0,
            log_likelihood: 0.0,
        }
    }

    /// By hand: a curve with median 1 and dispersion 1 puts 0.158655, 0.341345, 0.341345 and
    /// 0.158655 of the records between exp(-1), 1 and exp(1). Of 100 records 20, 30, 35 and 15
    /// give (4.1345^2 + 0.8655^2) / 15.8655 + (4.1345^2 + 0.8655^2) / 34.1345 = 1.647535, with
    /// one degree of freedom: p = erfc(sqrt(1.647535 / 2)) = 0.19930.
    #[test]
    fn four_classes_by_hand() {
        let e = std::f64::consts::E;
        let classes = [20, 30, 35, 15];
        let counts = counts(&[1.0 / e, 1.0, e], &classes);
        let test = test(&curve(1.0, 1.0), &counts, &capacities(&classes)).unwrap();
        assert_eq!(test.degrees_of_freedom, 1);
        let expected = (4.134_475_f64.powi(2) + 0.865_525_f64.powi(2)) / 15.865_525
            + (4.134_475_f64.powi(2) + 0.865_525_f64.powi(2)) / 34.134_475;
        assert!((test.statistic - expected).abs() < 1e-5, "{test:?}");
        let p = libm_erfc((0.5 * expected).sqrt());
        assert!((test.p_value - p).abs() < 1e-6, "{test:?}");
        assert!((test.distance.0 - 0.041_344_746).abs() < 1e-8, "{test:?}");
    }

    /// The complementary error function by its definition: Simpson's rule over the density.
    fn libm_erfc(x: f64) -> f64 {
        let n = 20_000;
        let h = 12.0 / f64::from(n);
        let at = |i: i32| (-(x + h * f64::from(i)).powi(2)).exp();
        let inner: f64 = (1..n)
            .map(|i| if i % 2 == 1 { 4.0 * at(i) } else { 2.0 * at(i) })
            .sum();
        (at(0) + inner + at(n)) * h / 3.0 * 2.0 / std::f64::consts::PI.sqrt()
    }

    /// Classes that expect less than one record are joined, and too few classes are no test.
    #[test]
    fn small_classes_are_joined() {
        let intensities = [1e-6, 1e-5, 0.4, 1.0, 2.5, 1e5, 1e6];
        let classes = [0, 0, 18, 32, 32, 18, 0, 0];
        let counts = counts(&intensities, &classes);
        let found = test(&curve(1.0, 1.0), &counts, &capacities(&classes)).unwrap();
        assert_eq!(found.degrees_of_freedom, 1);
        assert!(found.p_value > 0.5);
        assert_eq!(
            test(&curve(1.0, 1.0), &counts[3..4], &capacities(&[50, 50])),
            None
        );
    }

    /// Half of the records reach the state early and the others never: the fraction stays at a
    /// half, the fitted curve does not, and the test refuses it.
    #[test]
    fn a_plateau_is_a_poor_fit() {
        let intensities: Vec<f64> = (0..8).map(|i| 0.1 * 1.5_f64.powi(i)).collect();
        let classes = [2, 8, 8, 2, 0, 0, 0, 0, 20];
        let counts = counts(&intensities, &classes);
        let capacities = capacities(&classes);
        let fitted = fit(&counts);
        let FragilityFit::Lognormal(f) = fitted else {
            panic!("{fitted:?}")
        };
        let goodness = test(&f, &counts, &capacities);
        assert!(goodness.unwrap().p_value < 1e-3, "{goodness:?}");
        let said = remarks(&fitted, goodness.as_ref(), &counts, &capacities);
        assert!(matches!(said[0], FitRemark::Poor { .. }), "{said:?}");
        let plateau = FitRemark::Plateau {
            fraction: 0.5,
            from: intensities[3],
        };
        assert!(said.contains(&plateau), "{said:?}");
    }

    /// Records drawn at the quantiles of a lognormal distribution: nothing to say. Three of
    /// forty that reach it, far up: few, and a median beyond the intensities.
    #[test]
    fn good_and_scarce_counts() {
        let intensities: Vec<f64> = (0..8).map(|i| 0.2 * 1.5_f64.powi(i)).collect();
        let f = curve(0.9, 0.5);
        let bounds = intensities
            .iter()
            .map(|x| (40.0 * f.probability(*x)).round() as usize);
        let bounds: Vec<usize> = bounds.chain([40]).collect();
        let before = |i: usize| if i == 0 { 0 } else { bounds[i - 1] };
        let classes: Vec<usize> = (0..bounds.len()).map(|i| bounds[i] - before(i)).collect();
        let table = counts(&intensities, &classes);
        let all = capacities(&classes);
        let fitted = fit(&table);
        let FragilityFit::Lognormal(fragility) = fitted else {
            panic!("{fitted:?}")
        };
        let goodness = test(&fragility, &table, &all).unwrap();
        assert!(goodness.p_value > 0.5, "{goodness:?}");
        assert!(remarks(&fitted, Some(&goodness), &table, &all).is_empty());
        let classes = [0, 0, 0, 0, 0, 1, 1, 1, 37];
        let table = counts(&intensities, &classes);
        let all = capacities(&classes);
        let fitted = fit(&table);
        let said = remarks(&fitted, None, &table, &all);
        assert!(said.contains(&FitRemark::FewReach { records: 3, of: 40 }));
        assert!(said.contains(&FitRemark::NotTested));
        let beyond = |r: &FitRemark| matches!(r, FitRemark::MedianBeyond { .. });
        assert!(said.iter().any(beyond), "{said:?}");
    }
}
