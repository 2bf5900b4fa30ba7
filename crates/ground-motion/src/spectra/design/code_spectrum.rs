//! The spectrum of any code.

use pounding_catalogue::STANDARD_GRAVITY as G;
use pounding_catalogue::numbers::six_digits;

use crate::error::{GroundMotionError, within};
use crate::spectra::TargetSpectrum;
use crate::spectra::design::{Asce7Of2016, Eurocode8Of2004};

/// The elastic spectrum of a code.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CodeSpectrum {
    /// EN 1998-1:2004, 3.2.2.2.
    Eurocode8Of2004(Eurocode8Of2004),
    /// ASCE/SEI 7-16, 11.4.6.
    Asce7Of2016(Asce7Of2016),
}

impl CodeSpectrum {
    /// Name of the code in cases and arguments.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Eurocode8Of2004(_) => "eurocode_8_2004",
            Self::Asce7Of2016(_) => "asce_7_2016",
        }
    }

    /// Code with its clause.
    #[must_use]
    pub fn clause(&self) -> &'static str {
        match self {
            Self::Eurocode8Of2004(_) => "EN 1998-1:2004, 3.2.2.2",
            Self::Asce7Of2016(_) => "ASCE/SEI 7-16, 11.4.6",
        }
    }

    /// What the first and the last period of a suite are of the smallest and the greatest
    /// fundamental period of the structures (-), and the clause that says it.
    #[must_use]
    pub fn band(&self) -> ((f64, f64), &'static str) {
        match self {
            Self::Eurocode8Of2004(_) => ((0.2, 2.0), "EN 1998-1:2004, 3.2.3.1.2(4)c"),
            Self::Asce7Of2016(_) => ((0.2, 2.0), "ASCE/SEI 7-16, 16.2.3.1"),
        }
    }

    /// Damping ratio that the values are for (-).
    #[must_use]
    pub fn damping(&self) -> f64 {
        match self {
            Self::Eurocode8Of2004(spectrum) => spectrum.damping,
            Self::Asce7Of2016(_) => Asce7Of2016::DAMPING,
        }
    }

    /// Acceleration (m/s2) at a period (s).
    #[must_use]
    pub fn acceleration(&self, period: f64) -> f64 {
        match self {
            Self::Eurocode8Of2004(spectrum) => spectrum.acceleration(period),
            Self::Asce7Of2016(spectrum) => spectrum.acceleration(period),
        }
    }

    /// Name, parameters and damping, for people.
    #[must_use]
    pub fn title(&self) -> String {
        let g = |a: f64| six_digits(a / G);
        let parameters = match self {
            Self::Eurocode8Of2004(s) => format!(
                "ag {} g, ground type {}, type {}",
                g(s.ground_acceleration),
                s.ground.name(),
                s.spectrum.number()
            ),
            Self::Asce7Of2016(s) => format!(
                "S_DS {} g, S_D1 {} g, T_L {} s",
                g(s.short_period),
                g(s.one_second),
                six_digits(s.long_transition)
            ),
        };
        format!(
            "{}, {parameters}, {} % damping",
            self.name(),
            six_digits(100.0 * self.damping())
        )
    }

    /// Periods (s) at which its formula changes, within its range.
    #[must_use]
    pub fn corners(&self) -> Vec<f64> {
        match self {
            Self::Eurocode8Of2004(s) => s.parameters()[1..].to_vec(),
            Self::Asce7Of2016(s) => {
                vec![0.2 * s.transition(), s.transition(), s.long_transition]
            }
        }
    }

    /// The spectrum as a target, which has its title.
    ///
    /// # Errors
    /// Parameters out of range, or a damping ratio that the code has no values for.
    pub fn target(&self) -> Result<TargetSpectrum, GroundMotionError> {
        let target = match self {
            Self::Eurocode8Of2004(spectrum) => spectrum.target(),
            Self::Asce7Of2016(spectrum) => spectrum.target(),
        };
        Ok(target?.named(self.title()))
    }

    /// Refuses periods (s) beyond the code's range.
    ///
    /// # Errors
    /// As [`Self::target`], and a period outside its range.
    pub fn check_periods(&self, periods: &[f64]) -> Result<(), GroundMotionError> {
        let (from, to) = self.target()?.range();
        // The last first, and the first: ends of a band are what was asked for.
        let mut ends_first = periods.last().into_iter().chain(periods);
        ends_first.try_for_each(|t| within(self.name(), "period", *t, from, to).map(|_| ()))
    }
}
