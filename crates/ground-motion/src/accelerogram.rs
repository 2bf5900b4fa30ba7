//! An accelerogram with its origin.

use std::sync::Arc;

use pounding_catalogue::numbers::fixed_or_small;
use serde::{Deserialize, Serialize};
use sha2::{Digest as _, Sha256};

use crate::direction::Orientation;
use crate::error::{GroundMotionError, rounded};
use crate::origin::Origin;
use crate::step_record::StepRecord;
use crate::time_step::{impossible_step, unusual_step};
use crate::unit::AccelerationUnit;

/// A maximum absolute value and its time.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Peak {
    /// Absolute value (SI: m/s2 for an acceleration).
    pub value: f64,
    /// Time (s).
    pub time: f64,
}

/// What an accelerogram tells of itself besides its samples; serialised, it goes with them to
/// another process.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct AccelerogramHistory {
    /// Factor applied to the recorded values.
    scale: f64,
    /// Velocity (m/s) and displacement (m) at the first sample.
    initial: Option<(f64, f64)>,
    origin: Option<Origin>,
    steps: Vec<StepRecord>,
}

/// Ground acceleration at even steps, the first sample at time zero.
#[derive(Debug, Clone, PartialEq)]
pub struct Accelerogram {
    // Shared by copies; a vector, as a slice would be a second copy while a file is read.
    samples: Arc<Vec<f64>>,
    time_step: f64,
    history: AccelerogramHistory,
}

impl Accelerogram {
    /// An accelerogram from samples in a unit and a time step (s).
    ///
    /// # Errors
    /// Fewer than two samples, a sample that is not finite in SI units, or a time step that is
    /// not between 1e-9 s and 1e6 s.
    pub fn new(
        samples: Vec<f64>,
        unit: AccelerationUnit,
        time_step: f64,
    ) -> Result<Self, GroundMotionError> {
        if let Some(wrong) = impossible_step(time_step) {
            return Err(GroundMotionError::Invalid(wrong));
        }
        if samples.len() < 2 {
            return Err(GroundMotionError::Invalid(format!(
                "{} samples; at least two are needed",
                samples.len()
            )));
        }
        let factor = unit.in_si();
        let samples: Vec<f64> = samples.into_iter().map(|a| a * factor).collect();
        if let Some(i) = samples.iter().position(|a| !a.is_finite()) {
            return Err(GroundMotionError::Invalid(format!(
                "sample {} is {}",
                i + 1,
                samples[i]
            )));
        }
        Ok(Self {
            samples: Arc::new(samples),
            time_step,
            history: AccelerogramHistory {
                scale: 1.0,
                initial: None,
                origin: None,
                steps: Vec::new(),
            },
        })
    }

    /// What it tells of itself besides its samples.
    #[must_use]
    pub fn history(&self) -> &AccelerogramHistory {
        &self.history
    }

    /// The same samples with what another accelerogram tells, of which they are a copy.
    #[must_use]
    pub fn with_history(mut self, history: AccelerogramHistory) -> Self {
        self.history = history;
        self
    }

    /// Velocity (m/s) and displacement (m) at the first sample, where the file states them and the
    /// record is still as it was read, but for its scale.
    #[must_use]
    pub fn initial(&self) -> Option<(f64, f64)> {
        self.history.initial
    }

    pub(crate) fn with_initial(mut self, initial: Option<(f64, f64)>) -> Self {
        self.history.initial = initial;
        self
    }

    /// What is to be said of a time step that no accelerograph has: mostly one that is wrong by a
    /// power of ten.
    #[must_use]
    pub fn unusual_time_step(&self) -> Option<String> {
        unusual_step(self.time_step, self.samples.len())
    }

