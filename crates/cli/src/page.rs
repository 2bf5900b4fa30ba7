//! Pages of results and of what commands answer: `report` and `--report`.

use std::path::Path;

use pounding_case::{Case, Separation};
use pounding_files::checksum::{WithoutChecksum, hexadecimal};
use pounding_report::page::{self as pages, Inputs, SweepAnswer};
use pounding_report::{Answered, ReportError, RunResult};
use pounding_study::ResultReader;
use pounding_study::gap_check::CaseUnderRecord;
use serde::Serialize;
use serde_json::Value;
use sha2::{Digest, Sha256};

use crate::failure::Failure;
use crate::files::say_what_goes;
use crate::plot;

/// The object that a command prints with `--json`, for its page.
pub fn answer(answer: &impl Serialize) -> Result<Value, Failure> {
    serde_json::to_value(answer)
        .map_err(|e| Failure::output(&std::io::Error::other(e), "the result as JSON"))
}

/// Writes the file of an answer and its page, where they are asked for.
pub fn write_answered(
    made: impl FnOnce() -> Result<Answered, Failure>,
    output: Option<&Path>,
    page: Option<&Path>,
) -> Result<(), Failure> {
    if output.is_none() && page.is_none() {
        return Ok(());
    }
    let answered = made()?;
    if let Some(output) = output {
        say_what_goes(output, &answered)?;
        pounding_files::write(output, answered.text().as_bytes())
            .map_err(|e| Failure::output(&e, &output.display().to_string()))?;
    }
    page.map_or(Ok(()), |page| plot::write(page, &answered.page()))
}

/// Inputs of a command that takes a file.
pub fn inputs(command: &str, title: &str, file: &Path) -> Inputs {
    let name = file.display().to_string();
    let title = match title {
        "" => name.clone(),
        title => title.to_owned(),
    };
    Inputs {
        title,
        origin: vec![
            command.to_owned(),
            name,
            format!("pounding {}", env!("CARGO_PKG_VERSION")),
        ],
        warnings: Vec::new(),
        facts: vec![("build".to_owned(), pounding_study::BUILD.to_owned())],
        listings: Vec::new(),
    }
}

/// Inputs of a command that puts a case under records.
pub fn of_case(command: &str, case: &Case, file: &Path, records: &[CaseUnderRecord]) -> Inputs {
    let mut inputs = inputs(command, &case.title, file);
    let hash = hexadecimal(&Sha256::digest(&case.source));
    inputs.facts.push(("SHA-256 of the case".to_owned(), hash));
    for record in records {
        let origin = record.assembly.accelerogram.origin();
        let hash = origin.map_or(String::new(), |o| o.sha256.clone());
        let name = format!("SHA-256 of {}", record.name);
        inputs.facts.push((name, hash));
    }
    let listing = ("The case file".to_owned(), case.source.clone());
    inputs.listings.push(listing);
    inputs
}

/// What a page says of a gap check: also the files of rules beside the case.
pub fn of_gap(
    case: &Case,
    file: &Path,
    records: &[CaseUnderRecord],
    separation: &Separation,
) -> Inputs {
    let mut inputs = of_case("gap", case, file, records);
    let mut listed: Vec<&str> = vec![&case.source];
    for rule in &separation.rules {
        let source: &str = &rule.source;
        if listed.contains(&source) {
            continue;
        }
        listed.push(source);
        let hash = hexadecimal(&Sha256::digest(source));
        inputs
            .facts
            .push((format!("SHA-256 of {}", rule.file), hash));
        let listing = (format!("The rules of {}", rule.file), source.to_owned());
        inputs.listings.push(listing);
    }
    inputs
}

/// The page of a run that has just been written.
pub fn of_run(path: &Path, output: &Path) -> Result<(), Failure> {
    let result = RunResult::read(path, WithoutChecksum::Refuse).map_err(failed)?;
    write_run(&result, path, output)
}

/// The result of a sweep that has just been written.
pub fn read_sweep(path: &Path) -> Result<ResultReader, Failure> {
    let result = ResultReader::open(path, WithoutChecksum::Refuse);
    result.map_err(|e| failed(ReportError::Study(e)))
}

/// What the runs of a sweep come to.
pub fn answer_of_sweep(result: &ResultReader) -> Result<SweepAnswer, Failure> {
    SweepAnswer::of(result).map_err(|e| failed(ReportError::Study(e)))
}

/// The page of a sweep that has just been written.
pub fn of_sweep(path: &Path, output: &Path) -> Result<(), Failure> {
    write_sweep(&read_sweep(path)?, path, output)
}

/// The page of a sweep that was read.
pub fn write_sweep(result: &ResultReader, path: &Path, output: &Path) -> Result<(), Failure> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    plot::write(output, &pages::sweep(result, &name).map_err(failed)?)
}

/// The page of a run that was read.
pub fn write_run(result: &RunResult, path: &Path, output: &Path) -> Result<(), Failure> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    plot::write(output, &pages::run(result, &name).map_err(failed)?)
}

/// A result that cannot be read or drawn.
pub fn failed(e: ReportError) -> Failure {
    match e {
        ReportError::Figure { .. } => Failure::not_drawn(&e),
        _ => Failure::input(e.to_string(), e.help()),
    }
}
