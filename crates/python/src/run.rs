//! Runs and what they return.
#![allow(unsafe_code)]

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use numpy::ndarray::ArrayView2;
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods};
use pounding_assembly::{Assembly, RecordFiles};
use pounding_cli::Failure;
use pounding_cli::answers::{Replaced, page_judged};
use pounding_files::checksum::Checksum;
use pounding_report::{RunResult, page};
use pounding_results::{
    Kind, RunEnding, RunHead, check_size, image, response_bytes, run_in_memory, write_run,
};
use pounding_time_history::{
    Energy, GridRecorder, History, HistorySink, Impact, IsolatedRun, Outcome, Recorder, Summary,
    TimeHistoryError, in_parallel, run as integrate, run_isolated,
};
use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

use crate::case::PyCase;
use crate::errors::{Problem, warn};
use crate::values::json;
use crate::watch::{Stop, Watch, watched};

/// Thousandths of a run, for its progress.
const WHOLE: usize = 1000;

/// A run that has ended.
#[pyclass(frozen, name = "Run", module = "pounding._native")]
#[derive(Debug)]
pub struct Run {
    case: PyCase,
    assembly: Assembly,
    outcome: Outcome,
    isolated: Option<Outcome>,
    warnings: Vec<String>,
    wall_time: f64,
    /// Responses on the output grid, if they were asked for.
    history: Option<History>,
}

/// What is computed beside the run itself.
#[derive(Debug, Clone, Copy)]
struct Wanted {
    histories: bool,
    isolated: bool,
}

impl Run {
    fn of(
        (case, files): (&PyCase, &RecordFiles),
        wanted: Wanted,
        (watch, told): (&Watch, &(dyn Fn(f64) + Sync)),
    ) -> Result<Self, Problem> {
        let mut assembly = case.assembly_sharing(files)?;
        let failed = |e: TimeHistoryError| case.problem(Failure::of_case(e, &case.case));
        let (system, options) = (&assembly.system, &assembly.options);
        if wanted.histories {
            check_size(system, options.duration, assembly.output_step)
                .map_err(|e| Problem::from(Failure::from(e)))?;
            fit_in_memory(response_bytes(
                system,
                options.duration,
                assembly.output_step,
            ))?;
        }
        let started = Instant::now();
        let recorder = || {
            let sink = Fitting(History::default());
            GridRecorder::into_sink(assembly.output_step, sink).map_err(failed)
        };
        let mut recorder = wanted.histories.then(recorder).transpose()?;
        let (outcome, isolated) = std::thread::scope(|scope| {
            // Neither run depends on the other.
            let without = move || {
                let mut stop = Stop(watch);
                run_isolated(system, options, &mut [&mut stop], &mut |_| {})
            };
            let beside = wanted
                .isolated
                .then(|| std::thread::Builder::new().spawn_scoped(scope, without));
            let mut stop = Stop(watch);
            let mut recorders: Vec<&mut dyn Recorder> = vec![&mut stop];
            recorders.extend(recorder.as_mut().map(|r| r as &mut dyn Recorder));
            let outcome = integrate(system, options, &mut recorders, &mut |part| told(part));
            let isolated = beside.map(|thread| match thread.map(|thread| thread.join()) {
                Ok(Ok(isolated)) => isolated,
                Ok(Err(panic)) => std::panic::resume_unwind(panic),
                // No thread to be had.
                Err(_) => without(),
            });
            (outcome, isolated)
        });
        let outcome = outcome.map_err(failed)?;
        let mut warnings = assembly.with_those_of_the_record(&outcome.warnings);
        let isolated = isolated.map(|isolated| {
            let (isolated, told) = IsolatedRun::beside(&outcome, isolated);
            warnings.extend(told);
            isolated
        });
        // Thousands of runs are kept.
        assembly.system.release_tables();
        Ok(Self {
            case: case.clone(),
            outcome,
            isolated,
            warnings,
            wall_time: started.elapsed().as_secs_f64(),
            history: recorder.map(|recorder| recorder.responses.0),
            assembly,
        })
    }

