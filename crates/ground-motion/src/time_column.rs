//! Times printed beside the values.

use crate::error::GroundMotionError;
use crate::number;
use crate::source::Source;
use crate::text::Line;

/// Times of samples as found.
pub(crate) enum Times {
    /// The step that the file states (s), if it does.
    Step(Option<f64>),
    /// A time for each sample (s), uneven.
    Each(Vec<f64>),
}

/// A column of times as it is read.
pub(crate) struct TimeColumn {
    times: Vec<f64>,
    /// The digits with which they are printed.
    printed: PrintedDigits,
    /// One unit of the printed times (s).
    unit: f64,
    /// The first time that is not after the one before it, from zero, and its line.
    not_after: Option<(usize, usize)>,
}

impl TimeColumn {
    pub(crate) fn with_capacity(capacity: usize) -> Self {
        Self {
            times: Vec::with_capacity(capacity),
            printed: PrintedDigits::default(),
            unit: 1.0,
            not_after: None,
        }
    }

    /// The same for times that are printed in another unit than seconds.
    pub(crate) fn in_unit(self, unit: f64) -> Self {
        Self { unit, ..self }
    }

    /// Adds a time of a line.
    pub(crate) fn push(&mut self, line: Line<'_>, time: f64, printed: &[u8]) {
        let time = time * self.unit;
        if self.times.last().is_some_and(|before| !(time > *before)) {
            self.not_after
                .get_or_insert((self.times.len(), line.number));
        }
        self.times.push(time);
        self.printed.see(printed);
    }

    /// The first time (s).
    pub(crate) fn first(&self) -> Option<f64> {
        self.times.first().copied()
    }

    /// Whether one step is between all of them, within their printed digits.
    pub(crate) fn is_even(&self) -> bool {
        even_step(&self.times, self.printed, self.unit).is_some()
    }

    /// The even step, or the times themselves where they are not even within
    /// their printed digits. `line` is that of the first one.
    ///
    /// # Errors
    /// A zero that is to be put before a first value at time zero, or uneven times that do not
    /// increase.
    pub(crate) fn finish(
        self,
        source: &Source<'_>,
        line: usize,
        warnings: &mut Vec<String>,
    ) -> Result<Times, GroundMotionError> {
        let first = self.first().unwrap_or(0.0);
        let prepended = source.options.prepend_zero;
        let mean = (self.times.last().map_or(0.0, |last| last - first)) / self.times.len() as f64;
        if prepended && first.abs() <= 1.0e-3 * mean {
            return Err(starts_at_zero(source, line));
        }
        let Some(step) = even_step(&self.times, self.printed, self.unit) else {
            return match self.not_after {
                Some((i, line)) => Err(not_after(source, line, &self.times, i)),
                None => Ok(Times::Each(self.times)),
            };
        };
        // Half a digit, which the sum of a rounded number may exceed by its own round-off.
        let half = (0.501 * self.unit * self.printed.unit_of(first / self.unit)).min(0.25 * step);
        let at_one_step = (first - step).abs() <= half.max(0.1 * step);
        if first.abs() > 1.0e-3 * step && !(prepended && at_one_step) {
            let taken = match (prepended, at_one_step) {
                (true, _) => format!("{step} s, after a zero"),
                (false, true) => "0; `prepend_zero` keeps its time".to_owned(),
                (false, false) => "0".to_owned(),
            };
            warnings.push(format!(
                "the first value is at {first} s in the file and is taken at {taken}"
            ));
        }
        Ok(Times::Step(Some(step)))
    }
}

/// The error of a time, from zero, that is not after the one before it.
pub(crate) fn not_after(
    source: &Source<'_>,
    line: usize,
    times: &[f64],
    i: usize,
) -> GroundMotionError {
    source.error(
        line,
        0,
        format!(
            "time {} s of value {} is not after {} s",
            times[i],
            i + 1,
            times[i - 1]
        ),
        "times must increase: get the record again",
    )
}

/// The error of a zero that would shift a record whose times start at zero.
pub(crate) fn starts_at_zero(source: &Source<'_>, line: usize) -> GroundMotionError {
    source.error(
        line,
        0,
        "the first value is at 0 s in the file: a zero before it would shift the motion by a step",
        "leave `prepend_zero` out (`--prepend-zero` with `pounding motion`): it is for files whose first value is at one time step",
    )
}

/// The digits of a column: the most decimals and the most significant digits of any of its
/// numbers. Shorter ones have lost zeros at their end: `0.0` among numbers of seven decimals is
/// no coarser than they are.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct PrintedDigits {
    /// Digits behind the point, less the exponent.
    decimals: i32,
    significant: i32,
}

