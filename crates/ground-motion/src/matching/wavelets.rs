//! Matching by wavelets added in time: Lilhanand and Tseng (1988), with the improved
//! tapered cosine of Al Atik and Abrahamson (2010), Earthquake Spectra 26 (3) 601.
//!
//! Each period gets wavelets that raise or lower its oscillator at the times of its
//! highest peaks; their amplitudes are those of [`LeastSquares`]. The wavelet leaves
//! nearly no velocity and displacement; what is left, and what is cut off at an end of the
//! record, is taken off under the wavelet's own window, so that the ground ends at rest.

use std::f64::consts::TAU;

use crate::accelerogram::Accelerogram;
use crate::error::GroundMotionError;
use crate::matching::least_squares::{LeastSquares, Rows};
use crate::matching::misfit::Deviations;
use crate::matching::peaks::{AtPeak, Change, Row};
use crate::matching::{Adjustment, MatchOptions, Matched, drift, iterate};
use crate::spectra::TargetSpectrum;

/// Beyond this many widths the window is below rounding.
const WIDTHS: f64 = 6.0;

struct Wavelets(LeastSquares);

/// Brings a record to a target by wavelets at the times of the peaks. Velocity and
/// displacement at the end are zero after it: what the record has of them is taken off
/// first.
///
/// # Errors
/// A band that the target or the record does not cover, or
/// [`GroundMotionError::NotMatched`].
pub fn match_by_wavelets(
    record: &Accelerogram,
    target: &TargetSpectrum,
    options: MatchOptions,
) -> Result<Matched, GroundMotionError> {
    iterate(record, target, options, &mut Wavelets(LeastSquares::new()))
}

impl Adjustment for Wavelets {
    const NAME: &'static str = "matching by wavelets";

    fn improve(
        &mut self,
        record: &Accelerogram,
        target: &TargetSpectrum,
        periods: &[f64],
        deviations: &Deviations,
    ) -> Result<Accelerogram, GroundMotionError> {
        let (h, count) = (record.time_step(), record.samples().len());
        let rows = Rows::of(record, target, periods, deviations);
        let wavelets: Vec<Change> = rows.rows[rows.between..]
            .iter()
            .flat_map(|r| r.peaks.iter().map(move |p| (r, p)))
            .filter_map(|(r, p)| wavelet(r, *p, target.damping(), count, h))
            .collect();
        self.0.improve(record, target, &rows, &wavelets)
    }
}

/// `cos(w' s) exp(-(s/g)^2)`, `s = t - t_peak + atan(sqrt(1 - z^2)/z)/w'`,
/// `w' = w sqrt(1 - z^2)`, `g = 1.178 f^-0.93`; `None` where nothing of it lies in the
/// record.
fn wavelet(row: &Row, peak: AtPeak, damping: f64, count: usize, h: f64) -> Option<Change> {
    let root = (1.0 - damping * damping).sqrt();
    let w = row.frequency * root;
    let width = 1.178 * libm::pow(row.frequency / TAU, -0.93);
    let centre = peak.index as f64 * h + peak.after - libm::atan2(root, damping) / w;
    let first = ((centre - WIDTHS * width) / h).ceil().max(0.0) as usize;
    let last = ((centre + WIDTHS * width) / h)
        .floor()
        .min((count - 1) as f64);
    let inside = (last - first as f64 + 1.0).max(0.0) as usize;
    let of = |f: &dyn Fn(f64) -> f64| -> Vec<f64> {
        (first..first + inside)
            .map(|i| {
                let s = i as f64 * h - centre;
                f(s) * libm::exp(-(s / width).powi(2))
            })
            .collect()
    };
    let mut samples = of(&|s| libm::cos(w * s));
    let (constant, slope) = (of(&|_| 1.0), of(&|s| s / width));
    // Zero at the ends of the window: no drift over it is no drift over the record.
    drift::bring_to(&mut samples, [&constant, &slope], [0.0; 2], h)
        .then_some(Change { first, samples })
}
