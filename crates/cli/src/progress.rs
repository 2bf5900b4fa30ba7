//! How far a command is: a bar on a terminal, a line from time to time elsewhere.

use std::io::{IsTerminal, Write};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};
use pounding_catalogue::wording::counted;

use crate::failure::Failure;

/// Time between lines where there is no terminal.
const BETWEEN_LINES: Duration = Duration::from_secs(30);
/// Time that a command whose progress is unknown takes before it says that it works.
const QUIET: Duration = Duration::from_secs(2);
/// The environment's key for another time (s).
const KEY: &str = "POUNDING_PROGRESS_SECONDS";

/// What is counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// Runs.
    Runs,
    /// Thousandths of one computation.
    Part,
}

/// How far a command is. It is shown until this is dropped.
pub struct Progress {
    shown: Shown,
}

enum Shown {
    Bar(ProgressBar),
    Lines {
        now: Arc<Mutex<Now>>,
        /// Dropped first: ends the thread.
        end: Option<Sender<()>>,
        thread: Option<JoinHandle<()>>,
    },
}

#[derive(Debug, Clone)]
struct Now {
    unit: Unit,
    done: u64,
    total: u64,
    more: String,
}

impl Progress {
    /// Begins to show; the time that is left is counted from here.
    ///
    /// # Errors
    /// A value of the environment that is no time.
    pub fn begin(unit: Unit) -> Result<Self, Failure> {
        let between = between_lines()?;
        if std::io::stderr().is_terminal() {
            return Ok(Self {
                shown: Shown::Bar(bar(unit)),
            });
        }
        let now = Arc::new(Mutex::new(Now {
            unit,
            done: 0,
            total: 0,
            more: String::new(),
        }));
        let (end, ended) = channel::<()>();
        let (seen, began) = (Arc::clone(&now), Instant::now());
        // Without a thread there are no lines, which is no reason not to compute.
        let thread = std::thread::Builder::new()
            .name("progress".to_owned())
            .spawn(move || {
                while let Err(RecvTimeoutError::Timeout) = ended.recv_timeout(between) {
                    let now = seen.lock().unwrap_or_else(PoisonError::into_inner).clone();
                    // Whoever closed the stream wants to see nothing.
                    let _ = writeln!(std::io::stderr().lock(), "{}", now.line(began.elapsed()));
                }
            })
            .ok();
        Ok(Self {
            shown: Shown::Lines {
                now,
                end: Some(end),
                thread,
            },
        })
    }

    /// Begins to wait for a computation that does not report how far it is: one that takes
    /// long says what it does, and for how long it has done so.
    ///
    /// # Errors
    /// A value of the environment that is no time.
    pub fn working(what: String) -> Result<Self, Failure> {
        let between = between_lines()?;
        let now = Now {
            unit: Unit::Part,
            done: 0,
            total: 0,
            more: String::new(),
        };
        let (end, ended) = channel::<()>();
        let began = Instant::now();
        let thread = std::thread::Builder::new()
            .name("progress".to_owned())
            .spawn(move || {
                let goes_on =
                    |time| matches!(ended.recv_timeout(time), Err(RecvTimeoutError::Timeout));
                if !goes_on(QUIET.min(between)) {
                    return;
                }
                if std::io::stderr().is_terminal() {
                    let bar = ProgressBar::new_spinner().with_elapsed(began.elapsed());
                    if let Ok(style) = ProgressStyle::with_template("{elapsed:>4} {spinner} {msg}")
                    {
                        bar.set_style(style);
                    }
                    bar.set_message(what);
                    bar.enable_steady_tick(Duration::from_millis(200));
                    // Until the other end is dropped.
                    let _ = ended.recv();
                    return bar.finish_and_clear();
                }
                loop {
                    let elapsed = time(began.elapsed().as_secs_f64());
                    // Whoever closed the stream wants to see nothing.
                    let _ = writeln!(std::io::stderr().lock(), "{what}, {elapsed} elapsed");
                    if !goes_on(between) {
                        return;
                    }
                }
            })
            .ok();
        Ok(Self {
            shown: Shown::Lines {
                now: Arc::new(Mutex::new(now)),
                end: Some(end),
                thread,
            },
        })
    }

