//! Response spectra of floors: what equipment that stands on them feels.

use crate::error::{GroundMotionError, within};
use crate::spectra::oscillator::{Piece, peaks_over};
use crate::spectra::response::check;
use crate::spectra::{Evaluation, ResponseSpectrum};

const STEP: &str = "floor response spectrum";

/// The motion of a floor over a time in which nothing jumps. The velocity at the start of a piece may be another than that
/// at the end of the one before: then the floor was struck between them.
///
/// Accelerations of the floor are not asked for: those at even times miss impacts, which last milliseconds or are jumps of
/// the velocity. Displacements and velocities hold all that impacts have done.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FloorMotion {
    /// Length (s).
    pub length: f64,
    /// Acceleration of the ground at start and end (m/s2), linear in between.
    pub ground: [f64; 2],
    /// Displacement of the floor relative to the ground there (m).
    pub displacement: [f64; 2],
    /// Velocity of the floor relative to the ground there (m/s).
    pub velocity: [f64; 2],
}

impl FloorMotion {
    /// What it does to equipment of unit mass on the floor after one that ended with this velocity (m/s): less the
    /// acceleration of the ground, and less that of the cubic polynomial (Hermite) that has the displacements and velocities
    /// of the floor at both ends.
    fn piece(&self, velocity_before: f64) -> Piece {
        let (h, [x, y], [v, w]) = (self.length, self.displacement, self.velocity);
        let mean = (y - x) / h;
        let start = (6.0 * mean - 4.0 * v - 2.0 * w) / h;
        let end = (4.0 * w + 2.0 * v - 6.0 * mean) / h;
        Piece {
            length: h,
            forces: [-(self.ground[0] + start), -(self.ground[1] + end)],
            jump: velocity_before - v,
        }
    }
}

/// Response spectrum of a floor for periods (s) above zero and a damping ratio: peaks of linear oscillators that stand on
/// it and do not move it, relative to the floor and from rest on it, and their absolute accelerations; by the exact step of
/// Nigam and Jennings (1969) over each piece of the motion. Peaks are those up to its end.
///
/// # Errors
/// A damping ratio outside [0, 1), a period that is not above zero, a piece without a length, and motions that are not
/// finite.
pub fn floor_spectrum(
    motion: &[FloorMotion],
    periods: &[f64],
    damping: f64,
) -> Result<ResponseSpectrum, GroundMotionError> {
    for &period in periods {
        within(STEP, "period", period, f64::MIN_POSITIVE, f64::MAX)?;
    }
    let mut longest = 0.0_f64;
    for piece in motion {
        within(
            STEP,
            "length of a piece",
            piece.length,
            f64::MIN_POSITIVE,
            f64::MAX,
        )?;
        longest = longest.max(piece.length);
        for (quantity, values) in [
            ("acceleration of the ground", piece.ground),
            ("displacement of the floor", piece.displacement),
            ("velocity of the floor", piece.velocity),
        ] {
            for value in values {
                within(STEP, quantity, value, -f64::MAX, f64::MAX)?;
            }
        }
    }
    check(periods, damping, longest)?;
    let before = std::iter::once(motion.first().map_or(0.0, |first| first.velocity[0]));
    let before = before.chain(motion.iter().map(|piece| piece.velocity[1]));
    let pieces = motion.iter().zip(before);
    let pieces = pieces.map(|(piece, before)| piece.piece(before));
    let mut spectrum = ResponseSpectrum::empty(damping, Evaluation::PiecewiseLinear);
    for &period in periods {
        spectrum.push_peaks(period, &peaks_over((period, damping), pieces.clone()));
    }
    Ok(spectrum)
}
