//! Matching by Fourier amplitudes: each is multiplied by the ratio of target to
//! response at its period, phases kept (Gasparini and Vanmarcke 1976, MIT R76-4, the
//! iteration of SIMQKE). Simple; the distribution of energy over time changes, and
//! single periods stay some 8 % off: wavelets come nearer.

use std::f64::consts::PI;

use crate::accelerogram::Accelerogram;
use crate::error::GroundMotionError;
use crate::matching::{Adjustment, MatchOptions, Matched, drift, iterate, spectrum};
use crate::spectra::{TargetSpectrum, inverse_transform, transform};

/// Exponent of the ratio: below one, iterations swing less.
const RELAXATION: f64 = 0.7;
/// Part of a ratio that is followed at once.
const GREATEST_RATIO: f64 = 3.0;
/// Octaves beyond the band over which the ratio fades to one.
const FADE: f64 = 1.0;

struct FourierAmplitudes;

/// Brings a record to a target by its Fourier amplitudes. Velocity and displacement at
/// the end are zero after it.
///
/// # Errors
/// A band that the target or the record does not cover, or
/// [`GroundMotionError::NotMatched`].
pub fn match_by_fourier_amplitudes(
    record: &Accelerogram,
    target: &TargetSpectrum,
    options: MatchOptions,
) -> Result<Matched, GroundMotionError> {
    iterate(record, target, options, &mut FourierAmplitudes)
}

impl Adjustment for FourierAmplitudes {
    const NAME: &'static str = "matching by Fourier amplitudes";

    fn improve(
        &mut self,
        record: &Accelerogram,
        target: &TargetSpectrum,
        periods: &[f64],
    ) -> Result<Accelerogram, GroundMotionError> {
        let (h, count) = (record.time_step(), record.samples().len());
        let now = spectrum(record, target, periods)?;
        let ratios: Vec<f64> = periods
            .iter()
            .zip(&now.pseudo_acceleration)
            .map(|(t, a)| (target.nearest(*t) / a).ln() * RELAXATION)
            .collect();
        let length = (2 * count).next_power_of_two();
        let mut coefficients = transform(record.samples(), length);
        for (k, c) in coefficients.iter_mut().enumerate().skip(1) {
            let period = length as f64 * h / k as f64;
            let limit = GREATEST_RATIO.ln();
            *c *= at(periods, &ratios, period).clamp(-limit, limit).exp();
        }
        let mut samples = inverse_transform(coefficients, length);
        samples.truncate(count);
        let shapes = end_shapes(count);
        drift::bring_to(&mut samples, [&shapes[0], &shapes[1]], [0.0; 2], h);
        record.with_samples(samples, h)
    }
}

/// Logarithm of the factor at a period: straight in the logarithm of the period, fading
/// beyond the band.
fn at(periods: &[f64], ratios: &[f64], period: f64) -> f64 {
    let last = periods.len() - 1;
    let beyond = |end: f64| {
        let octaves = (period / end).log2().abs();
        0.5 * (1.0 + (PI * (octaves / FADE).min(1.0)).cos())
    };
    if period <= periods[0] {
        return ratios[0] * beyond(periods[0]);
    }
    if period >= periods[last] {
        return ratios[last] * beyond(periods[last]);
    }
    let i = periods.partition_point(|p| *p <= period).min(last);
    let part = (period / periods[i - 1]).ln() / (periods[i] / periods[i - 1]).ln();
    ratios[i - 1] + part * (ratios[i] - ratios[i - 1])
}

/// Half a sine and a whole one over the record: zero at both ends.
fn end_shapes(count: usize) -> [Vec<f64>; 2] {
    [1.0, 2.0].map(|waves| {
        (0..count)
            .map(|i| (PI * waves * i as f64 / (count - 1) as f64).sin())
            .collect()
    })
}
