//! Moreau-Jean time stepping against Newton's law by hand, and against located impacts,
//! to which it converges in first order.
#![allow(clippy::print_stdout)]

use std::sync::Arc;

use pounding_time_history::{Floor, GridRecorder, MethodChoice, Outcome, RunOptions, System, run};
use verification::{
    constant_ground, free_bodies, reference_cases, reference_system, reference_system_with, rigid,
    single_storey, synthetic_motion,
};

fn go(system: &System, step: f64, duration: f64) -> Outcome {
    let options = RunOptions {
        method: MethodChoice::MoreauJean { step, theta: 0.5 },
        duration: Some(duration),
        energy_tolerance: None,
    };
    run(system, &options, &mut [], &mut |_| {}).unwrap()
}

#[test]
fn newtons_law_for_two_bodies_and_for_a_chain() {
    let system = free_bodies(&[1.0, 2.0], &[0.3], 0.6, constant_ground(0.0, 1.0));
    let system = system
        .with_initial_state(&[0.0, 0.0], &[1.0, -0.5])
        .unwrap();
    let outcome = go(&system, 1.0e-3, 0.5);
    let [a, b] = outcome.final_velocity[..] else {
        panic!("two bodies");
    };
    assert!(
        (a + 0.6).abs() < 1e-12 && (b - 0.3).abs() < 1e-12,
        "{a} {b}"
    );
    let impact = &outcome.impacts[0];
    assert_eq!(outcome.impacts.len(), 1);
    assert!((impact.impulse - 1.6).abs() < 1e-12);
    assert!((impact.approach_velocity - 1.5).abs() < 1e-12);
    assert!((impact.achieved_restitution - 0.6).abs() < 1e-12);
    assert!((impact.energy_dissipated - 0.48).abs() < 1e-12);
    assert!((impact.time_closed - 0.2).abs() <= 1.001e-3);
    assert!(outcome.energy.residual_ratio < 1e-13);

    let ground = constant_ground(0.0, 1.0);
    let chain = free_bodies(&[1.0; 3], &[0.25, 0.0], 1.0, ground)
        .with_initial_state(&[0.0; 3], &[1.0, 0.0, 0.0])
        .unwrap();
    let third = 1.0 / 3.0;
    let outcome = go(&chain, 1.0e-3, 1.0);
    for (v, expected) in outcome
        .final_velocity
        .iter()
        .zip([-third, 2.0 * third, 2.0 * third])
    {
        assert!((v - expected).abs() < 1e-12, "{:?}", outcome.final_velocity);
    }
}

/// What an impact takes does not depend on theta: 0.75 - 0.27 J.
#[test]
fn the_loss_is_newtons_for_every_theta() {
    for theta in [0.5, 0.7, 1.0] {
        let system = free_bodies(&[1.0, 2.0], &[0.3], 0.6, constant_ground(0.0, 1.0))
            .with_initial_state(&[0.0, 0.0], &[1.0, -0.5])
            .unwrap();
        let options = RunOptions {
            method: MethodChoice::MoreauJean { step: 1e-3, theta },
            duration: Some(0.5),
            energy_tolerance: None,
        };
        let outcome = run(&system, &options, &mut [], &mut |_| {}).unwrap();
        let loss = outcome.impacts[0].energy_dissipated;
        assert!((loss - 0.48).abs() < 1e-12, "theta {theta}: {loss}");
        assert!(outcome.energy.residual_ratio < 1e-10);
    }
}

/// Impacts that accumulate come to rest in finitely many steps, and the contact holds
/// the weight.
#[test]
fn a_ball_comes_to_rest() {
    let ground = constant_ground(-9.81, 6.0);
    let system = free_bodies(&[2.0], &[1.0], 0.5, ground);
    let outcome = go(&system, 1.0e-3, 6.0);
    assert!(outcome.final_velocity[0].abs() < 1e-9);
    assert!((outcome.final_displacement[0] - 1.0).abs() < 0.02);
    let last = outcome.impacts.last().unwrap();
    assert!(last.time_opened.is_nan());
    let level = &outcome.gaps[0].levels[0];
    assert_eq!(level.sticks, 1);
    assert!((last.impulse - 2.0 * 9.81 * (6.0 - last.time_closed)).abs() < 0.5);
    assert!(outcome.energy.residual_ratio < 1e-12);
    // What holds it is its weight, not the momentum of its last bounces.
    for step in [1.0e-3, 3.0e-4, 1.0e-4] {
        let outcome = go(&system, step, 6.0);
        let held = outcome.impacts.last().unwrap().peak_force.value;
        assert!((held / (2.0 * 9.81) - 1.0).abs() < 1e-9, "{step}: {held}");
    }
}

