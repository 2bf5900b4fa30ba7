//! Mavroeidis and Papageorgiou (2003), Bull. Seism. Soc. Am. 93 (3) 1099, eq. 3: the
//! velocity pulse of near-fault motions.

use std::f64::consts::{PI, TAU};

use crate::error::{GroundMotionError, positive, within};
use crate::generators::{Generated, Generator, TimeGrid};

const STEP: &str = MavroeidisPapageorgiou2003::GENERATOR.name;

/// `v = A/2 (1 + cos(2 pi fp s/gamma)) cos(2 pi fp s + nu)` for
/// `|s| <= gamma/(2 fp)`, `s = t - t0`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MavroeidisPapageorgiou2003 {
    /// Amplitude A of the velocity (m/s).
    pub amplitude: f64,
    /// Frequency fp (Hz).
    pub frequency: f64,
    /// Oscillatory character gamma (-), above 1.
    pub oscillation: f64,
    /// Phase nu (rad).
    pub phase: f64,
    /// Time t0 of the envelope's peak (s).
    pub centre: f64,
}

impl MavroeidisPapageorgiou2003 {
    /// Name, title and source.
    pub const GENERATOR: Generator = Generator {
        name: "mavroeidis_papageorgiou_2003",
        title: "Velocity pulse of near-fault motions",
        source: "Mavroeidis and Papageorgiou, Bulletin of the Seismological Society of America 93 (2003) 1099, equation 3",
    };

    /// Ground velocity (m/s) at a time (s).
    #[must_use]
    pub fn velocity(&self, time: f64) -> f64 {
        let s = time - self.centre;
        if s.abs() > self.half_length() {
            return 0.0;
        }
        let x = TAU * self.frequency * s;
        0.5 * self.amplitude * (1.0 + libm::cos(x / self.oscillation)) * libm::cos(x + self.phase)
    }

    /// Ground acceleration (m/s2) at a time (s).
    #[must_use]
    pub fn acceleration(&self, time: f64) -> f64 {
        let s = time - self.centre;
        if s.abs() > self.half_length() {
            return 0.0;
        }
        let (x, gamma) = (TAU * self.frequency * s, self.oscillation);
        -self.amplitude * PI * self.frequency / gamma
            * (libm::sin(x / gamma) * libm::cos(x + self.phase)
                + gamma * libm::sin(x + self.phase) * (1.0 + libm::cos(x / gamma)))
    }

    /// Displacement (m) that remains.
    #[must_use]
    pub fn net_displacement(&self) -> f64 {
        let gamma = self.oscillation;
        self.amplitude * libm::cos(self.phase) * libm::sin(PI * gamma)
            / (TAU * self.frequency * (1.0 - gamma * gamma))
    }

    fn half_length(&self) -> f64 {
        0.5 * self.oscillation / self.frequency
    }

    /// The motion.
    ///
    /// # Errors
    /// Numbers out of range, a frequency from half the sampling rate on, or a pulse that does not fit into the duration.
    pub fn generate(&self, grid: TimeGrid) -> Result<Generated, GroundMotionError> {
        positive(STEP, "amplitude", self.amplitude)?;
        let step = grid.record(STEP, self.frequency)?;
        if !(self.oscillation > 1.0 && self.oscillation <= 1.0e3) {
            return Err(GroundMotionError::OutOfRange {
                step: STEP,
                name: "gamma",
                value: self.oscillation,
                range: "(1, 1000]".to_owned(),
            });
        }
        within(STEP, "phase", self.phase, -TAU, TAU)?;
        grid.has_room_around(STEP, self.centre, self.half_length())?;
        let step = step
            .number("velocity amplitude", self.amplitude, "m/s")
            .number("frequency", self.frequency, "Hz")
            .number("gamma", self.oscillation, "-")
            .number("phase", self.phase, "rad")
            .number("centre", self.centre, "s")
            .number("net displacement", self.net_displacement(), "m");
        grid.finish(grid.sample(|t| self.acceleration(t))?, step)
    }
}
