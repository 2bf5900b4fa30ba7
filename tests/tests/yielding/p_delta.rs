//! P-Delta against what it is: a spring of negative stiffness beside the storey.

use std::sync::Arc;

use pounding_hysteresis::LawParameters;
use pounding_shear_building::{Damping, ShearBuilding, StoreyLaw};
use pounding_time_history::{Outcome, RunOptions, System, TimeHistoryError, run};

use verification::constant_ground;

use super::setup::{ADAPTIVE, EVENT_DRIVEN, el_centro, go, law, newmark};

const GRAVITY: f64 = 9.80665;
const MASS: f64 = 25.0e3;
const HEIGHT: f64 = 3.0;
const STIFFNESS: f64 = 1.0e6;
const YIELD_FORCE: f64 = 5.0e4;

fn oscillator(stiffness: f64, gravity: f64, stored: StoreyLaw) -> System {
    let building = storey((stiffness, 1.5e4), gravity, stored);
    System::new(vec![Arc::new(building)], el_centro())
}

fn storey((stiffness, dashpot): (f64, f64), gravity: f64, stored: StoreyLaw) -> ShearBuilding {
    let damping = Damping::Dashpots {
        coefficients: vec![dashpot],
    };
    ShearBuilding::under_gravity(
        "frame".to_owned(),
        vec![MASS],
        vec![stiffness],
        vec![HEIGHT],
        damping,
        gravity,
    )
    .unwrap()
    .with_laws(vec![Some(stored)])
    .unwrap()
}

fn end(outcome: &Outcome) -> (f64, f64) {
    let peak = outcome.buildings[0].storeys[0].displacement.value;
    (peak, outcome.final_displacement[0])
}

/// Elastic-perfectly-plastic under gravity is bilinear with a falling branch.
#[test]
fn elastic_plastic_under_gravity_is_bilinear_with_a_falling_branch() {
    let geometric = MASS * GRAVITY / HEIGHT;
    let plain =
        LawParameters::from_pairs(&[("stiffness", STIFFNESS), ("yield_force", YIELD_FORCE)]);
    let lateral = STIFFNESS - geometric;
    let falling = LawParameters::from_pairs(&[
        ("stiffness", lateral),
        ("yield_force", YIELD_FORCE * lateral / STIFFNESS),
        ("hardening_ratio", -geometric / lateral),
    ]);
    let under_gravity = oscillator(STIFFNESS, GRAVITY, law("elastic_perfectly_plastic", &plain));
    let equal = oscillator(lateral, 0.0, law("bilinear", &falling));
    let without = oscillator(STIFFNESS, 0.0, law("elastic_perfectly_plastic", &plain));
    for (method, tolerance) in [(ADAPTIVE, 1.0e-9), (newmark(5.0e-4), 1.0e-9)] {
        let outcome = go(&under_gravity, method, 12.0);
        let (a, b) = (end(&outcome), end(&go(&equal, method, 12.0)));
        println!(
            "P-Delta: {a:?}, falling branch: {b:?}, residual {:e}",
            outcome.energy.residual_ratio
        );
        assert!((a.0 / b.0 - 1.0).abs() < tolerance);
        assert!((a.1 - b.1).abs() < tolerance * b.0);
        // Gravity matters here: a test that forgets it must fail.
        let c = end(&go(&without, method, 12.0));
        assert!((a.1 - c.1).abs() > 0.1 * c.0, "{a:?} {c:?}");
        // The column carries no more than it can.
        let shear = outcome.buildings[0].storeys[0].storey_shear.value;
        assert!((shear / YIELD_FORCE - 1.0).abs() < 1.0e-9, "{shear}");
    }
}

