//! Collisions under a constant pressing acceleration, against closed forms.
use pounding_gap_element::{
    Bodies, CollisionOptions, CollisionOutcome, ModelParameters, collide, collide_with, registry,
};

const GRAVITY: f64 = 9.80665;

fn drop(
    model: &str,
    parameters: &[(&str, f64)],
    (mass, velocity): (f64, f64),
    read_at: impl Into<Option<f64>>,
) -> CollisionOutcome {
    let model = registry::build(model, &ModelParameters::from_pairs(parameters)).unwrap();
    let bodies = Bodies {
        mass_left: mass,
        mass_right: None,
        velocity_left: velocity,
        velocity_right: 0.0,
    };
    let options = CollisionOptions {
        pressing_acceleration: GRAVITY,
        read_at: read_at.into(),
    };
    collide_with(model.as_ref(), &bodies, &options).unwrap()
}

fn close(value: f64, expected: f64) {
    let error = (value / expected - 1.0).abs();
    assert!(error < 1e-9, "{value} is not {expected}");
}

/// x = g/w^2 (1 - cos wt) + v0/w sin wt until x = 0 again, then free flight.
#[test]
fn an_elastic_drop_is_that_of_an_oscillator() {
    let (mass, velocity, stiffness) = (500.0, 2.0, 1.0e6);
    let natural = f64::sqrt(stiffness / mass);
    let sag = GRAVITY / (natural * natural);
    let contact = (2.0 * std::f64::consts::PI - 2.0 * (velocity / natural).atan2(sag)) / natural;
    let parameters = [("stiffness", stiffness)];
    let out = drop("linear_elastic", &parameters, (mass, velocity), 0.2);
    close(out.peak_penetration, sag + sag.hypot(velocity / natural));
    close(out.duration, contact);
    close(out.restitution, 1.0);
    let reading = out.reading.unwrap();
    close(reading.velocity, GRAVITY * (0.2 - contact) - velocity);
    let within = drop("linear_elastic", &parameters, (mass, velocity), 0.01);
    let phase = natural * 0.01;
    let expected = sag * natural * phase.sin() + velocity * phase.cos();
    close(within.reading.unwrap().velocity, expected);
    let at_once = drop("linear_elastic", &parameters, (mass, velocity), 0.0);
    assert_eq!(at_once.reading.unwrap().velocity, velocity);
    assert_eq!(at_once.reading.unwrap().penetration, 0.0);
}

/// Bodies set down so slowly, or on so soft a slab, that they leave it for a small part of a period at most: a step that is
/// longer goes over the excursion, and the contact went on for whole periods.
#[test]
fn slow_drops_end_after_one_period() {
    for (mass, stiffness) in [
        (25e3, 93.5e6),
        (200e3, 5e6),
        (25e3, 1e4),
        (25e3, 1e3),
        (1.0, 1e9),
    ] {
        for velocity in [
            1e-4, 2e-4, 3.1e-4, 9e-4, 1e-3, 1.5e-3, 5e-3, 8e-3, 1e-2, 3e-2, 0.3,
        ] {
            let natural = f64::sqrt(stiffness / mass);
            let sag = GRAVITY / (natural * natural);
            let part = velocity / natural / sag;
            // Excursions of less are the error of steps.
            if part < 3e-6 {
                continue;
            }
            let contact = (2.0 * std::f64::consts::PI - 2.0 * part.atan()) / natural;
            let parameters = [("stiffness", stiffness)];
            let out = drop("linear_elastic", &parameters, (mass, velocity), None);
            let error = out.duration / contact - 1.0;
            assert!(
                error.abs() < 1e-6,
                "{mass} kg, {stiffness} N/m, {velocity} m/s: {} s for {contact} s",
                out.duration
            );
            assert!((out.restitution - 1.0).abs() < 1e-3);
        }
    }
}

