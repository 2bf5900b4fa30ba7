//! The program under test, run with arguments that are separated by blanks.

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
