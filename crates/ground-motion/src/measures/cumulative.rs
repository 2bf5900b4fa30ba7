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

/// Seconds in a step from which on they are not counted one by one.
const MANY: f64 = 8.0;

/// A straight line through many seconds.
struct Line {
    from: f64,
    slope: f64,
}

impl Line {
    fn at(&self, time: f64) -> f64 {
        self.from + self.slope * time
    }

    /// `int |a| dt` over those of so many seconds in which the peak reaches a threshold: the first ones and the last
    /// ones, as the peak of a second falls towards that in which the line is zero, and rises from there on.
    fn seconds(&self, count: f64, threshold: f64, evaluation: Evaluation) -> f64 {
        let reaches = |second: f64| {
            let peak = self.at(second).abs().max(self.at(second + 1.0).abs());
            peak >= threshold
        };
        let zero = -self.from / self.slope;
        let bottom = match zero.is_finite() {
            true => zero.floor().clamp(0.0, count - 1.0),
            false => 0.0,
        };
        // The first second in this range, or its end, in which `reaches` is not what it is at its begin.
        let change = |mut from: f64, mut to: f64, first: bool| {
            while from < to {
                let middle = ((from + to) / 2.0).floor();
                match reaches(middle) == first {
                    true => from = middle + 1.0,
                    false => to = middle,
                }
            }
            from
        };
        let before = change(0.0, bottom + 1.0, true);
        let after = change(bottom, count, false).max(before);
        // The second in which the line is zero stands alone.
        let integral = |from: f64, to: f64| {
            let ends = [
                from,
                bottom.clamp(from, to),
                (bottom + 1.0).clamp(from, to),
                to,
            ];
            let parts = ends.windows(2);
            let parts =
                parts.map(|p| absolute(self.at(p[0]), self.at(p[1]), p[1] - p[0], evaluation));
            parts.sum::<f64>()
        };
        integral(0.0, before) + integral(after, count)
    }
}

/// `int |a| dt` (m/s) over those seconds from the first sample in which the peak
/// reaches a threshold; a last part of a second counts like a second. Steps that a
/// second ends in are divided there.
pub(crate) fn standardised(samples: &[f64], h: f64, threshold: f64, evaluation: Evaluation) -> f64 {
    let (mut total, mut second, mut peak) = (0.0, 0.0, samples[0].abs());
    let mut left = 1.0;
    for pair in samples.windows(2) {
        let (mut from, mut rest) = (pair[0], h);
        if rest > MANY {
            // What began before ends first.
            let length = left;
            let to = from + (pair[1] - from) * length / rest;
            second += absolute(from, to, length, evaluation);
            if peak.max(to.abs()) >= threshold {
                total += second;
            }
            (from, rest) = (to, rest - length);
            let whole = rest.floor() - 1.0;
            let line = Line {
                from,
                slope: (pair[1] - from) / rest,
            };
            total += line.seconds(whole, threshold, evaluation);
            from = line.at(whole);
            rest -= whole;
            (second, peak, left) = (0.0, from.abs(), 1.0);
        }
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Steps of many seconds, against the same straight lines sampled once a second.
    #[test]
    fn long_steps_are_straight_lines_of_seconds() {
        let value = |i: u64| {
            crate::distributions::normal_quantile(((i * 7919 + 13) % 1000) as f64 / 1000.0 + 5e-4)
        };
        let samples: Vec<f64> = (0..30).map(value).collect();
        for step in [9_usize, 40, 1001] {
            let mut fine = vec![samples[0]];
            for pair in samples.windows(2) {
                let inside =
                    (1..=step).map(|k| pair[0] + (pair[1] - pair[0]) * k as f64 / step as f64);
                fine.extend(inside);
            }
            for (threshold, evaluation) in [
                (0.0, Evaluation::PiecewiseLinear),
                (0.0, Evaluation::AtSamples),
                (0.01, Evaluation::PiecewiseLinear),
                (0.3, Evaluation::AtSamples),
                (0.3, Evaluation::PiecewiseLinear),
                (1.0, Evaluation::PiecewiseLinear),
                (3.0, Evaluation::PiecewiseLinear),
            ] {
                let found = standardised(&samples, step as f64, threshold, evaluation);
                let expected = standardised(&fine, 1.0, threshold, evaluation);
                assert!(
                    (found - expected).abs() <= 1e-9 * expected,
                    "{step} {threshold}: {found} {expected}"
                );
            }
        }
        // It ends.
        let long = standardised(&samples, 1.0e6, 0.25, Evaluation::PiecewiseLinear);
        assert!(long > 1e6, "{long}");
    }
}