/// A ball that falls upon one that lies on the ground: its shocks go through the contact below, whose force is the weight of
/// both in the end, whatever the step. Divided by the step they would be some hundred weights, and more for shorter ones.
#[test]
fn shocks_through_floors_that_are_held_are_no_forces() {
    let ground = constant_ground(-9.81, 8.0);
    let system = free_bodies(&[1.0, 2.0], &[1.0, 0.0], 0.5, ground);
    for step in [1.0e-3, 3.0e-4, 1.0e-4] {
        let outcome = go(&system, step, 8.0);
        assert!(outcome.gaps[0].levels[0].impacts > 3);
        let held = outcome.gaps[1].levels[0].peak_force.value;
        // The last bounces, with shocks of less than a thousandth of the impulse by the mass of the pair, count whole.
        assert!((held / (3.0 * 9.81) - 1.0).abs() < 2e-3, "{step}: {held}");
    }
}

/// First order on case C1, and the ledger closes to round-off with theta 1/2.
#[test]
fn converges_to_the_located_impacts_in_first_order() {
    let cases = reference_cases().unwrap();
    let case = &cases.cases["C1"];
    let law = rigid(0.65);
    let ground = synthetic_motion().unwrap();
    let system = reference_system_with(case, &|_| Ok(Arc::clone(&law)), ground, 1.0).unwrap();
    let options = RunOptions {
        duration: Some(12.0),
        ..RunOptions::default()
    };
    let located = run(&system, &options, &mut [], &mut |_| {}).unwrap();
    let peak = |o: &Outcome| o.buildings[0].storeys[0].displacement.value;
    // The place of an impact inside its step is as good as random: the mean error over
    // neighbouring steps falls like the step. All divide the record's 5 ms.
    let mean_error = |refinement: u32| {
        let errors = (5..=16).map(|parts| {
            let step = 5.0e-3 / f64::from(parts * refinement);
            let outcome = go(&system, step, 12.0);
            assert!(outcome.energy.residual_ratio < 1e-11);
            let ends = outcome.final_displacement.iter();
            let squares: f64 = ends
                .zip(&located.final_displacement)
                .map(|(a, b)| (a - b) * (a - b))
                .sum();
            squares.sqrt() / peak(&located)
        });
        errors.sum::<f64>() / 12.0
    };
    let errors = [1, 4, 16].map(mean_error);
    let order = (errors[0] / errors[2]).ln() / 16.0_f64.ln();
    println!("order {order}, errors {errors:?}");
    assert!((order - 1.0).abs() < 0.25, "{order}: {errors:?}");
}

