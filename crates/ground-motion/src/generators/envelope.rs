//! Envelopes of amplitude over time, maximum value one.

use std::f64::consts::PI;
use std::fmt;

use serde::Serialize;

use crate::error::{GroundMotionError, bound, positive, within};

/// An envelope.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub enum Envelope {
    /// One throughout.
    Constant,
    /// Half a sine over the duration.
    HalfSine,
    /// Up in a line, one, down in a line to the end of the duration.
    Ramped {
        /// Time up (s).
        rise: f64,
        /// Time down (s).
        fall: f64,
    },
    /// `exp(-rate t)`.
    Decay {
        /// Rate (1/s).
        rate: f64,
    },
    /// `(t/rise)^2`, one up to `strong_end`, `exp(-decay (t - strong_end))`: Jennings,
    /// Housner and Tsai (1968), Caltech EERL. Type B: 4 s, 15 s, 0.0992 1/s.
    JenningsHousnerTsai1968 {
        /// End of the rise (s).
        rise: f64,
        /// End of the strong part (s).
        strong_end: f64,
        /// Rate of decay after it (1/s).
        decay: f64,
    },
    /// `t^power exp(-rate t)` over its maximum value: Saragoni and Hart (1974),
    /// Earthq. Eng. Struct. Dyn. 2, 249.
    SaragoniHart1974 {
        /// Power (-).
        power: f64,
        /// Rate (1/s).
        rate: f64,
    },
    /// `exp(-slow t) - exp(-fast t)` over its maximum value: Shinozuka and Sato
    /// (1967), J. Eng. Mech. 93, 11.
    ShinozukaSato1967 {
        /// Slower rate (1/s).
        slow: f64,
        /// Faster rate (1/s).
        fast: f64,
    },
}

impl fmt::Display for Envelope {
    /// Its name and numbers, as they are written for `motion synth`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Constant => f.write_str("constant"),
            Self::HalfSine => f.write_str("half_sine"),
            Self::Ramped { rise, fall } => write!(f, "ramped, rise {rise} s, fall {fall} s"),
            Self::Decay { rate } => write!(f, "decay, rate {rate} 1/s"),
            Self::JenningsHousnerTsai1968 {
                rise,
                strong_end,
                decay,
            } => write!(
                f,
                "jennings_housner_tsai_1968, rise {rise} s, strong end {strong_end} s, decay {decay} 1/s"
            ),
            Self::SaragoniHart1974 { power, rate } => {
                write!(f, "saragoni_hart_1974, power {power}, rate {rate} 1/s")
            }
            Self::ShinozukaSato1967 { slow, fast } => {
                write!(f, "shinozuka_sato_1967, slow {slow} 1/s, fast {fast} 1/s")
            }
        }
    }
}

impl Envelope {
    /// Refuses numbers out of range, for a motion of this duration (s).
    pub(crate) fn check(&self, duration: f64) -> Result<(), GroundMotionError> {
        const STEP: &str = "envelope";
        match *self {
            Self::Constant | Self::HalfSine => {}
            Self::Ramped { rise, fall } => {
                within(STEP, "rise", rise, 0.0, f64::MAX)?;
                within(STEP, "fall", fall, 0.0, f64::MAX)?;
                if rise + fall > duration * (1.0 + 1.0e-9) {
                    return Err(GroundMotionError::NotPossible {
                        step: STEP,
                        reason: format!(
                            "a rise of {rise} s and a fall of {fall} s do not fit into {} s: it would never reach one",
                            bound(duration)
                        ),
                        remedy: "shorten rise and fall, or give the motion a longer duration",
                    });
                }
            }
            Self::Decay { rate } => {
                positive(STEP, "rate", rate)?;
            }
            Self::JenningsHousnerTsai1968 {
                rise,
                strong_end,
                decay,
            } => {
                positive(STEP, "rise", rise)?;
                within(STEP, "end of the strong part", strong_end, rise, f64::MAX)?;
                positive(STEP, "decay", decay)?;
            }
            Self::SaragoniHart1974 { power, rate } => {
                positive(STEP, "power", power)?;
                positive(STEP, "rate", rate)?;
            }
            Self::ShinozukaSato1967 { slow, fast } => {
                positive(STEP, "slower rate", slow)?;
                if !(fast > slow && fast <= f64::MAX) {
                    return Err(GroundMotionError::OutOfRange {
                        step: STEP,
                        name: "faster rate",
                        value: fast,
                        range: format!("({}, inf)", bound(slow)),
                    });
                }
            }
        }
        let one = self.first_one(duration);
        if one > duration * (1.0 + 1.0e-9) {
            return Err(GroundMotionError::NotPossible {
                step: STEP,
                reason: format!(
                    "it reaches one at {} s, after the end of the motion at {} s: the motion would be weaker than asked for",
                    bound(one),
                    bound(duration)
                ),
                remedy: "give an envelope that rises sooner, or the motion a longer duration",
            });
        }
        Ok(())
    }

    /// The time (s) at which it is one for the first time, in a motion of a duration (s) that is
    /// long enough.
    fn first_one(&self, duration: f64) -> f64 {
        match *self {
            Self::Constant | Self::Decay { .. } => 0.0,
            Self::HalfSine => 0.5 * duration,
            Self::Ramped { rise, .. } | Self::JenningsHousnerTsai1968 { rise, .. } => rise,
            Self::SaragoniHart1974 { power, rate } => power / rate,
            // Rates that are nearly one have their difference to full precision.
            Self::ShinozukaSato1967 { slow, fast } => {
                libm::log1p((fast - slow) / slow) / (fast - slow)
            }
        }
    }

    /// The value at a time (s) of a motion of a duration (s).
    #[must_use]
    pub fn at(&self, time: f64, duration: f64) -> f64 {
        if time < 0.0 || time > duration * (1.0 + 1.0e-12) {
            return 0.0;
        }
        match *self {
            Self::Constant => 1.0,
            Self::HalfSine => libm::sin(PI * time / duration),
            Self::Ramped { rise, fall } => {
                let up = if time < rise { time / rise } else { 1.0 };
                let left = (duration - time).max(0.0);
                let down = if left < fall { left / fall } else { 1.0 };
                up.min(down)
            }
            Self::Decay { rate } => libm::exp(-rate * time),
            Self::JenningsHousnerTsai1968 {
                rise,
                strong_end,
                decay,
            } => {
                if time < rise {
                    (time / rise).powi(2)
                } else {
                    libm::exp(-decay * (time - strong_end).max(0.0))
                }
            }
            Self::SaragoniHart1974 { power, rate } => {
                let part = rate * time / power;
                libm::exp(power * (libm::log(part) + 1.0 - part))
            }
            Self::ShinozukaSato1967 { slow, fast } => {
                let value = |t: f64| -libm::exp(-slow * t) * libm::expm1(-(fast - slow) * t);
                value(time) / value(self.first_one(duration))
            }
        }
    }
}
