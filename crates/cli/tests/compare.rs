//! `pounding compare`: headline numbers of the example, files, mistakes.
#![allow(clippy::unwrap_used)]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn compare(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_pounding"))
        .arg("compare")
        .arg(root().join("examples/three_storey_pair/case.toml"))
        .args(arguments)
        .current_dir(root())
        .output()
        .unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

fn quantity<'a>(result: &'a Value, of: &str, name: &str) -> &'a Value {
    let all = result["quantities"].as_array().unwrap();
    all.iter()
        .find(|q| q["of"] == of && q["name"] == name)
        .unwrap_or_else(|| panic!("{of} {name}"))
}

/// All models under both records. The heavy building hardly notices whichever model
/// acts; the spread between records is three times that between models.
#[test]
fn all_models_under_both_records() {
    let output = compare(&["--records", "ground_motions", "--json"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let result: Value = serde_json::from_slice(&output.stdout).unwrap();
    let models = result["models"].as_array().unwrap();
    assert!(models.len() >= 35);
    for model in models {
        assert_eq!(
            model["failures"],
            serde_json::json!([]),
            "{}",
            model["name"]
        );
    }
    let spread = |of: &str, name: &str| {
        let spread = &quantity(&result, of, name)["spread"];
        let value = |key: &str| spread[key].as_f64().unwrap();
        (value("between_models"), value("between_records"))
    };
    let (models, records) = spread("light", "displacement");
    assert!((models - 0.195).abs() < 0.01 && (records - 0.68).abs() < 0.01);
    let (models, records) = spread("light", "acceleration_absolute");
    assert!((models - 0.219).abs() < 0.01 && (records - 0.817).abs() < 0.01);
    let (models, _) = spread("heavy", "displacement");
    assert!(models < 0.01, "{models}");
    let conclusions = result["conclusions"].as_array().unwrap();
    let holds = |statement: &str| {
        let found = conclusions.iter().find(|c| c["statement"] == statement);
        found.unwrap_or_else(|| panic!("{statement}"))["holds"].clone()
    };
    let raises = "pounding raises the peak absolute acceleration of light";
    assert_eq!(holds(raises), "holds for all models");
    assert_eq!(
        holds("pounding raises the peak displacement of light"),
        "hangs on the model"
    );
}

/// Exact: every model that can be asked returns what the case's law returns.
#[test]
fn calibrated_exactly() {
    let output = compare(&[
        "--models",
        "jankowski_2005,hunt_crossley_1975,anagnostopoulos_2004",
        "--restitution-rule",
        "exact",
        "--restitution",
        "0.65",
        "--json",
    ]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let result: Value = serde_json::from_slice(&output.stdout).unwrap();
    for model in result["models"].as_array().unwrap() {
        let free = model["gaps"][0]["free_restitution"].as_f64().unwrap();
        assert!((free - 0.65).abs() < 1e-6, "{}: {free}", model["name"]);
    }
}

#[test]
fn tables_and_files() {
    let folder = tempfile::tempdir().unwrap();
    let csv = folder.path().join("models.csv");
    let svg = folder.path().join("models.svg");
    let output = compare(&[
        "--models",
        "exact_hunt_crossley,stereomechanical",
        "--csv",
        csv.to_str().unwrap(),
        "--plot",
        svg.to_str().unwrap(),
    ]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let shown = text(&output.stdout);
    for part in [
        "calibrated alike",
        "Spread",
        "Ranking",
        "Conclusions",
        "(no pounding)",
    ] {
        assert!(shown.contains(part), "{part}: {shown}");
    }
    let table = std::fs::read_to_string(csv).unwrap();
    assert_eq!(table.lines().count(), 1 + 2 * (2 * 4 + 6));
    assert!(table.contains("stereomechanical,el_centro_1940_ns,light-heavy,peak_force,N,NaN"));
    assert!(std::fs::read_to_string(svg).unwrap().contains("<svg"));
}

/// A model that cannot be calibrated is told with its reason; alone it leaves nothing.
#[test]
fn models_that_fail() {
    let impossible = ["--restitution", "0.001", "--restitution-rule", "exact"];
    let with = |models: &'static str| {
        let mut arguments = vec!["--models", models];
        arguments.extend(impossible);
        compare(&arguments)
    };
    let two = with("muthukumar_2003,exact_hunt_crossley");
    assert!(two.status.success(), "{}", text(&two.stderr));
    assert!(text(&two.stdout).contains("muthukumar_2003: no restitution returns 0.001"));
    let one = with("muthukumar_2003");
    assert_eq!(one.status.code(), Some(3));
    let unknown = compare(&["--models", "jankowsky_2005"]);
    assert_eq!(unknown.status.code(), Some(2));
    assert!(text(&unknown.stderr).contains("jankowski_2005"));
}
