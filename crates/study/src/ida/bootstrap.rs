//! Confidence of a mean annual frequency: the records are drawn anew.

use pounding_time_history::in_parallel;

use super::fragility::{Counts, FragilityFit, fit};
use super::hazard::mean_annual_frequency;
use crate::fractiles::fractile;
use crate::mixing::unit;
use crate::study_file::HazardCurve;

/// Sets of records that are drawn at least, and at most.
const RESAMPLES: [usize; 2] = [1000, 10_000];
/// Sets that are to lie beyond a bound, and that must: fewer make it an extreme of what was drawn.
const BEYOND: [f64; 2] = [25.0, 4.999_999];
/// Seed of the drawing, the same in every analysis.
const SEED: u64 = 20_261_123;

/// Sets of records that bounds at a confidence are drawn from; `None` where too few of the most that are drawn
/// lie beyond them, above 99.9 %.
#[must_use]
pub fn bootstrap_sets(confidence: f64) -> Option<usize> {
    let tail = 0.5 * (1.0 - confidence);
    let [least, most] = RESAMPLES;
    let sets = (BEYOND[0] / tail).round().clamp(least as f64, most as f64);
    (tail * sets >= BEYOND[1]).then_some(sets as usize)
}

/// Bounds of a mean annual frequency.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrequencyBounds {
    /// Lower bound (1/year); `None` where the sets of which no least frequency is known reach its tail.
    pub low: Option<f64>,
    /// Upper bound (1/year); `None` where the sets of unknown frequency reach its tail.
    pub high: Option<f64>,
    /// Sets that were drawn.
    pub sets: usize,
    /// Sets of whose frequency only the most is known: none of their records reach the state, or some at
    /// the highest intensity alone.
    pub below: usize,
    /// Sets whose frequency is not known but above the others: some or all of their records reach
    /// the state at the lowest intensity already.
    pub above: usize,
    /// Sets that could have any frequency: their counts give no fragility.
    pub unknown: usize,
}

/// What a set says of its frequency.
enum Drawn {
    Frequency(f64),
    AtMost(f64),
    Above,
    Unknown,
}

impl Drawn {
    fn of(fit: &FragilityFit, hazard: &HazardCurve) -> Self {
        let frequency = match *fit {
            // Any narrow curve between the two is as likely: neither end stands for them all.
            FragilityFit::Step { lower, upper } if lower > 0.0 && upper.is_finite() => {
                Some(hazard.frequency((lower * upper).sqrt()))
            }
            // All from the second intensity on: what they do below is not known.
            FragilityFit::Step { upper, .. } if upper.is_finite() => return Self::Above,
            FragilityFit::Always { .. } => return Self::Above,
            // At the highest intensity alone, or nowhere: they may do so at any intensity above.
            FragilityFit::Step { lower: x, .. } | FragilityFit::Never { up_to: x } if x > 0.0 => {
                return Self::AtMost(hazard.frequency(x));
            }
            _ => mean_annual_frequency(fit, hazard),
        };
        match frequency {
            Some(frequency) if frequency.is_finite() => Self::Frequency(frequency),
            _ => Self::Unknown,
        }
    }
}

/// Runs of one record: at each intensity how many were made and how many reached the state.
pub(super) type RecordCounts = Vec<(usize, usize)>;

/// Records of a group from which on groups are drawn by themselves.
const LEAST_GROUP: usize = 5;

