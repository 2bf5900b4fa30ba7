//! The examples with storeys that yield and with links run, and their headline numbers
//! hold: against an independent classical Runge-Kutta solution with fixed steps (2 us;
//! 20 us with links), plastic drifts corrected after each step, the joint as 4000
//! discrete sliders. It agrees with itself at half the step to five digits.
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

fn example(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../examples")
        .join(name)
        .join("case.toml")
}

fn run(name: &str, more: &[&str]) -> Value {
    let output = Command::new(env!("CARGO_BIN_EXE_pounding"))
        .arg("run")
        .arg(example(name))
        .args(["--json"])
        .args(more)
        .output()
        .unwrap();
    let complaint = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{complaint}");
    let result: Value = serde_json::from_slice(&output.stdout).unwrap();
    let residual = result["energy"]["residual_ratio"].as_f64().unwrap();
    assert!(residual < 1.0e-9, "{name}: energy residual {residual:e}");
    result
}

/// Against DOP853 of SciPy with located events, with which Radau's method agrees to 5e-12.
#[test]
fn bridge_abutment() {
    let result = run("bridge_abutment", &["--no-output"]);
    let frame = &result["buildings"][0]["storeys"][0];
    close(&frame["displacement"]["peak"], 0.065_929_055_046, 1e-8);
    let wall = &result["links"][0]["levels"][0];
    close(&wall["force"]["peak"], 2_828_275.158_15, 1e-8);
    close(&wall["energy_dissipated"], 45_659.219_528, 1e-8);
}

fn close(value: &Value, expected: f64, relative: f64) {
    let value = value.as_f64().unwrap();
    let off = (value - expected).abs();
    assert!(off < relative * expected.abs(), "{value} is not {expected}");
}

fn displacements(result: &Value, building: usize, expected: [f64; 3]) {
    let storeys = &result["buildings"][building]["storeys"];
    for (storey, expected) in expected.into_iter().enumerate() {
        close(&storeys[storey]["displacement"]["peak"], expected, 1.0e-4);
    }
}

fn forces_and_impacts(result: &Value, forces: [f64; 3], impacts: u64) {
    let levels = result["gaps"][0]["levels"].as_array().unwrap();
    let count: u64 = levels.iter().map(|l| l["impacts"].as_u64().unwrap()).sum();
    assert_eq!(count, impacts);
    for (level, force) in levels.iter().zip(forces) {
        if force == 0.0 {
            assert_eq!(level["impacts"], 0);
        } else {
            close(&level["peak_force"]["peak"], force, 1.0e-3);
        }
    }
}

#[test]
fn yielding_pair() {
    let result = run("yielding_pair", &["--no-output"]);
    displacements(&result, 0, [0.069748, 0.100287, 0.120484]);
    displacements(&result, 1, [0.009377, 0.014981, 0.018304]);
    forces_and_impacts(&result, [1.2534e5, 7.6960e5, 1.2396e6], 19);
    let light = &result["buildings"][0];
    close(
        &light["storeys"][2]["acceleration_absolute"]["peak"],
        50.022,
        1.0e-3,
    );
    let first = &light["yielding"][0];
    assert_eq!(first["law"], "elastic_perfectly_plastic");
    close(
        &first["ductility"]["peak"],
        0.069748 * 3.46e6 / 1.369e5,
        1.0e-4,
    );
    close(&first["residual_drift_ratio"], -0.030181 / 3.0, 1.0e-4);
    close(&result["energy"]["hysteretic"], 77_412.16, 1.0e-4);
    for (storey, shear) in [136_900.0, 117_226.3, 81_036.7].into_iter().enumerate() {
        let peak = &light["storeys"][storey]["storey_shear"]["peak"];
        close(peak, shear, 1.0e-4);
    }
}

#[test]
fn linked_pair() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("linked.h5");
    let result = run("linked_pair", &["--output", file.to_str().unwrap()]);
    displacements(&result, 0, [0.029962, 0.049638, 0.057740]);
    displacements(&result, 1, [0.009363, 0.015088, 0.018528]);
    forces_and_impacts(&result, [0.0, 5.1722e5, 8.5203e5], 9);
    let storeys = 73_549.8;
    let joints: f64 = result["links"][0]["levels"]
        .as_array()
        .unwrap()
        .iter()
        .map(|l| l["energy_dissipated"].as_f64().unwrap())
        .sum();
    close(&result["energy"]["hysteretic"], storeys + joints, 1.0e-4);
    close(
        &result["links"][0]["levels"][2]["energy_dissipated"],
        70_962.0,
        1.0e-3,
    );
    assert!(file.exists());
}
