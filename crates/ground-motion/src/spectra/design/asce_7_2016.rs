//! ASCE/SEI 7-16, 11.4.6: design response spectrum, 5 % damping.

use crate::error::{GroundMotionError, positive, within};
use crate::spectra::TargetSpectrum;
use crate::spectra::design::through;

const STEP: &str = "asce_7_2016";
const FIRST: f64 = 0.01;
const LAST: f64 = 10.0;
/// A design spectrum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Asce7Of2016 {
    /// SDS (m/s2), at short periods.
    pub short_period: f64,
    /// SD1 (m/s2), at one second.
    pub one_second: f64,
    /// Long-period transition TL (s), 4 to 16.
    pub long_transition: f64,
}

impl Asce7Of2016 {
    /// The damping ratio that the code's values are for (-).
    pub const DAMPING: f64 = 0.05;

    /// TS = SD1/SDS (s).
    #[must_use]
    pub fn transition(&self) -> f64 {
        self.one_second / self.short_period
    }

    /// Design acceleration Sa (m/s2) at a period (s): equations 11.4-5 to 11.4-7.
    #[must_use]
    pub fn acceleration(&self, period: f64) -> f64 {
        let corner = self.transition();
        if period < 0.2 * corner {
            self.short_period * (0.4 + 0.6 * period / (0.2 * corner))
        } else if period <= corner {
            self.short_period
        } else if period <= self.long_transition {
            self.one_second / period
        } else {
            self.one_second * self.long_transition / (period * period)
        }
    }

    /// The spectrum from 0.01 to 10 s as a target.
    ///
    /// # Errors
    /// Accelerations that are not positive, TS outside 0.1 to 2 s, or TL outside 4 to 16 s.
    pub fn target(&self) -> Result<TargetSpectrum, GroundMotionError> {
        positive(STEP, "SDS", self.short_period)?;
        positive(STEP, "SD1", self.one_second)?;
        within(STEP, "TS = SD1/SDS", self.transition(), 0.1, 2.0)?;
        within(STEP, "TL", self.long_transition, 4.0, 16.0)?;
        let corner = self.transition();
        let corners = [
            FIRST,
            0.2 * corner,
            corner,
            self.long_transition.min(LAST),
            LAST,
        ];
        through(&corners, Self::DAMPING, |t| self.acceleration(t))
    }
}
