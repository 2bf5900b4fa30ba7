//! Trap 7: dry friction that stops the floors holds them. Without the state of sticking
//! the sign of the velocity chatters.

use super::case::{Case, Chain, Law, METHODS};
use super::exact::{GIVE_UP, Rules, solve};
use super::{agrees, near};

const MASS: f64 = 2.0e4;
const STIFFNESS: f64 = 2.0e7;
const FRICTION: f64 = 0.4;
const LAW: Law = Law::DryFriction {
    k: STIFFNESS,
    friction: FRICTION,
};
const TIME_STEP: f64 = 0.1;

/// The push (m/s2) on a body that leans on a wall: steady for two seconds, then falling
/// by as much every two seconds.
fn push(time: f64) -> f64 {
    2.0 - (time - 2.0).max(0.0)
}

fn leaning() -> Case {
    let ground = (0..=60).map(|i| -push(f64::from(i) * TIME_STEP)).collect();
    Case::wall(Chain::body(MASS), 0, 0.0, LAW, (ground, TIME_STEP))
}

/// The push drives the body in from rest, up to twice the penetration at which friction
/// and spring balance it; there it sticks until the push no longer holds the spring
/// less the friction. Time and place in closed form.
#[test]
fn a_body_sticks_until_the_push_is_too_weak() {
    let held = 2.0 * MASS * push(0.0) / (STIFFNESS * (1.0 + FRICTION));
    let turning = std::f64::consts::PI / (STIFFNESS * (1.0 + FRICTION) / MASS).sqrt();
    let loose = 2.0 + push(0.0) - STIFFNESS * (1.0 - FRICTION) * held / MASS;
    let case = leaning();
    let truth = solve(&case, Rules::EXACT);
    assert_eq!(truth.sticks, 1);
    near("held", truth.penetration.0, held, 1e-12);
    near("turning", truth.penetration.1, turning, 1e-6);
    assert!(turning < 0.2 && loose > 2.2 && loose < 2.5, "{loose}");
    let rules = Rules {
        sticks: false,
        ..Rules::EXACT
    };
    let naive = solve(&case, rules);
    assert!(naive.gave_up && naive.events >= GIVE_UP, "{}", naive.events);
    let reversals = reversals_with_a_fixed_step(1e-4);
    assert!(reversals > 1000, "{reversals}");
    for method in METHODS {
        let (outcome, seen) = case.run_sampled(method);
        agrees("leaning", &outcome, &truth, 1e-8);
        near("held", seen, held, 1e-9);
        agrees("leaning", &case.run(method), &truth, 1e-8);
    }
}

/// Sign changes of the velocity while the body should stick, in semi-implicit Euler
/// steps (s) with the sign of the velocity in the force.
fn reversals_with_a_fixed_step(step: f64) -> usize {
    let (mut u, mut v, mut count) = (0.0_f64, 0.0_f64, 0);
    for i in 0..20_000 {
        let sign = if v == 0.0 { 0.0 } else { v.signum() };
        let force = STIFFNESS * u.max(0.0) * (1.0 + FRICTION * sign);
        let before = v;
        v += step * (push(f64::from(i) * step) - force / MASS);
        u += step * v;
        count += usize::from(before * v < 0.0);
    }
    count
}

/// Two storeys under a push that swings: stick, slip up, stick, slip down, part.
#[test]
fn stick_and_slip_in_turns() {
    let chain = Chain {
        mass: vec![MASS; 2],
        stiffness: vec![3.0e7; 2],
        alpha: 0.5,
        beta: 0.0,
    };
    let swinging = |i: i32| {
        let time = 0.05 * f64::from(i);
        -1.5 - 1.2 * (3.0 * time).sin() - 0.4 * (7.1 * time).sin()
    };
    let ground: Vec<f64> = (0..=200).map(swinging).collect();
    let case = Case::wall(chain, 1, 0.0, LAW, (ground, 0.05));
    let truth = solve(&case, Rules::EXACT);
    assert!(truth.sticks > 8, "{}", truth.sticks);
    let rules = Rules {
        sticks: false,
        ..Rules::EXACT
    };
    let naive = solve(&case, rules);
    assert!(naive.gave_up, "{}", naive.events);
    for method in METHODS {
        agrees("swinging", &case.run(method), &truth, 1e-7);
    }
}