    fn history(&self) -> Result<&History, Problem> {
        self.history.as_ref().ok_or_else(|| {
            let help = "run it with histories=True".to_owned();
            let message = "the run has no histories, only peaks and impacts";
            Failure::input(message, Some(help)).into()
        })
    }

    fn head(&self) -> RunHead<'_> {
        RunHead {
            title: &self.case.case.title,
            case: &self.case.text,
            version: env!("CARGO_PKG_VERSION"),
            build: pounding_study::BUILD,
            system: &self.assembly.system,
            accelerogram: &self.assembly.accelerogram,
        }
    }

    /// All that a result file takes; unknown peaks stand in for a run without gaps that was
    /// not asked for.
    fn with_ending<T>(&self, write: impl FnOnce(&RunEnding<'_>) -> T) -> T {
        let unknown;
        let isolated = match &self.isolated {
            Some(isolated) => isolated,
            None => {
                unknown = self.outcome.with_unknown_peaks();
                &unknown
            }
        };
        write(&RunEnding {
            outcome: &self.outcome,
            isolated,
            warnings: &self.warnings,
            wall_time: self.wall_time,
        })
    }

    fn in_memory(&self) -> Result<hdf5::File, Problem> {
        let (head, history) = (self.head(), self.history()?);
        let made = self.with_ending(|ending| run_in_memory(&head, history, ending));
        made.map_err(|e| Failure::computation(format!("no result in memory: {e}"), None).into())
    }
}

/// Histories of which [`fit_in_memory`] has found that the memory of this machine holds them.
struct Fitting(History);

impl HistorySink for Fitting {
    fn most_bytes(&self) -> f64 {
        f64::INFINITY
    }

    fn take(&mut self, rows: &mut History) -> Result<(), TimeHistoryError> {
        self.0.take(rows)
    }
}

/// Refuses responses that memory does not hold: an allocation that fails ends the interpreter.
/// While they grow, they are there twice.
fn fit_in_memory(bytes: f64) -> Result<(), Problem> {
    let most = 2.0 * bytes;
    let mut probe: Vec<u8> = Vec::new();
    let address_space = most < isize::MAX as f64 && probe.try_reserve_exact(most as usize).is_ok();
    if address_space && available_memory().is_none_or(|available| bytes <= available) {
        return Ok(());
    }
    let message = format!(
        "the histories take {:.1} GB, which memory does not hold",
        bytes / 1e9
    );
    let help = "raise `output_step` in [analysis], shorten `duration`, or run it with histories=False; the command `pounding run` writes them while the run goes on";
    Err(Failure::computation(message, Some(help.to_owned())).into())
}

/// Bytes that are free for new work, where Linux says so.
fn available_memory() -> Option<f64> {
    let told = std::fs::read_to_string("/proc/meminfo").ok()?;
    let line = told
        .lines()
        .find_map(|line| line.strip_prefix("MemAvailable:"))?;
    let kibibytes: f64 = line.split_whitespace().next()?.parse().ok()?;
    Some(1024.0 * kibibytes)
}

#[pymethods]
impl Run {
    /// What `pounding run --json` prints.
    fn summary_json(&self) -> Result<String, Problem> {
        self.with_ending(|ending| {
            let outcomes = (ending.outcome, ending.isolated);
            json(&Summary::of(
                &self.assembly.system,
                outcomes,
                ending.warnings,
            ))
        })
    }

    /// The case that was run.
    #[getter]
    fn case(&self) -> PyCase {
        self.case.clone()
    }

    /// Time that the run took (s).
    #[getter]
    fn wall_time(&self) -> f64 {
        self.wall_time
    }

    /// Whether responses over time were kept.
    #[getter]
    fn has_histories(&self) -> bool {
        self.history.is_some()
    }

    /// Whether the run without gaps was made too.
    #[getter]
    fn has_isolated(&self) -> bool {
        self.isolated.is_some()
    }

