//! Scale factors.

use serde::Serialize;

use crate::accelerogram::Accelerogram;
use crate::error::{GroundMotionError, positive, within};
use crate::measures::GroundMotion;
use crate::spectra::{Evaluation, TargetSpectrum, logarithmic_periods, response_spectrum};
use crate::step_record::StepRecord;

const STEP: &str = "scale";
/// Periods of a band, evenly spaced in their logarithm.
pub const BAND_PERIODS: usize = 100;

/// A spectrum to which a record comes near over a band of periods.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BandTarget {
    /// The spectrum, with its damping ratio.
    pub spectrum: TargetSpectrum,
    /// First period (s).
    pub from: f64,
    /// Last period (s).
    pub to: f64,
    /// A further factor (-).
    pub times: f64,
    /// Why these periods, for the user; empty where the user chose them.
    pub reason: String,
}

/// What a record is scaled to. `T` is a band with its spectrum: as read, or what names it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub enum Scale<T = BandTarget> {
    /// By this factor.
    Factor(f64),
    /// To a peak ground acceleration (m/s2).
    PeakAcceleration(f64),
    /// To a peak ground velocity (m/s), from the initial velocity of the file or from zero.
    PeakVelocity(f64),
    /// To a pseudo-acceleration at one period.
    SpectralAcceleration {
        /// Period (s).
        period: f64,
        /// Damping ratio (-).
        damping: f64,
        /// Pseudo-acceleration (m/s2).
        target: f64,
    },
    /// To a spectrum over a band of periods: see [`band_factor`].
    Band(T),
}

impl<T> Scale<T> {
    /// The same scale with its band made into another form, such as the spectrum read from
    /// the file that `T` names.
    ///
    /// # Errors
    /// What `made` refuses.
    pub fn with_target<U, E>(&self, made: impl FnOnce(&T) -> Result<U, E>) -> Result<Scale<U>, E> {
        Ok(match *self {
            Self::Factor(factor) => Scale::Factor(factor),
            Self::PeakAcceleration(peak) => Scale::PeakAcceleration(peak),
            Self::PeakVelocity(peak) => Scale::PeakVelocity(peak),
            Self::SpectralAcceleration {
                period,
                damping,
                target,
            } => Scale::SpectralAcceleration {
                period,
                damping,
                target,
            },
            Self::Band(ref target) => Scale::Band(made(target)?),
        })
    }

    /// The band with its spectrum.
    #[must_use]
    pub fn target(&self) -> Option<&T> {
        match self {
            Self::Band(target) => Some(target),
            _ => None,
        }
    }
}

impl Scale {
    /// The factor for a record, without applying it.
    ///
    /// # Errors
    /// Targets that are not positive, periods or damping ratios out of range, a band
    /// beyond the target, or a record of zeros.
    pub fn factor(&self, record: &Accelerogram) -> Result<f64, GroundMotionError> {
        let linear = Evaluation::PiecewiseLinear;
        match self {
            Self::Factor(factor) => Ok(*factor),
            Self::PeakAcceleration(target) => ratio(*target, record.peak().value),
            Self::PeakVelocity(target) => {
                let (velocity, displacement) = record.initial().unwrap_or_default();
                let motion = GroundMotion::of(record, velocity, displacement);
                ratio(*target, motion.peak_velocity(linear).value)
            }
            Self::SpectralAcceleration {
                period,
                damping,
                target,
            } => {
                let spectrum = response_spectrum(record, &[*period], *damping, linear)?;
                ratio(*target, spectrum.pseudo_acceleration[0])
            }
            Self::Band(band) => {
                positive(STEP, "times", band.times)?;
                let record = std::slice::from_ref(record);
                let nearest = band_factor(record, &band.spectrum, band.from, band.to)?;
                Ok(band.times * nearest)
            }
        }
    }

    pub(crate) fn apply(
        &self,
        record: &Accelerogram,
    ) -> Result<(Accelerogram, StepRecord), GroundMotionError> {
        let factor = self.factor(record)?;
        let step = StepRecord::new(STEP);
        let step = match self {
            Self::Factor(_) => step,
            Self::PeakAcceleration(target) => step.number("peak acceleration", *target, "m/s2"),
            Self::PeakVelocity(target) => step.number("peak velocity", *target, "m/s"),
            Self::SpectralAcceleration {
                period,
                damping,
                target,
            } => step
                .number("pseudo-acceleration", *target, "m/s2")
                .number("period", *period, "s")
                .number("damping ratio", *damping, "-"),
            Self::Band(band) => step
                .number("first period", band.from, "s")
                .number("last period", band.to, "s")
                .number("damping ratio", band.spectrum.damping(), "-")
                .remark(format!(
                    "to {}: least squares of the logarithm at {BAND_PERIODS} periods{}{}",
                    match band.spectrum.name() {
                        "" => "a spectrum",
                        name => name,
                    },
                    match band.reason.as_str() {
                        "" => String::new(),
                        reason => format!("; {reason}"),
                    },
                    match band.times {
                        1.0 => String::new(),
                        times => format!("; times {times}"),
                    }
                )),
        };
        Ok((
            record.scaled_by(factor)?,
            step.number("factor", factor, "-"),
        ))
    }
}

fn ratio(target: f64, value: f64) -> Result<f64, GroundMotionError> {
    positive(STEP, "target", target)?;
    if value > 0.0 {
        return Ok(target / value);
    }
    Err(GroundMotionError::NotPossible {
        step: STEP,
        reason: "the record is zero throughout".to_owned(),
        remedy: "use another record or component",
    })
}

/// One factor for a set of records (or both components of one) that brings their mean
/// spectrum nearest to a target over a band of periods (s): least squares of the
/// logarithms, `ln s = mean(ln target - ln PSA)` over 100 periods evenly spaced in
/// their logarithm, PSA the geometric mean of the set.
///
/// For a pair of buildings the band must span both, as 0.2 times the shorter to twice
/// the longer period.
///
/// # Errors
/// No record, a band that the target does not cover, or a record of zeros.
pub fn band_factor(
    records: &[Accelerogram],
    target: &TargetSpectrum,
    from: f64,
    to: f64,
) -> Result<f64, GroundMotionError> {
    within(
        STEP,
        "number of records",
        records.len() as f64,
        1.0,
        f64::MAX,
    )?;
    let periods = logarithmic_periods(from, to, BAND_PERIODS)?;
    target.covers(from, to)?;
    let mut sum = 0.0;
    for record in records {
        let linear = Evaluation::PiecewiseLinear;
        let spectrum = response_spectrum(record, &periods, target.damping(), linear)?;
        for (period, value) in periods.iter().zip(&spectrum.pseudo_acceleration) {
            sum += libm::log(ratio(target.at(*period)?, *value)?);
        }
    }
    Ok(libm::exp(sum / (records.len() * BAND_PERIODS) as f64))
}
