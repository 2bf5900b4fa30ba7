//! Parameters of a gap's model that differ between its contact levels.
use std::path::Path;

use pounding_assembly::{AssemblyError, assemble};
use pounding_case::Case;
use pounding_time_history::{Outcome, run};

/// The three-storey pair for ten seconds with these keys of its gap.
fn text(gap: &str, analysis: &str) -> String {
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
    let case = std::fs::read_to_string(format!("{root}/examples/three_storey_pair/case.toml"));
    let case = case
        .unwrap()
        .replace("../../ground_motions", &format!("{root}/ground_motions"))
        .replace("duration = \"31 s\"", &format!("duration = 10\n{analysis}"));
    let (before, rest) = case.split_once("model = \"jankowski_2005\"").unwrap();
    let (_, after) = rest.split_once("[ground_motion]").unwrap();
    format!("{before}{gap}\n[ground_motion]{after}")
}

fn outcome(gap: &str, analysis: &str) -> Outcome {
    let case = Case::parse(&text(gap, analysis), Path::new("case.toml")).unwrap();
    let assembly = assemble(&case).unwrap();
    run(&assembly.system, &assembly.options, &mut [], &mut |_| {}).unwrap()
}

/// Force over penetration at the peak of each level, from the bottom: of an elastic contact its stiffness, in
/// closed form.
fn stiffness(outcome: &Outcome) -> Vec<f64> {
    let levels = outcome.gaps[0].levels.iter();
    levels
        .map(|l| l.peak_force.value / l.peak_penetration.value)
        .collect()
}

fn close(found: &[f64], expected: &[f64], tolerance: f64) {
    assert_eq!(found.len(), expected.len());
    for (x, y) in found.iter().zip(expected) {
        assert!((x / y - 1.0).abs() < tolerance, "{found:?} {expected:?}");
    }
}

/// Every level has its own stiffness, in the order in which levels are named, from the bottom where they are not.
#[test]
fn levels_have_their_own_stiffness() {
    let from_below = outcome(
        "model = \"linear_elastic\"\nstiffness = [\"50 MN/m\", 100e6, \"93.5 MN/m\"]",
        "",
    );
    close(&stiffness(&from_below), &[50e6, 100e6, 93.5e6], 1e-12);
    let named = outcome(
        "levels = [[3, 3], [1, 1], [2, 2]]\nmodel = \"linear_elastic\"\nstiffness = [\"93.5 MN/m\", \"50 MN/m\", \"100 MN/m\"]",
        "",
    );
    assert_eq!(named, from_below);
    let one = outcome("model = \"linear_elastic\"\nstiffness = 50e6", "");
    let thrice = outcome(
        "model = \"linear_elastic\"\nstiffness = [50e6, 50e6, 50e6]",
        "",
    );
    assert_eq!(one, thrice);
    assert_ne!(one, from_below);
}

/// Damped laws too, as another method has it: fixed steps of Runge and Kutta at a quarter of a hundredth
/// of the contact time.
#[test]
fn methods_agree_on_levels() {
    let gap = "model = \"anagnostopoulos_2004\"\nseparation = \"no_tension\"\nstiffness = [\"50 MN/m\", \"100 MN/m\", \"200 MN/m\"]\nrestitution = [0.4, 0.65, 0.9]";
    let exact = outcome(gap, "");
    let stepped = outcome(gap, "method = \"runge_kutta_4\"\nstep = 5e-5");
    let of = |outcome: &Outcome| -> [Vec<f64>; 2] {
        let levels = || outcome.gaps[0].levels.iter();
        [
            levels().map(|l| l.peak_force.value).collect(),
            levels().map(|l| l.approach_velocity_max).collect(),
        ]
    };
    let impacts = |outcome: &Outcome| -> Vec<usize> {
        outcome.gaps[0].levels.iter().map(|l| l.impacts).collect()
    };
    assert_eq!(impacts(&exact), impacts(&stepped));
    assert!(impacts(&exact).iter().all(|n| *n > 0));
    for (a, b) in of(&exact).iter().zip(&of(&stepped)) {
        close(a, b, 1e-4);
    }
}

/// What is wrong with a value is said where it stands, each once.
#[test]
fn wrong_values_of_levels() {
    for (gap, place, says) in [
        (
            "model = \"linear_elastic\"\nstiffness = [1e8, 2e8]",
            "[1e8, 2e8]",
            "2 values where there are 3 contact levels",
        ),
        (
            "model = \"linear_elastic\"\nstiffness = []",
            "[]",
            "0 values where there are 3 contact levels",
        ),
        (
            "model = \"linear_elastic\"\nstiffness = [1e8, \"2 MN\", 1e8]",
            "\"2 MN\"",
            "must be a stiffness (N/m)",
        ),
        (
            "model = \"anagnostopoulos_2004\"\nstiffness = 1e8\nrestitution = [0.5, 0.6, 1.7]",
            "1.7",
            "restitution = 1.7 is outside",
        ),
        (
            "model = \"linear_elastic\"\nstiffness = 1e8\nrestitution = [0.5, 0.6, 0.7]",
            "restitution",
            "has no parameter \"restitution\"",
        ),
        (
            "model = \"linear_elastic\"\nstiffness = [1e8, [2e8], 1e8]",
            "[2e8]",
            "stiffness",
        ),
    ] {
        let text = text(gap, "");
        let error = match Case::parse(&text, Path::new("case.toml")) {
            Err(error) => error,
            Ok(case) => match assemble(&case) {
                Err(AssemblyError::Case(error)) => error,
                other => panic!("{other:?}"),
            },
        };
        assert!(error.message.contains(says), "{}", error.message);
        assert_eq!(&text[error.span.clone()], place, "{gap}: {}", error.message);
        assert!(error.others.is_empty(), "{error:?}");
    }
}
