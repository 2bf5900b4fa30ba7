//! The HDF5 result of a run, netCDF-4 style: dimension scales, units, long names.
//!
//! The layout is described in `docs/result-file.md`. The file is written beside
//! its place as `<name>.part`, flushed to the disk, and renamed, so that a reader
//! never sees half of one.

mod dimension_scales;

use std::path::{Path, PathBuf};
use std::str::FromStr;

use hdf5::types::VarLenUnicode;
use hdf5::{Dataset, Group, H5Type, Location};
use sha2::{Digest, Sha256};

use crate::assemble::Assembly;
use crate::error::TimeHistoryError;
use crate::outcome::{Impact, Outcome, Peak, StoreyPeaks};
use crate::recorder::Sample;

/// Everything that goes into a result file.
#[derive(Debug, Clone, Copy)]
pub struct RunRecord<'a> {
    /// Title of the case.
    pub title: &'a str,
    /// The case's TOML text.
    pub case: &'a str,
    /// Program version.
    pub version: &'a str,
    /// System, options, record.
    pub assembly: &'a Assembly,
    /// Result of the run.
    pub outcome: &'a Outcome,
    /// Result of the same buildings without gaps.
    pub isolated: &'a Outcome,
    /// Responses on the output grid.
    pub samples: &'a [Sample],
    /// Wall-clock time of the run (s); the only value that two runs do not share.
    pub wall_time: f64,
}

/// Rows of a chunk: a few hundred kilobytes for tall buildings, few chunks for
/// short runs.
const CHUNK_ROWS: usize = 1024;

type Result<T> = hdf5::Result<T>;

/// Writes the result of a run.
///
/// # Errors
/// [`TimeHistoryError::ResultFile`] if the file cannot be written; nothing is
/// left under its name then.
pub fn write_result(
    path: &Path,
    record: &RunRecord<'_>,
) -> std::result::Result<(), TimeHistoryError> {
    let failed = |reason: String| TimeHistoryError::ResultFile {
        path: path.to_owned(),
        reason,
    };
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(".part");
    let part = path.with_file_name(name);
    let written = write(&part, record)
        .map_err(|e| e.to_string())
        .and_then(|()| publish(&part, path).map_err(|e| e.to_string()));
    written.map_err(|reason| {
        // The part file is worthless; if it cannot be removed, that is all the same.
        let _ = std::fs::remove_file(&part);
        failed(reason)
    })
}

fn publish(part: &PathBuf, path: &Path) -> std::io::Result<()> {
    std::fs::OpenOptions::new()
        .write(true)
        .open(part)?
        .sync_all()?;
    std::fs::rename(part, path)
}

fn write(path: &Path, record: &RunRecord<'_>) -> Result<()> {
    let file = hdf5::File::create(path)?;
    text(&file, "Conventions", "CF-1.10")?;
    text(&file, "title", record.title)?;
    text(&file, "program", "pounding")?;
    text(&file, "version", record.version)?;
    text(&file, "case", record.case)?;
    text(&file, "case_sha256", &sha256(record.case))?;
    let origin = record.assembly.accelerogram.origin();
    text(
        &file,
        "record_sha256",
        origin.map_or("", |o| o.sha256.as_str()),
    )?;
    text(&file, "status", "complete")?;
    let samples = record.samples;
    let time = series(&file, "time", "s", "time", &column(samples, |s| s.time))?;
    dimension_scales::make_scale(&time, "time")?;
    let ground = file.create_group("ground")?;
    let a = series(
        &ground,
        "acceleration",
        "m s-2",
        "ground acceleration",
        &column(samples, |s| s.ground_acceleration),
    )?;
    dimension_scales::attach(&a, &time, 0)?;
    buildings(&file, record, &time)?;
    gaps(&file, record, &time)?;
    energy(&file, record, &time)?;
    run(&file, record)?;
    file.flush()
}

