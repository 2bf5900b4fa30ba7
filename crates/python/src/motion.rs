//! Ground motions, their spectra and measures.

use std::path::PathBuf;
use std::sync::Arc;

use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1};
use pounding_case::Dimension;
use pounding_cli::Failure;
use pounding_ground_motion::measures::{IntensityMeasures, MeasureOptions};
use pounding_ground_motion::spectra::{Evaluation, logarithmic_periods, response_spectrum_while};
use pounding_ground_motion::{
    AccelerationUnit, Accelerogram, Format, GroundMotionError, Offset, Quantity, ReadOptions, read,
    responses_beside,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::errors::Problem;
use crate::values::{above_zero, here, json, quantity};
use crate::watch::watched;

/// Dimension of a sensitivity, counts per m/s2.
const SENSITIVITY: Dimension = Dimension {
    mass: 0.0,
    length: -1.0,
    time: 2.0,
};

/// An accelerogram: accelerations (m/s2) at even steps, linear in between.
#[pyclass(frozen, name = "Motion", module = "pounding._native")]
#[derive(Debug)]
pub struct Motion {
    pub record: Arc<Accelerogram>,
    /// The files that it was read from.
    pub read_from: ReadFrom,
}

/// The files that a motion was read from; none of one that was made of numbers.
#[derive(Debug, Clone, Default)]
pub struct ReadFrom {
    /// That of the record.
    pub record: Option<PathBuf>,
    /// The metadata of its station, where they were named.
    response: Option<PathBuf>,
}

impl ReadFrom {
    /// All of them with what each is; as for the records of cases also the metadata that may lie beside it.
    pub fn files(&self) -> Vec<(&'static str, PathBuf)> {
        let metadata = match (&self.response, &self.record) {
            (Some(named), _) => vec![named.clone()],
            (None, Some(record)) => responses_beside(record),
            (None, None) => Vec::new(),
        };
        let record = self.record.iter().map(|file| ("record", file.clone()));
        let metadata = metadata.into_iter();
        record
            .chain(metadata.map(|file| ("station's metadata", file)))
            .collect()
    }
}

impl Motion {
    fn of(record: Accelerogram, read_from: ReadFrom) -> Self {
        Self {
            record: Arc::new(record),
            read_from,
        }
    }
}

fn refused(error: GroundMotionError) -> Problem {
    Problem::of_record(error.into())
}

/// The same where numbers that are out of their range were given as arguments, with a record that is sound.
fn refused_argument(error: GroundMotionError) -> Problem {
    match error {
        GroundMotionError::OutOfRange { .. } => Failure::from(error).into(),
        of_record => refused(of_record),
    }
}

/// A factor of a record, which is neither zero nor none.
fn factor_of(value: &Bound<'_, PyAny>) -> PyResult<f64> {
    let factor = quantity(value, "factor", Dimension::NUMBER)?;
    if factor.is_finite() && factor != 0.0 {
        return Ok(factor);
    }
    let message = format!("factor = {factor} is not finite, or zero");
    let help = "give a number other than zero".to_owned();
    Err(Problem::from(Failure::input(message, Some(help))).into())
}

/// A motion of samples in a unit at even steps (s).
fn of_samples(
    acceleration: &PyReadonlyArray1<'_, f64>,
    time_step: f64,
    unit: &str,
) -> Result<Accelerogram, Problem> {
    let unit = unit.parse::<AccelerationUnit>().map_err(refused)?;
    let samples = acceleration.as_array().to_vec();
    Accelerogram::new(samples, unit, time_step).map_err(refused)
}

/// One of the words that an option takes.
fn word<T>(name: &str, given: Option<T>, what: &str, known: &str) -> Result<T, Problem> {
    let wrong = || Failure::input(format!("\"{name}\" is {what}"), Some(known.to_owned()));
    given.ok_or_else(|| Problem::of_record(wrong()))
}

#[pymethods]
impl Motion {
    /// Accelerations in a unit at even steps (s).
    #[new]
    fn new(
        acceleration: PyReadonlyArray1<'_, f64>,
        time_step: &Bound<'_, PyAny>,
        unit: &str,
    ) -> PyResult<Self> {
        let time_step = quantity(time_step, "time_step", Dimension::TIME)?;
        let record = of_samples(&acceleration, time_step, unit)?;
        Ok(Self::of(record, ReadFrom::default()))
    }

    /// A record of a file, with what its headers do not say.
    #[staticmethod]
    #[pyo3(signature = (path, *, format, component, unit, time_step, quantity, skip_lines, skip_columns, prepend_zero, layout, sensitivity, lenient, response, gravity, offset))]
    #[expect(clippy::too_many_arguments, reason = "keywords of Python")]
    fn read(
        py: Python<'_>,
        path: PathBuf,
        format: Option<&str>,
        component: Option<String>,
        unit: Option<&str>,
        time_step: Option<&Bound<'_, PyAny>>,
        quantity: Option<&str>,
        skip_lines: usize,
        skip_columns: usize,
        prepend_zero: bool,
        layout: Option<String>,
        sensitivity: Option<&Bound<'_, PyAny>>,
        lenient: bool,
        response: Option<PathBuf>,
        gravity: Option<&Bound<'_, PyAny>>,
        offset: Option<&str>,
    ) -> PyResult<Self> {
        let of_name = |name: &str| {
            let known = "acceleration, velocity or displacement";
            word(
                name,
                Quantity::from_name(name),
                "no quantity of a record",
                known,
            )
        };
        let of_mean = |name: &str| {
            let offset = match name {
                "automatic" => Some(Offset::Automatic),
                "keep" => Some(Offset::Keep),
                "remove" => Some(Offset::Remove),
                _ => None,
            };
            let what = "nothing that becomes of the mean";
            word(name, offset, what, "automatic, keep or remove")
        };
        let positive = |value: Option<&Bound<'_, PyAny>>, name, wanted| {
            value.map(|v| above_zero(v, name, wanted)).transpose()
        };
        let options = ReadOptions {
            format: format.map(Format::find).transpose().map_err(refused)?,
            component,
            unit: unit.map(str::parse).transpose().map_err(refused)?,
            time_step: positive(time_step, "time_step", Dimension::TIME)?,
            quantity: quantity.map(of_name).transpose()?,
            skip_lines,
            skip_columns,
            prepend_zero,
            layout,
            sensitivity: positive(sensitivity, "sensitivity", SENSITIVITY)?,
            lenient,
            response,
            gravity: positive(gravity, "gravity", Dimension::ACCELERATION)?,
            offset: offset.map(of_mean).transpose()?.unwrap_or_default(),
        };
        let record = py.detach(|| read(&path, &options)).map_err(refused)?;
        let read_from = ReadFrom {
            record: Some(here(path)),
            response: options.response.map(here),
        };
        Ok(Self::of(record, read_from))
    }

    /// A motion as it was in another process: samples (m/s2) and what [`Self::history_json`] told.
    #[staticmethod]
    fn restored(
        acceleration: PyReadonlyArray1<'_, f64>,
        time_step: f64,
        history: &str,
        file: Option<PathBuf>,
        response: Option<PathBuf>,
    ) -> PyResult<Self> {
        let history = serde_json::from_str(history)
            .map_err(|e| PyValueError::new_err(format!("a motion is damaged: {e}")))?;
        let record = of_samples(&acceleration, time_step, "m/s2")?;
        let read_from = ReadFrom {
            record: file,
            response,
        };
        Ok(Self::of(record.with_history(history), read_from))
    }

    /// What it tells of itself besides its samples, as JSON.
    fn history_json(&self) -> Result<String, Problem> {
        json(self.record.history())
    }

    /// Accelerations (m/s2); a copy, which may be changed.
    #[getter]
    fn acceleration<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, self.record.samples())
    }

    /// Time step (s).
    #[getter]
    fn time_step(&self) -> f64 {
        self.record.time_step()
    }

    /// Time of the last sample (s).
    #[getter]
    fn duration(&self) -> f64 {
        self.record.duration()
    }

    /// Peak absolute acceleration (m/s2).
    #[getter]
    fn peak(&self) -> f64 {
        self.record.peak().value
    }

    /// The file that it was read from.
    #[getter]
    fn file(&self) -> Option<PathBuf> {
        self.read_from.record.clone()
    }

    /// The metadata of its station, where they were named.
    #[getter]
    fn response(&self) -> Option<PathBuf> {
        self.read_from.response.clone()
    }

    /// What was read and done, line by line.
    #[getter]
    fn description(&self) -> Vec<String> {
        self.record.echo()
    }

    /// Where it comes from, as JSON; `null` for one that was made of numbers.
    fn origin_json(&self) -> Result<String, Problem> {
        let origin = self.record.origin().map(|o| {
            serde_json::json!({
                "file": o.file,
                "format": o.format,
                "title": o.title,
                "component": o.component,
                "unit": o.unit,
                "start_time": o.start_time,
                "sha256": o.sha256,
                "warnings": o.warnings,
            })
        });
        json(&origin)
    }

    /// Multiplied by a factor.
    fn scaled_by(&self, factor: &Bound<'_, PyAny>) -> PyResult<Self> {
        let factor = factor_of(factor)?;
        let record = self.record.scaled_by(factor).map_err(refused)?;
        Ok(Self::of(record, self.read_from.clone()))
    }

    /// Scaled to a peak ground acceleration (m/s2).
    fn scaled_to_peak(&self, peak: &Bound<'_, PyAny>) -> PyResult<Self> {
        let peak = above_zero(peak, "peak", Dimension::ACCELERATION)?;
        let record = self.record.scaled_to_peak(peak).map_err(refused)?;
        Ok(Self::of(record, self.read_from.clone()))
    }

    /// The response spectrum at these periods (s): arrays by name.
    fn spectrum<'py>(
        &self,
        py: Python<'py>,
        periods: PyReadonlyArray1<'py, f64>,
        damping: &Bound<'py, PyAny>,
    ) -> PyResult<(f64, Bound<'py, PyDict>)> {
        let damping = quantity(damping, "damping", Dimension::NUMBER)?;
        let periods = periods.as_array().to_vec();
        let how = (damping, Evaluation::default());
        let spectrum = watched(py, None, |watch| {
            response_spectrum_while(&self.record, &periods, how, &|| !watch.stopped())
        })?;
        let spectrum = spectrum.map_err(refused_argument)?;
        let arrays = PyDict::new(py);
        for (name, values) in [
            ("displacement", spectrum.displacement),
            ("velocity", spectrum.velocity),
            ("acceleration", spectrum.acceleration),
            ("pseudo_velocity", spectrum.pseudo_velocity),
            ("pseudo_acceleration", spectrum.pseudo_acceleration),
        ] {
            arrays.set_item(name, values.into_pyarray(py))?;
        }
        Ok((damping, arrays))
    }

    /// Intensity measures, as JSON: what `pounding motion info --json` prints of them.
    fn measures_json(&self, py: Python<'_>, damping: &Bound<'_, PyAny>) -> PyResult<String> {
        if self.record.peak().value == 0.0 {
            let message = "the ground stands still: a record of zeros has no intensity measures";
            let help = "use another record or component, or check the unit".to_owned();
            let failure = Failure::input(message, Some(help));
            return Err(Problem::of_record(failure).into());
        }
        let start = self.record.initial().unwrap_or_default();
        let options = MeasureOptions {
            damping: quantity(damping, "damping", Dimension::NUMBER)?,
            initial_velocity: start.0,
            initial_displacement: start.1,
            ..MeasureOptions::default()
        };
        let measures = watched(py, None, |watch| {
            IntensityMeasures::of_while(&self.record, options, &|| !watch.stopped())
        })?;
        let measures = measures.map_err(refused_argument)?;
        Ok(json(&measures)?)
    }
}

/// Periods (s) evenly spaced in their logarithm.
#[pyfunction]
fn periods(
    py: Python<'_>,
    first: f64,
    last: f64,
    count: usize,
) -> Result<Bound<'_, PyArray1<f64>>, Problem> {
    let periods = logarithmic_periods(first, last, count).map_err(refused_argument)?;
    Ok(periods.into_pyarray(py))
}

/// Names and titles of the record formats, in the order in which they are tried.
#[pyfunction]
fn formats() -> Vec<(&'static str, &'static str)> {
    Format::all().iter().map(|f| (f.name, f.title)).collect()
}

/// What a motion that is read from a file is called if nothing else is said: as in commands.
#[pyfunction]
fn name_of_record(file: PathBuf) -> String {
    pounding_study::gap_check::name_of_record(&file)
}

/// Adds the classes and functions of this file.
pub fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<Motion>()?;
    module.add_function(wrap_pyfunction!(name_of_record, module)?)?;
    module.add_function(wrap_pyfunction!(periods, module)?)?;
    module.add_function(wrap_pyfunction!(formats, module)?)
}
