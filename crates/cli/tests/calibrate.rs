//! `pounding impact calibrate`: the search, its conditions, bad input; and the
//! collision beside it.
use std::process::Output;

use crate::support;
use serde_json::Value;

fn run(arguments: &str) -> Output {
    support::run("impact", arguments)
}

fn text(arguments: &str) -> String {
    support::text("impact", arguments)
}

fn json(arguments: &str) -> Value {
    let shown = text(&format!("calibrate {arguments} --json"));
    assert!(!shown.contains("NaN"), "{shown}");
    serde_json::from_str(&shown).unwrap()
}

/// Refused as bad input, with these words.
fn refused(arguments: &str, wanted: &[&str]) {
    let output = run(arguments);
    let message = String::from_utf8_lossy(&output.stderr).replace(['│', '\n'], " ");
    let message = message.split_whitespace().collect::<Vec<_>>().join(" ");
    assert_eq!(output.status.code(), Some(2), "{arguments}: {message}");
    assert!(output.stdout.is_empty());
    for part in wanted {
        assert!(message.contains(part), "\"{part}\" is not in: {message}");
    }
}

/// Rounded to the paper's grid of 0.1 the search gives its table 1 up to 0.8.
#[test]
fn the_papers_drop_test_gives_the_papers_alpha() {
    let result = json("");
    assert_eq!(result["drop_test"]["read_at"], 1.0e-3);
    assert_eq!(result["drop_test"]["conditions_are_a_hypothesis"], true);
    let rows = result["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 9);
    for row in &rows[..8] {
        let alpha = |key: &str| row[key]["alpha"].as_f64().unwrap();
        let rounded = (10.0 * alpha("found")).round() / 10.0;
        assert!((rounded - alpha("rule")).abs() < 1e-9, "{row}");
        let achieved = row["found"]["achieved"].as_f64().unwrap();
        assert!((achieved - row["requested"].as_f64().unwrap()).abs() <= 1e-10);
    }
    let shown = text("calibrate");
    for part in [
        "0.1554974",
        "0.1385273",
        "0.1270621",
        "hypothesis",
        "exact_hunt_crossley",
    ] {
        assert!(shown.contains(part), "\"{part}\" is not in: {shown}");
    }
}

#[test]
fn one_restitution_shows_every_collision() {
    let shown = text("calibrate --restitution 0.65");
    for part in ["ITP", "0.779017241", "0.750000000", "0.669731758"] {
        assert!(shown.contains(part), "\"{part}\" is not in: {shown}");
    }
    let result = json("--restitution 0.65");
    let steps = result["steps"].as_array().unwrap();
    assert!(steps.len() < 20);
    assert_eq!(steps.last().unwrap()["alpha"], result["found"]["alpha"]);
}

/// Without gravity the search ends at the exact factor.
#[test]
fn without_gravity_the_free_alpha_is_found() {
    let result =
        json("--restitution 0.5 --gravity 0 --mass 25t --stiffness 93.5MN/m --velocity 0.8m/s");
    assert!(result["drop_test"]["read_at"].is_null());
    assert_eq!(result["drop_test"]["conditions_are_a_hypothesis"], false);
    let alpha = |key: &str| result[key]["alpha"].as_f64().unwrap();
    assert!((alpha("found") - 0.535_202_988_151).abs() < 1e-9);
    assert!((alpha("found") - alpha("free")).abs() < 1e-9);
}

/// A row that cannot be met is named, the others stand.
#[test]
fn a_row_without_an_answer_is_shown() {
    // Read later, even an elastic rebound shows only 0.88.
    let shown = text("calibrate --read-at 2.5ms");
    assert!(
        shown.contains("none") && shown.contains("0.9: no alpha shows"),
        "{shown}"
    );
    let result = json("--read-at 2.5ms");
    assert!(result["rows"][8]["error"].is_string());
    assert!(result["rows"][4]["found"]["alpha"].is_number());
}

#[test]
fn bad_input_is_refused_with_the_remedy() {
    refused(
        "calibrate --restitution 1.2",
        &["restitution = 1.2 is outside (0, 1)"],
    );
    refused(
        "calibrate --restitution 0.995",
        &["0.985529 with alpha = 1 and 0.990764", "leaves the slab"],
    );
    refused(
        "calibrate --mass=-1kg",
        &["mass = -1 kg", "greater than zero"],
    );
    refused(
        "calibrate --mass 3m",
        &["--mass must be a mass", "is a length"],
    );
    refused("calibrate --gravity 9.8m/s", &["--gravity must be"]);
    refused("calibrate --read-at 1e-6", &["no alpha shows"]);
    refused("calibrate --read-at soon", &["--read-at"]);
    refused(
        "calibrate --tolerance 0",
        &["tolerance = 0 is outside (0, 1)"],
    );
    refused("", &["<MODEL>"]);
    refused(
        "hertz_1882 calibrate",
        &["`pounding impact calibrate", "before"],
    );
}

/// The subcommand takes nothing from the collision itself.
#[test]
fn a_model_still_collides() {
    let shown = text("exact_hunt_crossley -p stiffness=2e9 -p restitution=0.5");
    assert!(shown.contains("achieved restitution  0.5000000"), "{shown}");
}

/// A collision that does not end is a computation that failed, as without the search.
#[test]
fn a_search_whose_collision_does_not_end_failed() {
    let output = run("calibrate --restitution 1e-9");
    assert_eq!(output.status.code(), Some(3));
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(message.contains("did not end"), "{message}");
}
