//! Cutting, tapering and padding.

use std::f64::consts::PI;

use crate::accelerogram::Accelerogram;
use crate::error::{GroundMotionError, ascending, within};
use crate::measures::Husid;
use crate::processing::resampling::MOST_SAMPLES;
use crate::processing::whole_steps;
use crate::spectra::Evaluation;
use crate::step_record::StepRecord;

/// What a record is cut to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Trim {
    /// From one time (s) to another, at the samples that enclose them.
    Times {
        /// Start (s).
        start: f64,
        /// End (s).
        end: f64,
    },
    /// From one part of the Arias intensity to another, in (0, 1]: 0.001 to 0.999 keeps
    /// nearly all.
    Arias {
        /// First part (-).
        from: f64,
        /// Last part (-).
        to: f64,
    },
}

impl Trim {
    pub(crate) fn apply(
        self,
        record: &Accelerogram,
    ) -> Result<(Accelerogram, StepRecord), GroundMotionError> {
        const STEP: &str = "trim";
        let h = record.time_step();
        let step = StepRecord::new(STEP);
        let (start, end, step) = match self {
            Self::Times { start, end } => {
                ascending(STEP, ("start", start), ("end", end))?;
                within(STEP, "end", end, h, record.duration() * (1.0 + 1.0e-9))?;
                if end - start < h * (1.0 - 1.0e-9) {
                    return Err(GroundMotionError::NotPossible {
                        step: STEP,
                        reason: format!("{start} s to {end} s is less than a step of {h} s"),
                        remedy: "keep a longer part",
                    });
                }
                within(STEP, "start", start, 0.0, end)?;
                (start, end, step)
            }
            Self::Arias { from, to } => {
                let span = Husid::of(record, Evaluation::PiecewiseLinear)?.between(from, to)?;
                let step = step
                    .number("from part of Arias intensity", from, "-")
                    .number("to part of Arias intensity", to, "-");
                (span.start, span.end, step)
            }
        };
        let first = whole_steps(start, h);
        let last = ((end / h - 1.0e-6).ceil() as usize).min(record.samples().len() - 1);
        let kept = record.samples()[first..=last.max(first)].to_vec();
        let step = step
            .number("start", first as f64 * h, "s")
            .number("end", last as f64 * h, "s");
        let cut = record.with_samples(kept, h)?;
        Ok((cut.starting_later(first as f64 * h), step))
    }
}

pub(crate) fn taper(
    record: &Accelerogram,
    start: f64,
    end: f64,
) -> Result<(Accelerogram, StepRecord), GroundMotionError> {
    const STEP: &str = "taper";
    let (h, duration) = (record.time_step(), record.duration());
    within(STEP, "start", start, 0.0, duration)?;
    within(STEP, "end", end, 0.0, duration - start)?;
    let mut samples = record.samples().to_vec();
    let last = samples.len() - 1;
    let counts = [start, end].map(|length| whole_steps(length, h));
    for (count, reversed) in counts.into_iter().zip([false, true]) {
        for i in 0..count {
            let weight = 0.5 * (1.0 - libm::cos(PI * i as f64 / count as f64));
            samples[if reversed { last - i } else { i }] *= weight;
        }
    }
    let step = StepRecord::new(STEP)
        .number("start", counts[0] as f64 * h, "s")
        .number("end", counts[1] as f64 * h, "s");
    Ok((record.with_samples(samples, h)?, step))
}

pub(crate) fn pad(
    record: &Accelerogram,
    before: f64,
    after: f64,
) -> Result<(Accelerogram, StepRecord), GroundMotionError> {
    const STEP: &str = "pad";
    /// A day: longer is a wrong unit.
    const LONGEST: f64 = 86_400.0;
    let h = record.time_step();
    let longest = LONGEST.min(MOST_SAMPLES * h);
    within(STEP, "before", before, 0.0, longest)?;
    within(STEP, "after", after, 0.0, longest)?;
    let counts = [before, after].map(|t| (t / h - 1.0e-6).ceil().max(0.0) as usize);
    let step = StepRecord::new(STEP)
        .number("before", counts[0] as f64 * h, "s")
        .number("after", counts[1] as f64 * h, "s");
    let padded = with_zeros(record.samples(), counts[0], counts[1]);
    let padded = record.with_samples(padded, h)?;
    Ok((padded.starting_later(-(counts[0] as f64) * h), step))
}

/// Samples with zeros before and after them.
pub(crate) fn with_zeros(samples: &[f64], before: usize, after: usize) -> Vec<f64> {
    let mut padded = vec![0.0; before];
    padded.extend_from_slice(samples);
    padded.resize(before + samples.len() + after, 0.0);
    padded
}
