//! The event-driven method where sampling at the record's step would fail, and against
//! the adaptive pair, which shares no step with it.
use std::sync::Arc;

use pounding_gap_element::{ModelParameters, registry};
use pounding_shear_building::{Damping, ShearBuilding};
use pounding_time_history::{
    Floor, GroundAcceleration, MethodChoice, Outcome, RunOptions, StoreyPeaks, System, run,
};
use verification::{AnyModel, reference_cases, reference_system, synthetic_motion};

fn event_driven(relative_tolerance: f64) -> MethodChoice {
    MethodChoice::EventDriven { relative_tolerance }
}

const ADAPTIVE: MethodChoice = MethodChoice::Adaptive {
    relative_tolerance: 1e-11,
};

fn go(system: &System, method: MethodChoice) -> Outcome {
    let options = RunOptions {
        method,
        ..RunOptions::default()
    };
    run(system, &options, &mut [], &mut |_| {}).unwrap()
}

fn spring() -> AnyModel {
    let parameters = ModelParameters::from_pairs(&[("stiffness", 1.0e8), ("restitution", 0.7)]);
    registry::build("exact_kelvin_voigt", &parameters)
        .unwrap()
        .into()
}

fn building(storeys: usize, damping: Damping) -> Arc<ShearBuilding> {
    let all = |x: f64| vec![x; storeys];
    let name = format!("of{storeys}");
    let building = ShearBuilding::new(name, all(2.0e4), all(3.0e7), all(3.0), damping);
    Arc::new(building.unwrap())
}

/// A record with few samples: a straight line lasts half a period of the building.
fn coarse() -> GroundAcceleration {
    let samples = (0..80).map(|i| (1.7 * f64::from(i)).sin() + 0.6 * (0.9 * f64::from(i)).cos());
    GroundAcceleration {
        samples: Arc::new(samples.collect()),
        time_step: 0.12,
    }
}

fn beside_a_wall(gap: f64, storeys: usize, damping: Damping) -> System {
    let mut system = System::new(vec![building(storeys, damping)], coarse());
    let names = ["building".to_owned(), "wall".to_owned()];
    let level = (Floor::Storey(0, storeys - 1), Floor::Wall, gap, spring());
    system.add_gap("gap", names, vec![level]).unwrap();
    system
}

const NEARLY_NONE: Damping = Damping::MassProportional { ratio: 0.02 };

/// The roof's largest distance to the right, from a run in which it meets nothing.
fn reach(storeys: usize) -> f64 {
    // With a gap a little narrower it touches, with one a little wider it does not:
    // bisection on whether the adaptive pair sees an impact.
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..45 {
        let middle = 0.5 * (low + high);
        let outcome = go(&beside_a_wall(middle, storeys, NEARLY_NONE), ADAPTIVE);
        if outcome.impacts.is_empty() {
            high = middle;
        } else {
            low = middle;
        }
    }
    high
}

/// The roof grazes the wall between two samples, by a part in 1e8 of its way: both
/// crossings lie within one sample, at whose ends the gap is open.
#[test]
fn a_touch_between_samples_is_found() {
    for storeys in [1, 3] {
        let reach = reach(storeys);
        let touching = go(
            &beside_a_wall(reach * (1.0 - 1e-8), storeys, NEARLY_NONE),
            event_driven(1e-10),
        );
        assert_eq!(touching.impacts.len(), 1, "{storeys} storeys");
        let impact = &touching.impacts[0];
        let sample = impact.time_closed / 0.12;
        assert!((sample - sample.round()).abs() > 1e-3, "{sample}");
        assert!(impact.time_opened.floor() / 0.12 <= sample.ceil());
        let clear = go(
            &beside_a_wall(reach * (1.0 + 1e-8), storeys, NEARLY_NONE),
            event_driven(1e-10),
        );
        assert!(clear.impacts.is_empty(), "{storeys} storeys");
    }
}

fn near(what: &str, a: f64, b: f64, relative: f64) {
    let error = (a / b - 1.0).abs();
    assert!(error < relative, "{what}: {a} {b} ({error:e})");
}

fn agree(what: &str, a: &Outcome, b: &Outcome, relative: f64) {
    let storeys = |o: &Outcome| -> Vec<StoreyPeaks> {
        o.buildings.iter().flat_map(|x| x.storeys.clone()).collect()
    };
    for (x, y) in storeys(a).iter().zip(storeys(b)) {
        near(what, x.displacement.value, y.displacement.value, relative);
        near(what, x.drift_ratio.value, y.drift_ratio.value, relative);
        near(what, x.storey_shear.value, y.storey_shear.value, relative);
        let (p, q) = (x.acceleration_absolute, y.acceleration_absolute);
        near(what, p.value, q.value, relative);
        assert!((p.time - q.time).abs() < 1e-3, "{what}: {p:?} {q:?}");
    }
    assert_eq!(a.impacts.len(), b.impacts.len(), "{what}");
    near(what, a.energy.end.input, b.energy.end.input, relative);
    near(what, a.energy.end.viscous, b.energy.end.viscous, relative);
    assert!(a.energy.residual_ratio < 1e-9, "{what}: {:?}", a.energy);
}

