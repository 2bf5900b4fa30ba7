//! The motions of a study: read once.

use std::collections::BTreeSet;
use std::path::Path;

use super::motion::{Motion, motion};
use super::shared_records::{self, SharedRecords};
use crate::error::StudyError;
use crate::gap_check::Shape;
use crate::study_file::{RecordKind, RecordSource, Study};

/// All motions; those that cannot be read with the reason.
#[derive(Debug, Clone)]
pub(crate) struct Motions {
    pub all: Vec<Result<Motion, String>>,
}

/// A motion of a study, for tables.
#[derive(Debug, Clone, PartialEq)]
pub struct RecordReport {
    /// Name in the results.
    pub name: String,
    /// SHA-256 of its bytes.
    pub sha256: String,
    /// Intensity as recorded (SI), if the study scales to one.
    pub intensity: Option<f64>,
}

impl Motions {
    /// Reads all motions of a study, but those that a folder of shared records knows: of these
    /// the hash and the intensity are enough until a run needs them. The folder is given what it
    /// does not know.
    ///
    /// # Errors
    /// [`StudyError::Records`] if there are some that cannot be read, unless they are to
    /// be kept as failures; a folder that cannot be written to.
    pub(crate) fn read(
        study: &Study,
        keep_failures: bool,
        folder: Option<&Path>,
    ) -> Result<Self, StudyError> {
        let mut shared = folder
            .map(|folder| SharedRecords::open(folder, study))
            .transpose()?;
        let known = |source: &RecordSource| shared.as_ref().and_then(|s| s.known(source));
        let all = study.records.iter().map(|source| match known(source) {
            Some(known) => Ok(known),
            None => read(&source.kind, study),
        });
        let mut motions = Self { all: all.collect() };
        motions.check(study, keep_failures)?;
        motions.find_copies(&study.records);
        if let Some(shared) = &mut shared {
            shared.add(&study.records, &motions.all)?;
        }
        Ok(motions)
    }

    /// Finds the first record of each motion, as far as they were read: those that another process
    /// has read it has held against one another.
    fn find_copies(&mut self, sources: &[RecordSource]) {
        let read = |motion: &Result<Motion, String>| motion.as_ref().ok()?.record.clone();
        let records: Vec<_> = self.all.iter().map(read).collect();
        let mut firsts: Vec<(String, Shape<'_>)> = Vec::new();
        for ((motion, record), source) in self.all.iter_mut().zip(&records).zip(sources) {
            let (Ok(motion), Some(record)) = (motion, record) else {
                continue;
            };
            let shape = match &source.kind {
                RecordKind::File { .. } => Shape::of(record),
                RecordKind::Made { .. } | RecordKind::Refused(_) => Shape::of_generated(record),
            };
            motion.first = match firsts.iter().find(|(_, first)| first.is_that_of(&shape)) {
                Some((first, _)) => first.clone(),
                None => {
                    let own = format!("{} {}", source.name, motion.sha256);
                    firsts.push((own.clone(), shape));
                    own
                }
            };
        }
    }

    /// Reads those that runs need and that were only known until now.
    ///
    /// # Errors
    /// As [`read`](Self::read); a record that has changed since its hash was taken.
    pub(crate) fn need(
        &mut self,
        study: &Study,
        wanted: &BTreeSet<usize>,
        keep_failures: bool,
        folder: Option<&Path>,
    ) -> Result<(), StudyError> {
        for number in wanted {
            let Ok(known) = &self.all[*number] else {
                continue;
            };
            if known.record.is_some() {
                continue;
            }
            let source = &study.records[*number];
            let copy = folder.and_then(|f| shared_records::copy(f, source, &known.sha256));
            let made = read(copy.as_ref().unwrap_or(&source.kind), study);
            self.all[*number] = match made {
                Ok(made) if made.sha256 != known.sha256 => Err(format!(
                    "it has changed since the study was begun (SHA-256 {}, now {})",
                    known.sha256, made.sha256
                )),
                made => made.map(|made| Motion {
                    first: known.first.clone(),
                    ..made
                }),
            };
        }
        self.check(study, keep_failures)
    }

    fn check(&self, study: &Study, keep_failures: bool) -> Result<(), StudyError> {
        let pairs = self.all.iter().zip(&study.records);
        let failed: Vec<_> = pairs
            .filter_map(|(m, s)| Some((m.as_ref().err()?, s)))
            .collect();
        if failed.is_empty() || keep_failures {
            return Ok(());
        }
        // Those that are not there at the places that name them.
        let others = failed.iter().filter(|(_, source)| source.missing.is_none());
        let list: Vec<_> = others.map(|(e, s)| format!("  {}: {e}", s.name)).collect();
        let unread = (!list.is_empty()).then(|| StudyError::Records {
            count: list.len(),
            of: self.all.len(),
            list: list.join("\n"),
        });
        let missing = study.missing_of(failed.iter().map(|(_, source)| *source));
        Err(StudyError::of_all(
            missing.into_iter().chain(unread).collect(),
        ))
    }
}

/// Reads a motion of a study.
fn read(kind: &RecordKind, study: &Study) -> Result<Motion, String> {
    motion(kind, study.measure()).map_err(|e| e.to_string())
}
