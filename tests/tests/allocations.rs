//! What a run allocates.

mod no_allocation;
mod streaming;
