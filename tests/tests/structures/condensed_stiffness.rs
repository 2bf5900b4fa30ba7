//! Buildings with a full stiffness matrix: a cantilever wall beside a frame with flexible
//! beams.

use std::collections::BTreeMap;
use std::sync::Arc;

use pounding_gap_element::{ImpactModel, ModelParameters, registry};
use pounding_shear_building::{Damping, LateralStiffness, ShearBuilding};
use pounding_time_history::{
    Floor, GridRecorder, MethodChoice, Outcome, Recorder, RunOptions, System, run,
};
use serde::Deserialize;

use super::reference::{Reference, Within};
use crate::yielding::setup::el_centro;

/// The figures of `data/structures/condensed_stiffness_pair.json`, which says where they come
/// from.
#[derive(Deserialize)]
struct File {
    stiffness: BTreeMap<String, Vec<Vec<f64>>>,
    rayleigh: Rayleigh,
    reference: Reference,
}

#[derive(Deserialize)]
struct Rayleigh {
    alpha: f64,
    beta: f64,
}

fn file() -> File {
    let text = include_str!("../../data/structures/condensed_stiffness_pair.json");
    serde_json::from_str(text).unwrap()
}

pub(super) fn model() -> Arc<dyn ImpactModel> {
    let parameters = ModelParameters::from_pairs(&[("stiffness", 2.0e8), ("restitution", 0.65)]);
    registry::build("anagnostopoulos_2004", &parameters)
        .unwrap()
        .into()
}

fn pair_of(wall: LateralStiffness, frame: LateralStiffness) -> System {
    let file = file();
    let modal = Damping::Modal {
        ratios: vec![0.03, 0.03, 0.04, 0.05],
    };
    let Rayleigh { alpha, beta } = file.rayleigh;
    let building = |name: &str, mass: Vec<f64>, stiffness, damping| {
        let height = vec![3.0; mass.len()];
        let name = name.to_owned();
        let made =
            ShearBuilding::with_stiffness_matrix(name, mass, stiffness, height, damping, 0.0);
        Arc::new(made.unwrap())
    };
    let wall = building("A", vec![4.0e4; 4], wall, modal);
    let masses = vec![6.0e4, 6.0e4, 5.0e4];
    let frame = building("B", masses, frame, Damping::Rayleigh { alpha, beta });
    let mut system = System::new(vec![wall, frame], el_centro());
    let level = |i: usize| (Floor::Storey(0, i), Floor::Storey(1, i), 0.012, model());
    let names = ["A".to_owned(), "B".to_owned()];
    system
        .add_gap("A-B", names, (0..3).map(level).collect())
        .unwrap();
    system
}

fn typed_pair() -> System {
    let file = file();
    let typed = |name: &str| LateralStiffness::from_rows(&file.stiffness[name]).unwrap();
    pair_of(typed("A"), typed("B"))
}

fn go(system: &System, method: MethodChoice, recorders: &mut [&mut dyn Recorder]) -> Outcome {
    let options = RunOptions {
        method,
        duration: Some(25.0),
        ..RunOptions::default()
    };
    run(system, &options, recorders, &mut |_| {}).unwrap()
}

const EVENT_DRIVEN: MethodChoice = MethodChoice::EventDriven {
    relative_tolerance: 1e-10,
};

fn near(what: &str, found: f64, expected: f64, allowed: f64) {
    let error = (found - expected).abs();
    assert!(
        error <= allowed * expected.abs(),
        "{what}: {found} against {expected} ({:e})",
        error / expected.abs()
    );
}

/// All that the reference says, within these relative errors of values and of times (s).
fn agrees(outcome: &Outcome, allowed: f64, times: f64) {
    let within = Within {
        peak_times: times,
        force_times: times,
        first_contact: 1e-10,
        impact_times: times,
        own_loss: 10.0 * allowed,
        ..Within::all(allowed)
    };
    file().reference.agrees_within(outcome, within, &|_| None);
}

#[test]
fn event_driven_agrees_with_the_reference() {
    let outcome = go(&typed_pair(), EVENT_DRIVEN, &mut []);
    agrees(&outcome, 1e-9, 1e-8);
}

#[test]
fn the_adaptive_pair_agrees_with_the_reference() {
    let method = MethodChoice::Adaptive {
        relative_tolerance: 1e-12,
    };
    agrees(&go(&typed_pair(), method, &mut []), 1e-8, 1e-5);
}

/// The wall from its flexural rigidity, the frame from its columns and beams.
#[test]
fn helpers_make_the_matrices_of_the_reference() {
    let wall = LateralStiffness::cantilever(&[3.0; 4], &[6.0e9; 4], None).unwrap();
    let springs = [12.0 * 1.5e8 / 6.0; 3];
    let frame = LateralStiffness::fishbone(&[3.0; 3], &[2.4e8; 3], &springs).unwrap();
    agrees(
        &go(&pair_of(wall, frame), EVENT_DRIVEN, &mut []),
        1e-8,
        1e-6,
    );
}

