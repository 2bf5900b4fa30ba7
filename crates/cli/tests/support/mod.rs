//! The program under test, run with arguments that are separated by blanks.
#![allow(clippy::unwrap_used)]

pub mod part_files;

use std::path::Path;
use std::process::{Command, Output};

/// Runs `pounding COMMAND ARGUMENTS`.
pub fn run(command: &str, arguments: &str) -> Output {
    Command::new(env!("CARGO_BIN_EXE_pounding"))
        .env("NO_COLOR", "1")
        .arg(command)
        .args(arguments.split_whitespace())
        .output()
        .unwrap()
}

/// What it prints if all went well.
pub fn text(command: &str, arguments: &str) -> String {
    let output = run(command, arguments);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{arguments}: {errors}");
    String::from_utf8(output.stdout).unwrap()
}

/// Changes a file by HDF5, which cuts off what follows the content.
pub fn edit(path: &Path, change: impl FnOnce(&hdf5::File)) {
    let file = hdf5::File::open_rw(path).unwrap();
    change(&file);
    file.close().unwrap();
    // HDF5's lock lives on in a process that another test is just starting: another file takes
    // the place of the one that was locked.
    let bytes = std::fs::read(path).unwrap();
    std::fs::remove_file(path).unwrap();
    std::fs::write(path, bytes).unwrap();
}
