//! What options need, also where another option excludes it.
//!
//! `clap` forgives an option the absence of what it `requires` where that is excluded by another
//! option: `--height`, which needs `--drop`, would be read and left unused beside
//! `--velocity-right`, which excludes `--drop`.

use std::ffi::OsString;

use clap::builder::Resettable;
use clap::error::{ContextKind, ContextValue, Error, ErrorKind};
use clap::{Command, Id};

/// Refuses options without what they need. To be asked of arguments that `command` has read.
///
/// # Errors
/// What is missing.
pub fn all_is_there(command: &Command, given: &[OsString]) -> Result<(), Error> {
    let needs = with_needs_alone(command.clone());
    match needs.try_get_matches_from(given) {
        Err(error) if error.kind() == ErrorKind::MissingRequiredArgument => {
            let missing = match error.get(ContextKind::InvalidArg) {
                Some(ContextValue::Strings(missing)) => missing.join(", "),
                _ => "an option".to_owned(),
            };
            // Else `clap` would have asked for it.
            let text = format!(
                "{missing} is not given, which one option here needs and another one excludes\n\n  tip: leave one of these two options out"
            );
            Err(command.clone().error(ErrorKind::ArgumentConflict, text))
        }
        _ => Ok(()),
    }
}

/// A command whose options exclude nothing, and must be there only where another one needs them.
fn with_needs_alone(command: Command) -> Command {
    let groups: Vec<Id> = command.get_groups().map(|g| g.get_id().clone()).collect();
    let free = |command: Command, group: Id| {
        command.mut_group(group, |group| {
            group.multiple(true).conflicts_with(Resettable::Reset)
        })
    };
    let command = command.mut_args(|argument| {
        argument
            .conflicts_with(Resettable::Reset)
            .required(false)
            .required_unless_present(Resettable::Reset)
    });
    let command = groups.into_iter().fold(command, free);
    command.mut_subcommands(with_needs_alone)
}
