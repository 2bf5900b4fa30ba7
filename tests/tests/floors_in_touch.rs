//! Gaps of zero width: floors that lie against one another from the start. Truth is the
//! adaptive pair at 1e-12, which goes another way through the program.
#![allow(clippy::unwrap_used)]

use std::sync::Arc;

use pounding_gap_element::{ImpactModel, SeparationRule, registry};
use pounding_shear_building::{Damping, ShearBuilding};
use pounding_time_history::{
    Floor, GroundAcceleration, MethodChoice, Outcome, RunOptions, System, TimeHistoryError, run,
};

const FAST: MethodChoice = MethodChoice::EventDriven {
    relative_tolerance: 1e-10,
};
const TRUTH: MethodChoice = MethodChoice::Adaptive {
    relative_tolerance: 1e-12,
};

fn law(name: &str, restitution: f64, rule: Option<SeparationRule>) -> Arc<dyn ImpactModel> {
    let descriptor = registry::find(name).unwrap();
    let mut parameters = descriptor.example_parameters(restitution);
    if let Some(rule) = rule {
        parameters = parameters.with_separation(rule);
    }
    registry::build(name, &parameters).unwrap().into()
}

fn go(system: &System, method: MethodChoice, duration: f64) -> Outcome {
    let options = RunOptions {
        method,
        duration: Some(duration),
        energy_tolerance: None,
    };
    run(system, &options, &mut [], &mut |_| {}).unwrap()
}

fn building(storeys: usize, factor: f64) -> Arc<ShearBuilding> {
    let damping = Damping::StiffnessProportional { ratio: 0.05 };
    let (mass, stiffness) = (vec![3e4 * factor; storeys], vec![5e7 * factor; storeys]);
    let height = vec![3.0; storeys];
    Arc::new(ShearBuilding::new("b".into(), mass, stiffness, height, damping).unwrap())
}

/// Two buildings that move alike when alone: masses and stiffnesses in proportion.
fn alike(storeys: usize, factor: f64, law: &Arc<dyn ImpactModel>) -> System {
    let sample = |i: i32| {
        let t = f64::from(i) * 0.01;
        3.0 * (7.3 * t).sin() + 2.0 * (23.0 * t).sin()
    };
    let ground = GroundAcceleration {
        samples: (0..401).map(sample).collect::<Vec<_>>().into(),
        time_step: 0.01,
    };
    let buildings = vec![building(storeys, 1.0), building(storeys, factor)];
    let mut system = System::new(buildings, ground);
    let pair = |i| {
        let (left, right) = (Floor::Storey(0, i), Floor::Storey(1, i));
        (left, right, 0.0, Arc::clone(law))
    };
    let names = ["a".to_owned(), "b".to_owned()];
    let pairs = (0..storeys).map(pair).collect();
    system.add_gap("gap", names, pairs).unwrap();
    system
}

/// A floor that the ground presses against a wall stays there; one that it pulls off does
/// not come back too late.
#[test]
fn a_resting_contact_is_not_lost() {
    let laws = [
        ("hunt_crossley_1975", Some(SeparationRule::NoTension)),
        ("hertz_1882", None),
        ("jankowski_2005", None),
        ("anagnostopoulos_2004", None),
    ];
    for (name, rule) in laws {
        for case in 0..36 {
            let time_step = [0.005, 0.01, 0.02][case % 3];
            let jump = [-2.3, 2.3][case / 3 % 2];
            let storeys = 1 + case / 6 % 3;
            let sample = |i: i32| match i {
                0 => 0.0,
                _ => jump * (1.0 + 0.1 * f64::from(i).sin()),
            };
            let ground = GroundAcceleration {
                samples: (0..50).map(sample).collect::<Vec<_>>().into(),
                time_step,
            };
            let mut system = System::new(vec![building(storeys, 1.0)], ground);
            let floors = match case / 18 {
                0 => (Floor::Wall, Floor::Storey(0, 0)),
                _ => (Floor::Storey(0, 0), Floor::Wall),
            };
            let names = ["a".to_owned(), "b".to_owned()];
            let pair = (floors.0, floors.1, 0.0, law(name, 0.5, rule));
            system.add_gap("gap", names, vec![pair]).unwrap();
            let (fast, truth) = (go(&system, FAST, 0.1), go(&system, TRUTH, 0.1));
            let impulse = |o: &Outcome| o.gaps[0].levels[0].impulse;
            let error = (impulse(&fast) - impulse(&truth)).abs();
            assert!(
                error <= 1e-6 * impulse(&truth).max(1.0),
                "{name} {case}: {error}"
            );
        }
    }
}

/// Equal buildings move alike, whatever lies between them.
#[test]
fn twins_do_not_collide() {
    for name in ["anagnostopoulos_2004", "jankowski_2005", "linear_elastic"] {
        for storeys in [1, 3, 5, 9] {
            let system = alike(storeys, 1.0, &law(name, 0.65, None));
            let outcome = go(&system, FAST, 4.0);
            assert_eq!(outcome.impacts.len(), 0, "{name}, {storeys} storeys");
        }
    }
}

/// So do buildings in proportion, which touch by round-off at most.
#[test]
fn buildings_in_proportion_do_not_push_one_another() {
    for (storeys, factor) in [(2, 1.7), (3, 1.7), (4, 1.3), (3, 2.0)] {
        for name in ["hertz_1882", "jankowski_2005"] {
            let system = alike(storeys, factor, &law(name, 0.65, None));
            let (together, alone) = (go(&system, FAST, 4.0), go(&system.isolated(), FAST, 4.0));
            assert!(together.energy.residual_ratio < 1e-9, "{name} x{factor}");
            for (a, b) in together.buildings.iter().zip(&alone.buildings) {
                for (a, b) in a.storeys.iter().zip(&b.storeys) {
                    let error = a.displacement.value / b.displacement.value - 1.0;
                    assert!(error.abs() < 1e-9, "{name} x{factor}: {error:e}");
                }
            }
        }
    }
}

/// Floors that overlap from the start are refused, also where the gap comes last.
#[test]
fn floors_that_overlap_at_time_zero_are_refused() {
    let ground = GroundAcceleration {
        samples: vec![0.0; 3].into(),
        time_step: 0.01,
    };
    let system = System::new(vec![building(1, 1.0)], ground);
    let mut system = system.with_initial_state(&[0.02], &[0.0]).unwrap();
    let pair = (
        Floor::Storey(0, 0),
        Floor::Wall,
        0.005,
        law("hertz_1882", 1.0, None),
    );
    let names = ["b".to_owned(), "wall".to_owned()];
    let error = system.add_gap("gap", names, vec![pair]).unwrap_err();
    assert!(
        matches!(error, TimeHistoryError::InitialState { .. }),
        "{error}"
    );
    assert!(error.to_string().contains("0.015"), "{error}");
}
