//! Sizes and extremes: what is large runs, and what would never end is refused or named
//! before it begins.
use std::path::Path;
use std::process::{Command, Output};

const CASE: &str = r#"
[[building]]
name = "a"
storeys = 2
mass = "25 t"
stiffness = "3.46 MN/m"
height = "3 m"
damping = { modal = 0.05 }
[[gap]]
between = ["a", "wall"]
levels = [1]
width = "20 mm"
model = "anagnostopoulos_2004"
stiffness = "93.5 MN/m"
restitution = 0.65
[ground_motion]
file = "record.csv"
[analysis]
duration = "2 s"
"#;

fn pounding(folder: &Path, case: &str, arguments: &[&str]) -> Output {
    let mut record = "# Unit: g\n# dt: 0.02 s\ntime_s,acceleration_g\n".to_owned();
    for i in 0..120 {
        let t = f64::from(i) * 0.02;
        record.push_str(&format!(
            "{t:.2},{:.5}\n",
            0.1 * (2.5 * std::f64::consts::PI * t).sin()
        ));
    }
    std::fs::write(folder.join("case.toml"), case).unwrap();
    std::fs::write(folder.join("record.csv"), record).unwrap();
    Command::new(env!("CARGO_BIN_EXE_pounding"))
        .current_dir(folder)
        .env("NO_COLOR", "1")
        .args(arguments)
        .output()
        .unwrap()
}

