//! Tall buildings, whose floors are worked out at the ends of blocks of samples alone: the
//! event-driven method against the adaptive pair, which integrates all floors in steps of its own
//! and has nothing in common with it but the laws.
use std::collections::BTreeMap;

use pounding_time_history::{
    GridRecorder, MethodChoice, Outcome, Recorder, RunOptions, System, run,
};
use verification::{
    ReferenceBuilding, ReferenceCase, ReferenceLink, reference_system, synthetic_motion,
};

const DURATION: f64 = 9.0;

/// Damping in parts of the stiffness (s): of the fastest modes 4 % of critical, and 20 times
/// critical.
const SLIGHT: f64 = 0.001;
const BEYOND_CRITICAL: f64 = 0.5;

/// Two towers of these storeys, all of them different.
fn towers(storeys: [usize; 2], gap: f64, beta: f64) -> System {
    let vary = |i: usize, k: usize| (1.7 * i as f64 + 2.3 * k as f64).sin();
    let buildings = storeys
        .iter()
        .enumerate()
        .map(|(b, count)| ReferenceBuilding {
            name: format!("b{b}"),
            m: (0..*count)
                .map(|i| 3.0e5 * (1.0 + 0.2 * vary(i, b)))
                .collect(),
            k: (0..*count)
                .map(|i| 5.0e8 * (1.0 - 0.3 * b as f64) * (1.0 + 0.3 * vary(i, b + 5)))
                .collect(),
            alpha: 0.3,
            beta,
        });
    let links = (0..storeys[0].min(storeys[1])).map(|i| ReferenceLink {
        a: i,
        b: storeys[0] + i,
        gap,
        k_lin: 2.0e9,
        k_hertz: 2.0e10,
        e: 0.65,
    });
    let case = ReferenceCase {
        buildings: buildings.collect(),
        links: links.collect(),
        models: BTreeMap::new(),
    };
    reference_system(&case, "kv", synthetic_motion().unwrap(), 1.0).unwrap()
}

fn computed(system: &System, method: MethodChoice, recorders: &mut [&mut dyn Recorder]) -> Outcome {
    let options = RunOptions {
        method,
        duration: Some(DURATION),
        energy_tolerance: Some(1.0e-9),
    };
    run(system, &options, recorders, &mut |_| {}).unwrap()
}

/// Peaks of all storeys.
fn peaks(outcome: &Outcome) -> Vec<(&'static str, f64)> {
    let storeys = outcome.buildings.iter().flat_map(|b| &b.storeys);
    let of_storeys = storeys.flat_map(|s| {
        [
            ("displacement", s.displacement.value),
            ("shear", s.storey_shear.value),
            ("drift ratio", s.drift_ratio.value),
            ("acceleration", s.acceleration_absolute.value),
        ]
    });
    of_storeys.collect()
}

fn impacts(outcome: &Outcome) -> Vec<usize> {
    let levels = outcome.gaps.iter().flat_map(|g| &g.levels);
    levels.map(|l| l.impacts).collect()
}

/// Every peak within this part of itself.
fn agree(storeys: [usize; 2], (gap, beta): (f64, f64), allowed: f64) -> usize {
    let system = towers(storeys, gap, beta);
    let event_driven = MethodChoice::EventDriven {
        relative_tolerance: 1e-11,
    };
    let adaptive = MethodChoice::Adaptive {
        relative_tolerance: 1e-12,
    };
    let name = format!("{storeys:?}, {gap} m, {beta} s");
    let ours = computed(&system, event_driven, &mut []);
    let mut seen = GridRecorder::new(0.0171).unwrap();
    let watched = computed(&system, event_driven, &mut [&mut seen]);
    assert_eq!(format!("{ours:?}"), format!("{watched:?}"), "{name}");
    let theirs = computed(&system, adaptive, &mut []);
    assert_eq!(impacts(&ours), impacts(&theirs), "{name}: impacts");
    for ((what, a), (_, b)) in peaks(&ours).iter().zip(peaks(&theirs)) {
        assert!((a - b).abs() < allowed * b, "{name}: {what} {a} {b}");
    }
    impacts(&ours).iter().sum()
}

#[test]
fn towers_that_never_touch() {
    assert_eq!(agree([63, 41], (1.0e3, SLIGHT), 1e-8), 0);
}

#[test]
fn towers_that_touch() {
    assert!(agree([30, 45], (0.05, SLIGHT), 1e-7) > 5);
}

/// The upper modes die out within a part of a sample.
#[test]
fn towers_damped_beyond_critical() {
    assert_eq!(agree([63, 41], (1.0e3, BEYOND_CRITICAL), 1e-8), 0);
    assert!(agree([30, 45], (0.01, BEYOND_CRITICAL), 1e-7) > 0);
}
