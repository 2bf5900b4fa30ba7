//! All cores on the runs of a study.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{RecvTimeoutError, sync_channel};
use std::time::Duration;

use super::Row;
use super::runner::Runner;
use crate::error::StudyError;

/// Rows that may wait for the thread that stores them, for each thread that makes them.
const WAITING: usize = 16;
/// How long nothing may happen before `take` is called without a row.
const PAUSE: Duration = Duration::from_millis(100);

/// Makes runs on so many threads, begun in their order, and hands every row to `take` when
/// it is finished. Rows come in any order; each is the same whatever the number of threads.
/// Between rows `take` is called with `None` from time to time. It may break off: then no
/// more runs are begun, those in flight come to their end, and it is handed these, too.
///
/// # Errors
/// The first error of `take`, after which no more runs are begun.
pub(crate) fn run_all(
    runner: &Runner<'_>,
    runs: &[usize],
    threads: usize,
    take: &mut dyn FnMut(Option<Row>) -> Result<ControlFlow<()>, StudyError>,
) -> Result<(), StudyError> {
    let threads = threads.clamp(1, runs.len().max(1));
    let (next, stop) = (AtomicUsize::new(0), AtomicBool::new(false));
    let (sender, receiver) = sync_channel::<Row>(WAITING * threads);
    std::thread::scope(|scope| {
        let mut begun = 0;
        for _ in 0..threads {
            let sender = sender.clone();
            let (next, stop) = (&next, &stop);
            let work = move || {
                while !stop.load(Ordering::Relaxed) {
                    let at = next.fetch_add(1, Ordering::Relaxed);
                    let Some(run) = runs.get(at) else {
                        return;
                    };
                    // Told when it ends, with its number and the time that it took.
                    let row = tracing::debug_span!("study_run", number = *run)
                        .in_scope(|| runner.row(*run));
                    // The other end is gone only if the study has stopped.
                    if sender.send(row).is_err() {
                        return;
                    }
                }
            };
            // Where the system refuses another thread, fewer do the same.
            if std::thread::Builder::new()
                .spawn_scoped(scope, work)
                .is_err()
            {
                break;
            }
            begun += 1;
        }
        drop(sender);
        if begun < threads {
            tracing::info!(begun, threads, "the system grants no more threads");
        }
        if begun == 0 {
            for run in runs {
                if take(Some(runner.row(*run)))?.is_break() {
                    break;
                }
            }
            return Ok(());
        }
        let mut result = Ok(());
        loop {
            let row = match receiver.recv_timeout(PAUSE) {
                Ok(row) => Some(row),
                Err(RecvTimeoutError::Timeout) => None,
                Err(RecvTimeoutError::Disconnected) => return result,
            };
            if result.is_ok() {
                let taken = take(row);
                if !matches!(taken, Ok(ControlFlow::Continue(()))) {
                    stop.store(true, Ordering::Relaxed);
                }
                result = taken.map(|_| ());
            }
        }
    })
}
