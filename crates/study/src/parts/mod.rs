//! Finished runs on the disk, a file a chunk.
//!
//! A file that HDF5 was writing when its process was killed may be lost as a whole.
//! Finished runs therefore go into small files of their own, each written beside its
//! place, brought to the disk, renamed, and checked by a hash when it is read: a kill or a
//! full disk loses the chunk in flight and nothing else.

mod chunk;
mod folder;

pub(crate) use folder::Parts;
