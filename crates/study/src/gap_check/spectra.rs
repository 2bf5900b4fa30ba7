//! Response spectra of a suite of records, and the target to which it is scaled.

use pounding_assembly::scale_target;
use pounding_case::Case;
use pounding_ground_motion::processing::BandTarget;
use pounding_ground_motion::spectra::{Evaluation, logarithmic_periods, response_spectrum};

use super::error::CheckError;
use super::parallel::in_parallel;
use super::records::CaseUnderRecord;

/// Periods of the spectra: enough for a smooth curve.
const PERIODS: usize = 200;
/// First and last period (s).
const RANGE: (f64, f64) = (0.05, 4.0);
/// Damping ratio without a target.
const DAMPING: f64 = 0.05;

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
    /// Pseudo-accelerations at the periods of the spectra (m/s2); `None` beyond its range.
    pub values: Vec<Option<f64>>,
    /// Least ratio of the mean to the target within the band, with its period (s).
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
    let damping = target.as_ref().map_or(DAMPING, |t| t.spectrum.damping());
    let wrong = |record: &CaseUnderRecord| {
        let record = record.name.clone();
        move |source: pounding_ground_motion::GroundMotionError| CheckError::Record {
            record,
            source: Box::new(source.into()),
        }
    };
    let Some(first) = records.first() else {
        return Err(CheckError::NoGap);
    };
    let periods = logarithmic_periods(RANGE.0, RANGE.1, PERIODS).map_err(wrong(first))?;
    let spectra = in_parallel(records.len(), threads, &|_, _| {}, |r| {
        let record = &records[r];
        let linear = Evaluation::PiecewiseLinear;
        let found = response_spectrum(&record.assembly.accelerogram, &periods, damping, linear);
        found.map(|s| s.pseudo_acceleration).map_err(wrong(record))
    });
    let spectra: Vec<Vec<f64>> = spectra.into_iter().collect::<Result<_, _>>()?;
    let mean_at = |i: usize| spectra.iter().map(|s| s[i]).sum::<f64>() / spectra.len() as f64;
    let mean: Vec<f64> = (0..periods.len()).map(mean_at).collect();
    let target = target.map(
        |BandTarget {
             spectrum: target,
             from,
             to,
             reason,
         }| {
            let band = (from, to);
            let values: Vec<Option<f64>> = periods.iter().map(|t| target.at(*t).ok()).collect();
            let within = periods.iter().zip(&values).zip(&mean);
            let within = within.filter(|((t, _), _)| (band.0..=band.1).contains(*t));
            let ratios = within.filter_map(|((t, value), mean)| Some((mean / (*value)?, *t)));
            let ratios: Vec<(f64, f64)> = ratios.collect();
            let by_ratio = |a: &&(f64, f64), b: &&(f64, f64)| a.0.total_cmp(&b.0);
            let none = (f64::NAN, f64::NAN);
            SuiteTarget {
                name: target.name().to_owned(),
                band,
                band_reason: reason,
                least: ratios.iter().min_by(by_ratio).copied().unwrap_or(none),
                greatest: ratios.iter().max_by(by_ratio).copied().unwrap_or(none),
                values,
            }
        },
    );
    Ok(SuiteSpectra {
        damping,
        periods,
        names: records.iter().map(|r| r.name.clone()).collect(),
        records: spectra,
        mean,
        target,
    })
}
