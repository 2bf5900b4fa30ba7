//! Matching by wavelets added in time: Lilhanand and Tseng (1988), with the improved
//! tapered cosine of Al Atik and Abrahamson (2010), Earthquake Spectra 26 (3) 601.
//!
//! Each period gets a wavelet that raises or lowers its oscillator at the time of its
//! peak; amplitudes solve `C b = target - response`, C the response of each
//! oscillator at its peak to each wavelet. The wavelet leaves nearly no velocity and
//! displacement; what is left, and what is cut off at an end of the record, is taken
//! off under the wavelet's own window, so that the ground ends as it did before.

use std::f64::consts::TAU;

use nalgebra::{DMatrix, DVector};

use crate::accelerogram::Accelerogram;
use crate::error::GroundMotionError;
use crate::matching::{Adjustment, MatchOptions, Matched, drift, iterate, spectrum};
use crate::spectra::{Oscillator, State, TargetSpectrum};

/// Part of the difference that one iteration takes away.
const RELAXATION: f64 = 0.7;
/// Part of the greatest diagonal that is added to it: neighbours are nearly dependent.
const REGULARISATION: f64 = 1.0e-3;
/// Beyond this many widths the window is below rounding.
const WIDTHS: f64 = 6.0;

struct Wavelets;

/// Brings a record to a target by wavelets at the times of the peaks. Velocity and
/// displacement at the end stay what they were, times the scale.
///
/// # Errors
/// A band that the target or the record does not cover, or
/// [`GroundMotionError::NotMatched`].
pub fn match_by_wavelets(
    record: &Accelerogram,
    target: &TargetSpectrum,
    options: MatchOptions,
) -> Result<Matched, GroundMotionError> {
    iterate(record, target, options, &mut Wavelets)
}

/// One oscillator at its peak.
struct AtPeak {
    oscillator: Oscillator,
    frequency: f64,
    /// Sample of the peak.
    index: usize,
    /// Sign of the displacement there.
    sign: f64,
}

impl Adjustment for Wavelets {
    const NAME: &'static str = "matching by wavelets";

    fn improve(
        &mut self,
        record: &Accelerogram,
        target: &TargetSpectrum,
        periods: &[f64],
    ) -> Result<Accelerogram, GroundMotionError> {
        let (h, samples) = (record.time_step(), record.samples());
        let now = spectrum(record, target, periods)?;
        let peaks: Vec<AtPeak> = periods
            .iter()
            .map(|&period| at_peak(samples, period, target.damping(), h))
            .collect();
        let wavelets: Vec<Wavelet> = peaks
            .iter()
            .filter_map(|p| wavelet(p, target.damping(), samples.len(), h))
            .collect();
        let size = peaks.len();
        let mut matrix = DMatrix::zeros(size, wavelets.len());
        for (j, w) in wavelets.iter().enumerate() {
            for (i, p) in peaks.iter().enumerate() {
                matrix[(i, j)] = p.response_to(w);
            }
        }
        let difference = DVector::from_fn(size, |i, _| {
            let wanted = target.nearest(periods[i]) - now.pseudo_acceleration[i];
            wanted * peaks[i].sign * RELAXATION
        });
        // Rows weighted so that deviations are parts of the target.
        let weight = DVector::from_fn(size, |i, _| 1.0 / target.nearest(periods[i]));
        let weighted = DMatrix::from_diagonal(&weight) * matrix;
        let right = weighted.transpose() * difference.component_mul(&weight);
        let mut normal = weighted.transpose() * &weighted;
        let added = REGULARISATION * normal.diagonal().max();
        for i in 0..wavelets.len() {
            normal[(i, i)] += added;
        }
        let Some(factors) = normal.cholesky().map(|c| c.solve(&right)) else {
            return Err(GroundMotionError::NotPossible {
                step: Self::NAME,
                reason: "the wavelets depend on one another".to_owned(),
                remedy: "match fewer periods or a narrower band",
            });
        };
        let mut changed = samples.to_vec();
        for (w, factor) in wavelets.iter().zip(factors.iter()) {
            for (a, f) in changed[w.first..].iter_mut().zip(&w.samples) {
                *a += factor * f;
            }
        }
        record.with_samples(changed, h)
    }
}

/// Samples of a wavelet from a first one; zero elsewhere.
struct Wavelet {
    first: usize,
    samples: Vec<f64>,
}

fn at_peak(samples: &[f64], period: f64, damping: f64, h: f64) -> AtPeak {
    let oscillator = Oscillator::new(period, damping, h);
    let mut state = State::default();
    let (mut index, mut most) = (0, 0.0_f64);
    for (i, pair) in samples.windows(2).enumerate() {
        state = oscillator.advance(state, -pair[0], -pair[1]);
        if state.displacement.abs() > most.abs() {
            (index, most) = (i + 1, state.displacement);
        }
    }
    AtPeak {
        oscillator,
        frequency: TAU / period,
        index,
        sign: most.signum(),
    }
}

/// `cos(w' s) exp(-(s/g)^2)`, `s = t - t_peak + atan(sqrt(1 - z^2)/z)/w'`,
/// `w' = w sqrt(1 - z^2)`, `g = 1.178 f^-0.93`; `None` where nothing of it lies in the
/// record.
fn wavelet(peak: &AtPeak, damping: f64, count: usize, h: f64) -> Option<Wavelet> {
    let root = (1.0 - damping * damping).sqrt();
    let w = peak.frequency * root;
    let width = 1.178 * (peak.frequency / TAU).powf(-0.93);
    let centre = peak.index as f64 * h - root.atan2(damping) / w;
    let first = ((centre - WIDTHS * width) / h).ceil().max(0.0) as usize;
    let last = ((centre + WIDTHS * width) / h)
        .floor()
        .min((count - 1) as f64);
    let inside = (last - first as f64 + 1.0).max(0.0) as usize;
    let of = |f: &dyn Fn(f64) -> f64| -> Vec<f64> {
        (first..first + inside)
            .map(|i| {
                let s = i as f64 * h - centre;
                f(s) * (-(s / width).powi(2)).exp()
            })
            .collect()
    };
    let mut samples = of(&|s| (w * s).cos());
    let (constant, slope) = (of(&|_| 1.0), of(&|s| s / width));
    // Zero at the ends of the window: no drift over it is no drift over the record.
    drift::bring_to(&mut samples, [&constant, &slope], [0.0; 2], h)
        .then_some(Wavelet { first, samples })
}

impl AtPeak {
    /// `w^2 u` at the time of the peak under a wavelet.
    fn response_to(&self, wavelet: &Wavelet) -> f64 {
        let mut state = State::default();
        let at = |i: usize| match i.checked_sub(wavelet.first) {
            Some(k) => wavelet.samples.get(k).copied().unwrap_or(0.0),
            None => 0.0,
        };
        for i in wavelet.first.saturating_sub(1)..self.index {
            state = self.oscillator.advance(state, -at(i), -at(i + 1));
        }
        self.frequency * self.frequency * state.displacement
    }
}
