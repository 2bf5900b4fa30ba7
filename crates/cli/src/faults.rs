//! Cases as commands read them: all that is wrong in one is reported together.

use std::path::Path;

use pounding_assembly::{Assembly, AssemblyError, assemble};
use pounding_case::Case;
use pounding_study::faults;
use pounding_study::gap_check::CheckError;

use crate::commands::gap_failure;
use crate::failure::Failure;

/// Reads and validates a case file. With `own_record`, errors of one kind do not hide that
/// its record is missing.
pub fn read_case(path: &Path, own_record: bool) -> Result<Case, Failure> {
    faults::read_case(path, own_record).map_err(|e| Failure::case(*e.error, &e.source_text))
}

/// The system of a case under its own record.
pub fn assembled(case: &Case) -> Result<Assembly, Failure> {
    assemble(case).map_err(|e| Failure::of_case(faults::with_all(e, case, true), case))
}

/// What kept a case from being put under records, its own or others.
pub fn of_records(error: CheckError, case: &Case, own_record: bool) -> Failure {
    let error = match error {
        CheckError::Case(error) => error.into(),
        CheckError::Record { source, .. }
            if own_record && matches!(*source, AssemblyError::GroundMotion(_)) =>
        {
            *source
        }
        error => return gap_failure(error, case),
    };
    Failure::of_case(faults::with_all(error, case, own_record), case)
}
