//! The workspace itself: what its crates import, and that all its tests are run.
#![allow(clippy::unwrap_used)]

mod layers;
mod reached;

use std::path::Path;

fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}
