//! EN 1998-1:2004, 3.2.2.2: horizontal elastic response spectrum with the recommended
//! parameters of tables 3.2 and 3.3. National annexes may differ.

use crate::error::{GroundMotionError, positive, within};
use crate::spectra::TargetSpectrum;
use crate::spectra::design::through;

const STEP: &str = "eurocode_8_2004";
/// First and last period (s): the code's spectrum ends at 4 s.
const FIRST: f64 = 0.01;
const LAST: f64 = 4.0;
/// Least damping correction (eq. 3.6).
const LEAST_CORRECTION: f64 = 0.55;

/// Ground type of table 3.1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GroundType {
    /// Rock.
    A,
    /// Very dense sand or gravel, very stiff clay.
    B,
    /// Dense or medium-dense sand, stiff clay.
    C,
    /// Loose soil, soft clay.
    D,
    /// Up to 20 m of C or D over rock.
    E,
}

impl GroundType {
    /// Its letter in table 3.1.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::A => "A",
            Self::B => "B",
            Self::C => "C",
            Self::D => "D",
            Self::E => "E",
        }
    }
}

/// Shape of the spectrum.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SpectrumType {
    /// Surface-wave magnitudes above 5.5.
    Type1,
    /// Surface-wave magnitudes of 5.5 and less.
    Type2,
}

impl SpectrumType {
    /// Its number.
    #[must_use]
    pub fn number(self) -> u8 {
        match self {
            Self::Type1 => 1,
            Self::Type2 => 2,
        }
    }
}

/// An elastic spectrum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Eurocode8Of2004 {
    /// Design ground acceleration on type A ground, ag (m/s2).
    pub ground_acceleration: f64,
    /// Ground type.
    pub ground: GroundType,
    /// Type of the spectrum.
    pub spectrum: SpectrumType,
    /// Damping ratio (-).
    pub damping: f64,
}

impl Eurocode8Of2004 {
    /// S, TB, TC and TD (s): tables 3.2 and 3.3.
    #[must_use]
    pub fn parameters(&self) -> [f64; 4] {
        match (self.spectrum, self.ground) {
            (SpectrumType::Type1, GroundType::A) => [1.0, 0.15, 0.4, 2.0],
            (SpectrumType::Type1, GroundType::B) => [1.2, 0.15, 0.5, 2.0],
            (SpectrumType::Type1, GroundType::C) => [1.15, 0.2, 0.6, 2.0],
            (SpectrumType::Type1, GroundType::D) => [1.35, 0.2, 0.8, 2.0],
            (SpectrumType::Type1, GroundType::E) => [1.4, 0.15, 0.5, 2.0],
            (SpectrumType::Type2, GroundType::A) => [1.0, 0.05, 0.25, 1.2],
            (SpectrumType::Type2, GroundType::B) => [1.35, 0.05, 0.25, 1.2],
            (SpectrumType::Type2, GroundType::C) => [1.5, 0.1, 0.25, 1.2],
            (SpectrumType::Type2, GroundType::D) => [1.8, 0.1, 0.3, 1.2],
            (SpectrumType::Type2, GroundType::E) => [1.6, 0.05, 0.25, 1.2],
        }
    }

    /// Elastic acceleration Se (m/s2) at a period (s): equations 3.2 to 3.5.
    #[must_use]
    pub fn acceleration(&self, period: f64) -> f64 {
        let [s, b, c, d] = self.parameters();
        let correction = (10.0 / (5.0 + 100.0 * self.damping))
            .sqrt()
            .max(LEAST_CORRECTION);
        let (ground, plateau) = (self.ground_acceleration * s, 2.5 * correction);
        if period < b {
            ground * (1.0 + period / b * (plateau - 1.0))
        } else if period <= c {
            ground * plateau
        } else if period <= d {
            ground * plateau * c / period
        } else {
            ground * plateau * c * d / (period * period)
        }
    }

    /// The spectrum from 0.01 to 4 s as a target.
    ///
    /// # Errors
    /// An acceleration that is not positive, or a damping ratio outside [0, 0.3].
    pub fn target(&self) -> Result<TargetSpectrum, GroundMotionError> {
        positive(STEP, "ground acceleration", self.ground_acceleration)?;
        within(STEP, "damping ratio", self.damping, 0.0, 0.3)?;
        let [_, b, c, d] = self.parameters();
        through(&[FIRST, b, c, d, LAST], self.damping, |t| {
            self.acceleration(t)
        })
    }
}
