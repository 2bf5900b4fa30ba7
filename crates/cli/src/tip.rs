//! What the parser of arguments advises.

use std::ffi::OsString;

use clap::builder::StyledStr;
use clap::error::{ContextKind, ContextValue};

use crate::interruption::shell_line;

/// The error with a tip that works where a value that begins with a dash stands behind its option: the
/// parser takes it for an option, and its own tip, two dashes, is for names of files.
pub fn that_works(mut error: clap::Error, given: &[OsString]) -> clap::Error {
    let Some(ContextValue::String(word)) = error.get(ContextKind::InvalidArg) else {
        return error;
    };
    // Of several letters behind one dash the parser names the first alone.
    let begins = |given: &&[OsString]| {
        let value = given[1].to_str();
        value.is_some_and(|value| value.starts_with(word) && is_number(value))
    };
    let Some([option, value]) = given.windows(2).find(begins) else {
        return error;
    };
    let (option, value) = (option.to_string_lossy(), value.to_string_lossy());
    if !option.starts_with("--") || option.len() == 2 || option.contains('=') {
        return error;
    }
    let joined = shell_line(&[format!("{option}={value}")]);
    let tip = StyledStr::from(format!(
        "a value that begins with a dash is joined to its option: {joined}"
    ));
    error.insert(ContextKind::Suggested, ContextValue::StyledStrs(vec![tip]));
    error
}

/// Whether a word is a number below zero, with or without a unit.
fn is_number(word: &str) -> bool {
    let digits = |rest: &str| rest.starts_with(|c: char| c.is_ascii_digit() || c == '.');
    word.strip_prefix('-').is_some_and(digits)
}
