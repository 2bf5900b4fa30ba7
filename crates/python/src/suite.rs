//! Records under which studies put a case: motions in memory, files, and folders of files.

use std::path::PathBuf;
use std::sync::Arc;

use pounding_case::Case;
use pounding_cli::Failure;
use pounding_cli::answers::of_check;
use pounding_ground_motion::Accelerogram;
use pounding_study::gap_check::{
    CaseUnderRecord, CheckError, distinct_names, given_once, name_of_record, record_files,
    under_record, under_records,
};
use pyo3::prelude::*;

use crate::case::{PyCase, under_motion};
use crate::errors::{Problem, warn};
use crate::motion::Motion;

/// Records with names that are distinct, in their order; those of the case itself without any.
pub struct Suite(Vec<(String, Record)>);

/// A motion in memory, or a file.
enum Record {
    Motion(Arc<Accelerogram>),
    File(PathBuf),
}

impl Suite {
    /// Motions and paths as Python gives them, each with its name, which is empty for that of the file. Warns of
    /// files in folders that are no records, as the command line says it.
    pub fn of(
        py: Python<'_>,
        case: &PyCase,
        given: Vec<(String, Bound<'_, PyAny>)>,
    ) -> PyResult<Self> {
        let wrong = |error: CheckError| case.problem(of_check(error, &case.case));
        let (mut names, mut records, mut skipped) = (Vec::new(), Vec::new(), Vec::new());
        for (name, value) in given {
            if let Ok(motion) = value.cast::<Motion>() {
                let motion = &motion.get().record;
                let is_it = |r: &Record| matches!(r, Record::Motion(m) if Arc::ptr_eq(m, motion));
                if records.iter().any(is_it) {
                    return Err(wrong(CheckError::record_given_twice(&name)).into());
                }
                names.push(name);
                records.push(Record::Motion(Arc::clone(motion)));
                continue;
            }
            let path: PathBuf = value.extract()?;
            let found = record_files(std::slice::from_ref(&path)).map_err(wrong)?;
            skipped.extend(found.skipped);
            // Several of a folder have the names of their files.
            let is_named = !name.is_empty() && found.files.len() == 1;
            for file in found.files {
                names.push(match is_named {
                    true => name.clone(),
                    false => name_of_record(&file),
                });
                records.push(Record::File(file));
            }
        }
        let files = records.iter().filter_map(|record| match record {
            Record::File(file) => Some(file.clone()),
            Record::Motion(_) => None,
        });
        given_once(&files.collect::<Vec<_>>()).map_err(wrong)?;
        for file in skipped {
            warn(py, &file.to_string(), 2)?;
        }
        let named = distinct_names(names).into_iter().zip(records);
        Ok(Self(named.collect()))
    }

    /// The case under each of them.
    ///
    /// # Errors
    /// A case or a record that cannot be used.
    pub fn under(&self, case: &PyCase) -> Result<Vec<CaseUnderRecord>, Problem> {
        let of = |error: CheckError| case.problem(of_check(error, &case.case));
        if self.0.is_empty() {
            if case.motion.is_none() {
                return under_records(&case.case, &[]).map_err(of);
            }
            return Ok(vec![CaseUnderRecord {
                name: case.motion_name.clone(),
                file: PathBuf::new(),
                assembly: case.assembly()?,
            }]);
        }
        let each = self.0.iter().map(|(name, record)| match record {
            Record::File(file) => under_record(&case.case, file.clone(), name.clone()).map_err(of),
            Record::Motion(record) => {
                let mut other = Case::clone(&case.case);
                // As with records of files: for their own durations.
                other.analysis.duration = None;
                let assembly = under_motion(&other, record)
                    .map_err(|e| case.problem(Failure::of_case(e, &other).within(name)))?;
                Ok(CaseUnderRecord {
                    name: name.clone(),
                    file: PathBuf::new(),
                    assembly,
                })
            }
        });
        each.collect()
    }
}
