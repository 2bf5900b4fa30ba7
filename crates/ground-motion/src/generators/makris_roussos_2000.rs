//! Makris and Roussos (2000), Géotechnique 50 (3) 243: trigonometric pulses of
//! near-fault motions.

use std::f64::consts::{PI, TAU};
use std::fmt;

use crate::error::{GroundMotionError, positive, within};
use crate::generators::{Generated, Generator, TimeGrid};
use crate::spectra::zero;

const STEP: &str = MakrisRoussos2000::GENERATOR.name;

/// The shape of a pulse.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PulseType {
    /// One-sided velocity, the ground is displaced: `a = w v/2 sin w t`, one period.
    A,
    /// One cycle of velocity, the displacement returns: `a = w v cos w t`, one period.
    B,
    /// `n` and a half cycles of acceleration, velocity and displacement return:
    /// `a = w v cos(w t + phi)` up to `(n + 1/2 - phi/pi) T`.
    C {
        /// Number n of cycles, 1 to 20.
        cycles: u32,
    },
}

impl fmt::Display for PulseType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::A => f.write_str("A"),
            Self::B => f.write_str("B"),
            Self::C { cycles } => write!(f, "C, {cycles} cycles"),
        }
    }
}

/// A pulse with its velocity amplitude and period.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MakrisRoussos2000 {
    /// Shape.
    pub pulse: PulseType,
    /// Amplitude v of the velocity (m/s).
    pub amplitude: f64,
    /// Period T (s).
    pub period: f64,
    /// Time at which the pulse starts (s).
    pub start: f64,
}

/// The phase of type C, at which no displacement remains: `cos((2n+1) pi - phi)
/// + ((2n+1) pi - 2 phi) sin phi - cos phi = 0`.
fn phase(cycles: u32) -> f64 {
    let half_turns = f64::from(2 * cycles + 1) * PI;
    let remains = |phi: f64| (half_turns - 2.0 * phi) * libm::sin(phi) - 2.0 * libm::cos(phi);
    let (low, high) = (0.0, PI / 4.0);
    zero(low, high, remains(low), remains(high), 1.0e-16, remains)
}

impl MakrisRoussos2000 {
    /// Name, title and source.
    pub const GENERATOR: Generator = Generator {
        name: "makris_roussos_2000",
        title: "Trigonometric pulses of type A, B and C",
        source: "Makris and Roussos, Géotechnique 50 (2000) 243",
    };

    /// Length of the pulse (s).
    #[must_use]
    pub fn length(&self) -> f64 {
        match self.pulse {
            PulseType::A | PulseType::B => self.period,
            PulseType::C { cycles } => (f64::from(cycles) + 0.5 - phase(cycles) / PI) * self.period,
        }
    }

    /// The motion.
    ///
    /// # Errors
    /// Numbers out of range, a period of two time steps or less, or a pulse that does not fit into the duration.
    pub fn generate(&self, grid: TimeGrid) -> Result<Generated, GroundMotionError> {
        positive(STEP, "amplitude", self.amplitude)?;
        positive(STEP, "period", self.period)?;
        let step = grid.record(STEP, 1.0 / self.period)?;
        if let PulseType::C { cycles } = self.pulse {
            within(STEP, "number of cycles", f64::from(cycles), 1.0, 20.0)?;
        }
        let length = self.length();
        grid.has_room_for(STEP, length)?;
        // A pulse may end with the motion, whose duration is a sum of rounded numbers.
        let latest = grid.duration - length + 1.0e-9 * length;
        within(STEP, "start", self.start, 0.0, latest)?;
        let w = TAU / self.period;
        let phi = match self.pulse {
            PulseType::C { cycles } => phase(cycles),
            PulseType::A | PulseType::B => 0.0,
        };
        let samples = grid.sample_between((self.start, self.start + length), |t| {
            let angle = w * (t - self.start);
            let value = match self.pulse {
                PulseType::A => 0.5 * libm::sin(angle),
                PulseType::B | PulseType::C { .. } => libm::cos(angle + phi),
            };
            self.amplitude * w * value
        })?;
        let step = step
            .number("velocity amplitude", self.amplitude, "m/s")
            .number("period", self.period, "s")
            .number("start", self.start, "s")
            .number("length", length, "s")
            .number("phase", phi, "rad")
            .remark(format!("type {}", self.pulse));
        grid.finish(samples, step)
    }
}
