//! Whether the mean spectrum of a suite reaches what a code asks of it.

use pounding_case::{Case, SpectrumSource};
use pounding_ground_motion::spectra::USUAL_DAMPING;
use pounding_ground_motion::spectra::design::{CodeSpectrum, Eurocode8Of2004};
use pounding_separation::SpectrumCondition;

use super::SAME;
use super::band_extremes::Band;
use super::error::CheckError;
use super::record_spectra::wrong;
use super::records::CaseUnderRecord;

/// The spectra of a suite beside that of the code that is asked.
#[derive(Debug, Clone, PartialEq)]
pub enum SuiteSpectrum {
    /// Nothing is known here of what the code asks.
    NotKnown,
    /// The case does not scale its records to the spectrum of the code, whose parameters are
    /// not known then.
    NotCompared {
        /// What the code asks.
        condition: SpectrumCondition,
        /// Name of the spectrum of another code to which it scales.
        scaled_to: Option<&'static str>,
    },
    /// How the mean of the suite compares.
    Compared(MeanSpectrum),
}

/// The mean spectrum of a suite over that of a code.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeanSpectrum {
    /// What the code asks.
    pub condition: SpectrumCondition,
    /// The periods (s) at which it asks it, within the range of its spectrum.
    pub band: (f64, f64),
    /// The least ratio there (-), also between periods of any grid, with its period (s).
    pub least: (f64, f64),
    /// The mean peak ground acceleration over the spectrum at zero period (-), where the code asks
    /// for it.
    pub zero_period: Option<f64>,
}

impl MeanSpectrum {
    /// The least factor (-) on all records with which the suite is what the code asks for: not
    /// above one where it is.
    #[must_use]
    pub fn factor(&self) -> f64 {
        let in_band = self.condition.at_least / self.least.0;
        let at_zero = self.zero_period.map_or(0.0, f64::recip);
        in_band.max(at_zero)
    }

    /// Whether the suite is what the code asks for.
    #[must_use]
    pub fn is_reached(&self) -> bool {
        self.factor() <= 1.0 + SAME
    }
}

impl SuiteSpectrum {
    /// Whether the suite is known not to be what the code asks for.
    #[must_use]
    pub fn is_below(&self) -> bool {
        matches!(self, Self::Compared(mean) if !mean.is_reached())
    }

    /// Compares the records of a check with the spectrum to which their case scales them.
    pub(super) fn of(
        case: &Case,
        records: &[CaseUnderRecord],
        condition: Option<SpectrumCondition>,
        threads: usize,
    ) -> Result<Self, CheckError> {
        let (Some(condition), Some(first)) = (condition, records.first()) else {
            return Ok(Self::NotKnown);
        };
        let scale = case.ground_motion.scale.as_ref();
        let code = match scale.and_then(|s| s.value.target()).map(|b| &b.spectrum) {
            Some(SpectrumSource::Code(code)) => Some(code.value),
            _ => None,
        };
        let Some(spectrum) = code.filter(|c| c.name() == condition.spectrum) else {
            let scaled_to = code.map(|c| c.name());
            return Ok(Self::NotCompared {
                condition,
                scaled_to,
            });
        };
        let spectrum = match spectrum {
            CodeSpectrum::Eurocode8Of2004(of) => CodeSpectrum::Eurocode8Of2004(Eurocode8Of2004 {
                damping: USUAL_DAMPING,
                ..of
            }),
            other => other,
        };
        let range = spectrum.target().map_err(wrong(first))?.range();
        let buildings = first.assembly.system.buildings().iter();
        let fundamental = buildings.map(|b| b.modes().period[b.fundamental_mode()]);
        let (shortest, longest) = fundamental.fold((f64::INFINITY, 0.0_f64), |(low, high), t| {
            (low.min(t), high.max(t))
        });
        let from = (condition.band.0 * shortest).clamp(range.0, range.1);
        let to = (condition.band.1 * longest).clamp(range.0, range.1);
        let band = Band {
            ends: (from, to),
            damping: USUAL_DAMPING,
        };
        let (least, _) = band.extremes(records, |t| Some(spectrum.acceleration(t)), threads)?;
        let peaks = records.iter().map(|r| r.assembly.accelerogram.peak().value);
        let mean_peak = peaks.sum::<f64>() / records.len() as f64;
        Ok(Self::Compared(MeanSpectrum {
            condition,
            band: (from, to),
            least,
            zero_period: condition
                .zero_period
                .then(|| mean_peak / spectrum.acceleration(0.0)),
        }))
    }
}
