//! How well a fitted fragility describes what the runs say.

use std::fmt;

use pounding_catalogue::STANDARD_GRAVITY;
use pounding_catalogue::wording::counted;
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

/// What the runs of an analysis say of a state beside its counts, by how they were made.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Evidence {
    /// Each record, or record with a structure, at every intensity: where each first reaches the state.
    Curves {
        /// One of each whose runs tell.
        capacities: Vec<Capacity>,
        /// What each of them is.
        of: Sampled,
    },
    /// Others at every intensity, as in a multiple stripe analysis: counts do not depend on one another.
    Stripes,
    /// Some at one intensity, and some at several but not at all.
    Mixed,
}

/// What a state is counted of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sampled {
    /// Records.
    Records,
    /// Records with one of several structures each.
    RecordsWithStructures,
    /// Runs at their one intensity.
    Runs,
}

impl fmt::Display for Sampled {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Records => "records",
            Self::RecordsWithStructures => "records with a structure",
            Self::Runs => "runs",
        })
    }
}

/// Why a fit is not tested.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Untested {
    /// Too few classes.
    FewClasses,
    /// Some records have runs at one intensity, and some at several but not at all.
    Mixed,
}

impl fmt::Display for Untested {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::FewClasses => {
                "too few intensities at which some records reach it and others do not: the fit cannot be tested"
            }
            Self::Mixed => {
                "some records have runs at several intensities, but not one at each, so that counts depend on one another in part: the fit cannot be tested"
            }
        })
    }
}

/// Pearson's test of a lognormal fragility.
///
/// Counts at different intensities that come from the same records depend on one another;
/// the intensities at which records first reach the state do not. They are counted between the
/// intensities of the analysis and held against what the curve expects there. Two parameters
/// were fitted, which leaves classes less three degrees of freedom.
///
/// Counts of other records at every intensity are binomial, and held against what the curve expects by
/// themselves: classes less two degrees of freedom.
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
        /// What they are.
        sampled: Sampled,
    },
    /// Too few records miss the state.
    FewMiss {
        /// Records that miss it at some intensity.
        records: usize,
        /// Of so many.
        of: usize,
        /// What they are.
        sampled: Sampled,
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
        /// What they are.
        sampled: Sampled,
    },
    /// There is no test.
    NotTested(Untested),
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
        /// Sets that were drawn.
        sets: usize,
        /// Sets whose records reach the state at the lowest intensity already, some or all.
        above: usize,
        /// Sets whose counts give no fragility.
        unknown: usize,
    },
    /// The bootstrap has no lower bound of the frequency.
    NoLowerBound {
        /// Sets that were drawn.
        sets: usize,
        /// Sets whose records reach the state nowhere, or some at the highest intensity alone.
        below: usize,
        /// Sets whose counts give no fragility.
        unknown: usize,
    },
    /// The bootstrap has no bounds of the frequency at so high a confidence.
    NoBoundsSoSure {
        /// Confidence (-).
        confidence: f64,
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
                | Self::NoBoundsSoSure { .. }
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
    let decimals = (2.0 - libm::log10(size).floor()).max(0.0) as usize;
    format!("{x:.decimals$}")
}

/// What the sets have of which nothing is known.
const NO_FRAGILITY: &str = "have no fragility";

/// Says why a bound of a frequency is missing: of so many sets some are, and what to add.
fn no_bound(
    f: &mut fmt::Formatter<'_>,
    (bound, sets): (&str, usize),
    reasons: [(usize, &str, &str); 2],
) -> fmt::Result {
    let reasons = || reasons.iter().filter(|(count, ..)| *count > 0);
    let are: Vec<String> = reasons()
        .map(|(count, what, _)| format!("{count} {what}"))
        .collect();
    let add: Vec<&str> = reasons().map(|(.., add)| *add).collect();
    write!(
        f,
        "no {bound} bound of the frequency: of {sets} sets of records {}; add {}",
        are.join(" and "),
        add.join(" and ")
    )
}

