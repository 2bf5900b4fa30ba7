//! Newmark's method and the explicit pair converge to each other on the yielding pair
//! and on the linked pair, with impacts, at the order of the method.

use pounding_hysteresis::LawParameters;
use pounding_time_history::{MethodChoice, System};

use super::setup::{
    ADAPTIVE, difference, el_centro, go, newmark, with_gaps, with_links, yielding_pair,
};

/// Seconds of El Centro.
const DURATION: f64 = 10.0;

/// A bolted joint that slips at some 60 kN in all.
pub fn joint() -> LawParameters {
    LawParameters::from_pairs(&[
        ("density", 4.0e8),
        ("exponent", -0.3),
        ("phi_1", 0.0),
        ("phi_2", 5.0e-3),
        ("slider_stiffness", 2.0e6),
        ("residual_stiffness", 1.0e5),
    ])
}

fn yielding() -> System {
    with_gaps(yielding_pair("elastic_perfectly_plastic", el_centro()))
}

fn linked() -> System {
    with_links(yielding(), "iwan_six_parameter", &joint())
}

fn converge(label: &str, system: &System, method: impl Fn(f64) -> MethodChoice) {
    let exact = go(system, ADAPTIVE, DURATION);
    let tight = go(
        system,
        MethodChoice::Adaptive {
            relative_tolerance: 1.0e-12,
        },
        DURATION,
    );
    let own = difference(&exact, &tight);
    println!(
        "{label}: {} impacts, two tolerances {own:.1e}, residual {:.1e}, {:?}",
        exact.impacts.len(),
        exact.energy.residual_ratio,
        exact.statistics
    );
    assert!(exact.energy.residual_ratio < 1.0e-7, "{label}");
    assert!(own < 1.0e-7, "{label}: {own}");
    let mut points: Vec<(f64, f64)> = Vec::new();
    let mut residual = f64::NAN;
    for step in [4.0e-4, 2.0e-4, 1.0e-4, 0.5e-4] {
        let stepped = go(system, method(step), DURATION);
        let error = difference(&exact, &stepped);
        residual = stepped.energy.residual_ratio;
        println!("{label}: step {step} error {error:.2e}, residual {residual:.1e}");
        points.push((step, error));
    }
    let (first, last) = (points[0], points[points.len() - 1]);
    let order = (first.1 / last.1).ln() / (first.0 / last.0).ln();
    println!("{label}: order {order:.2}");
    assert!(last.1 < 1.0e-5, "{label}: {points:?}");
    // HHT-alpha damps by itself; the average acceleration rule balances.
    if matches!(method(1.0e-3), MethodChoice::Newmark { .. }) {
        assert!(residual < 1.0e-7, "{label}: residual {residual:e}");
    }
    assert!(
        (1.6..2.6).contains(&order),
        "{label}: order {order}, {points:?}"
    );
}

#[test]
fn yielding_pair_by_newmark() {
    converge("yielding, Newmark", &yielding(), newmark);
}

#[test]
fn linked_pair_by_newmark() {
    converge("linked, Newmark", &linked(), newmark);
}

#[test]
fn linked_pair_by_hht() {
    converge("linked, HHT", &linked(), |step| MethodChoice::HhtAlpha {
        step,
        alpha: -0.05,
    });
}
