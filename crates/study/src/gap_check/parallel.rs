//! Work on all cores, in the order of its numbers, with its progress.

use std::ops::ControlFlow;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};

use super::error::CheckError;

/// Given how many of how many pieces of work are done; says whether to go on.
pub type Progress<'a> = &'a (dyn Fn(usize, usize) -> ControlFlow<()> + Sync);

/// Tells nobody, and goes on.
pub const UNWATCHED: Progress<'static> = &|_, _| ControlFlow::Continue(());

/// Does `work` for the numbers from zero to `count - 1` on so many threads (at least
/// one). Results are in order and do not depend on the number of threads.
///
/// # Errors
/// [`CheckError::Stopped`] where `progress` ends the work: what has begun is finished, and nothing
/// else begun.
pub(crate) fn in_parallel<T: Send>(
    count: usize,
    threads: usize,
    progress: Progress<'_>,
    work: impl Fn(usize) -> T + Sync,
) -> Result<Vec<T>, CheckError> {
    let done = Mutex::new(0);
    let stopped = AtomicBool::new(false);
    let kept = pounding_time_history::in_parallel(count, threads, |number| {
        if stopped.load(Ordering::Relaxed) {
            return None;
        }
        let kept = work(number);
        // Counted under the lock: nobody is reported of fewer after more.
        let mut done = done.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
        *done += 1;
        if progress(*done, count).is_break() {
            stopped.store(true, Ordering::Relaxed);
        }
        Some(kept)
    });
    match stopped.into_inner() {
        true => Err(CheckError::Stopped),
        // Without a stop none is missing.
        false => Ok(kept.into_iter().flatten().collect()),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn in_order_for_any_number_of_threads() {
        for threads in [0, 1, 2, 7, 100] {
            let reported = Mutex::new(Vec::new());
            let tell = |done, count| {
                if let Ok(mut reported) = reported.lock() {
                    reported.push((done, count));
                }
                ControlFlow::Continue(())
            };
            let squares = in_parallel(20, threads, &tell, |i| i * i).unwrap();
            assert_eq!(squares, (0..20).map(|i| i * i).collect::<Vec<_>>());
            let reported = reported.into_inner().unwrap_or_default();
            assert_eq!(reported, (1..=20).map(|i| (i, 20)).collect::<Vec<_>>());
        }
        assert!(in_parallel(0, 2, UNWATCHED, |i| i).unwrap().is_empty());
    }

    /// What runs is finished, which is one piece on each thread, and no other is begun.
    #[test]
    fn ended_by_who_watches() {
        for threads in [1, 2, 7] {
            let begun = Mutex::new(0);
            let tell = |done, _| match done {
                0..5 => ControlFlow::Continue(()),
                _ => ControlFlow::Break(()),
            };
            let made = in_parallel(1000, threads, &tell, |_| *begun.lock().unwrap() += 1);
            assert!(matches!(made, Err(CheckError::Stopped)));
            let begun = begun.into_inner().unwrap();
            assert!((5..5 + threads).contains(&begun), "{threads}: {begun}");
        }
    }
}
