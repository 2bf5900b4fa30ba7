//! Everything that a file holds.

use crate::accelerogram::Peak;
use crate::origin::Origin;
use crate::quantity::Quantity;

/// Times of the samples of a series.
#[derive(Debug, Clone, PartialEq)]
pub enum Sampling {
    /// Even steps.
    Even {
        /// Time step (s).
        time_step: f64,
    },
    /// A time for each sample, as digitised film has.
    Uneven {
        /// Times (s), increasing, as many as samples.
        times: Vec<f64>,
    },
}

impl Sampling {
    /// The even time step (s), or of uneven times the median of their steps, not longer than the
    /// mean: the step at which such a series is resampled where none is asked for.
    #[must_use]
    pub fn median_step(&self) -> f64 {
        let times = match self {
            Self::Even { time_step } => return *time_step,
            Self::Uneven { times } => times,
        };
        let mut steps: Vec<f64> = times.windows(2).map(|t| t[1] - t[0]).collect();
        steps.sort_by(f64::total_cmp);
        let mean = steps.iter().sum::<f64>() / steps.len() as f64;
        // Differences of printed times carry noise beyond their digits.
        let median = steps.get(steps.len() / 2).copied().unwrap_or(f64::NAN);
        ((median * 1.0e9).round() / 1.0e9).min(mean)
    }
}

/// What the header says about the maximum value of a series.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeaderPeak {
    /// Value (SI), with the sign that is printed: agencies differ in its meaning.
    pub value: f64,
    /// Time (s), if printed.
    pub time: Option<f64>,
    /// Unit in which it is printed.
    pub unit: &'static str,
    /// One such unit in SI.
    pub unit_in_si: f64,
    /// Whether the samples reach this magnitude with the other sign alone: the header
    /// prints signs that are opposite to those of the samples, or no signs at all.
    pub opposite_sign: bool,
}

/// One series of a file, values as in the file but in SI.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// What it records.
    pub quantity: Quantity,
    /// Component as the file names it, e.g. `90 deg`, `N10E`, `HNE`.
    pub component: String,
    /// Place among the channels of the file, from 1; acceleration, velocity and
    /// displacement of one channel share it.
    pub channel: usize,
    /// Unit in the file.
    pub unit: &'static str,
    /// One unit of the file in SI (m/s2, m/s or m).
    pub unit_in_si: f64,
    /// Values (m/s2, m/s or m); an offset of the instrument is kept.
    pub samples: Vec<f64>,
    /// When they were taken.
    pub sampling: Sampling,
    /// Peak in the header.
    pub header_peak: Option<HeaderPeak>,
    /// Velocity at the first sample (m/s) and displacement there (m), if the file
    /// has series or entries for them.
    pub initial: Option<(f64, f64)>,
    /// Where it came from and how it was understood.
    pub origin: Origin,
}

impl Series {
    /// Maximum absolute value (SI) and its time (s).
    #[must_use]
    pub fn peak(&self) -> Peak {
        let (value, time) = self.signed_peak();
        Peak {
            value: value.abs(),
            time,
        }
    }

    /// The value of largest magnitude with its sign (SI), and its time (s).
    #[must_use]
    pub fn signed_peak(&self) -> (f64, f64) {
        let mut peak = (0.0_f64, 0.0);
        for (i, a) in self.samples.iter().enumerate() {
            if a.abs() > peak.0.abs() {
                peak = (*a, self.time(i));
            }
        }
        peak
    }

    /// The largest value of a sign (1 or -1) with its time (s): the one nearest to it if none
    /// has the sign.
    pub(crate) fn extreme(&self, sign: f64) -> (f64, f64) {
        let values = self.samples.iter().enumerate();
        let largest = values.max_by(|a, b| (a.1 * sign).total_cmp(&(b.1 * sign)));
        largest.map_or((0.0, 0.0), |(i, a)| (*a, self.time(i)))
    }

    /// Time of sample `index` (s).
    #[must_use]
    pub fn time(&self, index: usize) -> f64 {
        match &self.sampling {
            Sampling::Even { time_step } => index as f64 * time_step,
            Sampling::Uneven { times } => times.get(index).copied().unwrap_or(f64::NAN),
        }
    }

    /// Mean of the samples (SI).
    #[must_use]
    pub fn mean(&self) -> f64 {
        self.samples.iter().sum::<f64>() / self.samples.len() as f64
    }

    /// `acceleration N10E (channel 1)`, for lists.
    #[must_use]
    pub fn label(&self) -> String {
        format!(
            "{} {} (channel {})",
            self.quantity, self.component, self.channel
        )
    }
}

/// All series of a file.
#[derive(Debug, Clone, PartialEq)]
pub struct Recording {
    /// Series in the order of the file; at least one.
    pub series: Vec<Series>,
    /// Channels of counts that were passed over, as nothing says how many make a unit.
    pub without: Vec<WithoutSensitivity>,
}

/// A channel of counts that cannot be read.
#[derive(Debug, Clone, PartialEq)]
pub struct WithoutSensitivity {
    /// Component as the file names it.
    pub component: String,
    /// Why its sensitivity is not known.
    pub reason: String,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn uneven_times_have_the_median_step_at_most_the_mean() {
        let uneven = |times: &[f64]| Sampling::Uneven {
            times: times.to_vec(),
        };
        assert_eq!(Sampling::Even { time_step: 0.02 }.median_step(), 0.02);
        assert_eq!(uneven(&[0.0, 0.01, 0.02, 0.07]).median_step(), 0.01);
        // A few short steps: the mean is less than the median.
        let mean = uneven(&[0.0, 0.001, 0.011, 0.021]).median_step();
        assert!((mean - 0.007).abs() < 1e-12, "{mean}");
    }
}