/// Floors that stay together where no restitution parts them: forces that hold them, recorded ones
/// too, converge to those of located contacts, and are zero where the gap is open.
#[test]
fn floors_that_stay_together() {
    let cases = reference_cases().unwrap();
    let law = rigid(0.0);
    let ground = synthetic_motion().unwrap();
    for name in ["C1", "C2"] {
        let case = &cases.cases[name];
        let system =
            reference_system_with(case, &|_| Ok(Arc::clone(&law)), ground.clone(), 1.0).unwrap();
        let recorded = |method: MethodChoice| {
            let options = RunOptions {
                method,
                duration: Some(12.0),
                energy_tolerance: None,
            };
            let mut recorder = GridRecorder::new(0.01).unwrap();
            let outcome = run(&system, &options, &mut [&mut recorder], &mut |_| {}).unwrap();
            (outcome, recorder)
        };
        let (located, exact) = recorded(MethodChoice::EventDriven {
            relative_tolerance: 1e-11,
        });
        let exact = exact.responses;
        let sticks = |o: &Outcome| o.gaps[0].levels.iter().map(|l| l.sticks).sum::<usize>();
        assert!(sticks(&located) > 5, "{name}: {}", sticks(&located));
        let errors = [5.0e-5, 5.0e-6].map(|step| {
            let (outcome, rows) = recorded(MethodChoice::MoreauJean { step, theta: 0.5 });
            let rows = rows.responses;
            let apart = |a: &[f64], b: &[f64]| {
                let pairs = a.iter().zip(b);
                let largest = b.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
                pairs.fold(0.0_f64, |m, (a, b)| m.max((a - b).abs())) / largest
            };
            // A force of a gap that is open would be one that pulls or holds floors apart.
            let pulls = rows.force.iter().fold(0.0_f64, |m, force| m.min(*force));
            let held = rows.force.iter().zip(&rows.penetration);
            let open = held.filter(|(_, gap)| **gap < -1.0e-4);
            let across = open.fold(0.0_f64, |m, (force, _)| m.max(force.abs()));
            assert!(across == 0.0 && pulls >= 0.0, "{name}: {across} {pulls}");
            let error = apart(&rows.displacement, &exact.displacement);
            println!(
                "{name} {step}: {error:e}, {} times together, {}",
                sticks(&outcome),
                sticks(&located)
            );
            error
        });
        assert!(
            errors[1] < 1e-3 && errors[1] < 0.3 * errors[0],
            "{name}: {errors:?}"
        );
    }
}

/// A wall and two floors that touch, whose impacts come in groups of steps: forces that are recorded stand inside impacts,
/// and push; so do their peaks.
#[test]
fn recorded_forces_stand_inside_impacts() {
    let ground = synthetic_motion().unwrap();
    let bodies = [("a", 5.0e4, 2.0e7), ("b", 9.0e4, 6.0e7)];
    let bodies = bodies.map(|(name, mass, stiffness)| single_storey(name, mass, stiffness));
    let mut system = System::new(bodies.to_vec(), ground);
    for (name, sides, left, right) in [
        ("wall-a", ["wall", "a"], Floor::Wall, Floor::Storey(0, 0)),
        ("a-b", ["a", "b"], Floor::Storey(0, 0), Floor::Storey(1, 0)),
    ] {
        let pair = (left, right, 0.0, rigid(0.5));
        let sides = sides.map(str::to_owned);
        system.add_gap(name, sides, vec![pair]).unwrap();
    }
    let options = RunOptions {
        method: MethodChoice::MoreauJean {
            step: 2.0e-4,
            theta: 0.5,
        },
        duration: Some(10.0),
        energy_tolerance: None,
    };
    let mut recorder = GridRecorder::new(1.0e-4).unwrap();
    let outcome = run(&system, &options, &mut [&mut recorder], &mut |_| {}).unwrap();
    let rows = recorder.responses;
    assert!(outcome.impacts.len() > 50, "{}", outcome.impacts.len());
    for impact in &outcome.impacts {
        let time = impact.peak_force.time;
        let open = impact.time_opened;
        assert!(time >= impact.time_closed && !(time > open), "{impact:?}");
    }
    let mut pushing = 0;
    for (forces, time) in rows.force.chunks_exact(2).zip(&rows.time) {
        for (gap, force) in forces.iter().enumerate() {
            assert!(*force >= 0.0, "{force} N at {time} s");
            if *force == 0.0 {
                continue;
            }
            pushing += 1;
            // Rows at the ends of an impact have them but for round-off.
            let inside = (outcome.impacts.iter()).any(|i| {
                let closed = i.time_closed <= *time + 1e-9;
                i.gap == gap && closed && !(i.time_opened < *time - 1e-9)
            });
            assert!(inside, "{force} N at {time} s in gap {gap}");
        }
    }
    assert!(pushing > 1000, "{pushing}");
}

#[test]
fn compliant_laws_are_refused() {
    let cases = reference_cases().unwrap();
    let ground = synthetic_motion().unwrap();
    let system = reference_system(&cases.cases["C1"], "kv", ground, 1.0).unwrap();
    let options = RunOptions {
        method: MethodChoice::MoreauJean {
            step: 1e-3,
            theta: 0.5,
        },
        duration: None,
        energy_tolerance: None,
    };
    let error = run(&system, &options, &mut [], &mut |_| {}).unwrap_err();
    assert!(
        error.to_string().contains("anagnostopoulos_2004"),
        "{error}"
    );
}