fn one_line(bytes: &[u8]) -> String {
    let text = String::from_utf8_lossy(bytes).replace(['│', '\n'], " ");
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// `check` and `run` both end with exit code 2 and these words.
fn refused(case: &str, wanted: &[&str]) {
    let folder = tempfile::tempdir().unwrap();
    for command in [
        &["check", "case.toml"][..],
        &["run", "case.toml", "--no-output"],
    ] {
        let output = pounding(folder.path(), case, command);
        let text = one_line(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{command:?}: {text}");
        for part in wanted {
            assert!(text.contains(part), "\"{part}\" is not in: {text}");
        }
    }
}

/// A uniform chain has `omega_1 = 2 sqrt(k/m) sin(pi / (2 (2 n + 1)))`.
#[test]
fn two_thousand_storeys_are_checked_and_run() {
    let case = CASE
        .replace("storeys = 2", "storeys = 2000")
        .replace("duration = \"2 s\"", "duration = \"0.1 s\"");
    let folder = tempfile::tempdir().unwrap();
    let output = pounding(folder.path(), &case, &["check", "case.toml", "--json"]);
    assert!(output.status.success(), "{}", one_line(&output.stderr));
    let found: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let periods = found["buildings"][0]["period"].as_array().unwrap();
    for (j, period) in periods.iter().enumerate() {
        let angle = (2 * j + 1) as f64 * std::f64::consts::PI / (2.0 * 4001.0);
        let omega = 2.0 * (3.46e6_f64 / 2.5e4).sqrt() * angle.sin();
        let exact = std::f64::consts::TAU / omega;
        let error = period.as_f64().unwrap() / exact - 1.0;
        assert!(error.abs() < 1e-10, "mode {}: {error:e}", j + 1);
    }
    let run = ["run", "case.toml", "--no-output", "--json"];
    let output = pounding(folder.path(), &case, &run);
    assert!(output.status.success(), "{}", one_line(&output.stderr));
    let found: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert!(found["energy"]["residual_ratio"].as_f64().unwrap() < 1e-9);
}

/// Terms in the modes and terms of the floors are two ways to one motion.
#[test]
fn large_buildings_move_as_the_adaptive_pair_says() {
    let folder = tempfile::tempdir().unwrap();
    let large = CASE
        .replace("storeys = 2", "storeys = 110")
        .replace("20 mm", "1 mm");
    let large = large.replace("[\"a\", \"wall\"]", "[\"wall\", \"a\"]");
    let mut answers = Vec::new();
    for method in ["event_driven", "adaptive"] {
        let case = format!("{large}method = \"{method}\"\n");
        let run = ["run", "case.toml", "--no-output", "--json"];
        let output = pounding(folder.path(), &case, &run);
        assert!(output.status.success(), "{}", one_line(&output.stderr));
        answers.push(serde_json::from_slice::<serde_json::Value>(&output.stdout).unwrap());
    }
    let [exact, pair] = &answers[..] else {
        panic!("two answers");
    };
    let level = |v: &serde_json::Value| v["gaps"][0]["levels"][0].clone();
    assert!(level(exact)["impacts"].as_u64().unwrap() > 0);
    assert_eq!(level(exact)["impacts"], level(pair)["impacts"]);
    for quantity in [
        "displacement",
        "drift_ratio",
        "storey_shear",
        "acceleration_absolute",
    ] {
        for storey in 0..30 {
            let of = |v: &serde_json::Value| {
                v["buildings"][0]["storeys"][storey][quantity]["peak"]
                    .as_f64()
                    .unwrap()
            };
            let error = of(exact) / of(pair) - 1.0;
            assert!(error.abs() < 1e-6, "{quantity} {storey}: {error:e}");
        }
    }
}

#[test]
fn a_hundred_thousand_storeys_are_refused_with_the_limit() {
    let case = CASE.replace("storeys = 2", "storeys = 100000");
    refused(&case, &["`storeys`", "whole number from 1 to 4000"]);
    let absurd = CASE.replace("storeys = 2", "storeys = 4000000000");
    refused(&absurd, &["`storeys`", "whole number"]);
}

#[test]
fn runs_that_would_not_end_are_refused_by_what_they_mean() {
    let light = CASE
        .replace("25 t", "1e-8 t")
        .replace("\"3.46 MN/m\"", "\"1e8 MN/m\"")
        .replace("\"2 s\"", "\"31 s\"");
    let period = ["steps over 31 s", "shortest period of building a", "units?"];
    refused(&light, &period);
    let endless = CASE.replace("\"2 s\"", "\"1e300 s\"");
    refused(&endless, &["`duration` is 1e300 s", "shorten `duration`"]);
    let fine = CASE.replace("file =", "time_step = \"1e-9 s\"\nfile =");
    let fine = fine.replace("record.csv", "values.csv");
    let fine = fine.replace("\"2 s\"", "\"200 s\"");
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("values.csv"), "0.1\n0.2\n".repeat(40)).unwrap();
    let fine = fine.replace(
        "time_step =",
        "format = \"plain_columns\"\nunit = \"g\"\ntime_step =",
    );
    let output = pounding(folder.path(), &fine, &["check", "case.toml"]);
    let text = one_line(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{text}");
    let wanted = "steps over 200 s, as the time step of the ground motion is 1e-9 s";
    assert!(text.contains(wanted), "{text}");
    let step = CASE.replace(
        "\"2 s\"",
        "\"2 s\"\nmethod = \"newmark\"\nstep = \"1e-12 s\"",
    );
    refused(&step, &["`step` is 1e-12 s", "raise `step`"]);
    let contact = CASE.replace("93.5 MN/m", "1e300 MN/m");
    refused(
        &contact,
        &["case.toml", "gap a-wall", "digits of the time", "units?"],
    );
    let law = "[[link]]\nbetween = [\"a\", \"wall\"]\nlevels = [1]\nmodel = \"bilinear\"\nstiffness = \"1e30 MN/m\"\nyield_force = \"1 MN\"\nhardening_ratio = 0.1\n[ground_motion]";
    let link = CASE.replace("[ground_motion]", law);
    refused(
        &link,
        &[
            "case.toml",
            "a-wall level 1",
            "stiffness and damping of the law",
        ],
    );
    // A hook is that stiff once its play is taken up: its law shows nothing of it at first.
    for (model, keys) in [
        (
            "gap_hook",
            "tension_gap = \"5 mm\"\ntension_stiffness = \"1e28 MN/m\"",
        ),
        (
            "elastoplastic_gap",
            "gap = \"5 mm\"\nstiffness = \"1e28 MN/m\"\nyield_force = \"1e30 MN\"",
        ),
    ] {
        let hook = format!(
            "[[link]]\nbetween = [\"a\", \"wall\"]\nlevels = [1]\nmodel = \"{model}\"\n{keys}\n[ground_motion]"
        );
        let link = CASE.replace("[ground_motion]", &hook);
        refused(
            &link,
            &[
                "case.toml",
                "a-wall level 1",
                "once its play is taken up",
                "stiffness of the law",
            ],
        );
    }
    // So are steps of its own rate to a damper: at 1e15 N s/m over 25 t some 1e-11 s.
    let damper = "[[link]]\nbetween = [\"a\", \"wall\"]\nlevels = [1]\nmodel = \"viscous_damper\"\ndamping = \"1e15 N s/m\"\n[ground_motion]";
    let link = CASE.replace("[ground_motion]", damper);
    refused(
        &link,
        &[
            "case.toml",
            "a-wall level 1",
            "stiffness and damping of the law",
        ],
    );
}

/// Damping of a contact beyond which next to nothing is given back.
#[test]
fn contacts_without_return_are_refused() {
    let damped = CASE.replace("restitution = 0.65", "damping_ratio = 1e9");
    refused(&damped, &["case.toml", "damping_ratio", "[0, 10000]"]);
}

#[test]
fn responses_that_no_disk_has_room_for_are_refused_by_check_as_well() {
    let dense = CASE.replace("\"2 s\"", "\"2 s\"\noutput_step = \"1e-12 s\"");
    let folder = tempfile::tempdir().unwrap();
    for command in [&["check", "case.toml"][..], &["run", "case.toml"]] {
        let output = pounding(folder.path(), &dense, command);
        let text = one_line(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{command:?}: {text}");
        assert!(text.contains("100 GB are the most"), "{text}");
        assert!(
            text.contains("case.toml") && text.contains("output_step"),
            "{text}"
        );
    }
    // What is not written takes no room.
    let output = pounding(folder.path(), &dense, &["run", "case.toml", "--no-output"]);
    assert_eq!(
        output.status.code(),
        Some(0),
        "{}",
        one_line(&output.stderr)
    );
}

/// A long run is possible: it is named, with its steps and the period that is to blame.
#[test]
fn a_run_of_very_many_steps_is_named_by_check() {
    let case = CASE
        .replace("25 t", "1e-8 t")
        .replace("\"2 s\"", "\"1000 s\"");
    let folder = tempfile::tempdir().unwrap();
    let output = pounding(folder.path(), &case, &["check", "case.toml"]);
    assert!(output.status.success(), "{}", one_line(&output.stderr));
    let text = one_line(&output.stdout);
    for part in ["steps, or parts of steps", "shortest period of building a"] {
        assert_eq!(text.matches(part).count(), 1, "{text}");
    }
}
