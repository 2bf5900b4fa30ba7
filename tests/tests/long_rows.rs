//! Long rows, in which some buildings touch while others move freely: the event-driven method,
//! which takes them part by part, against the adaptive pair, which always takes all buildings
//! together and has nothing in common with it but the laws.
use std::collections::BTreeMap;

use pounding_time_history::{
    Floor, GridRecorder, MethodChoice, Outcome, Recorder, RunOptions, System, run,
};
use verification::{
    ReferenceBuilding, ReferenceCase, ReferenceLink, reference_model, reference_system,
    synthetic_motion,
};

const DURATION: f64 = 8.0;
const BUILDINGS: usize = 9;

/// Buildings of three to six storeys, no two alike, with gaps about this wide (m) between them
/// and in front of a wall at the left end.
fn row(model: &str, width: f64) -> System {
    let vary = |i: usize, k: usize| (1.3 * i as f64 + 2.1 * k as f64 + width * 1.0e3).sin();
    let storeys: Vec<usize> = (0..BUILDINGS).map(|i| 3 + (i * 7 + 2) % 4).collect();
    let buildings = storeys.iter().enumerate().map(|(i, count)| {
        let storeys = 0..*count;
        ReferenceBuilding {
            name: format!("b{i}"),
            m: storeys
                .clone()
                .map(|_| 2.5e5 + 1.0e5 * vary(i, 1))
                .collect(),
            k: storeys.map(|s| 4.0e8 + 2.5e8 * vary(i, 2 + s)).collect(),
            alpha: 0.5 + 0.2 * vary(i, 3),
            beta: 0.0015,
        }
    });
    let mut first = vec![0];
    for count in &storeys {
        first.push(first[first.len() - 1] + count);
    }
    let mut links = Vec::new();
    for i in 1..BUILDINGS {
        for s in 0..storeys[i - 1].min(storeys[i]) {
            links.push(ReferenceLink {
                a: first[i - 1] + s,
                b: first[i] + s,
                gap: width * (1.0 + 0.6 * vary(i, 4)),
                k_lin: 2.0e9,
                k_hertz: 2.0e10,
                e: 0.65 + 0.2 * vary(i, 5),
            });
        }
    }
    let wall = reference_model(&links[0], model).unwrap();
    let case = ReferenceCase {
        buildings: buildings.collect(),
        links,
        models: BTreeMap::new(),
    };
    let ground = synthetic_motion().unwrap();
    let mut system = reference_system(&case, model, ground, 1.0).unwrap();
    let between = ["wall".to_owned(), "b0".to_owned()];
    let pair = (Floor::Wall, Floor::Storey(0, 2), 1.2 * width, wall);
    system.add_gap("wall-b0", between, vec![pair]).unwrap();
    system
}

fn computed(system: &System, method: MethodChoice, recorders: &mut [&mut dyn Recorder]) -> Outcome {
    let options = RunOptions {
        method,
        duration: Some(DURATION),
        energy_tolerance: Some(1.0e-9),
    };
    run(system, &options, recorders, &mut |_| {}).unwrap()
}

/// Peaks of all storeys and levels, each beside what it may be compared with.
fn peaks(outcome: &Outcome) -> Vec<(&'static str, f64)> {
    let storeys = outcome.buildings.iter().flat_map(|b| &b.storeys);
    let of_storeys = storeys.flat_map(|s| {
        [
            ("displacement", s.displacement.value),
            ("shear", s.storey_shear.value),
            ("acceleration", s.acceleration_absolute.value),
        ]
    });
    let levels = outcome.gaps.iter().flat_map(|g| &g.levels);
    let of_levels = levels.flat_map(|l| [("force", l.peak_force.value), ("impulse", l.impulse)]);
    of_storeys.chain(of_levels).collect()
}

fn counts(outcome: &Outcome) -> Vec<usize> {
    let levels = outcome.gaps.iter().flat_map(|g| &g.levels);
    levels.map(|l| l.impacts).collect()
}

fn agree(model: &str, width: f64, allowed: f64) {
    let system = row(model, width);
    let event_driven = MethodChoice::EventDriven {
        relative_tolerance: 1e-11,
    };
    let adaptive = MethodChoice::Adaptive {
        relative_tolerance: 1e-13,
    };
    let name = format!("{model}, {width} m");
    let alone = computed(&system, event_driven, &mut []);
    let mut seen = GridRecorder::new(0.0037).unwrap();
    let watched = computed(&system, event_driven, &mut [&mut seen]);
    assert_eq!(format!("{alone:?}"), format!("{watched:?}"), "{name}");

    let mut expected = GridRecorder::new(0.0037).unwrap();
    let reference = computed(&system, adaptive, &mut [&mut expected]);
    assert_eq!(counts(&alone), counts(&reference), "{name}: impacts");
    let impacts: usize = counts(&alone).iter().sum();
    assert!(impacts > 50, "{name}: {impacts} impacts");
    let (ours, theirs) = (peaks(&alone), peaks(&reference));
    for ((what, a), (_, b)) in ours.iter().zip(&theirs) {
        let same = theirs.iter().filter(|(other, _)| other == what);
        let largest = same.fold(0.0_f64, |m, (_, x)| m.max(x.abs()));
        assert!((a - b).abs() < allowed * largest, "{name}: {what} {a} {b}");
    }
    let (seen, expected) = (seen.responses, expected.responses);
    let motions = seen.displacement.iter().zip(&expected.displacement);
    let off = motions.fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()));
    assert!(off < 1e-8, "{name}: displacements by {off:e}");
    let largest = reference.energy.largest_input;
    for energy in &seen.energy {
        let residual = energy.residual.abs() / largest;
        assert!(residual < 1e-9, "{name}: residual {residual:e}");
    }
}

#[test]
fn affine_contacts() {
    agree("kv", 0.02, 1e-8);
    agree("kv", 0.004, 1e-8);
}

#[test]
fn contacts_in_powers() {
    agree("jank", 0.02, 1e-7);
    agree("jank", 0.004, 1e-7);
}

#[test]
fn contacts_that_end_with_their_force() {
    agree("kv_cut", 0.008, 1e-8);
}

#[test]
fn contacts_that_may_stick() {
    agree("frich", 0.02, 1e-7);
}
