//! The least and the greatest ratio of a mean spectrum to a target within a band of periods, also
//! between the periods of any grid.

use pounding_ground_motion::processing::BAND_PERIODS;
use pounding_ground_motion::spectra::logarithmic_periods;

use super::error::CheckError;
use super::record_spectra::{mean, of_records, wrong};
use super::records::CaseUnderRecord;

/// Steps of the grid in the bandwidth of an oscillator, which is twice its damping ratio: as far
/// apart, relative to the period, are those that one motion excites apart.
const STEPS_IN_BANDWIDTH: f64 = 20.0;
/// Least damping ratio that the grid goes by (-): below it its steps stay 0.05 % of the period.
const LEAST_DAMPING: f64 = 0.005;
/// Extremes of the grid between whose neighbours is searched: those so near to the extreme one
/// (-), and no more than so many. A quarter of the bandwidth away a ratio differs by less.
const NEAR: f64 = 0.03;
const BRACKETS: usize = 12;
/// Periods inside a bracket, and how often the bracket shrinks to both neighbours of the extreme
/// one among them: after six times to a three-thousandth of a step.
const INSIDE: usize = 7;
const ROUNDS: usize = 6;

/// A ratio with its period (s).
pub(super) type At = (f64, f64);

/// A band of periods in which a mean spectrum is held against a target.
pub(super) struct Band {
    /// First and last period (s).
    pub ends: (f64, f64),
    /// Damping ratio of the spectra (-).
    pub damping: f64,
}

impl Band {
    /// The least and the greatest ratio of the mean spectrum of the records to a target, whose
    /// value (m/s2) is `None` beyond its range.
    pub(super) fn extremes(
        &self,
        records: &[CaseUnderRecord],
        target: impl Fn(f64) -> Option<f64>,
        threads: usize,
    ) -> Result<(At, At), CheckError> {
        let Some(first) = records.first() else {
            return Err(CheckError::NoGap);
        };
        let (from, to) = self.ends;
        let grid = match from < to {
            true => logarithmic_periods(from, to, self.grid()).map_err(wrong(first))?,
            // Of a band beyond the spectrum its end is left.
            false => vec![from],
        };
        extremes(&grid, |periods| {
            let spectra = of_records(records, periods, self.damping, threads)?;
            let mean = mean(&spectra, periods.len());
            let ratio = |(t, mean): (&f64, f64)| target(*t).map_or(f64::NAN, |of| mean / of);
            Ok(periods.iter().zip(mean).map(ratio).collect())
        })
    }

    /// How many periods its grid has.
    fn grid(&self) -> usize {
        let (from, to) = self.ends;
        let step = 2.0 * self.damping.max(LEAST_DAMPING) / STEPS_IN_BANDWIDTH;
        let steps = (libm::log(to / from) / step).ceil() as usize;
        (steps + 1).max(BAND_PERIODS)
    }
}

/// The extremes of a function of the period: those on the grid, and between its neighbours those of
/// brackets that shrink around each that is near to them. Values that are no number are none.
fn extremes(
    grid: &[f64],
    values: impl Fn(&[f64]) -> Result<Vec<f64>, CheckError>,
) -> Result<(At, At), CheckError> {
    let on_grid = values(grid)?;
    let most = |sign: f64| -> Result<At, CheckError> {
        let sought: Vec<f64> = on_grid.iter().map(|v| sign * v).collect();
        let found = least(grid, &sought, |periods| {
            let found = values(periods)?;
            Ok(found.into_iter().map(|v| sign * v).collect())
        })?;
        Ok((sign * found.0, found.1))
    };
    Ok((most(1.0)?, most(-1.0)?))
}

