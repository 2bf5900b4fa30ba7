//! `pounding report`: the page of a result.

use std::path::Path;

use pounding_case::read_regular_text;
use pounding_catalogue::wording::counted;
use pounding_files::FileUse;
use pounding_files::checksum::Checksum;
use pounding_report::{Answered, ReportError, RunResult};
use pounding_results::Inputs;
use pounding_study::{ResultReader, Study};

use crate::failure::Failure;
use crate::files::{name_left_over, page_is_spared, reads_too};
use crate::output::{print, warn};
use crate::separate::{Reading, reading, warnings};
use crate::{page, plot};

/// What is to have a page.
pub struct Asked<'a> {
    /// Result.
    pub result: &'a Path,
    /// Page; none is beside the result.
    pub output: Option<&'a Path>,
    /// Study of an incremental dynamic analysis.
    pub study: Option<&'a Path>,
}

/// Writes the page of a result of a study, whose file comes first.
pub type PageOfStudy = fn(&Path, &ResultReader, &Path, &mut FileUse) -> Result<(), Failure>;

/// Reads a result, writes its page, says where.
pub fn report(
    asked: &Asked<'_>,
    page_of_study: PageOfStudy,
    child: bool,
    mut files: FileUse,
) -> Result<(), Failure> {
    let path = asked.result;
    let output = match asked.output {
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
    if let Some(study) = asked.study {
        read_regular_text(study, "study").map_err(|e| Failure::case(e, ""))?;
        // Before anything else is said of the output: it may be a file that the study reads.
        if let Ok(study) = Study::read(study) {
            reads_too(&mut files, study.files())?;
        }
    }
    if !child {
        page_is_spared(&output, asked.output.is_some())?;
    }
    if Answered::may_be(path) {
        return of_answer(asked, &output);
    }
    let read = [path.to_owned()];
    let without = match reading(&read, &files, child)? {
        Reading::Here(without) => without,
        Reading::Done => return Ok(()),
    };
    let (held, checksum) = match RunResult::read(path, without) {
        // HDF5, but no run: it may be a study.
        Err(no_run @ ReportError::NotAResult { .. }) => {
            let result = ResultReader::open(path, without).map_err(|_| page::failed(no_run))?;
            let made_of = &result.description;
            let texts = [made_of.study.as_str(), &made_of.case];
            spare_inputs(&output, (&texts, &made_of.records))?;
            match asked.study {
                Some(study) => page_of_study(study, &result, &output, &mut files)?,
                None => page::write_sweep(&result, path, &output)?,
            }
            (counted(result.rows, "run"), result.checksum)
        }
        result => {
            let result = result.map_err(page::failed)?;
            no_study(asked, "the result of a run")?;
            spare_inputs(&output, (&[&result.case], &result.record_sha256))?;
            page::write_run(&result, path, &output)?;
            let impacts: usize = result.gaps.iter().map(|g| g.impacts.len()).sum();
            let held = [
                counted(result.buildings.len(), "building"),
                counted(result.gaps.len(), "gap"),
                counted(impacts, "impact"),
            ];
            (held.join(", "), result.checksum)
        }
    };
    if checksum == Checksum::Absent {
        warnings(&read).iter().for_each(|text| warn(text));
    }
    print(&format!("{held}: page written to {}", output.display()))
}

/// A file that the result was made of is not replaced by its page.
fn spare_inputs(output: &Path, (texts, records): (&[&str], &str)) -> Result<(), Failure> {
    let inputs = Inputs { texts, records };
    match inputs.holds(output) {
        None => Ok(()),
        Some(what) => Err(Failure::input(
            format!(
                "{} is not replaced: it is a {what} that this result was made of",
                output.display()
            ),
            Some("give the page another name with -o".to_owned()),
        )),
    }
}

/// The page of what another command has answered.
fn of_answer(asked: &Asked<'_>, output: &Path) -> Result<(), Failure> {
    let answered = Answered::read(asked.result).map_err(|e| page::failed(e.into()))?;
    no_study(asked, "the answer of another command")?;
    // What an answer tells of files is their names.
    let text = read_regular_text(asked.result, "answer").map_err(|e| Failure::case(e, ""))?;
    spare_inputs(output, (&[&text], ""))?;
    plot::write(output, &answered.page())?;
    let command = answered.command.name();
    print(&format!(
        "answer of `pounding {command}`: page written to {}",
        output.display()
    ))
}

/// Refuses a study for what is no result of one.
fn no_study(asked: &Asked<'_>, what: &str) -> Result<(), Failure> {
    match asked.study {
        None => Ok(()),
        Some(_) => Err(Failure::input(
            format!("{} is {what}, not of a study", asked.result.display()),
            Some("leave --study away".to_owned()),
        )),
    }
}
