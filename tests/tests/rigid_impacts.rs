//! Impacts without compliance: velocity jumps, several at once, lasting contact.
//!
//! Checked against Newton's law of impact by hand, and against contact that is made
//! ever stiffer.
use std::sync::Arc;

use pounding_gap_element::{ImpactModel, ModelParameters, registry};
use pounding_time_history::{
    Floor, GroundAcceleration, MethodChoice, Outcome, RunOptions, System, run,
};
use verification::{
    constant_ground, free_bodies as row, reference_cases, reference_system_with, rigid,
    synthetic_motion,
};

fn go(system: &System, duration: f64) -> Outcome {
    let options = RunOptions {
        duration: Some(duration),
        ..RunOptions::default()
    };
    run(system, &options, &mut [], &mut |_| {}).unwrap()
}

fn near(what: &str, computed: &[f64], expected: &[f64]) {
    assert_eq!(computed.len(), expected.len(), "{what}");
    for (a, b) in computed.iter().zip(expected) {
        assert!(
            (a - b).abs() < 1e-9,
            "{what}: {computed:?}, not {expected:?}"
        );
    }
}

/// Bodies of 1 and 2 kg at 1 and -0.5 m/s, e = 0.6: -0.6 and 0.3 m/s, 1.6 N s.
#[test]
fn newtons_law_for_two_bodies() {
    let system = row(&[1.0, 2.0], &[0.3], 0.6, constant_ground(0.0, 1.0));
    let system = system
        .with_initial_state(&[0.0, 0.0], &[1.0, -0.5])
        .unwrap();
    let outcome = go(&system, 0.5);
    near("velocities", &outcome.final_velocity, &[-0.6, 0.3]);
    let impact = &outcome.impacts[0];
    near(
        "impact",
        &[impact.impulse, impact.time_closed, impact.time_opened],
        &[1.6, 0.2, 0.2],
    );
    near("loss", &[impact.energy_dissipated], &[0.75 - 0.27]);
    assert!(impact.peak_force.value.is_nan(), "a jump has no force");
}

/// A body runs into two that touch: Newton's law in both contacts at once gives
/// -1/3, 2/3, 2/3 at e = 1, not what two impacts after one another would.
#[test]
fn a_chain_in_contact_is_solved_as_one() {
    let masses = [1.0, 1.0, 1.0];
    let system = row(&masses, &[0.25, 0.0], 1.0, constant_ground(0.0, 1.0));
    let system = system
        .with_initial_state(&[0.0; 3], &[1.0, 0.0, 0.0])
        .unwrap();
    let outcome = go(&system, 1.0);
    let third = 1.0 / 3.0;
    near(
        "velocities",
        &outcome.final_velocity,
        &[-third, 2.0 * third, 2.0 * third],
    );
    assert!(outcome.energy.end.impact.abs() < 1e-12);
    // A body that did not move parts from one that jumps without an impulse.
    let system = row(&masses, &[0.25, 0.0], 0.5, constant_ground(0.0, 1.0));
    let system = system
        .with_initial_state(&[0.0; 3], &[0.0, 0.0, 1.0])
        .unwrap();
    near(
        "untouched",
        &go(&system, 1.0).final_velocity,
        &[0.0, 0.0, 1.0],
    );
}

/// Two bodies meet a third from both sides at one instant: it stays where it is.
#[test]
fn simultaneous_impacts_from_both_sides() {
    for e in [0.0, 0.5, 1.0] {
        let system = row(
            &[2.0, 1.0, 2.0],
            &[0.25, 0.25],
            e,
            constant_ground(0.0, 1.0),
        );
        let system = system
            .with_initial_state(&[0.0; 3], &[1.0, 0.0, -1.0])
            .unwrap();
        let outcome = go(&system, 0.5);
        near("velocities", &outcome.final_velocity, &[-e, 0.0, e]);
        let closed: Vec<f64> = outcome.impacts.iter().map(|i| i.time_closed).collect();
        near("closures", &closed, &[0.25, 0.25]);
    }
}