/// The least value, with its period.
fn least(
    grid: &[f64],
    on_grid: &[f64],
    values: impl Fn(&[f64]) -> Result<Vec<f64>, CheckError>,
) -> Result<At, CheckError> {
    let known = |(value, period): (&f64, &f64)| (!value.is_nan()).then_some((*value, *period));
    let lower = |a: At, b: At| if b.0 < a.0 { b } else { a };
    let pairs = on_grid.iter().zip(grid).filter_map(known);
    let Some(mut found) = pairs.reduce(lower) else {
        return Ok((f64::NAN, f64::NAN));
    };
    let last = grid.len() - 1;
    let is_least = |i: &usize| {
        let beside = [i.saturating_sub(1), (i + 1).min(last)];
        let near = on_grid[*i] <= found.0 + NEAR * found.0.abs();
        near && beside.iter().all(|j| !(on_grid[*j] < on_grid[*i]))
    };
    let mut places: Vec<usize> = (0..=last).filter(is_least).collect();
    places.sort_by(|a, b| on_grid[*a].total_cmp(&on_grid[*b]));
    let bracket = |i: &usize| (grid[i.saturating_sub(1)], grid[(i + 1).min(last)]);
    let mut brackets: Vec<(f64, f64)> = places.iter().take(BRACKETS).map(bracket).collect();
    brackets.retain(|(from, to)| from < to);
    let mut near = NEAR;
    for _ in 0..ROUNDS {
        // All brackets together: oscillators are cheaper side by side.
        let inside = |(from, to): &(f64, f64)| -> Vec<f64> {
            let step = (to - from) / (INSIDE + 1) as f64;
            let (from, to) = (*from, *to);
            (0..INSIDE + 2)
                .map(|i| (from + step * i as f64).min(to))
                .collect()
        };
        let periods: Vec<f64> = brackets.iter().flat_map(inside).collect();
        let of_all = values(&periods)?;
        let pieces = periods.chunks(INSIDE + 2).zip(of_all.chunks(INSIDE + 2));
        let mut shrunk = Vec::with_capacity(brackets.len());
        for (periods, values) in pieces {
            let pairs = values.iter().zip(periods).filter_map(known);
            found = pairs.fold(found, lower);
            let at = (0..values.len()).min_by(|a, b| values[*a].total_cmp(&values[*b]));
            let at = at.unwrap_or_default();
            let ends = (
                periods[at.saturating_sub(1)],
                periods[(at + 1).min(periods.len() - 1)],
            );
            shrunk.push((values[at], ends));
        }
        // What differs by less inside a bracket that is as much narrower cannot be the least.
        near *= 2.0 / (INSIDE + 1) as f64;
        let can_be_least = |(value, _): &(f64, _)| *value <= found.0 + near * found.0.abs();
        brackets = shrunk
            .into_iter()
            .filter(can_be_least)
            .map(|(_, ends)| ends)
            .collect();
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    /// Grid of a band with a damping ratio of 5 %: steps of 0.5 % of the period, and of less where
    /// damping is less.
    #[test]
    fn steps_go_by_damping() {
        for (damping, step) in [(0.05, 0.005), (0.02, 0.002), (0.0, 0.0005)] {
            let ends = (0.06, 2.4);
            let steps = Band { ends, damping }.grid() - 1;
            let ratio = libm::log(2.4_f64 / 0.06) / steps as f64;
            assert!(ratio <= step && ratio > 0.98 * step, "{damping}: {ratio}");
        }
    }

    /// A notch with the slopes that oscillators of 5 % damping have at most, `1 / (2 damping)` of
    /// the ratio over the logarithm of the period, a second one that is a little less deep, and a
    /// peak: in closed form 0.88 at 0.6431 s and 1.2 at 1.7 s. A hundred periods see neither.
    #[test]
    fn a_notch_between_periods_is_found() {
        let away = |t: f64, at: f64| libm::log(t / at).abs();
        let ratio = |t: f64| {
            let deep = 0.88 + 10.0 * away(t, 0.6431);
            let less = 0.885 + 10.0 * away(t, 0.12345);
            let peak = 1.2 - 10.0 * away(t, 1.7);
            deep.min(less).min(1.0).max(peak)
        };
        let coarse = logarithmic_periods(0.06, 2.4, BAND_PERIODS).unwrap();
        let seen = coarse.iter().map(|t| ratio(*t));
        assert!(seen.fold(f64::INFINITY, f64::min) > 0.9);
        let band = Band {
            ends: (0.06, 2.4),
            damping: 0.05,
        };
        let grid = logarithmic_periods(0.06, 2.4, band.grid()).unwrap();
        let all = |periods: &[f64]| Ok(periods.iter().map(|t| ratio(*t)).collect());
        let (least, most) = extremes(&grid, all).unwrap();
        assert!((least.0 / 0.88 - 1.0).abs() < 1e-5, "{least:?}");
        assert!((least.1 / 0.6431 - 1.0).abs() < 1e-5, "{least:?}");
        assert!((most.0 / 1.2 - 1.0).abs() < 1e-5, "{most:?}");
        assert!((most.1 / 1.7 - 1.0).abs() < 1e-5, "{most:?}");
        // Ends of the band are periods like others, and what is beyond a target is no ratio.
        let rising = |periods: &[f64]| Ok(periods.to_vec());
        assert_eq!(extremes(&grid, rising).unwrap().0, (0.06, 0.06));
        let nowhere = |periods: &[f64]| Ok(vec![f64::NAN; periods.len()]);
        assert!(extremes(&grid, nowhere).unwrap().0.0.is_nan());
        let one = extremes(&[0.3], rising).unwrap();
        assert_eq!(one, ((0.3, 0.3), (0.3, 0.3)));
    }
}
