//! `pounding motion`: what it prints, what it writes, what it refuses.
mod code_spectra;
mod examples;
mod files;
mod headers;
mod made;
mod options;
mod pages;
mod refused;
mod shown;

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

fn el_centro() -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"));
    path.join("../../ground_motions/el_centro_1940_ns.csv")
        .display()
        .to_string()
}

/// Runs `pounding motion ARGUMENTS`.
fn run(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_pounding"))
        .env("NO_COLOR", "1")
        .arg("motion")
        .args(arguments)
        .output()
        .unwrap()
}

/// What it prints if all went well.
fn text(arguments: &[&str]) -> String {
    let output = run(arguments);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {errors}");
    String::from_utf8(output.stdout).unwrap()
}

fn json(arguments: &[&str]) -> Value {
    let mut all = arguments.to_vec();
    all.push("--json");
    serde_json::from_str(&text(&all)).unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

fn close(value: f64, expected: f64, relative: f64) {
    assert!(
        (value - expected).abs() <= relative * expected.abs(),
        "{value} is not {expected}"
    );
}

/// A file of a folder that goes with the test.
struct Folder(tempfile::TempDir);

impl Folder {
    fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn name(&self, name: &str) -> String {
        self.path(name).display().to_string()
    }

    fn content(&self, name: &str) -> String {
        std::fs::read_to_string(self.path(name)).unwrap()
    }

    /// Names of all files: nothing half written may stay.
    fn files(&self) -> Vec<String> {
        let mut names: Vec<String> = std::fs::read_dir(self.0.path())
            .unwrap()
            .map(|f| f.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }
}

/// Rows of numbers below a header.
fn rows(content: &str) -> Vec<Vec<f64>> {
    content
        .lines()
        .filter(|l| !l.starts_with('#'))
        .skip(1)
        .map(|l| l.split(',').map(|x| x.parse().unwrap()).collect())
        .collect()
}
