//! Tables of the command line as they are read, by snapshots in `snapshots/`. After a change
//! that is meant: `INSTA_UPDATE=always cargo test -p pounding-cli --test integration tables`, and
//! read the difference.
#![allow(clippy::unwrap_used)]

use std::path::Path;
use std::process::Command;

/// What the program writes on standard output, started at the root of the repository.
fn written(arguments: &[&str], code: i32) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_pounding"))
        .args(arguments)
        // By which help is wrapped.
        .env_remove("COLUMNS")
        .current_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("../.."))
        .output()
        .unwrap();
    let failed = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "{failed}");
    String::from_utf8(output.stdout).unwrap()
}

/// Without what changes from one machine, version or run to another: the number between the two
/// texts becomes `...`, wherever they stand in a line.
fn without(text: &str, before: &str, after: &str) -> String {
    let line = |line: &str| -> Option<String> {
        let from = line.find(before)? + before.len();
        let to = from + line[from..].find(after)?;
        Some(format!("{}...{}", &line[..from], &line[to..]))
    };
    let lines = text.lines();
    lines
        .map(|l| line(l).unwrap_or_else(|| l.to_owned()) + "\n")
        .collect()
}

#[test]
fn help() {
    insta::assert_snapshot!(written(&["--help"], 0));
}

#[test]
fn check() {
    insta::assert_snapshot!(written(
        &["check", "examples/three_storey_pair/case.toml"],
        0
    ));
}

#[test]
fn run() {
    let case = "examples/three_storey_pair/case.toml";
    let text = written(&["run", case, "--no-output"], 0);
    let text = without(&text, "residual ", " of the largest input");
    insta::assert_snapshot!(without(&text, " events; ", " s"));
}

#[test]
fn gap() {
    let case = "examples/gap_check/case.toml";
    insta::assert_snapshot!(written(&["gap", case, "--records", "ground_motions"], 1));
}