    /// Names of the buildings with the columns of their floors.
    #[getter]
    fn building_columns(&self) -> Vec<(String, usize, usize)> {
        let system = &self.assembly.system;
        let ranges = system.offsets().windows(2);
        let buildings = system.buildings().iter().zip(ranges);
        buildings
            .map(|(b, range)| (b.name().to_owned(), range[0], range[1]))
            .collect()
    }

    /// Names of the gaps with the columns of their levels.
    #[getter]
    fn gap_columns(&self) -> Vec<(String, usize, usize)> {
        let gaps = self.assembly.system.gaps().iter();
        gaps.map(|g| (g.name.clone(), g.first_level, g.first_level + g.levels))
            .collect()
    }

    /// Output times (s).
    #[getter]
    fn time(slf: Bound<'_, Self>) -> PyResult<Bound<'_, PyArray1<f64>>> {
        let rows = Self::array(slf, "time")?;
        rows.reshape([rows.len()?])
    }

    /// One of the histories by its name: a row for each output time, read only, in the memory
    /// of the run.
    fn array<'py>(slf: Bound<'py, Self>, name: &str) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let history = slf.get().history()?;
        let values = match name {
            "time" => &history.time,
            "ground_acceleration" => &history.ground_acceleration,
            "displacement" => &history.displacement,
            "velocity" => &history.velocity,
            "acceleration_absolute" => &history.acceleration_absolute,
            "storey_shear" => &history.storey_shear,
            "penetration" => &history.penetration,
            "force" => &history.force,
            _ => {
                return Err(PyKeyError::new_err(format!(
                    "{name} is no history of a run"
                )));
            }
        };
        let rows = history.len();
        let columns = values.len().checked_div(rows).unwrap_or(0);
        let view = ArrayView2::from_shape((rows, columns), values)
            .map_err(|e| Failure::computation(e.to_string(), None))
            .map_err(Problem::from)?;
        // SAFETY: the run owns the values, never changes them, as its class is frozen, and
        // lives as long as the array, whose base it is.
        let array = unsafe { PyArray2::borrow_from_array(&view, slf.clone().into_any()) };
        array.readwrite().make_nonwriteable();
        Ok(array)
    }

    /// Energies over time (J): arrays by name.
    fn energy<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let history = self.history()?;
        let columns = PyDict::new(py);
        for part in Energy::PARTS {
            let values: Vec<f64> = history.energy.iter().map(part.value).collect();
            columns.set_item(part.name, values.into_pyarray(py))?;
        }
        Ok(columns)
    }

    /// Impacts in order of closure: columns by name, as in the result file.
    fn impacts<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        type Pick = fn(&Impact) -> f64;
        let parts: [(&str, Pick); 10] = [
            ("t_close", |i| i.time_closed),
            ("t_open", |i| i.time_opened),
            ("approach_velocity", |i| i.approach_velocity),
            ("separation_velocity", |i| i.separation_velocity),
            ("achieved_restitution", |i| i.achieved_restitution),
            ("peak_force", |i| i.peak_force.value),
            ("peak_force_time", |i| i.peak_force.time),
            ("peak_penetration", |i| i.peak_penetration.value),
            ("impulse", |i| i.impulse),
            ("energy_dissipated", |i| i.energy_dissipated),
        ];
        let (impacts, gaps) = (&self.outcome.impacts, &self.outcome.gaps);
        let columns = PyDict::new(py);
        let names: Vec<&str> = impacts.iter().map(|i| gaps[i.gap].name.as_str()).collect();
        columns.set_item("gap", names)?;
        let levels: Vec<i64> = impacts.iter().map(|i| i.level as i64 + 1).collect();
        columns.set_item("level", levels.into_pyarray(py))?;
        for (name, part) in parts {
            let values: Vec<f64> = impacts.iter().map(part).collect();
            columns.set_item(name, values.into_pyarray(py))?;
        }
        Ok(columns)
    }

    /// Writes the result file, as `pounding run` does.
    fn to_hdf5(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        let _inputs_stay = self.case.writes("result", &path)?;
        let file = self.case.own_file();
        let replaced = Replaced {
            output: &path,
            kind: Kind::Run,
            file,
            text_sha256: file.is_none().then(|| self.head().case_sha256()),
            named: true,
        };
        let going = replaced.judged(false).map_err(Problem::from)?;
        let (head, history) = (self.head(), self.history()?);
        going.map_or(Ok(()), |going| warn(py, &going.ahead(), 2))?;
        let target = (path.as_path(), file);
        py.detach(|| self.with_ending(|ending| write_run(target, &head, history, ending)))
            .map_err(|e| Problem::from(Failure::from(e)).into())
    }

    /// The bytes of the result file, without its checksum.
    fn image<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let bytes = py.detach(|| {
            let made = image(&self.in_memory()?);
            made.map_err(|e| Problem::from(Failure::computation(e.to_string(), None)))
        })?;
        Ok(PyBytes::new(py, &bytes))
    }

    /// Writes a page to a file.
    fn write_page(&self, py: Python<'_>, path: PathBuf, page: &str) -> PyResult<()> {
        let _inputs_stay = self.case.writes("page", &path)?;
        let going = page_judged(&path, true).map_err(Problem::from)?;
        going.map_or(Ok(()), |going| warn(py, &going.ahead(), 2))?;
        let failed = |e: std::io::Error| Failure::output(&e, &path.display().to_string());
        pounding_files::write(&path, page.as_bytes())
            .map_err(failed)
            .map_err(|failure| Problem::from(failure).into())
    }

    /// The page of the run.
    fn page(&self, py: Python<'_>, name: &str) -> Result<String, Problem> {
        py.detach(|| {
            // What was never on a disk cannot have been damaged there.
            let read = RunResult::of_file(&self.in_memory()?, Path::new(name), Checksum::Matches);
            let drawn = read.and_then(|result| page::run(&result, name));
            drawn.map_err(|e| Failure::computation(e.to_string(), None).into())
        })
    }
}

