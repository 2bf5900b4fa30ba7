//! `pounding report`: the page of a result.

use std::path::Path;

use pounding_catalogue::wording::counted;
use pounding_files::FileUse;
use pounding_files::checksum::Checksum;
use pounding_report::{ReportError, RunResult, page};

use crate::failure::Failure;
use crate::files::name_left_over;
use crate::output::print;
use crate::output::warn;
use crate::plot;
use crate::separate::{Reading, reading, warnings};

/// Reads a result, writes its page, says where.
pub fn report(
    path: &Path,
    output: Option<&Path>,
    child: bool,
    mut files: FileUse,
) -> Result<(), Failure> {
    let output = match output {
        Some(output) => output.to_owned(),
        None => {
            let beside = path.with_extension("html");
            files.writes("--output", &beside);
            files.check()?;
            if !child {
                name_left_over(&beside);
            }
            beside
        }
    };
    let files = [path.to_owned()];
    let without = match reading(&files, child)? {
        Reading::Here(without) => without,
        Reading::Done => return Ok(()),
    };
    let result = RunResult::read(path, without).map_err(failed)?;
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    plot::write(&output, &page(&result, &name).map_err(failed)?)?;
    if result.checksum == Checksum::Absent {
        warnings(&files).iter().for_each(|text| warn(text));
    }
    let impacts: usize = result.gaps.iter().map(|g| g.impacts.len()).sum();
    print(&format!(
        "{}, {}, {}: page written to {}",
        counted(result.buildings.len(), "building"),
        counted(result.gaps.len(), "gap"),
        counted(impacts, "impact"),
        output.display()
    ))
}

fn failed(e: ReportError) -> Failure {
    match e {
        ReportError::Figure { .. } => plot::not_drawn(&e),
        _ => Failure::input(e.to_string(), e.help()),
    }
}
