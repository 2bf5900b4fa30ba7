//! New HDF5 files.

use std::path::Path;

use hdf5::{File, FileBuilder, Result};

/// What makes a file whose groups and datasets are in the oldest form that holds them, as of every
/// release of HDF5 before the second. That one takes a newer form for its own, which keeps the
/// time at which groups were made: files with the same results would differ.
pub(crate) fn builder() -> FileBuilder {
    let mut builder = FileBuilder::new();
    builder.with_fapl(|list| list.libver_earliest());
    builder
}

/// A new file at this path.
///
/// # Errors
/// What HDF5 says.
pub(crate) fn create(path: &Path) -> Result<File> {
    builder().create(path)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::create;

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