/// Pressed to the wall by the ground, the body stays there after ever shorter hops
/// and leaves when the ground turns: at 1.05 s by the record's own straight line.
#[test]
fn lasting_contact_ends_when_the_ground_turns() {
    let mut samples = vec![-1.0; 11];
    samples.extend([1.0; 20]);
    let ground = GroundAcceleration {
        samples: samples.into(),
        time_step: 0.1,
    };
    let system = row(&[3.0], &[0.02], 0.3, ground);
    let outcome = go(&system, 1.5);
    let first = (2.0 * 0.02_f64).sqrt();
    let last = outcome.impacts.last().unwrap();
    near(
        "accumulation and release",
        &[last.time_closed, last.time_opened],
        &[first * 1.3 / 0.7, 1.05],
    );
    near("weight", &[last.peak_force.value], &[3.0]);
    // From 1.05 s the ground pulls: a = 20 t for 0.05 s, then 1 m/s2.
    let speed = 0.5 * 20.0 * 0.05_f64.powi(2) + 0.4;
    near("after", &outcome.final_velocity, &[-speed]);
    assert_eq!(outcome.gaps[0].levels[0].sticks, 1);
    assert!(outcome.energy.residual_ratio < 1e-12);
}

/// Plastic impact: both go on as one, and each lets go when it should pull.
#[test]
fn plastic_impact_holds_without_pulling() {
    let system = row(&[1.0, 3.0], &[0.1], 0.0, constant_ground(0.0, 1.0));
    let system = system.with_initial_state(&[0.0; 2], &[2.0, 0.0]).unwrap();
    let outcome = go(&system, 1.0);
    near("velocities", &outcome.final_velocity, &[0.5, 0.5]);
    near("loss", &[outcome.energy.end.impact], &[2.0 - 0.5]);
}

/// Isolated buildings of case C1 with rigid impacts are the limit of contact that is
/// made ever stiffer: the difference falls like the contact time.
#[test]
fn rigid_is_the_limit_of_stiff() {
    let cases = reference_cases().unwrap();
    let case = &cases.cases["C1"];
    let end = |law: Arc<dyn ImpactModel>| {
        let ground = synthetic_motion().unwrap();
        let system = reference_system_with(case, &|_| Ok(Arc::clone(&law)), ground, 1.0).unwrap();
        let outcome = go(&system, 12.0);
        assert!(outcome.impacts.len() > 5, "{}", outcome.impacts.len());
        (outcome.impacts.len(), outcome.final_displacement)
    };
    let (count, limit) = end(rigid(0.65));
    let distance = |stiffness: f64| {
        let parameters =
            ModelParameters::from_pairs(&[("stiffness", stiffness), ("restitution", 0.65)]);
        let law = registry::build("exact_kelvin_voigt", &parameters).unwrap();
        let (impacts, u) = end(law.into());
        assert_eq!(impacts, count);
        let squares = u.iter().zip(&limit).map(|(a, b)| (a - b) * (a - b));
        squares.sum::<f64>().sqrt()
    };
    let distances = [1.0e11, 1.6e12, 2.56e13].map(distance);
    // Sixteen times as stiff, a quarter of the contact time.
    for pair in distances.windows(2) {
        let ratio = pair[0] / pair[1];
        assert!((3.6..4.4).contains(&ratio), "{distances:?}");
    }
    assert!(distances[2] < 1e-4, "{distances:?}");
}

