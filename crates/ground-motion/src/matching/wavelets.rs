//! Matching by wavelets added in time: Lilhanand and Tseng (1988), with the improved
//! tapered cosine of Al Atik and Abrahamson (2010), Earthquake Spectra 26 (3) 601.
//!
//! Each period gets wavelets that raise or lower its oscillator at the times of its
//! greatest peaks, so that no other peak takes the place of the one that was matched.
//! Amplitudes b solve `C b = target - response`, C the response of each oscillator at
//! its peaks to each wavelet, by damped least squares (Levenberg and Marquardt). Rows
//! are weighted by their deviation, so that the worst periods count most. The
//! wavelet leaves nearly no velocity and displacement; what is left, and what is cut
//! off at an end of the record, is taken off under the wavelet's own window, so that
//! the ground ends as it did before.

use std::f64::consts::TAU;

use nalgebra::{DMatrix, DVector};

use crate::accelerogram::Accelerogram;
use crate::error::GroundMotionError;
use crate::matching::{Adjustment, MatchOptions, Matched, drift, iterate};
use crate::spectra::{Oscillator, State, TargetSpectrum, zero};

/// Peaks of an oscillator from this part of the greatest on are looked after, at most
/// so many.
const PEAKS_FROM: f64 = 0.75;
/// Samples below this part of the greatest have no such peak beside them, where there
/// are five to a period.
const SAMPLES_FROM: f64 = 0.5;
const MOST_PEAKS: usize = 5;
/// Damping of the least squares as a part of the greatest diagonal: at the start, and
/// its factors after success and failure.
const FIRST_DAMPING: f64 = 1.0e-3;
const LEAST_DAMPING: f64 = 1.0e-9;
const AFTER_SUCCESS: f64 = 0.3;
const AFTER_FAILURE: f64 = 4.0;
/// Trials of one iteration.
const MOST_TRIALS: usize = 8;
/// Deviation that rows without one are weighted with.
const LEAST_WEIGHT: f64 = 0.02;
/// Beyond this many widths the window is below rounding.
const WIDTHS: f64 = 6.0;

struct Wavelets {
    damping: f64,
}

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
    let mut wavelets = Wavelets {
        damping: FIRST_DAMPING,
    };
    iterate(record, target, options, &mut wavelets)
}

/// One peak of an oscillator.
#[derive(Clone, Copy)]
struct AtPeak {
    /// Sample before it.
    index: usize,
    /// Time from there to it (s), at most a step.
    after: f64,
    /// Pseudo-acceleration there as a part of the target, with its sign.
    part: f64,
}

/// One oscillator with its greatest peaks, the greatest first.
struct Row {
    oscillator: Oscillator,
    frequency: f64,
    target: f64,
    peaks: Vec<AtPeak>,
}

/// Samples of a wavelet from a first one; zero elsewhere.
struct Wavelet {
    first: usize,
    samples: Vec<f64>,
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
        let all = with_middles(periods);
        let rows = rows_of(samples, &all, target, h);
        let wavelets: Vec<Wavelet> = rows
            .iter()
            .step_by(2)
            .flat_map(|r| r.peaks.iter().map(move |p| (r, p)))
            .filter_map(|(r, p)| wavelet(r, *p, target.damping(), samples.len(), h))
            .collect();
        let (matrix, deviations) = system(&rows, &wavelets);
        let normal = matrix.transpose() * &matrix;
        let right = matrix.transpose() * deviations;
        let before = objective(&rows);
        for _ in 0..MOST_TRIALS {
            let Some(factors) = damped(&normal, &right, self.damping) else {
                self.damping *= AFTER_FAILURE;
                continue;
            };
            let mut changed = samples.to_vec();
            for (w, factor) in wavelets.iter().zip(factors.iter()) {
                for (a, f) in changed[w.first..].iter_mut().zip(&w.samples) {
                    *a -= factor * f;
                }
            }
            if objective(&rows_of(&changed, &all, target, h)) < before {
                self.damping = (self.damping * AFTER_SUCCESS).max(LEAST_DAMPING);
                return record.with_samples(changed, h);
            }
            self.damping *= AFTER_FAILURE;
        }
        Ok(record.clone())
    }
}

/// The periods and those between them.
fn with_middles(periods: &[f64]) -> Vec<f64> {
    let mut all = vec![periods[0]];
    for pair in periods.windows(2) {
        all.extend([(pair[0] * pair[1]).sqrt(), pair[1]]);
    }
    all
}

fn rows_of(samples: &[f64], all: &[f64], target: &TargetSpectrum, h: f64) -> Vec<Row> {
    all.iter()
        .map(|&period| Row::of(samples, period, target, h))
        .collect()
}

fn objective(rows: &[Row]) -> f64 {
    rows.iter().map(Row::objective).sum()
}

/// Responses to wavelets and deviations, both as parts of the target and weighted by the
/// deviation.
fn system(rows: &[Row], wavelets: &[Wavelet]) -> (DMatrix<f64>, DVector<f64>) {
    let count = rows.iter().map(|r| r.peaks.len()).sum();
    let mut matrix = DMatrix::zeros(count, wavelets.len());
    let mut deviations = DVector::zeros(count);
    let mut at = 0;
    for row in rows {
        let found: Vec<f64> = row.deviations().collect();
        for (j, w) in wavelets.iter().enumerate() {
            for (k, value) in row.responses_to(w).into_iter().enumerate() {
                matrix[(at + k, j)] = value * (found[k].abs() + LEAST_WEIGHT);
            }
        }
        for (k, deviation) in found.iter().enumerate() {
            deviations[at + k] = deviation * (deviation.abs() + LEAST_WEIGHT);
        }
        at += found.len();
    }
    (matrix, deviations)
}

