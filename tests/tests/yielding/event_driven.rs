//! Storeys and links on straight branches, and contacts between them, by the event-driven
//! method: series to round-off from event to event, against the explicit pair at a
//! tolerance of 1e-12, which locates the same events and has nothing else in common with
//! them.

use std::sync::Arc;

use pounding_gap_element::{ImpactModel, ModelParameters, registry};
use pounding_hysteresis::LawParameters;
use pounding_shear_building::{Damping, ShearBuilding};
use pounding_time_history::{Floor, GridRecorder, Outcome, Recorder, RunOptions, System, run};

use super::setup::{
    EVENT_DRIVEN, TIGHT, building, difference, el_centro, go, law, with_gaps, with_gaps_of,
    with_links, yielding_pair,
};

const DURATION: f64 = 12.0;

/// Compares the two methods; returns the outcome of the event-driven one.
fn agree(label: &str, system: &System, tolerance: f64) -> Outcome {
    let exact = go(system, EVENT_DRIVEN, DURATION);
    let tight = go(system, TIGHT, DURATION);
    let worst = difference(&exact, &tight);
    println!(
        "{label}: peaks {worst:.1e}, residual {:.1e}, {} impacts, {:?} (pair: {:?})",
        exact.energy.residual_ratio,
        exact.impacts.len(),
        exact.statistics,
        tight.statistics,
    );
    assert!(worst < tolerance, "{label}: {worst}");
    assert!(exact.energy.residual_ratio < 1.0e-10, "{label}");
    assert_eq!(exact.impacts.len(), tight.impacts.len(), "{label}");
    for (a, b) in exact.impacts.iter().zip(&tight.impacts) {
        assert_eq!((a.gap, a.level), (b.gap, b.level), "{label}");
        assert!((a.time_closed - b.time_closed).abs() < 1.0e-8, "{label}");
        let force = a.peak_force.value / b.peak_force.value - 1.0;
        assert!(force.abs() < 1.0e3 * tolerance, "{label}: {force}");
    }
    for (a, b) in exact.buildings.iter().zip(&tight.buildings) {
        for (a, b) in a.yielding.iter().flatten().zip(b.yielding.iter().flatten()) {
            let energy = (a.hysteretic_energy - b.hysteretic_energy).abs();
            assert!(energy < tolerance * exact.energy.largest_input, "{label}");
            let drift = (a.residual_drift_ratio - b.residual_drift_ratio).abs();
            assert!(drift < tolerance, "{label}: {drift}");
        }
    }
    exact
}

#[test]
fn yielding_pair_with_gaps_of_every_straight_law() {
    for name in [
        "elastic_perfectly_plastic",
        "bilinear",
        "modified_clough",
        "peak_oriented",
        "takeda",
        "origin_oriented",
    ] {
        let system = with_gaps(yielding_pair(name, el_centro()));
        let outcome = agree(name, &system, 1.0e-9);
        assert!(outcome.impacts.len() > 3, "{name}");
        assert!(outcome.method.title.contains("exact"), "{name}");
        let yielded = outcome.buildings[0].yielding[0].unwrap();
        assert!(yielded.hysteretic_energy > 1.0, "{name}");
    }
}

