//! Cumulative absolute velocity.

use crate::spectra::Evaluation;

/// A second that lacks less than this (s) counts as whole: time steps are rounded.
const SHORT: f64 = 1.0e-6;

/// `int |a| dt` of a step from `a` to `b` of length `h`.
fn absolute(a: f64, b: f64, h: f64, evaluation: Evaluation) -> f64 {
    if evaluation == Evaluation::AtSamples || a * b >= 0.0 {
        return 0.5 * h * (a.abs() + b.abs());
    }
    0.5 * h * (a * a + b * b) / (a - b).abs()
}

/// `int |a| dt` (m/s).
pub(crate) fn absolute_velocity(samples: &[f64], h: f64, evaluation: Evaluation) -> f64 {
    samples
        .windows(2)
        .map(|a| absolute(a[0], a[1], h, evaluation))
        .sum()
}

/// `int |a| dt` (m/s) over those seconds from the first sample in which the peak
/// reaches a threshold; a last part of a second counts like a second. Steps that a
/// second ends in are divided there.
pub(crate) fn standardised(samples: &[f64], h: f64, threshold: f64, evaluation: Evaluation) -> f64 {
    let (mut total, mut second, mut peak) = (0.0, 0.0, samples[0].abs());
    let mut left = 1.0;
    for pair in samples.windows(2) {
        let (mut from, mut rest) = (pair[0], h);
        while rest > left - SHORT * h.min(1.0) {
            let length = left.min(rest);
            let to = from + (pair[1] - from) * length / rest;
            second += absolute(from, to, length, evaluation);
            peak = to.abs().max(peak);
            if peak >= threshold {
                total += second;
            }
            (second, peak, left) = (0.0, to.abs(), 1.0);
            (from, rest) = (to, rest - length);
        }
        if rest > SHORT * h {
            second += absolute(from, pair[1], rest, evaluation);
            peak = peak.max(pair[1].abs());
            left -= rest;
        }
    }
    if peak >= threshold {
        total += second;
    }
    total
}
