//! The folder of the finished runs of a result, beside it.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{Error, ErrorKind};
use std::ops::Range;
use std::path::{Path, PathBuf};

use super::piece;
use crate::error::StudyError;
use crate::runs::Row;

/// The file that tells whose runs lie here.
const STUDY: &str = "study.txt";
/// The file that one process at a time holds.
const LOCK: &str = "lock";
/// How often a folder that another process is just removing is made anew.
const TRIES: usize = 10;

/// The piece of a run that is not stored.
const NOWHERE: u32 = u32::MAX;

/// Finished runs of one study, or of one shard of it.
#[derive(Debug)]
pub(crate) struct Parts {
    pub folder: PathBuf,
    study: String,
    /// Chunks of this shard, in order; all have one length, but the last may be shorter.
    pub chunks: Vec<Range<usize>>,
    /// All pieces that were read or written.
    pieces: Vec<PathBuf>,
    /// The piece in which each run stands, or [`NOWHERE`], by the run's place among those of this
    /// shard: four bytes a run, as there may be ten million.
    stored: Vec<u32>,
    /// Held as long as this lives.
    _lock: File,
}

impl Parts {
    /// The folder of the finished runs of a result, `<name>.parts`.
    pub(crate) fn folder(result: &Path) -> PathBuf {
        let mut name = result.file_name().unwrap_or_default().to_owned();
        name.push(".parts");
        result.with_file_name(name)
    }

    /// Opens the folder of a result; makes it if it is not there.
    ///
    /// # Errors
    /// Runs of an earlier call without `resume`, those of another study, another
    /// process at work there, or a folder that cannot be made.
    pub(crate) fn open(
        result: &Path,
        study: &str,
        chunks: Vec<Range<usize>>,
        resume: bool,
    ) -> Result<Self, StudyError> {
        let folder = Self::folder(result);
        let lock = lock(&folder)?;
        let runs = chunks.iter().map(Range::len).sum();
        let mut parts = Self {
            folder,
            study: study.to_owned(),
            chunks,
            pieces: Vec::new(),
            stored: vec![NOWHERE; runs],
            _lock: lock,
        };
        parts.claim(resume)?;
        Ok(parts)
    }

