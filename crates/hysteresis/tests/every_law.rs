//! What every law of the registry must satisfy, in one loop each.
use std::collections::BTreeSet;

use crate::common::{Explicit, example, motion, times};
use pounding_hysteresis::{Guard, History, HysteresisLaw, LawDescriptor, Motion, descriptors};

const END: f64 = 40.0;

/// Least distance to the nearest guard of the held branch, in deformation and in
/// velocity.
fn room(law: &dyn HysteresisLaw, history: &History, at: Motion) -> (f64, f64) {
    let mut room = (f64::INFINITY, f64::INFINITY);
    for guard in law.guards(history).into_iter().flatten() {
        let distance = -law.guard(history, guard, at, history.variables());
        match guard {
            Guard::Turning | Guard::Faster | Guard::Slower => room.1 = room.1.min(distance),
            _ => room.0 = room.0.min(distance),
        }
    }
    room
}

/// Whether a slope agrees with the central difference of a function, to the
/// truncation and rounding errors of the latter: it halves the width until it does.
fn slope_agrees(f: impl Fn(f64) -> f64, slope: f64, width: f64, scale: f64) -> Result<(), f64> {
    let mut least = f64::INFINITY;
    let mut h = width;
    for _ in 0..9 {
        let difference = (f(h) - f(-h)) / (2.0 * h);
        least = least.min((difference - slope).abs());
        if least <= 2e-6 * scale {
            return Ok(());
        }
        h *= 0.5;
    }
    Err(least)
}

fn check_trial_tangents(descriptor: &'static LawDescriptor) {
    let law = example(descriptor);
    let mut committed = law.virgin();
    let mut candidate = committed.clone();
    let (mut visited, mut tested) = (BTreeSet::new(), BTreeSet::new());
    let amplitude = descriptor.example_amplitude;
    let mut scale = law.initial_stiffness();
    let instants = times(END, 0.05);
    for pair in instants.windows(2) {
        let (end, step) = (motion(amplitude, pair[1]), pair[1] - pair[0]);
        let response = law.trial(&committed, &mut candidate, end, step);
        scale = scale.max(response.by_deformation.abs());
        let width = 1e-4 * amplitude;
        let moved = (end.deformation - committed.motion().deformation).abs();
        let (room, room_velocity) = room(law.as_ref(), &candidate, end);
        visited.insert(candidate.branch());
        if moved > 2.0 * width && room > 2.0 * width {
            let f = |h: f64| {
                let shifted = Motion {
                    deformation: end.deformation + h,
                    ..end
                };
                law.trial(&committed, &mut law.virgin(), shifted, step)
                    .force
            };
            slope_agrees(f, response.by_deformation, width, scale).unwrap_or_else(|e| {
                panic!("{}: {response:?} at {end:?}, off by {e}", descriptor.name)
            });
            tested.insert(candidate.branch());
        }
        let width = 1e-4 * end.velocity.abs();
        // What the speed at a peak has of round-off is too little to be varied.
        if width > 1e-12 * amplitude && room_velocity > 2.0 * width {
            let f = |h: f64| {
                let shifted = Motion {
                    velocity: end.velocity + h,
                    ..end
                };
                law.trial(&committed, &mut law.virgin(), shifted, step)
                    .force
            };
            let scale = response.by_velocity.abs().max(1e-6 * scale);
            slope_agrees(f, response.by_velocity, width, scale).unwrap_or_else(|e| {
                panic!("{}: {response:?} at {end:?}, off by {e}", descriptor.name)
            });
        }
        committed.commit(&mut candidate);
    }
    assert_eq!(visited, tested, "{}: branches not tested", descriptor.name);
}

#[test]
fn tangents_of_trials_agree_with_finite_differences_on_all_branches() {
    for descriptor in descriptors() {
        check_trial_tangents(descriptor);
    }
}