/// Runs a case, with and without its gaps if that is wanted.
#[pyfunction]
#[pyo3(signature = (case, histories=true, isolated=true, progress=None))]
fn run(
    py: Python<'_>,
    case: &Bound<'_, PyCase>,
    histories: bool,
    isolated: bool,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Run> {
    let case = case.get();
    let wanted = Wanted {
        histories,
        isolated,
    };
    let made = watched(py, progress, |watch| {
        let told = |part: f64| watch.tell((part * WHOLE as f64) as usize, WHOLE);
        Run::of((case, &RecordFiles::default()), wanted, (watch, &told))
    })?;
    Ok(made?)
}

/// Runs many cases on so many threads; each is a run or the exception that it ended with.
#[pyfunction]
#[pyo3(signature = (cases, threads, histories=false, isolated=false, progress=None))]
fn run_many<'py>(
    py: Python<'py>,
    cases: Vec<Bound<'py, PyCase>>,
    threads: usize,
    histories: bool,
    isolated: bool,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<Vec<Py<PyAny>>> {
    let wanted = Wanted {
        histories,
        isolated,
    };
    let cases: Vec<PyCase> = cases.iter().map(|c| c.get().clone()).collect();
    let made = watched(py, progress, |watch| {
        let done = AtomicUsize::new(0);
        let files = RecordFiles::default();
        in_parallel(cases.len(), threads.max(1), |number| {
            if watch.stopped() {
                return None;
            }
            let made = Run::of((&cases[number], &files), wanted, (watch, &|_| {}));
            watch.tell(done.fetch_add(1, Ordering::Relaxed) + 1, cases.len());
            Some(made)
        })
    })?;
    let made = made.into_iter().flatten().map(|made| match made {
        Ok(run) => Ok(Bound::new(py, run)?.into_any().unbind()),
        Err(problem) => Ok(PyErr::from(problem).into_value(py).into_any()),
    });
    made.collect()
}

/// Adds the classes and functions of this file.
pub fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<Run>()?;
    module.add_function(wrap_pyfunction!(run, module)?)?;
    module.add_function(wrap_pyfunction!(run_many, module)?)
}
