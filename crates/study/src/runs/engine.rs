//! All cores on the runs of a study.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::sync_channel;

use super::runner::{Row, Runner};
use crate::error::StudyError;

/// Rows that may wait for the thread that stores them, for each thread that makes them.
const WAITING: usize = 16;

/// Makes the runs of some chunks on so many threads and hands every chunk, rows in order,
/// to `store` when its last run is done. Chunks come in any order; each row is the same
/// whatever the number of threads. `tick` is told of every row.
///
/// # Errors
/// The first error of `store`, after which no more runs are begun.
pub(crate) fn run_all(
    runner: &Runner<'_>,
    chunks: &[Range<usize>],
    threads: usize,
    tick: &mut dyn FnMut(&Row),
    store: &mut dyn FnMut(Range<usize>, Vec<Row>) -> Result<(), StudyError>,
) -> Result<(), StudyError> {
    // Runs of all chunks as one sequence: `starts[c]` come before chunk c.
    let mut starts = vec![0];
    for chunk in chunks {
        starts.push(starts.last().copied().unwrap_or(0) + chunk.len());
    }
    let total = starts.last().copied().unwrap_or(0);
    let threads = threads.clamp(1, total.max(1));
    let (next, stop) = (AtomicUsize::new(0), AtomicBool::new(false));
    let (sender, receiver) = sync_channel::<(usize, Row)>(WAITING * threads);
    std::thread::scope(|scope| {
        for _ in 0..threads {
            let sender = sender.clone();
            let (next, stop, starts) = (&next, &stop, &starts);
            scope.spawn(move || {
                while !stop.load(Ordering::Relaxed) {
                    let at = next.fetch_add(1, Ordering::Relaxed);
                    if at >= total {
                        return;
                    }
                    let chunk = starts.partition_point(|s| *s <= at) - 1;
                    let row = runner.row(chunks[chunk].start + at - starts[chunk]);
                    // The other end is gone only if the study has stopped.
                    if sender.send((chunk, row)).is_err() {
                        return;
                    }
                }
            });
        }
        drop(sender);
        let mut open: BTreeMap<usize, Vec<Row>> = BTreeMap::new();
        let mut result = Ok(());
        for (chunk, row) in receiver {
            if result.is_err() {
                continue;
            }
            tick(&row);
            let rows = open.entry(chunk).or_default();
            rows.push(row);
            if rows.len() == chunks[chunk].len() {
                let mut rows = open.remove(&chunk).unwrap_or_default();
                rows.sort_unstable_by_key(|r| r.run);
                result = store(chunks[chunk].clone(), rows);
                if result.is_err() {
                    stop.store(true, Ordering::Relaxed);
                }
            }
        }
        result
    })
}
