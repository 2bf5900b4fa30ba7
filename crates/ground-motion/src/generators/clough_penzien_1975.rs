//! Clough and Penzien (1975), Dynamics of Structures, 26-2: the spectrum of Kanai and
//! Tajimi without the displacements that grow for ever.

use std::f64::consts::{PI, TAU};

use crate::error::{GroundMotionError, positive, within};
use crate::generators::random_phases::intensity_for_peak;
use crate::generators::{Generator, KanaiTajimi1960, PowerSpectrum};
use crate::step_record::StepRecord;

const STEP: &str = CloughPenzien1975::GENERATOR.name;

/// `S = S_KT w^4/((wf^2 - w^2)^2 + 4 zf^2 wf^2 w^2)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CloughPenzien1975 {
    /// The spectrum of Kanai and Tajimi.
    pub ground: KanaiTajimi1960,
    /// Frequency wf of the second filter (rad/s).
    pub filter_frequency: f64,
    /// Damping ratio zf of the second filter (-).
    pub filter_damping: f64,
}

impl CloughPenzien1975 {
    /// Name, title and source.
    pub const GENERATOR: Generator = Generator {
        name: "clough_penzien_1975",
        title: "Kanai-Tajimi noise without displacements that grow for ever",
        source: "Clough and Penzien, Dynamics of Structures (1975), 26-2",
    };

    /// Firm, medium or soft ground of an intensity S0 (m2/s3): Der Kiureghian and
    /// Neuenhofer (1992), Earthq. Eng. Struct. Dyn. 21, 713 (values unverified).
    #[must_use]
    pub fn of_ground(kind: &str, intensity: f64) -> Option<Self> {
        let (ground_frequency, ground_damping, filter_frequency) = match kind {
            "firm" => (15.0, 0.6, 1.5),
            "medium" => (10.0, 0.4, 1.0),
            "soft" => (5.0, 0.2, 0.5),
            _ => return None,
        };
        Some(Self {
            ground: KanaiTajimi1960 {
                intensity,
                ground_frequency,
                ground_damping,
            },
            filter_frequency,
            filter_damping: 0.6,
        })
    }
}

impl CloughPenzien1975 {
    /// The spectrum whose standard deviation, after both filters, is a peak acceleration (m/s2)
    /// over a peak factor, 2.8 to 3.2. The intensity of `ground` is not looked at.
    ///
    /// # Errors
    /// Numbers that are not positive, or damping ratios out of range.
    pub fn for_peak(
        peak_acceleration: f64,
        peak_factor: f64,
        ground: KanaiTajimi1960,
        filter_frequency: f64,
        filter_damping: f64,
    ) -> Result<Self, GroundMotionError> {
        let mut spectrum = Self {
            ground: KanaiTajimi1960 {
                intensity: 1.0,
                ..ground
            },
            filter_frequency,
            filter_damping,
        };
        spectrum.describe()?;
        spectrum.ground.intensity =
            intensity_for_peak(STEP, peak_acceleration, peak_factor, spectrum.variance())?;
        Ok(spectrum)
    }

    /// Variance (m2/s4) after both filters: the integral of `S0 |H(i w)|^2` with
    /// `H(s) = (b3 s^3 + b2 s^2)/(s^4 + a3 s^3 + a2 s^2 + a1 s + a0)` in closed form, as James,
    /// Nichols and Phillips (1947), Theory of Servomechanisms, tabulate it:
    /// `pi S0 (b3^2 (a1 a2 - a0 a3) + b2^2 a1)/(a1 a2 a3 - a0 a3^2 - a1^2)`.
    #[must_use]
    pub fn variance(&self) -> f64 {
        let (wg, wf) = (self.ground.ground_frequency, self.filter_frequency);
        let (cg, cf) = (
            2.0 * self.ground.ground_damping * wg,
            2.0 * self.filter_damping * wf,
        );
        let (g2, f2) = (wg * wg, wf * wf);
        let (a0, a1, a2, a3) = (g2 * f2, cg * f2 + cf * g2, g2 + f2 + cg * cf, cg + cf);
        let above = cg * cg * (a1 * a2 - a0 * a3) + g2 * g2 * a1;
        PI * self.ground.intensity * above / (a1 * a2 * a3 - a0 * a3 * a3 - a1 * a1)
    }
}

impl PowerSpectrum for CloughPenzien1975 {
    fn density(&self, frequency: f64) -> f64 {
        let (w2, f2) = (frequency.powi(2), self.filter_frequency.powi(2));
        let damping = 4.0 * self.filter_damping.powi(2) * f2 * w2;
        self.ground.density(frequency) * w2 * w2 / ((f2 - w2).powi(2) + damping)
    }

    fn generator(&self) -> &'static Generator {
        &Self::GENERATOR
    }

    fn main_frequency(&self) -> f64 {
        self.ground.main_frequency()
    }

    fn describe(&self) -> Result<StepRecord, GroundMotionError> {
        positive(STEP, "filter frequency", self.filter_frequency)?;
        within(STEP, "filter damping", self.filter_damping, 1.0e-3, 10.0)?;
        let step = self.ground.described_as(STEP)?;
        Ok(step
            .number("filter frequency", self.filter_frequency, "rad/s")
            .number("filter frequency in Hz", self.filter_frequency / TAU, "Hz")
            .number("filter damping", self.filter_damping, "-")
            .number("variance of the spectrum", self.variance(), "m2/s4"))
    }
}
