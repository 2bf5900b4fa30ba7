//! Names of systems that no builder has looked at.

use std::sync::Arc;

use pounding::gap_element::{ImpactModel, ModelParameters, registry};
use pounding::hysteresis::{LawParameters, build};
use pounding::prelude::*;
use pounding::shear_building::ShearBuilding;
use pounding::time_history::{Floor, GroundAcceleration, LinkedPair, System};

/// Two buildings of one storey with two gaps and a link, of these names.
fn system(buildings: [&str; 2], gaps: [&str; 2], link: &str) -> System {
    let building = |name: &str| {
        let damping = Damping::StiffnessProportional { ratio: 0.05 };
        let (mass, stiffness, height) = (vec![25e3], vec![3.46e6], vec![3.0]);
        let made =
            ShearBuilding::under_gravity(name.to_owned(), mass, stiffness, height, damping, 0.0);
        Arc::new(made.unwrap())
    };
    let ground = GroundAcceleration {
        samples: Arc::new(vec![0.0, 1.0, -1.0, 0.0]),
        time_step: 0.1,
    };
    let mut system = System::new(buildings.map(building).to_vec(), ground);
    let elastic = registry::build(
        "linear_elastic",
        &ModelParameters::from_pairs(&[("stiffness", 1e8)]),
    );
    let elastic: Arc<dyn ImpactModel> = Arc::from(elastic.unwrap());
    let floors = [(0, 1)].map(|(l, r)| (Floor::Storey(l, 0), Floor::Storey(r, 0)));
    let between = || buildings.map(str::to_owned);
    for gap in gaps {
        let levels = floors.map(|(l, r)| (l, r, 0.1, Arc::clone(&elastic)));
        system.add_gap(gap, between(), levels.to_vec()).unwrap();
    }
    let law = build("linear", &LawParameters::from_pairs(&[("stiffness", 1e6)])).unwrap();
    let pair = LinkedPair {
        left: floors[0].0,
        right: floors[0].1,
        law: law.into(),
        yield_deformation: None,
    };
    system.add_link(link, between(), vec![pair]).unwrap();
    system
}

/// A result has groups of these names: none is written, and nothing run, of those that cannot be such.
#[test]
fn names_that_no_result_can_have_are_refused_before_the_run() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("r.h5");
    let model = |system| Model::of_system(system, RunOptions::default()).unwrap();
    let good = ["a", "b"];
    let gaps = ["near", "far"];
    for (buildings, gaps, link, said) in [
        (["", "b"], gaps, "l", "\"\" cannot name a building"),
        (["a/c", "b"], gaps, "l", "\"a/c\" cannot name a building"),
        ([".", "b"], gaps, "l", "\".\" cannot name a building"),
        (["a", "a"], gaps, "l", "another building has it"),
        (["a", "b\0"], gaps, "l", "cannot name a building"),
        (good, ["g", "g"], "l", "another gap has it"),
        (good, ["", "g"], "l", "\"\" cannot name a gap"),
        (good, ["g", "g/level"], "l", "\"g/level\" cannot name a gap"),
        (good, gaps, "..", "\"..\" cannot name a link"),
    ] {
        let error = model(system(buildings, gaps, link))
            .run_to_file(&path)
            .unwrap_err();
        assert!(matches!(error, Error::Result(_)), "{error}");
        assert!(error.to_string().contains(said), "{error}");
        assert_eq!(error.help().as_deref(), Some("give it another name"));
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }
    // One name for things of different kinds, and dots within, are no matter; nor is that of a wall, which
    // systems know by its place.
    let dotted = model(system(["1.5 m", "wall"], ["b", "b.2"], "b"));
    dotted.run_to_file(&path).unwrap();
    assert!(path.exists());
}

/// A gap without levels would be a check of nothing, and samples that are no numbers a step that fell
/// below all bounds.
#[test]
fn gaps_without_levels_and_samples_that_are_no_numbers_are_refused() {
    let good = system(["a", "b"], ["near", "far"], "l");
    let between = || ["a", "b"].map(str::to_owned);
    let error = good.clone().add_gap("none", between(), Vec::new());
    assert_eq!(
        error.unwrap_err().to_string(),
        "gap none: it has no levels at which floors could meet"
    );
    for (value, said) in [(f64::NAN, "NaN"), (f64::INFINITY, "inf")] {
        let ground = GroundAcceleration {
            samples: Arc::new(vec![0.0, 1.0, value, 0.0]),
            time_step: 0.1,
        };
        let system = System::new(good.buildings().to_vec(), ground);
        let error = match Model::of_system(system, RunOptions::default()) {
            Ok(model) => model.run().unwrap_err(),
            Err(error) => error,
        };
        let said = format!("ground motions: sample 3 of 4 is {said}; they must all be finite");
        assert_eq!(error.to_string(), said);
    }
}
