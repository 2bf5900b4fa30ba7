//! When finished runs are stored.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use super::Parts;
use crate::runs::Row;

/// Takes finished runs, and stores them when there are enough or when time is up.
///
/// Pieces that were written because time was up are small. As soon as they hold enough runs
/// together they are written as one, so that a long study has no more files than a fast one.
#[derive(Debug)]
pub(crate) struct Store<'p> {
    parts: &'p mut Parts,
    /// Runs that are enough.
    most: usize,
    /// Time that a finished run waits at most.
    every: Duration,
    last: Instant,
    /// Rows that are not stored yet.
    waiting: Vec<Row>,
    /// Rows that are stored in small pieces, and these.
    small: (Vec<Row>, Vec<PathBuf>),
}

impl<'p> Store<'p> {
    /// Stores into a folder, `most` runs at once, or what there is after `every`.
    pub(crate) fn new(parts: &'p mut Parts, most: usize, every: Duration) -> Self {
        Self {
            parts,
            most,
            every,
            last: Instant::now(),
            waiting: Vec::new(),
            small: (Vec::new(), Vec::new()),
        }
    }

    /// The folder.
    pub(crate) fn folder(&self) -> PathBuf {
        self.parts.folder.clone()
    }

    /// What is stored.
    pub(crate) fn parts(&self) -> &Parts {
        self.parts
    }

    /// Takes a finished run.
    pub(crate) fn take(&mut self, row: Row) {
        self.waiting.push(row);
    }

    /// Finished runs that are not stored.
    pub(crate) fn waiting(&self) -> usize {
        self.waiting.len()
    }

    /// Stores what waits if there is enough, or if time is up; says whether it has.
    ///
    /// # Errors
    /// What the system said; what was stored before stays.
    pub(crate) fn store_if_due(&mut self) -> std::io::Result<bool> {
        if self.waiting.len() + self.small.0.len() >= self.most {
            let mut rows = std::mem::take(&mut self.small.0);
            rows.append(&mut self.waiting);
            self.write(&mut rows)?;
            for path in self.small.1.drain(..) {
                // Its runs stand in the new piece, too: it does no harm.
                let _ = std::fs::remove_file(path);
            }
            return Ok(true);
        }
        if self.last.elapsed() >= self.every {
            self.store()?;
            return Ok(true);
        }
        Ok(false)
    }

    /// Stores what waits.
    ///
    /// # Errors
    /// What the system said; what was stored before stays.
    pub(crate) fn store(&mut self) -> std::io::Result<()> {
        if !self.waiting.is_empty() {
            let mut rows = std::mem::take(&mut self.waiting);
            let path = self.write(&mut rows)?;
            self.small.0.append(&mut rows);
            self.small.1.push(path);
        }
        self.last = Instant::now();
        Ok(())
    }

    fn write(&mut self, rows: &mut [Row]) -> std::io::Result<PathBuf> {
        rows.sort_unstable_by_key(|r| r.run);
        let path = self.parts.write(rows)?;
        self.last = Instant::now();
        Ok(path)
    }
}
