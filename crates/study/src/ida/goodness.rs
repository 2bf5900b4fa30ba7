//! How well a fitted fragility describes what the runs say.

use std::fmt;

use pounding_catalogue::STANDARD_GRAVITY;
use pounding_ground_motion::distributions::chi_square_exceedance;

use super::bootstrap::RESAMPLES;
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
    /// The analysis has too few records.
    FewRecords {
        /// So many.
        records: usize,
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
    /// The median lies above the intensities of the analysis: the curve is extrapolated.
    MedianBeyond {
        /// Highest intensity (SI).
        highest: f64,
    },
    /// The median lies below the intensities of the analysis: the curve is extrapolated.
    MedianBelow {
        /// Lowest intensity (SI).
        lowest: f64,
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
    /// The hazard curve begins where the state is reached already, and the frequency leaves out
    /// what is below.
    BelowHazard {
        /// First intensity of the curve.
        first: ShownIntensity,
        /// Probability of the state there (-).
        probability: f64,
        /// Where the counts give no curve: the intensity right above which the state is taken as
        /// reached, though nobody reaches it there.
        assumed: Option<ShownIntensity>,
        /// What is left out if the first power law went on (1/year).
        uncounted: f64,
    },
    /// The counts give no curve, and the frequency is that of a state which is reached right above
    /// an intensity at which nobody reaches it.
    AtMost {
        /// This intensity.
        above: ShownIntensity,
    },
    /// The bootstrap has no upper bound of the frequency.
    NoUpperBound {
        /// Sets whose records reach the state at the lowest intensity already, some or all.
        above: usize,
        /// Sets whose counts give no fragility.
        unknown: usize,
    },
    /// The bootstrap has no lower bound of the frequency.
    NoLowerBound {
        /// Sets whose counts give no fragility.
        unknown: usize,
    },
    /// Part of the frequency comes from above the hazard curve.
    AboveHazard {
        /// Last intensity of the curve.
        last: ShownIntensity,
        /// Which part (-).
        share: f64,
    },
    /// Part of the frequency comes from below the intensities of the analysis.
    FromBelow {
        /// Lowest intensity.
        lowest: ShownIntensity,
        /// Which part (-).
        share: f64,
    },
    /// Part of the frequency comes from above the intensities of the analysis.
    FromAbove {
        /// Highest intensity.
        highest: ShownIntensity,
        /// Which part (-).
        share: f64,
    },
}

impl FitRemark {
    /// Whether it is of the frequency, and not of the fragility.
    #[must_use]
    pub fn is_of_frequency(&self) -> bool {
        matches!(
            self,
            Self::BelowHazard { .. }
                | Self::AtMost { .. }
                | Self::NoUpperBound { .. }
                | Self::NoLowerBound { .. }
                | Self::AboveHazard { .. }
                | Self::FromBelow { .. }
                | Self::FromAbove { .. }
        )
    }
}

/// An intensity as people read it: accelerations in g.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShownIntensity {
    /// Value (SI).
    pub si: f64,
    /// Whether it is an acceleration; else it is a velocity.
    pub in_g: bool,
}

impl fmt::Display for ShownIntensity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.in_g {
            true => write!(f, "{} g", figures(self.si / STANDARD_GRAVITY)),
            false => write!(f, "{} m/s", figures(self.si)),
        }
    }
}

