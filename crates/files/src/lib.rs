//! Files that are written whole or not at all.
//!
//! The crate knows nothing of what stands in a file. Everything that the program writes
//! goes into a [`PartFile`] beside its place first; [`checksum`] tells of what is read back
//! whether it is as it was written.

pub mod checksum;
mod part_file;

pub use part_file::{PartFile, remove_part_files, write};
