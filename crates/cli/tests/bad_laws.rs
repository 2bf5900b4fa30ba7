//! Laws of storeys and links that cannot be: exit code 2, place, reason, remedy.
use std::process::{Command, Output};

const LAW: &str =
    "law = { model = \"bilinear\", yield_force = \"120 kN\", hardening_ratio = 0.05 }";
const LINK: &str = "[[link]]\nbetween = [\"a\", \"b\"]\nmodel = \"iwan_six_parameter\"\ndensity = \"4e8 N/m^1.7\"\nexponent = -0.3\nphi_2 = \"5 mm\"\n";

fn case(law: &str, link: &str) -> String {
    format!(
        r#"
[[building]]
name = "a"
storeys = 2
mass = "25 t"
stiffness = "3.46 MN/m"
height = "3 m"
damping = {{ stiffness_proportional = 0.05 }}
{law}
[[building]]
name = "b"
storeys = 2
mass = "100 t"
stiffness = "30 MN/m"
height = "3 m"
damping = {{ ratio = 0.05, modes = [1, 2] }}
{link}
[ground_motion]
file = "record.csv"
[analysis]
duration = "2 s"
"#
    )
}

fn run(case: &str, more: &[&str]) -> Output {
    let folder = tempfile::tempdir().unwrap();
    let mut record = "# Unit: g\n# dt: 0.02 s\ntime_s,acceleration_g\n".to_owned();
    for i in 0..120 {
        let t = f64::from(i) * 0.02;
        record.push_str(&format!("{t:.2},{:.5}\n", 0.4 * (7.0 * t).sin()));
    }
    std::fs::write(folder.path().join("case.toml"), case).unwrap();
    std::fs::write(folder.path().join("record.csv"), record).unwrap();
    Command::new(env!("CARGO_BIN_EXE_pounding"))
        .current_dir(folder.path())
        .env("NO_COLOR", "1")
        .args(["run", "case.toml", "--no-output"])
        .args(more)
        .output()
        .unwrap()
}

fn refused(law: &str, link: &str, wanted: &[&str]) {
    let output = run(&case(law, link), &[]);
    let text = String::from_utf8_lossy(&output.stderr).replace(['│', '\n'], " ");
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert_eq!(output.status.code(), Some(2), "{text}");
    for word in wanted {
        assert!(text.contains(word), "{word:?} is not in: {text}");
    }
    assert!(text.contains("case.toml:"), "no place: {text}");
}

#[test]
fn the_case_itself_runs() {
    let output = run(&case(LAW, LINK), &[]);
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    assert!(
        text.contains("ductility") && text.contains("Link a-b"),
        "{text}"
    );
    // The method was not asked for: what happens in its place is said.
    assert!(text.contains("adaptive pair"), "{text}");
    // Straight branches are followed exactly.
    let output = run(&case(LAW, ""), &[]);
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(text.contains("exact between events"), "{text}");
    assert!(!text.contains("adaptive pair"), "{text}");
}

#[test]
fn laws_of_storeys() {
    let with = |from: &str, to: &str| LAW.replace(from, to);
    refused(&with("bilinear", "bilinaer"), "", &["unknown", "bilinear"]);
    refused(
        &with("hardening_ratio", "hardning_ratio"),
        "",
        &["hardening_ratio"],
    );
    refused(&with("120 kN", "120 kg"), "", &["yield_force", "force"]);
    refused(&with("120 kN", "0 kN"), "", &["yield_force", "0"]);
    refused(&with("0.05", "-1.5"), "", &["hardening_ratio", "-1"]);
    refused(
        &with(", yield_force = \"120 kN\"", ""),
        "",
        &["yield_force", "add"],
    );
    refused(
        &with("\"120 kN\"", "[1e5, 1e5, 1e5]"),
        "",
        &["3 values", "2 places"],
    );
    // As with `mass`: a list of one is not spread.
    refused(
        &with("\"120 kN\"", "[\"120 kN\"]"),
        "",
        &["1 value where there are 2 places", "without brackets"],
    );
    refused(
        &with("{ ", "{ storeys = [3], "),
        "",
        &["storey 3 is not one of 2", "to 2 at the roof"],
    );
    refused(
        &with("{ ", "{ storeys = [1, 1], "),
        "",
        &["storey 1 stands here twice", "each storey of this law once"],
    );
    refused(
        &with("{ ", "{ stiffness = 1e6, "),
        "",
        &["1000000 N/m", "3460000 N/m"],
    );
    refused(&with("model", "modell"), "", &["did you mean `model`"]);
    refused(
        "law = [{ model = \"bilinear\", yield_force = 1e5 }, { model = \"linear\", storeys = [2] }]",
        "",
        &["storey 2", "two laws"],
    );
}