/// Period of a linear building: `2 pi sqrt(m / (k - P / h))`.
#[test]
fn gravity_lengthens_the_period() {
    let building = ShearBuilding::under_gravity(
        "frame".to_owned(),
        vec![MASS],
        vec![STIFFNESS],
        vec![HEIGHT],
        Damping::MassProportional { ratio: 0.05 },
        GRAVITY,
    )
    .unwrap();
    let lateral = STIFFNESS - MASS * GRAVITY / HEIGHT;
    let period = std::f64::consts::TAU * (MASS / lateral).sqrt();
    assert!((building.modes().period[0] / period - 1.0).abs() < 1.0e-12);
    // The ledger counts what gravity gives.
    let system = System::new(vec![Arc::new(building)], el_centro());
    let outcome = go(&system, ADAPTIVE, 12.0);
    assert!(outcome.energy.residual_ratio < 1.0e-9);
}

/// Too weak to stand: the run ends where the drift passes the storey height.
#[test]
fn a_collapse_is_told_with_time_and_storey() {
    let weak = LawParameters::from_pairs(&[("stiffness", STIFFNESS), ("yield_force", 2.0e4)]);
    let system = oscillator(STIFFNESS, GRAVITY, law("elastic_perfectly_plastic", &weak));
    let error = run(&system, &RunOptions::default(), &mut [], &mut |_| {}).unwrap_err();
    let TimeHistoryError::Collapse { time, storey, .. } = error else {
        panic!("{error}");
    };
    assert!(storey == 1 && time > 2.0 && time < 20.0, "{time}");
}

/// Where the drift passes the height is found inside the step: a storey thrown at 1 m/s, which
/// yields at once, against its solution `A cosh(q t) + B sinh(q t) + C` beyond yielding, whatever the
/// length of the record's steps.
#[test]
fn the_time_of_a_collapse_is_located() {
    let (force, speed) = (1.0e4, 1.0);
    let parameters = LawParameters::from_pairs(&[("stiffness", STIFFNESS), ("yield_force", force)]);
    // Up to yielding a stiff spring, then u'' = (P / h u - F) / m.
    let lateral = STIFFNESS / MASS - GRAVITY / HEIGHT;
    let (omega, yielding) = (lateral.sqrt(), force / STIFFNESS);
    let until = (yielding * omega / speed).asin() / omega;
    let rate = speed * (omega * until).cos();
    let q = (GRAVITY / HEIGHT).sqrt();
    let level = force * HEIGHT / (MASS * GRAVITY);
    let drift = |t: f64| (yielding - level) * (q * t).cosh() + rate / q * (q * t).sinh() + level;
    let (mut low, mut high) = (0.0, 60.0);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if drift(middle) > HEIGHT {
            high = middle;
        } else {
            low = middle;
        }
    }
    let expected = until + high;
    for duration in [5.0, 20.0, 500.0] {
        let law = law("elastic_perfectly_plastic", &parameters);
        let building = storey((STIFFNESS, 0.0), GRAVITY, law);
        let system = System::new(vec![Arc::new(building)], constant_ground(0.0, duration));
        let system = system.with_initial_state(&[0.0], &[speed]).unwrap();
        for method in [ADAPTIVE, EVENT_DRIVEN] {
            let options = RunOptions {
                method,
                ..RunOptions::default()
            };
            let error = run(&system, &options, &mut [], &mut |_| {}).unwrap_err();
            let TimeHistoryError::Collapse { time, .. } = error else {
                panic!("{error}");
            };
            assert!(
                (time - expected).abs() < 1.0e-7,
                "{method:?}, {duration}: {time}, not {expected}"
            );
        }
    }
}

/// A storey whose weight over its height exceeds its stiffness cannot stand.
#[test]
fn a_building_that_gravity_overturns_is_refused() {
    let error = ShearBuilding::under_gravity(
        "tower".to_owned(),
        vec![1.0e5; 2],
        vec![1.0e6, 3.0e5],
        vec![3.0; 2],
        Damping::MassProportional { ratio: 0.05 },
        GRAVITY,
    )
    .unwrap_err();
    assert!(error.to_string().contains("storey 2"), "{error}");
}
