//! Ricker (1953), Geophysics 18 (1) 10: the second derivative of a Gaussian.

use std::f64::consts::PI;

use crate::error::{GroundMotionError, positive};
use crate::generators::{Generated, Generator, TimeGrid};

const STEP: &str = Ricker1953::GENERATOR.name;

/// `a = A (1 - 2 x) exp(-x)`, `x = pi^2 (t - t0)^2/Tp^2`: no velocity and no
/// displacement remains.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ricker1953 {
    /// Peak acceleration A (m/s2).
    pub amplitude: f64,
    /// Period Tp (s) of the maximum Fourier amplitude.
    pub period: f64,
    /// Time t0 of the peak (s); from 1.5 Tp the start is below 1e-7 of the peak.
    pub centre: f64,
}

/// Periods on either side of the peak that a motion must hold: beyond them the acceleration is below 1e-3 of its
/// peak, and so is the velocity.
const SIDE: f64 = 1.0;

impl Ricker1953 {
    /// Name, title and source.
    pub const GENERATOR: Generator = Generator {
        name: "ricker_1953",
        title: "Second derivative of a Gaussian",
        source: "Ricker, Geophysics 18 (1953) 10",
    };

    /// Acceleration (m/s2) at a time (s).
    #[must_use]
    pub fn acceleration(&self, time: f64) -> f64 {
        let x = (PI * (time - self.centre) / self.period).powi(2);
        self.amplitude * (1.0 - 2.0 * x) * libm::exp(-x)
    }

    /// The motion.
    ///
    /// # Errors
    /// Numbers that are not positive, a period of two time steps or less, or a pulse that does not fit into the
    /// duration, with one period on either side of its centre.
    pub fn generate(&self, grid: TimeGrid) -> Result<Generated, GroundMotionError> {
        positive(STEP, "amplitude", self.amplitude)?;
        positive(STEP, "period", self.period)?;
        let step = grid.record(STEP, 1.0 / self.period)?;
        let side = SIDE * self.period;
        grid.has_room_around(STEP, self.centre, side)?;
        let step = step
            .number("amplitude", self.amplitude, "m/s2")
            .number("period", self.period, "s")
            .number("centre", self.centre, "s");
        grid.finish(grid.sample(|t| self.acceleration(t))?, step)
    }
}