    pub(crate) fn with_origin(mut self, mut origin: Origin) -> Self {
        let peak = self.peak();
        if peak.value > 30.0 {
            origin.warnings.push(format!(
                "peak acceleration {:.3} m/s2 is larger than any recorded; check the unit",
                peak.value
            ));
        } else if peak.value == 0.0 {
            let message = "all samples are zero: the ground stands still";
            origin.warnings.push(message.to_owned());
        } else if peak.value < 1.0e-3 {
            origin.warnings.push(format!(
                "peak acceleration {} m/s2 is not felt; check the unit",
                rounded(peak.value, 4)
            ));
        }
        self.history.origin = Some(origin);
        self
    }

    /// The same record as one that is given in memory under a name. One that no file holds as it is,
    /// since it was made of numbers, scaled or processed, has the [hash](Self::sha256) of its samples.
    #[must_use]
    pub fn of_memory(mut self, name: &str) -> Self {
        let sha256 = self.sha256();
        let as_read = self.history.scale == 1.0 && self.history.steps.is_empty();
        match &mut self.history.origin {
            Some(_) if as_read => self,
            Some(origin) => {
                origin.sha256 = sha256;
                self
            }
            None => {
                let origin = Origin {
                    file: name.to_owned(),
                    format: "array in memory".into(),
                    unit: AccelerationUnit::MetrePerSecondSquared.symbol().to_owned(),
                    time_step: format!("{} s", self.time_step),
                    warnings: self.unusual_time_step().into_iter().collect(),
                    sha256,
                    ..Origin::default()
                };
                self.with_origin(origin)
            }
        }
    }

    /// SHA-256, hexadecimal, of the time step (s) and the samples (m/s2), numbers of eight bytes from
    /// the lowest on.
    #[must_use]
    pub fn sha256(&self) -> String {
        let mut hash = Sha256::new();
        hash.update(self.time_step.to_le_bytes());
        for a in self.samples.iter() {
            hash.update(a.to_le_bytes());
        }
        hash.finalize().iter().map(|b| format!("{b:02x}")).collect()
    }

    /// The same record with other samples (m/s2) and time step (s): where it came
    /// from and its scale stay.
    pub(crate) fn with_samples(
        &self,
        samples: Vec<f64>,
        time_step: f64,
    ) -> Result<Self, GroundMotionError> {
        let unit = AccelerationUnit::MetrePerSecondSquared;
        let mut other = Self::new(samples, unit, time_step)?;
        other.history = AccelerogramHistory {
            initial: None,
            ..self.history.clone()
        };
        Ok(other)
    }

    /// Says in which unit (m/s2) the values of its file are.
    pub(crate) fn read_in(&mut self, unit_in_si: f64) {
        if let Some(origin) = &mut self.history.origin {
            origin.unit_in_si = Some(unit_in_si);
        }
    }

    /// The same record whose first sample is so much later (s) than before. A printed time that is
    /// not understood is left out, with a warning: it would be that of another sample.
    pub(crate) fn starting_later(mut self, by: f64) -> Self {
        if let Some(origin) = &mut self.history.origin {
            origin.start_later(by);
        }
        self
    }

    /// The same record with positive values in another direction; `None`: not known.
    pub(crate) fn pointing(mut self, orientation: Option<Orientation>) -> Self {
        if let Some(origin) = &mut self.history.origin {
            origin.orientation = orientation;
        }
        self
    }

    /// The same record as a component of another name.
    pub(crate) fn called(mut self, component: String) -> Self {
        if let Some(origin) = &mut self.history.origin {
            origin.component = component;
        }
        self
    }

    /// The same record with a warning, where it has an origin to say it with.
    pub(crate) fn warned(mut self, warning: Option<&str>) -> Self {
        if let (Some(origin), Some(warning)) = (&mut self.history.origin, warning) {
            origin.warnings.push(warning.to_owned());
        }
        self
    }

    /// Notes that these steps made it what it is.
    pub(crate) fn note(&mut self, steps: &[StepRecord]) {
        self.history.steps.extend_from_slice(steps);
    }

    /// Samples (m/s2), scale applied.
    #[must_use]
    pub fn samples(&self) -> &[f64] {
        &self.samples
    }

