//! Files of HDF5, new ones and others.

use std::path::Path;

use hdf5::{File, FileBuilder, Result};

/// What makes a file whose groups and datasets are in the oldest form that holds them, as of every
/// release of HDF5 before the second. That one takes a newer form for its own, which keeps the
/// time at which groups were made: files with the same results would differ.
pub(crate) fn builder() -> FileBuilder {
    let mut builder = without_lock();
    builder.with_fapl(|list| list.libver_earliest());
    builder
}

/// What makes and opens files without a lock, which network file systems may refuse: a new file has a
/// name of its own until it is whole, and another one was compared with its checksum.
/// The variable `HDF5_USE_FILE_LOCKING` has the last word.
fn without_lock() -> FileBuilder {
    #[cfg_attr(
        not(file_locking),
        expect(unused_mut, reason = "HDF5 is too old for it")
    )]
    let mut builder = FileBuilder::new();
    #[cfg(file_locking)]
    builder.with_fapl(|list| list.file_locking(false));
    builder
}

/// The file at this path, to be read.
///
/// # Errors
/// What HDF5 says.
pub(crate) fn open(path: &Path) -> Result<File> {
    without_lock().open(path)
}

/// A new file at this path.
///
/// # Errors
/// What HDF5 says.
pub(crate) fn create(path: &Path) -> Result<File> {
    builder().create(path)
}

#[cfg(test)]
mod tests {
    use super::{create, open};

    /// Where a lock cannot be had, as another process holds it or as the file system has none.
    #[test]
    #[cfg(file_locking)]
    fn files_are_made_and_opened_without_a_lock() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.h5");
        let held = std::fs::File::create(&path).unwrap();
        held.lock().unwrap();
        // With a lock of its own HDF5 says: unable to lock file.
        create(&path).unwrap().create_group("group").unwrap();
        assert_eq!(open(&path).unwrap().member_names().unwrap(), ["group"]);
    }

    /// Files of different times are the same, whichever HDF5 is linked in.
    #[test]
    fn files_do_not_know_when_they_were_made() {
        let folder = tempfile::tempdir().unwrap();
        let bytes = |name: &str| {
            let path = folder.path().join(name);
            let file = create(&path).unwrap();
            file.create_group("group").unwrap();
            file.close().unwrap();
            std::fs::read(path).unwrap()
        };
        let first = bytes("first.h5");
        // The form with times stores whole seconds.
        std::thread::sleep(std::time::Duration::from_millis(1100));
        assert!(first == bytes("second.h5"));
        // Version 0 of the superblock, that of the oldest form.
        assert_eq!(first[8], 0);
    }
}
