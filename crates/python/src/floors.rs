//! Response spectra of floors.

use numpy::PyReadonlyArray1;
use pounding_case::Dimension;
use pounding_cli::Failure;
use pounding_study::floor_spectra::{
    FloorMotions, FloorSpectraError, FloorSpectraWanted, floor_above, roofs,
};
use pyo3::prelude::*;

use crate::case::{PyCase, json};
use crate::errors::Problem;
use crate::values::quantity;
use crate::watch::watched;

/// Progress is told in parts of this.
const WHOLE: usize = 1000;

/// Response spectra of floors, each a building and a storey from 1, or of the roofs, at these periods (s): what `pounding
/// floor-spectrum --json` prints.
#[pyfunction]
#[pyo3(signature = (case, floors, periods, damping, progress=None))]
fn floor_spectra_json<'py>(
    py: Python<'py>,
    case: &Bound<'py, PyCase>,
    floors: Option<Vec<(String, usize)>>,
    periods: PyReadonlyArray1<'py, f64>,
    damping: &Bound<'py, PyAny>,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<String> {
    let case = case.get();
    let dampings = [quantity(damping, "damping", Dimension::NUMBER)?];
    let periods = periods.as_array().to_vec();
    let failed = |error: FloorSpectraError| match error {
        FloorSpectraError::Run(error) => case.problem(Failure::of_case(error, &case.case)),
        FloorSpectraError::Spectrum(error) => Problem::from(Failure::from(error)),
        error => Problem::from(Failure::input(error.to_string(), error.help())),
    };
    let made = watched(py, progress, |watch| {
        let assembly = case.assembly()?;
        let floors = match &floors {
            None => roofs(&assembly.system),
            Some(floors) => {
                let floor = |(building, storey): &(String, usize)| {
                    floor_above(&assembly.system, building, &storey.to_string())
                };
                let floors: Result<Vec<_>, _> = floors.iter().map(floor).collect();
                floors.map_err(failed)?
            }
        };
        let wanted = FloorSpectraWanted {
            floors: &floors,
            periods: &periods,
            dampings: &dampings,
        };
        let motions = FloorMotions::new(&assembly, wanted, &mut |part| {
            watch.ask((part * WHOLE as f64) as usize, WHOLE)
        });
        let spectra = motions.and_then(|motions| motions.spectra(&periods));
        json(&spectra.map_err(failed)?)
    })?;
    Ok(made?)
}

/// Adds the functions of this file.
pub fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(floor_spectra_json, module)?)
}
