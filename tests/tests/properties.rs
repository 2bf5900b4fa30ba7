//! Rung 6 of the ladder: symmetry, independence, determinism.
use std::sync::Arc;

use pounding_time_history::{GroundAcceleration, MethodChoice, Outcome, RunOptions, System, run};
use verification::{
    REFERENCE_MODELS, ReferenceCase, reference_cases, reference_system, synthetic_motion,
};

const ADAPTIVE: MethodChoice = MethodChoice::Adaptive {
    relative_tolerance: 1e-10,
};
const EVENT_DRIVEN: MethodChoice = MethodChoice::EventDriven {
    relative_tolerance: 1e-10,
};
const NEWMARK: MethodChoice = MethodChoice::Newmark {
    step: 1e-3,
    beta: 0.25,
    gamma: 0.5,
};
const HHT: MethodChoice = MethodChoice::HhtAlpha {
    step: 1e-3,
    alpha: -0.1,
};
const RK4: MethodChoice = MethodChoice::RungeKutta4 { step: 1e-3 };

fn solve(system: &System, method: MethodChoice) -> Outcome {
    let options = RunOptions {
        method,
        duration: Some(12.0),
        energy_tolerance: None,
    };
    run(system, &options, &mut [], &mut |_| {}).unwrap()
}

fn mirrored(case: &ReferenceCase) -> ReferenceCase {
    let json = serde_json::json!({
        "buildings": case.buildings.iter().rev().map(|b| serde_json::json!({
            "name": b.name, "m": b.m, "k": b.k, "alphaM": b.alpha, "betaK": b.beta,
        })).collect::<Vec<_>>(),
        "links": [], "models": {},
    });
    let mut other: ReferenceCase = serde_json::from_value(json).unwrap();
    let counts: Vec<usize> = case.buildings.iter().map(|b| b.m.len()).collect();
    let total: usize = counts.iter().sum();
    // Degree of freedom in the mirror: same storey, building counted from the right.
    let place = |dof: usize| {
        let (mut start, mut building) = (0, 0);
        while dof >= start + counts[building] {
            start += counts[building];
            building += 1;
        }
        total - start - counts[building] + (dof - start)
    };
    for gap in (0..counts.len() - 1).rev() {
        let start: usize = counts[..gap].iter().sum();
        let range = start..start + counts[gap];
        for link in case.links.iter().filter(|l| range.contains(&l.a)) {
            other.links.push(verification::ReferenceLink {
                a: place(link.b),
                b: place(link.a),
                gap: link.gap,
                k_lin: link.k_lin,
                k_hertz: link.k_hertz,
                e: link.e,
            });
        }
    }
    other
}

fn negated(ground: &GroundAcceleration) -> GroundAcceleration {
    GroundAcceleration {
        samples: ground.samples.iter().map(|a| -a).collect::<Vec<_>>().into(),
        time_step: ground.time_step,
    }
}

/// Final displacements with buildings in reverse order and the sign changed.
fn reflected(outcome: &Outcome, case: &ReferenceCase) -> Vec<f64> {
    let mut out = Vec::new();
    let mut end = outcome.final_displacement.len();
    for building in &case.buildings {
        let start = end - building.m.len();
        out.extend(outcome.final_displacement[start..end].iter().map(|u| -u));
        end = start;
    }
    out
}

fn check_mirror(name: &str, model: &str, method: MethodChoice) {
    let cases = reference_cases().unwrap();
    let case = &cases.cases[name];
    let ground = synthetic_motion().unwrap();
    let one = solve(
        &reference_system(case, model, ground.clone(), 1.0).unwrap(),
        method,
    );
    let two = solve(
        &reference_system(&mirrored(case), model, negated(&ground), 1.0).unwrap(),
        method,
    );
    assert!(!one.impacts.is_empty());
    assert_eq!(
        one.impacts.len(),
        two.impacts.len(),
        "{name} {model} {method:?}"
    );
    let back = reflected(&two, case);
    if method == ADAPTIVE || method == EVENT_DRIVEN {
        let scale = one
            .buildings
            .iter()
            .flat_map(|b| &b.storeys)
            .map(|s| s.displacement.value)
            .fold(0.0, f64::max);
        for (a, b) in one.final_displacement.iter().zip(&back) {
            assert!((a - b).abs() <= 1e-10 * scale, "{name} {model}: {a} {b}");
        }
    } else {
        assert_eq!(one.final_displacement, back, "{name} {model} {method:?}");
        let times = |o: &Outcome| {
            o.impacts
                .iter()
                .map(|i| i.time_closed.to_bits())
                .collect::<Vec<_>>()
        };
        let (mut a, mut b) = (times(&one), times(&two));
        a.sort_unstable();
        b.sort_unstable();
        assert_eq!(a, b, "closure times of {name} {model} {method:?}");
    }
}

