//! Cases as commands read them: all that is wrong in one is reported together.

use std::path::{Path, PathBuf};

use pounding_assembly::{Assembly, AssemblyError, assemble};
use pounding_case::Case;
use pounding_catalogue::OUTPUT_STEP;
use pounding_files::FileUse;
use pounding_results::check_size;
use pounding_study::faults;
use pounding_study::gap_check::{CaseUnderRecord, CheckError, under_records};

use crate::arguments::InputPath;
use crate::failure::Failure;
use crate::files::{metadata_beside, reads_too, record_files};

/// Reads and validates a case file. With `own_record`, errors of one kind do not hide that
/// its record is missing.
pub fn read_case(path: &Path, own_record: bool) -> Result<Case, Failure> {
    faults::read_case(path, own_record).map_err(|e| Failure::case(*e.error, &e.source_text))
}

/// Refuses a grid of output times that no disk has room for.
pub fn responses_fit(assembly: &Assembly, case: &Case) -> Result<(), Failure> {
    let duration = assembly.options.duration;
    check_size(&assembly.system, duration, assembly.output_step).map_err(|e| {
        // The one that is further from what is usual.
        let long = e.duration / assembly.system.record_duration().max(1.0);
        let keys = match long > OUTPUT_STEP / assembly.output_step {
            true => ["duration", "output_step"],
            false => ["output_step", "duration"],
        };
        match keys.iter().find_map(|key| case.analysis.places.get(*key)) {
            Some(place) => {
                let error = case.error(place.clone(), e.to_string(), Some(e.help()));
                Failure::case(error, &case.source)
            }
            None => Failure::from(e).about(&case.file),
        }
    })
}

/// The system of a case under its own record.
pub fn assembled(case: &Case) -> Result<Assembly, Failure> {
    assemble(case).map_err(|e| Failure::of_case(faults::with_all(e, case, true), case))
}

/// A case under the records that arguments name, or under its own; none of what it reads is
/// an output.
pub fn recorded(
    case: &Case,
    named: &[InputPath],
    files: &mut FileUse,
) -> Result<Vec<CaseUnderRecord>, Failure> {
    let given = record_files(named).map_err(|e| of_check(e, case))?;
    reads_too(files, case.files())?;
    let records = under_records(case, &given).map_err(|e| of_records(e, case, given.is_empty()))?;
    reads_too(files, records.iter().map(|r| ("record", r.file.clone())))?;
    reads_too(files, metadata_beside(given.iter().map(PathBuf::as_path)))?;
    Ok(records)
}

/// What kept a case from being put under records, its own or others.
fn of_records(error: CheckError, case: &Case, own_record: bool) -> Failure {
    let error = match error {
        CheckError::Case(error) => error.into(),
        CheckError::Record { source, .. }
            if own_record && matches!(*source, AssemblyError::GroundMotion(_)) =>
        {
            *source
        }
        error => return of_check(error, case),
    };
    Failure::of_case(faults::with_all(error, case, own_record), case)
}

/// A failure of a check, with its place in the case where it has one.
pub fn of_check(error: CheckError, case: &Case) -> Failure {
    let help = error.help();
    match error {
        CheckError::Case(error) => Failure::case(error, &case.source),
        CheckError::Record { source, record } => {
            // What a run refuses is of the case, with this record.
            let of_run = matches!(*source, AssemblyError::System(_));
            let within = match of_run {
                true => format!("{} under record {record}", case.file.display()),
                false => format!("record {record}"),
            };
            Failure::assembly(*source, "").within(&within)
        }
        CheckError::AllCollapse {
            records,
            record,
            source,
        } => Failure::assembly(*source, "").within(&format!(
            "under all {records} records a building collapses without contact; record {record}"
        )),
        error @ CheckError::OwnLaw { .. } => Failure::computation(error.to_string(), help),
        error @ CheckError::Unwritten { .. } => Failure::unwritten(error.to_string(), help),
        error => Failure::input(error.to_string(), help),
    }
}