/// Peaks between samples, of every quantity, with modes whose periods are far shorter
/// than the step of the record; damped below and above critical, and by dashpots that
/// couple the modes.
#[test]
fn peaks_between_samples_are_found() {
    let dampings = [
        NEARLY_NONE,
        Damping::StiffnessProportional { ratio: 0.05 },
        Damping::Modal {
            ratios: vec![0.03; 6],
        },
        Damping::Dashpots {
            coefficients: vec![4.0e4, 0.0, 9.0e4, 1.0e4, 0.0, 2.0e4],
        },
    ];
    for damping in dampings {
        let label = format!("{damping:?}");
        let free = beside_a_wall(10.0, 6, damping.clone());
        agree(
            &label,
            &go(&free, event_driven(1e-10)),
            &go(&free, ADAPTIVE),
            1e-7,
        );
        let pounding = beside_a_wall(0.004, 6, damping);
        let outcome = go(&pounding, event_driven(1e-10));
        assert!(outcome.impacts.len() > 3, "{label}");
        agree(&label, &outcome, &go(&pounding, ADAPTIVE), 1e-6);
    }
}

/// Two tolerances and the adaptive pair give the same answer.
#[test]
fn tolerances_and_methods_agree() {
    let cases = reference_cases().unwrap();
    for name in ["C1", "C2", "C3a"] {
        for model in ["kv", "jank", "hertzdamp", "fricl"] {
            let ground = synthetic_motion().unwrap();
            let system = reference_system(&cases.cases[name], model, ground, 1.0).unwrap();
            let label = format!("{name} {model}");
            let loose = go(&system, event_driven(1e-9));
            agree(&label, &loose, &go(&system, event_driven(1e-11)), 1e-6);
            agree(&label, &loose, &go(&system, ADAPTIVE), 1e-6);
        }
    }
}

/// Modes far above critical damping, which forget their velocity much faster than they
/// would swing: after impacts the steps have to follow that.
#[test]
fn overdamped_modes_are_followed() {
    let dampings = [
        Damping::StiffnessProportional { ratio: 0.9 },
        Damping::Rayleigh {
            alpha: 0.1,
            beta: 0.5,
        },
        Damping::Dashpots {
            coefficients: vec![4.0e4, 0.0, 9.0e6, 1.0e4, 8.0e7, 2.0e4],
        },
    ];
    for damping in dampings {
        let label = format!("{damping:?}");
        let pounding = beside_a_wall(0.001, 6, damping);
        let outcome = go(&pounding, event_driven(1e-10));
        assert!(outcome.impacts.len() > 3, "{label}");
        agree(&label, &outcome, &go(&pounding, ADAPTIVE), 1e-6);
    }
}

/// A building let go with its floors on their way back: its maximum displacement,
/// drift and acceleration are those of time zero, and no sample comes after them.
#[test]
fn peaks_at_the_start_are_found() {
    let displacement = [0.01, 0.02, 0.03, 0.035, 0.04, 0.042];
    let free = beside_a_wall(10.0, 6, Damping::StiffnessProportional { ratio: 0.3 });
    let ground = GroundAcceleration {
        samples: vec![0.0; 2000].into(),
        time_step: 0.001,
    };
    let mut free = System::new(free.buildings().to_vec(), ground);
    free = free
        .with_initial_state(&displacement, &displacement.map(|u| -5.0 * u))
        .unwrap();
    let outcome = go(&free, event_driven(1e-10));
    agree("let go", &outcome, &go(&free, ADAPTIVE), 1e-7);
    let roof = outcome.buildings[0].storeys[5].displacement;
    assert_eq!((roof.value, roof.time), (0.042, 0.0));
}

/// A sample that is a billion seconds long costs what the run takes of it: constants and peaks of a whole one would take hours.
/// Truth is the same straight line in samples of one second.
#[test]
fn samples_end_where_the_run_does() {
    let ground = |step: f64| GroundAcceleration {
        samples: [1.0, 1.0 + 0.5 * step, 1.0 + step].to_vec().into(),
        time_step: step,
    };
    let floors = |storeys| building(storeys, Damping::StiffnessProportional { ratio: 0.05 });
    let go = |step: f64| {
        let mut system = System::new(vec![floors(1), floors(3)], ground(step));
        let names = ["a".to_owned(), "b".to_owned()];
        let level = (Floor::Storey(0, 0), Floor::Storey(1, 0), 1.0e-3, spring());
        system.add_gap("gap", names, vec![level]).unwrap();
        let options = RunOptions {
            method: event_driven(1e-10),
            duration: Some(1.0),
            energy_tolerance: None,
        };
        run(&system, &options, &mut [], &mut |_| {}).unwrap()
    };
    let (coarse, fine) = (go(1.0e9), go(1.0));
    assert!(!fine.impacts.is_empty());
    assert_eq!(coarse.impacts.len(), fine.impacts.len());
    for (a, b) in coarse.buildings.iter().zip(&fine.buildings) {
        for (a, b) in a.storeys.iter().zip(&b.storeys) {
            let off = a.displacement.value / b.displacement.value - 1.0;
            assert!(off.abs() < 1e-7, "{off:e}");
        }
    }
}
