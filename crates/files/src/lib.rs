//! Files that are written whole or not at all, never in the place of an input, and checked
//! when they are read back.
//!
//! The crate knows nothing of what stands in a file. Everything that the program writes
//! goes into a [`PartFile`] beside its place first, and what it reads is a regular file ([`input`]); what a command reads and will write is
//! held against one another by [`FileUse`] before it does any work; [`checksum`] tells of
//! what is read back whether it is as it was written, and [`label`] what it is, before anybody
//! parses it.

pub mod checksum;
mod file_use;
pub mod input;
pub mod label;
mod label_line;
mod lock_file;
mod part_file;

pub use file_use::{FileUse, FileUseError, ends_in_a_file_name, same_file};
pub use lock_file::open_lock;
pub use part_file::{
    AskedOfTargets, ELSEWHERE, LeftOver, PartFile, PlaceTaken, ask_of_targets, free_name,
    left_over, left_over_in, not_own, remove_left_by, remove_part_files, runs_here,
    tell_of_replaced, write, write_own,
};
