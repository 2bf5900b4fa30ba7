//! The examples run, and their headline numbers hold.
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn pounding() -> Command {
    Command::new(env!("CARGO_BIN_EXE_pounding"))
}

fn run_example(name: &str) -> Value {
    run_case(name, "case.toml")
}

fn run_case(name: &str, file: &str) -> Value {
    let case = root().join("examples").join(name).join(file);
    let output = pounding()
        .arg("run")
        .arg(case)
        .args(["--no-output", "--json"])
        .output()
        .unwrap();
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let result: Value = serde_json::from_slice(&output.stdout).unwrap();
    let residual = result["energy"]["residual_ratio"].as_f64().unwrap();
    assert!(residual < 1e-9, "{name}: energy residual {residual:e}");
    result
}

/// Against two independent codes, which agree to 1e-14 (`tests/data/structures`).
#[test]
fn wall_and_frame() {
    let result = run_example("wall_and_frame");
    let (wall, frame) = (&result["buildings"][0], &result["buildings"][1]);
    close(
        &wall["storeys"][3]["displacement"]["peak"],
        0.087_995_903,
        1e-8,
    );
    close(
        &wall["storeys"][0]["storey_shear"]["peak"],
        1_892_776.414_81,
        1e-8,
    );
    close(
        &frame["storeys"][2]["storey_shear"]["peak"],
        845_536.371_741_5,
        1e-8,
    );
    let levels = &result["gaps"][0]["levels"];
    let impacts = [0, 1, 2].map(|l: usize| levels[l]["impacts"].as_u64().unwrap());
    assert_eq!(impacts, [0, 11, 24]);
    close(&levels[1]["peak_force"]["peak"], 603_702.418_562, 1e-8);
    close(&levels[2]["peak_force"]["peak"], 504_958.384_377, 1e-8);
}

/// Against two independent codes (`tests/data/structures`); `foundations` compares all of it.
#[test]
fn soil_pair() {
    let result = run_example("soil_pair");
    let (a, b) = (&result["buildings"][0], &result["buildings"][1]);
    close(
        &a["storeys"][2]["displacement"]["peak"],
        0.080_739_861_642_221,
        1e-8,
    );
    close(
        &b["storeys"][0]["storey_shear"]["peak"],
        3_715_711.386_534_45,
        1e-8,
    );
    let response = |name: &str| {
        let mut responses = b["responses"].as_array().unwrap().iter();
        responses.find(|r| r["name"] == name).unwrap()["peak"].clone()
    };
    close(&response("foundation_sway"), 0.001_696_914_552_541, 1e-8);
    close(
        &response("foundation_rotation"),
        0.000_244_592_149_100_57,
        1e-8,
    );
    let levels = &result["gaps"][0]["levels"];
    let impacts = [0, 1, 2].map(|l: usize| levels[l]["impacts"].as_u64().unwrap());
    assert_eq!(impacts, [1, 6, 10]);
    close(&levels[2]["peak_force"]["peak"], 2_564_748.385_678_4, 1e-8);
}

/// Against two independent codes, which agree to 1e-14 (`tests/data/structures`).
#[test]
fn slab_hits_column() {
    let result = run_example("slab_hits_column");
    let levels = &result["gaps"][0]["levels"];
    let response = |level: usize, name: &str| {
        let all = levels[level]["responses"].as_array().unwrap();
        all.iter().find(|r| r["name"] == name).unwrap().clone()
    };
    let impacts = [0, 1].map(|l: usize| levels[l]["impacts"].as_u64().unwrap());
    assert_eq!(impacts, [2, 9]);
    close(&levels[1]["peak_force"]["peak"], 3_201_269.688_822, 1e-8);
    let above = response(1, "column_shear_above");
    close(&above["peak"], 2_315_697.205_927, 1e-8);
    close(&above["capacity"], 1.5e6, 1e-15);
    close(
        &response(1, "column_shear_below")["peak"],
        872_077.559_986,
        1e-8,
    );
    close(
        &response(1, "column_moment_top")["peak"],
        1_378_737.498_600,
        1e-8,
    );
    close(
        &response(0, "column_shear_below")["peak"],
        572_848.330_249,
        1e-8,
    );
}

