//! The step of a match: factors `b` of some changes of the motion that solve
//! `C b = target - response`, C the response of each oscillator at its highest peaks to
//! each change, by damped least squares (Levenberg and Marquardt). All peaks from three
//! quarters of the highest on take part, so that no other takes the place of the one
//! that was matched; rows are weighted by their deviation, so that the worst count most.

use nalgebra::{DMatrix, DVector};

use crate::accelerogram::Accelerogram;
use crate::error::GroundMotionError;
use crate::matching::misfit::Deviations;
use crate::matching::peaks::{Change, Row, responses_to};
use crate::spectra::{TOGETHER, TargetSpectrum};

/// Damping of the least squares as a part of the largest diagonal element: at the start, and
/// its factors after success and failure.
const FIRST_DAMPING: f64 = 1.0e-3;
const LEAST_DAMPING: f64 = 1.0e-9;
const GREATEST_DAMPING: f64 = 1.0e3;
const AFTER_SUCCESS: f64 = 0.3;
const AFTER_FAILURE: f64 = 4.0;
/// Trials of one power.
const MOST_TRIALS: usize = 8;
/// Deviation that rows without one are weighted with.
const LEAST_WEIGHT: f64 = 0.02;
/// Powers of the deviations whose sum is lowered: the next where one comes to its end.
/// The higher, the more the worst deviation counts alone.
const POWERS: [f64; 3] = [4.0, 8.0, 16.0];
/// Periods nearer than this are the same (logarithms).
const SAME_PERIOD: f64 = 2.0e-3;

/// State that one iteration hands to the next.
pub(crate) struct LeastSquares {
    damping: f64,
}

/// Oscillators of a match.
pub(crate) struct Rows {
    /// Their periods (s).
    periods: Vec<f64>,
    /// In the order of the periods.
    pub rows: Vec<Row>,
    /// How many of them, from the start, are between periods and have no changes.
    pub between: usize,
}

impl Rows {
    /// Those between the periods, the periods themselves, and where the worst deviations
    /// are.
    pub(crate) fn of(
        record: &Accelerogram,
        target: &TargetSpectrum,
        periods: &[f64],
        deviations: &Deviations,
    ) -> Self {
        let mut all: Vec<f64> = periods.windows(2).map(|p| (p[0] * p[1]).sqrt()).collect();
        let between = all.len();
        all.extend(periods);
        for period in deviations.worst_places() {
            let known = all[between..]
                .iter()
                .any(|t| libm::log(t / period).abs() < SAME_PERIOD);
            if !known {
                all.push(period);
            }
        }
        let rows = rows_of(record.samples(), &all, target, record.time_step());
        Self {
            periods: all,
            rows,
            between,
        }
    }
}

fn rows_of(samples: &[f64], all: &[f64], target: &TargetSpectrum, h: f64) -> Vec<Row> {
    all.iter()
        .map(|&period| Row::of(samples, period, target, h))
        .collect()
}

impl LeastSquares {
    pub(crate) fn new() -> Self {
        Self {
            damping: FIRST_DAMPING,
        }
    }

    /// The record with that combination of changes taken off that brings it nearer the
    /// target; the same record where none does.
    ///
    /// # Errors
    /// None in practice: samples that are not finite.
    pub(crate) fn improve(
        &mut self,
        record: &Accelerogram,
        target: &TargetSpectrum,
        rows: &Rows,
        changes: &[Change],
    ) -> Result<Accelerogram, GroundMotionError> {
        let (h, samples) = (record.time_step(), record.samples());
        let responses = responses(&rows.rows, changes);
        let found = deviations(&rows.rows);
        for power in POWERS {
            let (normal, right) = normal_equations(&responses, &found, power);
            let before = objective(&found, power);
            self.damping = self.damping.min(FIRST_DAMPING);
            for _ in 0..MOST_TRIALS {
                if let Some(factors) = damped(&normal, &right, self.damping) {
                    let changed = without(samples, changes, &factors);
                    let after = deviations(&rows_of(&changed, &rows.periods, target, h));
                    if objective(&after, power) < before {
                        self.damping = (self.damping * AFTER_SUCCESS).max(LEAST_DAMPING);
                        return record.with_samples(changed, h);
                    }
                }
                self.damping = (self.damping * AFTER_FAILURE).min(GREATEST_DAMPING);
            }
        }
        Ok(record.clone())
    }
}

fn without(samples: &[f64], changes: &[Change], factors: &DVector<f64>) -> Vec<f64> {
    let mut changed = samples.to_vec();
    for (change, factor) in changes.iter().zip(factors.iter()) {
        for (a, f) in changed[change.first..].iter_mut().zip(&change.samples) {
            *a -= factor * f;
        }
    }
    changed
}

fn deviations(rows: &[Row]) -> Vec<f64> {
    rows.iter().flat_map(Row::deviations).collect()
}

/// `(d^2 + c^2)^(p/2)` summed, zero where no row deviates.
fn objective(deviations: &[f64], power: f64) -> f64 {
    let c = LEAST_WEIGHT * LEAST_WEIGHT;
    deviations
        .iter()
        .map(|d| libm::pow((d * d + c) / c, 0.5 * power) - 1.0)
        .sum()
}

/// Responses of each row at its peaks to each change, as parts of the target.
fn responses(rows: &[Row], changes: &[Change]) -> DMatrix<f64> {
    let count = rows.iter().map(|r| r.peaks.len()).sum();
    let mut matrix = DMatrix::zeros(count, changes.len());
    let (together, alone) = rows.as_chunks::<TOGETHER>();
    let mut at = 0;
    for rows in together {
        at = fill(&mut matrix, at, rows.each_ref(), changes);
    }
    for row in alone {
        at = fill(&mut matrix, at, [row], changes);
    }
    matrix
}

/// Fills lines of the matrix from one on with the responses of rows; returns the line behind them.
fn fill<const N: usize>(
    matrix: &mut DMatrix<f64>,
    at: usize,
    rows: [&Row; N],
    changes: &[Change],
) -> usize {
    for (j, change) in changes.iter().enumerate() {
        let values = responses_to(rows, change).into_iter().flatten();
        for (k, value) in values.enumerate() {
            matrix[(at + k, j)] = value;
        }
    }
    at + rows.iter().map(|row| row.peaks.len()).sum::<usize>()
}

/// Those of the weighted least squares whose gradient is that of the objective.
fn normal_equations(
    responses: &DMatrix<f64>,
    deviations: &[f64],
    power: f64,
) -> (DMatrix<f64>, DVector<f64>) {
    let c = LEAST_WEIGHT * LEAST_WEIGHT;
    let mut weighted = responses.clone();
    let mut right = DVector::zeros(deviations.len());
    for (i, d) in deviations.iter().enumerate() {
        let weight = libm::pow((d * d + c) / c, 0.25 * (power - 2.0));
        weighted.row_mut(i).scale_mut(weight);
        right[i] = weight * d;
    }
    let transposed = weighted.transpose();
    (&transposed * &weighted, transposed * right)
}

fn damped(normal: &DMatrix<f64>, right: &DVector<f64>, damping: f64) -> Option<DVector<f64>> {
    let mut matrix = normal.clone();
    let added = damping * normal.diagonal().max();
    for i in 0..matrix.nrows() {
        matrix[(i, i)] += added;
    }
    matrix.cholesky().map(|c| c.solve(right))
}
