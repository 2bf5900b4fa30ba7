//! `pounding stiffness`: numbers, units, the line for a case file, bad input.
use std::process::{Command, Output};

use crate::support;
use serde_json::Value;

const BALLS: &str = "hertz --radius-left=25mm --radius-right=50mm --elastic-modulus-left=206GPa --poisson-ratio-left=0.28";
const SLABS: &str = "slab --elastic-modulus-left=30GPa --area-left=1.8m^2 --length-left=20m";
const FLOORS: &str = "--velocity=0.8m/s --mass-left=25t --mass-right=40t";

fn run(arguments: &str) -> Output {
    support::run("stiffness", arguments)
}

fn text(arguments: &str) -> String {
    support::text("stiffness", arguments)
}

fn json(arguments: &str) -> Value {
    serde_json::from_str(&text(&format!("{arguments} --json"))).unwrap()
}

fn stiffness(arguments: &str) -> f64 {
    json(arguments)["stiffness"].as_f64().unwrap()
}

fn close(value: f64, expected: f64, relative: f64) {
    assert!(
        (value / expected - 1.0).abs() < relative,
        "{value} is not {expected}"
    );
}

fn warned(arguments: &str, part: &str) -> bool {
    let result = json(arguments);
    let warnings = result["warnings"].as_array().unwrap();
    warnings.iter().any(|w| w.as_str().unwrap().contains(part))
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

#[test]
fn hertz_of_steel_balls_in_text_and_json() {
    let shown = text(BALLS);
    for part in [
        "1.923791e10 N/m^1.5",
        "stiffness = \"1.92379091753",
        "N/m^1.5\"",
        "Hertz, J. reine angew. Math. 92 (1882) 156",
        "flat-on-flat",
    ] {
        assert!(shown.contains(part), "\"{part}\" is not in: {shown}");
    }
    let result = json(BALLS);
    close(
        result["stiffness"].as_f64().unwrap(),
        19_237_909_175.316_547,
        1e-10,
    );
    assert_eq!(result["unit"], "N/m^1.5");
    assert_eq!(result["exponent"], 1.5);
    assert_eq!(result["method"], "hertz");
}

#[test]
fn hertz_of_a_rubber_ball_on_a_flat_floor() {
    let value = stiffness(
        "hertz --radius-left=0.0236708014102 --radius-right=flat --elastic-modulus-left=8MPa --poisson-ratio-left=0.5 --elastic-modulus-right=27.5GPa --poisson-ratio-right=0.15",
    );
    close(value, 2_187_304.814_76, 1e-10);
}

#[test]
fn hertz_warns_of_waves_and_wide_contact() {
    let with = |more: &str| format!("{BALLS} --mass-left=0.5kg --mass-right=wall {more}");
    let waves = "waves carry energy";
    assert!(warned(
        &with("--velocity=50 --density-left=7850kg/m^3"),
        waves
    ));
    assert!(!warned(
        &with("--velocity=0.001 --density-left=7850"),
        waves
    ));
    assert!(!warned(&with("--velocity=50"), waves));
    assert!(warned(&with("--velocity=50"), "no half-spaces"));
    assert!(!warned(&with("--velocity=0.001"), "no half-spaces"));
    // Another material's density is not known.
    let other = "--velocity=50 --density-left=7850 --elastic-modulus-right=30GPa";
    let transit = |more: &str| {
        let result = json(&with(more));
        let list = result["intermediate"].as_array().unwrap().clone();
        let found = list.iter().find(|i| i["name"] == "wave transit time");
        found.unwrap()["value"].as_f64().unwrap()
    };
    close(transit(other), 0.05 / (206e9_f64 / 7850.0).sqrt(), 1e-14);
    let both = format!("{other} --density-right=2400");
    close(transit(&both), 0.1 / (30e9_f64 / 2400.0).sqrt(), 1e-14);
}

#[test]
fn slabs_in_series_by_area_or_width_and_thickness() {
    close(stiffness(SLABS), 1.35e9, 1e-14);
    let sized = "slab --elastic-modulus-left=30GPa --width-left=10m --thickness-left=18cm --length-left=20m";
    close(stiffness(sized), 1.35e9, 1e-14);
    let other = format!("{SLABS} --elastic-modulus-right=25GPa --area-right=1.5 --length-right=15");
    close(stiffness(&other), 6.75e9 / 5.2, 1e-14);
    // The other slab differs in thickness only: 2.7e9 and 3e9 N/m.
    let thicker = format!("{sized} --thickness-right=20cm");
    close(stiffness(&thicker), 2.7e9 * 3e9 / 5.7e9, 1e-14);
    assert!(text(SLABS).contains("e9 N/m\""));
}

#[test]
fn slab_warns_where_storeys_are_nearly_as_stiff() {
    let soft = "softer than customary";
    assert!(warned(
        &format!("{SLABS} --storey-stiffness=2215MN/m"),
        soft
    ));
    assert!(!warned(
        &format!("{SLABS} --storey-stiffness=3.46MN/m"),
        soft
    ));
    assert!(!warned(SLABS, soft));
    assert!(warned(SLABS, "linear laws only"));
}

/// The line that is printed, given to the laboratory, does what was wanted.
#[test]
fn the_laboratory_finds_the_wanted_contact_time_and_penetration() {
    for (exponent, model) in [("1", "linear_elastic"), ("1.5", "hertz_1882")] {
        for (method, wanted, key) in [
            ("duration", 0.02, "duration"),
            ("penetration", 5e-3, "peak_penetration"),
        ] {
            let result = json(&format!(
                "{method} --{method}={wanted} --exponent={exponent} {FLOORS}"
            ));
            let line = result["case_line"].as_str().unwrap();
            let parameter = line.replace(" = ", "=").replace('"', "");
            let output = Command::new(env!("CARGO_BIN_EXE_pounding"))
                .args(["impact", model, "-p", &parameter, "--json"])
                .args(FLOORS.split_whitespace())
                .output()
                .unwrap();
            let outcome: Value = serde_json::from_slice(&output.stdout).unwrap();
            let found = outcome[key].as_f64().or(outcome[key]["peak"].as_f64());
            close(found.unwrap(), wanted, 1e-9);
        }
    }
}

#[test]
fn duration_and_penetration_warn() {
    let time = format!("duration --duration=20ms {FLOORS}");
    assert!(warned(&format!("{time} --exponent=1.5"), "at 0.8 m/s only"));
    assert!(!warned(&format!("{time} --exponent=1"), "at 0.8 m/s only"));
    assert!(warned(&format!("{time} --exponent=1"), "without damping"));
    assert!(!warned(
        &format!("{time} --exponent=1 --restitution=1"),
        "without damping"
    ));
    let depth = format!("penetration --penetration=5mm --exponent=1.5 {FLOORS}");
    assert!(warned(&depth, "penetrates less"));
    assert!(!warned(
        &format!("{depth} --restitution=1"),
        "penetrates less"
    ));
    assert!(warned(
        &format!("{depth} --gap-width=4mm"),
        "exceeds the gap"
    ));
    assert!(!warned(
        &format!("{depth} --gap-width=20mm"),
        "exceeds the gap"
    ));
}

#[test]
fn a_multiple_is_a_rule_of_thumb() {
    let usual = "multiple --storey-stiffness=3.46MN/m";
    close(stiffness(usual), 69.2e6, 1e-14);
    let shown = text(usual);
    assert!(
        shown.contains("from secondary sources: rule of thumb"),
        "{shown}"
    );
    assert!(!shown.contains("warnings"), "{shown}");
    assert!(warned(&format!("{usual} --factor=5"), "range in use"));
    assert!(warned(&format!("{usual} --factor=200"), "range in use"));
    assert!(!warned(&format!("{usual} --factor=100"), "range in use"));
}

#[test]
fn bad_input_is_refused_with_the_remedy() {
    refused(
        "multiple --storey-stiffness=-3",
        &["storey stiffness = -3 N/m", "unit"],
    );
    refused(
        "multiple --storey-stiffness=nan",
        &["--storey-stiffness", "does not start with a number"],
    );
    refused(
        "multiple --storey-stiffness=1e400",
        &["not a finite number"],
    );
    refused(
        "multiple --storey-stiffness=3MN",
        &["must be a stiffness", "is a force"],
    );
    refused(
        "multiple --storey-stiffness=3mn/m",
        &["not a known unit", "did you mean \"MN\""],
    );
    refused(
        "multiple --storey-stiffness=3 --factor=0",
        &["factor = 0 is outside (0, inf)", "20 is customary"],
    );
    refused("multiple", &["--storey-stiffness"]);
    refused(
        &BALLS.replace("25mm", "flat").replace("50mm", "flat"),
        &["both bodies are flat", "stiffness slab"],
    );
    refused(&BALLS.replace("25mm", "-25mm"), &["radius = -0.025 m"]);
    refused(
        &BALLS.replace("0.28", "0.6"),
        &["Poisson's ratio = 0.6", "(-1, 0.5]"],
    );
    refused(&BALLS.replace("206GPa", "206GN"), &["must be a pressure"]);
    refused(&format!("{BALLS} --velocity=1"), &["--mass-left"]);
    refused(&format!("{BALLS} --density-left=7850"), &["--velocity"]);
    refused(
        &format!("{BALLS} --velocity=0 --mass-left=1 --mass-right=wall"),
        &["approach velocity = 0"],
    );
    refused(
        &format!("{SLABS} --width-left=10m"),
        &["cannot be used with"],
    );
    refused(
        &format!("{SLABS} --width-right=10m"),
        &["right slab has no area", "--thickness-right"],
    );
    refused(
        &SLABS.replace("--area-left=1.8m^2", ""),
        &["left slab has no area"],
    );
    refused(
        &SLABS.replace("--area-left=1.8m^2", "--width-left=-1 --thickness-left=-1"),
        &["greater than zero"],
    );
    refused(
        &format!("duration --duration=0 --exponent=1 {FLOORS}"),
        &["contact time = 0 s"],
    );
    refused(
        &format!("duration --duration=1 --exponent=0.5 {FLOORS}"),
        &["exponent = 0.5 is outside [1, 5]"],
    );
    refused(
        &format!("duration --duration=1 --exponent=1 --restitution=2 {FLOORS}"),
        &["restitution = 2 is outside (0, 1]"],
    );
    refused(
        &format!("penetration --penetration=1e-200 --exponent=1 {FLOORS}"),
        &["too large or too small"],
    );
    refused("", &["Usage"]);
}

/// The lines for a case, on the screen one below the other, with an exponent that laws take.
#[test]
fn the_exponent_stands_beside_the_stiffness() {
    let line = &json(&format!("duration --duration=20ms --exponent=2 {FLOORS}"))["case_line"];
    assert!(
        line.as_str().unwrap().ends_with(" N/m^2\"\nexponent = 2"),
        "{line}"
    );
    refused(
        &format!("duration --duration=20ms --exponent=8 {FLOORS}"),
        &[
            "exponent = 8 is outside [1, 5]",
            "impact models take exponents from 1 to 5",
        ],
    );
}
