//! Links without play between floors that set out together: their buildings begin to move
//! alike, so that only the fourth derivative or a higher one tells on which side a link acts.

use std::sync::Arc;

use pounding_gap_element::{ModelParameters, registry};
use pounding_hysteresis::LawParameters;
use pounding_shear_building::StoreyLaw;
use pounding_time_history::{
    Floor, GroundAcceleration, LinkedPair, MethodChoice, Outcome, RunOptions, System,
    TimeHistoryError, run,
};

use super::setup::{ADAPTIVE, EVENT_DRIVEN, building, difference, el_centro, law, newmark};

/// Stiffnesses (N/m) of the link.
const STIFFNESSES: [f64; 5] = [1.0e4, 2_271_661.0, 1.0e7, 1.0e9, 1.0e11];
/// Stiffnesses (N/m) of the lighter building.
const BUILDINGS: [f64; 3] = [1.15e6, 3.0e6, 9.0e6];

/// Links of this stiffness that act from the start on one side, or on both.
fn links(stiffness: f64) -> [(&'static str, LawParameters); 5] {
    let of = |name, pairs: &[(&str, f64)]| (name, LawParameters::from_pairs(pairs));
    let (gap, hook) = (
        ("compression_stiffness", stiffness),
        ("tension_stiffness", stiffness),
    );
    [
        of("gap_hook", &[gap, hook]),
        of("gap_hook", &[gap, hook, ("tension_gap", 0.003)]),
        of("gap_hook", &[gap]),
        of("gap_hook", &[hook]),
        of(
            "elastoplastic_gap",
            &[("stiffness", stiffness), ("yield_force", 1.0e5)],
        ),
    ]
}

/// Two storeys with the link between them, the heavier with a law, if any.
fn linked(stiffness: f64, stored: Option<StoreyLaw>, link: &(&str, LawParameters)) -> System {
    let light = building("light", (1, 25.0e3, stiffness), None);
    let heavy = building("heavy", (1, 1.0e5, 1.74e7), stored);
    let mut system = System::new(vec![Arc::new(light), Arc::new(heavy)], el_centro());
    let pair = LinkedPair {
        left: Floor::Storey(0, 0),
        right: Floor::Storey(1, 0),
        law: law(link.0, &link.1).law,
        yield_deformation: None,
    };
    let names = ["light".to_owned(), "heavy".to_owned()];
    system.add_link("joint", names, vec![pair]).unwrap();
    system
}

fn outcome(system: &System, method: MethodChoice) -> Result<Outcome, TimeHistoryError> {
    let options = RunOptions {
        method,
        duration: Some(4.0),
        energy_tolerance: None,
    };
    run(system, &options, &mut [], &mut |_| {})
}

/// Against the series of the event-driven method, which sees every derivative. The stiffest
/// links turn the last bits of an approach into other collisions.
#[test]
fn the_pair_finds_the_side_of_a_link_without_play() {
    let mut worst = 0.0_f64;
    for stiffness in STIFFNESSES {
        for link in links(stiffness) {
            for of_building in BUILDINGS {
                let label = format!("{link:?}, {of_building:e}");
                let system = linked(of_building, None, &link);
                let pair = outcome(&system, ADAPTIVE).map_err(|e| format!("{label}: {e}"));
                let (pair, series) = (pair.unwrap(), outcome(&system, EVENT_DRIVEN).unwrap());
                assert!(series.method.title.contains("exact"), "{label}");
                assert!(pair.energy.residual_ratio < 1.0e-9, "{label}");
                let off = difference(&pair, &series);
                let allowed = if stiffness > 1.0e7 { 1.0e-3 } else { 1.0e-9 };
                assert!(off < allowed, "{label}: {off:e}");
                worst = worst.max(off / allowed);
            }
        }
    }
    println!("worst {worst:.1e} of what is allowed");
}

/// Where a storey is curved, the event-driven method is the pair too: against the average
/// acceleration, which follows the links without looking for their ends.
#[test]
fn so_it_does_beside_a_curved_storey() {
    let curved = || {
        let yielding = [("stiffness", 1.74e7), ("yield_force", 2.0e5)];
        Some(law("bouc_wen", &LawParameters::from_pairs(&yielding)))
    };
    let mut worst = 0.0_f64;
    for stiffness in STIFFNESSES {
        for link in links(stiffness) {
            for of_building in BUILDINGS {
                let label = format!("{link:?}, {of_building:e}");
                let system = linked(of_building, curved(), &link);
                let pair = outcome(&system, EVENT_DRIVEN).map_err(|e| format!("{label}: {e}"));
                let pair = pair.unwrap();
                assert!(!pair.method.title.contains("exact"), "{label}");
                assert!(pair.energy.residual_ratio < 1.0e-9, "{label}");
                if stiffness <= 1.0e7 {
                    let off = difference(&outcome(&system, newmark(2.0e-4)).unwrap(), &pair);
                    assert!(off < 1.0e-4, "{label}: {off:e}");
                    worst = worst.max(off);
                }
            }
        }
    }
    println!("worst {worst:.1e}");
}

/// Buildings of two and three storeys at rest, struck through a gap without width, or pulled by a link that relaxes: the
/// storeys above begin with so high a derivative that round-off alone says on which side of zero they are. A law that has
/// no kink there before it yields must not ask. Against Runge-Kutta steps of 10 microseconds, which follow the law from
/// step to step and know no events of it.
#[test]
fn storeys_that_yield_are_struck_at_rest() {
    let jankowski = [("stiffness", 2.75e9), ("restitution", 0.65)];
    let mut worst = 0.0_f64;
    for name in [
        "origin_oriented",
        "peak_oriented",
        "modified_clough",
        "takeda",
        "bilinear",
    ] {
        for (storeys, speed, by_link) in [
            (2, -0.1, false),
            (2, -0.5, false),
            (3, -0.3, false),
            (2, 0.25, true),
            (2, 0.5, true),
        ] {
            let descriptor = pounding_hysteresis::find(name).unwrap();
            let mut parameters = descriptor.example_parameters();
            let given = LawParameters::from_pairs(&[("stiffness", 2.0e7), ("yield_force", 2.0e5)]);
            parameters.values.extend(given.values);
            let left = building(
                "left",
                (storeys, 2.0e5, 2.0e7),
                Some(law(name, &parameters)),
            );
            let right = building("right", (1, 3.0e5, 7.0e7), None);
            let ground = GroundAcceleration {
                samples: vec![0.0; 6].into(),
                time_step: 0.1,
            };
            let mut system = System::new(vec![Arc::new(left), Arc::new(right)], ground);
            let floors = [Floor::Storey(0, 0), Floor::Storey(1, 0)];
            let names = ["left".to_owned(), "right".to_owned()];
            if by_link {
                let parameters =
                    LawParameters::from_pairs(&[("stiffness", 2.0e7), ("damping", 1.0e6)]);
                let pair = LinkedPair {
                    left: floors[0],
                    right: floors[1],
                    law: law("maxwell", &parameters).law,
                    yield_deformation: None,
                };
                system.add_link("joint", names, vec![pair]).unwrap();
            } else {
                let model =
                    registry::build("jankowski_2005", &ModelParameters::from_pairs(&jankowski));
                let level = (floors[0], floors[1], 0.0, model.unwrap().into());
                system.add_gap("gap", names, vec![level]).unwrap();
            }
            let mut velocity = vec![0.0; storeys + 1];
            velocity[storeys] = speed;
            let system = system
                .with_initial_state(&vec![0.0; storeys + 1], &velocity)
                .unwrap();
            let run = |method| {
                let options = RunOptions {
                    method,
                    duration: Some(0.5),
                    energy_tolerance: None,
                };
                let label = format!("{name}, {storeys} storeys, {speed} m/s, link {by_link}");
                run(&system, &options, &mut [], &mut |_| {}).map_err(|e| format!("{label}: {e}"))
            };
            let truth = run(MethodChoice::RungeKutta4 { step: 1.0e-5 }).unwrap();
            for method in [EVENT_DRIVEN, ADAPTIVE] {
                let found = run(method).unwrap();
                assert_eq!(found.impacts.len(), truth.impacts.len());
                worst = worst.max(difference(&truth, &found));
            }
        }
    }
    assert!(worst < 1.0e-4, "{worst:e}");
}
