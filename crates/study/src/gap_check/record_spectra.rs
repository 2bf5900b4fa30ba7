//! Response spectra of records at any periods, and their mean.

use pounding_ground_motion::GroundMotionError;
use pounding_ground_motion::spectra::{Evaluation, response_spectrum};

use super::error::CheckError;
use super::parallel::{UNWATCHED, in_parallel};
use super::records::CaseUnderRecord;

/// Pseudo-accelerations (m/s2) of each record at these periods (s).
pub(super) fn of_records(
    records: &[CaseUnderRecord],
    periods: &[f64],
    damping: f64,
    threads: usize,
) -> Result<Vec<Vec<f64>>, CheckError> {
    let spectra = in_parallel(records.len(), threads, UNWATCHED, |r| {
        let record = &records[r];
        let linear = Evaluation::PiecewiseLinear;
        let found = response_spectrum(&record.assembly.accelerogram, periods, damping, linear);
        found.map(|s| s.pseudo_acceleration).map_err(wrong(record))
    });
    spectra?.into_iter().collect()
}

/// The mean of spectra at so many periods.
pub(super) fn mean(spectra: &[Vec<f64>], periods: usize) -> Vec<f64> {
    let mean_at = |i: usize| spectra.iter().map(|s| s[i]).sum::<f64>() / spectra.len() as f64;
    (0..periods).map(mean_at).collect()
}

/// The error of a record whose spectrum cannot be computed.
pub(super) fn wrong(record: &CaseUnderRecord) -> impl FnOnce(GroundMotionError) -> CheckError {
    let record = record.name.clone();
    move |source| CheckError::Record {
        record,
        source: Box::new(source.into()),
    }
}