impl PrintedDigits {
    /// Those of times that all have as many decimals.
    pub(crate) fn of_decimals(decimals: usize, times: &[f64]) -> Self {
        let largest = times.iter().fold(1.0_f64, |m, time| m.max(time.abs()));
        let decimals = decimals as i32;
        Self {
            decimals,
            significant: decimals + 1 + libm::log10(largest).floor() as i32,
        }
    }

    pub(crate) fn see(&mut self, printed: &[u8]) {
        let plain = printed.trim_ascii();
        let unsigned = plain.strip_prefix(b"-").or(plain.strip_prefix(b"+"));
        let mantissa = unsigned.unwrap_or(plain).iter();
        let significant = mantissa
            .take_while(|b| b.is_ascii_digit() || **b == b'.')
            .skip_while(|b| matches!(b, b'0' | b'.'))
            .filter(|b| **b != b'.')
            .count();
        self.significant = self.significant.max(significant as i32);
        self.decimals = self.decimals.max(number::decimals(plain));
    }

    /// One unit of the last digit of a number of this column. Those of many digits before the
    /// point have fewer behind it where the significant digits are limited, as by `%g`.
    fn unit_of(self, value: f64) -> f64 {
        let power = |exponent: i32| 10.0_f64.powi(exponent.clamp(-300, 300));
        let mut unit = power(-self.decimals);
        let mut limit = power(self.significant - self.decimals);
        while value.abs() >= limit && limit < 1.0e300 {
            limit *= 10.0;
            unit *= 10.0;
        }
        unit
    }
}

/// Round-off of times in single precision, as a part of the time.
const SINGLE: f64 = 2.0e-7;

/// Round-off of times that were added up, as a part of their sum.
const SUM: f64 = 1.0e-10;

/// Part of a step that the digits of a time may leave open: a third would let a row be missing behind the first.
const OPEN: f64 = 0.25;
/// The same of many times, for which nothing else is found: a line that is open by less than half a step passes by none
/// before a missing row and none behind it. One that is missing behind the first `k` rows asks for
/// `n <= k (1 + 0.45) / (1 - 0.45)` rows in all, and for `(1 - 0.45) (k - 1) <= 0.45 k`, which only five rows and fewer meet.
const OPEN_OF_MANY: f64 = 0.45;
const MANY_TIMES: usize = 20;
/// Largest part of a step that the digits of all of them leave open: rates up to a thousand samples a second are told
/// from the next whole one.
const PINNED_OF_MANY: f64 = 0.001;
/// Part of a step that round-off may be then.
const ROUND_OFF: f64 = 0.05;

/// Decimals of a step (s) that is rounder than a whole number of samples a second.
const ROUND_DECIMALS: i32 = 5;

/// The even step (s) of times of `unit` seconds, printed with these digits; `None` if they are
/// not even.
///
/// Each time leaves open a range of steps, as wide as its rounding is over the number of steps
/// before it: the step is the roundest number of the range that all of them have in common.
pub(crate) fn even_step(times: &[f64], printed: PrintedDigits, unit: f64) -> Option<f64> {
    even_step_of(times, printed, unit, true)
}

/// The same of times (s) whose last digit was rounded, never cut off.
pub(crate) fn even_step_of_rounded(times: &[f64], printed: PrintedDigits) -> Option<f64> {
    even_step_of(times, printed, 1.0, false)
}

