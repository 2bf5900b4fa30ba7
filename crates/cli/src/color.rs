//! Colour on the screen: `--color`, else the environment and the terminal.

use std::ffi::OsString;

use crate::arguments::ColorChoice;
use crate::tables::width;

impl ColorChoice {
    /// Whether a stream has colour, which is a terminal or not.
    pub fn is_on(self, terminal: bool) -> bool {
        match self {
            Self::Always => true,
            Self::Never => false,
            Self::Auto => {
                // https://no-color.org: set, and not empty.
                let refused = std::env::var_os("NO_COLOR").is_some_and(|v| !v.is_empty());
                terminal && !refused
            }
        }
    }
}

/// The choice among arguments that may not be right in all else: errors of arguments have
/// colour, too.
pub fn among(arguments: &[OsString]) -> ColorChoice {
    let texts: Vec<_> = arguments.iter().map(|a| a.to_string_lossy()).collect();
    let word = |at: usize, text: &str| match text.strip_prefix("--color") {
        Some("") => texts.get(at + 1).map(|next| next.to_string()),
        Some(rest) => rest.strip_prefix('=').map(str::to_owned),
        None => None,
    };
    let found = texts
        .iter()
        .enumerate()
        .find_map(|(at, text)| word(at, text));
    match found.as_deref() {
        Some("always") => ColorChoice::Always,
        Some("never") => ColorChoice::Never,
        _ => ColorChoice::Auto,
    }
}

/// Has clap and the reports of errors follow the choice; what is left to the environment they
/// find out themselves.
pub fn apply(choice: ColorChoice, command: clap::Command) -> clap::Command {
    let on = match choice {
        ColorChoice::Auto => None,
        ColorChoice::Always => Some(true),
        ColorChoice::Never => Some(false),
    };
    let columns = width();
    // In a process that has a hook already, that one stays.
    let _ = miette::set_hook(Box::new(move |_| {
        let mut report = miette::MietteHandlerOpts::new();
        if let Some(on) = on {
            report = report.color(on);
        }
        if let Some(columns) = columns {
            report = report.width(usize::from(columns));
        }
        Box::new(report.build())
    }));
    match on {
        None => command,
        Some(true) => command.color(clap::ColorChoice::Always),
        Some(false) => command.color(clap::ColorChoice::Never),
    }
}
