//! Response spectra of floors: what equipment that stands on them feels.

use crate::error::GroundMotionError;
use crate::spectra::response::{check, spectrum_under};
use crate::spectra::{Evaluation, ResponseSpectrum};

const STEP: &str = "floor response spectrum";

/// The motion of a floor at even times from rest, as many of each.
///
/// Its accelerations are not asked for: those at even times miss impacts, which last milliseconds or are jumps of the
/// velocity. Displacements and velocities hold all that impacts have done.
#[derive(Debug, Clone, Copy)]
pub struct FloorMotion<'m> {
    /// Time step (s).
    pub time_step: f64,
    /// Acceleration of the ground (m/s2).
    pub ground: &'m [f64],
    /// Displacement of the floor relative to the ground (m).
    pub displacement: &'m [f64],
    /// Velocity of the floor relative to the ground (m/s).
    pub velocity: &'m [f64],
}

impl FloorMotion<'_> {
    /// Forces per mass (m/s2) on what stands on the floor, at both ends of each step: less the acceleration of the ground,
    /// linear between its values, and less that of the cubic polynomial (Hermite) that has the displacements and
    /// velocities of the floor at both ends. Over a step it changes the velocity as the floor changes its own.
    fn forces(&self) -> impl Iterator<Item = [f64; 2]> + Clone + '_ {
        let h = self.time_step;
        let steps = self.displacement.windows(2).zip(self.velocity.windows(2));
        let steps = steps.zip(self.ground.windows(2));
        steps.map(move |((x, v), ground)| {
            let mean = (x[1] - x[0]) / h;
            let start = (6.0 * mean - 4.0 * v[0] - 2.0 * v[1]) / h;
            let end = (4.0 * v[1] + 2.0 * v[0] - 6.0 * mean) / h;
            [-(ground[0] + start), -(ground[1] + end)]
        })
    }
}

/// Response spectrum of a floor for periods (s) above zero and a damping ratio: peaks of linear oscillators that stand on
/// it and do not move it, relative to the floor, and their absolute accelerations; by the exact recurrence of Nigam and Jennings (1969)
/// under the acceleration of the floor that has its displacements and velocities. A jump of the velocity within a step counts 1.6 % low
/// where the period has ten steps, 0.07 % where it has fifty.
///
/// # Errors
/// A damping ratio outside [0, 1), a period that is not above a thousandth of the time step, and lists of other lengths or
/// of fewer than two values.
pub fn floor_spectrum(
    motion: &FloorMotion<'_>,
    periods: &[f64],
    damping: f64,
) -> Result<ResponseSpectrum, GroundMotionError> {
    let lengths = [motion.ground, motion.displacement, motion.velocity].map(<[f64]>::len);
    if lengths[0] < 2 || lengths[1..] != [lengths[0]; 2] {
        return Err(GroundMotionError::NotPossible {
            step: STEP,
            reason: format!(
                "the motion has {lengths:?} accelerations of the ground, displacements and velocities"
            ),
            remedy: "give as many of each, two at least",
        });
    }
    if periods.contains(&0.0) {
        return Err(GroundMotionError::OutOfRange {
            step: STEP,
            name: "period",
            value: 0.0,
            range: "above zero: what is rigid feels the peak acceleration of the floor".to_owned(),
        });
    }
    check(periods, damping, motion.time_step)?;
    let oscillators = (periods, damping, motion.time_step);
    let evaluation = (Evaluation::PiecewiseLinear, 0.0);
    spectrum_under(oscillators, motion.forces(), evaluation, &|| true)
}
