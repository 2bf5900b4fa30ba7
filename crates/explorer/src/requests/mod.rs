//! What is computed for each kind of request.

pub(crate) mod calibrate;
mod deadline;
pub(crate) mod run;
pub(crate) mod sweep;
pub(crate) mod widths;

use std::path::PathBuf;

use pounding_study::gap_check::CaseUnderRecord;

use crate::explorer::Prepared;

/// The case under its own record, as gap checks take it.
fn under_its_record(prepared: Prepared) -> CaseUnderRecord {
    let file: PathBuf = prepared.case.ground_motion.file.value;
    let name = file.file_stem().unwrap_or(file.as_os_str());
    CaseUnderRecord {
        name: name.to_string_lossy().into_owned(),
        file,
        assembly: prepared.assembly,
    }
}
