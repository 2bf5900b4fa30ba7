//! Isolated buildings on the command line: what is said of them, and of what cannot be.
#![allow(clippy::unwrap_used)]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

fn example() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/isolated_building/case.toml")
}

fn pounding(arguments: &[&str], case: &Path) -> Output {
    Command::new(env!("CARGO_BIN_EXE_pounding"))
        .env("NO_COLOR", "1")
        .args(arguments)
        .arg(case)
        .output()
        .unwrap()
}

fn words(output: &[u8]) -> String {
    let text = String::from_utf8_lossy(output).replace(['│', '\n'], " ");
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn json(arguments: &[&str], case: &Path) -> Value {
    let output = pounding(&[arguments, &["--json"]].concat(), case);
    serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{}", words(&output.stderr)))
}

fn close(value: &Value, expected: f64) {
    let value = value.as_f64().unwrap();
    let off = (value / expected - 1.0).abs();
    assert!(off < 1e-8, "{value} is not {expected}");
}

/// The example with some of its text changed, its record found from anywhere.
fn changed(changes: &[(&str, &str)]) -> (tempfile::TempDir, PathBuf) {
    let mut text = std::fs::read_to_string(example()).unwrap();
    let record = example().parent().unwrap().join("../../ground_motions");
    let record = record.canonicalize().unwrap().display().to_string();
    text = text.replace("../../ground_motions", &record.replace('\\', "/"));
    for (old, new) in changes {
        assert!(text.contains(old), "{old}");
        text = text.replace(old, new);
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("case.toml");
    std::fs::write(&path, text).unwrap();
    (folder, path)
}

/// Against Taylor series in long double, with which a Gragg-Bulirsch-Stoer code agrees to
/// 1e-14.
#[test]
fn the_example_runs_into_both_walls() {
    let result = json(&["run", "--no-output"], &example());
    let office = &result["buildings"][0];
    let roof = &office["storeys"][3]["displacement"]["peak"];
    close(roof, 0.113_545_907_721_545);
    let isolator = &office["isolator"];
    assert_eq!(isolator["model"], "lead_rubber");
    close(&isolator["displacement"]["peak"], 0.090_411_664_578_086);
    // On the branch after yield: Q + k2 u.
    let force = 423_900.0 + 5.053e6 * 0.090_411_664_578_086;
    close(&isolator["force"]["peak"], force);
    let period = (8.0e5 * 0.090_411_664_578_086 / force).sqrt() * std::f64::consts::TAU;
    close(&isolator["effective_period"], period);
    let forces = [2_041_537.158_324_545, 2_629_163.224_543_812];
    for (gap, force) in result["gaps"].as_array().unwrap().iter().zip(forces) {
        let level = &gap["levels"][0];
        assert_eq!(level["impacts"], 2);
        assert_eq!(level["clearance"], 0.0);
        close(&level["peak_force"]["peak"], force);
    }
    close(&result["energy"]["hysteretic"], 514_408.455_479_311);
    // The displacement of isolators over their height says nothing.
    assert!(result["warnings"].as_array().unwrap().is_empty());
}

/// Without impacts, the clearance that is left is the width less what the gap check finds.
#[test]
fn clearance_is_width_less_demand() {
    let wider = "width = \"150 mm\"";
    let (_folder, case) = changed(&[("width = \"70 mm\"", wider), ("width = \"80 mm\"", wider)]);
    let result = json(&["run", "--no-output"], &case);
    let check = json(&["gap", "--points", "0"], &case);
    assert_eq!(check["adequate"], true);
    for index in 0..2 {
        let left = &result["gaps"][index]["levels"][0]["clearance"];
        let level = &check["gaps"][index]["levels"][0];
        let demand = level["demand"][0]["peak"].as_f64().unwrap();
        close(left, 0.15 - demand);
        close(&level["isolation"]["clearance"][0], 0.15 - demand);
        assert_eq!(level["isolation"]["building"], "office");
        assert_eq!(level["isolation"]["force"][0], 0.0);
    }
    let shown = words(&pounding(&["run", "--no-output"], &case).stdout);
    assert!(shown.contains("mm of 150.0 mm clearance left"), "{shown}");
}

#[test]
fn the_gap_check_says_demand_clearance_and_force() {
    let output = pounding(&["gap", "--points", "0", "--all"], &example());
    assert_eq!(output.status.code(), Some(1));
    let shown = words(&output.stdout);
    for part in [
        "office on isolators demands 117.37 mm (el_centro_1940_ns), clearance 70.0 mm: 47.37 mm short; maximum contact force at this clearance 2041.5 kN",
        "clearance 80.0 mm: 13.69 mm short; maximum contact force at this clearance 2629.2 kN",
        "asce_7_16_isolation_boundary | boundary, prescriptive | - | 140.0 | no |",
    ] {
        assert!(shown.contains(part), "{part} is not in {shown}");
    }
}

/// What is given for all buildings makes no isolated one of a neighbour.
#[test]
fn a_neighbour_without_isolators_has_no_isolation_clearance() {
    let neighbour = "[[building]]\nname = \"next\"\nmass = [\"200 t\"]\nstiffness = \"90 MN/m\"\nheight = 3.6\ndamping = { modal = 0.05 }\n\n[[gap]]\nname = \"left wall\"";
    let changes = [
        ("[[gap]]\nname = \"left wall\"", neighbour),
        (
            "[\"office\", \"wall\"]\nlevels = [1]",
            "[\"office\", \"next\"]\nlevels = \"matching\"",
        ),
    ];
    let (_folder, case) = changed(&changes);
    let check = json(&["gap", "--points", "0"], &case);
    let provision = |gap: usize| check["gaps"][gap]["provisions"][0].clone();
    assert_eq!(provision(0)["name"], "asce_7_16_isolation_boundary");
    assert!(provision(0)["refusal"].is_null());
    let refusal = provision(1)["refusal"].as_str().unwrap().to_owned();
    assert!(refusal.contains("needs isolation_period"), "{refusal}");
    assert!(refusal.ends_with("of next"), "{refusal}");
}

#[test]
fn check_says_what_the_isolators_are() {
    let understood = json(&["check"], &example());
    let isolator = &understood["buildings"][0]["isolator"];
    close(&isolator["weight"], 8.0e5 * 9.806_65);
    close(&isolator["strength"], 423_900.0);
    close(&isolator["yield_displacement"], 471.0e3 / 50.53e6);
    close(&isolator["initial_stiffness"], 50.53e6);
    let shown = words(&pounding(&["check"], &example()).stdout);
    for part in [
        "isolators (lead_rubber), storey 1: weight 7845.3 kN",
        "5.40 % of the weight, yield at 9.321 mm, dashpot 200000 N s/m",
    ] {
        assert!(shown.contains(part), "{part} is not in {shown}");
    }
}

/// The file holds it, and the page shows it.
#[test]
fn the_page_shows_isolators_and_clearance() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("isolated.h5");
    let output = pounding(&["run", "-o", file.to_str().unwrap()], &example());
    assert!(output.status.success(), "{}", words(&output.stderr));
    let output = pounding(&["report"], &file);
    assert!(output.status.success(), "{}", words(&output.stderr));
    let page = std::fs::read_to_string(file.with_extension("html")).unwrap();
    for part in ["isolators (storey 1)", "lead_rubber", "clearance left (mm)"] {
        assert!(page.contains(part), "{part}");
    }
}

/// Values of the isolators are varied as others are.
#[test]
fn sweeps_vary_isolators() {
    let (folder, _case) = changed(&[]);
    let study = "case = \"case.toml\"\n[[variable]]\npath = \"building.office.isolator.yield_force\"\nvalues = [\"300 kN\", \"471 kN\"]\n";
    let path = folder.path().join("study.toml");
    std::fs::write(&path, study).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_pounding"))
        .current_dir(folder.path())
        .args(["sweep", "study.toml"])
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", words(&output.stderr));
}

/// Bad input with place and remedy that only the whole building shows.
#[test]
fn isolators_that_cannot_be_are_refused() {
    let maxwell = "law = { model = \"maxwell\", storeys = [2], stiffness = 4e8, damping = 1e6 }\n\n[building.isolator]";
    for (changes, wanted) in [
        (
            ("yield_force = \"471 kN\"", "yield_force = \"47.1 MN\""),
            [
                "case.toml:11:",
                "of the weight, which must be above 0 and below 1",
                "usual are 0.03 to 0.10",
            ],
        ),
        (
            (
                "[\"1.2 MN s/m\", \"1 MN s/m\", \"0.8 MN s/m\"]",
                "[1e6, 1e6, 1e6, 1e6]",
            ),
            [
                "case.toml:9:",
                "4 values where there are 3 storeys",
                "one value per storey",
            ],
        ),
        (
            ("model = \"lead_rubber\"", "model = \"rubber\""),
            [
                "case.toml:12:",
                "unknown isolator \"rubber\"",
                "lead_rubber",
            ],
        ),
        // A law that holds no load stays refused in a storey.
        (
            ("[building.isolator]", maxwell),
            ["case.toml:11:", "carries no lasting load", "make it a link"],
        ),
    ] {
        let (_folder, case) = changed(&[changes]);
        let output = pounding(&["run", "--no-output"], &case);
        let text = words(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{text}");
        for part in wanted {
            assert!(text.contains(part), "{part} is not in {text}");
        }
        assert!(!text.contains("2 errors"), "{text}");
    }
}