    /// Says how many are done, of how many, and what else there is to say.
    pub fn show(&self, done: usize, total: usize, more: &str) {
        match &self.shown {
            Shown::Bar(bar) => {
                bar.set_length(total as u64);
                bar.set_position(done as u64);
                if bar.message() != more {
                    bar.set_message(more.to_owned());
                }
            }
            Shown::Lines { now, .. } => {
                let mut now = now.lock().unwrap_or_else(PoisonError::into_inner);
                (now.done, now.total) = (done as u64, total as u64);
                if now.more != more {
                    more.clone_into(&mut now.more);
                }
            }
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        match &mut self.shown {
            Shown::Bar(bar) => bar.finish_and_clear(),
            Shown::Lines { end, thread, .. } => {
                *end = None;
                if let Some(thread) = thread.take() {
                    // It has nothing to say about how it ended.
                    let _ = thread.join();
                }
            }
        }
    }
}

impl Now {
    fn line(&self, elapsed: Duration) -> String {
        let part = self.done as f64 / self.total.max(1) as f64;
        let seconds = elapsed.as_secs_f64();
        let mut line = match self.unit {
            // Records are read before the runs are counted.
            Unit::Runs if self.total == 0 => "no run begun".to_owned(),
            Unit::Runs => format!(
                "{} of {} ({:.0} %)",
                self.done,
                counted(self.total, "run"),
                100.0 * part
            ),
            Unit::Part => format!("{:.0} %", 100.0 * part),
        };
        line.push_str(&self.more);
        line.push_str(&format!(", {} elapsed", time(seconds)));
        if part > 0.0 {
            let left = seconds * (1.0 - part) / part;
            line.push_str(&format!(", about {} left", time(left)));
        }
        line
    }
}

/// Seconds, minutes or hours as people say them.
pub fn time(seconds: f64) -> String {
    let whole = seconds.round();
    if whole < 120.0 {
        format!("{whole:.0} s")
    } else if whole < 7200.0 {
        format!("{:.0} min", whole / 60.0)
    } else {
        format!("{:.1} h", whole / 3600.0)
    }
}

fn bar(unit: Unit) -> ProgressBar {
    let bar = ProgressBar::new(0);
    let style = match unit {
        Unit::Runs => "{elapsed:>4} {wide_bar} {pos}/{len} runs  {per_sec}  {eta} left{msg}",
        Unit::Part => "{elapsed:>4} {wide_bar} {percent:>3} %  {eta} left{msg}",
    };
    if let Ok(style) = ProgressStyle::with_template(style) {
        bar.set_style(style);
    }
    bar.enable_steady_tick(Duration::from_millis(200));
    bar
}

fn between_lines() -> Result<Duration, Failure> {
    let Ok(text) = std::env::var(KEY) else {
        return Ok(BETWEEN_LINES);
    };
    let time = text.trim().parse().ok().filter(|s: &f64| *s > 0.0);
    time.and_then(|s| Duration::try_from_secs_f64(s).ok())
        .ok_or_else(|| {
            Failure::input(
                format!("{KEY}={text} is no time between lines of progress"),
                Some("give seconds, such as 300, or unset it for 30".to_owned()),
            )
        })
}

/// Threads asked for, or all cores.
pub fn threads(asked: Option<u32>) -> usize {
    let cores = || std::thread::available_parallelism().map_or(1, usize::from);
    asked.map_or_else(cores, |n| n as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_says_how_far_it_is() {
        let now = |unit, done, total, more: &str| Now {
            unit,
            done,
            total,
            more: more.to_owned(),
        };
        let line = |now: Now, s| now.line(Duration::from_secs_f64(s));
        assert_eq!(
            line(now(Unit::Runs, 12, 60, ", 2 failed"), 30.2),
            "12 of 60 runs (20 %), 2 failed, 30 s elapsed, about 2 min left"
        );
        assert_eq!(
            line(now(Unit::Runs, 0, 0, ""), 60.0),
            "no run begun, 60 s elapsed"
        );
        assert_eq!(
            line(now(Unit::Part, 250, 1000, ""), 3600.0),
            "25 %, 60 min elapsed, about 3.0 h left"
        );
    }
}
