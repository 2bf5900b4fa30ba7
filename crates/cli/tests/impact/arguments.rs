//! Bad arguments are refused with the remedy.

use super::{example, refused, refused_with};

#[test]
fn bad_arguments() {
    refused("", &["unknown impact model"]);
    refused("--json", &["<MODEL>"]);
    refused(
        "hertz_1883|--example",
        &["unknown impact model", "did you mean \"hertz_1882\""],
    );
    refused("hertz_1882|--all", &["cannot be used with"]);
    refused(
        "hertzdamp|muthukumar_desroches_2006|--example",
        &["asked for twice"],
    );
    refused(
        "hertz_1882",
        &["needs stiffness", "-p stiffness=VALUE, or --example"],
    );
    refused(
        "hertz_1882|-p|stifness=3",
        &["no parameter \"stifness\"", "did you mean \"stiffness\""],
    );
    refused(
        "hertz_1882|jankowski_2005|--example|-p|restitutoin=0.5",
        &[
            "no chosen model has a parameter \"restitutoin\"",
            "did you mean \"restitution\"",
        ],
    );
    refused("hertz_1882|-p|stiffness", &["not KEY=VALUE"]);
    refused(
        "hertz_1882|-p|stiffness=stiff",
        &["does not start with a number"],
    );
    refused(
        "linear_elastic|hertz_1882|-p|stiffness=93.5 MN/m",
        &[
            "`stiffness` of model hertz_1882 must be a contact stiffness (N/m^1.5)",
            "-p hertz_1882.stiffness",
        ],
    );
    refused(
        "hertz_1882|-p|stiffness=2.75e9 N/m^1.5|-p|stiffness=3e9",
        &["given twice"],
    );
    refused(
        "linear_elastic|-p|stiffness=3 N/m|-p|stiffness=3 N",
        &["serves no model"],
    );
    refused(
        "hertz_1882|--example|-p|linear_elastic.stiffness=3",
        &["not among those chosen"],
    );
    refused(
        "exact_hunt_crossley|--example|-p|exponent=2",
        &["needs stiffness"],
    );
    refused(
        "jankowski_2005|--example|-p|restitution=1.2",
        &["outside (0, 1]"],
    );
    refused(
        "hertz_1882|--example|--separation|magic",
        &["unknown separation", "no_tension"],
    );
    refused(
        "hertz_1882|--example|--separation|no_tension",
        &["does not offer"],
    );
    refused(
        "hertz_1882|linear_elastic|--example|--separation|no_tension",
        &["no chosen model offers"],
    );
    refused(
        "hertz_1882|--example|--mass-left=-3 t",
        &["greater than zero", "for example --mass-left \"25 t\""],
    );
    refused(
        "hertz_1882|--example|--mass-right=3 m",
        &["--mass-right must be a mass"],
    );
    refused("hertz_1882|--example|--velocity=0", &["do not approach"]);
    refused(
        "hertz_1882|--example|--velocity-right=1",
        &["do not approach"],
    );
    refused(
        "hertz_1882|--example|--mass-right=wall|--velocity-right=-1",
        &["rigid wall"],
    );
    refused("hertz_1882|--example|--drop", &["--height"]);
    refused("hertz_1882|--example|--height=1", &["--drop"]);
    refused(
        "hertz_1882|--example|--drop|--height=-1",
        &["--height", "greater than zero"],
    );
    refused(
        "hertz_1882|--example|--drop|--height=1|--gravity=-1",
        &["zero or more"],
    );
    refused(
        "hertz_1882|--example|--drop|--height=1|--gravity=0",
        &["do not approach"],
    );
    refused(
        "hertz_1882|--example|--read-at=0",
        &["--read-at", "greater than zero"],
    );
    refused(
        "hertz_1882|--example|--table",
        &["nothing to tabulate", "always returns 1"],
    );
    refused(
        "exact_kelvin_voigt|--example|-p|damping_ratio=0.2|--table",
        &["exclude one another"],
    );
    refused("stereomechanical|--example|--csv|x.csv", &["force history"]);
    refused_with(
        &example(),
        "hertz_1882|--example|--csv|absent/x.csv",
        4,
        &["cannot write absent/x.csv"],
    );
}

#[test]
fn output_replaces_files_only() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("taken.svg")).unwrap();
    for option in ["--csv", "--svg"] {
        let arguments = format!("exact_hunt_crossley|--example|{option}|taken.svg");
        refused_with(
            folder.path(),
            &arguments,
            4,
            &["cannot write taken.svg", "not a regular file"],
        );
    }
    let left: Vec<_> = std::fs::read_dir(folder.path()).unwrap().collect();
    assert_eq!(left.len(), 1, "{left:?}");
}

#[test]
fn a_collision_that_does_not_end_names_its_model() {
    let folder = tempfile::tempdir().unwrap();
    // A reading keeps a body that creeps to rest on its way.
    let setting =
        "--example|-p|restitution=0.001|--drop|--height|0.01|--mass-left|1e4|--read-at|100 s";
    let wanted = ["model pant_2010", "did not end"];
    refused_with(folder.path(), &format!("pant_2010|{setting}"), 3, &wanted);
    // Beside another one too, whose result is shown.
    let output = super::run_in(folder.path(), &format!("hertz_1882|pant_2010|{setting}"));
    assert_eq!(output.status.code(), Some(3));
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(wanted.iter().all(|part| told.contains(part)), "{told}");
    let shown = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(shown.contains("hertz_1882 - "), "{shown}");
}

/// The stiffness of the example belongs to its exponent: with another one the remedy is not --example.
#[test]
fn an_exponent_of_its_own_needs_a_stiffness_of_its_own() {
    refused(
        "exact_hunt_crossley|--example|-p|exponent=1",
        &["add -p stiffness=VALUE", "belongs to another exponent"],
    );
}

/// A stiffness out of all proportion is no damping.
#[test]
fn elastic_laws_do_not_creep() {
    for arguments in [
        "hertz_1882|-p|stiffness=1e300",
        "linear_elastic|--example|--mass-left|1e-300",
    ] {
        let output = super::run_in(&example(), arguments);
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(!message.contains("damping"), "{message}");
    }
}