#[test]
fn energy_and_momentum_over_many_rigid_impacts() {
    let cases = reference_cases().unwrap();
    for (name, e) in [("C2", 1.0), ("C2", 0.0), ("C3a", 0.4), ("C4", 0.65)] {
        let ground = synthetic_motion().unwrap();
        let case = &cases.cases[name];
        let system = reference_system_with(case, &|_| Ok(rigid(e)), ground, 1.0).unwrap();
        let outcome = go(&system, 30.0);
        let energy = &outcome.energy;
        assert!(energy.residual_ratio < 1e-10, "{name}: {energy:?}");
        let logged: f64 = outcome.impacts.iter().map(|i| i.energy_dissipated).sum();
        assert!((logged - energy.end.impact).abs() < 1e-10 * energy.largest_input);
        if e == 1.0 {
            assert!(energy.end.impact.abs() < 1e-10 * energy.largest_input);
        } else {
            assert!(energy.end.impact > 1e-3 * energy.largest_input);
        }
        // Floors must not pass through one another.
        for gap in &outcome.gaps {
            for level in &gap.levels {
                assert!(level.peak_penetration.value < 1e-9, "{name}: {level:?}");
                assert_eq!(level.impacts > 0, level.first_contact.is_some());
            }
        }
    }
}

/// A row of five buildings that stand close or touch: floors are held together while
/// others hit them and part. Contacts neither flutter nor sink into one another.
#[test]
fn a_row_in_touch_does_not_flutter() {
    let cases = reference_cases().unwrap();
    for scale in [0.0, 0.05] {
        for e in [0.3, 0.5, 0.65] {
            let ground = synthetic_motion().unwrap();
            let case = &cases.cases["C4"];
            let system = reference_system_with(case, &|_| Ok(rigid(e)), ground, scale).unwrap();
            let outcome = go(&system, 10.0);
            let tell = format!("scale {scale}, e {e}");
            assert!(outcome.energy.residual_ratio < 1e-10, "{tell}");
            let count = outcome.impacts.len();
            assert!(count < 20_000, "{tell}: {count} impacts");
            for impact in &outcome.impacts {
                assert!(!(impact.time_opened < impact.time_closed), "{impact:?}");
            }
            for level in outcome.gaps.iter().flat_map(|g| &g.levels) {
                assert!(level.peak_penetration.value < 1e-12, "{tell}: {level:?}");
            }
        }
    }
}

/// A floor between two walls without clearance has no unique contact forces: refused with
/// every method before a step is taken, never numbers that are none.
#[test]
fn a_floor_that_cannot_move_is_refused() {
    let methods = [
        MethodChoice::Adaptive {
            relative_tolerance: 1e-10,
        },
        MethodChoice::RungeKutta4 { step: 1e-3 },
        MethodChoice::Newmark {
            step: 1e-3,
            beta: 0.25,
            gamma: 0.5,
        },
    ];
    for method in methods {
        let ground = GroundAcceleration {
            samples: vec![0.0, 1.0, -1.0].into(),
            time_step: 0.1,
        };
        let mut system = row(&[1.0], &[0.0], 0.5, ground);
        let pair = (Floor::Wall, Floor::Storey(0, 0), 0.0, rigid(1.0));
        system
            .add_gap("left", ["wall".to_owned(), "body0".to_owned()], vec![pair])
            .unwrap();
        let system = system.with_initial_state(&[0.0], &[0.3]).unwrap();
        let options = RunOptions {
            method,
            duration: Some(0.2),
            energy_tolerance: None,
        };
        let error = run(&system, &options, &mut [], &mut |_| {}).unwrap_err();
        let told = error.to_string();
        assert!(
            [
                "left level wall-1 (",
                "gap0 level 1-",
                "are rigid and lie between two walls"
            ]
            .iter()
            .all(|part| told.contains(part)),
            "{told}"
        );
        assert!(error.help().is_some());
    }
}

