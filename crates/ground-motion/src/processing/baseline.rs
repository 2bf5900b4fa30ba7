//! Baseline corrections.

use crate::accelerogram::Accelerogram;
use crate::error::{GroundMotionError, ascending, bound, positive, within};
use crate::measures::GroundMotion;
use crate::step_record::StepRecord;

const STEP: &str = "baseline";

/// Where the two segments are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SegmentWindow {
    /// From one time (s) to another.
    Times {
        /// Start t1 of the first segment (s).
        start: f64,
        /// End t2 of the first segment (s).
        end: f64,
    },
    /// From the first to the last sample at an acceleration (m/s2): 0.5 m/s2 in Iwan,
    /// Moser and Peng (1985), Bull. Seism. Soc. Am. 75 (5) 1225.
    Threshold(f64),
}

/// A baseline correction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Baseline {
    /// Takes the polynomial that fits the acceleration best off it.
    Acceleration {
        /// Degree, 0 to 5.
        degree: usize,
    },
    /// Takes the derivative of the polynomial without constant term that fits the
    /// velocity best off the acceleration.
    Velocity {
        /// Degree, 1 to 5.
        degree: usize,
    },
    /// Boore (2001), Bull. Seism. Soc. Am. 91 (5) 1199: a line `v0 + af t` is fitted
    /// to the velocity at the end; `af` is taken off the acceleration after t2, and
    /// between t1 and t2 the constant `am = (v0 + af t2)/(t2 - t1)` that reaches
    /// the line.
    TwoSegments {
        /// t1 and t2.
        window: SegmentWindow,
        /// Start of the fit (s); `None`: t2.
        fit_from: Option<f64>,
    },
}

impl Baseline {
    pub(crate) fn apply(
        self,
        record: &Accelerogram,
    ) -> Result<(Accelerogram, StepRecord), GroundMotionError> {
        match self {
            Self::Acceleration { degree } => of_acceleration(record, degree),
            Self::Velocity { degree } => of_velocity(record, degree),
            Self::TwoSegments { window, fit_from } => two_segments(record, window, fit_from),
        }
    }
}

fn of_acceleration(
    record: &Accelerogram,
    degree: usize,
) -> Result<(Accelerogram, StepRecord), GroundMotionError> {
    within(STEP, "degree", degree as f64, 0.0, 5.0)?;
    let samples = record.samples();
    let times = positions(samples.len());
    let coefficients = fit(&times, samples, 0, degree)?;
    let corrected = samples
        .iter()
        .zip(&times)
        .map(|(a, x)| a - polynomial(&coefficients, *x))
        .collect();
    let mut step = StepRecord::new(STEP)
        .number("degree", degree as f64, "-")
        .remark("polynomial fitted to the acceleration; coefficients of (t/duration)^k");
    for (name, value) in COEFFICIENTS.iter().zip(&coefficients) {
        step = step.number(name, *value, "m/s2");
    }
    Ok((record.with_samples(corrected, record.time_step())?, step))
}

fn of_velocity(
    record: &Accelerogram,
    degree: usize,
) -> Result<(Accelerogram, StepRecord), GroundMotionError> {
    within(STEP, "degree", degree as f64, 1.0, 5.0)?;
    let samples = record.samples();
    let velocity = GroundMotion::of(record, 0.0, 0.0).velocity;
    let times = positions(samples.len());
    let coefficients = fit(&times, &velocity, 1, degree)?;
    let duration = record.duration();
    let derivative: Vec<f64> = (1..coefficients.len())
        .map(|k| k as f64 * coefficients[k] / duration)
        .collect();
    let corrected = samples
        .iter()
        .zip(&times)
        .map(|(a, x)| a - polynomial(&derivative, *x))
        .collect();
    let mut step = StepRecord::new(STEP)
        .number("degree", degree as f64, "-")
        .remark("polynomial fitted to the velocity; coefficients of (t/duration)^k");
    for (name, value) in COEFFICIENTS.iter().zip(&coefficients).skip(1) {
        step = step.number(name, *value, "m/s");
    }
    Ok((record.with_samples(corrected, record.time_step())?, step))
}

const COEFFICIENTS: [&str; 6] = [
    "coefficient 0",
    "coefficient 1",
    "coefficient 2",
    "coefficient 3",
    "coefficient 4",
    "coefficient 5",
];

