//! Response spectra of floors against the response spectrum of the ground and closed forms.
use std::f64::consts::TAU;

use pounding_ground_motion::spectra::{Evaluation, FloorMotion, floor_spectrum, response_spectrum};
use pounding_ground_motion::{AccelerationUnit, Accelerogram, GroundMotionError};

/// Pieces between these values at even times, of which nothing jumps.
fn pieces(time_step: f64, ground: &[f64], motion: impl Fn(f64) -> [f64; 2]) -> Vec<FloorMotion> {
    let at = |i: usize| motion(time_step * i as f64);
    let piece = |i: usize| {
        let ([x, v], [y, w]) = (at(i), at(i + 1));
        FloorMotion {
            length: time_step,
            ground: [ground[i], ground[i + 1]],
            displacement: [x, y],
            velocity: [v, w],
        }
    };
    (0..ground.len() - 1).map(piece).collect()
}

/// A floor that stays where the ground is feels what the ground does, to the last bit.
#[test]
fn a_floor_that_does_not_move_has_the_spectrum_of_the_ground() {
    let ground: Vec<f64> = (0..800)
        .map(|i| (0.13 * f64::from(i)).sin() * (0.011 * f64::from(i)).sin())
        .collect();
    let motion = pieces(0.01, &ground, |_| [0.0; 2]);
    let periods = [0.05, 0.2, 0.48, 1.0, 3.0];
    let floor = floor_spectrum(&motion, &periods, 0.05).unwrap();
    let unit = AccelerationUnit::MetrePerSecondSquared;
    let record = Accelerogram::new(ground, unit, 0.01).unwrap();
    let expected = response_spectrum(&record, &periods, 0.05, Evaluation::PiecewiseLinear).unwrap();
    assert_eq!(floor, expected);
    // Pieces of other lengths hold the same motion.
    let halves = motion.iter().enumerate().flat_map(|(i, piece)| {
        let part = 0.2 + 0.6 * (i % 7) as f64 / 7.0;
        let [a, b] = piece.ground;
        let middle = a + part * (b - a);
        [(part, [a, middle]), (1.0 - part, [middle, b])].map(|(part, ground)| FloorMotion {
            length: part * piece.length,
            ground,
            ..*piece
        })
    });
    let halves: Vec<FloorMotion> = halves.collect();
    let floor = floor_spectrum(&halves, &periods, 0.05).unwrap();
    for (found, expected) in floor.acceleration.iter().zip(&expected.acceleration) {
        assert!((found / expected - 1.0).abs() < 1e-9, "{found} {expected}");
    }
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
        let motion = pieces(h, &vec![0.0; count + 1], |t| {
            let angle = forcing * t;
            [
                amplitude * (1.0 - angle.cos()),
                amplitude * forcing * angle.sin(),
            ]
        });
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

/// A jump of the velocity of the floor by `V`, as that of a rigid impact, gives equipment at rest the relative motion
/// `-V/wd exp(-z w t) sin(wd t)`, whose damper acts at once: peaks of both to round-off, whatever the pieces, and for
/// damping of which the absolute acceleration is largest at the jump itself, `2 z w V`.
#[test]
fn a_jump_of_the_velocity_has_the_closed_form() {
    let (jump, when, duration) = (0.3, 0.0104, 3.0);
    for count in [3, 40, 3000] {
        let h = (duration - when) / f64::from(count);
        let still = FloorMotion {
            length: when,
            ground: [0.0; 2],
            displacement: [0.0; 2],
            velocity: [0.0; 2],
        };
        let moving = (0..count).map(|i| FloorMotion {
            length: h,
            displacement: [f64::from(i), f64::from(i + 1)].map(|i| jump * h * i),
            velocity: [jump; 2],
            ..still
        });
        let motion: Vec<FloorMotion> = std::iter::once(still).chain(moving).collect();
        for damping in [0.0, 0.05, 0.2, 0.5, 0.9] {
            let periods = [0.01, 0.05, 0.4, 1.7];
            let found = floor_spectrum(&motion, &periods, damping).unwrap();
            for (i, period) in periods.into_iter().enumerate() {
                let w = TAU / period;
                let wd = w * (1.0_f64 - damping * damping).sqrt();
                let mut most = [0.0_f64; 2];
                for k in 0..=200_000 {
                    let t = period * f64::from(k) / 200_000.0;
                    let decay = jump / wd * (-damping * w * t).exp();
                    let u = decay * (wd * t).sin();
                    let v = decay * (wd * (wd * t).cos() - damping * w * (wd * t).sin());
                    most[0] = most[0].max(u.abs());
                    most[1] = most[1].max((w * w * u + 2.0 * damping * w * v).abs());
                }
                for (found, expected) in [found.displacement[i], found.acceleration[i]]
                    .into_iter()
                    .zip(most)
                {
                    let error = found / expected - 1.0;
                    assert!(error.abs() < 1e-8, "{count} {damping} {period}: {error}");
                }
            }
        }
    }
}

#[test]
fn what_has_no_spectrum_is_refused() {
    let piece = |length| FloorMotion {
        length,
        ground: [0.0; 2],
        displacement: [0.0; 2],
        velocity: [0.0; 2],
    };
    for (length, period, damping, part) in [
        (0.0, 0.1, 0.05, "length of a piece"),
        (f64::NAN, 0.1, 0.05, "length of a piece"),
        (0.01, 0.0, 0.05, "period"),
        (0.01, -1.0, 0.05, "period"),
        (0.01, 1e-9, 0.05, "period"),
        (0.01, f64::NAN, 0.05, "period"),
        (0.01, 0.1, 1.0, "damping ratio"),
        (0.01, 0.1, f64::NAN, "damping ratio"),
    ] {
        let error: GroundMotionError =
            floor_spectrum(&[piece(length)], &[period], damping).unwrap_err();
        assert!(error.to_string().contains(part), "{error}");
    }
    // A motion that is no number is no peak of zero.
    for value in [f64::NAN, f64::INFINITY] {
        for (part, change) in [
            ("acceleration of the ground", 0),
            ("displacement of the floor", 1),
            ("velocity of the floor", 2),
        ] {
            let mut wrong = piece(0.01);
            match change {
                0 => wrong.ground[1] = value,
                1 => wrong.displacement[1] = value,
                _ => wrong.velocity[0] = value,
            }
            let motion = [piece(0.01), wrong];
            let error = floor_spectrum(&motion, &[0.1], 0.05).unwrap_err();
            assert!(error.to_string().contains(part), "{error}");
        }
    }
}
