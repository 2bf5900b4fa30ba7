//! Rungs 5 and 6 of the ladder: multi-storey pounding against converged values.
//!
//! Cases C1 (pair of single storeys), C2 (three-storey pair), C3a (eight against
//! five storeys) and C4 (row of five) under a synthetic motion of 30 s. Origin of
//! the values: `tests/data/reference_cases.json`.
#![allow(clippy::print_stdout)]

use pounding_time_history::{DEFAULT_RELATIVE_TOLERANCE, MethodChoice, Outcome, RunOptions, run};
use verification::{
    REFERENCE_MODELS, ReferenceValues, reference_cases, reference_system, synthetic_motion,
};

/// Largest relative difference between two lists.
fn difference(name: &str, computed: &[f64], reference: &[f64], worst: &mut f64) {
    assert_eq!(computed.len(), reference.len(), "{name}");
    for (a, b) in computed.iter().zip(reference) {
        let scale = b.abs();
        let error = if scale == 0.0 {
            a.abs()
        } else {
            (a - b).abs() / scale
        };
        *worst = worst.max(error);
    }
}

fn compare(label: &str, outcome: &Outcome, reference: &ReferenceValues) -> Vec<String> {
    let levels: Vec<_> = outcome.gaps.iter().flat_map(|g| &g.levels).collect();
    let storeys: Vec<_> = outcome.buildings.iter().flat_map(|b| &b.storeys).collect();
    let (mut u, mut f, mut t, mut v, mut e) = (0.0, 0.0, 0.0, 0.0, 0.0);
    let list = |g: &dyn Fn(usize) -> f64, n: usize| (0..n).map(g).collect::<Vec<_>>();
    let n = levels.len();
    difference(
        "displacement",
        &list(&|i| storeys[i].displacement.value, storeys.len()),
        &reference.peak_u,
        &mut u,
    );
    difference(
        "force",
        &list(&|i| levels[i].peak_force.value, n),
        &reference.peak_force,
        &mut f,
    );
    difference(
        "first contact",
        &list(&|i| levels[i].first_contact.unwrap_or(-1.0), n),
        &reference.t_first,
        &mut t,
    );
    difference(
        "approach velocity",
        &list(&|i| levels[i].approach_velocity_max, n),
        &reference.max_v0,
        &mut v,
    );
    let end = outcome.energy.end;
    difference(
        "energy",
        &[end.input, end.viscous],
        &[reference.input, reference.viscous],
        &mut e,
    );
    // Elastic laws dissipate nothing: their contact work is compared with the input.
    let scale = if reference.contact.abs() < 1e-9 * reference.input {
        reference.input
    } else {
        reference.contact
    };
    e = e.max((end.impact - reference.contact).abs() / scale);
    let impacts: Vec<usize> = levels.iter().map(|l| l.impacts).collect();
    let sticks: usize = levels.iter().map(|l| l.sticks).sum();
    println!(
        "{label:16} u {u:8.1e}  F {f:8.1e}  t {t:8.1e}  v {v:8.1e}  E {e:8.1e}  residual {:8.1e}  impacts {}  steps {} rejected {} events {}",
        outcome.energy.residual_ratio,
        if impacts == reference.n_impacts {
            "equal".to_owned()
        } else {
            format!("{impacts:?} for {:?}", reference.n_impacts)
        },
        outcome.statistics.steps,
        outcome.statistics.rejected,
        outcome.statistics.events,
    );
    let mut failures = Vec::new();
    for (name, error, bound) in [
        ("displacement", u, 1e-6),
        ("force", f, 1e-6),
        ("first contact", t, 1e-6),
        ("approach velocity", v, 1e-6),
        ("energy", e, 1e-6),
        ("residual", outcome.energy.residual_ratio, 1e-9),
    ] {
        if !(error <= bound) {
            failures.push(format!("{label}: {name} differs by {error:e}"));
        }
    }
    if impacts != reference.n_impacts {
        failures.push(format!(
            "{label}: impacts {impacts:?} for {:?}",
            reference.n_impacts
        ));
    }
    if sticks != reference.n_stick {
        failures.push(format!(
            "{label}: stuck {sticks} times for {}",
            reference.n_stick
        ));
    }
    failures
}

fn check_case(name: &str) {
    let cases = reference_cases().unwrap();
    let case = &cases.cases[name];
    let mut failures = Vec::new();
    for model in REFERENCE_MODELS {
        let system = reference_system(case, model, synthetic_motion().unwrap(), 1.0).unwrap();
        let adaptive = MethodChoice::Adaptive {
            relative_tolerance: DEFAULT_RELATIVE_TOLERANCE,
        };
        for (short, method) in [("evd", RunOptions::default().method), ("ad", adaptive)] {
            let label = format!("{name} {model} {short}");
            let options = RunOptions {
                method,
                ..RunOptions::default()
            };
            match run(&system, &options, &mut [], &mut |_| {}) {
                Ok(outcome) => failures.extend(compare(&label, &outcome, &case.models[model])),
                Err(error) => failures.push(format!("{label}: {error}")),
            }
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn c1_pair_of_single_storeys() {
    check_case("C1");
}

#[test]
fn c2_three_storey_pair() {
    check_case("C2");
}

#[test]
fn c3a_eight_against_five_storeys() {
    check_case("C3a");
}

#[test]
fn c4_row_of_five() {
    check_case("C4");
}
