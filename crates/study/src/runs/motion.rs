//! One motion of a study: read, and measured if the study scales.

use std::sync::Arc;

use pounding_assembly::read_record;
use pounding_ground_motion::Accelerogram;

use crate::error::StudyError;
use crate::gap_check::said_in_reading;
use crate::study_file::{IntensityMeasure, RecordKind};

/// A motion of a study.
#[derive(Debug, Clone)]
pub(crate) struct Motion {
    /// The motion as it was read; `None` where its hash and intensity are known from another
    /// process, and no run here needs more.
    pub record: Option<Arc<Accelerogram>>,
    /// Hash of the bytes of its file, or of its samples if it is synthetic.
    pub sha256: String,
    /// Name and hash of the first record of the study that is the same motion, or its own; empty
    /// until it is held against the others.
    pub first: String,
    /// Intensity as recorded, if the study scales to one.
    pub intensity: Option<f64>,
    /// Time of its peak acceleration (s).
    pub peak_time: f64,
    /// What was said when it was read.
    pub warnings: Vec<String>,
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
        RecordKind::Refused(error) => {
            return Err(StudyError::Text {
                error: error.clone(),
                source_text: String::new(),
            });
        }
    };
    let sha256 = match record.origin() {
        Some(origin) => origin.sha256.clone(),
        None => record.sha256(),
    };
    let mut warnings = said_in_reading(&record);
    if let RecordKind::Made { warnings: own, .. } = kind {
        warnings.extend(own.iter().cloned());
    }
    Ok(Motion {
        first: String::new(),
        intensity: measure.map(|m| m.of(&record)).transpose()?,
        peak_time: record.peak().time,
        warnings,
        record: Some(Arc::new(record)),
        sha256,
    })
}