    /// Writes whose folder this is, or finds that it is ours.
    fn claim(&mut self, resume: bool) -> Result<(), StudyError> {
        let path = self.folder.join(STUDY);
        let folder = self.folder.clone();
        let failed = |what| {
            let path = path.clone();
            move |source| StudyError::File { what, path, source }
        };
        match pounding_files::input::read_to_string(&path) {
            Ok(text) if text != self.study => Err(self.other(&text)),
            Ok(_) => {
                self.look();
                let stored = self.stored.iter().filter(|p| **p != NOWHERE).count();
                if stored > 0 && !resume {
                    return Err(StudyError::Unfinished { folder, stored });
                }
                Ok(())
            }
            Err(e) if e.kind() == ErrorKind::NotFound => {
                pounding_files::write_own(&path, self.study.as_bytes()).map_err(failed("write"))
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

    /// Finds out which runs are stored whole, and where.
    fn look(&mut self) {
        for path in files(&self.folder, &["runs"]) {
            // What is damaged is made again.
            let rows = piece::read(&path, &self.study).unwrap_or_default();
            self.note(path, &rows);
        }
    }

    /// Notes where these rows are stored.
    fn note(&mut self, path: PathBuf, rows: &[Row]) {
        // More pieces than that are more files than file systems hold.
        let piece = u32::try_from(self.pieces.len()).unwrap_or(NOWHERE);
        for row in rows {
            if let Some(place) = self.place(row.run) {
                self.stored[place] = piece;
            }
        }
        self.pieces.push(path);
    }

    /// The place of a run among those of this shard; `None` if it is of another one.
    fn place(&self, run: usize) -> Option<usize> {
        let chunk = self.chunks.partition_point(|c| c.end <= run);
        let inside = self.chunks.get(chunk).filter(|c| c.contains(&run))?;
        Some(chunk * self.chunks[0].len() + run - inside.start)
    }

    /// The piece in which a run stands; `None` if it is not stored.
    fn piece(&self, run: usize) -> Option<&Path> {
        let piece = *self.stored.get(self.place(run)?)?;
        Some(self.pieces.get(usize::try_from(piece).ok()?)?.as_path())
    }

    /// How many runs are stored in pieces that are still there.
    pub(crate) fn standing(&self) -> usize {
        let there: Vec<bool> = self.pieces.iter().map(|piece| piece.is_file()).collect();
        let stands = |piece: &&u32| {
            let number = usize::try_from(**piece).ok();
            number.and_then(|number| there.get(number)) == Some(&true)
        };
        self.stored.iter().filter(stands).count()
    }

    /// Runs that are not stored, in order.
    pub(crate) fn left(&self) -> Vec<usize> {
        let all = self.chunks.iter().flat_map(Clone::clone);
        let stored = all.zip(&self.stored);
        stored
            .filter(|(_, piece)| **piece == NOWHERE)
            .map(|(run, _)| run)
            .collect()
    }

    /// Stores some rows, which are in the order of their runs, as a piece.
    ///
    /// # Errors
    /// What the system said; the other pieces stay as they are.
    pub(super) fn write(&mut self, rows: &[Row]) -> std::io::Result<PathBuf> {
        let content = piece::encode(&self.study, rows);
        let path = self.folder.join(piece::name(&content, rows));
        pounding_files::write_own(&path, &content)?;
        self.note(path.clone(), rows);
        Ok(path)
    }

    /// Hands all rows over, in the order of their runs.
    ///
    /// # Errors
    /// A run that is not stored, a piece that is not whole, or what `take` says.
    pub(crate) fn rows(
        &self,
        take: &mut dyn FnMut(Row) -> Result<(), StudyError>,
    ) -> Result<(), StudyError> {
        let mut rows = RowsInOrder::default();
        while let Some(row) = rows.next(self)? {
            take(row)?;
        }
        match rows.awaited(self) {
            Some(run) => Err(self.unreadable(lost(run))),
            None => Ok(()),
        }
    }

    fn unreadable(&self, source: Error) -> StudyError {
        StudyError::File {
            what: "read the finished runs in",
            path: self.folder.clone(),
            source,
        }
    }

    /// Whether finished runs of this very study, shard and build are kept for a result.
    pub(crate) fn hold(result: &Path, study: &str) -> bool {
        let path = Self::folder(result).join(STUDY);
        pounding_files::input::read_to_string(&path).is_ok_and(|text| text == study)
    }

    /// Removes the folder of a result that stands complete, if it holds runs of this very
    /// study, shard and build, and no process is at work there. Any other folder stays.
    pub(crate) fn discard(result: &Path, study: &str) {
        let folder = Self::folder(result);
        let ours = || Self::hold(result, study);
        // Looked at before the lock, which would leave its file in a folder of others, and
        // under it, as another process may have begun anew in between.
        if !ours() {
            return;
        }
        let Ok(lock) = lock(&folder) else { return };
        if ours() {
            let parts = Self {
                folder: folder.clone(),
                study: study.to_owned(),
                chunks: Vec::new(),
                pieces: Vec::new(),
                stored: Vec::new(),
                _lock: lock,
            };
            // A folder that stays does no harm.
            let _ = parts.remove();
        }
    }

    /// Removes what is ours, when its runs are in the result. A file of somebody else stays,
    /// and the folder with it.
    pub(crate) fn remove(self) -> std::io::Result<()> {
        // With the part files of killed processes: nobody else writes any under the lock.
        for path in files(&self.folder, &["runs", "part"]) {
            std::fs::remove_file(path)?;
        }
        std::fs::remove_file(self.folder.join(STUDY))?;
        // Last of all: who comes now makes a folder of its own.
        std::fs::remove_file(self.folder.join(LOCK))?;
        std::fs::remove_dir(&self.folder)
    }
}

/// The rows of a folder one after another, in the order of their runs, while more are stored.
#[derive(Debug, Default)]
pub(crate) struct RowsInOrder {
    /// Chunk of the next run, and which of its runs it is.
    at: (usize, usize),
    /// Rows that were read with others of their piece. Runs are made nearly in order, so that few
    /// pieces are open at a time.
    open: BTreeMap<usize, Row>,
}

impl RowsInOrder {
    /// The run whose row comes next; `None` if there is none.
    fn awaited(&mut self, parts: &Parts) -> Option<usize> {
        while let Some(chunk) = parts.chunks.get(self.at.0) {
            if self.at.1 < chunk.len() {
                return Some(chunk.start + self.at.1);
            }
            self.at = (self.at.0 + 1, 0);
        }
        None
    }

    /// The next row; `None` at the end, and where its run is not stored yet.
    ///
    /// # Errors
    /// A piece that is not whole.
    pub(crate) fn next(&mut self, parts: &Parts) -> Result<Option<Row>, StudyError> {
        let Some(run) = self.awaited(parts) else {
            return Ok(None);
        };
        if !self.open.contains_key(&run) {
            let Some(path) = parts.piece(run) else {
                return Ok(None);
            };
            let rows = piece::read(path, &parts.study).map_err(|e| parts.unreadable(e))?;
            let ahead = rows.into_iter().filter(|row| row.run >= run);
            self.open.extend(ahead.map(|row| (row.run, row)));
        }
        let row = self.open.remove(&run);
        let row = row.ok_or_else(|| parts.unreadable(lost(run)))?;
        self.at.1 += 1;
        Ok(Some(row))
    }
}

fn lost(run: usize) -> Error {
    let text = format!("run {run} was stored, but its file is gone or damaged");
    Error::new(ErrorKind::NotFound, text)
}

/// The files of a folder that end so, in the order of their names.
fn files(folder: &Path, ends: &[&str]) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten();
    let paths = entries.filter_map(|entry| entry.ok().map(|e| e.path()));
    let wanted = |path: &PathBuf| {
        let end = path.extension().and_then(|e| e.to_str());
        end.is_some_and(|e| ends.contains(&e))
    };
    let mut files: Vec<PathBuf> = paths.filter(wanted).collect();
    files.sort();
    files
}

/// Makes the folder if it is not there, and takes its lock.
fn lock(folder: &Path) -> Result<File, StudyError> {
    let failed = |what: &'static str, path: &Path| {
        let path = path.to_owned();
        move |source| StudyError::File { what, path, source }
    };
    let path = folder.join(LOCK);
    let mut tries = 0;
    loop {
        tries += 1;
        std::fs::create_dir_all(folder).map_err(failed("make the folder", folder))?;
        let lock = match pounding_files::open_lock(&path) {
            // Another process has finished and removed the folder in between.
            Err(e) if e.kind() == ErrorKind::NotFound && tries < TRIES => continue,
            made => made.map_err(failed("write", &path))?,
        };
        match lock.try_lock() {
            Err(std::fs::TryLockError::WouldBlock) => {
                return Err(StudyError::Busy {
                    folder: folder.to_owned(),
                });
            }
            // A file system without locks: nothing to hold.
            Ok(()) | Err(std::fs::TryLockError::Error(_)) => {}
        }
        // Held, but perhaps only what another process had held and has removed.
        if is_at(&lock, &path) || tries == TRIES {
            return Ok(lock);
        }
    }
}

/// Whether an open file is the one that its path names.
#[cfg(unix)]
fn is_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let number = |m: std::fs::Metadata| (m.dev(), m.ino());
    match (file.metadata(), path.symlink_metadata()) {
        (Ok(a), Ok(b)) => number(a) == number(b),
        _ => false,
    }
}

#[cfg(not(unix))]
fn is_at(_: &File, path: &Path) -> bool {
    path.exists()
}
