//! The motions of a study: read once.

use std::sync::Arc;

use pounding_assembly::read_record;
use pounding_ground_motion::Accelerogram;
use sha2::{Digest, Sha256};

use crate::error::StudyError;
use crate::study_file::{IntensityMeasure, RecordKind, Study, Target};
use pounding_files::checksum::hexadecimal;

/// A motion as it was read.
#[derive(Debug, Clone)]
pub(crate) struct Motion {
    pub record: Arc<Accelerogram>,
    /// Hash of the bytes of its file, or of its samples if it is synthetic.
    pub sha256: String,
    /// Intensity as recorded, if the study scales to one.
    pub intensity: Option<f64>,
}

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
    /// Reads all motions of a study.
    ///
    /// # Errors
    /// [`StudyError::Records`] if there are some that cannot be read, unless they are to
    /// be kept as failures.
    pub(crate) fn read(study: &Study, keep_failures: bool) -> Result<Self, StudyError> {
        let measure = study.variables.iter().find_map(|v| match &v.target {
            Target::Intensity(measure) => Some(measure),
            _ => None,
        });
        let all: Vec<_> = study
            .records
            .iter()
            .map(|source| motion(&source.kind, measure).map_err(|e| e.to_string()))
            .collect();
        let failed: Vec<String> = all
            .iter()
            .zip(&study.records)
            .filter_map(|(m, s)| m.as_ref().err().map(|e| format!("  {}: {e}", s.name)))
            .collect();
        if failed.is_empty() || (keep_failures && failed.len() < all.len()) {
            return Ok(Self { all });
        }
        Err(StudyError::Records {
            count: failed.len(),
            of: all.len(),
            list: failed.join("\n"),
        })
    }
}

/// Reads a motion, and measures it if the study scales.
///
/// # Errors
/// One that cannot be read or measured.
pub(crate) fn motion(
    kind: &RecordKind,
    measure: Option<&IntensityMeasure>,
) -> Result<Motion, StudyError> {
    let record = match kind {
        RecordKind::File { case, .. } => read_record(case)?,
        RecordKind::Made { record, .. } => (**record).clone(),
    };
    let sha256 = match record.origin() {
        Some(origin) => origin.sha256.clone(),
        None => {
            let mut hash = Sha256::new();
            hash.update(record.time_step().to_le_bytes());
            for a in record.samples() {
                hash.update(a.to_le_bytes());
            }
            hexadecimal(&hash.finalize())
        }
    };
    Ok(Motion {
        intensity: measure.map(|m| m.of(&record)).transpose()?,
        record: Arc::new(record),
        sha256,
    })
}