/// A body set down so slowly that it stays: its peak is that of the damped
/// oscillator, though its fate is known before it gets there.
#[test]
fn a_body_that_stays_has_reached_its_peak() {
    let (mass, velocity, stiffness, ratio) = (500.0, 1e-3, 1.0e6, 0.5_f64);
    let natural = f64::sqrt(stiffness / mass);
    let damped = natural * (1.0 - ratio * ratio).sqrt();
    let sag = GRAVITY / (natural * natural);
    let sine = (velocity - ratio * natural * sag) / damped;
    let state = |t: f64| {
        let (s, c) = (damped * t).sin_cos();
        let fading = (-ratio * natural * t).exp();
        let x = sag + fading * (sine * s - sag * c);
        let rate = fading * damped * (sine * c + sag * s) - ratio * natural * (x - sag);
        (x, rate)
    };
    let (mut low, mut high) = (1e-4 / damped, 1.5 * std::f64::consts::PI / damped);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if state(middle).1 > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    let parameters = [("stiffness", stiffness), ("damping_ratio", ratio)];
    let out = drop("anagnostopoulos_2004", &parameters, (mass, velocity), 1.0);
    assert!(out.stays_in_contact);
    close(out.reading.unwrap().penetration, state(1.0).0);
    close(out.peak_penetration, state(low).0);
    assert!((out.peak_penetration_time / low - 1.0).abs() < 1e-6);
}

/// A spring so weak that the dashpot takes all: nothing acts any more, and the bodies
/// neither part nor approach.
#[test]
fn bodies_that_the_dashpot_stops_stay_together() {
    let descriptor = registry::find("adams_impact").unwrap();
    let mut parameters = descriptor.example_parameters(0.5);
    parameters.values.insert("stiffness".to_owned(), 7.74509e-6);
    let law = registry::build("adams_impact", &parameters).unwrap();
    let bodies = Bodies {
        mass_left: 12.9834,
        mass_right: Some(2761.67),
        velocity_left: 295.191,
        velocity_right: 0.0,
    };
    let out = collide(law.as_ref(), &bodies).unwrap();
    assert!(out.stays_in_contact && out.restitution == 0.0);
}

/// A dashpot so strong that the body creeps to rest without turning back.
#[test]
fn a_body_that_creeps_comes_to_rest() {
    let parameters = [("stiffness", 1.0e6), ("damping_ratio", 3.0)];
    let out = drop("anagnostopoulos_2004", &parameters, (500.0, 0.01), 100.0);
    assert!(out.stays_in_contact);
    close(out.peak_penetration, 500.0 * GRAVITY / 1.0e6);
}

/// A damping that leaves no inertia lets a body creep to where the spring bears its weight, without
/// ever turning back: `(m g / k)^(1 / n)` for laws in powers.
#[test]
fn a_body_that_creeps_to_rest_stays_where_the_spring_bears_it() {
    let cases = [
        (
            "exact_hunt_crossley",
            [("stiffness", 1e7), ("restitution", 0.3)],
            25e3,
            0.01,
            1.5,
        ),
        (
            "exact_hunt_crossley",
            [("stiffness", 2.75e9), ("restitution", 0.1)],
            25e3,
            5e-3,
            1.5,
        ),
        (
            "ye_li_2009",
            [("stiffness", 1e7), ("restitution", 0.3)],
            25e3,
            0.01,
            1.0,
        ),
        (
            "gonthier_2004",
            [("stiffness", 1e7), ("restitution", 0.3)],
            25e3,
            0.01,
            1.5,
        ),
        (
            "anagnostopoulos_2004",
            [("stiffness", 1e6), ("damping_ratio", 40.0)],
            500.0,
            1e-3,
            1.0,
        ),
    ];
    for (model, parameters, mass, velocity, power) in cases {
        let out = drop(model, &parameters, (mass, velocity), None);
        assert!(out.stays_in_contact && out.restitution == 0.0, "{model}");
        let static_penetration = (mass * GRAVITY / parameters[0].1).powf(1.0 / power);
        close(out.peak_penetration, static_penetration);
        assert!(out.peak_force >= mass * GRAVITY, "{model}");
    }
}
