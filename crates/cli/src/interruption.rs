//! What happens when a command is asked to end: by Ctrl-C (SIGINT), by a batch system or
//! a shutdown (SIGTERM, SIGXCPU), or by a terminal that is closed (SIGHUP).
//!
//! A sweep stores the runs that have finished first; everything else ends at once. Either
//! way no file is left half-written, none that stood before is lost, and the exit code is
//! [`INTERRUPTED`](exit_code::INTERRUPTED). A second signal does not wait for anything, unless it
//! comes within [a second](TOGETHER): batch systems and shells send the same wish to several
//! processes, which hand it on.

use std::io::Write;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};
#[cfg(unix)]
use std::time::{Duration, Instant};

#[cfg(unix)]
use crate::command_words::is_child;
use crate::exit_code;
use crate::failure::Failure;
use crate::separate::end_child;

/// Signals that follow the first so soon belong to it. Storing takes a small part of this time.
#[cfg(unix)]
const TOGETHER: Duration = Duration::from_secs(1);

/// Whether a signal has come that waits for the runs to be stored.
static ASKED: AtomicBool = AtomicBool::new(false);
static STATE: Mutex<State> = Mutex::new(State {
    waits: false,
    #[cfg(unix)]
    first: None,
    resume: None,
});

struct State {
    /// Whether somebody looks at [`asked`].
    waits: bool,
    /// When the first signal came that waits.
    #[cfg(unix)]
    first: Option<Instant>,
    /// The command that goes on where this one ends.
    resume: Option<String>,
}

/// Listens for the signals from here on.
///
/// # Errors
/// If the system does not let us.
pub fn listen() -> Result<(), Failure> {
    #[cfg(unix)]
    {
        use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM, SIGXCPU, SIGXFSZ};
        let failed = |e: std::io::Error| {
            let help = "the system allows no more threads or files; end other programs";
            Failure::computation(format!("cannot listen for signals: {e}"), Some(help.into()))
        };
        // A file beyond the limit of its size is an error of writing, not an end: the flag that
        // nobody looks at keeps the signal from ending the process.
        let beyond = std::sync::Arc::new(AtomicBool::new(false));
        signal_hook::flag::register(SIGXFSZ, beyond).map_err(failed)?;
        let mut awaited = vec![SIGINT, SIGTERM, SIGXCPU];
        // `nohup` asks for the terminal's end to be ignored.
        if !is_ignored(SIGHUP) {
            awaited.push(SIGHUP);
        }
        let mut signals = signal_hook::iterator::Signals::new(awaited).map_err(failed)?;
        let thread = std::thread::Builder::new().name("signals".to_owned());
        let listener = thread.spawn(move || {
            for signal in signals.forever() {
                if signal == SIGXCPU && is_child() {
                    pounding_files::remove_part_files();
                    signal_hook::low_level::exit(exit_code::OUT_OF_PROCESSOR_TIME);
                }
                received();
            }
        });
        listener.map(drop).map_err(failed)
    }
    #[cfg(not(unix))]
    Ok(())
}

/// Whether this process was started with the signal ignored; not known beside Linux, where it
/// is taken as not ignored.
#[cfg(unix)]
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|l| l.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|m| u64::from_str_radix(m.trim(), 16).ok());
    mask.is_some_and(|mask| mask >> (signal - 1) & 1 == 1)
}

/// Says which command goes on where this one ends; an interrupted command prints it.
pub fn resume_with(command: String) {
    state().resume = Some(command);
}

/// While `waits` is true, a signal is answered by whoever looks at [`asked`]; else the
/// command ends at once. Returns whether one has come.
pub fn wait(waits: bool) -> bool {
    state().waits = waits;
    asked()
}

/// Whether a signal has come that waits for the runs to be stored.
pub fn asked() -> bool {
    ASKED.load(Ordering::Relaxed)
}

fn state() -> std::sync::MutexGuard<'static, State> {
    STATE.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(unix)]
fn received() {
    let mut state = state();
    if state.waits {
        let first = *state.first.get_or_insert_with(Instant::now);
        let again = ASKED.swap(true, Ordering::Relaxed);
        if !again || first.elapsed() < TOGETHER {
            return;
        }
    }
    drop(state);
    leave("");
}

/// Ends the process: removes part files, prints how to go on, exits.
pub fn leave(done: &str) -> ! {
    end_child();
    // Nobody finishes a file from here on.
    pounding_files::remove_part_files();
    let mut text = String::from("interrupted");
    if done.is_empty() {
        text.push_str("; every output is as it was before, or complete\n");
    } else {
        text.push_str(&format!("; {done}\n"));
    }
    if let Some(command) = &state().resume {
        text.push_str(&format!("go on with\n  {command}\n"));
    }
    // A terminal that is gone changes nothing.
    let _ = std::io::stderr()
        .lock()
        .write_all(crate::terminal::shown(&text).as_bytes());
    end_with(exit_code::INTERRUPTED)
}

/// Ends the process without what libraries do at its end: other threads are still in them.
pub fn end_with(code: u8) -> ! {
    #[cfg(unix)]
    signal_hook::low_level::exit(i32::from(code));
    #[cfg(not(unix))]
    std::process::exit(i32::from(code))
}