/// Two-sided bounds of the mean annual frequency by percentiles of the bootstrap (Efron 1979,
/// Annals of Statistics 7, 1) over records: so many records are drawn with replacement from
/// them, with all their runs, since runs of one record at different intensities depend on one
/// another. Groups of records that have runs at the same intensities, as those of one stripe, are drawn by
/// themselves, which keeps the number of runs at each intensity; unless one of them is small. The hazard is taken as
/// known. A set that leaves a step between two intensities counts
/// with their geometric mean; one of which some or all records reach the state at the lowest
/// intensity counts as above all others, one of which none do, or at the highest intensity alone, as below all others
/// for the lower bound and with the most it may have for the upper, and one without a fragility at both ends. `None`
/// with fewer than two records, and for a confidence that so few sets do not tell.
pub(super) fn frequency_bounds(
    intensities: &[f64],
    groups: &[Vec<RecordCounts>],
    hazard: &HazardCurve,
    (confidence, threads): (f64, usize),
) -> Option<FrequencyBounds> {
    let records = groups.concat();
    if records.len() < 2 {
        return None;
    }
    let sets = bootstrap_sets(confidence)?;
    let large = groups.iter().all(|group| group.len() >= LEAST_GROUP);
    // Of every draw the records that it is made from: first and number.
    let mut sources = Vec::with_capacity(records.len());
    for group in groups.iter().filter(|_| large) {
        let first = sources.len();
        sources.resize(first + group.len(), (first, group.len()));
    }
    sources.resize(records.len(), (0, records.len()));
    let drawn = |set: usize| {
        let mut counts: Vec<Counts> = intensities
            .iter()
            .map(|intensity| Counts {
                intensity: *intensity,
                runs: 0,
                reached: 0,
            })
            .collect();
        for (draw, (first, count)) in sources.iter().enumerate() {
            let random = unit(&[SEED, set as u64, draw as u64]);
            let record = first + ((random * *count as f64) as usize).min(count - 1);
            for (count, (runs, reached)) in counts.iter_mut().zip(&records[record]) {
                count.runs += runs;
                count.reached += reached;
            }
        }
        Drawn::of(&fit(&counts), hazard)
    };
    let mut all = Frequencies::default();
    for of_set in in_parallel(sets, threads, drawn) {
        match of_set {
            Drawn::Frequency(frequency) => all.found.push(frequency),
            Drawn::AtMost(frequency) => all.at_most.push(frequency),
            Drawn::Above => all.above += 1,
            Drawn::Unknown => all.unknown += 1,
        }
    }
    Some(all.bounds(0.5 * (1.0 - confidence)))
}

/// What all sets say of their frequencies.
#[derive(Default)]
struct Frequencies {
    found: Vec<f64>,
    /// The most it may be.
    at_most: Vec<f64>,
    /// Sets above all others, and those that could be anywhere.
    above: usize,
    unknown: usize,
}

