//! What the parser of arguments advises.

use std::ffi::OsString;

use clap::builder::StyledStr;
use clap::error::{ContextKind, ContextValue};
use clap::{Arg, Command};

use crate::command_words::shell_line;

/// The error with a tip that works where a value that begins with a dash stands behind its option: the
/// parser takes it for an option, and its own tip, two dashes, is for names of files.
pub fn that_works(mut error: clap::Error, command: &Command, given: &[OsString]) -> clap::Error {
    let Some(ContextValue::String(word)) = error.get(ContextKind::InvalidArg) else {
        return error;
    };
    // Of several letters behind one dash the parser names the first alone; it meets the first such word.
    let named = |word_given: &OsString| word_given.to_str().is_some_and(|w| w.starts_with(word));
    let joined = given.iter().position(named).and_then(|met| {
        let option = given[met.checked_sub(1)?].to_str()?;
        let value = given[met].to_str().filter(|v| !v.starts_with("--"))?;
        let name = taking(command, given, option)?;
        Some(shell_line(&[format!("{name}{value}")]))
    });
    let Some(joined) = joined else {
        return error;
    };
    let tip = StyledStr::from(format!(
        "a value that begins with a dash is joined to its option: {joined}"
    ));
    error.insert(ContextKind::Suggested, ContextValue::StyledStrs(vec![tip]));
    error
}

/// How a value is joined to an option of the command that is called, such as `--output=`; `None` if it is none that
/// always takes one.
fn taking(command: &Command, given: &[OsString], option: &str) -> Option<String> {
    let mut called = command;
    for word in given {
        called = called.find_subcommand(word).unwrap_or(called);
    }
    let dashed = option.strip_prefix('-')?;
    let is_it = |argument: &&Arg| match dashed.strip_prefix('-') {
        Some(long) => argument.get_long() == Some(long),
        None => argument.get_short().map(String::from).as_deref() == Some(dashed),
    };
    let mut arguments = called.get_arguments().chain(command.get_arguments());
    let found = arguments.find(is_it)?;
    let takes = found.get_action().takes_values();
    let least = found.get_num_args().map_or(1, |n| n.min_values());
    match found.get_long() {
        _ if !takes || least == 0 => None,
        Some(long) => Some(format!("--{long}=")),
        None => Some(format!("-{dashed}")),
    }
}