fn damped(normal: &DMatrix<f64>, right: &DVector<f64>, damping: f64) -> Option<DVector<f64>> {
    let mut matrix = normal.clone();
    let added = damping * normal.diagonal().max();
    for i in 0..matrix.nrows() {
        matrix[(i, i)] += added;
    }
    matrix.cholesky().map(|c| c.solve(right))
}

impl Row {
    fn of(samples: &[f64], period: f64, target: &TargetSpectrum, h: f64) -> Self {
        let oscillator = Oscillator::new(period, target.damping(), h);
        let frequency = TAU / period;
        let wanted = target.nearest(period);
        let mut states = vec![State::default()];
        let mut highest = 0.0_f64;
        for pair in samples.windows(2) {
            let next = oscillator.advance(states[states.len() - 1], -pair[0], -pair[1]);
            highest = highest.max(next.displacement.abs());
            states.push(next);
        }
        let mut peaks: Vec<AtPeak> = Vec::new();
        for (index, pair) in states.windows(2).enumerate() {
            // The displacement turns where its velocity is zero.
            let near = pair[0].displacement.abs().max(pair[1].displacement.abs());
            if near < SAMPLES_FROM * highest || pair[0].velocity * pair[1].velocity >= 0.0 {
                continue;
            }
            let forces = [-samples[index], -samples[index + 1]];
            let at = |t| oscillator.within_step(pair[0], forces[0], forces[1], t);
            let ends = [pair[0].velocity, pair[1].velocity];
            let after = zero(0.0, h, ends[0], ends[1], 1.0e-6 * h, |t| at(t).velocity);
            peaks.push(AtPeak {
                index,
                after,
                part: frequency * frequency * at(after).displacement / wanted,
            });
        }
        let most = peaks.iter().fold(0.0_f64, |m, p| m.max(p.part.abs()));
        peaks.retain(|p| p.part.abs() >= PEAKS_FROM * most);
        peaks.sort_by(|a, b| b.part.abs().total_cmp(&a.part.abs()));
        peaks.truncate(MOST_PEAKS);
        Self {
            oscillator,
            frequency,
            target: wanted,
            peaks,
        }
    }

    /// What each peak is too far out, with its sign, as a part of the target: the
    /// greatest must reach one, the others must not exceed it and rise with it.
    fn deviations(&self) -> impl Iterator<Item = f64> {
        let greatest = self.peaks.first().map_or(1.0, |p| p.part.abs());
        let lift = (1.0 - 1.0 / greatest).min(0.0);
        self.peaks.iter().enumerate().map(move |(k, peak)| {
            let part = peak.part.abs();
            let out = if k == 0 || part > 1.0 {
                part - 1.0
            } else {
                part * lift
            };
            out * peak.part.signum()
        })
    }

    /// Sum over the peaks of that function of the deviation d whose derivative is
    /// `d (|d| + c)^2`: what the weighted least squares lower.
    fn objective(&self) -> f64 {
        self.deviations()
            .map(|d| {
                let (d, c) = (d.abs(), LEAST_WEIGHT);
                d * d * (d * d / 4.0 + 2.0 * c * d / 3.0 + c * c / 2.0)
            })
            .sum()
    }

    /// `w^2 u` at the times of the peaks under a wavelet, as a part of the target.
    fn responses_to(&self, wavelet: &Wavelet) -> Vec<f64> {
        let mut found = vec![0.0; self.peaks.len()];
        let last = self.peaks.iter().map(|p| p.index).max().unwrap_or(0);
        let scale = self.frequency * self.frequency / self.target;
        let at = |i: usize| match i.checked_sub(wavelet.first) {
            Some(k) => wavelet.samples.get(k).copied().unwrap_or(0.0),
            None => 0.0,
        };
        let mut state = State::default();
        for i in wavelet.first.saturating_sub(1)..=last {
            let (p0, p1) = (-at(i), -at(i + 1));
            for (value, peak) in found.iter_mut().zip(&self.peaks) {
                if peak.index == i {
                    let there = self.oscillator.within_step(state, p0, p1, peak.after);
                    *value = scale * there.displacement;
                }
            }
            state = self.oscillator.advance(state, p0, p1);
        }
        found
    }
}

/// `cos(w' s) exp(-(s/g)^2)`, `s = t - t_peak + atan(sqrt(1 - z^2)/z)/w'`,
/// `w' = w sqrt(1 - z^2)`, `g = 1.178 f^-0.93`; `None` where nothing of it lies in the
/// record.
fn wavelet(row: &Row, peak: AtPeak, damping: f64, count: usize, h: f64) -> Option<Wavelet> {
    let root = (1.0 - damping * damping).sqrt();
    let w = row.frequency * root;
    let width = 1.178 * (row.frequency / TAU).powf(-0.93);
    let centre = peak.index as f64 * h + peak.after - root.atan2(damping) / w;
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
