//! Response spectra of floors.

use numpy::PyReadonlyArray1;
use pounding_case::Dimension;
use pounding_cli::Failure;
use pounding_cli::answers::of_check;
use pounding_study::floor_spectra::{
    FloorPlace, FloorSpectraError, FloorSpectraWanted, floor_above, floor_spectra,
    floor_spectra_under, roofs,
};
use pounding_time_history::System;
use pyo3::prelude::*;

use crate::case::PyCase;
use crate::errors::Problem;
use crate::suite::Suite;
use crate::values::{json, quantity};
use crate::watch::watched;

/// Progress is told in parts of this.
const WHOLE: usize = 1000;

/// Floors as Python names them, or the roofs.
type Floors = Option<Vec<(String, usize)>>;

fn places(floors: &Floors, system: &System) -> Result<Vec<FloorPlace>, FloorSpectraError> {
    let Some(floors) = floors else {
        return Ok(roofs(system));
    };
    let floor =
        |(building, storey): &(String, usize)| floor_above(system, building, &storey.to_string());
    floors.iter().map(floor).collect()
}

fn problem(error: FloorSpectraError, case: &PyCase) -> Problem {
    match error {
        FloorSpectraError::Run(error) => case.problem(Failure::of_case(error, &case.case)),
        FloorSpectraError::Record { record, error } => {
            let failure = Failure::of_case(*error, &case.case);
            case.problem(failure.within(&format!("record {record}")))
        }
        FloorSpectraError::NoRecord { .. } => {
            Problem::from(Failure::computation(error.to_string(), error.help()))
        }
        FloorSpectraError::Records(error) => case.problem(of_check(*error, &case.case)),
        FloorSpectraError::Spectrum(error) => Problem::from(Failure::from(error)),
        error => Problem::from(Failure::input(error.to_string(), error.help())),
    }
}

/// Response spectra of floors, each a building and a storey from 1, or of the roofs, at these periods (s): what `pounding
/// floor-spectrum --json` prints.
#[pyfunction]
#[pyo3(signature = (case, floors, periods, damping, progress=None))]
fn floor_spectra_json<'py>(
    py: Python<'py>,
    case: &Bound<'py, PyCase>,
    floors: Floors,
    periods: PyReadonlyArray1<'py, f64>,
    damping: &Bound<'py, PyAny>,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<String> {
    let case = case.get();
    let dampings = [quantity(damping, "damping", Dimension::NUMBER)?];
    let periods = periods.as_array().to_vec();
    let failed = |error| problem(error, case);
    let made = watched(py, progress, |watch| {
        let assembly = case.assembly()?;
        let floors = places(&floors, &assembly.system).map_err(failed)?;
        let wanted = FloorSpectraWanted {
            floors: &floors,
            periods: &periods,
            dampings: &dampings,
        };
        let work = floor_spectra(&assembly, wanted, &[&periods], &mut |part| {
            watch.ask((part * WHOLE as f64) as usize, WHOLE)
        });
        let (mut spectra, _) = work.map_err(failed)?;
        json(&spectra.remove(0))
    })?;
    Ok(made?)
}

/// The same under motions and records: what `pounding floor-spectrum --records ... --json` prints.
#[pyfunction]
#[pyo3(signature = (case, motions, floors, periods, damping, threads, progress=None))]
#[expect(clippy::too_many_arguments, reason = "keywords of Python")]
fn floor_spectra_over_records_json<'py>(
    py: Python<'py>,
    case: &Bound<'py, PyCase>,
    motions: Vec<(String, Bound<'py, PyAny>)>,
    floors: Floors,
    periods: PyReadonlyArray1<'py, f64>,
    damping: &Bound<'py, PyAny>,
    threads: usize,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<String> {
    let case = case.get();
    let suite = Suite::of(py, case, motions)?;
    let dampings = [quantity(damping, "damping", Dimension::NUMBER)?];
    let periods = periods.as_array().to_vec();
    let failed = |error| problem(error, case);
    let made = watched(py, progress, |watch| {
        let records = suite.under(case)?;
        let floors = match records.first() {
            Some(first) => places(&floors, &first.assembly.system).map_err(failed)?,
            None => Vec::new(),
        };
        let wanted = FloorSpectraWanted {
            floors: &floors,
            periods: &periods,
            dampings: &dampings,
        };
        let ask = |done, total| watch.ask(done, total);
        let work = (threads.max(1), &ask as &_);
        let answers = floor_spectra_under((&case.case, &records), wanted, &[&periods], work);
        json(&answers.map_err(failed)?.remove(0))
    })?;
    Ok(made?)
}

/// Adds the functions of this file.
pub fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(floor_spectra_json, module)?)?;
    module.add_function(wrap_pyfunction!(floor_spectra_over_records_json, module)?)
}