    /// The same in the memory that copies of this accelerogram share.
    #[must_use]
    pub fn shared_samples(&self) -> Arc<Vec<f64>> {
        Arc::clone(&self.samples)
    }

    /// Time step (s).
    #[must_use]
    pub fn time_step(&self) -> f64 {
        self.time_step
    }

    /// Time of the last sample (s).
    #[must_use]
    pub fn duration(&self) -> f64 {
        (self.samples.len() - 1) as f64 * self.time_step
    }

    /// Factor applied to the recorded values.
    #[must_use]
    pub fn scale(&self) -> f64 {
        self.history.scale
    }

    /// Where it came from; `None` if it was built in memory.
    #[must_use]
    pub fn origin(&self) -> Option<&Origin> {
        self.history.origin.as_ref()
    }

    /// What was done to it since it was read or how it was generated, in order.
    #[must_use]
    pub fn steps(&self) -> &[StepRecord] {
        &self.history.steps
    }

    /// Peak ground acceleration (m/s2) and its time.
    #[must_use]
    pub fn peak(&self) -> Peak {
        let mut peak = Peak {
            value: 0.0,
            time: 0.0,
        };
        for (i, a) in self.samples.iter().enumerate() {
            if a.abs() > peak.value {
                peak = Peak {
                    value: a.abs(),
                    time: i as f64 * self.time_step,
                };
            }
        }
        peak
    }

    /// The record times a factor.
    ///
    /// # Errors
    /// A factor that is zero or not finite.
    pub fn scaled_by(&self, factor: f64) -> Result<Self, GroundMotionError> {
        if !(factor.is_finite() && factor != 0.0) {
            return Err(GroundMotionError::Invalid(format!(
                "scale factor {factor} must be finite and not zero"
            )));
        }
        let mut scaled = self.clone();
        scaled.history.scale *= factor;
        scaled.history.initial = self.initial().map(|(v, d)| (v * factor, d * factor));
        if factor != 1.0 {
            scaled.samples = Arc::new(self.samples.iter().map(|a| a * factor).collect());
        }
        let peak = scaled.peak().value;
        if !(peak.is_finite() && scaled.scale().is_finite()) {
            return Err(GroundMotionError::Invalid(format!(
                "scaled by {factor:e}, the record has a peak of {peak} m/s2"
            )));
        }
        Ok(scaled)
    }

    /// The record scaled to a peak ground acceleration (m/s2).
    ///
    /// # Errors
    /// A target that is not positive, or a record of zeros.
    pub fn scaled_to_peak(&self, target: f64) -> Result<Self, GroundMotionError> {
        let peak = self.peak().value;
        if !(target > 0.0 && peak > 0.0) {
            return Err(GroundMotionError::Invalid(format!(
                "a record with peak {peak} m/s2 cannot be scaled to {target} m/s2"
            )));
        }
        self.scaled_by(target / peak)
    }

    /// What was read, a line each, for the user.
    #[must_use]
    pub fn echo(&self) -> Vec<String> {
        let mut lines = Vec::new();
        if let Some(origin) = &self.history.origin {
            lines.push(format!("{} ({})", origin.file, origin.format));
            if !origin.title.is_empty() {
                lines.push(origin.title.clone());
            }
            if !origin.component.is_empty() {
                lines.push(format!("component {}", origin.component));
            }
            lines.push(format!(
                "unit {}, time step {}",
                origin.unit, origin.time_step
            ));
        }
        lines.extend(self.history.steps.iter().map(ToString::to_string));
        let peak = self.peak();
        lines.push(format!(
            "{} samples at {} s, duration {} s, peak {} m/s2 = {} g at {:.4} s, scale {}",
            self.samples.len(),
            self.time_step,
            (self.duration() * 1e9).round() / 1e9,
            fixed_or_small(peak.value, 5),
            fixed_or_small(peak.value / AccelerationUnit::StandardGravity.in_si(), 5),
            peak.time,
            self.history.scale
        ));
        lines
    }
}
