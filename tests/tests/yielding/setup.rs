//! Buildings with laws, and the record, for these tests.

use std::path::Path;
use std::sync::Arc;

use pounding_gap_element::{ModelParameters, registry};
use pounding_ground_motion::{Accelerogram, ReadOptions};
use pounding_hysteresis::{LawParameters, build, yield_deformation};
use pounding_shear_building::{Damping, ShearBuilding, StoreyLaw};
use pounding_time_history::{
    Floor, GroundAcceleration, LinkedPair, MethodChoice, Outcome, RunOptions, System, run,
};

/// El Centro 1940 NS as it lies in the repository.
pub fn el_centro_record() -> Accelerogram {
    let file =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../ground_motions/el_centro_1940_ns.csv");
    pounding_ground_motion::read(&file, &ReadOptions::default()).unwrap()
}

/// The same as a ground acceleration.
pub fn el_centro() -> GroundAcceleration {
    let record = el_centro_record();
    GroundAcceleration {
        samples: record.shared_samples(),
        time_step: record.time_step(),
    }
}

/// A law for a storey or a link.
pub fn law(name: &str, parameters: &LawParameters) -> StoreyLaw {
    let law = build(name, parameters).unwrap();
    StoreyLaw {
        yield_drift: yield_deformation(law.descriptor(), parameters, law.initial_stiffness()),
        law: law.into(),
    }
}

/// A building of equal storeys with this law in each.
pub fn building(
    name: &str,
    (storeys, mass, stiffness): (usize, f64, f64),
    stored: Option<StoreyLaw>,
) -> ShearBuilding {
    ShearBuilding::new(
        name.to_owned(),
        vec![mass; storeys],
        vec![stiffness; storeys],
        vec![3.0; storeys],
        Damping::StiffnessProportional { ratio: 0.05 },
    )
    .unwrap()
    .with_laws(vec![stored; storeys])
    .unwrap()
}

/// The three-storey pair of Jankowski (2006) with the yield forces of benchmarks
/// section 5, in one of the laws that have a yield force.
pub fn yielding_pair(name: &str, ground: GroundAcceleration) -> System {
    let storey = |stiffness: f64, yield_force: f64| {
        let parameters =
            LawParameters::from_pairs(&[("stiffness", stiffness), ("yield_force", yield_force)]);
        let descriptor = pounding_hysteresis::find(name).unwrap();
        let mut all = descriptor.example_parameters();
        all.values.extend(parameters.values);
        law(name, &all)
    };
    let light = building("light", (3, 25.0e3, 3.46e6), Some(storey(3.46e6, 1.369e5)));
    let heavy = building("heavy", (3, 1.0e6, 2.215e9), Some(storey(2.215e9, 1.442e7)));
    System::new(vec![Arc::new(light), Arc::new(heavy)], ground)
}

/// Gaps of 20 mm with Kelvin-Voigt contacts between all floors.
pub fn with_gaps(system: System) -> System {
    let parameters = [("stiffness", 9.35e7), ("restitution", 0.65)];
    with_gaps_of(system, "kelvin_voigt", &parameters)
}

/// Gaps of 20 mm with contacts of this model between all floors.
pub fn with_gaps_of(mut system: System, model: &str, parameters: &[(&str, f64)]) -> System {
    let parameters = ModelParameters::from_pairs(parameters);
    let model: Arc<dyn pounding_gap_element::ImpactModel> =
        registry::build(model, &parameters).unwrap().into();
    let pairs = (0..3)
        .map(|s| {
            let (left, right) = (Floor::Storey(0, s), Floor::Storey(1, s));
            (left, right, 0.02, Arc::clone(&model))
        })
        .collect();
    let names = ["light".to_owned(), "heavy".to_owned()];
    system.add_gap("light-heavy", names, pairs).unwrap();
    system
}

/// The same law at every floor between the two.
pub fn with_links(mut system: System, name: &str, parameters: &LawParameters) -> System {
    let StoreyLaw { law, yield_drift } = law(name, parameters);
    let pairs = (0..3)
        .map(|s| LinkedPair {
            left: Floor::Storey(0, s),
            right: Floor::Storey(1, s),
            law: Arc::clone(&law),
            yield_deformation: yield_drift,
        })
        .collect();
    let names = ["light".to_owned(), "heavy".to_owned()];
    system.add_link("joint", names, pairs).unwrap();
    system
}

/// Runs a system for so many seconds.
pub fn go(system: &System, method: MethodChoice, duration: f64) -> Outcome {
    let options = RunOptions {
        method,
        duration: Some(duration),
        energy_tolerance: None,
    };
    run(system, &options, &mut [], &mut |_| {}).unwrap()
}

/// The explicit pair at its default tolerance.
pub const ADAPTIVE: MethodChoice = MethodChoice::Adaptive {
    relative_tolerance: pounding_time_history::DEFAULT_RELATIVE_TOLERANCE,
};

/// The event-driven method at its default tolerance.
pub const EVENT_DRIVEN: MethodChoice = MethodChoice::EventDriven {
    relative_tolerance: pounding_time_history::DEFAULT_RELATIVE_TOLERANCE,
};

/// The explicit pair at a tolerance that leaves round-off.
pub const TIGHT: MethodChoice = MethodChoice::Adaptive {
    relative_tolerance: 1.0e-13,
};

/// Newmark's average acceleration with this step (s).
pub fn newmark(step: f64) -> MethodChoice {
    MethodChoice::Newmark {
        step,
        beta: 0.25,
        gamma: 0.5,
    }
}

/// Maximum relative difference of the peaks of storeys, of base moments and of responses with names.
pub fn difference(a: &Outcome, b: &Outcome) -> f64 {
    let mut worst = 0.0_f64;
    for (a, b) in a.buildings.iter().zip(&b.buildings) {
        let moments = a.base_moment.iter().zip(&b.base_moment);
        let responses = a.responses.iter().zip(&b.responses);
        for (x, y) in moments.chain(responses.map(|(x, y)| (&x.peak, &y.peak))) {
            worst = worst.max((x.value - y.value).abs() / y.value);
        }
        for (a, b) in a.storeys.iter().zip(&b.storeys) {
            for (x, y) in [
                (a.displacement, b.displacement),
                (a.drift_ratio, b.drift_ratio),
                (a.storey_shear, b.storey_shear),
            ] {
                worst = worst.max((x.value - y.value).abs() / y.value);
            }
        }
    }
    worst
}
