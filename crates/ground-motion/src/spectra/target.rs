//! A spectrum to reach.

use serde::Serialize;

use crate::error::{GroundMotionError, positive, within};

const STEP: &str = "target spectrum";

/// Pseudo-accelerations to reach, straight lines between points in the logarithms of
/// both axes.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TargetSpectrum {
    name: String,
    damping: f64,
    periods: Vec<f64>,
    accelerations: Vec<f64>,
}

impl TargetSpectrum {
    /// A target from increasing periods (s), pseudo-accelerations (m/s2) and a
    /// damping ratio in [0, 1).
    ///
    /// # Errors
    /// Fewer than two points, different counts, periods that do not increase, or
    /// values that are not positive.
    pub fn new(
        periods: Vec<f64>,
        accelerations: Vec<f64>,
        damping: f64,
    ) -> Result<Self, GroundMotionError> {
        within(STEP, "damping ratio", damping, 0.0, 1.0 - f64::EPSILON)?;
        if periods.len() < 2 || periods.len() != accelerations.len() {
            return Err(GroundMotionError::NotPossible {
                step: STEP,
                reason: format!(
                    "{} periods and {} accelerations",
                    periods.len(),
                    accelerations.len()
                ),
                remedy: "give two points or more, an acceleration for each period",
            });
        }
        for (&period, &acceleration) in periods.iter().zip(&accelerations) {
            positive(STEP, "period", period)?;
            positive(STEP, "acceleration", acceleration)?;
        }
        for pair in periods.windows(2) {
            if !(pair[1] > pair[0]) {
                return Err(GroundMotionError::NotPossible {
                    step: STEP,
                    reason: format!("period {} s follows {} s", pair[1], pair[0]),
                    remedy: "give the periods in increasing order",
                });
            }
        }
        Ok(Self {
            name: String::new(),
            damping,
            periods,
            accelerations,
        })
    }

    /// The same under this name.
    #[must_use]
    pub fn named(self, name: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            ..self
        }
    }

    /// What it is: the title of a code's spectrum, or a file; empty where it has none.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Damping ratio (-).
    #[must_use]
    pub fn damping(&self) -> f64 {
        self.damping
    }

    /// First and last period (s).
    #[must_use]
    pub fn range(&self) -> (f64, f64) {
        (self.periods[0], self.periods[self.periods.len() - 1])
    }

    /// Refuses a band (s) that it does not cover.
    pub(crate) fn covers(&self, from: f64, to: f64) -> Result<(), GroundMotionError> {
        let (first, last) = self.range();
        within(STEP, "first period of the band", from, first, last)?;
        within(STEP, "last period of the band", to, first, last)?;
        Ok(())
    }

    /// Pseudo-acceleration (m/s2) at a period (s).
    ///
    /// # Errors
    /// A period outside the target's range: nothing is extrapolated.
    pub fn at(&self, period: f64) -> Result<f64, GroundMotionError> {
        let (from, to) = self.range();
        within(STEP, "period", period, from, to)?;
        Ok(self.nearest(period))
    }

    /// As [`Self::at`], with the value of the end beyond an end.
    pub(crate) fn nearest(&self, period: f64) -> f64 {
        let (from, to) = self.range();
        let period = period.clamp(from, to);
        let after = self.periods.partition_point(|p| *p <= period);
        let i = after.clamp(1, self.periods.len() - 1);
        let part = libm::log(period / self.periods[i - 1])
            / libm::log(self.periods[i] / self.periods[i - 1]);
        let (low, high) = (self.accelerations[i - 1], self.accelerations[i]);
        low * libm::exp(part * libm::log(high / low))
    }
}
