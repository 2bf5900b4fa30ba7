//! Every law of the registry, as a storey and as a link: Newmark with a short step, which
//! walks through the law's branches, and the explicit pair, which locates them.

use std::sync::Arc;

use pounding_hysteresis::{LawParameters, descriptors};
use pounding_shear_building::{Foundation, ShearBuilding, SpringDashpot};
use pounding_time_history::{Floor, LinkedPair, System};

use super::setup::{
    ADAPTIVE, EVENT_DRIVEN, TIGHT, building, difference, el_centro, go, law, newmark,
};

/// Seconds of El Centro.
const DURATION: f64 = 6.0;

/// Newmark's step (s): short for laws that close a gap onto a stiff element.
fn step(law: &str) -> f64 {
    if matches!(law, "gap_hook" | "elastoplastic_gap" | "hyperbolic_gap") {
        2.5e-5
    } else {
        2.0e-4
    }
}

fn parameters(name: &str) -> LawParameters {
    pounding_hysteresis::find(name)
        .unwrap()
        .example_parameters()
}

/// A building of two storeys with the law in both, of a mass that makes the elastic
/// period half a second and lets it yield.
fn storeys(name: &str) -> Option<ShearBuilding> {
    let law = law(name, &parameters(name));
    let stiffness = law.law.initial_stiffness();
    if !(stiffness.is_finite() && stiffness > 0.0 && law.law.holds_static_load()) {
        return None;
    }
    let mass = stiffness * (0.5 / std::f64::consts::TAU).powi(2) * 0.4;
    Some(building("frame", (2, mass, stiffness), Some(law)))
}

/// The same on a foundation that sways and rocks.
fn on_soil(name: &str) -> Option<ShearBuilding> {
    let building = storeys(name)?;
    let (mass, stiffness) = (building.mass()[0], building.stiffness()[0]);
    let held = |stiffness: f64| {
        Some(SpringDashpot {
            stiffness,
            dashpot: 0.02 * stiffness,
        })
    };
    let springs = [held(8.0 * stiffness), held(200.0 * stiffness)];
    let foundation = Foundation::new(mass, 5.0 * mass, springs[0], springs[1]).unwrap();
    Some(building.on_foundation(foundation, None, 9.8).unwrap())
}

/// Two elastic buildings of one storey, linked by the law.
fn linked(name: &str) -> System {
    let law = law(name, &parameters(name));
    let own = law.law.initial_stiffness() + 10.0 * law.law.initial_damping();
    let stiffness = own.clamp(1.0e5, 1.0e8);
    let mass = |period: f64| stiffness * (period / std::f64::consts::TAU).powi(2);
    let soft = building("soft", (1, mass(0.8), stiffness), None);
    let stiff = building("stiff", (1, mass(0.3), stiffness), None);
    let mut system = System::new(vec![Arc::new(soft), Arc::new(stiff)], el_centro());
    let pair = LinkedPair {
        left: Floor::Storey(0, 0),
        right: Floor::Storey(1, 0),
        law: law.law,
        yield_deformation: law.yield_drift,
    };
    let names = ["soft".to_owned(), "stiff".to_owned()];
    system.add_link("joint", names, vec![pair]).unwrap();
    system
}

fn check(law: &str, system: &System) {
    let exact = go(system, ADAPTIVE, DURATION);
    let stepped = go(system, newmark(step(law)), DURATION);
    let worst = difference(&exact, &stepped);
    let energy = exact.energy;
    println!(
        "{law}: peaks {worst:.1e}, residual {:.1e}, hysteretic {:.3} of the input, {:?}",
        energy.residual_ratio,
        energy.end.hysteretic / energy.largest_input,
        exact.statistics
    );
    assert!(energy.residual_ratio < 1.0e-7, "{law}: {energy:?}");
    assert!(worst < 2.0e-4, "{law}: {worst}");
    // The event-driven method goes by series where all branches are straight.
    let (by_events, tight) = (
        go(system, EVENT_DRIVEN, DURATION),
        go(system, TIGHT, DURATION),
    );
    let straight = system
        .elements()
        .iter()
        .all(|e| e.law.is_piecewise_linear());
    let worst = difference(&by_events, &tight);
    println!(
        "    event-driven: peaks {worst:.1e}, residual {:.1e}, {:?}",
        by_events.energy.residual_ratio, by_events.statistics
    );
    assert!(
        worst < if straight { 1.0e-9 } else { 1.0e-7 },
        "{law}: {worst}"
    );
    let title = by_events.method.title;
    assert_eq!(straight, title.contains("exact"), "{law}: {title}");
    if straight {
        let residual = by_events.energy.residual_ratio;
        assert!(residual < 1.0e-11, "{law}: {residual}");
    }
}

#[test]
fn every_law_as_a_storey() {
    every_law(storeys);
}

#[test]
fn every_law_as_a_storey_on_soil() {
    every_law(on_soil);
}

fn every_law(building: fn(&str) -> Option<ShearBuilding>) {
    let mut count = 0;
    for descriptor in descriptors() {
        if let Some(building) = building(descriptor.name) {
            let system = System::new(vec![Arc::new(building)], el_centro());
            check(descriptor.name, &system);
            count += 1;
        }
    }
    assert!(count >= 15, "{count} laws");
}

#[test]
fn every_law_as_a_link() {
    for descriptor in descriptors() {
        check(descriptor.name, &linked(descriptor.name));
    }
}