fn two_segments(
    record: &Accelerogram,
    window: SegmentWindow,
    fit_from: Option<f64>,
) -> Result<(Accelerogram, StepRecord), GroundMotionError> {
    let (h, samples) = (record.time_step(), record.samples());
    let (start, end) = segment(record, window)?;
    let (first, last) = ((start / h).round() as usize, (end / h).round() as usize);
    if last <= first {
        return Err(GroundMotionError::NotPossible {
            step: STEP,
            reason: format!("the first segment from {start} s to {end} s has no length"),
            remedy: "give times t1 < t2 at least a time step apart",
        });
    }
    let end = last as f64 * h;
    let latest = record.duration() - 2.0 * h;
    let from = match fit_from {
        Some(from) => within(STEP, "start of the fit", from, 0.0, latest)?,
        // It was not asked for by a key of its own.
        None if end > latest => {
            return Err(GroundMotionError::NotPossible {
                step: STEP,
                reason: format!(
                    "a line is fitted to the velocity from the end of the first segment, {} s, which leaves less than two time steps to the end of the record, {} s",
                    bound(end),
                    bound(record.duration())
                ),
                remedy: "end the first segment earlier, or say where the fit starts (`fit_from`)",
            });
        }
        None => end,
    };
    let velocity = GroundMotion::of(record, 0.0, 0.0).velocity;
    let tail = (from / h).round() as usize;
    let times: Vec<f64> = (tail..samples.len()).map(|i| i as f64 * h - end).collect();
    // About t2, where the line's value is what the first segment must reach.
    let line = fit(&times, &velocity[tail..], 0, 1)?;
    let (reached, final_rate) = (line[0], line[1]);
    let middle_rate = reached / ((last - first) as f64 * h);
    let mut corrected = samples.to_vec();
    for (i, a) in corrected.iter_mut().enumerate().skip(first) {
        // A sample on a jump takes the mean: then the integral is exact.
        *a -= if i == first {
            0.5 * middle_rate
        } else if i < last {
            middle_rate
        } else if i == last {
            0.5 * (middle_rate + final_rate)
        } else {
            final_rate
        };
    }
    let step = StepRecord::new(STEP)
        .number("t1", first as f64 * h, "s")
        .number("t2", end, "s")
        .number("start of the fit", tail as f64 * h, "s")
        .number("v0", reached - final_rate * end, "m/s")
        .number("af", final_rate, "m/s2")
        .number("am", middle_rate, "m/s2")
        .remark("two segments");
    Ok((record.with_samples(corrected, h)?, step))
}

fn segment(record: &Accelerogram, window: SegmentWindow) -> Result<(f64, f64), GroundMotionError> {
    match window {
        SegmentWindow::Times { start, end } => {
            within(STEP, "t1", start, 0.0, record.duration())?;
            within(STEP, "t2", end, 0.0, record.duration())?;
            ascending(STEP, ("t1", start), ("t2", end))?;
            Ok((start, end))
        }
        SegmentWindow::Threshold(threshold) => {
            positive(STEP, "threshold", threshold)?;
            let samples = record.samples();
            let reaches = |a: &f64| a.abs() >= threshold;
            let ends = (
                samples.iter().position(reaches),
                samples.iter().rposition(reaches),
            );
            let (Some(first), Some(last)) = ends else {
                return Err(GroundMotionError::NotPossible {
                    step: STEP,
                    reason: format!("the record never reaches {threshold} m/s2"),
                    remedy: "give a lower threshold, or times t1 and t2",
                });
            };
            Ok((
                first as f64 * record.time_step(),
                last as f64 * record.time_step(),
            ))
        }
    }
}

/// `t/duration` of each sample.
fn positions(count: usize) -> Vec<f64> {
    (0..count).map(|i| i as f64 / (count - 1) as f64).collect()
}

fn polynomial(coefficients: &[f64], x: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * x + c)
}

/// Coefficients of x^0 to x^`highest`, those below `lowest` zero.
fn fit(x: &[f64], y: &[f64], lowest: usize, highest: usize) -> Result<Vec<f64>, GroundMotionError> {
    let columns = (lowest..=highest)
        .map(|k| x.iter().map(|x| x.powi(k as i32)).collect())
        .collect();
    let Some(found) = least_squares(columns, y) else {
        return Err(GroundMotionError::NotPossible {
            step: STEP,
            reason: format!("{} samples do not determine degree {highest}", x.len()),
            remedy: "take a lower degree or a longer record",
        });
    };
    let mut coefficients = vec![0.0; lowest];
    coefficients.extend(found);
    Ok(coefficients)
}

/// Factors of columns whose sum is nearest to `y`, by orthogonalising the columns
/// (modified Gram-Schmidt); `None` where they depend on one another.
fn least_squares(mut columns: Vec<Vec<f64>>, y: &[f64]) -> Option<Vec<f64>> {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let count = columns.len();
    let mut rest = y.to_vec();
    let mut upper = vec![vec![0.0; count]; count];
    let mut right = vec![0.0; count];
    for i in 0..count {
        let length = dot(&columns[i], &columns[i]).sqrt();
        let (done, after) = columns.split_at_mut(i + 1);
        let column = &mut done[i];
        // Each column was of a length of its own before those before it were taken off.
        let before: f64 = (0..i).map(|k| upper[k][i] * upper[k][i]).sum();
        if !(length > 1.0e-10 * (before + length * length).sqrt()) {
            return None;
        }
        upper[i][i] = length;
        column.iter_mut().for_each(|c| *c /= length);
        for (k, other) in after.iter_mut().enumerate() {
            let part = dot(column, other);
            upper[i][i + 1 + k] = part;
            other
                .iter_mut()
                .zip(&*column)
                .for_each(|(o, c)| *o -= part * c);
        }
        right[i] = dot(column, &rest);
        rest.iter_mut()
            .zip(&*column)
            .for_each(|(r, c)| *r -= right[i] * c);
    }
    for i in (0..count).rev() {
        let above: f64 = (i + 1..count).map(|k| upper[i][k] * right[k]).sum();
        right[i] = (right[i] - above) / upper[i][i];
    }
    Some(right)
}
