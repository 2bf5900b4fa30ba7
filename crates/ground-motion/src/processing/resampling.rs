//! Other time steps.

use std::f64::consts::PI;

use serde::Deserialize;

use crate::accelerogram::Accelerogram;
use crate::error::{GroundMotionError, positive};
use crate::recording::{Sampling, Series};
use crate::spectra::{inverse_transform, transform};
use crate::step_record::StepRecord;
use crate::unit::AccelerationUnit;

const STEP: &str = "resampling";
/// Most samples a record may become: a wrong unit of the time step makes more.
pub(super) const MOST_SAMPLES: f64 = 5.0e7;
/// Maximum denominator of a ratio of time steps.
const GREATEST_DENOMINATOR: usize = 2000;
/// How near the ratio must be to a fraction.
const RATIO_TOLERANCE: f64 = 1.0e-9;
/// Parts of the new sampling frequency between which amplitudes go down to zero
/// when samples become fewer.
const PASS: f64 = 0.4;
const STOP: f64 = 0.5;

/// What lies between samples.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case", expecting = "a text in quotes")]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub enum Interpolation {
    /// Straight lines, as the time history takes them. Only to steps that are not
    /// longer.
    Linear,
    /// The band below the Nyquist frequency, through the Fourier transform of the
    /// record and zeros after it. Peaks grow a little. To longer steps, what lies
    /// above 0.4 of the new sampling frequency is taken off by a cosine first.
    BandLimited,
}

pub(crate) fn resample(
    record: &Accelerogram,
    time_step: f64,
    interpolation: Interpolation,
) -> Result<(Accelerogram, StepRecord), GroundMotionError> {
    positive(STEP, "time step", time_step)?;
    let h = record.time_step();
    let count = new_count(record.duration(), time_step)?;
    let (samples, how) = match interpolation {
        Interpolation::Linear => {
            if time_step > h * (1.0 + RATIO_TOLERANCE) {
                return Err(GroundMotionError::NotPossible {
                    step: STEP,
                    reason: format!("{time_step} s is longer than the record's {h} s"),
                    remedy: "use band-limited interpolation, which takes off what longer steps cannot hold",
                });
            }
            (
                interpolate_linearly(record.samples(), h, time_step, count),
                "linear",
            )
        }
        Interpolation::BandLimited => (
            band_limited(record.samples(), h, time_step, count)?,
            "band-limited",
        ),
    };
    let step = StepRecord::new(STEP)
        .number("from time step", h, "s")
        .number("to time step", time_step, "s")
        .number("samples", count as f64, "-")
        .remark(how);
    Ok((record.with_samples(samples, time_step)?, step))
}

fn new_count(duration: f64, time_step: f64) -> Result<usize, GroundMotionError> {
    let count = (duration / time_step * (1.0 + 1.0e-12) + 1.0e-9).floor() + 1.0;
    if (2.0..=MOST_SAMPLES).contains(&count) {
        return Ok(count as usize);
    }
    Err(GroundMotionError::OutOfRange {
        step: STEP,
        name: "time step",
        value: time_step,
        range: format!("[{:e}, {duration}]", duration / MOST_SAMPLES),
    })
}

/// `count` values at steps of `to`, straight lines between samples at steps of `from`;
/// the last value beyond the last sample.
fn interpolate_linearly(samples: &[f64], from: f64, to: f64, count: usize) -> Vec<f64> {
    let last = samples.len() - 1;
    (0..count)
        .map(|i| {
            let place = (i as f64 * to / from).min(last as f64);
            let k = (place as usize).min(last - 1);
            let part = place - k as f64;
            samples[k] + part * (samples[k + 1] - samples[k])
        })
        .collect()
}

fn band_limited(
    samples: &[f64],
    h: f64,
    time_step: f64,
    count: usize,
) -> Result<Vec<f64>, GroundMotionError> {
    let Some((new, old)) = fraction(time_step / h) else {
        return Err(GroundMotionError::NotPossible {
            step: STEP,
            reason: format!("{time_step} s to {h} s is not a ratio of small whole numbers"),
            remedy: "choose a step in a simple ratio to the record's, or linear interpolation",
        });
    };
    // old * time_step = new * h: both step through `blocks` such stretches. As many
    // zeros as samples keep the end of the record off its start.
    let blocks = (2 * samples.len()).div_ceil(new);
    let (length, new_length) = (blocks * new, blocks * old);
    let mut coefficients = transform(samples, length);
    let total = length as f64 * h;
    if new_length < length {
        for (k, c) in coefficients.iter_mut().enumerate() {
            let part = (k as f64 / total * time_step - PASS) / (STOP - PASS);
            *c *= 0.5 * (1.0 + libm::cos(PI * part.clamp(0.0, 1.0)));
        }
    } else if length.is_multiple_of(2) && new_length > length {
        // The Nyquist term stands for two, one at each sign of the frequency.
        coefficients[length / 2] *= 0.5;
    }
    let ratio = new_length as f64 / length as f64;
    let mut values = inverse_transform(coefficients, new_length);
    values.truncate(count);
    values.iter_mut().for_each(|a| *a *= ratio);
    Ok(values)
}

