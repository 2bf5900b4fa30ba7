//! Confidence of a mean annual frequency: the records are drawn anew.

use super::fragility::{Counts, FragilityFit, fit};
use super::hazard::mean_annual_frequency;
use crate::design::mixing::unit;
use crate::fractiles::fractile;
use crate::study_file::HazardCurve;

/// Sets of records that are drawn.
pub const RESAMPLES: usize = 1000;
/// Seed of the drawing, the same in every analysis.
const SEED: u64 = 20_261_123;
/// Part of the sets that may have no frequency.
const MOST_WITHOUT: f64 = 0.05;

/// Bounds of a mean annual frequency.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrequencyBounds {
    /// Lower bound (1/year).
    pub low: f64,
    /// Upper bound (1/year).
    pub high: f64,
}

/// Runs of one record: at each intensity how many were made and how many reached the state.
pub(super) type RecordCounts = Vec<(usize, usize)>;

/// Two-sided bounds of the mean annual frequency by percentiles of the bootstrap (Efron 1979,
/// Annals of Statistics 7, 1) over records: so many records are drawn with replacement from
/// them, with all their runs, since runs of one record at different intensities depend on one
/// another. The hazard is taken as known. A set that leaves a step between two intensities counts
/// with their geometric mean. `None` with fewer than two records, or where more than
/// one in twenty of the sets has no frequency.
pub(super) fn frequency_bounds(
    intensities: &[f64],
    records: &[RecordCounts],
    hazard: &HazardCurve,
    confidence: f64,
) -> Option<FrequencyBounds> {
    if records.len() < 2 {
        return None;
    }
    let drawn = |set: usize| {
        let mut counts: Vec<Counts> = intensities
            .iter()
            .map(|intensity| Counts {
                intensity: *intensity,
                runs: 0,
                reached: 0,
            })
            .collect();
        for draw in 0..records.len() {
            let random = unit(&[SEED, set as u64, draw as u64]);
            let record = ((random * records.len() as f64) as usize).min(records.len() - 1);
            for (count, (runs, reached)) in counts.iter_mut().zip(&records[record]) {
                count.runs += runs;
                count.reached += reached;
            }
        }
        match fit(&counts) {
            // Any narrow curve between the two is as likely: neither end stands for them all.
            FragilityFit::Step { lower, upper } if lower > 0.0 && upper.is_finite() => {
                Some(hazard.frequency((lower * upper).sqrt()))
            }
            fit => mean_annual_frequency(&fit, hazard),
        }
    };
    let mut found: Vec<f64> = (0..RESAMPLES).filter_map(drawn).collect();
    if (RESAMPLES - found.len()) as f64 > MOST_WITHOUT * RESAMPLES as f64 {
        return None;
    }
    found.sort_by(f64::total_cmp);
    let tail = 0.5 * (1.0 - confidence);
    Some(FrequencyBounds {
        low: fractile(&found, tail),
        high: fractile(&found, 1.0 - tail),
    })
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
            .map(|x| (*x, 1e-4 * x.powf(-k)))
            .collect();
        let hazard = HazardCurve::new(points).unwrap();
        let quantile = pounding_ground_motion::distributions::normal_quantile;
        let records: Vec<RecordCounts> = (0..n)
            .map(|r| {
                let z = quantile((r as f64 + 0.5) / n as f64);
                let capacity = median * (beta * z).exp();
                let reached = intensities.iter().map(|x| (1, usize::from(*x > capacity)));
                reached.collect()
            })
            .collect();
        let bounds = frequency_bounds(&intensities, &records, &hazard, 0.9).unwrap();
        let exact = 1e-4 * median.powf(-k) * (0.5 * k * k * beta * beta).exp();
        let deviation = (k * k * beta * beta / n as f64 * (1.0 + 0.5 * k * k * beta * beta)).sqrt();
        let reach = 1.644_853_6 * deviation;
        assert!(
            bounds.low < exact && exact < bounds.high,
            "{bounds:?} {exact}"
        );
        let found = 0.5 * (bounds.high / bounds.low).ln();
        assert!((found / reach - 1.0).abs() < 0.15, "{found} {reach}");
        // Same input, same bits.
        let again = frequency_bounds(&intensities, &records, &hazard, 0.9);
        assert_eq!(again, Some(bounds));
    }

    #[test]
    fn one_record_has_no_bounds() {
        let hazard = HazardCurve::new(vec![(0.1, 1e-2), (1.0, 1e-4)]).unwrap();
        let one = [vec![(1, 0), (1, 1)]];
        assert_eq!(frequency_bounds(&[0.1, 0.2], &one, &hazard, 0.9), None);
        // All reach it already at the least intensity: no frequency, and no bounds.
        let always = [vec![(1, 1), (1, 1)], vec![(1, 1), (1, 1)]];
        assert_eq!(frequency_bounds(&[0.1, 0.2], &always, &hazard, 0.9), None);
        let counts = [Counts {
            intensity: 0.1,
            runs: 2,
            reached: 2,
        }];
        assert!(matches!(fit(&counts), FragilityFit::Always { .. }));
    }
}
