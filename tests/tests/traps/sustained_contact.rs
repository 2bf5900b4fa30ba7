//! Trap 1 in contact: event functions that go to the other side and back within one
//! step. Penetration, velocity, force and margin of sticking each have a test.

use pounding_gap_element::{ModelParameters, registry};
use verification::{ReferenceLink, reference_cases, reference_system_with, synthetic_motion};

use super::case::{Case, Chain, Law, METHODS, go, steady};
use super::exact::{Rules, solve};
use super::{agrees, astray, near};

/// One look a sample.
const SAMPLE: f64 = 0.02;

/// Two storeys whose roof the ground presses against a wall while the lower floor,
/// hardly damped, swings with a period of about 0.09 s, at first with this speed (m/s).
fn pressed(law: Law, swing: f64, samples: usize) -> Case {
    let chain = Chain {
        mass: vec![2.0e4, 2.0e4],
        stiffness: vec![5.0e7, 5.0e7],
        alpha: 0.02,
        beta: 0.0,
    };
    let ground = steady(-2.0, samples, SAMPLE);
    Case::wall(chain, 1, 0.0, law, ground).from(&[0.0, 0.0, swing, 0.01])
}

/// Penetration: an elastic body bounces on its own spring under a steady push, apart
/// for 2 ms once in 0.31 s. Impacts in closed form.
#[test]
fn brief_separations_within_contact() {
    let (push, speed, omega) = (1.0, 1e-3, 20.0_f64);
    let mass = 2.0e4;
    let law = Law::Spring {
        k: mass * omega * omega,
    };
    let case = Case::wall(Chain::body(mass), 0, 0.0, law, steady(-push, 501, SAMPLE));
    let case = case.from(&[0.0, speed]);
    let angle = (speed * omega / push).atan();
    let contact = (std::f64::consts::TAU - 2.0 * angle) / omega;
    let flight = 2.0 * speed / push;
    assert!(flight < 0.11 * SAMPLE);
    let expected = (10.0 / (contact + flight)).ceil() as usize;
    let naive = solve(&case, Rules::ends_of_steps(SAMPLE));
    assert!(
        2 * naive.impacts.len() < expected,
        "{}",
        naive.impacts.len()
    );
    let truth = solve(&case, Rules::EXACT);
    for method in METHODS {
        let outcome = case.run(method);
        agrees("bouncing", &outcome, &truth, 1e-7);
        assert_eq!(outcome.impacts.len(), expected);
        for (n, impact) in outcome.impacts.iter().enumerate() {
            let closed = n as f64 * (contact + flight);
            assert!(
                (impact.time_closed - closed).abs() < 1e-8,
                "{n}: {impact:?}"
            );
        }
    }
}

/// Two swings a part in 1e9 apart, from `few` to `many` events: with the latter an
/// event function just grazes.
fn graze(case: &dyn Fn(f64) -> Case, few: f64, many: f64) -> (f64, f64) {
    let events = |swing| solve(&case(swing), Rules::EXACT).events;
    let (mut few, mut many) = (few, many);
    let base = events(few);
    assert!(events(many) > base, "{base} events throughout");
    while (many - few).abs() > 1e-9 * many.abs() {
        let middle = 0.5 * (few + many);
        if events(middle) == base {
            few = middle;
        } else {
            many = middle;
        }
    }
    (few, many)
}

/// The program finds the pair of events that a graze by a part in 1e8 brings, and none
/// where it is missed by as much. Sampling misses it.
fn finds_the_graze(what: &str, case: &dyn Fn(f64) -> Case, few: f64, many: f64) {
    let (few, many) = graze(case, few, many);
    let aside = 1e-8 * (many.abs() - few.abs()).signum();
    let swings = [few * (1.0 - aside), many * (1.0 + aside)];
    let truths = swings.map(|swing| solve(&case(swing), Rules::EXACT));
    assert_eq!(truths[0].events + 2, truths[1].events, "{what}: one pair");
    let naive = solve(&case(swings[1]), Rules::ends_of_steps(SAMPLE));
    assert_eq!(
        naive.events, truths[0].events,
        "{what}: sampling sees it too"
    );
    for (swing, truth) in swings.into_iter().zip(&truths) {
        for method in METHODS {
            let outcome = case(swing).run(method);
            let what = format!("{what}, swing {swing}, {method:?}");
            let events = usize::try_from(outcome.statistics.events).unwrap();
            assert_eq!(events, truth.events, "{what}");
            agrees(&what, &outcome, truth, 1e-7);
        }
    }
}

