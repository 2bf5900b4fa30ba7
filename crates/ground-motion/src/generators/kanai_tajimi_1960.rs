//! Tajimi (1960), Proc. 2nd World Conf. Earthq. Eng. 2, 781, after Kanai (1957): white
//! noise of the rock through one layer of ground.

use std::f64::consts::{PI, TAU};

use crate::error::{GroundMotionError, positive, within};
use crate::generators::random_phases::intensity_for_peak;
use crate::generators::{Generator, PowerSpectrum};
use crate::step_record::StepRecord;

const STEP: &str = KanaiTajimi1960::GENERATOR.name;

/// `S = S0 (wg^4 + 4 zg^2 wg^2 w^2)/((wg^2 - w^2)^2 + 4 zg^2 wg^2 w^2)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KanaiTajimi1960 {
    /// S0 (m2/s3), two-sided.
    pub intensity: f64,
    /// Frequency wg of the ground (rad/s); 15.6 is Kanai's firm ground.
    pub ground_frequency: f64,
    /// Damping ratio zg of the ground (-); 0.6 is Kanai's firm ground.
    pub ground_damping: f64,
}

impl KanaiTajimi1960 {
    /// Name, title and source.
    pub const GENERATOR: Generator = Generator {
        name: "kanai_tajimi_1960",
        title: "White noise through one layer of ground, under an envelope",
        source: "Tajimi, 2nd World Conference on Earthquake Engineering 2 (1960) 781, after Kanai 1957",
    };

    /// The spectrum whose standard deviation is a peak acceleration (m/s2) over a peak
    /// factor, 2.8 to 3.2.
    ///
    /// # Errors
    /// Numbers that are not positive.
    pub fn for_peak(
        peak_acceleration: f64,
        peak_factor: f64,
        ground_frequency: f64,
        ground_damping: f64,
    ) -> Result<Self, GroundMotionError> {
        let mut spectrum = Self {
            intensity: 1.0,
            ground_frequency,
            ground_damping,
        };
        spectrum.describe()?;
        spectrum.intensity =
            intensity_for_peak(STEP, peak_acceleration, peak_factor, spectrum.variance())?;
        Ok(spectrum)
    }

    /// Intensity, frequency and damping ratio, for a generator that filters the ground's motion.
    pub(crate) fn described_as(
        &self,
        generator: &'static str,
    ) -> Result<StepRecord, GroundMotionError> {
        positive(generator, "intensity", self.intensity)?;
        positive(generator, "ground frequency", self.ground_frequency)?;
        within(
            generator,
            "ground damping",
            self.ground_damping,
            1.0e-3,
            10.0,
        )?;
        Ok(StepRecord::new(generator)
            .number("intensity S0", self.intensity, "m2/s3")
            .number("ground frequency", self.ground_frequency, "rad/s")
            .number("ground frequency in Hz", self.ground_frequency / TAU, "Hz")
            .number("ground damping", self.ground_damping, "-"))
    }

    /// Variance (m2/s4): `pi S0 wg (1/(2 zg) + 2 zg)`.
    #[must_use]
    pub fn variance(&self) -> f64 {
        PI * self.intensity
            * self.ground_frequency
            * (0.5 / self.ground_damping + 2.0 * self.ground_damping)
    }
}

impl PowerSpectrum for KanaiTajimi1960 {
    fn density(&self, frequency: f64) -> f64 {
        let (w2, g2) = (frequency.powi(2), self.ground_frequency.powi(2));
        let damping = 4.0 * self.ground_damping.powi(2) * g2 * w2;
        self.intensity * (g2 * g2 + damping) / ((g2 - w2).powi(2) + damping)
    }

    fn generator(&self) -> &'static Generator {
        &Self::GENERATOR
    }

    fn main_frequency(&self) -> f64 {
        self.ground_frequency
    }

    fn describe(&self) -> Result<StepRecord, GroundMotionError> {
        let step = self.described_as(STEP)?;
        Ok(step.number("variance of the spectrum", self.variance(), "m2/s4"))
    }
}
