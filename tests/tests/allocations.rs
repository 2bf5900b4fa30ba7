//! What a run allocates.
#![allow(clippy::unwrap_used)]

mod no_allocation;
mod streaming;