/// The fraction with a small denominator that a number is, by continued fractions.
fn fraction(value: f64) -> Option<(usize, usize)> {
    let (mut rest, mut above, mut below) = (value, (1.0, 0.0), (0.0, 1.0));
    for _ in 0..30 {
        let whole = rest.floor();
        above = (whole * above.0 + above.1, above.0);
        below = (whole * below.0 + below.1, below.0);
        if above.0.max(below.0) > GREATEST_DENOMINATOR as f64 {
            return None;
        }
        if (above.0 / below.0 - value).abs() <= RATIO_TOLERANCE * value {
            return Some((above.0 as usize, below.0 as usize));
        }
        rest = 1.0 / (rest - whole);
    }
    None
}

/// An acceleration at even steps from a series of a file, even or not: straight lines
/// between its samples. `time_step` (s); `None`: the median of the series. With
/// [`Interpolation::BandLimited`] a longer step is reached through the median one.
///
/// # Errors
/// A step longer than the mean one with linear interpolation, or one that makes too
/// many samples.
pub fn to_even_steps(
    series: &Series,
    time_step: Option<f64>,
    interpolation: Interpolation,
) -> Result<(Accelerogram, StepRecord), GroundMotionError> {
    let unit = AccelerationUnit::MetrePerSecondSquared;
    let times = match &series.sampling {
        Sampling::Even { time_step: step } => {
            let record = Accelerogram::new(series.samples.clone(), unit, *step)?
                .with_origin(series.origin.clone());
            return resample(&record, time_step.unwrap_or(*step), interpolation);
        }
        Sampling::Uneven { times } if times.len() >= 2 => times,
        Sampling::Uneven { .. } => {
            return Err(GroundMotionError::Invalid(
                "fewer than two samples".to_owned(),
            ));
        }
    };
    let mut steps: Vec<f64> = times.windows(2).map(|t| t[1] - t[0]).collect();
    steps.sort_by(f64::total_cmp);
    let (median, largest) = (steps[steps.len() / 2], steps[steps.len() - 1]);
    let span = times[times.len() - 1] - times[0];
    let mean = span / steps.len() as f64;
    let wanted = positive(STEP, "time step", time_step.unwrap_or(median))?;
    // A thousandth: 0.005 s stands for film steps of 0.0050007 s and back.
    let parts = (wanted / median * 0.999).ceil();
    let fine = if interpolation == Interpolation::BandLimited && parts > 1.0 {
        wanted / parts
    } else {
        wanted
    };
    if fine > mean.max(median) * 1.001 {
        return Err(GroundMotionError::NotPossible {
            step: STEP,
            reason: format!("{wanted} s is longer than the record's mean step of {mean} s"),
            remedy: "use band-limited interpolation, which takes off what longer steps cannot hold",
        });
    }
    let count = new_count(span, fine)?;
    let samples = at_even_times(times, &series.samples, fine, count);
    let record = Accelerogram::new(samples, unit, fine)?.with_origin(series.origin.clone());
    let uneven = StepRecord::new(STEP)
        .number("uneven samples", times.len() as f64, "-")
        .number("median step", median, "s")
        .number("largest gap", largest, "s")
        .number("to time step", wanted, "s");
    if fine == wanted {
        return Ok((
            record,
            uneven
                .number("samples", count as f64, "-")
                .remark("linear, from uneven times"),
        ));
    }
    let (record, step) = resample(&record, wanted, interpolation)?;
    let report = uneven
        .number("step between", fine, "s")
        .number("samples", step.get("samples").unwrap_or(f64::NAN), "-")
        .remark("linear from uneven times, then band-limited");
    Ok((record, report))
}

/// Straight lines between values at increasing times.
fn at_even_times(times: &[f64], values: &[f64], step: f64, count: usize) -> Vec<f64> {
    let last = times[times.len() - 1];
    let mut k = 0;
    (0..count)
        .map(|i| {
            let t = (times[0] + i as f64 * step).min(last);
            while k + 2 < times.len() && times[k + 1] < t {
                k += 1;
            }
            let part = (t - times[k]) / (times[k + 1] - times[k]);
            values[k] + part * (values[k + 1] - values[k])
        })
        .collect()
}
