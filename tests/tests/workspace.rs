//! The workspace itself: what its crates import, and that all its tests are run.
#![allow(clippy::unwrap_used)]

mod layers;
mod modules;
mod reached;

use std::path::Path;
use std::process::Command;

use serde_json::Value;

fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}

/// What cargo tells of the workspace with these arguments. It downloads what no test has needed, as the
/// packages of the book, which is tested after all others.
fn metadata(arguments: &[&str]) -> Value {
    let output = Command::new(env!("CARGO"))
        .args(["metadata", "--format-version=1"])
        .args(arguments)
        .current_dir(root())
        .output()
        .unwrap();
    assert!(output.status.success(), "{output:?}");
    serde_json::from_slice(&output.stdout).unwrap()
}
