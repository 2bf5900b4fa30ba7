//! Case files of this crate, and their runs. Texts and record are part of the program.

use std::path::{Path, PathBuf};

use pounding_assembly::{AssemblyError, assemble, assemble_with_record};
use pounding_case::Case;
use pounding_ground_motion::{Accelerogram, GroundMotionError, ReadOptions, read_bytes};
use pounding_time_history::{GridRecorder, History, Impact, Outcome, run};

use crate::error::VerificationError;

/// Where these files lie in the sources.
const FOLDER: &str = "crates/verification/cases";

/// Records by the names of their files.
const RECORDS: [(&str, &[u8]); 2] = [
    (
        "el_centro_1940_ns.csv",
        include_bytes!(env!("POUNDING_EL_CENTRO")),
    ),
    ("at_rest.csv", include_bytes!("../../cases/at_rest.csv")),
];

/// A case file.
#[derive(Debug, Clone, Copy)]
pub(super) struct CaseFile {
    /// Name within the folder, without its ending.
    pub(super) name: &'static str,
    /// Text.
    pub(super) source: &'static str,
}

/// The case file of this name.
macro_rules! case_file {
    ($name:literal) => {
        $crate::structures::case_file::CaseFile {
            name: $name,
            source: include_str!(concat!("../../cases/", $name, ".toml")),
        }
    };
}
pub(super) use case_file;

/// A run of a case, with its responses on the grid of the case.
#[derive(Debug)]
pub(super) struct Run {
    name: &'static str,
    pub(super) outcome: Outcome,
    floors: usize,
    step: f64,
    history: History,
}

impl CaseFile {
    /// Where it lies in the sources.
    pub(super) fn path(&self) -> PathBuf {
        Path::new(FOLDER).join(format!("{}.toml", self.name))
    }

    /// Runs it.
    pub(super) fn run(&self) -> Result<Run, VerificationError> {
        let located = |error: AssemblyError| VerificationError::of_case(error, self.source);
        let case = Case::parse(self.source, &self.path()).map_err(|e| located(e.into()))?;
        let assembly = assemble_with_record(&case, &record(&case)?).map_err(located)?;
        let recorder = GridRecorder::new(assembly.output_step);
        let mut recorder = recorder.map_err(|e| located(e.into()))?;
        let (system, options) = (&assembly.system, &assembly.options);
        let outcome = run(system, options, &mut [&mut recorder], &mut |_| {});
        let outcome = outcome.map_err(|e| located(e.into()))?;
        Ok(Run {
            name: self.name,
            outcome,
            floors: system.floors(),
            step: assembly.output_step,
            history: recorder.responses,
        })
    }
}

/// The record that a case names, out of those that are part of the program.
fn record(case: &Case) -> Result<Accelerogram, GroundMotionError> {
    let file = &case.ground_motion.file.value;
    let of = |name: &str| file.file_name().is_some_and(|file| file == name);
    let (name, bytes) = RECORDS
        .into_iter()
        .find(|(name, _)| of(name))
        .ok_or_else(|| {
            GroundMotionError::Invalid(format!("no record {} in the program", file.display()))
        })?;
    read_bytes(name, bytes, &ReadOptions::default())
}

/// Runs a case of a user, whose record lies where it says.
pub(super) fn run_of_user(path: &Path) -> Result<Outcome, VerificationError> {
    let case = Case::read(path).map_err(|error| {
        // What can be read of it shows where it is wrong.
        let text = std::fs::read_to_string(path).unwrap_or_default();
        VerificationError::of_case(error, &text)
    })?;
    let located = |error: AssemblyError| VerificationError::of_case(error, &case.source);
    let assembly = assemble(&case).map_err(located)?;
    let outcome = run(&assembly.system, &assembly.options, &mut [], &mut |_| {});
    outcome.map_err(|e| located(e.into()))
}

impl Run {
    /// An impact, from 1, in order of closure.
    pub(super) fn impact(&self, number: usize) -> Result<&Impact, VerificationError> {
        let impacts = &self.outcome.impacts;
        let missing = || VerificationError::NoImpact {
            case: self.name,
            number,
            impacts: impacts.len(),
        };
        impacts.get(number.wrapping_sub(1)).ok_or_else(missing)
    }

    /// Displacement (m) of a floor at a time (s) of the grid; not a number off the grid.
    pub(super) fn displacement(&self, floor: usize, time: f64) -> f64 {
        let places = self.history.time.iter();
        let near = |t: &f64| (t - time).abs() < 1.0e-6 * self.step;
        let row = places.clone().position(near);
        let value = row.and_then(|row| self.history.displacement.get(row * self.floors + floor));
        value.copied().unwrap_or(f64::NAN)
    }
}