impl fmt::Display for FitRemark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Poor { p_value } => write!(
                f,
                "the lognormal curve does not describe the records (p = {p_value:.1e}): use the counts"
            ),
            Self::FewReach {
                records,
                of,
                sampled,
            } => {
                write!(f, "only {records} of {of} {sampled} reach it")
            }
            Self::FewMiss {
                records,
                of,
                sampled,
            } => write!(f, "only {records} of {of} {sampled} miss it"),
            Self::MedianBeyond { .. } => write!(
                f,
                "the median lies above the intensities: the curve is extrapolated"
            ),
            Self::MedianBelow { .. } => write!(
                f,
                "the median lies below the intensities: the curve is extrapolated"
            ),
            Self::FewRecords { records } => write!(
                f,
                "there {} only {}",
                if *records == 1 { "is" } else { "are" },
                counted(*records as u64, "record")
            ),
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
                "the frequency is an upper bound, as if the state were reached right above {above}, where no record of the study reaches it: the counts give no curve; add intensities from there on"
            ),
            Self::NoUpperBound {
                sets,
                above,
                unknown,
            } => no_bound(
                f,
                ("upper", *sets),
                [
                    (
                        *above,
                        "reach the state at the lowest intensity already",
                        "lower intensities",
                    ),
                    (*unknown, NO_FRAGILITY, "records"),
                ],
            ),
            Self::NoLowerBound {
                sets,
                below,
                unknown,
            } => no_bound(
                f,
                ("lower", *sets),
                [
                    (
                        *below,
                        "reach the state nowhere, or some at the highest intensity alone",
                        "higher intensities",
                    ),
                    (*unknown, NO_FRAGILITY, "records"),
                ],
            ),
            Self::NoBoundsSoSure { confidence } => write!(
                f,
                "no bounds of the frequency at {} % confidence, which too few sets of records lie beyond; ask for 99.9 % or less",
                100.0 * confidence
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
            Self::Returns {
                records,
                of,
                sampled,
            } => write!(
                f,
                "{records} of {of} {sampled} reach it and miss it again at a higher intensity"
            ),
            Self::NotTested(why) => why.fmt(f),
        }
    }
}