/// Every method treats the jumps alike, from plastic to elastic, and on a row of five
/// buildings whose floors are hit from both sides.
#[test]
fn all_methods_take_jumps() {
    let cases = reference_cases().unwrap();
    let fixed = 1.0e-3;
    let methods = [
        MethodChoice::Newmark {
            step: fixed,
            beta: 0.25,
            gamma: 0.5,
        },
        MethodChoice::HhtAlpha {
            step: fixed,
            alpha: -0.05,
        },
        MethodChoice::RungeKutta4 { step: fixed },
    ];
    for name in ["C1", "C2", "C3a", "C4"] {
        let case = &cases.cases[name];
        for e in [0.0, 0.3, 0.65, 0.95, 1.0] {
            let ground = synthetic_motion().unwrap();
            let system = reference_system_with(case, &|_| Ok(rigid(e)), ground, 1.0).unwrap();
            let adaptive = go(&system, 10.0);
            for method in methods {
                let options = RunOptions {
                    method,
                    duration: Some(10.0),
                    energy_tolerance: None,
                };
                let outcome = run(&system, &options, &mut [], &mut |_| {}).unwrap();
                let peak = |o: &Outcome| {
                    let storeys = o.buildings.iter().flat_map(|b| &b.storeys);
                    storeys.map(|s| s.displacement.value).fold(0.0, f64::max)
                };
                let ratio = peak(&outcome) / peak(&adaptive);
                assert!(
                    (0.9..1.1).contains(&ratio),
                    "{name} {e} {method:?}: {ratio}"
                );
            }
        }
    }
}

/// A body in contact with a wall at its left, hit by another from the right, rigidly: its
/// velocity jumps, and the contact at the left has to go on in the phase of the new one.
/// Every phase is a damped oscillator or free motion, in closed form.
mod beside_a_closed_contact {
    use super::*;
    use pounding_gap_element::{Memory, Phase, SeparationRule};
    use verification::single_storey;

    const STIFFNESS: f64 = 1.0e6;
    const MASS: f64 = 1.0e3;
    const HITTING: f64 = 200.0;
    const RESTITUTION: f64 = 0.8;
    const GAP: f64 = 0.05;
    const HIT_SPEED: f64 = 5.0;

    /// Penetration and its rate after `t` of `m x'' + c x' + k x = 0`.
    fn damped((x, v): (f64, f64), dashpot: f64, t: f64) -> (f64, f64) {
        let decay = dashpot / (2.0 * MASS);
        let omega = (STIFFNESS / MASS - decay * decay).sqrt();
        let (s, c) = (omega * t).sin_cos();
        let b = (v + decay * x) / omega;
        let e = (-decay * t).exp();
        let (position, turned) = (x * c + b * s, b * c - x * s);
        (e * position, e * (omega * turned - decay * position))
    }

    /// The first time within a half period at which the function of state falls below zero.
    fn ends(from: (f64, f64), dashpot: f64, function: impl Fn((f64, f64)) -> f64) -> f64 {
        let half = std::f64::consts::PI / (STIFFNESS / MASS).sqrt();
        let at = |t: f64| function(damped(from, dashpot, t));
        let step = half / 1000.0;
        let mut low = step;
        while at(low + step) > 0.0 {
            low += step;
        }
        let mut high = low + step;
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            if at(middle) > 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        low
    }

    /// What the law of the wall at the left does between closure and opening.
    struct Law {
        model: Arc<dyn ImpactModel>,
        /// Dashpot in approach (N s/m).
        dashpot: f64,
        /// Whether it only damps the approach, or may not pull.
        approach_only: bool,
    }

    impl Law {
        /// From a closed state that is pressed together until the force is over: time, state,
        /// and the velocity with which the body goes on freely.
        fn until_released(&self, from: (f64, f64)) -> (f64, (f64, f64)) {
            let force = |(x, v): (f64, f64)| STIFFNESS * x + self.dashpot * v;
            let end = if self.approach_only {
                ends(from, self.dashpot, |(_, v)| v)
            } else {
                ends(from, self.dashpot, force)
            };
            (end, damped(from, self.dashpot, end))
        }
    }

