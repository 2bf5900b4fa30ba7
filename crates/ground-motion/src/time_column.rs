//! Times printed beside the values.

use crate::draft::Times;
use crate::number;

/// A column of times as it is read.
pub(crate) struct TimeColumn {
    times: Vec<f64>,
    /// Coarsest unit of a last printed digit (s).
    digit: f64,
    /// One unit of the printed times (s).
    unit: f64,
}

impl TimeColumn {
    pub(crate) fn with_capacity(capacity: usize) -> Self {
        Self {
            times: Vec::with_capacity(capacity),
            digit: 0.0,
            unit: 1.0,
        }
    }

    /// The same for times that are printed in another unit than seconds.
    pub(crate) fn in_unit(self, unit: f64) -> Self {
        Self { unit, ..self }
    }

    pub(crate) fn push(&mut self, time: f64, printed: &[u8]) {
        self.times.push(time * self.unit);
        // A bare `0` or `1` among decimals says nothing of the others' digits.
        if printed.contains(&b'.') {
            self.digit = self.digit.max(self.unit * number::resolution(printed));
        }
    }

    /// The even step, or the times themselves where they are not even within
    /// their printed digits.
    pub(crate) fn finish(self, warnings: &mut Vec<String>) -> Times {
        let Some(step) = even_step(&self.times, self.digit) else {
            return Times::Each(self.times);
        };
        if self.times[0].abs() > 1.0e-3 * step {
            warnings.push(format!(
                "the first value is at {} s in the file and is taken at 0; `prepend_zero` keeps its time",
                self.times[0]
            ));
        }
        Times::Step(Some(step))
    }
}

/// The mean step, rounded to whole multiples of 10 us within the printed digits;
/// `None` if the times are not even.
pub(crate) fn even_step(times: &[f64], digit: f64) -> Option<f64> {
    let n = times.len();
    if n < 2 {
        return None;
    }
    let mean = (times[n - 1] - times[0]) / (n - 1) as f64;
    let nice = (mean * 1.0e5).round() / 1.0e5;
    let doubt = digit / (n - 1) as f64;
    let step = if nice > 0.0 && (nice - mean).abs() <= doubt + 1.0e-6 * mean {
        nice
    } else {
        mean
    };
    // One digit, not a half: SCT 1985 prints 163.41999 for 163.42. Single
    // precision costs a little more. A quarter of a step at most: a missing row
    // must not pass for coarse digits.
    let near = |(i, t): (usize, &f64)| {
        (t - times[0] - i as f64 * step).abs() <= (1.01 * digit + 2.0e-7 * t.abs()).min(0.25 * step)
    };
    (step > 0.0 && step.is_finite() && times.iter().enumerate().all(near)).then_some(step)
}

/// Values that may share one printed time: more are no rounding.
const MOST_TIED: usize = 4;

/// Parts times that are printed alike because their digits are too few, as those of film
/// read at uneven steps: each stays within half the digit (s) that `digit` tells of a time,
/// in the order of the file. Returns how many values had no time of their own.
pub(crate) fn part_ties(times: &mut [f64], digit: impl Fn(f64) -> f64) -> usize {
    let mut tied = 0;
    let mut at = 0;
    while at < times.len() {
        let time = times[at];
        let count = times[at..].iter().take_while(|t| **t == time).count();
        let next = times.get(at + count).copied();
        if (2..=MOST_TIED).contains(&count) {
            let half = 0.5 * digit(time);
            let below = match at.checked_sub(1) {
                Some(before) => half.min(0.5 * (time - times[before])),
                None => 0.0,
            };
            let above = next.map_or(half, |next| half.min(0.5 * (next - time)));
            if below >= 0.0 && above > 0.0 {
                for k in 0..count {
                    let part = (k as f64 + 0.5) / count as f64;
                    times[at + k] = time - below + part * (below + above);
                }
                tied += count - 1;
            }
        }
        at += count;
    }
    tied
}

/// What to say of `count` values without a time of their own.
pub(crate) fn tied_times(count: usize) -> String {
    format!(
        "{count} values are printed with the time of the value before: the times have too few digits, and were parted within the last one"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ties_stay_within_their_printed_digit() {
        let printed = [0.0, 0.0, 0.001, 0.002, 0.002, 0.002, 0.003, 0.005, 0.005];
        let mut times = printed;
        assert_eq!(part_ties(&mut times, |_| 1.0e-3), 4);
        assert!(times.windows(2).all(|w| w[1] > w[0]), "{times:?}");
        for (time, printed) in times.iter().zip(printed) {
            assert!((time - printed).abs() <= 0.5e-3, "{times:?}");
        }
        // Those with a time of their own keep it.
        assert_eq!((times[2], times[6]), (0.001, 0.003));
        // Time that goes back, or stands still for long, is no rounding.
        let mut back = [0.0, 0.002, 0.002, 0.001];
        assert_eq!(part_ties(&mut back, |_| 1.0e-3), 0);
        let mut still = [1.0; 5];
        assert_eq!(part_ties(&mut still, |_| 1.0e-3), 0);
    }
}
