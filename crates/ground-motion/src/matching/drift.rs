//! Changes of a motion that leave no velocity and no displacement behind, and motions
//! without them.

use std::f64::consts::PI;

use crate::accelerogram::Accelerogram;
use crate::error::{GroundMotionError, within};
use crate::measures::integrate;

/// What a change leaves at the end: velocity and displacement.
pub(crate) fn left_behind(change: &[f64], step: f64) -> [f64; 2] {
    let (velocity, displacement) = integrate(change, step, 0.0, 0.0);
    [
        velocity.last().copied().unwrap_or(0.0),
        displacement.last().copied().unwrap_or(0.0),
    ]
}

/// Takes that combination of two shapes off a change that brings velocity and
/// displacement at the end to given values; `false` where the shapes cannot.
pub(crate) fn bring_to(change: &mut [f64], shapes: [&[f64]; 2], end: [f64; 2], step: f64) -> bool {
    // Twice: the second pass takes the rounding of the first off.
    for _ in 0..2 {
        let left = left_behind(change, step);
        let [a, b] = shapes.map(|s| left_behind(s, step));
        let wanted = [left[0] - end[0], left[1] - end[1]];
        let determinant = a[0] * b[1] - a[1] * b[0];
        let scale = a[0].abs() * b[1].abs() + a[1].abs() * b[0].abs();
        if !(determinant.abs() > 1.0e-12 * scale) {
            return false;
        }
        let first = (wanted[0] * b[1] - wanted[1] * b[0]) / determinant;
        let second = (a[0] * wanted[1] - a[1] * wanted[0]) / determinant;
        for (i, c) in change.iter_mut().enumerate() {
            *c -= first * shapes[0][i] + second * shapes[1][i];
        }
    }
    true
}

/// Half a sine and a whole one over the record: zero at both ends.
pub(crate) fn end_shapes(count: usize) -> [Vec<f64>; 2] {
    [1.0, 2.0].map(|waves| {
        (0..count)
            .map(|i| libm::sin(PI * waves * i as f64 / (count - 1) as f64))
            .collect()
    })
}

/// The record with other samples, velocity and displacement at the end brought to zero.
///
/// # Errors
/// Fewer than four samples, between which the shapes have no values that differ, and
/// samples that are not finite.
pub(crate) fn ending_at_rest(
    record: &Accelerogram,
    mut samples: Vec<f64>,
) -> Result<Accelerogram, GroundMotionError> {
    within(
        "spectrum matching",
        "number of samples",
        samples.len() as f64,
        4.0,
        f64::MAX,
    )?;
    let (h, shapes) = (record.time_step(), end_shapes(samples.len()));
    bring_to(&mut samples, [&shapes[0], &shapes[1]], [0.0; 2], h);
    record.with_samples(samples, h)
}
