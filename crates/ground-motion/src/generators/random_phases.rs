//! Stationary random motions by their power spectrum, and envelopes over them.

use std::f64::consts::TAU;

use num_complex::Complex64;

use crate::error::{GroundMotionError, positive};
use crate::generators::noise::Noise;
use crate::generators::{Envelope, Generated, Generator, TimeGrid};
use crate::spectra::inverse_transform;
use crate::step_record::StepRecord;

/// A two-sided power spectral density of ground acceleration.
pub trait PowerSpectrum {
    /// Density (m2/s3) at a circular frequency (rad/s); its integral over all
    /// frequencies of both signs is the variance.
    fn density(&self, frequency: f64) -> f64;

    /// Its name, title and source.
    fn generator(&self) -> &'static Generator;

    /// The circular frequency (rad/s) of its hump, which samples must show.
    fn main_frequency(&self) -> f64;

    /// Parameters with their names, after a check.
    ///
    /// # Errors
    /// Parameters out of range.
    fn describe(&self) -> Result<StepRecord, GroundMotionError>;
}

/// A motion of random phases under an envelope: Shinozuka and Deodatis (1991), Appl.
/// Mech. Rev. 44 (4) 191, eq. 28: `a = sqrt(2) sum A_k cos(w_k t + phi_k)`,
/// `A_k = sqrt(2 S dw)`.
///
/// Frequencies lie 2 pi/L apart, L at least twice the duration, so that the end knows
/// nothing of the start, and end at half the sampling rate: what the spectrum has
/// beyond is lost, and the record says how much variance is left.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StationaryMotion<S> {
    /// Power spectrum.
    pub spectrum: S,
    /// Envelope over the duration.
    pub envelope: Envelope,
}

impl<S: PowerSpectrum> StationaryMotion<S> {
    /// The motion of a seed.
    ///
    /// # Errors
    /// Parameters, time step or duration out of range, or a spectrum whose main frequency is half
    /// the sampling rate or more.
    pub fn generate(&self, grid: TimeGrid, seed: u64) -> Result<Generated, GroundMotionError> {
        let count = grid.count()?;
        let mut step = self.spectrum.describe()?;
        let hump = self.spectrum.main_frequency() / TAU;
        let sampled = grid.record(self.spectrum.generator().name, hump)?;
        step.remarks.extend(sampled.remarks);
        self.envelope.check(grid.duration)?;
        let length = (2 * count).next_power_of_two();
        let apart = TAU / (length as f64 * grid.time_step);
        let mut noise = Noise::new(seed);
        let mut coefficients = vec![Complex64::default(); length / 2 + 1];
        let mut variance = 0.0;
        for (k, c) in coefficients.iter_mut().enumerate().take(length / 2).skip(1) {
            let power = self.spectrum.density(k as f64 * apart) * apart;
            variance += 2.0 * power;
            // 2 sqrt(S dw) cos(w t + phi), halved between both signs of w.
            let (sine, cosine) = libm::sincos(noise.phase());
            *c = Complex64::new(cosine, sine).scale(length as f64 * power.sqrt());
        }
        let mut samples = inverse_transform(coefficients, length);
        samples.truncate(count);
        for (i, a) in samples.iter_mut().enumerate() {
            *a *= self.envelope.at(i as f64 * grid.time_step, grid.duration);
        }
        let step = step
            .number("standard deviation", variance.sqrt(), "m/s2")
            .remark(format!("seed {seed}, envelope {}", self.envelope));
        grid.finish(samples, step)
    }
}

/// The density S0 (m2/s3) of white noise that makes the maximum value of a motion a
/// given multiple of its standard deviation: `S0 = (PGA/p)^2 / (variance at S0 = 1)`.
pub(crate) fn intensity_for_peak(
    step: &'static str,
    peak: f64,
    peak_factor: f64,
    variance_of_one: f64,
) -> Result<f64, GroundMotionError> {
    positive(step, "peak acceleration", peak)?;
    positive(step, "peak factor", peak_factor)?;
    Ok((peak / peak_factor).powi(2) / variance_of_one)
}
