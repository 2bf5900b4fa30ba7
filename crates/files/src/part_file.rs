//! A file that is written beside its place.

use std::fs::{File, OpenOptions};
use std::io::{Error, Result, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::TempPath;

/// Part files of this process that stand on the disk.
static STANDING: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn standing() -> MutexGuard<'static, Vec<PathBuf>> {
    STANDING.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Bytes of the target's name that stand in that of its part file: with what follows it
/// stays below 255, which is all that most file systems take.
const NAME: usize = 200;

/// A file that is written beside its place under a name of its own, `NAME.PROCESS-RANDOM.part`,
/// and takes its place when it is whole.
///
/// No other process writes into it, whether file locking works or not: of two processes that
/// write the same target both come to their end, and the last one's file stays. Dropped
/// without [`finish`](Self::finish), the part file is removed, and what stood in its place
/// before is untouched. A process that is killed without notice (SIGKILL) leaves it behind.
#[derive(Debug)]
pub struct PartFile {
    /// Removes the file when it is dropped; `None` once that is done.
    part: Option<TempPath>,
    path: PathBuf,
    target: PathBuf,
}

impl PartFile {
    /// Creates an empty part file beside `target`. A link is followed: the file that it
    /// names will be replaced, not the link.
    ///
    /// # Errors
    /// If the target is a folder or a device, or the folder does not exist or cannot be
    /// written to.
    pub fn beside(target: &Path) -> Result<Self> {
        let target = match target.canonicalize() {
            Ok(real) => real,
            Err(_) => target.to_owned(),
        };
        // Renaming would put the file in the place of a device, such as /dev/stdout.
        if target.exists() && !target.is_file() {
            return Err(Error::other("it is not a regular file"));
        }
        let folder = target
            .parent()
            .filter(|folder| !folder.as_os_str().is_empty())
            .unwrap_or(Path::new("."));
        let name = target.file_name().unwrap_or_default().to_string_lossy();
        let mut end = name.len().min(NAME);
        while !name.is_char_boundary(end) {
            end -= 1;
        }
        let prefix = format!("{}.{}-", &name[..end], std::process::id());
        let mut builder = tempfile::Builder::new();
        builder.prefix(&prefix).suffix(".part");
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            // What any new file gets, less what the user's mask takes away.
            builder.permissions(std::fs::Permissions::from_mode(0o666));
        }
        let mut all = standing();
        let part = builder.tempfile_in(folder)?.into_temp_path();
        let path = part.to_path_buf();
        all.push(path.clone());
        Ok(Self {
            part: Some(part),
            path,
            target,
        })
    }

    /// Where to write. The file is there, and empty at first; it may be opened by name and
    /// truncated, but not replaced.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The file in whose place it will be.
    #[must_use]
    pub fn target(&self) -> &Path {
        &self.target
    }

    /// Brings the file to the disk, puts it in its place, and brings that to the disk.
    ///
    /// # Errors
    /// What the system said; the target is as it was then, and the part file is removed.
    pub fn finish(mut self) -> Result<()> {
        OpenOptions::new()
            .write(true)
            .open(&self.path)?
            .sync_all()?;
        let mut all = standing();
        if let Some(part) = self.part.take() {
            let placed = part.persist(&self.target);
            all.retain(|p| *p != self.path);
            // The error holds the part file and removes it.
            placed.map_err(|e| e.error)?;
        }
        drop(all);
        // The file stands whole in its place. A folder that cannot be opened or brought to the
        // disk, as on some file systems, takes nothing from that.
        if let Some(folder) = self.target.parent() {
            let _ = File::open(folder).and_then(|f| f.sync_all());
        }
        Ok(())
    }
}

impl Drop for PartFile {
    fn drop(&mut self) {
        if let Some(part) = self.part.take() {
            let mut all = standing();
            // Half a file is worthless; one that cannot be removed is in nobody's way.
            let _ = part.close();
            all.retain(|p| *p != self.path);
        }
    }
}

/// Writes a whole file by a [`PartFile`].
///
/// # Errors
/// What the system said; what stood there before is untouched then.
pub fn write(target: &Path, content: &[u8]) -> Result<()> {
    let part = PartFile::beside(target)?;
    OpenOptions::new()
        .write(true)
        .open(part.path())?
        .write_all(content)?;
    part.finish()
}

/// Removes all part files of this process, before it ends without their being dropped. None
/// is begun or finished from here on: whoever tries to waits for the end.
pub fn remove_part_files() {
    let all = standing();
    for path in all.iter() {
        // Nothing can be done about one that stays.
        let _ = std::fs::remove_file(path);
    }
    std::mem::forget(all);
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let entries = std::fs::read_dir(folder).unwrap();
        let mut names: Vec<_> = entries
            .map(|e| e.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn the_target_changes_when_the_part_file_is_whole() {
        let folder = tempfile::tempdir().unwrap();
        let target = folder.path().join("a.txt");
        std::fs::write(&target, "before").unwrap();
        let dropped = PartFile::beside(&target).unwrap();
        let finished = PartFile::beside(&target).unwrap();
        assert_ne!(dropped.path(), finished.path());
        for part in [&dropped, &finished] {
            assert!(part.path().exists());
            assert_eq!(
                part.path().parent(),
                target.canonicalize().unwrap().parent()
            );
            std::fs::write(part.path(), "after").unwrap();
        }
        assert_eq!(std::fs::read(&target).unwrap(), b"before");
        drop(dropped);
        assert!(finished.path().exists());
        assert_eq!(std::fs::read(&target).unwrap(), b"before");
        finished.finish().unwrap();
        assert_eq!(std::fs::read(&target).unwrap(), b"after");
        assert_eq!(names(folder.path()), ["a.txt"]);
    }

    #[test]
    fn names_of_any_length_are_taken() {
        let folder = tempfile::tempdir().unwrap();
        for name in ["a".repeat(255), "\u{20ac}".repeat(85)] {
            write(&folder.path().join(&name), b"x").unwrap();
            assert_eq!(names(folder.path()), [name.clone()]);
            std::fs::remove_file(folder.path().join(name)).unwrap();
        }
    }

    #[test]
    fn folders_are_refused_and_nothing_is_left() {
        let folder = tempfile::tempdir().unwrap();
        let target = folder.path().join("a");
        std::fs::create_dir(&target).unwrap();
        let refused = write(&target, b"x").unwrap_err();
        assert!(refused.to_string().contains("not a regular file"));
        assert!(write(&folder.path().join("missing/a"), b"x").is_err());
        assert_eq!(names(folder.path()), ["a"]);
    }

    #[cfg(unix)]
    #[test]
    fn a_link_stays_a_link() {
        use std::os::unix::fs::{PermissionsExt, symlink};
        let folder = tempfile::tempdir().unwrap();
        let (target, link) = (folder.path().join("a"), folder.path().join("b"));
        std::fs::write(&target, "before").unwrap();
        symlink("a", &link).unwrap();
        write(&link, b"after").unwrap();
        assert!(link.is_symlink());
        assert_eq!(std::fs::read(&target).unwrap(), b"after");
        // Others may read it if the mask lets them: not the 0600 of temporary files.
        let plain = folder.path().join("c");
        std::fs::write(&plain, "").unwrap();
        let mode = |path: &Path| std::fs::metadata(path).unwrap().permissions().mode();
        assert_eq!(mode(&target), mode(&plain));
    }
}
