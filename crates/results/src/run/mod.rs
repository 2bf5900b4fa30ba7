//! The HDF5 result of a run, netCDF-4 style: dimension scales, units, long names.
//!
//! The layout is described in `docs/reference/result-file.md`. The file is written as a
//! part file beside its place while the run goes on, so that memory does not grow with the
//! duration, and a reader never sees half of it.

mod buildings;
mod datasets;
mod elements;
mod frames;
mod gaps;
mod levels;
mod memory;
mod responses;
mod size;
mod tables;

use std::path::{Path, PathBuf};

use hdf5::Group;
use pounding_files::{PartFile, PlaceTaken, checksum};
use pounding_ground_motion::Accelerogram;
use pounding_shear_building::NameError;
use pounding_time_history::{Energy, History, HistorySink, Outcome, System, TimeHistoryError};
use sha2::{Digest, Sha256};

use crate::attributes::{self, text};
use crate::dimension_scales;
use crate::{label, reason_of};
pub(crate) use buildings::with_base_moment;
pub use memory::{image, run_in_memory, write_run};
pub use size::{MAXIMUM_RESPONSES, ResponsesTooLarge, check_size, response_bytes};
use tables::{Content, Tables};

/// What is known of a run before it begins.
#[derive(Debug, Clone, Copy)]
pub struct RunHead<'a> {
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
}

impl RunHead<'_> {
    /// SHA-256 of the text of the case, by which the results of cases that were read from no file are told apart.
    #[must_use]
    pub fn case_sha256(&self) -> String {
        checksum::hexadecimal(&Sha256::digest(self.case))
    }
}

/// What is known of a run when it has ended.
#[derive(Debug, Clone, Copy)]
pub struct RunEnding<'a> {
    /// Result of the run.
    pub outcome: &'a Outcome,
    /// Result of the same buildings without gaps.
    pub isolated: &'a Outcome,
    /// Warnings of the record and of the run.
    pub warnings: &'a [String],
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
    /// What to do where neither folder nor disk is at fault: where the file stands whole under another
    /// name, and of names that cannot stand in it.
    pub aside: Option<String>,
}

impl WriteError {
    /// What to try.
    #[must_use]
    pub fn help(&self) -> String {
        let elsewhere = "check that the folder exists, may be written to and has room, or name another file with -o";
        self.aside.clone().unwrap_or_else(|| elsewhere.to_owned())
    }
}

type Result<T> = hdf5::Result<T>;

/// Writes the result of a run: responses while it goes on, as the [`HistorySink`] of a
/// [`GridRecorder`](pounding_time_history::GridRecorder), all else at its end.
///
/// Dropped before [`finish`](Self::finish), it leaves nothing behind, and what stood under
/// the name of the result is untouched.
pub struct RunWriter<'a> {
    system: &'a System,
    path: PathBuf,
    file: hdf5::File,
    tables: Tables,
    label: String,
    failure: Option<String>,
    /// Dropped after the file, which writes into it.
    part: PartFile,
}

impl<'a> RunWriter<'a> {
    /// Begins a result file.
    ///
    /// # Errors
    /// [`WriteError`] if the file cannot be written, or names of the system cannot stand in it
    /// ([`System::check_names`]).
    pub fn begin(path: &Path, head: &RunHead<'a>) -> std::result::Result<Self, WriteError> {
        let failed = |reason: String| WriteError {
            path: path.to_owned(),
            reason,
            aside: None,
        };
        head.system.check_names().map_err(|e| WriteError {
            aside: Some(NameError::HELP.to_owned()),
            ..failed(e.to_string())
        })?;
        let part = PartFile::beside(path).map_err(|e| failed(e.to_string()))?;
        // A link may lead from a name that HDF5 takes to a folder of one that it does not.
        if part.path().to_str().is_none() {
            return Err(WriteError {
                aside: Some(
                    "name it in a folder whose path is UTF-8: HDF5 opens no other".to_owned(),
                ),
                ..failed(format!("{} is not UTF-8", part.path().display()))
            });
        }
        let (file, tables) = begin(part.path(), head).map_err(|e| failed(reason_of(&e)))?;
        Ok(Self {
            system: head.system,
            path: path.to_owned(),
            file,
            tables,
            label: label::of_run_without_file(&head.case_sha256()),
            failure: None,
            part,
        })
    }

    /// Says of which case file the result is, as seen from the current folder.
    #[must_use]
    pub fn of_case_file(mut self, case: &Path) -> Self {
        self.label = label::of_run(&pounding_files::label::seen_from_here(case));
        self
    }

    /// What kept responses from being written, and so ended the run.
    #[must_use]
    pub fn failure(&self) -> Option<WriteError> {
        let reason = self.failure.clone()?;
        let path = self.path.clone();
        Some(WriteError {
            path,
            reason,
            aside: None,
        })
    }

