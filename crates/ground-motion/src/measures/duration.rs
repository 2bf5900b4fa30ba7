//! Arias intensity and durations.

use std::f64::consts::PI;

use serde::Serialize;

use crate::accelerogram::Accelerogram;
use crate::error::{GroundMotionError, ascending, within};
use crate::measures::{GRAVITY, Span};
use crate::spectra::Evaluation;

const STEP: &str = "Husid curve";

/// The growth of `pi/(2 g) int a^2 dt` with time (Husid 1969).
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Husid {
    evaluation: Evaluation,
    time_step: f64,
    samples: Vec<f64>,
    /// At each sample (m/s).
    intensity: Vec<f64>,
}

impl Husid {
    /// The curve of a record.
    ///
    /// # Errors
    /// A record of zeros, or one whose squares are beyond what numbers can hold.
    pub fn of(record: &Accelerogram, evaluation: Evaluation) -> Result<Self, GroundMotionError> {
        let h = record.time_step();
        let mut sum = 0.0;
        let mut intensity = vec![0.0];
        for a in record.samples().windows(2) {
            sum += match evaluation {
                Evaluation::AtSamples => 0.5 * h * (a[0] * a[0] + a[1] * a[1]),
                Evaluation::PiecewiseLinear => within_step(a[0], a[1], h, 1.0),
            };
            intensity.push(sum * PI / (2.0 * GRAVITY));
        }
        // Of squares beyond all numbers it is infinite, or none where they are subtracted.
        if !(sum > 0.0 && sum.is_finite()) {
            return Err(GroundMotionError::NotPossible {
                step: STEP,
                reason: match record.peak().value {
                    0.0 => "the record is zero throughout".to_owned(),
                    peak => {
                        let what = match sum == 0.0 {
                            true => "small",
                            false => "large",
                        };
                        format!("the peak acceleration {peak:e} m/s2 is too {what} to be squared")
                    }
                },
                remedy: "use another record or component, or check the unit",
            });
        }
        Ok(Self {
            evaluation,
            time_step: h,
            samples: record.samples().to_vec(),
            intensity,
        })
    }

    /// Arias intensity of the whole record (m/s).
    #[must_use]
    pub fn arias_intensity(&self) -> f64 {
        self.intensity.last().copied().unwrap_or(0.0)
    }

    /// Intensity up to each sample (m/s).
    #[must_use]
    pub fn intensity(&self) -> &[f64] {
        &self.intensity
    }

    /// Time (s) at which a part of the whole, in (0, 1], is reached.
    ///
    /// # Errors
    /// A part outside (0, 1].
    pub fn time_of(&self, part: f64) -> Result<f64, GroundMotionError> {
        within(STEP, "part", part, f64::MIN_POSITIVE, 1.0)?;
        let wanted = part * self.arias_intensity();
        let after = self
            .intensity
            .partition_point(|i| *i < wanted)
            .clamp(1, self.intensity.len() - 1);
        let (low, high) = (self.intensity[after - 1], self.intensity[after]);
        let linear = (wanted - low) / (high - low);
        let fraction = match self.evaluation {
            Evaluation::AtSamples => linear,
            Evaluation::PiecewiseLinear => {
                let (a, b) = (self.samples[after - 1], self.samples[after]);
                fraction_of_step(a, b, linear)
            }
        };
        Ok((after as f64 - 1.0 + fraction) * self.time_step)
    }

    /// From when one part of the whole (-) is reached to when another is.
    ///
    /// # Errors
    /// Parts that are not `0 < from < to <= 1`.
    pub fn between(&self, from: f64, to: f64) -> Result<Span, GroundMotionError> {
        ascending(STEP, ("first part", from), ("last part", to))?;
        Ok(Span {
            start: self.time_of(from)?,
            end: self.time_of(to)?,
        })
    }
}

/// `int a^2 dt` over the first part `x` of a step from `a` to `b`.
fn within_step(a: f64, b: f64, h: f64, x: f64) -> f64 {
    let end = a + (b - a) * x;
    h * x * (a * a + a * end + end * end) / 3.0
}

/// The part of a step in which this part of its integral is reached.
fn fraction_of_step(a: f64, b: f64, part: f64) -> f64 {
    let wanted = part * within_step(a, b, 1.0, 1.0);
    let (mut low, mut high) = (0.0, 1.0);
    // The integral grows with x: bisection down to rounding.
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if within_step(a, b, 1.0, middle) < wanted {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

/// The span between first and last time at a threshold, and the total time (s) at or
/// above it. At samples, each sample that reaches it stands for a time step.
pub(crate) fn above(
    samples: &[f64],
    h: f64,
    threshold: f64,
    evaluation: Evaluation,
) -> (Option<Span>, f64) {
    let mut span: Option<Span> = None;
    let mut extend = |start: f64, end: f64| match &mut span {
        // Of a line from one threshold to the other the later part may come first.
        Some(s) => (s.start, s.end) = (s.start.min(start), s.end.max(end)),
        None => span = Some(Span { start, end }),
    };
    let mut total = 0.0;
    if evaluation == Evaluation::AtSamples {
        for (i, a) in samples.iter().enumerate() {
            if a.abs() >= threshold {
                extend(i as f64 * h, i as f64 * h);
                total += h;
            }
        }
        return (span, total);
    }
    for (i, pair) in samples.windows(2).enumerate() {
        for sign in [1.0, -1.0] {
            let (a, b) = (sign * pair[0] - threshold, sign * pair[1] - threshold);
            if a < 0.0 && b < 0.0 {
                continue;
            }
            let crossing = if a == b { 0.0 } else { a / (a - b) };
            let from = if a >= 0.0 { 0.0 } else { crossing };
            let to = if b >= 0.0 { 1.0 } else { crossing };
            extend((i as f64 + from) * h, (i as f64 + to) * h);
            total += (to - from) * h;
        }
    }
    (span, total)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A line from one threshold to the other lies beyond both at its ends, whatever its direction.
    #[test]
    fn a_line_through_both_thresholds() {
        for samples in [[-1.0, 1.0], [1.0, -1.0]] {
            let (span, total) = above(&samples, 0.05, 0.5, Evaluation::PiecewiseLinear);
            let span = span.map(|span| (span.start, span.end));
            assert_eq!(span, Some((0.0, 0.05)), "{samples:?}");
            assert!((total - 0.025).abs() < 1e-15);
        }
    }

    /// The sign of a record says nothing of its durations.
    #[test]
    fn the_sign_of_a_record_does_not_count() {
        let samples: Vec<f64> = (0..60).map(|i| libm::sin((i * i) as f64)).collect();
        let turned: Vec<f64> = samples.iter().map(|a| -a).collect();
        for threshold in [0.1, 0.5, 0.9] {
            let [one, other] =
                [&samples, &turned].map(|s| above(s, 0.2, threshold, Evaluation::PiecewiseLinear));
            let both = [one.0, other.0].map(|s| s.map(|s| (s.start, s.end)));
            assert_eq!(both[0], both[1]);
            let first = samples.iter().position(|a| a.abs() >= threshold);
            let (start, end) = both[0].unwrap_or_default();
            assert!(start <= 0.2 * first.unwrap_or(0) as f64 && end >= start);
        }
    }
}
