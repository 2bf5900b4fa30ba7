//! Trap 8: the approach velocity of a collision is that of its located closure and
//! holds until its end. Taken from the first look inside the contact, or kept in a side
//! variable of the equations of motion that trial steps write to, it is another one.

use std::cell::Cell;

use pounding_gap_element::{ModelParameters, registry};
use pounding_time_history::{MethodChoice, Outcome, RunOptions, run};

use super::case::{Case, Chain, Law, METHODS, steady};
use super::integrate::integrate;
use super::{distance, near};

const MASS: f64 = 2.0e4;
const STIFFNESS: f64 = 2.0e7;
const RESTITUTION: f64 = 0.5;
/// Damping factor of Ye and Li (2009), equation 10.
const FACTOR: f64 = 1.5 * (1.0 - RESTITUTION) / RESTITUTION;
/// Acceleration towards the wall (m/s2) and way to it (m).
const PULL: f64 = 8.0;
const GAP: f64 = 0.01;
/// Step of the record, and of the naive look (s).
const TIME_STEP: f64 = 0.02;
/// Time from closure to the end of the run (s): turning points, but no separation.
const WITHIN: f64 = 0.3;

fn law(state: &[f64], approach: f64) -> f64 {
    let delta = (state[0] - GAP).max(0.0);
    PULL - STIFFNESS / MASS * delta * (1.0 + FACTOR * state[1] / approach)
}

/// From a state with its approach velocity over a time.
fn in_contact(state: &[f64], approach: f64, time: f64) -> Vec<f64> {
    let motion = |_: f64, s: &[f64], out: &mut [f64]| {
        out[0] = s[1];
        out[1] = law(s, approach);
    };
    integrate(motion, state, (1e-5, time), (1e-13, &[1e-4, 1e-2])).unwrap()
}

fn falls(method: MethodChoice, end: f64) -> Outcome {
    let case = Case::wall(
        Chain::body(MASS),
        0,
        GAP,
        Law::Spring { k: STIFFNESS },
        steady(-PULL, 31, TIME_STEP),
    );
    let pairs = [("stiffness", STIFFNESS), ("restitution", RESTITUTION)];
    let model = registry::build("ye_li_2009", &ModelParameters::from_pairs(&pairs)).unwrap();
    let options = RunOptions {
        method,
        duration: Some(end),
        ..RunOptions::default()
    };
    run(
        &case.system_with(model.into()),
        &options,
        &mut [],
        &mut |_| {},
    )
    .unwrap()
}

/// A body falls on the wall and swings there under its own weight.
#[test]
fn approach_velocity_is_that_of_closure() {
    let speed = (2.0 * PULL * GAP).sqrt();
    let closure = speed / PULL;
    let end = closure + WITHIN;
    let truth = in_contact(&[GAP, speed], speed, WITHIN);
    for method in METHODS {
        let outcome = falls(method, end);
        assert_eq!(outcome.impacts.len(), 1, "{method:?}");
        let impact = &outcome.impacts[0];
        assert!(impact.time_opened.is_nan(), "{impact:?}");
        near("closure", impact.time_closed, closure, 1e-11);
        near("approach", impact.approach_velocity, speed, 1e-11);
        let (u, v) = (&outcome.final_displacement, &outcome.final_velocity);
        let error = distance((u, v), &truth);
        assert!(error < 1e-8, "{method:?}: {error:e}");
    }
    for (what, naive) in [
        ("first look", first_look(closure, end)),
        ("side variable", side_variable(end)),
    ] {
        let error = distance((&naive[..1], &naive[1..]), &truth);
        assert!(error > 0.1, "{what}: naive within {error:e}");
    }
}

/// The first sample inside the contact sets the approach velocity; exact otherwise.
fn first_look(closure: f64, end: f64) -> Vec<f64> {
    let look = (closure / TIME_STEP).ceil() * TIME_STEP;
    let approach = PULL * look;
    let speed = PULL * closure;
    in_contact(&[GAP, speed], approach, end - closure)
}

/// The derivative itself notes the velocity when it first sees a penetration, in
/// whatever stage of whatever trial step, and forgets it when the floors are apart.
fn side_variable(end: f64) -> Vec<f64> {
    let noted: Cell<Option<f64>> = Cell::new(None);
    let motion = |_: f64, s: &[f64], out: &mut [f64]| {
        if s[0] <= GAP && s[1] < 0.0 {
            noted.set(None);
        } else if s[0] > GAP && noted.get().is_none() {
            noted.set(Some(s[1]));
        }
        out[0] = s[1];
        out[1] = law(s, noted.get().unwrap_or(1.0));
    };
    integrate(motion, &[0.0, 0.0], (1e-3, end), (1e-10, &[1e-2, 1e-1])).unwrap()
}
