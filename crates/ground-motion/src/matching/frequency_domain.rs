//! Matching by Fourier amplitudes, phases kept. First each is multiplied by the ratio
//! of target to response at its period (Gasparini and Vanmarcke 1976, MIT R76-4, the
//! iteration of SIMQKE), which leaves single periods some 8 % off: a peak between two
//! cycles that are alike answers to all its neighbours. Where that comes to its end, the
//! amplitudes of narrow bands around the periods are changed together, by factors of
//! [`LeastSquares`]. The distribution of energy over time changes with the amplitudes.

use std::f64::consts::PI;

use crate::accelerogram::Accelerogram;
use crate::error::GroundMotionError;
use crate::matching::least_squares::{LeastSquares, Rows};
use crate::matching::misfit::{Deviations, misfit};
use crate::matching::peaks::Change;
use crate::matching::{Adjustment, MatchOptions, Matched, drift, iterate, spectrum};
use crate::spectra::{TargetSpectrum, inverse_transform, transform};

/// Exponent of the ratio: below one, iterations swing less.
const RELAXATION: f64 = 0.7;
/// Part of a ratio that is followed at once.
const GREATEST_RATIO: f64 = 3.0;
/// Octaves beyond the band over which the ratio fades to one.
const FADE: f64 = 1.0;

struct FourierAmplitudes {
    /// Whether ratios still bring the motion nearer.
    by_ratios: bool,
    least_squares: LeastSquares,
}

/// Brings a record to a target by its Fourier amplitudes. Velocity and displacement at
/// the end are zero after it: what the record has of them is taken off first.
///
/// # Errors
/// A band that the target or the record does not cover, or
/// [`GroundMotionError::NotMatched`].
pub fn match_by_fourier_amplitudes(
    record: &Accelerogram,
    target: &TargetSpectrum,
    options: MatchOptions,
) -> Result<Matched, GroundMotionError> {
    let mut amplitudes = FourierAmplitudes {
        by_ratios: true,
        least_squares: LeastSquares::new(),
    };
    iterate(record, target, options, &mut amplitudes)
}

impl Adjustment for FourierAmplitudes {
    const NAME: &'static str = "matching by Fourier amplitudes";

    fn improve(
        &mut self,
        record: &Accelerogram,
        target: &TargetSpectrum,
        periods: &[f64],
        deviations: &Deviations,
    ) -> Result<Accelerogram, GroundMotionError> {
        let (from, to) = (periods[0], periods[periods.len() - 1]);
        if self.by_ratios {
            let next = multiplied(record, target, periods)?;
            if misfit(&next, target, from, to)?.worst < deviations.misfit.worst {
                return Ok(next);
            }
            self.by_ratios = false;
        }
        let rows = Rows::of(record, target, periods, deviations);
        let changes = bands(record, periods);
        self.least_squares.improve(record, target, &rows, &changes)
    }
}

/// Amplitudes times the ratios of target to response.
fn multiplied(
    record: &Accelerogram,
    target: &TargetSpectrum,
    periods: &[f64],
) -> Result<Accelerogram, GroundMotionError> {
    let now = spectrum(record, target, periods)?;
    let ratios: Vec<f64> = periods
        .iter()
        .zip(&now.pseudo_acceleration)
        .map(|(t, a)| libm::log(target.nearest(*t) / a) * RELAXATION)
        .collect();
    let limit = libm::log(GREATEST_RATIO);
    let samples = filtered(record, |period| {
        libm::exp(at(periods, &ratios, period).clamp(-limit, limit))
    });
    drift::ending_at_rest(record, samples)
}

/// What the record has in the band around each period: bands add up to what it has
/// between the first and the last.
fn bands(record: &Accelerogram, periods: &[f64]) -> Vec<Change> {
    let shapes = drift::end_shapes(record.samples().len());
    (0..periods.len())
        .filter_map(|k| {
            let mut weights = vec![0.0; periods.len()];
            weights[k] = 1.0;
            let mut samples = filtered(record, |period| at(periods, &weights, period));
            let shapes = [&shapes[0][..], &shapes[1][..]];
            drift::bring_to(&mut samples, shapes, [0.0; 2], record.time_step())
                .then_some(Change { first: 0, samples })
        })
        .collect()
}

/// The record with its coefficients times a function of the period; the constant term
/// goes.
fn filtered(record: &Accelerogram, factor: impl Fn(f64) -> f64) -> Vec<f64> {
    let (h, count) = (record.time_step(), record.samples().len());
    let length = (2 * count).next_power_of_two();
    let mut coefficients = transform(record.samples(), length);
    for (k, c) in coefficients.iter_mut().enumerate() {
        *c *= match k {
            0 => 0.0,
            k => factor(length as f64 * h / k as f64),
        };
    }
    let mut samples = inverse_transform(coefficients, length);
    samples.truncate(count);
    samples
}

/// A value at a period from those at the periods: straight in the logarithm of the
/// period, fading beyond the band.
fn at(periods: &[f64], ratios: &[f64], period: f64) -> f64 {
    let last = periods.len() - 1;
    let beyond = |end: f64| {
        let octaves = libm::log2(period / end).abs();
        0.5 * (1.0 + libm::cos(PI * (octaves / FADE).min(1.0)))
    };
    if period <= periods[0] {
        return ratios[0] * beyond(periods[0]);
    }
    if period >= periods[last] {
        return ratios[last] * beyond(periods[last]);
    }
    let i = periods.partition_point(|p| *p <= period).min(last);
    let part = libm::log(period / periods[i - 1]) / libm::log(periods[i] / periods[i - 1]);
    ratios[i - 1] + part * (ratios[i] - ratios[i - 1])
}