fn buildings(file: &hdf5::File, record: &RunRecord<'_>, time: &Dataset) -> Result<()> {
    let all = file.create_group("building")?;
    let system = &record.assembly.system;
    for (index, building) in system.buildings().iter().enumerate() {
        let group = all.create_group(building.name())?;
        let range = system.offsets()[index]..system.offsets()[index + 1];
        let storey = series(
            &group,
            "storey",
            "m",
            "floor elevation above the ground",
            building.elevations(),
        )?;
        dimension_scales::make_scale(&storey, "storey")?;
        let table =
            |name: &str, units: &str, long_name: &str, pick: &dyn Fn(&Sample) -> Vec<f64>| {
                let rows: Vec<f64> = record.samples.iter().flat_map(pick).collect();
                let data = matrix(&group, name, units, long_name, &rows, range.len())?;
                dimension_scales::attach(&data, time, 0)?;
                dimension_scales::attach(&data, &storey, 1)
            };
        let drifts = |s: &Sample| -> Vec<f64> {
            let mut below = 0.0;
            s.displacement[range.clone()]
                .iter()
                .map(|u| u - std::mem::replace(&mut below, *u))
                .collect()
        };
        let scaled = |s: &Sample, by: &dyn Fn(usize) -> f64| -> Vec<f64> {
            drifts(s)
                .iter()
                .enumerate()
                .map(|(i, d)| d * by(i))
                .collect()
        };
        table(
            "displacement",
            "m",
            "floor displacement relative to the ground",
            &|s| s.displacement[range.clone()].to_vec(),
        )?;
        table(
            "velocity",
            "m s-1",
            "floor velocity relative to the ground",
            &|s| s.velocity[range.clone()].to_vec(),
        )?;
        table(
            "acceleration_absolute",
            "m s-2",
            "absolute floor acceleration",
            &|s| s.acceleration_absolute[range.clone()].to_vec(),
        )?;
        table(
            "drift_ratio",
            "1",
            "storey drift over storey height",
            &|s| scaled(s, &|i| 1.0 / building.height()[i]),
        )?;
        table("storey_shear", "N", "elastic storey shear", &|s| {
            scaled(s, &|i| building.stiffness()[i])
        })?;
        let peaks = group.create_group("peak")?;
        storey_peaks(
            &peaks,
            "",
            &record.outcome.buildings[index].storeys,
            &storey,
        )?;
        storey_peaks(
            &peaks,
            "isolated_",
            &record.isolated.buildings[index].storeys,
            &storey,
        )?;
        let modes = building.modes();
        let period = series(&group, "period", "s", "natural periods", &modes.period)?;
        dimension_scales::make_scale(&period, "mode")?;
        let ratio = series(
            &group,
            "damping_ratio",
            "1",
            "modal damping ratios",
            &modes.damping_ratio,
        )?;
        dimension_scales::attach(&ratio, &period, 0)?;
    }
    Ok(())
}

fn storey_peaks(
    group: &Group,
    prefix: &str,
    peaks: &[StoreyPeaks],
    storey: &Dataset,
) -> Result<()> {
    type Pick = fn(&StoreyPeaks) -> Peak;
    let quantities: [(&str, &str, Pick); 4] = [
        ("displacement", "m", |p| p.displacement),
        ("drift_ratio", "1", |p| p.drift_ratio),
        ("storey_shear", "N", |p| p.storey_shear),
        ("acceleration_absolute", "m s-2", |p| {
            p.acceleration_absolute
        }),
    ];
    let without = if prefix.is_empty() {
        ""
    } else {
        " without pounding"
    };
    for (name, units, pick) in quantities {
        let values: Vec<f64> = peaks.iter().map(|p| pick(p).value).collect();
        let times: Vec<f64> = peaks.iter().map(|p| pick(p).time).collect();
        let label = name.replace('_', " ");
        let value = series(
            group,
            &format!("{prefix}{name}"),
            units,
            &format!("peak absolute {label}{without}"),
            &values,
        )?;
        let time = series(
            group,
            &format!("{prefix}{name}_time"),
            "s",
            &format!("time of peak {label}{without}"),
            &times,
        )?;
        dimension_scales::attach(&value, storey, 0)?;
        dimension_scales::attach(&time, storey, 0)?;
    }
    Ok(())
}