/// The test of a fitted curve on what the runs say, between intensities that rise; `None` with too few
/// classes. Runs that are alike count as independent ones over their design effect (Rao and Scott 1981, J. Am. Stat.
/// Assoc. 76, 221).
pub(super) fn test(
    fragility: &Fragility,
    counts: &[Counts],
    (evidence, design_effect): (&Evidence, f64),
) -> Option<GoodnessOfFit> {
    let weight = 1.0 / design_effect;
    let (statistic, degrees_of_freedom) = match evidence {
        Evidence::Curves { capacities, .. } => {
            of_capacities(fragility, counts, (capacities, weight))?
        }
        Evidence::Stripes => of_stripes(fragility, counts, weight)?,
        Evidence::Mixed => return None,
    };
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

/// Pearson's sum over classes of capacities, and its degrees of freedom; `None` with fewer than four
/// classes.
fn of_capacities(
    fragility: &Fragility,
    counts: &[Counts],
    (capacities, weight): (&[Capacity], f64),
) -> Option<(f64, usize)> {
    let records = weight * capacities.len() as f64;
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
        open.1 += weight * capacities.iter().filter(|c| c.first == class).count() as f64;
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
    Some((statistic, degrees_of_freedom))
}

/// Runs at one intensity, or at neighbouring ones that are joined, which are expected to reach the state.
#[derive(Debug, Clone, Copy, Default)]
struct Stripe {
    runs: f64,
    reached: f64,
    expected: f64,
    variance: f64,
}

impl Stripe {
    fn with(self, other: Self) -> Self {
        Self {
            runs: self.runs + other.runs,
            reached: self.reached + other.reached,
            expected: self.expected + other.expected,
            variance: self.variance + other.variance,
        }
    }
}

/// Pearson's sum over binomial counts, and its degrees of freedom; `None` with fewer than three classes.
/// Neighbours are joined until each class expects a run that reaches the state and one that misses it.
fn of_stripes(fragility: &Fragility, counts: &[Counts], weight: f64) -> Option<(f64, usize)> {
    let mut classes: Vec<Stripe> = Vec::new();
    let mut open = Stripe::default();
    for count in counts {
        let probability = fragility.probability(count.intensity);
        let runs = weight * count.runs as f64;
        open = open.with(Stripe {
            runs,
            reached: weight * count.reached as f64,
            expected: runs * probability,
            variance: runs * probability * (1.0 - probability),
        });
        if open.expected >= LEAST_EXPECTED && open.runs - open.expected >= LEAST_EXPECTED {
            classes.push(std::mem::take(&mut open));
        }
    }
    if let Some(last) = classes.last_mut() {
        *last = last.with(open);
    }
    let degrees_of_freedom = classes.len().checked_sub(2).filter(|d| *d > 0)?;
    let squares = classes
        .iter()
        .map(|c| (c.reached - c.expected).powi(2) / c.variance);
    Some((squares.sum(), degrees_of_freedom))
}

/// How many reach a state, how many miss it, of how many, and what they are.
struct Numbers {
    reach: usize,
    miss: usize,
    of: usize,
    sampled: Sampled,
}

impl Numbers {
    fn new(counts: &[Counts], evidence: &Evidence) -> Self {
        match evidence {
            Evidence::Curves { capacities, of } => Self {
                reach: capacities.iter().filter(|c| c.first < counts.len()).count(),
                miss: capacities
                    .iter()
                    .filter(|c| c.first > 0 || c.returns)
                    .count(),
                of: capacities.len(),
                sampled: *of,
            },
            Evidence::Stripes | Evidence::Mixed => {
                let reach = counts.iter().map(|c| c.reached).sum();
                let of: usize = counts.iter().map(|c| c.runs).sum();
                Self {
                    reach,
                    miss: of - reach,
                    of,
                    sampled: Sampled::Runs,
                }
            }
        }
    }
}

/// What must be said of a fit to the runs of so many records.
pub(super) fn remarks(
    fit: &FragilityFit,
    goodness: Option<&GoodnessOfFit>,
    counts: &[Counts],
    (evidence, records): (&Evidence, usize),
) -> Vec<FitRemark> {
    let Numbers {
        reach,
        miss,
        of,
        sampled,
    } = Numbers::new(counts, evidence);
    let mut remarks = Vec::new();
    if let Evidence::Curves { capacities, .. } = evidence {
        let returns = capacities.iter().filter(|c| c.returns).count();
        if returns > 0 {
            remarks.push(FitRemark::Returns {
                records: returns,
                of,
                sampled,
            });
        }
    }
    let FragilityFit::Lognormal(fragility) = fit else {
        // Of so few the intensities between which all reach the state, or up to which none do, say little.
        remarks.extend(few_records(records));
        return remarks;
    };
    match (goodness, evidence) {
        (Some(test), _) if test.p_value < POOR => remarks.push(FitRemark::Poor {
            p_value: test.p_value,
        }),
        (Some(_), _) => {}
        (None, Evidence::Mixed) => remarks.push(FitRemark::NotTested(Untested::Mixed)),
        (None, _) => remarks.push(FitRemark::NotTested(Untested::FewClasses)),
    }
    remarks.extend(few_records(records));
    if reach < FEW.min(of) {
        remarks.push(FitRemark::FewReach {
            records: reach,
            of,
            sampled,
        });
    }
    if miss < FEW.min(of) {
        remarks.push(FitRemark::FewMiss {
            records: miss,
            of,
            sampled,
        });
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

fn few_records(records: usize) -> Option<FitRemark> {
    (records < FEW).then_some(FitRemark::FewRecords { records })
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

    /// Records by the intensity at which they reach the state.
    fn curves(classes: &[usize]) -> Evidence {
        let classes = classes.iter().enumerate();
        let capacities = classes
            .flat_map(|(first, n)| {
                let one = Capacity {
                    first,
                    returns: false,
                };
                vec![one; *n]
            })
            .collect();
        of_records(capacities)
    }

    fn of_records(capacities: Vec<Capacity>) -> Evidence {
        Evidence::Curves {
            capacities,
            of: Sampled::Records,
        }
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

    fn few_reach(records: usize, of: usize) -> FitRemark {
        FitRemark::FewReach {
            records,
            of,
            sampled: Sampled::Records,
        }
    }

    fn few_miss(records: usize, of: usize) -> FitRemark {
        FitRemark::FewMiss {
            records,
            of,
            sampled: Sampled::Records,
        }
    }

    fn curve(median: f64, dispersion: f64) -> Fragility {
        Fragility {
            records: None,
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
        let test = test(&curve(1.0, 1.0), &counts, (&curves(&classes), 1.0)).unwrap();
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
        let at = |i: i32| libm::exp(-(x + h * f64::from(i)).powi(2));
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
        let found = test(&curve(1.0, 1.0), &counts, (&curves(&classes), 1.0)).unwrap();
        assert_eq!(found.degrees_of_freedom, 1);
        assert!(found.p_value > 0.5);
        assert_eq!(
            test(&curve(1.0, 1.0), &counts[3..4], (&curves(&[50, 50]), 1.0)),
            None
        );
    }

    /// By hand: of 100 runs each at exp(-1), 1 and exp(1) a curve with median 1 and dispersion 1 expects 15.8655, 50 and 84.1345
    /// to reach the state, with the variances 13.3484, 25 and 13.3484. Counts of 20, 45 and 80 give
    /// (2 (4.1345)^2) / 13.3484 + 1 = 3.5612, with one degree of freedom.
    #[test]
    fn stripes_by_hand() {
        let e = std::f64::consts::E;
        let stripe = |intensity: f64, reached: usize| Counts {
            intensity,
            runs: 100,
            reached,
        };
        let counts = [stripe(1.0 / e, 20), stripe(1.0, 45), stripe(e, 80)];
        let found = test(&curve(1.0, 1.0), &counts, (&Evidence::Stripes, 1.0)).unwrap();
        assert_eq!(found.degrees_of_freedom, 1);
        let expected = 2.0 * 4.134_475_f64.powi(2) / 13.348_377 + 1.0;
        assert!((found.statistic - expected).abs() < 1e-5, "{found:?}");
        let p = libm_erfc((0.5 * expected).sqrt());
        assert!((found.p_value - p).abs() < 1e-6, "{found:?}");
        // Far stripes, where nobody is expected to reach or to miss the state, are joined to others.
        let far = [
            &[stripe(1e-4, 0), stripe(1e-3, 0)],
            &counts[..],
            &[stripe(1e3, 100)],
        ];
        let found = test(&curve(1.0, 1.0), &far.concat(), (&Evidence::Stripes, 1.0)).unwrap();
        assert_eq!(found.degrees_of_freedom, 1);
        assert!((found.statistic - expected).abs() < 1e-3, "{found:?}");
        assert_eq!(
            test(&curve(1.0, 1.0), &counts[..2], (&Evidence::Stripes, 1.0)),
            None
        );
        assert_eq!(
            test(&curve(1.0, 1.0), &counts, (&Evidence::Mixed, 1.0)),
            None
        );
    }

    /// Stripes drawn from a lognormal curve, each of other records, and fitted: the test refuses 5 % of them at 0.05, as
    /// often as it says. Of 2000 sets the share has a standard deviation of 0.5 %.
    #[test]
    fn stripes_of_a_lognormal_curve_are_refused_as_often_as_said() {
        let f = curve(1.0, 0.4);
        let intensities: Vec<f64> = (0..8).map(|i| 0.5 * 1.25_f64.powi(i)).collect();
        let (mut refused, mut tested) = (0_u32, 0_u32);
        for set in 0..2000_u64 {
            let stripes = intensities.iter().zip(0_u64..);
            let counts: Vec<Counts> = stripes
                .map(|(intensity, level)| {
                    let reaches = |run: &u64| {
                        let random = crate::mixing::unit(&[7, set, level, *run]);
                        random < f.probability(*intensity)
                    };
                    Counts {
                        intensity: *intensity,
                        runs: 30,
                        reached: (0..30).filter(reaches).count(),
                    }
                })
                .collect();
            let FragilityFit::Lognormal(fitted) = fit(&counts) else {
                continue;
            };
            let Some(goodness) = test(&fitted, &counts, (&Evidence::Stripes, 1.0)) else {
                continue;
            };
            tested += 1;
            refused += u32::from(goodness.p_value < POOR);
        }
        assert!(tested > 1990, "{tested}");
        let share = f64::from(refused) / f64::from(tested);
        assert!((share - 0.05).abs() < 0.02, "{share}");
    }

    /// Half of the records reach the state early and the others never: the fraction stays at a
    /// half, the fitted curve does not, and the test refuses it.
    #[test]
    fn a_plateau_is_a_poor_fit() {
        let intensities: Vec<f64> = (0..8).map(|i| 0.1 * 1.5_f64.powi(i)).collect();
        let classes = [2, 8, 8, 2, 0, 0, 0, 0, 20];
        let counts = counts(&intensities, &classes);
        let evidence = curves(&classes);
        let fitted = fit(&counts);
        let FragilityFit::Lognormal(f) = fitted else {
            panic!("{fitted:?}")
        };
        let goodness = test(&f, &counts, (&evidence, 1.0));
        assert!(goodness.unwrap().p_value < 1e-3, "{goodness:?}");
        let said = remarks(&fitted, goodness.as_ref(), &counts, (&evidence, 40));
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
        let all = curves(&classes);
        let fitted = fit(&table);
        let FragilityFit::Lognormal(fragility) = fitted else {
            panic!("{fitted:?}")
        };
        let goodness = test(&fragility, &table, (&all, 1.0)).unwrap();
        assert!(goodness.p_value > 0.5, "{goodness:?}");
        assert!(remarks(&fitted, Some(&goodness), &table, (&all, 40)).is_empty());
        let classes = [0, 0, 0, 0, 0, 1, 1, 1, 37];
        let table = counts(&intensities, &classes);
        let all = curves(&classes);
        let fitted = fit(&table);
        let said = remarks(&fitted, None, &table, (&all, 40));
        assert!(said.contains(&few_reach(3, 40)));
        assert!(said.contains(&FitRemark::NotTested(Untested::FewClasses)));
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
        let said = remarks(&fit(&counts), None, &counts, (&of_records(all), 10));
        let below = FitRemark::MedianBelow { lowest: 0.5 };
        assert!(said.contains(&below), "{said:?}");
        assert!(said.contains(&few_miss(3, 10)));
        // One of ten reaches it at once, misses it, and reaches it again: it does miss it.
        let counts = table(&[10, 9, 10, 10], 10);
        let all = [vec![at(0, false); 9], vec![at(0, true)]].concat();
        let fitted = FragilityFit::Lognormal(curve(0.2, 0.5));
        let said = remarks(&fitted, None, &counts, (&of_records(all), 10));
        assert!(said.contains(&few_miss(1, 10)), "{said:?}");
        // Of three records all are few, which is said once.
        let counts = table(&[1, 2, 3], 3);
        let all = vec![at(0, false), at(1, false), at(2, true)];
        let said = remarks(&fitted, None, &counts, (&of_records(all), 3));
        assert!(
            said.contains(&FitRemark::FewRecords { records: 3 }),
            "{said:?}"
        );
        assert!(
            !said.iter().any(|r| matches!(r, FitRemark::FewReach { .. })),
            "{said:?}"
        );
        assert!(said.contains(&few_miss(2, 3)));
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
