//! `pounding gap`.
mod answers;
mod codes;
mod collapse;
mod inputs;
mod widths;

use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn gap(example: &str, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_pounding"))
        .arg("gap")
        .arg(root().join("examples").join(example).join("case.toml"))
        .args(arguments)
        .current_dir(root())
        .output()
        .unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

fn json(output: &Output) -> Value {
    serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{}", text(&output.stderr)))
}

fn close(value: &Value, expected: f64, relative: f64) {
    let value = value.as_f64().unwrap();
    assert!(
        (value / expected - 1.0).abs() < relative,
        "{value} is not {expected}"
    );
}

fn named<'a>(list: &'a Value, key: &str, name: &str) -> &'a Value {
    let list = list.as_array().unwrap();
    list.iter()
        .find(|x| x[key] == name)
        .unwrap_or_else(|| panic!("{name}"))
}

/// A folder with a case of two buildings that are alike, a gap of this width apart.
fn alike_buildings(width: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let case = std::fs::read_to_string(root().join("examples/three_storey_pair/case.toml"));
    let records = root().join("ground_motions").display().to_string();
    let case = case
        .unwrap()
        .replace("\"1000 t\"", "\"25 t\"")
        .replace("\"2215 MN/m\"", "\"3.46 MN/m\"")
        .replace("\"20 mm\"", &format!("\"{width}\""))
        .replace("\"31 s\"", "\"10 s\"")
        .replace("../../ground_motions", &records);
    std::fs::write(folder.path().join("case.toml"), case).unwrap();
    folder
}

fn gap_in(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_pounding"))
        .args(["gap", "case.toml"])
        .args(arguments)
        .current_dir(folder)
        .output()
        .unwrap()
}

/// The example with another gap, the record where the case finds it.
fn example_with(width: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let case = std::fs::read_to_string(root().join("examples/three_storey_pair/case.toml"));
    let records = root().join("ground_motions").display().to_string();
    let case = case
        .unwrap()
        .replace("\"20 mm\"", width)
        .replace("../../ground_motions", &records);
    std::fs::write(folder.path().join("case.toml"), case).unwrap();
    folder
}

/// The example with storeys that yield under gravity, so that a strong motion overturns the light
/// building.
fn example_that_collapses(width: &str) -> tempfile::TempDir {
    let folder = example_with(width);
    let file = folder.path().join("case.toml");
    let case = std::fs::read_to_string(&file).unwrap();
    let law = "height = \"3 m\"\np_delta = true\nlaw = { model = \"elastic_perfectly_plastic\", yield_force = \"110 kN\" }";
    let case = case
        .replacen("height = \"3 m\"", law, 1)
        .replace("damping_ratio = 0.35", "restitution = 0.65");
    std::fs::write(&file, case).unwrap();
    folder
}

/// The seven motions of the suite, and what comes after.
fn seven<'a>(motions: &'a [String], more: &[&'a str]) -> Vec<&'a str> {
    let mut arguments = vec!["--records"];
    arguments.extend(motions.iter().map(String::as_str));
    arguments.extend(["--points", "0"]);
    arguments.extend(more);
    arguments
}

fn motions(count: usize) -> Vec<String> {
    (1..=count)
        .map(|i| format!("examples/synthetic_suite/motion_{i}.csv"))
        .collect()
}

fn gap_of_folder(command: &str, folder: &Path) -> Output {
    let mut arguments = vec![command, "examples/gap_check/case.toml", "--records"];
    let folder = folder.display().to_string();
    arguments.push(&folder);
    arguments.push("--json");
    if command == "gap" {
        arguments.extend(["--points", "0"]);
    } else {
        arguments.extend(["--models", "hertz_1882"]);
    }
    Command::new(env!("CARGO_BIN_EXE_pounding"))
        .args(arguments)
        .current_dir(root())
        .env_remove("COLUMNS")
        .output()
        .unwrap()
}
