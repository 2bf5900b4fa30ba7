//! Work on all cores, in the order of its numbers, with its progress.

use std::cell::Cell;
use std::ops::ControlFlow;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};

use pounding_time_history::{History, Recorder, StepView, System, TimeHistoryError};

use super::error::CheckError;

/// Steps of a run between which it is not asked whether to go on.
const UNASKED: u32 = 64;

/// Given how many of how many pieces of work are done, after each and while runs last; says whether
/// to go on.
pub type Progress<'a> = &'a (dyn Fn(usize, usize) -> ControlFlow<()> + Sync);

/// Tells nobody, and goes on.
pub const UNWATCHED: Progress<'static> = &|_, _| ControlFlow::Continue(());

/// A recorder that ends its run where who watches the work ends that. It asks now and then between
/// steps, and is shown none until then.
pub(crate) struct Ending<'w> {
    goes_on: &'w dyn Fn() -> bool,
    /// Steps since it asked.
    steps: Cell<u32>,
    ended: Cell<bool>,
}

impl<'w> Ending<'w> {
    fn new(goes_on: &'w dyn Fn() -> bool) -> Self {
        Self {
            goes_on,
            steps: Cell::new(0),
            ended: Cell::new(false),
        }
    }

    /// Whether to go on with what is no run.
    #[cfg(feature = "results")]
    pub(crate) fn goes_on(&self) -> bool {
        (self.goes_on)()
    }

    fn checked(&self) -> Result<(), TimeHistoryError> {
        match self.ended.get() {
            false => Ok(()),
            true => Err(TimeHistoryError::Recorder(CheckError::Stopped.to_string())),
        }
    }
}

impl Recorder for Ending<'_> {
    fn begin(&mut self, _system: &System, _start: &History) -> Result<(), TimeHistoryError> {
        self.checked()
    }

    fn next_time(&self) -> f64 {
        self.steps.set(self.steps.get() + 1);
        if self.steps.get() == UNASKED {
            self.steps.set(0);
            self.ended.set(self.ended.get() || !(self.goes_on)());
        }
        match self.ended.get() {
            false => f64::INFINITY,
            true => f64::NEG_INFINITY,
        }
    }

    fn step(&mut self, _step: &mut StepView<'_, '_, '_>) -> Result<(), TimeHistoryError> {
        self.checked()
    }
}

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
    runs_in_parallel(count, threads, progress, |number, _| work(number))
}

/// The same for work whose runs take a recorder, by which they end where `progress` ends the work.
///
/// # Errors
/// As [`in_parallel`]; what has begun ends as well.
pub(crate) fn runs_in_parallel<T: Send>(
    count: usize,
    threads: usize,
    progress: Progress<'_>,
    work: impl Fn(usize, &mut Ending<'_>) -> T + Sync,
) -> Result<Vec<T>, CheckError> {
    let done = Mutex::new(0);
    let stopped = AtomicBool::new(false);
    // Told under the lock: nobody is told of fewer after more.
    let tell = |more: usize| {
        let mut done = done.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
        *done += more;
        if progress(*done, count).is_break() {
            stopped.store(true, Ordering::Relaxed);
        }
    };
    let goes_on = || {
        tell(0);
        !stopped.load(Ordering::Relaxed)
    };
    let kept = pounding_time_history::in_parallel(count, threads, |number| {
        if stopped.load(Ordering::Relaxed) {
            return None;
        }
        let kept = work(number, &mut Ending::new(&goes_on));
        tell(1);
        Some(kept)
    });
    match stopped.into_inner() {
        true => Err(CheckError::Stopped),
        // Without a stop none is missing.
        false => Ok(kept.into_iter().flatten().collect()),
    }
}

#[cfg(test)]
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

    /// Runs that last ask between their steps, and end with the others.
    #[test]
    fn runs_end_with_the_work() {
        for threads in [1, 2, 7] {
            let asked = Mutex::new(0);
            let tell = |_, count| {
                assert_eq!(count, 1000);
                let mut asked = asked.lock().unwrap();
                *asked += 1;
                match *asked {
                    0..5 => ControlFlow::Continue(()),
                    _ => ControlFlow::Break(()),
                }
            };
            let begun = Mutex::new(0);
            let made = runs_in_parallel(1000, threads, &tell, |_, ending| {
                *begun.lock().unwrap() += 1;
                while ending.next_time() == f64::INFINITY {
                    assert!(ending.checked().is_ok());
                }
                assert!(ending.checked().is_err());
            });
            assert!(matches!(made, Err(CheckError::Stopped)));
            assert!(begun.into_inner().unwrap() <= threads);
        }
    }
}
