//! Contacts that last some microseconds, in samples of 5 ms: a series over the rest of a sample overflows, and must not
//! be taken for the motion. Against the pair of order 8(5,3) in physical coordinates.
#![allow(clippy::unwrap_used)]

use pounding_gap_element::{ModelParameters, registry};
use pounding_time_history::{Floor, MethodChoice, Outcome, RunOptions, System, run};
use verification::{single_storey, synthetic_motion};

const DURATION: f64 = 3.0;

/// A building as good as free beside a wall that it touches at rest.
fn beside_a_wall(model: &str, stiffness: f64) -> System {
    let body = single_storey("body", 5.8, 3.2);
    let mut system = System::new(vec![body], synthetic_motion().unwrap());
    let parameters =
        ModelParameters::from_pairs(&[("stiffness", stiffness), ("restitution", 0.65)]);
    let model = registry::build(model, &parameters).unwrap().into();
    let pair = (Floor::Storey(0, 0), Floor::Wall, 0.0, model);
    let names = ["body".to_owned(), "wall".to_owned()];
    system.add_gap("body-wall", names, vec![pair]).unwrap();
    system
}

fn go(system: &System, method: MethodChoice) -> Outcome {
    let options = RunOptions {
        method,
        duration: Some(DURATION),
        energy_tolerance: None,
    };
    run(system, &options, &mut [], &mut |_| {}).unwrap()
}

#[test]
fn contacts_of_microseconds_are_followed() {
    let relative_tolerance = 1e-12;
    for model in ["pant_2010", "ye_li_2009", "papi_toopchi_2022"] {
        for stiffness in [1e8, 1e10, 1e12, 1e14] {
            let system = beside_a_wall(model, stiffness);
            let exact = go(&system, MethodChoice::EventDriven { relative_tolerance });
            let other = go(&system, MethodChoice::Adaptive { relative_tolerance });
            let place = format!("{model}, {stiffness:e}");
            assert!(!exact.impacts.is_empty(), "{place}");
            assert_eq!(exact.impacts.len(), other.impacts.len(), "{place}");
            let forces = [&exact, &other].map(|o| o.gaps[0].levels[0].peak_force.value);
            let displacements =
                [&exact, &other].map(|o| o.buildings[0].storeys[0].displacement.value);
            for [a, b] in [forces, displacements] {
                assert!((a / b - 1.0).abs() < 1e-6, "{place}: {a} {b}");
            }
        }
    }
}
