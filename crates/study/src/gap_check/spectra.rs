//! Response spectra of a suite of records, and the target to which it is scaled.

use pounding_assembly::scale_target;
use pounding_case::Case;
use pounding_ground_motion::processing::BandTarget;
use pounding_ground_motion::spectra::{SMOOTH, USUAL_DAMPING, logarithmic_periods};

use super::band_extremes::Band;
use super::error::CheckError;
use super::record_spectra::{mean, of_records, wrong};
use super::records::CaseUnderRecord;

/// First and last period (s).
const RANGE: (f64, f64) = (0.05, 4.0);

/// Spectra of the records as they are used.
#[derive(Debug, Clone, PartialEq)]
pub struct SuiteSpectra {
    /// Damping ratio (-).
    pub damping: f64,
    /// Periods (s), 200 evenly spaced in their logarithm.
    pub periods: Vec<f64>,
    /// Names of the records, those under which buildings collapse among them.
    pub names: Vec<String>,
    /// Pseudo-accelerations of each record (m/s2).
    pub records: Vec<Vec<f64>>,
    /// Their mean (m/s2).
    pub mean: Vec<f64>,
    /// The spectrum to which the case scales its records, if it does.
    pub target: Option<SuiteTarget>,
}

/// The target of a suite.
#[derive(Debug, Clone, PartialEq)]
pub struct SuiteTarget {
    /// What it is: a code with its parameters, or a file.
    pub name: String,
    /// First and last period of the band of the scale (s).
    pub band: (f64, f64),
    /// Why these periods; empty where the case gives them.
    pub band_reason: String,
    /// The further factor of the scale (-).
    pub times: f64,
    /// Pseudo-accelerations at the periods of the spectra (m/s2); `None` beyond its range.
    pub values: Vec<Option<f64>>,
    /// Least ratio of the mean to the target within the band, also between the periods of the
    /// spectra, with its period (s).
    pub least: (f64, f64),
    /// Greatest ratio, with its period (s).
    pub greatest: (f64, f64),
}

/// The spectra of the records of a check.
pub(super) fn spectra(
    case: &Case,
    records: &[CaseUnderRecord],
    threads: usize,
) -> Result<SuiteSpectra, CheckError> {
    let target = scale_target(case)?;
    let damping = target
        .as_ref()
        .map_or(USUAL_DAMPING, |t| t.spectrum.damping());
    let Some(first) = records.first() else {
        return Err(CheckError::NoGap);
    };
    let periods = logarithmic_periods(RANGE.0, RANGE.1, SMOOTH).map_err(wrong(first))?;
    let spectra = of_records(records, &periods, damping, threads)?;
    let mean = mean(&spectra, periods.len());
    let compared = |band: BandTarget| -> Result<SuiteTarget, CheckError> {
        let within = Band {
            ends: (band.from, band.to),
            damping,
        };
        let (least, greatest) = within.extremes(records, |t| band.spectrum.at(t).ok(), threads)?;
        Ok(SuiteTarget {
            name: band.spectrum.name().to_owned(),
            band: (band.from, band.to),
            band_reason: band.reason,
            times: band.times,
            least,
            greatest,
            values: periods.iter().map(|t| band.spectrum.at(*t).ok()).collect(),
        })
    };
    Ok(SuiteSpectra {
        target: target.map(compared).transpose()?,
        damping,
        names: records.iter().map(|r| r.name.clone()).collect(),
        periods,
        records: spectra,
        mean,
    })
}
