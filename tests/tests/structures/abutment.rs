//! A bridge frame that runs against the backfill of an abutment.

use std::sync::Arc;

use pounding_hysteresis::{LawParameters, build};
use pounding_shear_building::{Damping, ShearBuilding};
use pounding_time_history::{Floor, LinkedPair, MethodChoice, Outcome, RunOptions, System, run};

use crate::yielding::setup::el_centro;

/// 600 t, 0.9 s, damped by a dashpot; backfill of 10 m width behind 25.4 mm.
fn frame() -> System {
    let damping = Damping::Dashpots {
        coefficients: vec![418_879.020_478_639_1],
    };
    let stiffness = vec![29_243_272.299_524_024];
    let frame = ShearBuilding::new("frame".into(), vec![6.0e5], stiffness, vec![8.0], damping);
    let mut system = System::new(vec![Arc::new(frame.unwrap())], el_centro());
    let parameters = LawParameters::from_pairs(&[
        ("initial_stiffness", 2.03e8),
        ("ultimate_force", 3.26e6),
        ("failure_ratio", 0.7),
        ("gap", 0.0254),
    ]);
    let abutment = LinkedPair {
        left: Floor::Storey(0, 0),
        right: Floor::Wall,
        law: build("hyperbolic_gap", &parameters).unwrap().into(),
        yield_deformation: None,
    };
    let names = ["frame".to_owned(), "wall".to_owned()];
    system.add_link("abutment", names, vec![abutment]).unwrap();
    system
}

fn go(method: MethodChoice) -> Outcome {
    let options = RunOptions {
        method,
        duration: Some(20.0),
        ..RunOptions::default()
    };
    run(&frame(), &options, &mut [], &mut |_| {}).unwrap()
}

fn near(what: &str, found: f64, expected: f64, allowed: f64) {
    let error = (found / expected - 1.0).abs();
    assert!(
        error < allowed,
        "{what}: {found} against {expected} ({error:e})"
    );
}

/// Figures of DOP853 of SciPy, the events located, with which Radau's method agrees to 5e-12:
/// six closures, the envelope reached again three times after the first.
fn agrees(outcome: &Outcome, allowed: f64) {
    let roof = outcome.buildings[0].storeys[0].displacement;
    near("displacement", roof.value, 0.065_929_055_046_148_5, allowed);
    near("its time", roof.time, 5.415_018_776_868_135, allowed);
    let wall = &outcome.links[0].levels[0];
    near("force", wall.force.value, 2_828_275.158_146_522_5, allowed);
    near("its time", wall.force.time, 5.784_059_460_492_414, allowed);
    near(
        "loss",
        wall.energy_dissipated,
        45_659.219_528_131_23,
        allowed,
    );
    let end = outcome.energy.end;
    near("input", end.input, 293_742.273_507_465_7, allowed);
    near("viscous", end.viscous, 239_373.221_785_133_65, allowed);
    near("hysteretic", end.hysteretic, 45_659.219_528_131_23, allowed);
    near("strain", end.strain, 8_704.438_459_206_585, 10.0 * allowed);
    near(
        "end",
        outcome.final_displacement[0],
        -0.024_399_020_577_666_047,
        10.0 * allowed,
    );
}

#[test]
fn the_adaptive_pair_agrees_with_the_reference() {
    agrees(
        &go(MethodChoice::Adaptive {
            relative_tolerance: 1e-12,
        }),
        1e-9,
    );
}

#[test]
fn event_driven_agrees_with_the_reference() {
    agrees(
        &go(MethodChoice::EventDriven {
            relative_tolerance: 1e-12,
        }),
        1e-9,
    );
}

#[test]
fn newmark_agrees_with_the_reference() {
    let method = MethodChoice::Newmark {
        step: 5.0e-5,
        beta: 0.25,
        gamma: 0.5,
    };
    agrees(&go(method), 1e-4);
}
