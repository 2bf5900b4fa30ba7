//! The folder of the finished chunks of a result, beside it.

use std::fs::File;
use std::ops::Range;
use std::path::{Path, PathBuf};

use super::chunk::{read_chunk, write_chunk};
use crate::error::StudyError;
use crate::runs::Row;

/// The file that tells whose chunks lie here.
const STUDY: &str = "study.txt";
/// The file that one process at a time holds.
const LOCK: &str = "lock";

/// Finished chunks of one study, or of one shard of it.
#[derive(Debug)]
pub(crate) struct Parts {
    pub folder: PathBuf,
    study: String,
    /// Chunks of this shard, in order.
    pub chunks: Vec<Range<usize>>,
    /// Held as long as this lives.
    _lock: File,
}

impl Parts {
    /// Opens the folder of a result, `<name>.parts`; makes it if it is not there.
    ///
    /// # Errors
    /// Chunks of an earlier call without `resume`, those of another study, another
    /// process at work there, or a folder that cannot be made.
    pub(crate) fn open(
        result: &Path,
        study: &str,
        chunks: Vec<Range<usize>>,
        resume: bool,
    ) -> Result<Self, StudyError> {
        let mut name = result.file_name().unwrap_or_default().to_owned();
        name.push(".parts");
        let folder = result.with_file_name(name);
        let failed = |what: &'static str, path: &Path| {
            let path = path.to_owned();
            move |source| StudyError::File { what, path, source }
        };
        std::fs::create_dir_all(&folder).map_err(failed("make the folder", &folder))?;
        let path = folder.join(LOCK);
        let lock = File::create(&path).map_err(failed("write", &path))?;
        match lock.try_lock() {
            Ok(()) => {}
            Err(std::fs::TryLockError::WouldBlock) => return Err(StudyError::Busy { folder }),
            // A file system without locks: nothing to hold.
            Err(std::fs::TryLockError::Error(_)) => {}
        }
        let parts = Self {
            folder,
            study: study.to_owned(),
            chunks,
            _lock: lock,
        };
        parts.claim(resume)?;
        Ok(parts)
    }

    /// Writes whose folder this is, or finds that it is ours.
    fn claim(&self, resume: bool) -> Result<(), StudyError> {
        let path = self.folder.join(STUDY);
        let folder = || self.folder.clone();
        let failed = |what| {
            let path = path.clone();
            move |source| StudyError::File { what, path, source }
        };
        match std::fs::read_to_string(&path) {
            Ok(text) if text != self.study => Err(self.other(&text)),
            Ok(_) => {
                let all: usize = self.chunks.iter().map(Range::len).sum();
                let stored = all - self.left().iter().map(Range::len).sum::<usize>();
                if stored > 0 && !resume {
                    return Err(StudyError::Unfinished {
                        folder: folder(),
                        stored,
                    });
                }
                Ok(())
            }
            Err(e) if e.kind() == std::io::ErrorKind::NotFound => {
                let part = path.with_extension("writing");
                std::fs::write(&part, &self.study)
                    .and_then(|()| std::fs::rename(&part, &path))
                    .map_err(failed("write"))
            }
            Err(e) => Err(failed("read")(e)),
        }
    }

    /// Whose runs they are that are not ours.
    fn other(&self, theirs: &str) -> StudyError {
        let folder = self.folder.clone();
        match (theirs.split_once('\n'), self.study.split_once('\n')) {
            (Some((study, build)), Some((ours, this))) if study == ours => StudyError::OtherBuild {
                folder,
                build: build.to_owned(),
                this: this.to_owned(),
            },
            _ => StudyError::OtherStudy { folder },
        }
    }

    fn path(&self, chunk: &Range<usize>) -> PathBuf {
        self.folder.join(format!("{:012}.runs", chunk.start))
    }

    /// Chunks that have no whole file yet.
    pub(crate) fn left(&self) -> Vec<Range<usize>> {
        let missing = |chunk: &&Range<usize>| self.read(chunk).is_err();
        self.chunks.iter().filter(missing).cloned().collect()
    }

    /// Rows of a chunk.
    ///
    /// # Errors
    /// A file that is not there or not whole.
    pub(crate) fn read(&self, chunk: &Range<usize>) -> std::io::Result<Vec<Row>> {
        read_chunk(&self.path(chunk), &self.study, chunk)
    }

    /// Stores the rows of a chunk.
    ///
    /// # Errors
    /// What the system said; the other chunks stay as they are.
    pub(crate) fn write(&self, chunk: &Range<usize>, rows: &[Row]) -> std::io::Result<()> {
        write_chunk(&self.path(chunk), &self.study, rows)
    }

    /// Removes the folder, when its runs are in the result.
    pub(crate) fn remove(self) -> std::io::Result<()> {
        std::fs::remove_dir_all(&self.folder)
    }
}
