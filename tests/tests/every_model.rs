//! Every registered model inside the driver.
//!
//! A body pressed to a wall: the driver against the two-body integration of
//! `gap-element`, which shares the law with it but no line of stepping. Then the
//! reference buildings C2 and C3a with every model and every separation rule.
use std::sync::Arc;

use pounding_gap_element::{
    Bodies, CollisionOptions, ImpactModel, ModelDescriptor, ModelParameters, SeparationRule,
    collide_with, registry,
};
use pounding_time_history::{
    DEFAULT_RELATIVE_TOLERANCE, Floor, GroundAcceleration, MethodChoice, Outcome, RunOptions,
    System, run,
};
use verification::{
    constant_ground, reference_cases, reference_system_with, single_storey, synthetic_motion,
};

/// Mass of the body (kg), gravity (m/s2) and fall to the wall (m).
const MASS: f64 = 2.0e4;
const GRAVITY: f64 = 9.81;
const GAP: f64 = 0.02;

/// Every registered model under each of its separation rules.
fn all_laws(restitution: f64) -> impl Iterator<Item = (String, Arc<dyn ImpactModel>)> {
    registry::descriptors().iter().flat_map(move |d| {
        d.separation_rules.iter().map(move |rule| {
            (
                format!("{} {}", d.name, rule.name()),
                law(d, restitution, *rule),
            )
        })
    })
}

fn law(d: &ModelDescriptor, restitution: f64, rule: SeparationRule) -> Arc<dyn ImpactModel> {
    let parameters: ModelParameters = d.example_parameters(restitution).with_separation(rule);
    registry::build(d.name, &parameters).unwrap().into()
}

fn go(system: &System, method: MethodChoice) -> Result<Outcome, String> {
    let options = RunOptions {
        method,
        ..RunOptions::default()
    };
    run(system, &options, &mut [], &mut |_| {}).map_err(|e| e.to_string())
}

const ADAPTIVE: MethodChoice = MethodChoice::Adaptive {
    relative_tolerance: DEFAULT_RELATIVE_TOLERANCE,
};

/// A body as good as without storey stiffness, pressed to a wall.
fn body(law: Arc<dyn ImpactModel>, ground: GroundAcceleration) -> System {
    let mut system = System::new(vec![single_storey("body", MASS, 1.0e-9)], ground);
    let names = ["body".to_owned(), "wall".to_owned()];
    let pair = (Floor::Storey(0, 0), Floor::Wall, GAP, law);
    system.add_gap("gap", names, vec![pair]).unwrap();
    system
}

#[test]
fn one_impact_equals_the_collision_of_two_bodies() {
    for (method, bound) in [(ADAPTIVE, 1e-8), (RunOptions::default().method, 1e-6)] {
        one_impact(method, bound);
    }
}

fn one_impact(method: MethodChoice, bound: f64) {
    let mut failures = Vec::new();
    let mut compared = 0;
    for (name, law) in all_laws(0.6) {
        let approach = (2.0 * GRAVITY * GAP).sqrt();
        let bodies = Bodies {
            mass_left: MASS,
            mass_right: None,
            velocity_left: approach,
            velocity_right: 0.0,
        };
        let options = CollisionOptions {
            pressing_acceleration: GRAVITY,
            read_at: None,
        };
        let two = collide_with(law.as_ref(), &bodies, &options).unwrap();
        let duration = approach / GRAVITY + two.duration.max(1e-3) + 0.2;
        let outcome = match go(&body(law, constant_ground(-GRAVITY, duration)), method) {
            Ok(outcome) => outcome,
            Err(error) => {
                failures.push(format!("{name}: {error}"));
                continue;
            }
        };
        let one = &outcome.impacts[0];
        if two.stays_in_contact {
            assert!(one.time_opened.is_nan(), "{name}: it should stay");
            continue;
        }
        let mut check = |what: &str, driver: f64, other: f64| {
            let error = (driver / other - 1.0).abs();
            compared += 1;
            if !(error < bound) {
                failures.push(format!("{name}: {what} {driver:e} {other:e} ({error:.1e})"));
            }
        };
        check("approach", one.approach_velocity, approach);
        check("restitution", one.achieved_restitution, two.restitution);
        check("impulse", one.impulse, two.impulse);
        if two.peak_force.is_finite() {
            check("force", one.peak_force.value, two.peak_force);
            check(
                "penetration",
                one.peak_penetration.value,
                two.peak_penetration,
            );
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
    assert!(compared > 150, "{compared}");
}

#[test]
fn every_model_closes_the_ledger_on_the_reference_buildings() {
    let cases = reference_cases().unwrap();
    let mut failures = Vec::new();
    let mut runs = 0;
    for name in ["C2", "C3a"] {
        let case = &cases.cases[name];
        let default = RunOptions::default().method;
        let laws = all_laws(0.65).map(|law| (ADAPTIVE, law));
        let laws = laws.chain(all_laws(0.65).map(|law| (default, law)));
        for (method, (label, law)) in laws {
            let ground = synthetic_motion().unwrap();
            let system = reference_system_with(case, &|_| Ok(Arc::clone(&law)), ground, 1.0);
            runs += 1;
            match go(&system.unwrap(), method) {
                Err(error) => failures.push(format!("{name} {label}: {error}")),
                Ok(outcome) => {
                    let residual = outcome.energy.residual_ratio;
                    let lost = outcome.energy.end.impact;
                    let finite = outcome.final_displacement.iter().all(|u| u.is_finite());
                    if !(residual < 1e-8 && finite && !outcome.impacts.is_empty()) {
                        failures.push(format!("{name} {label}: residual {residual:e}"));
                    }
                    if lost < -1e-8 * outcome.energy.largest_input {
                        failures.push(format!("{name} {label}: impacts give {lost} J"));
                    }
                }
            }
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
    assert!(runs > 160, "{runs}");
}

/// Friction of 1 and above in the contact: floors that are held together, and part where the rest of
/// the building pulls harder. The event-driven method against the adaptive pair.
#[test]
fn plastic_friction_by_two_methods() {
    let cases = reference_cases().unwrap();
    for (friction, exponent, stiffness) in [
        (1.0, 1.0, 9.35e7),
        (1.0, 1.5, 2.75e9),
        (1.5, 1.0, 9.35e7),
        (3.0, 1.5, 2.75e9),
    ] {
        let pairs = [
            ("stiffness", stiffness),
            ("friction", friction),
            ("exponent", exponent),
        ];
        let law = registry::build("borovin_2014", &ModelParameters::from_pairs(&pairs)).unwrap();
        let law: Arc<dyn ImpactModel> = law.into();
        let by = |method| {
            let ground = synthetic_motion().unwrap();
            let case = &cases.cases["C2"];
            let system = reference_system_with(case, &|_| Ok(Arc::clone(&law)), ground, 1.0);
            go(&system.unwrap(), method).unwrap()
        };
        let (ours, pair) = (by(RunOptions::default().method), by(ADAPTIVE));
        let what = format!("D = {friction}, n = {exponent}");
        assert!(ours.energy.residual_ratio < 1e-8, "{what}");
        let levels = ours.gaps[0].levels.iter().zip(&pair.gaps[0].levels);
        for (a, b) in levels {
            assert_eq!((a.impacts, a.sticks), (b.impacts, b.sticks), "{what}");
            let (a, b) = (a.peak_force.value, b.peak_force.value);
            assert!((a - b).abs() <= 1e-6 * b, "{what}: {a} {b}");
        }
        assert!(ours.gaps[0].levels.iter().any(|l| l.sticks > 0), "{what}");
    }
}