/// Sampling misses pairs of events within impacts that it sees, and ends elsewhere.
fn sampling_goes_astray(what: &str, case: &Case) {
    let truth = solve(case, Rules::EXACT);
    let naive = solve(case, Rules::ends_of_steps(SAMPLE));
    assert_eq!(naive.impacts.len(), truth.impacts.len(), "{what}");
    assert!(naive.events + 2 <= truth.events, "{what}: {}", naive.events);
    let astray = astray(&naive, &truth);
    assert!(astray > 1e-3, "{what}: naive within {astray:e}");
    for method in METHODS {
        agrees(what, &case.run(method), &truth, 1e-7);
    }
}

/// Velocity: damping in approach alone has to come on for a floor that turns twice
/// between two looks.
#[test]
fn velocity_up_and_down() {
    let law = Law::ApproachOnly { k: 1e8, zeta: 0.3 };
    let case = |swing| pressed(law, swing, 101);
    finds_the_graze("velocity", &case, 1.25, 1.2);
    for swing in [1.3, 1.35, 1.4, 1.45] {
        sampling_goes_astray(&format!("velocity, swing {swing}"), &case(swing));
    }
}

/// Force: a contact without tension lets go and takes hold again between two looks.
#[test]
fn force_that_dips_below_zero() {
    let law = Law::NoTension { k: 1e8, zeta: 0.6 };
    let case = |swing| pressed(law, swing, 41);
    finds_the_graze("force", &case, 0.35, 0.4);
    for swing in [0.4, 0.5, 0.7, 0.8, 0.9, 1.1, 1.3] {
        sampling_goes_astray(&format!("force, swing {swing}"), &case(swing));
    }
}

/// Margin of sticking: the swing of the lower floor breaks the roof loose for a moment
/// at its crests, and friction takes hold again before the next look.
#[test]
fn margin_of_sticking_exceeded_for_a_moment() {
    let law = Law::DryFriction {
        k: 1e8,
        friction: 0.3,
    };
    // Stuck under a steady push, which a few samples then raise or lower.
    let hump = |hump: f64| {
        let mut case = pressed(law, 0.0, 101);
        case.chains[0].alpha = 7.0;
        case.ground[60..64].iter_mut().for_each(|a| *a -= hump);
        case
    };
    finds_the_graze("upper margin", &hump, 0.0, 0.9);
    finds_the_graze("lower margin", &hump, 0.0, -0.5);
    let case = |swing| pressed(law, swing, 101);
    for (swing, missed) in [(0.18, 10), (0.2, 10), (0.24, 8), (0.25, 10)] {
        let truth = solve(&case(swing), Rules::EXACT);
        let naive = solve(&case(swing), Rules::ends_of_steps(SAMPLE));
        assert!(
            naive.sticks + missed <= truth.sticks,
            "{swing}: {}",
            naive.sticks
        );
        assert!(astray(&naive, &truth) > 5e-4, "{swing}");
        for method in METHODS {
            let what = format!("sticking, swing {swing}");
            agrees(&what, &case(swing).run(method), &truth, 1e-7);
        }
    }
}

/// The law with damping in approach on the eight-storey pair, contacts a hundred times
/// stiffer: 180 impacts, a number measured with a prototype of the method, which had 179
/// as long as it looked at velocities at the ends of steps alone. Two methods that share
/// no step in flight have to agree.
#[test]
fn a_stiff_reference_case_keeps_all_its_impacts() {
    let cases = reference_cases().unwrap();
    let stiffer = |link: &ReferenceLink| {
        let pairs = [("stiffness", 100.0 * link.k_lin), ("restitution", link.e)];
        let parameters = ModelParameters::from_pairs(&pairs);
        Ok(registry::build("mahmoud_jankowski_2011", &parameters)?.into())
    };
    let ground = synthetic_motion().unwrap();
    let system = reference_system_with(&cases.cases["C3a"], &stiffer, ground, 1.0).unwrap();
    let [exact, adaptive] = METHODS.map(|method| go(&system, method));
    for outcome in [&exact, &adaptive] {
        assert_eq!(outcome.impacts.len(), 180);
    }
    let storeys = |b: usize| {
        exact.buildings[b]
            .storeys
            .iter()
            .zip(&adaptive.buildings[b].storeys)
    };
    for (a, b) in storeys(0).chain(storeys(1)) {
        near(
            "displacement",
            a.displacement.value,
            b.displacement.value,
            1e-8,
        );
    }
    for (a, b) in exact.impacts.iter().zip(&adaptive.impacts) {
        assert!((a.time_closed - b.time_closed).abs() < 1e-8, "{a:?} {b:?}");
    }
}