/// One impact as a row of the compound table.
#[derive(Debug, Clone, Copy, H5Type)]
#[repr(C)]
struct ImpactRow {
    level: u64,
    t_close: f64,
    t_open: f64,
    approach_velocity: f64,
    separation_velocity: f64,
    achieved_restitution: f64,
    peak_force: f64,
    peak_force_time: f64,
    peak_penetration: f64,
    impulse: f64,
    energy_dissipated: f64,
    constants: [f64; 4],
}

impl ImpactRow {
    fn new(impact: &Impact) -> Self {
        Self {
            level: impact.level as u64 + 1,
            t_close: impact.time_closed,
            t_open: impact.time_opened,
            approach_velocity: impact.approach_velocity,
            separation_velocity: impact.separation_velocity,
            achieved_restitution: impact.achieved_restitution,
            peak_force: impact.peak_force.value,
            peak_force_time: impact.peak_force.time,
            peak_penetration: impact.peak_penetration.value,
            impulse: impact.impulse,
            energy_dissipated: impact.energy_dissipated,
            constants: std::array::from_fn(|i| impact.constants.get(i).copied().unwrap_or(0.0)),
        }
    }
}

fn gaps(file: &hdf5::File, record: &RunRecord<'_>, time: &Dataset) -> Result<()> {
    let all = file.create_group("gap")?;
    let system = &record.assembly.system;
    for (index, gap) in system.gaps().iter().enumerate() {
        let group = all.create_group(&gap.name)?;
        let range = gap.first_level..gap.first_level + gap.levels;
        let levels = &system.levels()[range.clone()];
        let elevation: Vec<f64> = levels.iter().map(|l| l.elevation).collect();
        let level = series(
            &group,
            "level",
            "m",
            "elevation of the contact level",
            &elevation,
        )?;
        dimension_scales::make_scale(&level, "level")?;
        let width: Vec<f64> = levels.iter().map(|l| l.width).collect();
        dimension_scales::attach(
            &series(&group, "width", "m", "width of the gap at rest", &width)?,
            &level,
            0,
        )?;
        let table =
            |name: &str, units: &str, long_name: &str, pick: &dyn Fn(&Sample) -> Vec<f64>| {
                let rows: Vec<f64> = record.samples.iter().flat_map(pick).collect();
                let data = matrix(&group, name, units, long_name, &rows, range.len())?;
                dimension_scales::attach(&data, time, 0)?;
                dimension_scales::attach(&data, &level, 1)
            };
        table(
            "penetration",
            "m",
            "penetration, negative while the gap is open",
            &|s| s.penetration[range.clone()].to_vec(),
        )?;
        table("force", "N", "contact force, positive pushes apart", &|s| {
            s.force[range.clone()].to_vec()
        })?;
        let rows: Vec<ImpactRow> = record
            .outcome
            .impacts
            .iter()
            .filter(|i| i.gap == index)
            .map(ImpactRow::new)
            .collect();
        let impacts = group
            .new_dataset::<ImpactRow>()
            .shape(rows.len())
            .create("impacts")?;
        if !rows.is_empty() {
            impacts.write_raw(&rows)?;
            let numbers: Vec<f64> = (1..=rows.len()).map(|i| i as f64).collect();
            let number = series(&group, "impact", "1", "number of the impact", &numbers)?;
            dimension_scales::make_scale(&number, "impact")?;
            dimension_scales::attach(&impacts, &number, 0)?;
        }
        text(
            &impacts,
            "long_name",
            "impacts in order of closure; levels from 1, bottom first; SI units",
        )?;
        if let Some(first) = levels.first() {
            let names: Vec<_> = first
                .model
                .descriptor()
                .constants
                .iter()
                .map(|c| c.name)
                .collect();
            text(&impacts, "constants", &names.join(", "))?;
            text(&group, "model", first.model.descriptor().name)?;
            text(&group, "separation", first.model.separation().name())?;
        }
        text(&group, "between", &gap.between.join(" | "))?;
    }
    Ok(())
}

