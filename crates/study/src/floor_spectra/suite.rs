//! Response spectra of floors over several records.

use std::ops::ControlFlow;

use pounding_case::Case;
use pounding_ground_motion::spectra::ResponseSpectrum;
use pounding_time_history::TimeHistoryError;
use serde::Serialize;

use super::{
    FloorSpectra, FloorSpectraError, FloorSpectraWanted, FloorWithSpectra, RIGID, floor_spectra,
};
use crate::fractiles::fractiles;
use crate::gap_check::{
    CaseUnderRecord, CheckError, Ending, Progress, Repeated, runs_in_parallel, warnings,
};

/// The spectra of the floors under one record.
#[derive(Debug, Clone, Serialize)]
pub struct FloorSpectraOfRecord {
    /// Name of the record.
    pub name: String,
    /// What equipment feels under it.
    pub spectra: FloorSpectra,
}

/// Peak absolute accelerations (m/s2) by period over the records.
#[derive(Debug, Clone, Default, Serialize)]
pub struct AccelerationsOverRecords {
    /// Mean of the records.
    pub mean: Vec<f64>,
    /// Their 16 % fractile, linear between records.
    pub p16: Vec<f64>,
    /// Median.
    pub p50: Vec<f64>,
    /// 84 % fractile.
    pub p84: Vec<f64>,
}

/// Spectra of a floor of one damping ratio, over the records.
#[derive(Debug, Clone, Serialize)]
pub struct SpectraOverRecords {
    /// Damping ratio (-).
    pub damping: f64,
    /// Periods (s).
    pub periods: Vec<f64>,
    /// Of the ground under the building.
    pub ground: AccelerationsOverRecords,
    /// Of the building alone.
    pub alone: AccelerationsOverRecords,
    /// With pounding.
    pub pounding: AccelerationsOverRecords,
}

/// A floor with its spectra over the records.
#[derive(Debug, Clone, Serialize)]
pub struct FloorOverRecords {
    /// Name of its building.
    pub building: String,
    /// Number of the storey below it, from 1 at the bottom.
    pub storey: usize,
    /// Whether it is the uppermost.
    pub is_roof: bool,
    /// Above the ground (m).
    pub elevation: f64,
    /// By damping ratio.
    pub spectra: Vec<SpectraOverRecords>,
}

/// A record that counts nowhere, as one of the runs under it has no end.
#[derive(Debug, Clone, Serialize)]
pub struct RecordWithoutSpectra {
    /// Name of the record.
    pub name: String,
    /// Why.
    pub reason: String,
}

/// What equipment on floors feels under several records.
#[derive(Debug, Clone, Serialize)]
pub struct FloorSpectraOverRecords {
    /// Over the records, the floors in the order in which they are asked for.
    pub floors: Vec<FloorOverRecords>,
    /// Each record, in the order in which they are given.
    pub records: Vec<FloorSpectraOfRecord>,
    /// Those that are left out.
    pub left_out: Vec<RecordWithoutSpectra>,
    /// What the user should know.
    pub warnings: Vec<String>,
}

