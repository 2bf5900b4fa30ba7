//! The HDF5 result of a run, netCDF-4 style: dimension scales, units, long names.
//!
//! The layout is described in `docs/result-file.md`. The file is written as a
//! part file beside its place, so that a reader never sees half of one.

mod buildings;
mod datasets;
mod elements;
mod gaps;
mod levels;

use std::path::{Path, PathBuf};

use hdf5::{Dataset, Group};
use pounding_files::{PartFile, checksum};
use pounding_ground_motion::Accelerogram;
use pounding_time_history::{Energy, History, Outcome, System};
use sha2::{Digest, Sha256};

use crate::{CHECKSUM, CHECKSUM_FORM, dimension_scales};
use datasets::{series, text};

/// Everything that goes into a result file.
#[derive(Debug, Clone, Copy)]
pub struct RunRecord<'a> {
    /// Title of the case.
    pub title: &'a str,
    /// The case's TOML text.
    pub case: &'a str,
    /// Program version.
    pub version: &'a str,
    /// What the program was built of and for.
    pub build: &'a str,
    /// Buildings, gaps, links.
    pub system: &'a System,
    /// The record, scaled, with its origin.
    pub accelerogram: &'a Accelerogram,
    /// Warnings of the record and of the run.
    pub warnings: &'a [String],
    /// Result of the run.
    pub outcome: &'a Outcome,
    /// Result of the same buildings without gaps.
    pub isolated: &'a Outcome,
    /// Responses on the output grid.
    pub history: &'a History,
    /// Wall-clock time of the run (s); the only value that two runs do not share.
    pub wall_time: f64,
}

/// A result file that could not be written.
#[derive(Debug, thiserror::Error)]
#[error("cannot write {path}: {reason}")]
pub struct WriteError {
    /// The file asked for.
    pub path: PathBuf,
    /// What the file system or HDF5 said.
    pub reason: String,
}

impl WriteError {
    /// What to try.
    #[must_use]
    pub fn help(&self) -> String {
        "check that the folder exists, may be written to and has room, or name another file with -o"
            .to_owned()
    }
}

type Result<T> = hdf5::Result<T>;

/// Writes the result of a run.
///
/// # Errors
/// [`WriteError`] if the file cannot be written; what stood under its name before is
/// untouched then.
pub fn write_result(path: &Path, record: &RunRecord<'_>) -> std::result::Result<(), WriteError> {
    let failed = |reason: String| WriteError {
        path: path.to_owned(),
        reason,
    };
    let part = PartFile::beside(path).map_err(|e| failed(e.to_string()))?;
    write(part.path(), record).map_err(|e| failed(e.to_string()))?;
    checksum::append(part.path()).map_err(|e| failed(e.to_string()))?;
    part.finish().map_err(|e| failed(e.to_string()))
}

fn write(path: &Path, record: &RunRecord<'_>) -> Result<()> {
    let file = hdf5::File::create(path)?;
    text(&file, "Conventions", "CF-1.10")?;
    text(&file, "title", record.title)?;
    text(&file, "program", "pounding")?;
    text(&file, "version", record.version)?;
    text(&file, "build", record.build)?;
    text(&file, CHECKSUM, CHECKSUM_FORM)?;
    text(&file, "case", record.case)?;
    text(&file, "case_sha256", &sha256(record.case))?;
    let origin = record.accelerogram.origin();
    text(
        &file,
        "record_sha256",
        origin.map_or("", |o| o.sha256.as_str()),
    )?;
    text(&file, "status", "complete")?;
    let history = record.history;
    let time = series(&file, "time", "s", "time", &history.time)?;
    dimension_scales::make_scale(&time, "time")?;
    let ground = file.create_group("ground")?;
    share_time(&ground)?;
    let a = series(
        &ground,
        "acceleration",
        "m s-2",
        "ground acceleration",
        &history.ground_acceleration,
    )?;
    dimension_scales::attach(&a, &time, 0)?;
    // A text here ends at a NUL, which titles of damaged headers may have.
    let echo = record.accelerogram.echo().join("\n");
    text(&ground, "record", &echo.replace('\0', " "))?;
    buildings::buildings(&file, record, &time)?;
    gaps::gaps(&file, record, &time)?;
    elements::links(&file, record, &time)?;
    energy(&file, record, &time)?;
    run(&file, record)?;
    file.flush()
}

/// Puts the output times into a group, by a second name of the dataset `/time`: readers that
/// open one group, as xarray does, look for the coordinates of its dimensions in it alone.
fn share_time(group: &Group) -> Result<()> {
    group.link_hard("/time", "time")
}

fn energy(file: &hdf5::File, record: &RunRecord<'_>, time: &Dataset) -> Result<()> {
    let group = file.create_group("energy")?;
    share_time(&group)?;
    type Pick = fn(&Energy) -> f64;
    let entries: [(&str, &str, Pick); 7] = [
        (
            "input",
            "work of the ground motion, relative formulation",
            |e| e.input,
        ),
        ("kinetic", "kinetic energy relative to the ground", |e| {
            e.kinetic
        }),
        (
            "strain",
            "recoverable energy of storeys, links and contacts",
            |e| e.strain,
        ),
        ("viscous", "dissipated by viscous damping", |e| e.viscous),
        (
            "hysteretic",
            "dissipated by storeys with laws and by links",
            |e| e.hysteretic,
        ),
        ("impact", "dissipated in contacts", |e| e.impact),
        ("residual", "what the ledger misses", |e| e.residual),
    ];
    for (name, long_name, pick) in entries {
        let values: Vec<f64> = record.history.energy.iter().map(pick).collect();
        let data = series(&group, name, "J", long_name, &values)?;
        dimension_scales::attach(&data, time, 0)?;
    }
    let ratio = group.new_attr::<f64>().create("residual_ratio")?;
    ratio.write_scalar(&record.outcome.energy.residual_ratio)
}

fn run(file: &hdf5::File, record: &RunRecord<'_>) -> Result<()> {
    let group = file.create_group("run")?;
    text(&group, "method", record.outcome.method.title)?;
    text(
        &group,
        "warnings",
        &record.warnings.join("\n").replace('\0', " "),
    )?;
    let statistics = record.outcome.statistics;
    for (name, value) in [
        ("steps", statistics.steps),
        ("rejected", statistics.rejected),
        ("events", statistics.events),
        ("location_steps", statistics.location_steps),
        ("evaluations", statistics.evaluations),
        ("newton_iterations", statistics.newton_iterations),
    ] {
        group.new_attr::<u64>().create(name)?.write_scalar(&value)?;
    }
    let wall = group.new_attr::<f64>().create("wall_time")?;
    wall.write_scalar(&record.wall_time)
}

fn sha256(text: &str) -> String {
    Sha256::digest(text.as_bytes())
        .iter()
        .map(|b| format!("{b:02x}"))
        .collect()
}
