//! Statistics of the demand over a suite of records.

use crate::fractiles::fractiles;

/// Statistics of the demand of the records (m).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SuiteStatistics {
    /// Minimum.
    pub minimum: f64,
    /// 16 % fractile, linear between ordered values, as are the next two.
    pub p16: f64,
    /// Median.
    pub median: f64,
    /// 84 % fractile.
    pub p84: f64,
    /// Maximum.
    pub maximum: f64,
    /// Mean.
    pub mean: f64,
    /// Standard deviation with `n - 1` (m); NaN of one record.
    pub standard_deviation: f64,
}

impl SuiteStatistics {
    /// Of the demand of each record (m), at least one.
    #[must_use]
    pub fn of(demand: &[f64]) -> Self {
        let n = demand.len() as f64;
        let mean = demand.iter().sum::<f64>() / n;
        let squares = demand.iter().map(|d| (d - mean).powi(2)).sum::<f64>();
        let [p16, median, p84] = fractiles(demand.to_vec());
        Self {
            minimum: demand.iter().copied().fold(f64::INFINITY, f64::min),
            p16,
            median,
            p84,
            maximum: demand.iter().copied().fold(0.0, f64::max),
            mean,
            standard_deviation: (squares / (n - 1.0)).sqrt(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 1 to 5 by hand: places 0.16 and 0.84 of four steps are 1.64 and 4.36; variance 2.5.
    #[test]
    fn by_hand() {
        let s = SuiteStatistics::of(&[3.0, 1.0, 5.0, 2.0, 4.0]);
        let expected = [1.0, 1.64, 3.0, 4.36, 5.0, 3.0, 2.5_f64.sqrt()];
        let found = [
            s.minimum,
            s.p16,
            s.median,
            s.p84,
            s.maximum,
            s.mean,
            s.standard_deviation,
        ];
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-12, "{found} {expected}");
        }
        assert!(SuiteStatistics::of(&[1.0]).standard_deviation.is_nan());
    }
}