    /// Takes responses that are in memory already, all of the run.
    fn take_all(&mut self, history: &History) -> std::result::Result<(), WriteError> {
        self.tables.write_rows(history).map_err(|e| WriteError {
            path: self.path.clone(),
            reason: reason_of(&e),
            aside: None,
        })
    }

    /// Adds peaks, impacts and statistics, brings the file to the disk and puts it in its
    /// place.
    ///
    /// # Errors
    /// [`WriteError`] if the file cannot be written, or not under its name; what stood there before
    /// is untouched then.
    pub fn finish(self, ending: &RunEnding<'_>) -> std::result::Result<(), WriteError> {
        let Self {
            system,
            path,
            file,
            mut tables,
            label,
            part,
            ..
        } = self;
        let written = tables
            .write()
            .and_then(|()| finish(&file, system, ending))
            .and_then(|()| file.flush());
        // HDF5 closes a file when its last dataset is closed.
        drop((tables, file));
        let failed = |reason: String, aside| WriteError {
            path,
            reason,
            aside,
        };
        if let Err(e) = written {
            return Err(failed(reason_of(&e), None));
        }
        pounding_files::label::append(part.path(), &label)
            .and_then(|()| checksum::append(part.path()))
            .and_then(|()| part.finish())
            .map_err(|e| failed(e.to_string(), PlaceTaken::of(&e).map(PlaceTaken::help)))
    }
}

impl HistorySink for RunWriter<'_> {
    /// [`check_size`] counts the numbers that stand in the file, which are not quite those of the rows.
    fn most_bytes(&self) -> f64 {
        f64::INFINITY
    }

    fn take(&mut self, rows: &mut History) -> std::result::Result<(), TimeHistoryError> {
        self.tables.take(rows).map_err(|e| {
            let failure = self.failure.insert(reason_of(&e));
            TimeHistoryError::Recorder(failure.clone())
        })
    }
}

fn begin(path: &Path, head: &RunHead<'_>) -> Result<(hdf5::File, Tables)> {
    let file = crate::hdf5_file::create(path)?;
    let tables = begin_in(&file, head)?;
    Ok((file, tables))
}

/// What is known before the run, and the datasets that grow.
fn begin_in(file: &hdf5::File, head: &RunHead<'_>) -> Result<Tables> {
    attributes::head(file, head.title, head.version, head.build)?;
    text(file, "case", head.case)?;
    text(file, "case_sha256", &head.case_sha256())?;
    let origin = head.accelerogram.origin();
    text(
        file,
        "record_sha256",
        origin.map_or("", |o| o.sha256.as_str()),
    )?;
    let system = head.system;
    let mut tables = Tables::new(size::numbers(system));
    let time = Content::Number(|h| &h.time);
    let time = tables.add(file, ("time", "s", "time"), time)?;
    dimension_scales::make_scale(&time, "time")?;
    let ground = file.create_group("ground")?;
    share_time(&ground)?;
    let acceleration = Content::Number(|h| &h.ground_acceleration);
    let names = ("acceleration", "m s-2", "ground acceleration");
    let acceleration = tables.add(&ground, names, acceleration)?;
    dimension_scales::attach(&acceleration, &time, 0)?;
    let mut excitation = head.accelerogram.echo();
    excitation.extend(system.further_excitation());
    text(&ground, "record", &excitation.join("\n"))?;
    buildings::begin(file, system, &mut tables, &time)?;
    gaps::begin(file, system, &mut tables, &time)?;
    elements::begin_links(file, system, &mut tables, &time)?;
    let energy = file.create_group("energy")?;
    share_time(&energy)?;
    for part in Energy::PARTS {
        let names = (part.name, "J", part.description);
        let data = tables.add(&energy, names, Content::Energy(part.value))?;
        dimension_scales::attach(&data, &time, 0)?;
    }
    Ok(tables)
}

fn finish(file: &hdf5::File, system: &System, ending: &RunEnding<'_>) -> Result<()> {
    buildings::finish(file, system, ending)?;
    gaps::finish(file, system, ending.outcome)?;
    elements::finish_links(file, system, ending.outcome)?;
    let ratio = file.group("energy")?.new_attr::<f64>();
    let ratio = ratio.create("residual_ratio")?;
    ratio.write_scalar(&ending.outcome.energy.residual_ratio)?;
    run(file, ending)?;
    text(file, "status", "complete")
}

/// Puts the output times into a group, by a second name of the dataset `/time`: readers that
/// open one group, as xarray does, look for the coordinates of its dimensions in it alone.
fn share_time(group: &Group) -> Result<()> {
    group.link_hard("/time", "time")
}

fn run(file: &hdf5::File, ending: &RunEnding<'_>) -> Result<()> {
    let group = file.create_group("run")?;
    text(&group, "method", ending.outcome.method.title)?;
    text(&group, "warnings", &ending.warnings.join("\n"))?;
    let statistics = ending.outcome.statistics;
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
    wall.write_scalar(&ending.wall_time)
}