impl Frequencies {
    /// Percentiles, which are none where a set of unknown frequency has part in them.
    fn bounds(self, tail: f64) -> FrequencyBounds {
        let Self {
            found,
            at_most,
            above,
            unknown,
        } = self;
        let below = at_most.len();
        let percentile = |mut all: Vec<f64>, [below, above]: [usize; 2], at: f64| {
            all.resize(all.len() + below, f64::NEG_INFINITY);
            all.resize(all.len() + above, f64::INFINITY);
            all.sort_by(f64::total_cmp);
            let bound = fractile(&all, at);
            bound.is_finite().then_some(bound)
        };
        let most = [found.clone(), at_most].concat();
        FrequencyBounds {
            sets: most.len() + above + unknown,
            low: percentile(found, [below + unknown, above], tail),
            high: percentile(most, [0, above + unknown], 1.0 - tail),
            below,
            above,
            unknown,
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    /// Records whose capacities are lognormal, at their quantiles, under a power law: the
    /// frequency is `k0 median^-k exp(k^2 beta^2 / 2)`, and the logarithm of its estimate has,
    /// by the delta method, the standard deviation `sqrt(k^2 beta^2 / n (1 + k^2 beta^2 / 2))`
    /// (those of mean and deviation of n normal logarithms are `beta / sqrt(n)` and
    /// `beta / sqrt(2 n)`). Classes of finite width lose little of that.
    #[test]
    fn bounds_agree_with_the_delta_method() {
        let (median, beta, k, n) = (0.5_f64, 0.4_f64, 2.0_f64, 60_usize);
        let grid = (0..60).map(|i| 0.02 * 1.1_f64.powi(i));
        let intensities: Vec<f64> = grid.collect();
        let points = intensities
            .iter()
            .map(|x| (*x, 1e-4 * libm::pow(*x, -k)))
            .collect();
        let hazard = HazardCurve::new(points).unwrap();
        let quantile = pounding_ground_motion::distributions::normal_quantile;
        let records: Vec<RecordCounts> = (0..n)
            .map(|r| {
                let z = quantile((r as f64 + 0.5) / n as f64);
                let capacity = median * libm::exp(beta * z);
                let reached = intensities.iter().map(|x| (1, usize::from(*x > capacity)));
                reached.collect()
            })
            .collect();
        let bounds = frequency_bounds(
            &intensities,
            std::slice::from_ref(&records),
            &hazard,
            (0.9, 2),
        )
        .unwrap();
        let exact = 1e-4 * libm::pow(median, -k) * libm::exp(0.5 * k * k * beta * beta);
        let deviation = (k * k * beta * beta / n as f64 * (1.0 + 0.5 * k * k * beta * beta)).sqrt();
        let reach = 1.644_853_6 * deviation;
        let (low, high) = (bounds.low.unwrap(), bounds.high.unwrap());
        assert!(low < exact && exact < high, "{bounds:?} {exact}");
        let found = 0.5 * libm::log(high / low);
        assert!((found / reach - 1.0).abs() < 0.15, "{found} {reach}");
        // Same input, same bits.
        let again = frequency_bounds(
            &intensities,
            std::slice::from_ref(&records),
            &hazard,
            (0.9, 2),
        );
        assert_eq!(again, Some(bounds));
    }

    /// Stripes of records of their own: each is drawn by itself, so that the counts of every set have as many runs as the
    /// analysis; then the standard deviation of the logarithm of the median is that of the observed information, where the
    /// frequency is a power of the median.
    #[test]
    fn stripes_are_drawn_by_themselves() {
        let intensities: Vec<f64> = (0..6).map(|i| 0.3 * 1.35_f64.powi(i)).collect();
        let points = [(0.01, 1e2), (100.0, 1e-2)];
        let hazard = HazardCurve::new(points.to_vec()).unwrap();
        let curve = |x: f64| {
            pounding_ground_motion::distributions::normal_distribution(libm::log(x / 0.6) / 0.4)
        };
        let stripe = |level: usize| -> Vec<RecordCounts> {
            let reached = (60.0 * curve(intensities[level])).round() as usize;
            let run = |record: usize| {
                let mut counts = vec![(0, 0); intensities.len()];
                counts[level] = (1, usize::from(record < reached));
                counts
            };
            (0..60).map(run).collect()
        };
        let groups: Vec<Vec<RecordCounts>> = (0..intensities.len()).map(stripe).collect();
        let counts = |level: usize| Counts {
            intensity: intensities[level],
            runs: 60,
            reached: groups[level].iter().map(|record| record[level].1).sum(),
        };
        let counts: Vec<Counts> = (0..intensities.len()).map(counts).collect();
        let FragilityFit::Lognormal(fitted) = fit(&counts) else {
            panic!("{counts:?}");
        };
        // The slope of the hazard is one: the frequency is k0 / median exp(dispersion^2 / 2).
        let [s, t] = fitted.standard_errors;
        let b = fitted.dispersion;
        let variance = s * s + b * b * t * t - 2.0 * b * fitted.covariance;
        let found = frequency_bounds(&intensities, &groups, &hazard, (0.9, 2)).unwrap();
        let reach = 0.5 * libm::log(found.high.unwrap() / found.low.unwrap());
        let expected = 1.644_853_6 * variance.sqrt();
        assert!((reach / expected - 1.0).abs() < 0.12, "{reach} {expected}");
    }

    /// One record of ten reaches the state, at the highest intensities: (9/10)^10 of the sets are without it, which is far
    /// more than a tail of 2.5 %, and there is no lower bound.
    #[test]
    fn a_single_record_that_reaches_the_state_leaves_no_lower_bound() {
        let hazard = HazardCurve::new(vec![(0.01, 1e-1), (1.0, 1e-4)]).unwrap();
        let mut records = vec![vec![(1, 0); 4]; 9];
        records.push(vec![(1, 0), (1, 0), (1, 1), (1, 1)]);
        let found =
            frequency_bounds(&[0.1, 0.2, 0.3, 0.4], &[records], &hazard, (0.95, 2)).unwrap();
        let expected = 1000.0 * 0.9_f64.powi(10);
        assert!((found.below as f64 - expected).abs() < 60.0, "{found:?}");
        assert_eq!(found.low, None, "{found:?}");
        assert!(found.high.unwrap() > hazard.frequency(0.4), "{found:?}");
    }

    #[test]
    fn sets_beyond_a_bound_are_not_few() {
        assert_eq!(bootstrap_sets(0.9), Some(1000));
        assert_eq!(bootstrap_sets(0.95), Some(1000));
        assert_eq!(bootstrap_sets(0.99), Some(5000));
        assert_eq!(bootstrap_sets(0.999), Some(10_000));
        assert_eq!(bootstrap_sets(0.9995), None);
    }

    #[test]
    fn one_record_has_no_bounds() {
        let hazard = HazardCurve::new(vec![(0.1, 1e-2), (1.0, 1e-4)]).unwrap();
        let one = [vec![vec![(1, 0), (1, 1)]]];
        assert_eq!(frequency_bounds(&[0.1, 0.2], &one, &hazard, (0.9, 2)), None);
        // All reach it already at the least intensity: no frequency, and no bounds.
        let always = [vec![vec![(1, 1), (1, 1)], vec![(1, 1), (1, 1)]]];
        let without = frequency_bounds(&[0.1, 0.2], &always, &hazard, (0.9, 2)).unwrap();
        assert_eq!((without.low, without.high), (None, None));
        assert_eq!(
            (without.sets, without.above, without.unknown),
            (1000, 1000, 0)
        );
        let counts = [Counts {
            intensity: 0.1,
            runs: 2,
            reached: 2,
        }];
        assert!(matches!(fit(&counts), FragilityFit::Always { .. }));
    }

    /// Three records of four reach the state at the lowest intensity, the other one never but at
    /// the last: sets without the latter, (3/4)^4 of them, have the highest frequencies, which nobody
    /// knows.
    #[test]
    fn sets_above_the_others_count_there() {
        let hazard = HazardCurve::new(vec![(0.01, 1e-1), (1.0, 1e-4)]).unwrap();
        let early = vec![(1, 1), (1, 1), (1, 1)];
        let late = vec![(1, 0), (1, 1), (1, 0)];
        let records = [vec![early.clone(), early.clone(), early, late]];
        let found = frequency_bounds(&[0.1, 0.2, 0.4], &records, &hazard, (0.9, 2)).unwrap();
        assert!((250..400).contains(&found.above), "{found:?}");
        assert_eq!(found.high, None, "{found:?}");
    }

    /// Of 1000 sets with the frequencies 1, 2, ...: by hand.
    #[test]
    fn a_bound_is_withheld_where_unknown_sets_reach_its_tail() {
        let rising = |count: u32| (1..=count).map(f64::from).collect::<Vec<f64>>();
        let bounds = |found, [above, unknown]: [usize; 2], tail| {
            let all = Frequencies {
                found,
                above,
                unknown,
                at_most: Vec::new(),
            };
            all.bounds(tail)
        };
        // Place 949.05 of 0 to 999 is among the known ones as long as 951 are known.
        let found = bounds(rising(951), [49, 0], 0.05);
        assert!((found.low.unwrap() - 50.95).abs() < 1e-9, "{found:?}");
        assert!((found.high.unwrap() - 950.05).abs() < 1e-9, "{found:?}");
        let found = bounds(rising(950), [50, 0], 0.05);
        assert!((found.low.unwrap() - 50.95).abs() < 1e-9, "{found:?}");
        assert_eq!(found.high, None);
        // Those that could be anywhere are at both ends: place 49.95 is 9.95 behind forty of them.
        let found = bounds(rising(960), [0, 40], 0.05);
        assert!((found.low.unwrap() - 10.95).abs() < 1e-9, "{found:?}");
        assert!((found.high.unwrap() - 950.05).abs() < 1e-9, "{found:?}");
        let found = bounds(rising(900), [0, 100], 0.05);
        assert_eq!((found.low, found.high), (None, None));
        // Those of which the most is known are below all others for the one bound, and at their most for the other.
        let of = |found, at_most| Frequencies {
            found: rising(found),
            at_most: vec![2000.0; at_most],
            ..Frequencies::default()
        };
        let found = of(960, 40).bounds(0.05);
        assert!((found.low.unwrap() - 10.95).abs() < 1e-9, "{found:?}");
        assert!((found.high.unwrap() - 950.05).abs() < 1e-9, "{found:?}");
        let found = of(940, 60).bounds(0.05);
        assert_eq!((found.low, found.high), (None, Some(2000.0)));
        assert_eq!((found.sets, found.below), (1000, 60));
        // No number is none of them.
        let counts = |reached: [usize; 2]| {
            let level = |(i, reached): (usize, usize)| Counts {
                intensity: [0.1, 0.2][i],
                runs: 4,
                reached,
            };
            reached
                .into_iter()
                .enumerate()
                .map(level)
                .collect::<Vec<_>>()
        };
        let hazard = HazardCurve::new(vec![(0.1, 1e-2), (1.0, 1e-4)]).unwrap();
        let of = |reached| Drawn::of(&fit(&counts(reached)), &hazard);
        assert!(matches!(of([3, 1]), Drawn::Unknown));
        assert!(matches!(of([2, 4]), Drawn::Above));
        assert!(matches!(of([4, 4]), Drawn::Above));
        assert!(matches!(of([1, 2]), Drawn::Frequency(_)));
        assert!(matches!(of([0, 4]), Drawn::Frequency(_)));
        // What is reached nowhere, or at the highest intensity alone, has no least frequency.
        for (reached, most) in [([0, 0], 0.2), ([0, 1], 0.1)] {
            let expected = hazard.frequency(most);
            assert!(matches!(of(reached), Drawn::AtMost(x) if x == expected));
        }
    }
}