/// Runs a case under each of the records ([`crate::gap_check::under_records`]) with its gaps and links and without them, on
/// so many threads, and gives the spectra of its floors over the records: one answer for each list of periods (s), of which
/// none should be shorter than the shortest that is wanted. Nothing depends on the number of threads.
///
/// # Errors
/// Periods and damping ratios that no spectrum has, a run that fails, records under all of which a building collapses, and a
/// wish to stop.
pub fn floor_spectra_under(
    (case, records): (&Case, &[CaseUnderRecord]),
    wanted: FloorSpectraWanted<'_>,
    lists: &[&[f64]],
    (threads, progress): (usize, Progress<'_>),
) -> Result<Vec<FloorSpectraOverRecords>, FloorSpectraError> {
    let one = |number: usize, ending: &mut Ending<'_>| {
        let record = &records[number];
        // A record takes long: whether to go on is asked in between too.
        let goes_on = &mut |_| match ending.goes_on() {
            true => ControlFlow::Continue(()),
            false => ControlFlow::Break(()),
        };
        floor_spectra(&record.assembly, wanted, lists, goes_on)
    };
    let made = runs_in_parallel(records.len(), threads, progress, one);
    let made: Vec<Result<_, FloorSpectraError>> = made.map_err(|error| match error {
        CheckError::Stopped => FloorSpectraError::Stopped,
        error => FloorSpectraError::Records(Box::new(error)),
    })?;
    let mut answers = vec![Vec::new(); lists.len()];
    let mut left_out = Vec::new();
    for (record, made) in records.iter().zip(made) {
        let name = record.name.clone();
        let reason = match made {
            Ok((spectra, None)) => {
                for (answers, spectra) in answers.iter_mut().zip(spectra) {
                    let name = name.clone();
                    answers.push(FloorSpectraOfRecord { name, spectra });
                }
                continue;
            }
            Ok((_, Some(error))) => error,
            Err(FloorSpectraError::Run(error @ TimeHistoryError::Collapse { .. })) => {
                error.to_string()
            }
            Err(FloorSpectraError::Run(error)) => {
                let error = Box::new(error);
                return Err(FloorSpectraError::Record {
                    record: name,
                    error,
                });
            }
            Err(error) => return Err(error),
        };
        left_out.push(RecordWithoutSpectra { name, reason });
    }
    if left_out.len() == records.len() && !records.is_empty() {
        let reasons = left_out.iter().map(|r| format!("{}: {}", r.name, r.reason));
        return Err(FloorSpectraError::NoRecord {
            reasons: reasons.collect(),
        });
    }
    let mut told = warnings(case, records);
    told.extend(
        left_out
            .iter()
            .map(|record| format!("record {} counts nowhere: {}", record.name, record.reason)),
    );
    let mut spectra = answers
        .iter()
        .flatten()
        .map(|record: &FloorSpectraOfRecord| &record.spectra);
    if spectra.any(|spectra| spectra.warnings.iter().any(|text| text == RIGID)) {
        told.push(RIGID.to_owned());
    }
    let names: Vec<&str> = records.iter().map(|r| r.name.as_str()).collect();
    told.extend(Repeated::among(records).warnings(&names));
    let over = answers.into_iter().map(|records| FloorSpectraOverRecords {
        floors: over(&records),
        records,
        left_out: left_out.clone(),
        warnings: told.clone(),
    });
    Ok(over.collect())
}

/// The floors of all records, which have the same.
fn over(records: &[FloorSpectraOfRecord]) -> Vec<FloorOverRecords> {
    let Some(first) = records.first() else {
        return Vec::new();
    };
    let floors = first.spectra.floors.iter().enumerate();
    let floors = floors.map(|(number, floor)| FloorOverRecords {
        building: floor.building.clone(),
        storey: floor.storey,
        is_roof: floor.is_roof,
        elevation: floor.elevation,
        spectra: (0..floor.spectra.len())
            .map(|damping| {
                let of = records.iter().map(|r| &r.spectra.floors[number]);
                of_damping(&of.collect::<Vec<_>>(), damping)
            })
            .collect(),
    });
    floors.collect()
}

fn of_damping(floors: &[&FloorWithSpectra], damping: usize) -> SpectraOverRecords {
    let spectra: Vec<_> = floors.iter().map(|floor| &floor.spectra[damping]).collect();
    let first = &spectra[0].ground;
    // Records without a run of the buildings alone are left out.
    let alone: Vec<&ResponseSpectrum> = spectra.iter().filter_map(|s| s.alone.as_ref()).collect();
    let ground: Vec<&ResponseSpectrum> = spectra.iter().map(|s| &s.ground).collect();
    let pounding: Vec<&ResponseSpectrum> = spectra.iter().map(|s| &s.pounding).collect();
    SpectraOverRecords {
        damping: first.damping,
        periods: first.periods.clone(),
        ground: accelerations(&ground),
        alone: accelerations(&alone),
        pounding: accelerations(&pounding),
    }
}

fn accelerations(spectra: &[&ResponseSpectrum]) -> AccelerationsOverRecords {
    let mut over = AccelerationsOverRecords::default();
    for period in 0..spectra.first().map_or(0, |s| s.periods.len()) {
        let values = spectra.iter().map(|s| s.acceleration[period]);
        let values: Vec<f64> = values.collect();
        over.mean
            .push(values.iter().sum::<f64>() / values.len() as f64);
        let [low, middle, high] = fractiles(values);
        over.p16.push(low);
        over.p50.push(middle);
        over.p84.push(high);
    }
    over
}