/// What recorders read between the ends of steps closes the ledger as these do.
#[test]
fn ledger_closes_at_every_output_time() {
    let damper = LawParameters::from_pairs(&[("damping", 2.0e5), ("exponent", 1.0)]);
    let slider = LawParameters::from_pairs(&[("stiffness", 4.0e6), ("yield_force", 2.0e4)]);
    let pair = || yielding_pair("bilinear", el_centro());
    let soft = {
        let parameters = LawParameters::from_pairs(&[("stiffness", 1.0e6), ("yield_force", 3.0e4)]);
        let law = law("elastic_perfectly_plastic", &parameters);
        let soft = building("soft", (1, 25.0e3, 1.0e6), Some(law));
        System::new(vec![Arc::new(soft)], el_centro())
    };
    for (name, system) in [
        ("one soft storey", soft),
        ("pair", with_gaps(pair())),
        (
            "dampers",
            with_links(with_gaps(pair()), "viscous_damper", &damper),
        ),
        (
            "sliders",
            with_links(with_gaps(pair()), "elastic_perfectly_plastic", &slider),
        ),
    ] {
        let mut recorder = GridRecorder::new(1.0e-3).unwrap();
        let options = RunOptions {
            method: EVENT_DRIVEN,
            duration: Some(DURATION),
            energy_tolerance: None,
        };
        let recorders: &mut [&mut dyn Recorder] = &mut [&mut recorder];
        let outcome = run(&system, &options, recorders, &mut |_| {}).unwrap();
        let history = recorder.responses;
        assert_eq!(history.len(), 12_001, "{name}");
        let residuals = history.energy.iter().map(|e| e.residual.abs());
        let worst = residuals.fold(0.0, f64::max) / outcome.energy.largest_input;
        println!("{name}: worst residual of an output time {worst:.1e}");
        assert!(worst < 1.0e-9, "{name}: {worst:e}");
    }
}

#[test]
fn linked_pair_by_springs_dampers_and_sliders() {
    let damper = LawParameters::from_pairs(&[("damping", 2.0e5), ("exponent", 1.0)]);
    let slider = LawParameters::from_pairs(&[("stiffness", 4.0e6), ("yield_force", 2.0e4)]);
    let spring = LawParameters::from_pairs(&[("stiffness", 3.0e6)]);
    for (name, parameters) in [
        ("viscous_damper", damper),
        ("elastic_perfectly_plastic", slider),
        ("linear", spring),
    ] {
        let pair = with_gaps(yielding_pair("bilinear", el_centro()));
        let outcome = agree(name, &with_links(pair, name, &parameters), 1.0e-9);
        assert!(outcome.method.title.contains("exact"), "{name}");
    }
}

/// Contacts in powers of the penetration take the pair while they last, the rest is exact.
#[test]
fn yielding_pair_with_contacts_of_a_power_law() {
    let pair = yielding_pair("elastic_perfectly_plastic", el_centro());
    let parameters = [("stiffness", 2.75e9), ("restitution", 0.65)];
    let system = with_gaps_of(pair, "jankowski_2005", &parameters);
    let outcome = agree("jankowski_2005", &system, 1.0e-8);
    assert!(outcome.impacts.len() > 3);
}

/// Displacement of the base slab and floors (m), drifts of the three storeys (m) and
/// absolute accelerations (m/s2): peaks, by two codes written apart from this program and
/// from each other, a Taylor series in relative coordinates and a
/// Gragg-Bulirsch-Stoer extrapolation in absolute ones, which agree to 1e-14.
const DISPLACEMENTS: [f64; 4] = [
    0.090_411_664_578_085_94,
    0.098_646_738_103_563_86,
    0.107_127_630_638_766_8,
    0.113_545_907_721_545_23,
];
const DRIFTS: [f64; 3] = [
    0.008_309_845_912_989_59,
    0.008_601_002_733_783_052,
    0.006_930_179_413_078_12,
];
const ACCELERATIONS: [f64; 4] = [
    9.275_592_197_520_156,
    7.316_558_736_659_868,
    7.405_435_767_271_178,
    10.430_162_048_778_937,
];
/// Impacts: wall (0 on the right), time of closure (s), approach velocity (m/s), peak force
/// (N), time of opening (s), impulse (N s).
const IMPACTS: [(usize, [f64; 5]); 4] = [
    (
        1,
        [
            2.687_629_001_073_143_6,
            0.200_341_791_163_450_02,
            1_476_897.371_541_878_4,
            2.907_915_022_515_337_6,
            222_654.591_604_378_57,
        ],
    ),
    (
        0,
        [
            4.338_653_324_338_361,
            0.268_721_959_134_476_66,
            1_485_538.700_681_071,
            4.493_898_994_794_399_5,
            129_404.289_787_585_63,
        ],
    ),
    (
        1,
        [
            5.250_272_118_933_871,
            0.234_229_063_837_642_03,
            2_041_537.158_324_545,
            5.480_104_569_026_667,
            343_278.002_360_764_13,
        ],
    ),
    (
        0,
        [
            5.875_065_034_748_972,
            0.383_016_736_399_180_4,
            2_629_163.224_543_812_7,
            6.092_733_600_182_196,
            411_568.025_929_199,
        ],
    ),
];
/// Energies at 25 s (J): input, damping, isolator, impacts.
const ENERGIES: [f64; 4] = [
    642_228.148_324_979_9,
    96_286.860_516_435_04,
    514_408.455_479_311_4,
    24_505.702_743_395_563,
];