#[test]
fn tangents_of_held_branches_agree_with_finite_differences_inside_and_past_the_end() {
    for descriptor in descriptors() {
        let law = example(descriptor);
        let amplitude = descriptor.example_amplitude;
        let mut driver = Explicit::new(law.as_ref(), amplitude);
        for time in times(END, 0.05) {
            driver.advance(time);
            let at = motion(amplitude, time);
            // Some laws have a power as their slope where a branch begins: no
            // difference converges there.
            if at.velocity.abs() < 0.02 * amplitude || time == 0.0 {
                continue;
            }
            let response = law.force(&driver.history, at, &driver.variables);
            let force = |x: f64, v: f64| {
                let shifted = Motion {
                    deformation: at.deformation + x,
                    velocity: at.velocity + v,
                };
                law.force(&driver.history, shifted, &driver.variables).force
            };
            let scale = law.initial_stiffness().max(response.by_deformation.abs());
            let width = 1e-5 * amplitude;
            slope_agrees(|x| force(x, 0.0), response.by_deformation, width, scale)
                .unwrap_or_else(|e| panic!("{}: {response:?} at {at:?}, {e}", descriptor.name));
            let width = 1e-5 * at.velocity.abs();
            if width > 0.0 {
                let scale = response.by_velocity.abs().max(1e-6 * scale);
                slope_agrees(|v| force(0.0, v), response.by_velocity, width, scale)
                    .unwrap_or_else(|e| panic!("{}: {response:?} at {at:?}, {e}", descriptor.name));
            }
        }
    }
}

/// Laws that say so, and no others, are affine in deformation and velocity on every branch
/// that they hold: the event-driven method takes them at their word.
#[test]
fn piecewise_linear_laws_are_affine_on_their_branches() {
    let (mut straight, mut curved) = (0, 0);
    for descriptor in descriptors() {
        let law = example(descriptor);
        let amplitude = descriptor.example_amplitude;
        let (mut history, mut candidate) = (law.virgin(), law.virgin());
        let (mut bend, mut branches) = (0.0_f64, BTreeSet::new());
        for pair in times(END, 0.05).windows(2) {
            let (end, step) = (motion(amplitude, pair[1]), pair[1] - pair[0]);
            law.trial(&history, &mut candidate, end, step);
            history.commit(&mut candidate);
            branches.insert(history.branch());
            let variables = history.variables().to_vec();
            let force = |x: f64, v: f64| {
                let motion = Motion {
                    deformation: end.deformation + x * amplitude,
                    velocity: end.velocity + v * amplitude,
                };
                law.force(&history, motion, &variables).force
            };
            let size = force(0.0, 0.0).abs().max(force(0.01, 0.01).abs()).max(1.0);
            for (x, v) in [(1e-3, 0.0), (0.0, 1e-3), (1e-3, 1e-3)] {
                let second = force(x, v) - 2.0 * force(0.0, 0.0) + force(-x, -v);
                bend = bend.max(second.abs() / size);
            }
        }
        let name = descriptor.name;
        if law.is_piecewise_linear() {
            assert!(bend < 1e-12, "{name} bends by {bend:e} on {branches:?}");
            straight += 1;
        } else {
            // A law with internal variables may be straight at fixed ones.
            assert!(
                bend > 1e-12 || law.internal_variables() > 0,
                "{name} is straight on {branches:?}"
            );
            curved += 1;
        }
    }
    assert!(straight > 10 && curved > 5, "{straight} {curved}");
}