/// What acts on one side alone, or without a stiffness, lets a storey walk off: at a gap of zero too, where
/// laws of one side start with the stiffness of the storey.
#[test]
fn laws_of_links_are_no_laws_of_storeys() {
    for (law, reason) in [
        ("model = \"viscous_damper\", damping = 1e5", "no stiffness"),
        ("model = \"maxwell\", damping = 1e5", "lasting load"),
        (
            "model = \"elastoplastic_gap\", yield_force = 5e4",
            "shortening alone",
        ),
        (
            "model = \"hyperbolic_gap\", initial_stiffness = 3.46e6, ultimate_force = 1e5, failure_ratio = 0.7",
            "shortening alone",
        ),
        (
            "model = \"gap_hook\", compression_stiffness = 3.46e6",
            "no stiffness between",
        ),
        (
            "storeys = [2], model = \"yielding_bumper\", yield_force = 5e4, gap = 0.01",
            "law elastoplastic_gap cannot carry a storey",
        ),
    ] {
        refused(
            &format!("law = {{ {law} }}"),
            "",
            &["cannot carry a storey", reason, "make it a [[link]]"],
        );
    }
}

#[test]
fn gravity_that_overturns() {
    let weak = "p_delta = true\ninitial_displacement = 0";
    let heavy = case(weak, "").replace("\"25 t\"", "\"900 t\"");
    let output = run(&heavy, &[]);
    let text = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{text}");
    assert!(text.contains("cannot"), "{text}");
}

#[test]
fn laws_of_links() {
    let with = |from: &str, to: &str| LINK.replace(from, to);
    refused(
        "",
        &with("\"5 mm\"", "\"5 mm\"\nphi_1 = \"6 mm\""),
        &["phi_1"],
    );
    refused("", &with("-0.3", "-1.0"), &["exponent", "-1"]);
    refused("", &with("N/m^1.7", "N/m^1.5"), &["density"]);
    refused(
        "",
        &with("[\"a\", \"b\"]", "[\"a\", \"c\"]"),
        &["no building \"c\""],
    );
    refused("", &format!("{LINK}{LINK}"), &["two links"]);
    refused("", &with("phi_2 = \"5 mm\"", ""), &["phi_2"]);
    refused(
        "",
        "[[link]]\nbetween = [\"a\", \"b\"]\nmodel = \"viscous_damper\"\ndamping = \"1e5 N s/m\"\nexponent = 0.5\n",
        &[
            "a dashpot coefficient (N s^0.5/m^0.5)",
            "exponent of the law is in the unit",
        ],
    );
}

#[test]
fn rigid_time_stepping_knows_linear_storeys_only() {
    let moreau = case(LAW, "").replace(
        "duration = \"2 s\"",
        "duration = \"2 s\"\nmethod = \"moreau_jean\"\nstep = \"1 ms\"",
    );
    let output = run(&moreau, &[]);
    let text = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{text}");
    assert!(text.contains("a storey 1"), "{text}");
}

