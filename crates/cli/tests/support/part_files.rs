//! Part files that a command left behind.

use std::path::Path;

/// Nobody's part file stands in the folder.
pub fn no_part_file(folder: &Path) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        assert!(!name.ends_with(".part"), "{name}");
    }
}