#[test]
fn a_trial_without_commit_leaves_no_trace() {
    for descriptor in descriptors() {
        let law = example(descriptor);
        let amplitude = descriptor.example_amplitude;
        let (mut plain, mut disturbed) = (law.virgin(), law.virgin());
        let (mut spare, mut candidate) = (plain.clone(), plain.clone());
        let instants = times(END, 0.05);
        for (i, pair) in instants.windows(2).enumerate() {
            let (end, step) = (motion(amplitude, pair[1]), pair[1] - pair[0]);
            for wild in [-1.7, 0.9, 2.3] {
                let elsewhere = Motion {
                    deformation: wild * amplitude * (1.0 + i as f64 * 0.01),
                    velocity: -wild * amplitude,
                };
                let before = disturbed.clone();
                law.trial(&disturbed, &mut candidate, elsewhere, step);
                assert_eq!(before, disturbed, "{}", descriptor.name);
            }
            let response = law.trial(&disturbed, &mut candidate, end, step);
            disturbed.commit(&mut candidate);
            assert_eq!(
                response,
                law.trial(&plain, &mut spare, end, step),
                "{}",
                descriptor.name
            );
            plain.commit(&mut spare);
            assert_eq!(plain, disturbed, "{}", descriptor.name);
        }
    }
}

/// Maximum difference of force and of energy between the two seams, over the
/// maximum force and the maximum energy.
fn seams_differ(descriptor: &'static LawDescriptor, step: f64) -> (f64, f64) {
    let law = example(descriptor);
    let amplitude = descriptor.example_amplitude;
    let mut driver = Explicit::new(law.as_ref(), amplitude);
    let mut committed = law.virgin();
    let mut candidate = committed.clone();
    let (mut force_off, mut energy_off) = (0.0_f64, 0.0_f64);
    let (mut force_max, mut energy_max) = (0.0_f64, 0.0_f64);
    let instants = times(END, step);
    for pair in instants.windows(2) {
        let end = motion(amplitude, pair[1]);
        let implicit = law
            .trial(&committed, &mut candidate, end, pair[1] - pair[0])
            .force;
        committed.commit(&mut candidate);
        driver.advance(pair[1]);
        force_off = force_off.max((implicit - driver.force()).abs());
        force_max = force_max.max(implicit.abs());
        let (stored, dissipated) = driver.energies();
        let variables = committed.variables();
        let other = law.dissipated_energy(&committed, end, variables);
        energy_off = energy_off.max((other - dissipated).abs());
        energy_off = energy_off.max((law.stored_energy(&committed, end, variables) - stored).abs());
        energy_max = energy_max.max(stored.abs()).max(dissipated.abs());
    }
    let smooth = law.guards(&law.virgin()).iter().all(Option::is_none);
    assert!(smooth || driver.passed > 5, "{}", descriptor.name);
    (force_off / force_max, energy_off / energy_max)
}

#[test]
fn implicit_trials_and_located_branches_agree_on_the_same_path() {
    for descriptor in descriptors() {
        let (force, energy) = seams_differ(descriptor, 0.005);
        // A trial of a rate-dependent law goes straight through its step: second order
        // in time. A broken power of an internal variable costs the explicit steps
        // that start at its zero a little. Both must vanish with the step.
        let bound = if descriptor.rate_dependent {
            1e-3
        } else {
            1e-8
        };
        assert!(
            force < bound && energy < bound,
            "{}: {force} {energy}",
            descriptor.name
        );
        if force.max(energy) > 1e-9 {
            let (finer, finer_energy) = seams_differ(descriptor, 0.0025);
            assert!(
                force < 1e-9 || force / finer > 3.6,
                "{}: {force} {finer}",
                descriptor.name
            );
            assert!(
                energy < 1e-9 || energy / finer_energy > 3.6,
                "{}: {energy} {finer_energy}",
                descriptor.name
            );
        }
    }
}

#[test]
fn work_is_stored_or_dissipated() {
    for descriptor in descriptors() {
        let law = example(descriptor);
        let amplitude = descriptor.example_amplitude;
        let mut driver = Explicit::new(law.as_ref(), amplitude);
        let (mut off, mut maximum, mut lost) = (0.0_f64, 0.0_f64, 0.0_f64);
        for time in times(END, 0.005) {
            driver.advance(time);
            let (stored, dissipated) = driver.energies();
            off = off.max((stored + dissipated - driver.work).abs());
            maximum = maximum.max(stored).max(dissipated);
            lost = lost.max(-stored);
        }
        assert!(
            off < 1e-8 * maximum,
            "{}: {off:e} of {maximum:e}",
            descriptor.name
        );
        assert!(
            lost <= 1e-14 * maximum,
            "{}: stored energy of -{lost}",
            descriptor.name
        );
    }
}

