//! Options of `gap` and `compare` that take texts with units.
use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;

fn run(command: &str, example: &str, arguments: &[&str]) -> Output {
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    Command::new(env!("CARGO_BIN_EXE_pounding"))
        .env("NO_COLOR", "1")
        .arg(command)
        .arg(examples.join(example).join("case.toml"))
        .args(arguments)
        .output()
        .unwrap()
}

fn json(command: &str, example: &str, arguments: &[&str]) -> Value {
    let output = run(command, example, &[arguments, &["--json"]].concat());
    serde_json::from_slice(&output.stdout)
        .unwrap_or_else(|_| panic!("{}", String::from_utf8_lossy(&output.stderr)))
}

#[test]
fn probabilities_and_velocities_with_units() {
    for text in ["10 %", "10%", "0.1"] {
        let more = [
            "--points",
            "0",
            "--probability",
            text,
            "--confidence",
            "80 %",
        ];
        let told = json("gap", "gap_check", &more);
        assert_eq!(told["target_probability"], 0.1, "{text}");
        assert_eq!(told["confidence"], 0.8, "{text}");
    }
    let with = |velocity: &str, restitution: &str| {
        let more = [
            "--models",
            "jankowski_2005,exact_hunt_crossley",
            "--approach-velocity",
            velocity,
            "--restitution",
            restitution,
        ];
        let references = json("compare", "three_storey_pair", &more)["references"].clone();
        assert_eq!(references.as_array().map(Vec::len), Some(1));
        references
    };
    let plain = with("0.5", "0.6");
    assert_eq!(plain, with("50 cm/s", "60 %"));
    assert_ne!(plain, with("0.4 m/s", "0.6"));
}

#[test]
fn other_dimensions_are_refused_in_words() {
    for (command, example, option, value, says) in [
        ("gap", "gap_check", "--probability", "0.1 m", "a length (m)"),
        (
            "gap",
            "gap_check",
            "--confidence",
            "much",
            "does not start with a number",
        ),
        (
            "compare",
            "three_storey_pair",
            "--approach-velocity",
            "1 s",
            "must be a velocity",
        ),
        (
            "compare",
            "three_storey_pair",
            "--restitution",
            "0.5 kg",
            "a mass",
        ),
    ] {
        let output = run(command, example, &[option, value]);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{option} {value}: {said}");
        assert!(said.contains(option) && said.contains(says), "{said}");
        assert!(!said.contains("float literal"), "{said}");
    }
}
