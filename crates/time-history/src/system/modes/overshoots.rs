//! What functions of the modes can do between samples beyond their values there.

use super::constants::ContactFree;
use super::lanes::{Lane, WIDTH, lane_by_lane};

/// Bounds of what the displacements of the modes can do between samples beyond their values
/// there, for these sizes of the modes and this maximum ground acceleration.
#[inline(always)]
pub(crate) fn modal_overshoots(
    constants: &ContactFree,
    size: &[Lane],
    largest: f64,
    modal: &mut [Lane],
) {
    let eighth = constants.eighth();
    for (c, m) in constants.modes.iter().enumerate() {
        lane_by_lane();
        let (size, [by_size, by_ground]) = (size[c], m.acceleration_bound);
        let mut sum = Lane::ZERO;
        for l in 0..WIDTH {
            sum[l] = eighth * (by_size[l] * size[l] + by_ground[l] * largest);
        }
        modal[c] = sum;
    }
}

/// The same for absolute acceleration, with the maximum slope of the ground's.
#[inline(always)]
pub(crate) fn modal_acceleration_overshoots(
    constants: &ContactFree,
    size: &[Lane],
    (largest, slope): (f64, f64),
    modal: &mut [Lane],
) {
    let eighth = constants.eighth();
    for (c, m) in constants.modes.iter().enumerate() {
        lane_by_lane();
        let (size, [by_size, by_ground, by_slope]) = (size[c], m.snap_bound);
        let mut sum = Lane::ZERO;
        for l in 0..WIDTH {
            let ground = by_ground[l] * largest + by_slope[l] * slope;
            sum[l] = eighth * (by_size[l] * size[l] + ground);
        }
        modal[c] = sum;
    }
}

/// Whether the bound of floor acceleration, told by the overshoot of displacement and this
/// maximum ground acceleration, is below all peaks of absolute acceleration.
#[inline(always)]
pub(crate) fn is_low(
    constants: &ContactFree,
    (displacement, largest): (&[Lane], f64),
    peak: &[Lane],
) -> bool {
    let eighth = constants.eighth();
    // Free vibration is what the floors do beside the ground's own acceleration.
    let ground = if constants.swings { largest } else { 0.0 };
    let mut low = true;
    for (over, peak) in displacement.iter().zip(peak) {
        for l in 0..WIDTH {
            low &= over[l] <= eighth * (peak[l] - ground);
        }
    }
    low
}
