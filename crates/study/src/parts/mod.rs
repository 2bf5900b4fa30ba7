//! Finished runs on the disk, a few of them per file.
//!
//! A file that HDF5 was writing when its process was killed may be lost as a whole.
//! Finished runs therefore go into small files of their own, pieces, each a part file that
//! takes its name when it is whole, and checked by a hash when it is read. A piece is
//! written when enough runs have finished or enough time has passed: a kill or a full disk
//! loses the runs in flight, those that finished since, and nothing else. Which runs share a
//! piece depends on the clock and the threads; the result does not.

mod folder;
mod piece;
mod store;

pub(crate) use folder::{Parts, RowsInOrder};
pub(crate) use store::Store;