/// Three significant figures.
fn figures(x: f64) -> String {
    let size = x.abs();
    if !(1e-3..1e4).contains(&size) {
        return format!("{x:.2e}");
    }
    let decimals = (2.0 - size.log10().floor()).max(0.0) as usize;
    format!("{x:.decimals$}")
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
                "the median lies above the intensities: the curve is extrapolated"
            ),
            Self::MedianBelow { .. } => write!(
                f,
                "the median lies below the intensities: the curve is extrapolated"
            ),
            Self::FewRecords { records } => write!(f, "there are only {records} records"),
            Self::BelowHazard {
                first,
                probability,
                assumed,
                uncounted,
            } => {
                let reached = match assumed {
                    Some(above) => format!(
                        "above {above}, from which on the state is taken as reached, as no record reaches it up to there: the frequency is neither an estimate nor a bound, as it and its bounds leave out"
                    ),
                    None => format!(
                        "where the probability of the state is {} and not zero: the frequency and its bounds are too low by",
                        figures(*probability)
                    ),
                };
                write!(
                    f,
                    "the hazard curve begins at {first}, {reached} what weaker motions add ({} if the first power law of the curve went on); begin the curve lower",
                    match uncounted.is_finite() {
                        true => format!("{} per year", figures(*uncounted)),
                        false => "without bound".to_owned(),
                    }
                )
            }
            Self::AtMost { above } => write!(
                f,
                "the frequency is an upper bound, as if the state were reached right above {above}, where no record reaches it: the counts give no curve; add intensities from there on"
            ),
            Self::NoUpperBound { above, unknown } => {
                write!(
                    f,
                    "no upper bound of the frequency: of {RESAMPLES} sets of records "
                )?;
                match (*above, *unknown) {
                    (above, 0) => write!(
                        f,
                        "{above} reach the state at the lowest intensity already; add lower intensities"
                    ),
                    (0, unknown) => write!(f, "{unknown} have no fragility; add records"),
                    (above, unknown) => write!(
                        f,
                        "{above} reach the state at the lowest intensity already and {unknown} have no fragility; add lower intensities and records"
                    ),
                }
            }
            Self::NoLowerBound { unknown } => write!(
                f,
                "no lower bound of the frequency: of {RESAMPLES} sets of records {unknown} have no fragility; add records"
            ),
            Self::AboveHazard { last, share } => write!(
                f,
                "{:.0} % of the frequency comes from above {last}, where the hazard curve ends and its last power law is taken to go on; end the curve higher",
                100.0 * share
            ),
            Self::FromBelow { lowest, share } => write!(
                f,
                "{:.0} % of the frequency comes from below {lowest}, where no run was made; add lower intensities",
                100.0 * share
            ),
            Self::FromAbove { highest, share } => write!(
                f,
                "{:.0} % of the frequency comes from above {highest}, where no run was made; add higher intensities",
                100.0 * share
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
    let miss = capacities.iter().filter(|c| c.first > 0 || c.returns);
    let miss = miss.count();
    if of < FEW {
        remarks.push(FitRemark::FewRecords { records: of });
    }
    if reach < FEW.min(of) {
        remarks.push(FitRemark::FewReach { records: reach, of });
    }
    if miss < FEW.min(of) {
        remarks.push(FitRemark::FewMiss { records: miss, of });
    }
    let made = || counts.iter().filter(|c| c.runs > 0).map(|c| c.intensity);
    let highest = made().fold(0.0, f64::max);
    if fragility.median > highest {
        remarks.push(FitRemark::MedianBeyond { highest });
    }
    let lowest = made().fold(f64::INFINITY, f64::min);
    if fragility.median < lowest {
        remarks.push(FitRemark::MedianBelow { lowest });
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

    /// A median below the intensities, records that reach a state and miss it again, and few
    /// records in all.
    #[test]
    fn low_medians_and_few_records() {
        let table = |reached: &[usize], runs: usize| -> Vec<Counts> {
            let levels = reached.iter().enumerate();
            let one = |(i, reached): (usize, &usize)| Counts {
                intensity: 0.5 + 0.1 * i as f64,
                runs,
                reached: *reached,
            };
            levels.map(one).collect()
        };
        let at = |first: usize, returns: bool| Capacity { first, returns };
        let counts = table(&[7, 8, 9], 10);
        let all = [
            vec![at(0, false); 7],
            vec![at(1, false), at(2, false), at(3, false)],
        ]
        .concat();
        let said = remarks(&fit(&counts), None, &counts, &all);
        let below = FitRemark::MedianBelow { lowest: 0.5 };
        assert!(said.contains(&below), "{said:?}");
        assert!(said.contains(&FitRemark::FewMiss { records: 3, of: 10 }));
        // One of ten reaches it at once, misses it, and reaches it again: it does miss it.
        let counts = table(&[10, 9, 10, 10], 10);
        let all = [vec![at(0, false); 9], vec![at(0, true)]].concat();
        let fitted = FragilityFit::Lognormal(curve(0.2, 0.5));
        let said = remarks(&fitted, None, &counts, &all);
        assert!(
            said.contains(&FitRemark::FewMiss { records: 1, of: 10 }),
            "{said:?}"
        );
        // Of three records all are few, which is said once.
        let counts = table(&[1, 2, 3], 3);
        let all = [at(0, false), at(1, false), at(2, true)];
        let said = remarks(&fitted, None, &counts, &all);
        assert!(
            said.contains(&FitRemark::FewRecords { records: 3 }),
            "{said:?}"
        );
        assert!(
            !said.iter().any(|r| matches!(r, FitRemark::FewReach { .. })),
            "{said:?}"
        );
        assert!(said.contains(&FitRemark::FewMiss { records: 2, of: 3 }));
        let shown = |si, in_g| ShownIntensity { si, in_g }.to_string();
        assert_eq!(shown(0.5 * STANDARD_GRAVITY, true), "0.500 g");
        assert_eq!(shown(12.34, false), "12.3 m/s");
    }

    /// What a curve that begins too high leaves out is said with a probability that is not zero.
    #[test]
    fn a_late_hazard_curve_is_said() {
        let shown = |si: f64| ShownIntensity { si, in_g: true };
        let said = |assumed| {
            let remark = FitRemark::BelowHazard {
                first: shown(0.02 * STANDARD_GRAVITY),
                probability: 0.000_123,
                assumed,
                uncounted: 0.003_41,
            };
            remark.to_string()
        };
        assert_eq!(
            said(None),
            "the hazard curve begins at 0.0200 g, where the probability of the state is 1.23e-4 and not zero: the frequency and its bounds are too low by what weaker motions add (0.00341 per year if the first power law of the curve went on); begin the curve lower"
        );
        let assumed = said(Some(shown(STANDARD_GRAVITY)));
        assert!(
            assumed.contains(
                "nor a bound, as it and its bounds leave out what weaker motions add (0.00341"
            ),
            "{assumed}"
        );
    }
}