/// A building on a bilinear isolator between two walls, 1.5 times El Centro.
#[test]
fn isolated_building_between_walls() {
    let stiffness = vec![50.53e6, 4.0e8, 3.5e8, 3.0e8];
    let isolator = LawParameters::from_pairs(&[
        ("stiffness", stiffness[0]),
        ("yield_force", 471.0e3),
        ("hardening_ratio", 0.1),
    ]);
    let building = ShearBuilding::new(
        "isolated".to_owned(),
        vec![2.0e5; 4],
        stiffness,
        vec![3.0; 4],
        Damping::Dashpots {
            coefficients: vec![2.0e5, 1.2e6, 1.0e6, 8.0e5],
        },
    )
    .unwrap()
    .with_laws(vec![Some(law("bilinear", &isolator)), None, None, None])
    .unwrap();
    let mut ground = el_centro();
    ground.samples = Arc::new(ground.samples.iter().map(|a| 1.5 * a).collect());
    let mut system = System::new(vec![Arc::new(building)], ground);
    let parameters = ModelParameters::from_pairs(&[("stiffness", 2.5e8), ("restitution", 0.5)]);
    let model: Arc<dyn ImpactModel> = registry::build("anagnostopoulos_2004", &parameters)
        .unwrap()
        .into();
    for (gap, left, right, width) in [
        ("right", Floor::Storey(0, 0), Floor::Wall, 0.08),
        ("left", Floor::Wall, Floor::Storey(0, 0), 0.07),
    ] {
        let pair = vec![(left, right, width, Arc::clone(&model))];
        let names = ["one".to_owned(), "other".to_owned()];
        system.add_gap(gap, names, pair).unwrap();
    }
    let outcome = go(&system, EVENT_DRIVEN, 25.0);
    let mut worst = 0.0_f64;
    let mut near = |name: &str, value: f64, expected: f64| {
        let error = (value / expected - 1.0).abs();
        worst = worst.max(error);
        assert!(error < 1.0e-9, "{name}: {value}, not {expected}: {error:e}");
    };
    let storeys = &outcome.buildings[0].storeys;
    for (i, storey) in storeys.iter().enumerate() {
        near("displacement", storey.displacement.value, DISPLACEMENTS[i]);
        let acceleration = storey.acceleration_absolute.value;
        near("acceleration", acceleration, ACCELERATIONS[i]);
    }
    for (storey, drift) in storeys[1..].iter().zip(DRIFTS) {
        near("drift", 3.0 * storey.drift_ratio.value, drift);
    }
    assert_eq!(outcome.impacts.len(), IMPACTS.len());
    for (impact, (wall, expected)) in outcome.impacts.iter().zip(IMPACTS) {
        assert_eq!(impact.gap, wall);
        let [closed, approach, force, opened, impulse] = expected;
        near("closure", impact.time_closed, closed);
        near("approach velocity", impact.approach_velocity, approach);
        near("force", impact.peak_force.value, force);
        near("opening", impact.time_opened, opened);
        near("impulse", impact.impulse, impulse);
    }
    let end = outcome.energy.end;
    let energies = [end.input, end.viscous, end.hysteretic, end.impact];
    for (energy, expected) in energies.into_iter().zip(ENERGIES) {
        near("energy", energy, expected);
    }
    println!(
        "isolated building: worst {worst:.1e}, residual {:.1e}, {:?}",
        outcome.energy.residual_ratio, outcome.statistics
    );
    assert!(outcome.energy.residual_ratio < 1.0e-12);
}