/// Implicit steps come to the same end.
#[test]
fn newmark_converges_to_the_reference() {
    let expected = file().reference.peak("u_A4");
    let error = |substeps: f64| {
        let method = MethodChoice::Newmark {
            step: 0.02 / substeps,
            beta: 0.25,
            gamma: 0.5,
        };
        let outcome = go(&typed_pair(), method, &mut []);
        let roof = outcome.buildings[0].storeys[3].displacement.value;
        (roof / expected - 1.0).abs()
    };
    let (coarse, fine) = (error(20.0), error(80.0));
    assert!(fine < 1e-4 && fine < 0.2 * coarse, "{coarse:e} {fine:e}");
}

/// A chain of storeys typed in as a matrix.
#[test]
fn a_typed_chain_is_the_shear_building() {
    let (mass, k, height) = (vec![2.5e4; 3], [6.0e6, 5.0e6, 4.0e6], vec![3.0; 3]);
    let rows = vec![
        vec![k[0] + k[1], -k[1], 0.0],
        vec![-k[1], k[1] + k[2], -k[2]],
        vec![0.0, -k[2], k[2]],
    ];
    for (gravity, damping) in [
        (0.0, Damping::StiffnessProportional { ratio: 0.05 }),
        (9.81, Damping::Modal { ratios: vec![0.05] }),
        (
            9.81,
            Damping::Rayleigh {
                alpha: 0.4,
                beta: 2.0e-3,
            },
        ),
    ] {
        let chain = ShearBuilding::under_gravity(
            "left".into(),
            mass.clone(),
            k.to_vec(),
            height.clone(),
            damping.clone(),
            gravity,
        );
        let typed = ShearBuilding::with_stiffness_matrix(
            "left".into(),
            mass.clone(),
            LateralStiffness::from_rows(&rows).unwrap(),
            height.clone(),
            damping,
            gravity,
        );
        let outcome = |building: ShearBuilding| {
            let stiff = ShearBuilding::new(
                "right".into(),
                vec![1.0e6; 3],
                vec![2.0e9; 3],
                vec![3.0; 3],
                Damping::StiffnessProportional { ratio: 0.05 },
            );
            let buildings = vec![Arc::new(building), Arc::new(stiff.unwrap())];
            let mut system = System::new(buildings, el_centro());
            let level = |i| (Floor::Storey(0, i), Floor::Storey(1, i), 0.02, model());
            let names = ["left".to_owned(), "right".to_owned()];
            system
                .add_gap("gap", names, (0..3).map(level).collect())
                .unwrap();
            go(&system, EVENT_DRIVEN, &mut [])
        };
        let (chain, typed) = (outcome(chain.unwrap()), outcome(typed.unwrap()));
        assert!(!chain.impacts.is_empty());
        assert_eq!(chain.impacts.len(), typed.impacts.len());
        for (a, b) in chain.buildings[0]
            .storeys
            .iter()
            .zip(&typed.buildings[0].storeys)
        {
            near(
                "displacement",
                b.displacement.value,
                a.displacement.value,
                1e-13,
            );
            near("drift", b.drift_ratio.value, a.drift_ratio.value, 1e-13);
            near("shear", b.storey_shear.value, a.storey_shear.value, 1e-13);
            let (a, b) = (a.acceleration_absolute.value, b.acceleration_absolute.value);
            near("acceleration", b, a, 1e-13);
        }
        // The moment of the storey shears over the storeys below them.
        let moment = typed.buildings[0].base_moment.unwrap().value;
        let bound: f64 = chain.buildings[0]
            .storeys
            .iter()
            .map(|s| s.storey_shear.value * 3.0)
            .sum();
        assert!(moment > 0.5 * bound && moment <= bound * (1.0 + 1e-12));
    }
}

/// Recorders see the shears that the peaks come from, and change nothing.
#[test]
fn histories_hold_the_shears_of_the_matrix() {
    let system = typed_pair();
    let mut recorder = GridRecorder::new(0.001).unwrap();
    let recorded = go(&system, EVENT_DRIVEN, &mut [&mut recorder]);
    let plain = go(&system, EVENT_DRIVEN, &mut []);
    assert_eq!(recorded.buildings, plain.buildings);
    let history = &recorder.responses;
    let floors = system.degrees_of_freedom();
    for (i, storey) in plain.buildings.iter().flat_map(|b| &b.storeys).enumerate() {
        let shears = history.storey_shear.iter().skip(i).step_by(floors);
        let most = shears.fold(0.0_f64, |m, x| m.max(x.abs()));
        let peak = storey.storey_shear.value;
        assert!(
            most <= peak * (1.0 + 1e-12) && most > 0.99 * peak,
            "{most} {peak}"
        );
    }
}
