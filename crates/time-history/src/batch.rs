//! Many runs through one call.

use std::sync::atomic::{AtomicUsize, Ordering};

use crate::driver::run;
use crate::error::TimeHistoryError;
use crate::options::RunOptions;
use crate::outcome::Outcome;
use crate::system::System;

/// Integrates many systems on so many threads (at least one) and returns what `keep` makes
/// of each outcome, in the order of their numbers.
///
/// `make` gives the system of a number from 0 to `count - 1`. Systems that differ in gaps
/// and impact models alone should be made by [`System::isolated`] and [`System::add_gap`]
/// from one of them: modes and exact steps are then computed once for all. Results do not
/// depend on the number of threads, to the last bit, as long as `make` and `keep` do not;
/// memory does not grow with the number of runs but by what `keep` returns.
///
/// # Panics
/// If `make` or `keep` panics.
pub fn run_many<T: Send>(
    count: usize,
    threads: usize,
    options: &RunOptions,
    make: impl Fn(usize) -> Result<System, TimeHistoryError> + Sync,
    keep: impl Fn(usize, Result<Outcome, TimeHistoryError>) -> T + Sync,
) -> Vec<T> {
    in_parallel(count, threads, |number| {
        let outcome = make(number).and_then(|s| run(&s, options, &mut [], &mut |_| {}));
        keep(number, outcome)
    })
}

/// Does `work` for the numbers from zero to `count - 1`, begun in this order, on so many
/// threads (at least one, the caller's among them), or as many as the system grants. Results are in the order of the numbers.
///
/// # Panics
/// If `work` panics.
pub fn in_parallel<T: Send>(
    count: usize,
    threads: usize,
    work: impl Fn(usize) -> T + Sync,
) -> Vec<T> {
    let next = AtomicUsize::new(0);
    let one_thread = || {
        let mut kept = Vec::new();
        loop {
            let number = next.fetch_add(1, Ordering::Relaxed);
            if number >= count {
                return kept;
            }
            kept.push((number, work(number)));
        }
    };
    let mut kept = std::thread::scope(|scope| {
        // Where the system refuses another thread, fewer do the same.
        let another = |_| std::thread::Builder::new().spawn_scoped(scope, one_thread);
        let others: Vec<_> = (1..threads.min(count))
            .map_while(|number| another(number).ok())
            .collect();
        let mut kept = one_thread();
        for other in others {
            match other.join() {
                Ok(more) => kept.extend(more),
                Err(panic) => std::panic::resume_unwind(panic),
            }
        }
        kept
    });
    kept.sort_unstable_by_key(|(number, _)| *number);
    kept.into_iter().map(|(_, kept)| kept).collect()
}
