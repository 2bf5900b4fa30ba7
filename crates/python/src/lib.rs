//! The native part of the Python package `pounding`: cases, runs, motions and studies as
//! objects that Python modules beside it give their shape. Arrays are handed over without a
//! copy where they lie in memory as NumPy has them; what is computed and written is what the
//! command line computes and writes.

mod case;
mod errors;
mod floors;
mod models;
mod motion;
mod run;
mod study;
mod suite;
mod values;
mod watch;

use std::ffi::OsString;
use std::path::PathBuf;

use pyo3::prelude::*;

/// Does what the command line does with these arguments, and returns its exit code.
#[pyfunction]
fn command_line(py: Python<'_>, arguments: Vec<OsString>) -> PyResult<u8> {
    let interpreter: PathBuf = py.import("sys")?.getattr("executable")?.extract()?;
    let arguments = std::iter::once("pounding".into()).chain(arguments);
    Ok(py.detach(|| pounding_cli::run_within(interpreter, arguments)))
}

/// The module.
#[pymodule]
fn _native(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add("BUILD", pounding_study::BUILD)?;
    module.add_function(wrap_pyfunction!(command_line, module)?)?;
    case::add(module)?;
    motion::add(module)?;
    run::add(module)?;
    floors::add(module)?;
    models::add(module)?;
    study::add(module)
}
