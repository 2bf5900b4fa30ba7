//! What a second call of a builder's method does.

use pounding::gap_element::{ModelParameters, registry};
use pounding::prelude::*;
use std::sync::Arc;

use crate::{building, el_centro, gap, pair, refused, storey};

/// Settings are those of the last call.
#[test]
fn the_last_of_two_settings_counts() {
    let run = |building: Building, gap: Gap| {
        let heavy = crate::building("heavy", 1000.0, 2215.0);
        let simulation = Simulation::of([building, heavy])
            .gap(gap)
            .ground_motion(el_centro());
        simulation.duration(Time::seconds(6.0)).run().unwrap()
    };
    let light = || building("light", 25.0, 3.46);
    let once = run(light(), gap());
    let other = Damping::Modal { ratios: vec![0.2] };
    let last = Damping::StiffnessProportional { ratio: 0.05 };
    let moved = [1.0, 2.0, 3.0].map(Length::millimetres);
    let twice = light()
        .damping(other.clone())
        .undamped()
        .damping(last)
        .initial_displacement(moved)
        .initial_displacement([]);
    let parameters = ModelParameters::from_pairs(&[("stiffness", 1e8)]);
    let elastic = registry::build("linear_elastic", &parameters).unwrap();
    let gap_twice = Gap::between("light", "heavy")
        .widths([Length::millimetres(1.0)])
        .impact_model(Arc::from(elastic))
        .levels([(3, 3)])
        .matching_floors_only()
        .width(Length::millimetres(20.0))
        .model(
            "jankowski_2005",
            [("stiffness", 2.75e9), ("damping_ratio", 0.35)],
        );
    assert_eq!(run(twice, gap_twice), once);
    assert_ne!(run(light().damping(other), gap()), once);
    let still = GroundMotion::of([Acceleration::gravities(0.0); 2], Time::seconds(1.0)).unwrap();
    let again = pair()
        .ground_motion(still)
        .method(MethodChoice::RungeKutta4 { step: 1e-3 })
        .method(RunOptions::default().method)
        .duration(Time::seconds(1.0))
        .ground_motion(el_centro())
        .duration(Time::seconds(6.0));
    assert_eq!(again.run().unwrap(), once);
}

/// Parts are added, and a storey has one law.
#[test]
fn parts_are_added() {
    let two = Building::shear("two")
        .storey(storey(25.0, 3.46))
        .storey(storey(20.0, 3.0))
        .undamped();
    let law = [("yield_force", 1e5)];
    let name = "elastic_perfectly_plastic";
    let each = two
        .clone()
        .law_of_storeys([1], name, law)
        .law_of_storeys([2], name, law);
    let model = Simulation::of([each])
        .ground_motion(el_centro())
        .build()
        .unwrap();
    assert_eq!(model.system().elements().len(), 2);
    let again = Simulation::of([two.law(name, law).law(name, law)]).ground_motion(el_centro());
    let (said, _) = refused(&again);
    assert!(said.contains("it has a law already"), "{said}");
}

/// Floors that are to act on each other as if they were level are named.
#[test]
fn floors_that_act_as_if_level_are_named() {
    let pair = |gap: Gap| {
        let building = |name: &str| Building::shear(name).storey(storey(25.0, 3.46)).undamped();
        Simulation::of([building("a"), building("b")])
            .gap(
                gap.width(Length::millimetres(20.0))
                    .model("linear_elastic", [("stiffness", 93.5e6)]),
            )
            .ground_motion(el_centro())
    };
    let gap = || Gap::between("a", "b").floor_to_floor();
    let (said, help) = refused(&pair(gap()));
    assert!(
        said.contains("gap a-b: `.floor_to_floor()` has no meaning"),
        "{said}"
    );
    assert!(help.contains("`.levels(...)`"), "{help}");
    assert!(pair(gap().levels([(1, 1)])).build().is_ok());
}