#[test]
fn the_mirror_image_gives_the_mirrored_answer() {
    for method in [EVENT_DRIVEN, ADAPTIVE, NEWMARK, HHT, RK4] {
        for model in ["kv", "jank", "fricl", "hertzdamp"] {
            check_mirror("C2", model, method);
        }
    }
    for method in [EVENT_DRIVEN, ADAPTIVE, NEWMARK, RK4] {
        check_mirror("C4", "kv_cut", method);
    }
}

#[test]
fn a_gap_too_wide_to_close_gives_the_isolated_buildings() {
    let cases = reference_cases().unwrap();
    for name in ["C2", "C3a", "C4"] {
        let case = &cases.cases[name];
        let system = reference_system(case, "jank", synthetic_motion().unwrap(), 1e3).unwrap();
        for method in [EVENT_DRIVEN, ADAPTIVE, NEWMARK, HHT, RK4] {
            let row = solve(&system, method);
            assert!(row.impacts.is_empty());
            let mut start = 0;
            for building in system.buildings() {
                let alone = System::new(vec![Arc::clone(building)], system.ground().clone());
                let alone = solve(&alone, method);
                let part = &row.final_displacement[start..start + building.storeys()];
                start += building.storeys();
                if method == ADAPTIVE || method == EVENT_DRIVEN {
                    for (a, b) in part.iter().zip(&alone.final_displacement) {
                        assert!((a - b).abs() < 1e-10 * 0.1, "{name}: {a} {b}");
                    }
                } else {
                    assert_eq!(part, alone.final_displacement, "{name} {method:?}");
                }
            }
        }
    }
}

#[test]
fn two_runs_give_the_same_bits() {
    let cases = reference_cases().unwrap();
    let system = reference_system(
        &cases.cases["C3a"],
        "jank",
        synthetic_motion().unwrap(),
        1.0,
    )
    .unwrap();
    for method in [EVENT_DRIVEN, ADAPTIVE] {
        assert_eq!(
            format!("{:?}", solve(&system, method)),
            format!("{:?}", solve(&system, method))
        );
    }
}

/// Work of all contacts is the loss of the impacts, and impulses change momentum:
/// both counted twice, in the log of impacts and in the ledger.
#[test]
fn the_log_of_impacts_sums_up_to_the_ledger() {
    let cases = reference_cases().unwrap();
    for model in REFERENCE_MODELS {
        let system =
            reference_system(&cases.cases["C3a"], model, synthetic_motion().unwrap(), 1.0).unwrap();
        let outcome = solve(&system, ADAPTIVE);
        let impacts: f64 = outcome.impacts.iter().map(|i| i.energy_dissipated).sum();
        let levels: f64 = outcome.gaps[0]
            .levels
            .iter()
            .map(|l| l.energy_dissipated)
            .sum();
        let scale = outcome.energy.largest_input;
        assert!(
            (impacts - outcome.energy.end.impact).abs() < 1e-12 * scale,
            "{model}"
        );
        assert!((impacts - levels).abs() < 1e-12 * scale, "{model}");
        assert!(
            outcome
                .impacts
                .iter()
                .all(|i| i.energy_dissipated > -1e-9 * scale),
            "{model}"
        );
        assert!(outcome.impacts.iter().all(|i| i.peak_force.time >= i.time_closed && !(i.peak_force.time > i.time_opened)), "{model}");
    }
}

/// Buildings that touch at rest close at zero speed: no law may divide by it.
#[test]
fn touching_buildings_run() {
    let cases = reference_cases().unwrap();
    for model in REFERENCE_MODELS {
        let system =
            reference_system(&cases.cases["C2"], model, synthetic_motion().unwrap(), 0.0).unwrap();
        let outcome = solve(&system, ADAPTIVE);
        assert!(outcome.impacts.len() > 10, "{model}");
        assert!(
            outcome.final_displacement.iter().all(|u| u.is_finite()),
            "{model}"
        );
        assert!(
            outcome.energy.residual_ratio < 1e-8,
            "{model}: {:e}",
            outcome.energy.residual_ratio
        );
    }
}