    fn check(law: &Law, method: MethodChoice) {
        let speed = 1.0;
        // The first approach, and the part of the way back until the other body comes.
        let (first, released) = law.until_released((0.0, speed));
        let (rest, before) = if law.approach_only {
            (0.01, damped(released, 0.0, 0.01))
        } else {
            let rest = 0.4 * released.0 / -released.1;
            (rest, (released.0 + released.1 * rest, released.1))
        };
        assert!(before.0 > 1e-3 && before.1 < 0.0, "{before:?}");
        let hit = GAP / speed + first + rest;
        let reduced = MASS * HITTING / (MASS + HITTING);
        let impulse = (1.0 + RESTITUTION) * reduced * (HIT_SPEED - before.1);
        let after = (before.0, before.1 + impulse / MASS);
        let bounced = HIT_SPEED - impulse / HITTING;
        assert!(after.1 > 0.0 && bounced < 0.0);
        // The second approach, and the end of the contact.
        let (_, last) = law.until_released(after);
        let parting = if law.approach_only {
            damped(last, 0.0, ends(last, 0.0, |(x, _)| x)).1
        } else {
            last.1
        };

        let bodies = vec![
            single_storey("body", MASS, 1.0e-12 * MASS),
            single_storey("hitting", HITTING, 1.0e-12 * HITTING),
        ];
        let mut system = System::new(bodies, constant_ground(0.0, 2.0));
        let (body, other) = (Floor::Storey(0, 0), Floor::Storey(1, 0));
        let names = |a: &str, b: &str| [a.to_owned(), b.to_owned()];
        let wall = vec![(Floor::Wall, body, GAP, Arc::clone(&law.model))];
        system.add_gap("wall", names("wall", "body"), wall).unwrap();
        let width = HIT_SPEED * hit - GAP - before.0;
        let pair = vec![(body, other, width, rigid(RESTITUTION))];
        system
            .add_gap("pair", names("body", "hitting"), pair)
            .unwrap();
        let system = system
            .with_initial_state(&[0.0, 0.0], &[-speed, -HIT_SPEED])
            .unwrap();
        let options = RunOptions {
            duration: Some(0.5),
            method,
            ..RunOptions::default()
        };
        let outcome = run(&system, &options, &mut [], &mut |_| {}).unwrap();
        let what = format!("{} {method:?}", law.model.descriptor().name);
        near(&what, &outcome.final_velocity, &[-parting, -bounced]);
        let counts: Vec<usize> = outcome.gaps.iter().map(|g| g.levels[0].impacts).collect();
        assert_eq!(counts, [1, 1], "{what}");
        let force = STIFFNESS * after.0 + law.dashpot * after.1;
        let peak = outcome.gaps[0].levels[0].peak_force.value;
        if !law.approach_only {
            assert!(force > law.dashpot * speed);
            assert!(peak >= force * (1.0 - 1e-12), "{what}: {peak} {force}");
        }
        assert!(outcome.energy.residual_ratio < 1e-11, "{what}");
    }

    #[test]
    fn goes_on_in_the_phase_of_the_new_velocity() {
        let build = |name: &str, rule: Option<SeparationRule>| {
            let mut pairs = vec![("stiffness", STIFFNESS), ("restitution", 0.5)];
            if name == "exact_linear_approach" {
                pairs.push(("exponent", 1.0));
            }
            let mut parameters = ModelParameters::from_pairs(&pairs);
            if let Some(rule) = rule {
                parameters = parameters.with_separation(rule);
            }
            let model = registry::build(name, &parameters).unwrap();
            let collision = model.begin(1.0, MASS);
            let memory = Memory::default();
            let force = model.force(&collision, &memory, Phase::Approach, 1.0e-3, 1.0);
            Law {
                dashpot: force.by_velocity,
                approach_only: rule.is_none(),
                model: model.into(),
            }
        };
        let laws = [
            build("exact_kelvin_voigt", Some(SeparationRule::NoTension)),
            build("exact_kelvin_voigt", Some(SeparationRule::NoTensionLatched)),
            build("exact_linear_approach", None),
        ];
        for law in &laws {
            let relative_tolerance = 1.0e-12;
            check(law, MethodChoice::Adaptive { relative_tolerance });
            check(law, MethodChoice::EventDriven { relative_tolerance });
        }
    }
}
