//! Pages of what commands answer: `--report`.

use std::path::Path;

use pounding_case::Case;
use pounding_files::checksum::hexadecimal;
use pounding_report::ReportError;
use pounding_report::page::{Inputs, Picture};
use pounding_study::gap_check::CaseUnderRecord;
use serde::Serialize;
use serde_json::Value;
use sha2::{Digest, Sha256};

use crate::failure::Failure;
use crate::plot;

/// The object that a command prints with `--json`, for its page.
pub fn answer(answer: &impl Serialize) -> Result<Value, Failure> {
    serde_json::to_value(answer)
        .map_err(|e| Failure::output(&std::io::Error::other(e), "the result as JSON"))
}

/// A picture of the page.
pub fn picture(drawn: Result<String, ReportError>, words: &str) -> Result<Picture, Failure> {
    let svg = plot::drawn(drawn)?;
    Ok(Picture {
        svg,
        words: words.to_owned(),
    })
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