fn close(value: &Value, expected: f64, relative: f64) {
    let value = value.as_f64().unwrap();
    assert!(
        (value / expected - 1.0).abs() < relative,
        "{value} is not {expected}"
    );
}

/// Values by an independent fixed-step RK4 with steps of 1 to 2 us, four to five
/// digits; that run took the first tabulated value at t = 0.02 s, so times are
/// one step later there. Impact counts there are good to one.
#[test]
fn three_storey_pair() {
    let result = run_example("three_storey_pair");
    let light = &result["buildings"][0]["storeys"];
    close(&light[0]["displacement"]["peak"], 0.04859, 3e-3);
    close(&light[1]["displacement"]["peak"], 0.08395, 3e-3);
    close(&light[2]["displacement"]["peak"], 0.10526, 3e-3);
    close(&light[2]["acceleration_absolute"]["peak"], 50.93, 3e-3);
    let heavy = &result["buildings"][1]["storeys"];
    close(&heavy[2]["displacement"]["peak"], 0.0206785, 3e-3);
    close(&heavy[2]["acceleration_absolute"]["peak"], 9.098, 3e-3);
    let levels = &result["gaps"][0]["levels"];
    for (level, (force, impacts)) in [(3.133e5, 2), (9.731e5, 17), (12.71e5, 26)]
        .iter()
        .enumerate()
    {
        close(&levels[level]["peak_force"]["peak"], *force, 3e-3);
        let computed = levels[level]["impacts"].as_i64().unwrap();
        assert!(
            (computed - impacts).abs() <= 1,
            "level {level}: {computed} impacts"
        );
    }
    let isolated = &result["buildings"][0]["isolated"];
    close(&isolated[2]["displacement"]["peak"], 0.114253, 3e-3);
    assert_eq!(result["gaps"][0]["model"], "jankowski_2005");
    assert_eq!(result["gaps"][0]["from_secondary_sources"], false);
    let case = root().join("examples/three_storey_pair/case.toml");
    let shown = pounding()
        .arg("run")
        .arg(case)
        .arg("--no-output")
        .output()
        .unwrap();
    let shown = String::from_utf8(shown.stdout).unwrap();
    assert!(!shown.contains("secondary sources"));
}

/// The same example by fixed-step RK4, which shares nothing with the adaptive pair
/// but the equations of motion.
fn by_fixed_step(name: &str, step: &str) -> Value {
    let lines = format!("method = \"runge_kutta_4\"\nstep = \"{step}\"");
    with_analysis(name, &lines)
}

/// An example with more lines under `[analysis]`.
fn with_analysis(name: &str, lines: &str) -> Value {
    let file = root().join("examples").join(name).join("case.toml");
    let case = std::fs::read_to_string(file).unwrap();
    let motions = root().join("ground_motions").canonicalize().unwrap();
    let mut fixed = case.replace("../../ground_motions", motions.to_str().unwrap());
    if !fixed.contains("[analysis]") {
        fixed.push_str("\n[analysis]\n");
    }
    let fixed = fixed.replace("[analysis]", &format!("[analysis]\n{lines}"));
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("fixed.toml");
    std::fs::write(&path, fixed).unwrap();
    let output = pounding()
        .arg("run")
        .arg(&path)
        .args(["--no-output", "--json"])
        .output()
        .unwrap();
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    serde_json::from_slice(&output.stdout).unwrap()
}

/// Displacements to 1e-4 and impacts one by one.
fn agree(a: &Value, b: &Value) {
    for (x, y) in a["buildings"]
        .as_array()
        .unwrap()
        .iter()
        .zip(b["buildings"].as_array().unwrap())
    {
        for (s, t) in x["storeys"]
            .as_array()
            .unwrap()
            .iter()
            .zip(y["storeys"].as_array().unwrap())
        {
            close(
                &s["displacement"]["peak"],
                t["displacement"]["peak"].as_f64().unwrap(),
                1e-4,
            );
        }
    }
    let impacts = |v: &Value| -> Vec<u64> {
        v["gaps"]
            .as_array()
            .unwrap()
            .iter()
            .flat_map(|g| g["levels"].as_array().unwrap())
            .map(|l| l["impacts"].as_u64().unwrap())
            .collect()
    };
    assert_eq!(impacts(a), impacts(b));
    assert!(impacts(a).iter().sum::<u64>() > 0);
}

