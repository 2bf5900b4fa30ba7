//! What the program does while it works, to standard error: `-v`, `-vv` and `RUST_LOG`. Nothing
//! of it is in the loop that integrates, and no number depends on it.

use std::io::IsTerminal;

use tracing_subscriber::filter::Targets;
use tracing_subscriber::fmt::format::FmtSpan;
use tracing_subscriber::fmt::time::uptime;
use tracing_subscriber::layer::{Layer, SubscriberExt};

use crate::arguments::ColorChoice;
use crate::failure::Failure;

/// The environment's key for directives, such as `pounding_ground_motion=debug`.
const KEY: &str = "RUST_LOG";

/// Begins to write what is done, if it is asked for: once `-v` the steps of the work with their
/// times, twice what they found; `RUST_LOG` goes before both.
///
/// # Errors
/// Directives of the environment that are none.
pub fn begin(verbose: u8, color: ColorChoice) -> Result<(), Failure> {
    let given = std::env::var(KEY)
        .ok()
        .filter(|text| !text.trim().is_empty());
    let directives = match (given, verbose) {
        (Some(given), _) => given,
        (None, 0) => return Ok(()),
        (None, 1) => "pounding=info".to_owned(),
        (None, _) => "pounding=debug".to_owned(),
    };
    // Levels of targets alone: filters by the fields of spans would take a library of regular expressions.
    let filter: Targets = directives.parse().map_err(|e| {
        Failure::input(
            format!("{KEY}={directives}: {e}"),
            Some(format!(
                "write levels, or targets with levels: {KEY}=info, {KEY}=pounding_assembly=debug"
            )),
        )
    })?;
    let layer = tracing_subscriber::fmt::layer()
        .with_writer(std::io::stderr)
        .with_ansi(color.is_on(std::io::stderr().is_terminal()))
        .with_timer(uptime())
        // A step is told when it ends, with the time that it took.
        .with_span_events(FmtSpan::CLOSE)
        .with_filter(filter);
    let subscriber = tracing_subscriber::registry().with(layer);
    // In a process that has one already, as Python's may, that one is asked.
    let _ = tracing::subscriber::set_global_default(subscriber);
    Ok(())
}
