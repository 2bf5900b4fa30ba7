//! `pounding impact`: every mode, its numbers, its files, and bad input.
mod arguments;
mod collisions;
mod measured;
mod tables;

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

const REFERENCES: &str = include_str!("../../../gap-element/tests/data/impact_models.json");

fn example() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/impact_laboratory")
}

/// Runs in a folder, with arguments that are separated by `|`.
fn run_in(folder: &Path, arguments: &str) -> Output {
    Command::new(env!("CARGO_BIN_EXE_pounding"))
        .current_dir(folder)
        .env("NO_COLOR", "1")
        .arg("impact")
        .args(arguments.split('|').map(str::trim))
        .output()
        .unwrap()
}

fn text_in(folder: &Path, arguments: &str) -> String {
    let output = run_in(folder, arguments);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{arguments}: {errors}");
    String::from_utf8(output.stdout).unwrap()
}

fn text(arguments: &str) -> String {
    text_in(&example(), arguments)
}

fn json(arguments: &str) -> Value {
    let text = text(&format!("{arguments}|--json"));
    assert!(!text.contains("NaN"), "{text}");
    serde_json::from_str(&text).unwrap()
}

fn has(text: &str, parts: &[&str]) {
    for part in parts {
        assert!(text.contains(part), "\"{part}\" is not in: {text}");
    }
}

fn close(value: &Value, expected: f64, relative: f64) {
    let value = value.as_f64().unwrap();
    let size = expected.abs().max(1e-3);
    assert!(
        (value - expected).abs() < relative * size,
        "{value} is not {expected}"
    );
}

/// Equal but for the last digits, which serde_json may miss when it reads.
fn equal(value: f64, expected: &Value) {
    let expected = expected.as_f64().unwrap();
    assert!(
        (value - expected).abs() <= 1e-15 * expected.abs(),
        "{value:e} is not {expected:e}"
    );
}

/// Refused with this exit code and these words, and nothing printed.
fn refused_with(folder: &Path, arguments: &str, code: i32, wanted: &[&str]) {
    let output = run_in(folder, arguments);
    let message = String::from_utf8_lossy(&output.stderr).replace(['│', '\n'], " ");
    let message = message.split_whitespace().collect::<Vec<_>>().join(" ");
    assert_eq!(output.status.code(), Some(code), "{arguments}: {message}");
    assert!(output.stdout.is_empty());
    has(&message, wanted);
}

fn refused(arguments: &str, wanted: &[&str]) {
    refused_with(&example(), arguments, 2, wanted);
}
