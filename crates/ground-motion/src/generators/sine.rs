//! Sines with an envelope.

use std::f64::consts::TAU;

use crate::error::{GroundMotionError, positive, within};
use crate::generators::{Envelope, Generated, Generator, TimeGrid};

const STEP: &str = Sine::GENERATOR.name;

/// `A e(t) sin(2 pi f t + phase)` up to a length, zero after it. A jump there is passed in the middle
/// of its step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sine {
    /// Amplitude (m/s2).
    pub amplitude: f64,
    /// Frequency (Hz).
    pub frequency: f64,
    /// Phase (rad).
    pub phase: f64,
    /// Length (s): half a period for a half-sine pulse.
    pub length: f64,
    /// Envelope over that length.
    pub envelope: Envelope,
}

impl Sine {
    /// Name, title and source.
    pub const GENERATOR: Generator = Generator {
        name: "sine",
        title: "A sine with an envelope",
        source: "closed form",
    };

    /// The motion.
    ///
    /// # Errors
    /// Amplitude, frequency or length that are not positive, a phase beyond a turn, an envelope that does not fit the length, or a
    /// frequency from half the sampling rate on.
    pub fn generate(&self, grid: TimeGrid) -> Result<Generated, GroundMotionError> {
        positive(STEP, "amplitude", self.amplitude)?;
        positive(STEP, "length", self.length)?;
        within(STEP, "phase", self.phase, -TAU, TAU)?;
        let step = grid.record(STEP, self.frequency)?;
        self.envelope.check(self.length)?;
        let samples = grid.sample_between((0.0, self.length), |t| {
            self.amplitude
                * self.envelope.at(t, self.length)
                * libm::sin(TAU * self.frequency * t + self.phase)
        })?;
        let step = step
            .number("amplitude", self.amplitude, "m/s2")
            .number("frequency", self.frequency, "Hz")
            .number("phase", self.phase, "rad")
            .number("length", self.length, "s")
            .remark(format!("envelope {}", self.envelope));
        grid.finish(samples, step)
    }
}
