//! Work on all cores, in the order of its numbers, with its progress.

use std::sync::Mutex;

/// Given how many of how many pieces of work are done.
pub type Progress<'a> = &'a (dyn Fn(usize, usize) + Sync);

/// Does `work` for the numbers from zero to `count - 1` on so many threads (at least
/// one). Results are in order and do not depend on the number of threads.
pub(crate) fn in_parallel<T: Send>(
    count: usize,
    threads: usize,
    progress: Progress<'_>,
    work: impl Fn(usize) -> T + Sync,
) -> Vec<T> {
    let done = Mutex::new(0);
    pounding_time_history::in_parallel(count, threads, |number| {
        let kept = work(number);
        // Counted under the lock: nobody is reported of fewer after more.
        let mut done = done.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
        *done += 1;
        progress(*done, count);
        kept
    })
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
            };
            let squares = in_parallel(20, threads, &tell, |i| i * i);
            assert_eq!(squares, (0..20).map(|i| i * i).collect::<Vec<_>>());
            let reported = reported.into_inner().unwrap_or_default();
            assert_eq!(reported, (1..=20).map(|i| (i, 20)).collect::<Vec<_>>());
        }
        assert!(in_parallel(0, 2, &|_, _| {}, |i| i).is_empty());
    }
}