/// Laws that act differently on the two sides.
const ONE_SIDED: [&str; 3] = ["gap_hook", "elastoplastic_gap", "hyperbolic_gap"];

#[test]
fn the_mirrored_path_gives_the_mirrored_force_bit_for_bit() {
    for descriptor in descriptors()
        .iter()
        .filter(|c| !ONE_SIDED.contains(&c.name))
    {
        let law = example(descriptor);
        let run = |sign: f64| -> Vec<f64> {
            let path: Vec<f64> = times(END, 0.05)
                .iter()
                .map(|t| sign * motion(descriptor.example_amplitude, *t).deformation)
                .collect();
            let points = pounding_hysteresis::laboratory::history(law.as_ref(), &path, 0.05);
            points.iter().map(|p| p.force).collect()
        };
        let (there, mirrored) = (run(1.0), run(-1.0));
        for (a, b) in there.iter().zip(&mirrored) {
            assert_eq!(*a, -*b, "{}", descriptor.name);
        }
    }
}

/// Forces (N) after the element went slowly from rest to this deformation, behind a gap of zero where it has
/// one, and once it has rested there for an hour.
fn force_at_rest(descriptor: &'static LawDescriptor, deformation: f64) -> f64 {
    let mut parameters = descriptor.example_parameters();
    for (name, value) in &mut parameters.values {
        if name.ends_with("gap") {
            *value = 0.0;
        }
    }
    let law = pounding_hysteresis::build(descriptor.name, &parameters).unwrap();
    let (mut history, mut candidate) = (law.virgin(), law.virgin());
    let rest = Motion {
        deformation,
        velocity: 0.0,
    };
    law.trial(&history, &mut candidate, rest, 10.0);
    history.commit(&mut candidate);
    law.trial(&history, &mut candidate, rest, 3600.0).force
}

/// Laws of storeys resist a lasting deformation either way; those of links alone do not, but for a gap and
/// hook that both act from zero.
#[test]
fn laws_of_storeys_hold_a_lasting_load_in_both_directions() {
    for descriptor in descriptors() {
        let reach = 0.1 * descriptor.example_amplitude;
        let holds = [1.0, -1.0].map(|side| side * force_at_rest(descriptor, side * reach) > 0.0);
        let of_storeys = descriptor.link_alone.is_none();
        if descriptor.name != "gap_hook" {
            assert_eq!(holds == [true, true], of_storeys, "{}", descriptor.name);
        }
        let law = example(descriptor);
        if of_storeys {
            assert!(law.initial_stiffness() > 0.0, "{}", descriptor.name);
            assert!(law.holds_static_load(), "{}", descriptor.name);
        }
    }
    assert!(
        pounding_hysteresis::find("gap_hook")
            .unwrap()
            .link_alone
            .is_some()
    );
}

#[test]
fn descriptors_are_complete_and_examples_build() {
    let mut names = BTreeSet::new();
    for descriptor in descriptors() {
        assert!(names.insert(descriptor.name), "{} twice", descriptor.name);
        for alias in descriptor.aliases {
            assert!(names.insert(alias.name), "{} twice", alias.name);
        }
        let law = example(descriptor);
        assert_eq!(law.descriptor().name, descriptor.name);
        assert!(law.virgin().variables().len() == law.internal_variables());
        assert!(law.initial_stiffness().is_finite() && law.initial_stiffness() >= 0.0);
        assert!(!descriptor.formula.is_empty() && !descriptor.citation.is_empty());
        for parameter in descriptor.parameters {
            if let Some(default) = parameter.default {
                assert!(
                    parameter.allows(default),
                    "{} {}",
                    descriptor.name,
                    parameter.name
                );
            }
        }
    }
}