fn even_step_of(times: &[f64], printed: PrintedDigits, unit: f64, may_be_cut: bool) -> Option<f64> {
    let [first, .., last] = *times else {
        return None;
    };
    let mean = (last - first) / (times.len() - 1) as f64;
    if !(mean > 0.0 && mean.is_finite()) {
        return None;
    }
    let digit = |time: f64| unit * printed.unit_of(time / unit);
    // Nine digits tell every number of single precision from its neighbours; with more it may
    // be printed as the number that it is.
    let single = |time: f64| f64::from((time / unit) as f32) * unit;
    let is_single = printed.significant <= 9
        || times
            .iter()
            .all(|time| (time - single(*time)).abs() <= 4.0 * f64::EPSILON * time.abs());
    let round_off = |time: f64| {
        let largest = time.abs().max(first.abs());
        let part = if is_single {
            SINGLE * largest
        } else {
            SUM * (time - first)
        };
        part + 8.0 * f64::EPSILON * largest
    };
    // Half a digit for each of two times, of which a zero is exact; or one digit where digits
    // are cut off: SCT 1985 prints 163.41999 for 163.42.
    let start = if first == 0.0 {
        0.0
    } else {
        0.5 * digit(first)
    };
    let rounded = |time: f64| 0.5 * digit(time) + start;
    let cut = |time: f64| 1.01 * digit(time).max(digit(first));
    let common = |half_width: &dyn Fn(f64) -> f64, most_open: f64| {
        let (mut low, mut high) = (0.0_f64, f64::INFINITY);
        for (i, time) in times.iter().enumerate().skip(1) {
            // A missing row must not pass for coarse digits: with fewer than two digits a step
            // times are even as they are printed, or not at all.
            let most = match digit(*time) > 0.51 * mean {
                true => 0.01,
                false => most_open,
            };
            let open = (half_width(*time) + round_off(*time)).min(most * mean);
            low = low.max((time - first - open) / i as f64);
            high = high.min((time - first + open) / i as f64);
        }
        (low <= high).then_some((low, high))
    };
    // Times that start at one step, as multiples of it: the first one may be rounded coarsely.
    let from_zero = || {
        let (mut low, mut high) = (0.0_f64, f64::INFINITY);
        for (i, time) in times.iter().enumerate() {
            if digit(*time) > 0.51 * mean {
                return None;
            }
            let open = 0.5 * digit(*time) + round_off(*time);
            low = low.max((time - open) / (i + 1) as f64);
            high = high.min((time + open) / (i + 1) as f64);
        }
        (low <= high).then_some((low, high))
    };
    let found = common(&rounded, OPEN).or_else(|| may_be_cut.then(|| common(&cut, OPEN))?);
    let found = found.or_else(|| from_zero().filter(|_| first > 0.0));
    let found = found.or_else(|| in_single(times, digit).filter(|_| is_single));
    let decimals = printed.decimals - libm::log10(unit).round() as i32;
    let Some((low, high)) = found else {
        let is_one = may_be_cut && digit(first) == digit(last);
        let coarse = coarse_step(times, digit(last), decimals).filter(|_| is_one);
        // What single precision leaves open is not to be that much.
        let wider = || {
            let is_exact = round_off(last) <= ROUND_OFF * mean && times.len() > MANY_TIMES;
            let (low, high) = is_exact.then(|| common(&rounded, OPEN_OF_MANY))??;
            let mut round = round_steps(mean, decimals);
            let found = round.find(|step| (low..=high).contains(step));
            (high - low <= PINNED_OF_MANY * mean).then(|| found.unwrap_or(mean.clamp(low, high)))
        };
        return coarse.or_else(wider);
    };
    let mean = mean.clamp(low, high);
    let in_common = |step: &f64| *step > 0.0 && (low..=high).contains(step);
    let round = round_steps(mean, decimals).find(in_common);
    // With more decimals a number is as near by chance: only digits that were rounded excuse it.
    let digits = (digit(first) + digit(last)) / (times.len() - 1) as f64;
    let longer = (ROUND_DECIMALS + 1..=decimals.min(12)).map(|n| with_decimals(mean, n));
    let mut longer = longer.filter(|step| (step - mean).abs() <= digits);
    Some(round.or_else(|| longer.find(in_common)).unwrap_or(mean))
}

/// Digits a step below which a row that is missing is no more than their rounding, and from which on other rules hold.
const COARSE: std::ops::Range<f64> = 0.55..2.0;
/// Parts of a digit by which a step of coarse digits must be off a whole number of them: times that all are whole
/// numbers of steps but for a row that is missing have about none.
const BETWEEN_DIGITS: std::ops::RangeInclusive<f64> = 0.1..=0.9;
/// Largest part of a step that the digits of times leave open, for one round step to be told from others.
const PINNED: f64 = 0.004;

/// Rows at either end that may lie no further off the line than those between them, and part of a digit by which they
/// may: those between them have been as far off as rounding puts them.
const ENDS: usize = 8;
const BEYOND: f64 = 0.05;

/// The round step (s) of times of which each has the same digit (s), of about one step: all are within one digit of a
/// straight line, rounded or cut off. A row that is missing or doubled puts those behind it a step off the line, more
/// than is open: the steps of its times, in digits, fill most of a digit. One near an end puts the few rows up to there
/// off it: with steps below one digit none may be further off than all others, which cannot be told from rounding.
fn coarse_step(times: &[f64], digit: f64, decimals: i32) -> Option<f64> {
    let [first, .., last] = *times else {
        return None;
    };
    let intervals = (times.len() - 1) as f64;
    let mean = (last - first) / intervals;
    let digits = mean / digit;
    let is_between = BETWEEN_DIGITS.contains(&digits.fract());
    if !(COARSE.contains(&digits) && is_between && 2.0 * digit <= PINNED * (last - first)) {
        return None;
    }
    let open = 1.01 * digit + SINGLE * last.abs().max(first.abs());
    let fits = |step: &f64| {
        let off = |i: usize| times[i] - first - i as f64 * step;
        let range = |rows: std::ops::Range<usize>| {
            let widest = |(low, high): (f64, f64), off: f64| (low.min(off), high.max(off));
            let (low, high) = rows
                .map(off)
                .fold((f64::INFINITY, f64::NEG_INFINITY), widest);
            high - low
        };
        let all = range(0..times.len());
        all <= open && all - range(ENDS..times.len() - ENDS) <= BEYOND * digit
    };
    // Two decimals more than those printed are rounder than a whole number of samples a second, `0.015`. Steps with more
    // are as near by chance: those of even times of which one in so many is missing.
    let few = (0..=decimals + 2).map(|n| with_decimals(mean, n));
    let whole_rate = 1.0 / (1.0 / mean).round();
    few.chain([whole_rate]).find(fits)
}