#[test]
fn row_of_five() {
    let result = run_example("row_of_five");
    assert_eq!(result["gaps"].as_array().unwrap().len(), 4);
    agree(&result, &by_fixed_step("row_of_five", "0.5 ms"));
}

/// Without the wall the frame is Chopra's (Dynamics of Structures, example
/// 13.2.6): roof 0.17395 m by exact modal solution, sampled each 0.02 s.
#[test]
fn rigid_wall() {
    let result = run_example("rigid_wall");
    let roof = &result["buildings"][0]["isolated"][4]["displacement"];
    close(&roof["peak"], 0.173950, 1e-3);
    agree(&result, &by_fixed_step("rigid_wall", "1 ms"));
}

/// Two frames let go: matrix exponentials in 30 digits.
#[test]
fn snap_back() {
    let result = run_example("snap_back");
    let level = &result["gaps"][0]["levels"][0];
    close(&level["first_contact"], 0.278_154_263_102_045_05, 1e-9);
    close(
        &level["approach_velocity_max"],
        0.418_472_563_464_010_24,
        1e-9,
    );
    close(&level["peak_force"]["peak"], 783_354.258_210_039_1, 1e-9);
}

/// A frame with an initial velocity beside a wall, by hand: sines between impacts, of which each
/// begins with a part of the velocity that the last one ended with.
#[test]
fn struck_frame() {
    let result = run_case("snap_back", "struck.toml");
    let (mass, rate, gap, struck, restitution) = (1e5, 40.0_f64.sqrt(), 0.02, 0.4_f64, 0.6);
    let approach = (struck * struck - (rate * gap).powi(2)).sqrt();
    let first = (rate * gap / struck).asin() / rate;
    let amplitude = gap.hypot(restitution * approach / rate);
    let level = &result["gaps"][0]["levels"][0];
    assert_eq!(level["impacts"].as_u64(), Some(4));
    close(&level["first_contact"], first, 1e-9);
    close(&level["approach_velocity_max"], approach, 1e-9);
    close(
        &level["impulse_max"],
        mass * (1.0 + restitution) * approach,
        1e-9,
    );
    let back = &result["buildings"][0]["storeys"][0]["displacement"]["peak"];
    close(back, amplitude, 1e-9);
    let lost = 0.5 * mass * approach * approach * (1.0 - restitution.powi(8));
    close(&result["energy"]["impact"], lost, 1e-9);
}

/// Located jumps against Moreau-Jean stepping, which locates nothing and is of first
/// order.
#[test]
fn rigid_impacts() {
    let result = run_example("rigid_impacts");
    let roof = &result["buildings"][0]["storeys"][2]["displacement"]["peak"];
    close(roof, 0.12408, 1e-3);
    let levels = result["gaps"][0]["levels"].as_array().unwrap();
    let impacts: u64 = levels.iter().map(|l| l["impacts"].as_u64().unwrap()).sum();
    assert_eq!(impacts, 46);
    close(&levels[2]["impulse_max"], 28.03e3, 1e-3);
    assert!(
        levels[2]["peak_force"]["peak"].is_null(),
        "a jump has no force"
    );
    close(&result["energy"]["impact"], 26.87e3, 1e-3);
    let stepped = with_analysis(
        "rigid_impacts",
        "method = \"moreau_jean\"\nstep = \"10 us\"",
    );
    for storey in 0..3 {
        let peak =
            |r: &Value| r["buildings"][0]["storeys"][storey]["displacement"]["peak"].as_f64();
        close(
            &result["buildings"][0]["storeys"][storey]["displacement"]["peak"],
            peak(&stepped).unwrap(),
            2e-3,
        );
    }
    close(
        &result["energy"]["impact"],
        stepped["energy"]["impact"].as_f64().unwrap(),
        1e-2,
    );
}