fn energy(file: &hdf5::File, record: &RunRecord<'_>, time: &Dataset) -> Result<()> {
    let group = file.create_group("energy")?;
    type Pick = fn(&Sample) -> f64;
    let entries: [(&str, &str, Pick); 7] = [
        (
            "input",
            "work of the ground motion, relative formulation",
            |s| s.energy.input,
        ),
        ("kinetic", "kinetic energy relative to the ground", |s| {
            s.energy.kinetic
        }),
        (
            "strain",
            "recoverable energy of storeys and contacts",
            |s| s.energy.strain,
        ),
        ("viscous", "dissipated by viscous damping", |s| {
            s.energy.viscous
        }),
        ("hysteretic", "dissipated by yielding", |s| {
            s.energy.hysteretic
        }),
        ("impact", "dissipated in contacts", |s| s.energy.impact),
        ("residual", "what the ledger misses", |s| s.energy.residual),
    ];
    for (name, long_name, pick) in entries {
        let data = series(&group, name, "J", long_name, &column(record.samples, pick))?;
        dimension_scales::attach(&data, time, 0)?;
    }
    let ratio = group.new_attr::<f64>().create("residual_ratio")?;
    ratio.write_scalar(&record.outcome.energy.residual_ratio)
}

fn run(file: &hdf5::File, record: &RunRecord<'_>) -> Result<()> {
    let group = file.create_group("run")?;
    text(&group, "method", record.outcome.method.title)?;
    let warnings = &record.outcome.warnings;
    text(&group, "warnings", &warnings.join("\n"))?;
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

fn column(samples: &[Sample], pick: impl Fn(&Sample) -> f64) -> Vec<f64> {
    samples.iter().map(pick).collect()
}

/// A one-dimensional dataset with units and long name.
fn series(
    group: &Group,
    name: &str,
    units: &str,
    long_name: &str,
    values: &[f64],
) -> Result<Dataset> {
    let builder = group.new_dataset::<f64>();
    let data = if values.is_empty() {
        builder.shape(0).create(name)?
    } else {
        let rows = CHUNK_ROWS.min(values.len());
        builder
            .chunk(rows)
            .shuffle()
            .deflate(1)
            .shape(values.len())
            .create(name)?
    };
    if !values.is_empty() {
        data.write_raw(values)?;
    }
    describe(&data, units, long_name)?;
    Ok(data)
}

/// A dataset of rows by columns with units and long name.
fn matrix(
    group: &Group,
    name: &str,
    units: &str,
    long_name: &str,
    values: &[f64],
    columns: usize,
) -> Result<Dataset> {
    let rows = values.len() / columns.max(1);
    let data = group
        .new_dataset::<f64>()
        .chunk((CHUNK_ROWS.min(rows).max(1), columns.max(1)))
        .shuffle()
        .deflate(1)
        .shape((rows, columns))
        .create(name)?;
    data.write_raw(values)?;
    describe(&data, units, long_name)?;
    Ok(data)
}

fn describe(data: &Dataset, units: &str, long_name: &str) -> Result<()> {
    text(data, "units", units)?;
    text(data, "long_name", long_name)
}

/// A UTF-8 text attribute.
fn text(location: &Location, name: &str, value: &str) -> Result<()> {
    let value = VarLenUnicode::from_str(value)
        .map_err(|e| hdf5::Error::from(format!("attribute {name}: {e}")))?;
    location
        .new_attr::<VarLenUnicode>()
        .create(name)?
        .write_scalar(&value)
}

fn sha256(text: &str) -> String {
    Sha256::digest(text.as_bytes())
        .iter()
        .map(|b| format!("{b:02x}"))
        .collect()
}
