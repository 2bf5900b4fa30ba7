//! Who is told while the HDF5 library is at work on a file.
//!
//! Whatever the bytes of a file are, a checksum of them matches: the library may crash, hang or
//! ask for all memory on any file that somebody else has written. A process that reads for
//! another one limits itself meanwhile, and says which file it reads.

use std::path::Path;
use std::sync::OnceLock;

/// What is called when reading a file begins, and when it ends.
#[derive(Debug, Clone, Copy)]
pub struct Watcher {
    /// With the file.
    pub begins: fn(&Path),
    /// Nothing is being read any more.
    pub ends: fn(),
}

static WATCHER: OnceLock<Watcher> = OnceLock::new();

/// Has this process watched from here on; the first watcher stays.
pub fn watch(watcher: Watcher) {
    let _ = WATCHER.set(watcher);
}

/// A file is being read as long as this lives. No two of them at a time.
#[derive(Debug)]
#[must_use]
pub struct Reading(());

impl Reading {
    /// Tells that reading begins.
    pub fn of(path: &Path) -> Self {
        if let Some(watcher) = WATCHER.get() {
            (watcher.begins)(path);
        }
        Self(())
    }
}

impl Drop for Reading {
    fn drop(&mut self) {
        if let Some(watcher) = WATCHER.get() {
            (watcher.ends)();
        }
    }
}
