//! How far a spectrum is from a target, between the periods of any grid as well.
//!
//! The ratio to the target has kinks where the peak of the oscillator moves to another
//! time and where the target has a corner, and may change by `1/(2 zeta)` for a unit of the
//! logarithm of the period: no grid that is worth its cost shows the worst of it. So the grid
//! only finds where extremes are, and golden sections, which need no smoothness, find the
//! extremes themselves.

use serde::Serialize;

use crate::accelerogram::Accelerogram;
use crate::error::GroundMotionError;
use crate::matching::spectrum;
use crate::spectra::{TargetSpectrum, logarithmic_periods};

/// Grid points within the logarithmic width of a resonance, which is the damping ratio or,
/// where that is less, the shortest period as a part of the duration.
const POINTS_PER_WIDTH: f64 = 10.0;
/// Grid points at most: undamped oscillators under long records.
const MOST_POINTS: f64 = 20_000.0;
/// Extremes from this part of the worst on are located: between two points of the grid no
/// extreme has been seen to rise to twice what it is there.
const LOCATED_FROM: f64 = 0.5;
/// Extremes from this part of the worst on are worked on at their own periods.
const NEAR_WORST: f64 = 0.7;
/// Periods nearer than this part of the damping ratio (logarithms) have one resonance.
const SAME_RESONANCE: f64 = 0.2;
/// Periods matched at most.
pub(crate) const MOST_PERIODS: usize = 500;
/// Golden sections of an interval of two grid spacings: each takes 0.618 of the last, so that
/// at 5 % damping the deviation is known to 5e-5.
const SECTIONS: usize = 16;

/// How far a spectrum is from a target.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Misfit {
    /// Maximum deviation as a part of the target.
    pub worst: f64,
    /// Period where it is (s).
    pub period: f64,
    /// Mean of the absolute deviations as parts of the target, over periods evenly spaced in
    /// their logarithm.
    pub mean: f64,
}

/// The misfit of a record over a band of periods (s). The maximum is that of all periods of
/// the band, not of a grid.
///
/// # Errors
/// A band beyond the target, or periods that the record cannot have.
pub fn misfit(
    record: &Accelerogram,
    target: &TargetSpectrum,
    from: f64,
    to: f64,
) -> Result<Misfit, GroundMotionError> {
    Ok(Deviations::of(record, target, from, to)?.misfit)
}

/// The misfit, and where the spectrum is furthest from the target.
pub(crate) struct Deviations {
    pub misfit: Misfit,
    /// Periods (s) of local maxima of the deviation, each with its deviation: those that are
    /// near the worst, in increasing order of the periods.
    pub extremes: Vec<(f64, f64)>,
}

impl Deviations {
    pub(crate) fn of(
        record: &Accelerogram,
        target: &TargetSpectrum,
        from: f64,
        to: f64,
    ) -> Result<Self, GroundMotionError> {
        target.covers(from, to)?;
        let periods = grid(record, target, from, to)?;
        let at = |periods: &[f64]| deviations(record, target, periods);
        let found = at(&periods)?;
        let worst = found.iter().copied().fold(0.0, f64::max);
        let last = periods.len() - 1;
        let mut extremes = Vec::new();
        for (i, here) in found.iter().enumerate() {
            let around = [i.saturating_sub(1), (i + 1).min(last)];
            if *here < LOCATED_FROM * worst || around.iter().any(|k| found[*k] > *here) {
                continue;
            }
            let mut best = (periods[i], *here);
            let ends = around.map(|k| libm::log(periods[k]));
            located(ends, |logarithm| {
                let period = libm::exp(logarithm).clamp(from, to);
                let deviation = at(&[period])?[0];
                if deviation > best.1 {
                    best = (period, deviation);
                }
                Ok(deviation)
            })?;
            extremes.push(best);
        }
        let furthest = extremes
            .iter()
            .copied()
            .fold((from, 0.0), |a, b| if b.1 > a.1 { b } else { a });
        Ok(Self {
            misfit: Misfit {
                worst: furthest.1,
                period: furthest.0,
                mean: found.iter().sum::<f64>() / found.len() as f64,
            },
            extremes,
        })
    }

    /// Adds the extremes near the worst to increasing periods that are matched, if none of
    /// these answers for them.
    pub(crate) fn add_to(&self, periods: &mut Vec<f64>, damping: f64) {
        for period in self.worst_places() {
            let after = periods.partition_point(|p| *p < period);
            let near = |p: &f64| libm::log(p / period).abs() < SAME_RESONANCE * damping;
            let beside = &periods[after.saturating_sub(1)..periods.len().min(after + 1)];
            if periods.len() < MOST_PERIODS && !beside.iter().any(near) {
                periods.insert(after, period);
            }
        }
    }

    /// Periods (s) of the extremes near the worst, in increasing order.
    pub(crate) fn worst_places(&self) -> impl Iterator<Item = f64> {
        let least = NEAR_WORST * self.misfit.worst;
        let near = self.extremes.iter().filter(move |e| e.1 >= least);
        near.map(|e| e.0)
    }
}

/// Periods at which extremes are looked for, evenly spaced in their logarithm.
fn grid(
    record: &Accelerogram,
    target: &TargetSpectrum,
    from: f64,
    to: f64,
) -> Result<Vec<f64>, GroundMotionError> {
    let width = target.damping().max(from / record.duration());
    let count = (POINTS_PER_WIDTH * libm::log(to / from) / width).clamp(2.0, MOST_POINTS);
    logarithmic_periods(from, to, count.ceil() as usize + 1)
}

fn deviations(
    record: &Accelerogram,
    target: &TargetSpectrum,
    periods: &[f64],
) -> Result<Vec<f64>, GroundMotionError> {
    let found = spectrum(record, target, periods)?;
    Ok(periods
        .iter()
        .zip(&found.pseudo_acceleration)
        .map(|(t, a)| (a / target.nearest(*t) - 1.0).abs())
        .collect())
}

/// Golden sections of an interval towards a maximum of a function, which keeps the best that
/// it was asked for itself.
fn located(
    [mut low, mut high]: [f64; 2],
    mut value: impl FnMut(f64) -> Result<f64, GroundMotionError>,
) -> Result<(), GroundMotionError> {
    let part = 0.5 * (5.0_f64.sqrt() - 1.0);
    let (mut left, mut right) = (high - part * (high - low), low + part * (high - low));
    let (mut at_left, mut at_right) = (value(left)?, value(right)?);
    for _ in 2..SECTIONS {
        if at_left > at_right {
            (high, right, at_right) = (right, left, at_left);
            left = high - part * (high - low);
            at_left = value(left)?;
        } else {
            (low, left, at_left) = (left, right, at_right);
            right = low + part * (high - low);
            at_right = value(right)?;
        }
    }
    Ok(())
}
