//! What can be done to a record before it excites buildings: each step off unless
//! asked for, each reported with its numbers.

mod baseline;
mod butterworth;
mod plausibility;
mod resampling;
mod scaling;
mod window;

use crate::accelerogram::Accelerogram;
use crate::direction::Orientation;
use crate::error::{GroundMotionError, within};
use crate::measures::GroundMotion;
use crate::step_record::StepRecord;
use crate::unit::AccelerationUnit;

pub use crate::components::{
    RotatedPair, across_one_another, along_a_row, distinct, fault_components, is_one_series,
    rotate, start_together, starts_apart, starts_later, starts_not_compared,
};
pub use baseline::{Baseline, SegmentWindow};
pub use butterworth::{Butterworth, Phase};
pub use resampling::{Interpolation, to_even_steps};
pub use scaling::{BAND_PERIODS, BandTarget, Scale, band_factor};
pub use window::Trim;

/// What is taken off all samples.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum OffsetCorrection {
    /// The mean of the record.
    Mean,
    /// The mean of the time before the event, this long (s).
    PreEventMean(f64),
    /// This value (m/s2).
    Value(f64),
}

/// One step of processing. `T` is a band with its spectrum, as in [`Scale`].
#[derive(Debug, Clone, PartialEq)]
pub enum ProcessingStep<T = BandTarget> {
    /// The values as the file prints them are in this unit, not in the one by which they were read.
    Unit(AccelerationUnit),
    /// Turns the sign.
    Sign,
    /// Takes an offset off.
    Offset(OffsetCorrection),
    /// Filters.
    Filter(Butterworth),
    /// Corrects the baseline.
    Baseline(Baseline),
    /// Cuts a part out.
    Trim(Trim),
    /// Brings the ends to zero by half a cosine.
    Taper {
        /// Length at the start (s).
        start: f64,
        /// Length at the end (s).
        end: f64,
    },
    /// Puts zeros before and after: after, for free vibration.
    Pad {
        /// Length before (s).
        before: f64,
        /// Length after (s).
        after: f64,
    },
    /// Changes the time step.
    Resample {
        /// New time step (s).
        time_step: f64,
        /// Between samples.
        interpolation: Interpolation,
    },
    /// Scales.
    Scale(Scale<T>),
}

/// A record and what was done to it.
#[derive(Debug, Clone, PartialEq)]
pub struct Processed {
    /// The record as it is now.
    pub accelerogram: Accelerogram,
    /// What was done, in order.
    pub steps: Vec<StepRecord>,
}

impl<T> ProcessingStep<T> {
    /// The same step with the band that it scales over in another form: see
    /// [`Scale::with_target`].
    ///
    /// # Errors
    /// What `made` refuses.
    pub fn with_target<U, E>(
        &self,
        made: impl FnOnce(&T) -> Result<U, E>,
    ) -> Result<ProcessingStep<U>, E> {
        Ok(match *self {
            Self::Unit(unit) => ProcessingStep::Unit(unit),
            Self::Sign => ProcessingStep::Sign,
            Self::Offset(offset) => ProcessingStep::Offset(offset),
            Self::Filter(filter) => ProcessingStep::Filter(filter),
            Self::Baseline(baseline) => ProcessingStep::Baseline(baseline),
            Self::Trim(trim) => ProcessingStep::Trim(trim),
            Self::Taper { start, end } => ProcessingStep::Taper { start, end },
            Self::Pad { before, after } => ProcessingStep::Pad { before, after },
            Self::Resample {
                time_step,
                interpolation,
            } => ProcessingStep::Resample {
                time_step,
                interpolation,
            },
            Self::Scale(ref scale) => ProcessingStep::Scale(scale.with_target(made)?),
        })
    }

    /// The band that this step scales over, with its spectrum.
    #[must_use]
    pub fn target(&self) -> Option<&T> {
        match self {
            Self::Scale(scale) => scale.target(),
            _ => None,
        }
    }
}