/// What relaxes within nanoseconds takes steps as short: 1e13 of them are refused before the first.
#[test]
fn laws_that_relax_at_once() {
    let maxwell = |damping: &str| {
        format!(
            "[[link]]\nbetween = [\"a\", \"b\"]\nmodel = \"maxwell\"\nstiffness = \"10 MN/m\"\ndamping = \"{damping}\"\n"
        )
    };
    let damper = |transition: &str| {
        format!(
            "[[link]]\nbetween = [\"a\", \"b\"]\nmodel = \"viscous_damper\"\ndamping = \"1 MN*s^0.3/m^0.3\"\nexponent = 0.3\ntransition_velocity = \"{transition}\"\n"
        )
    };
    for link in [maxwell("1e-6 N*s/m"), damper("1e-300 m/s")] {
        let output = run(&case("", &link), &[]);
        let text = String::from_utf8_lossy(&output.stderr).replace(['│', '\n'], " ");
        assert_eq!(output.status.code(), Some(2), "{text}");
        assert!(text.contains("stiffness and damping of the law"), "{text}");
    }
    for link in [maxwell("1 MN*s/m"), damper("1 mm/s")] {
        let output = run(&case("", &link), &[]);
        let text = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{text}");
    }
}

/// A bumper opens without force: by its yield force over its stiffness its opening would be a ductility.
#[test]
fn a_bumper_has_no_ductility() {
    let link = "[[link]]\nbetween = [\"a\", \"b\"]\nmodel = \"elastoplastic_gap\"\nstiffness = \"50 MN/m\"\nyield_force = \"1000 kN\"\n";
    let output = run(&case("", link), &["--json"]);
    let answer: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let levels = answer["links"][0]["levels"].as_array().unwrap();
    assert_eq!(levels.len(), 2);
    for level in levels {
        assert!(level["force"]["peak"].as_f64().unwrap() > 0.0, "{level}");
        assert!(level["ductility"].is_null(), "{level}");
    }
}

/// Steps with which the classical method is unstable are refused where laws keep the motion bounded: a
/// friction of 40 kN had forces of 125 kN, with the ledger closed.
#[test]
fn explicit_steps_that_are_unstable() {
    let link = |stiffness: &str| {
        format!(
            "[[link]]\nbetween = [\"a\", \"b\"]\nmodel = \"coulomb_friction\"\nfriction_force = \"20 kN\"\nsticking_stiffness = \"{stiffness}\"\n"
        )
    };
    let by = |law: &str, link: &str, step: &str| {
        let method = format!("method = \"runge_kutta_4\"\nstep = \"{step}\"\nduration");
        run(&case(law, link).replace("duration", &method), &["--json"])
    };
    let stiff = LAW.replace("bilinear", "elastic_perfectly_plastic");
    let stiff = stiff.replace(", hardening_ratio = 0.05", "");
    // The floors of a have 25 t: 3.46 MN/m give them 22 rad/s, and 500 MN/m 270 rad/s.
    let heavy = case(&stiff, "").replace("3.46 MN/m", "500 MN/m");
    let heavy = heavy.replace(
        "duration",
        "method = \"runge_kutta_4\"\nstep = \"20 ms\"\nduration",
    );
    // 10 MN s^0.5/m^0.5 over 1 mm/s are 316 MN s/m at rest, 1.6e4 1/s between floors of 25 and 100 t: forces were
    // twice those of short steps, and grew the ledger's error as steps were cut.
    let damper = "[[link]]\nbetween = [\"a\", \"b\"]\nmodel = \"viscous_damper\"\ndamping = \"10 MN*s^0.5/m^0.5\"\nexponent = 0.5\n";
    for (output, place) in [
        (by("", &link("5 GN/m"), "20 ms"), "a-b level"),
        (run(&heavy, &[]), "building a"),
        (by("", damper, "1 ms"), "a-b level"),
    ] {
        let text = String::from_utf8_lossy(&output.stderr).replace(['│', '\n'], " ");
        let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
        assert_eq!(output.status.code(), Some(2), "{text}");
        for part in ["unstable with the classical", place, "smaller `step`"] {
            assert!(text.contains(part), "{part}: {text}");
        }
    }
    // Within the limit the force is that of the friction.
    let output = by("", &link("50 MN/m"), "1 ms");
    let answer: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let force = answer["links"][0]["levels"][0]["force"]["peak"]
        .as_f64()
        .unwrap();
    assert!(force <= 20.0e3 * (1.0 + 1e-9), "{force}");
}
