//! The gap that a target probability of contact asks for.

use pounding_ground_motion::distributions::normal_quantile;

use super::GapCheckOptions;
use super::statistics::tolerance_factor;

/// A lognormal distribution fitted to demands, and its quantile.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LognormalFit {
    /// Median demand (m): the exponential of the mean logarithm.
    pub median: f64,
    /// Standard deviation of the logarithms (-), with `n - 1`.
    pub dispersion: f64,
    /// Width that the target probability exceeds (m).
    pub width: f64,
    /// Bounds of that width at the confidence asked for (m), by the noncentral t
    /// distribution.
    pub bounds: (f64, f64),
}

/// The uniform width of a gap for a target probability of contact.
#[derive(Debug, Clone, PartialEq)]
pub struct RequiredGap {
    /// Smallest width that no more than the target part of the records exceeds (m); `None` where
    /// buildings collapse without contact under more of them.
    pub by_count: Option<f64>,
    /// Records that may exceed it.
    pub allowed_contacts: usize,
    /// By a lognormal distribution, or why there is none.
    pub lognormal: Result<LognormalFit, &'static str>,
}

/// Records of so many that may be in contact.
pub(crate) fn allowed_contacts(target_probability: f64, records: usize) -> usize {
    // A product that is whole but for round-off is whole.
    (target_probability * records as f64 + 1.0e-9).floor() as usize
}

/// From the maximum demand of each record (m), and so many more under which buildings collapse
/// without contact: their demand exceeds every width.
pub(crate) fn required_gap(
    demand: &[f64],
    collapsed: usize,
    options: &GapCheckOptions,
) -> RequiredGap {
    let allowed = allowed_contacts(options.target_probability, demand.len() + collapsed);
    let mut sorted = demand.to_vec();
    sorted.sort_by(|a, b| b.total_cmp(a));
    let left = allowed.checked_sub(collapsed);
    RequiredGap {
        by_count: left.map(|left| sorted.get(left).copied().unwrap_or(0.0)),
        allowed_contacts: allowed,
        lognormal: match collapsed {
            0 => lognormal(demand, options),
            _ => Err("a record brings a building to collapse without contact"),
        },
    }
}

fn lognormal(demand: &[f64], options: &GapCheckOptions) -> Result<LognormalFit, &'static str> {
    if options.target_probability == 0.0 {
        return Err("a lognormal demand exceeds every width: give a target probability");
    }
    if demand.len() < 2 {
        return Err("a fit needs two records or more");
    }
    if demand.iter().any(|d| *d <= 0.0) {
        return Err("a record demands no gap at all, which no lognormal distribution can");
    }
    let n = demand.len() as f64;
    let mean = demand.iter().map(|d| libm::log(*d)).sum::<f64>() / n;
    let squares = demand
        .iter()
        .map(|d| (libm::log(*d) - mean).powi(2))
        .sum::<f64>();
    let dispersion = (squares / (n - 1.0)).sqrt();
    let below = 1.0 - options.target_probability;
    let tail = 0.5 * (1.0 - options.confidence);
    let bound = |confidence| {
        let factor = tolerance_factor(demand.len(), below, confidence);
        libm::exp(mean + factor * dispersion)
    };
    Ok(LognormalFit {
        median: libm::exp(mean),
        dispersion,
        width: libm::exp(mean + normal_quantile(below) * dispersion),
        bounds: (bound(tail), bound(1.0 - tail)),
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    fn options(target_probability: f64) -> GapCheckOptions {
        GapCheckOptions {
            target_probability,
            confidence: 0.9,
            sweep: None,
            threads: 1,
        }
    }

    /// 10 widths of 10 to 100 mm: one of ten may exceed 90 mm, two 80 mm.
    #[test]
    fn counts() {
        let demand: Vec<f64> = (1..=10).map(|i| 0.01 * f64::from(i)).collect();
        for (p, width, allowed) in [
            (0.0, 0.1, 0),
            (0.1, 0.09, 1),
            (0.19, 0.09, 1),
            (0.2, 0.08, 2),
        ] {
            let required = required_gap(&demand, 0, &options(p));
            assert_eq!(required.allowed_contacts, allowed);
            let by_count = required.by_count.unwrap();
            assert!((by_count - width).abs() < 1.0e-15);
            let exceeding = demand.iter().filter(|d| **d > by_count).count();
            assert!(exceeding <= allowed);
        }
    }

    /// Eight widths of 10 to 80 mm and two collapses: two of ten may touch, which the collapses do.
    #[test]
    fn collapses_exceed_every_width() {
        let demand: Vec<f64> = (1..=8).map(|i| 0.01 * f64::from(i)).collect();
        for (p, width, allowed) in [
            (0.0, None, 0),
            (0.1, None, 1),
            (0.2, Some(0.08), 2),
            (0.3, Some(0.07), 3),
        ] {
            let required = required_gap(&demand, 2, &options(p));
            assert_eq!(required.allowed_contacts, allowed);
            assert_eq!(required.by_count.is_some(), width.is_some());
            let apart = required.by_count.zip(width).map_or(0.0, |(a, b)| a - b);
            assert!(apart.abs() < 1.0e-15);
            assert!(required.lognormal.is_err());
        }
    }

    /// Logarithms -1 and 1: median 1, dispersion sqrt(2); the 16 % quantile above lies
    /// one dispersion up. The bounds hold the estimate between them.
    #[test]
    fn fit_by_hand() {
        let e = std::f64::consts::E;
        let p = 1.0 - pounding_ground_motion::distributions::normal_distribution(1.0);
        let fit = required_gap(&[1.0 / e, e], 0, &options(p))
            .lognormal
            .unwrap();
        assert!((fit.median - 1.0).abs() < 1.0e-12);
        assert!((fit.dispersion - 2.0_f64.sqrt()).abs() < 1.0e-12);
        assert!((fit.width - libm::exp(2.0_f64.sqrt())).abs() < 1.0e-9);
        assert!(fit.bounds.0 < fit.width && fit.width < fit.bounds.1);
    }

    /// Ten logarithms with mean m and deviation s: the 95 % bound of the 90 % quantile is
    /// m + 2.355 s (Natrella 1963, table A-7).
    #[test]
    fn bounds_by_table() {
        let demand: Vec<f64> = (0..10).map(|i| libm::exp(0.1 * f64::from(i))).collect();
        let fit = required_gap(&demand, 0, &options(0.1)).lognormal.unwrap();
        let expected = libm::exp(libm::log(fit.median) + 2.355 * fit.dispersion);
        assert!((fit.bounds.1 / expected - 1.0).abs() < 1.0e-3);
    }

    #[test]
    fn no_fit() {
        assert!(
            required_gap(&[0.1, 0.2], 0, &options(0.0))
                .lognormal
                .is_err()
        );
        assert!(required_gap(&[0.1], 0, &options(0.1)).lognormal.is_err());
        assert!(
            required_gap(&[0.1, 0.0], 0, &options(0.1))
                .lognormal
                .is_err()
        );
    }
}