/// Steps (s) that times may have which were added up in single precision, or are multiples of a step
/// in it: each is after the one before it by the same step, but for the spacing of numbers of
/// single precision at the last time and one digit as it is printed there. Of the whole time between first and last
/// the digits leave no more open than of one step.
fn in_single(times: &[f64], digit: impl Fn(f64) -> f64) -> Option<(f64, f64)> {
    let [first, .., last] = *times else {
        return None;
    };
    let intervals = (times.len() - 1) as f64;
    let mean = (last - first) / intervals;
    let spacing = f64::from(f32::EPSILON) * last.abs().max(first.abs());
    let coarsest = digit(first).max(digit(last));
    let even = |w: &[f64]| {
        let open = spacing + digit(w[0]).max(digit(w[1]));
        (w[1] - w[0] - mean).abs() <= open
    };
    let open = spacing + 2.0 * coarsest / intervals;
    (spacing + coarsest <= MOST_OPEN * mean && times.windows(2).all(even))
        .then_some((mean - open, mean + open))
}

/// The even step (s) of times in single precision.
pub(crate) fn even_step_in_single(times: &[f64]) -> Option<f64> {
    let (low, high) = in_single(times, |_| 0.0)?;
    let mean = 0.5 * (low + high);
    let round = round_steps(mean, ROUND_DECIMALS).find(|step| (low..=high).contains(step));
    Some(round.unwrap_or(mean))
}

/// Part of a step by which single precision may change it.
const MOST_OPEN: f64 = 0.02;

fn with_decimals(step: f64, decimals: i32) -> f64 {
    let scale = 10.0_f64.powi(decimals);
    (step * scale).round() / scale
}

/// Round steps near one, the roundest first: with few decimals, of which none is behind the last
/// one printed; a whole number of samples a second; with few decimals all the same.
fn round_steps(step: f64, printed: i32) -> impl Iterator<Item = f64> {
    let few = (0..=printed.min(ROUND_DECIMALS)).map(move |n| with_decimals(step, n));
    let whole_rate = 1.0 / (1.0 / step).round();
    few.chain([whole_rate, with_decimals(step, ROUND_DECIMALS)])
}

/// Numbers in one place of which a piece of a series is made, to see whether they increase.
const PIECE: usize = 10;

/// Whether nearly all of every second (third, ...) number go forward as times do, even if some do
/// not. Piece by piece, as what is missing may change the places of those behind it; a slow motion
/// rises too, but in all places at once, and falls as often.
pub(crate) fn mostly_times(numbers: &[f64], every: usize) -> bool {
    let (mut pieces, mut rising, mut all) = (0_usize, 0, 0);
    for piece in numbers.chunks_exact(PIECE * every) {
        let rises = |place: &usize| {
            let places = piece[*place..].iter().step_by(every);
            let mut steps = places.clone().zip(places.skip(1));
            let last = piece[piece.len() - every + place];
            steps.all(|(a, b)| b >= a) && last > piece[*place]
        };
        let found = (0..every).filter(rises).count();
        pieces += 1;
        rising += usize::from(found > 0);
        all += usize::from(found == every);
    }
    pieces > 1 && rising + pieces.div_ceil(10) >= pieces && 4 * all <= 3 * pieces
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

    fn digits(column: &str) -> PrintedDigits {
        let mut printed = PrintedDigits::default();
        column
            .split_whitespace()
            .for_each(|field| printed.see(field.as_bytes()));
        printed
    }

    #[test]
    fn digits_of_a_column_are_those_of_its_longest_numbers() {
        for (column, decimals, significant) in [
            ("0.0 0.0078125 0.015625 23.4296875", 7, 9),
            ("0.000 0.005 1.005", 3, 4),
            ("0 0.0025 10.0025 100.002", 4, 6),
            ("0.00E+00 5.00E-03 1.00E+01", 5, 3),
            ("+5.000-003 -1.25D+1", 6, 4),
            ("0 20 40", 0, 2),
        ] {
            let expected = PrintedDigits {
                decimals,
                significant,
            };
            assert_eq!(digits(column), expected, "{column}");
        }
        // `%g`: six digits are three decimals above 100 s.
        let printed = digits("0 0.0025 10.0025 100.002");
        for (value, unit) in [(0.0, 1e-4), (10.0025, 1e-4), (100.002, 1e-3)] {
            assert!((printed.unit_of(value) / unit - 1.0).abs() < 1e-12);
        }
    }

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
