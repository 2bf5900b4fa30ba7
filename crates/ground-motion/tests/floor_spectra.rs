//! Response spectra of floors against the response spectrum of the ground and closed forms.
#![allow(clippy::unwrap_used)]

use std::f64::consts::TAU;

use pounding_ground_motion::spectra::{Evaluation, FloorMotion, floor_spectrum, response_spectrum};
use pounding_ground_motion::{AccelerationUnit, Accelerogram, GroundMotionError};

/// A floor that stays where the ground is feels what the ground does, to the last bit.
#[test]
fn a_floor_that_does_not_move_has_the_spectrum_of_the_ground() {
    let ground: Vec<f64> = (0..800)
        .map(|i| (0.13 * f64::from(i)).sin() * (0.011 * f64::from(i)).sin())
        .collect();
    let still = vec![0.0; ground.len()];
    let motion = FloorMotion {
        time_step: 0.01,
        ground: &ground,
        displacement: &still,
        velocity: &still,
    };
    let periods = [0.05, 0.2, 0.48, 1.0, 3.0];
    let floor = floor_spectrum(&motion, &periods, 0.05).unwrap();
    let unit = AccelerationUnit::MetrePerSecondSquared;
    let record = Accelerogram::new(ground.clone(), unit, 0.01).unwrap();
    let expected = response_spectrum(&record, &periods, 0.05, Evaluation::PiecewiseLinear).unwrap();
    assert_eq!(floor, expected);
}

/// Greatest relative displacement and absolute acceleration of an oscillator on a floor that begins to swing as
/// `1 - cos(W t)`, times `amplitude`, from the closed form at many times: forced swing and free one from rest.
fn swinging(amplitude: f64, forcing: f64, period: f64, damping: f64, duration: f64) -> [f64; 2] {
    let w = TAU / period;
    let wd = w * (1.0 - damping * damping).sqrt();
    // u'' + 2 z w u' + w^2 u = -A W^2 cos(W t).
    let force = -amplitude * forcing * forcing;
    let (p, q) = (w * w - forcing * forcing, 2.0 * damping * w * forcing);
    let scale = force / (p * p + q * q);
    let (c, s) = (scale * p, scale * q);
    let b = -(damping * w * c + forcing * s) / wd;
    let mut most = [0.0_f64; 2];
    let count = 400_000;
    for i in 0..=count {
        let t = duration * f64::from(i) / f64::from(count);
        let decay = (-damping * w * t).exp();
        let free = decay * (-c * (wd * t).cos() + b * (wd * t).sin());
        let free_rate =
            -damping * w * free + decay * wd * (c * (wd * t).sin() + b * (wd * t).cos());
        let u = c * (forcing * t).cos() + s * (forcing * t).sin() + free;
        let v = forcing * (s * (forcing * t).cos() - c * (forcing * t).sin()) + free_rate;
        most[0] = most[0].max(u.abs());
        most[1] = most[1].max((w * w * u + 2.0 * damping * w * v).abs());
    }
    most
}

/// Peaks of oscillators on a floor that swings agree with the closed form, and come nearer to it with more than the third power
/// of the time step.
#[test]
fn a_floor_that_swings_has_the_closed_form() {
    let (amplitude, forcing, damping, duration) = (0.05, TAU / 0.4, 0.03, 4.0);
    let periods = [0.11, 0.35, 0.9];
    let errors = |count: usize| -> Vec<f64> {
        let h = duration / count as f64;
        let at = |i: usize| forcing * h * i as f64;
        let displacement: Vec<f64> = (0..=count)
            .map(|i| amplitude * (1.0 - at(i).cos()))
            .collect();
        let velocity: Vec<f64> = (0..=count)
            .map(|i| amplitude * forcing * at(i).sin())
            .collect();
        let ground = vec![0.0; count + 1];
        let motion = FloorMotion {
            time_step: h,
            ground: &ground,
            displacement: &displacement,
            velocity: &velocity,
        };
        let found = floor_spectrum(&motion, &periods, damping).unwrap();
        let of = |(i, period): (usize, &f64)| {
            let [u, a] = swinging(amplitude, forcing, *period, damping, duration);
            [
                found.displacement[i] / u - 1.0,
                found.acceleration[i] / a - 1.0,
            ]
        };
        periods
            .iter()
            .enumerate()
            .flat_map(of)
            .map(f64::abs)
            .collect()
    };
    // Where in its step a peak lies says how much of an error is seen there.
    let worst = |count| errors(count).into_iter().fold(0.0, f64::max);
    let (coarse, fine) = (worst(160), worst(2560));
    let order = (coarse / fine).log2() / 4.0;
    assert!(order > 3.2, "{coarse} {fine}: {order}");
    assert!(errors(4000).iter().all(|error| *error < 1e-7));
}

/// A jump of the velocity of the floor, as that of a rigid impact, makes an oscillator at rest swing with it: its relative
/// displacement reaches `V/w exp(-z acos(z)/sqrt(1 - z^2))`. Accelerations at even times, which are zero, know nothing of it.
#[test]
fn a_jump_of_the_velocity_has_the_closed_form() {
    let (jump, damping, h) = (0.3, 0.05_f64, 1e-3);
    let when = 0.0104;
    let time = |i: usize| h * i as f64;
    let displacement: Vec<f64> = (0..3000)
        .map(|i| jump * (time(i) - when).max(0.0))
        .collect();
    let velocity: Vec<f64> = (0..3000)
        .map(|i| if time(i) > when { jump } else { 0.0 })
        .collect();
    let ground = vec![0.0; 3000];
    let motion = FloorMotion {
        time_step: h,
        ground: &ground,
        displacement: &displacement,
        velocity: &velocity,
    };
    let periods = [0.01, 0.05, 0.4];
    let found = floor_spectrum(&motion, &periods, damping).unwrap();
    let part = (-damping * damping.acos() / (1.0 - damping * damping).sqrt()).exp();
    for (i, tolerance) in [0.02, 0.002, 1e-4].into_iter().enumerate() {
        let expected = jump * periods[i] / TAU * part;
        let error = found.displacement[i] / expected - 1.0;
        assert!(error.abs() < tolerance, "{}: {error}", periods[i]);
    }
}

#[test]
fn what_has_no_spectrum_is_refused() {
    let (three, two) = (vec![0.0; 3], vec![0.0; 2]);
    let motion = |velocity| FloorMotion {
        time_step: 0.01,
        ground: &three,
        displacement: &three,
        velocity,
    };
    let refused = |error: Result<_, GroundMotionError>| error.unwrap_err().to_string();
    let said = refused(floor_spectrum(&motion(&two), &[0.1], 0.05));
    assert!(said.contains("[3, 3, 2]"), "{said}");
    for (period, damping, part) in [
        (0.0, 0.05, "peak acceleration of the floor"),
        (-1.0, 0.05, "period"),
        (f64::NAN, 0.05, "period"),
        (0.1, 1.0, "damping ratio"),
        (0.1, f64::NAN, "damping ratio"),
    ] {
        let said = refused(floor_spectrum(&motion(&three), &[period], damping));
        assert!(said.contains(part), "{said}");
    }
}
