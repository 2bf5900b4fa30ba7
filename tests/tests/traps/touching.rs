//! Trap 3: buildings that touch at rest. They close at zero speed, where laws scaled by
//! the approach velocity are 0/0; the program divides by 1 mm/s at least.

use pounding_gap_element::{APPROACH_VELOCITY_FLOOR, ModelParameters, registry};
use pounding_time_history::MethodChoice;

use super::case::{Case, Chain, Law, METHODS, go, restless, steady};
use super::exact::{Rules, solve};
use super::integrate::integrate;
use super::{agrees, astray, distance};

const MASS: f64 = 2.0e4;
const PUSH: f64 = 2.0;

/// A body at rest on a wall, which the ground begins to push.
fn resting() -> Case {
    let law = Law::Spring { k: 1.0 };
    Case::wall(Chain::body(MASS), 0, 0.0, law, steady(-PUSH, 51, 0.02))
}

/// Name, stiffness, exponent and damping factor of three published laws
/// `k delta^n (1 + y v / v0)` with a restitution of 0.65.
fn scaled_laws() -> [(&'static str, f64, f64, f64); 3] {
    let e = 0.65;
    [
        ("ye_li_2009", 1.0e8, 1.0, 1.5 * (1.0 - e) / e),
        ("hunt_crossley_1975", 4.0e9, 1.5, 1.5 * (1.0 - e)),
        ("flores_2011", 4.0e9, 1.5, 1.6 * (1.0 - e) / e),
    ]
}

#[test]
fn laws_scaled_by_the_approach_velocity_close_at_rest() {
    for (name, k, n, y) in scaled_laws() {
        let motion = |approach: f64| {
            let law = move |_: f64, s: &[f64], out: &mut [f64]| {
                let delta = s[0].max(0.0);
                out[0] = s[1];
                out[1] = PUSH - k / MASS * delta.powf(n) * (1.0 + y * s[1] / approach);
            };
            integrate(law, &[0.0, 0.0], (1e-7, 1.0), (1e-13, &[1e-6, 1e-4]))
        };
        assert!(motion(0.0).is_none(), "{name}: 0/0 went unnoticed");
        let truth = motion(APPROACH_VELOCITY_FLOOR).unwrap();
        let pairs = [("stiffness", k), ("restitution", 0.65)];
        let build = || registry::build(name, &ModelParameters::from_pairs(&pairs)).unwrap();
        for method in METHODS {
            let outcome = go(&resting().system_with(build().into()), method);
            assert_eq!(outcome.impacts.len(), 1, "{name} {method:?}");
            assert_eq!(outcome.impacts[0].approach_velocity, 0.0, "{name}");
            let end = (&outcome.final_displacement[..], &outcome.final_velocity[..]);
            let error = distance(end, &truth);
            assert!(error < 1e-8, "{name} {method:?}: {error:e}");
        }
    }
}

/// Every registered law, whatever it divides by: a finite motion that respects the wall.
#[test]
fn every_law_closes_at_rest() {
    for descriptor in registry::descriptors() {
        let parameters = descriptor.example_parameters(0.65);
        for method in METHODS {
            let model = registry::build(descriptor.name, &parameters).unwrap();
            let outcome = go(&resting().system_with(model.into()), method);
            assert!(
                !outcome.impacts.is_empty(),
                "{} {method:?}",
                descriptor.name
            );
            let (u, v) = (outcome.final_displacement[0], outcome.final_velocity[0]);
            assert!(
                u.abs() < 0.02 && v.abs() < 0.2,
                "{} {u} {v}",
                descriptor.name
            );
            let force = outcome.gaps[0].levels[0].peak_force.value;
            assert!(
                force >= PUSH * MASS * (1.0 - 1e-9),
                "{} {force}",
                descriptor.name
            );
        }
    }
}

fn touching_pair(law: Law, periods: [f64; 2]) -> Case {
    let chains = periods.map(|t| Chain::single(MASS, t, 0.05));
    Case::pair(chains, 0.0, law, restless(100, 0.05, 1.0, 1.0))
}

/// Two buildings side by side: both start with the acceleration of the ground, so that
/// the gap opens or closes like the fourth power of time. A rule that wants to see the
/// floors apart before they close never sees the first contact.
fn touch_at_rest(law: Law, methods: &[MethodChoice]) {
    let mut closed_at_once = 0;
    for periods in [[0.3, 0.5], [0.5, 0.3]] {
        let case = touching_pair(law, periods);
        let truth = solve(&case, Rules::EXACT);
        let what = format!("{law:?} {periods:?}");
        if truth.impacts[0].closed < 1e-3 {
            closed_at_once += 1;
            let rules = Rules {
                closes_from_apart: true,
                ..Rules::EXACT
            };
            let naive = solve(&case, rules);
            let astray = astray(&naive, &truth);
            let first = naive.impacts.first().map_or(f64::INFINITY, |t| t.closed);
            assert!(
                first > 0.05 && astray > 1e-3,
                "{what}: naive within {astray:e}"
            );
        }
        for method in methods {
            let what = format!("{what} {method:?}");
            agrees(&what, &case.run(*method), &truth, 1e-7);
        }
    }
    assert_eq!(closed_at_once, 1, "{law:?}");
}

const K: f64 = 1.0e8;
const APPROACH_ONLY: Law = Law::ApproachOnly { k: K, zeta: 0.35 };

#[test]
fn pairs_that_touch_at_rest() {
    for law in [
        Law::Spring { k: K },
        Law::KelvinVoigt { k: K, zeta: 0.14 },
        Law::NoTension { k: K, zeta: 0.14 },
        Law::DryFriction {
            k: K,
            friction: 0.4,
        },
    ] {
        touch_at_rest(law, &METHODS);
    }
    touch_at_rest(APPROACH_ONLY, &METHODS);
}