impl ProcessingStep {
    /// Name in messages and reports.
    fn name(&self) -> &'static str {
        match self {
            Self::Unit(_) => "unit",
            Self::Sign => "sign",
            Self::Offset(_) => "offset",
            Self::Filter(_) => "filter",
            Self::Baseline(_) => "baseline",
            Self::Trim(_) => "trim",
            Self::Taper { .. } => "taper",
            Self::Pad { .. } => "pad",
            Self::Resample { .. } => "resampling",
            Self::Scale(_) => "scale",
        }
    }

    /// The record after this step, and what was done with its numbers, among them the ground's
    /// velocity and displacement at the end.
    ///
    /// # Errors
    /// Numbers out of range, a step that the record does not allow, or one after which a sample or
    /// a number of its report is not finite.
    pub fn apply(
        &self,
        record: &Accelerogram,
    ) -> Result<(Accelerogram, StepRecord), GroundMotionError> {
        let not_finite = |reason: String| GroundMotionError::NotPossible {
            step: self.name(),
            reason,
            remedy: "the numbers grow beyond any that can be used: check those of the step and the unit of the record",
        };
        // An accelerogram has no other samples than finite ones.
        let (next, report) = self.carried_out(record).map_err(|error| match error {
            GroundMotionError::Invalid(reason) => not_finite(reason),
            error => error,
        })?;
        debug_assert_eq!(report.step, self.name());
        // From where the record starts, as its measures do.
        let (velocity, displacement) = next.initial().unwrap_or_default();
        let motion = GroundMotion::of(&next, velocity, displacement);
        let report = report
            .number("end velocity", motion.end_velocity(), "m/s")
            .number("end displacement", motion.end_displacement(), "m");
        match report.numbers.iter().find(|n| !n.value.is_finite()) {
            Some(number) => Err(not_finite(format!("{} is {}", number.name, number.value))),
            None => {
                let warnings = plausibility::warnings(self, record, &next);
                let warned = |record: Accelerogram, w: &String| record.warned(Some(w));
                Ok((warnings.iter().fold(next, warned), report))
            }
        }
    }

    fn carried_out(
        &self,
        record: &Accelerogram,
    ) -> Result<(Accelerogram, StepRecord), GroundMotionError> {
        match self {
            Self::Unit(unit) => {
                // One that was made in memory is in m/s2.
                let read = record.origin().and_then(|o| o.unit_in_si).unwrap_or(1.0);
                let factor = unit.in_si() / read;
                let step = StepRecord::new("unit")
                    .number("factor", factor, "-")
                    .remark(format!("values of the file are in {}", unit.symbol()));
                let mut corrected = times(record, factor)?;
                corrected.read_in(unit.in_si());
                Ok((corrected, step))
            }
            Self::Sign => {
                let orientation = record.origin().and_then(|o| o.orientation);
                let turned = times(record, -1.0)?;
                let turned = turned.pointing(orientation.map(Orientation::reversed));
                Ok((turned, StepRecord::new("sign")))
            }
            Self::Offset(offset) => remove_offset(record, *offset),
            Self::Filter(filter) => filter.apply(record),
            Self::Baseline(baseline) => baseline.apply(record),
            Self::Trim(trim) => trim.apply(record),
            Self::Taper { start, end } => window::taper(record, *start, *end),
            Self::Pad { before, after } => window::pad(record, *before, *after),
            Self::Resample {
                time_step,
                interpolation,
            } => resampling::resample(record, *time_step, *interpolation),
            Self::Scale(scale) => scale.apply(record),
        }
    }
}

/// Does the steps in the order given. Each is recorded with its numbers and with the
/// ground's velocity and displacement at the end after it, by which users judge a
/// baseline.
///
/// # Errors
/// The first step that is out of range or that the record does not allow.
pub fn process(
    record: &Accelerogram,
    steps: &[ProcessingStep],
) -> Result<Processed, GroundMotionError> {
    let mut accelerogram = record.clone();
    let mut done = Vec::with_capacity(steps.len());
    for step in steps {
        let (next, report) = step.apply(&accelerogram)?;
        done.push(report);
        accelerogram = next;
    }
    accelerogram.note(&done);
    Ok(Processed {
        accelerogram,
        steps: done,
    })
}

/// The record times a factor that is no scale: the samples were wrong before.
fn times(record: &Accelerogram, factor: f64) -> Result<Accelerogram, GroundMotionError> {
    let samples = record.samples().iter().map(|a| a * factor).collect();
    let initial = record.initial().map(|(v, d)| (v * factor, d * factor));
    Ok(record
        .with_samples(samples, record.time_step())?
        .with_initial(initial))
}

fn remove_offset(
    record: &Accelerogram,
    offset: OffsetCorrection,
) -> Result<(Accelerogram, StepRecord), GroundMotionError> {
    const STEP: &str = "offset";
    let samples = record.samples();
    let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
    let step = StepRecord::new(STEP);
    let (value, step) = match offset {
        OffsetCorrection::Mean => (mean(samples), step.remark("mean of the record")),
        OffsetCorrection::PreEventMean(length) => {
            let shortest = record.time_step();
            within(STEP, "length", length, shortest, record.duration())?;
            let count = whole_steps(length, record.time_step()) + 1;
            (
                mean(&samples[..count.min(samples.len())]),
                step.number("length", length, "s"),
            )
        }
        OffsetCorrection::Value(value) => (value, step),
    };
    let shifted = samples.iter().map(|a| a - value).collect();
    Ok((
        record.with_samples(shifted, record.time_step())?,
        step.number("offset", value, "m/s2"),
    ))
}

/// Whole time steps in a time: a millionth of a step short counts as whole.
pub(crate) fn whole_steps(time: f64, step: f64) -> usize {
    (time / step + 1.0e-6).floor().max(0.0) as usize
}
