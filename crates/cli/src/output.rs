//! What commands say: answers to standard output, remarks to standard error.

use std::io::Write;
use std::path::Path;

use pounding_catalogue::wording::cell;
use serde::Serialize;
use serde::de::IgnoredAny;

use crate::failure::Failure;
use crate::tables::paragraphs;
use crate::terminal::shown;

/// Prints to standard output: a text for people, whose lines are broken where the terminal
/// ends, or JSON, as it is.
pub fn print(text: &str) -> Result<(), Failure> {
    if text.starts_with(['{', '[']) && serde_json::from_str::<IgnoredAny>(text).is_ok() {
        print_as_it_is(text)
    } else {
        print_as_it_is(&paragraphs(&shown(text)))
    }
}

/// Prints to standard output what programs read.
pub fn print_as_it_is(text: &str) -> Result<(), Failure> {
    let mut out = std::io::stdout().lock();
    to_standard_output(writeln!(out, "{}", text.trim_end()).and_then(|()| out.flush()))
}

/// What became of writing to standard output. A reader that closed the pipe has seen enough.
pub fn to_standard_output(written: std::io::Result<()>) -> Result<(), Failure> {
    match written {
        Err(e) if e.kind() == std::io::ErrorKind::BrokenPipe => Ok(()),
        Err(e) => Err(Failure::output(&e, "to standard output")),
        Ok(()) => Ok(()),
    }
}

/// JSON for machines and people; numbers at full precision, keys in alphabetical order.
pub fn pretty(value: &impl Serialize) -> Result<String, Failure> {
    let value = serde_json::to_value(value)
        .map_err(|e| Failure::output(&std::io::Error::other(e), "the result as JSON"))?;
    Ok(format!("{value:#}"))
}

/// Says which of these files were written.
pub fn written<'p>(files: impl IntoIterator<Item = Option<&'p Path>>) -> String {
    let lines = files.into_iter().flatten();
    lines
        .map(|path| format!("written to {}\n", path.display()))
        .collect()
}

/// Prints a remark to standard error.
pub fn note(text: &str) {
    // Nobody to tell is no reason to stop.
    let _ = writeln!(std::io::stderr(), "note: {}", shown(text));
}

/// Prints a warning to standard error.
pub fn warn(text: &str) {
    // Nobody to tell is no reason to stop.
    let _ = writeln!(std::io::stderr(), "warning: {}", shown(text));
}

/// A header and rows as comma-separated values, numbers at full precision; see [`cell`] for texts.
pub fn comma_separated<R: Serialize>(
    columns: &[&str],
    rows: impl IntoIterator<Item = R>,
) -> Result<String, Failure> {
    let write = || -> Result<String, Box<dyn std::error::Error>> {
        let mut writer = csv::WriterBuilder::new()
            .has_headers(false)
            .from_writer(Vec::new());
        writer.write_record(columns)?;
        for row in rows {
            writer.serialize(row)?;
        }
        let written = writer.into_inner()?;
        // Texts among the cells are of users.
        let mut reader = csv::ReaderBuilder::new()
            .has_headers(false)
            .from_reader(&written[..]);
        let mut safe = csv::Writer::from_writer(Vec::new());
        for row in reader.records() {
            safe.write_record(row?.iter().map(|text| cell(text).into_owned()))?;
        }
        Ok(String::from_utf8(safe.into_inner()?)?)
    };
    write().map_err(|e| Failure::output(&std::io::Error::other(e.to_string()), "the columns"))
}
