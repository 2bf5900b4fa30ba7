//! The three-storey pair under a sine: peaks within 0.1 %, first contacts to 1e-6 s.
//!
//! Origin: an independent RK4 with fixed steps of 1 to 2 us whose successive
//! halvings agree to 5 to 6 digits. `a_g = 0.3 g sin(2 pi t / 0.6)` for t < 5 s,
//! then zero, 12 s.
use std::sync::Arc;

use pounding_gap_element::{ModelParameters, SeparationRule, registry};
use pounding_shear_building::{Damping, ShearBuilding};
use pounding_time_history::{Floor, GroundAcceleration, RunOptions, System, run};

/// Samples dense enough for 1e-7 s; the one at the jump carries half of it, so that
/// the impulse of the ramp is that of the jump.
fn sine() -> GroundAcceleration {
    let dt = 2.0e-4;
    let samples: Vec<f64> = (0..=60_000)
        .map(|i| {
            let t = f64::from(i) * dt;
            let a = 0.3 * 9.80665 * (std::f64::consts::TAU * t / 0.6).sin();
            match i {
                0..25_000 => a,
                25_000 => 0.5 * a,
                _ => 0.0,
            }
        })
        .collect();
    GroundAcceleration {
        samples: samples.into(),
        time_step: dt,
    }
}

/// Name, parameters and separation rule of a model.
type Law<'a> = (&'a str, &'a [(&'a str, f64)], Option<SeparationRule>);

fn pair(model: Option<Law<'_>>) -> System {
    let building = |name: &str, m: f64, k: f64, c: f64| {
        let damping = Damping::Dashpots {
            coefficients: vec![c; 3],
        };
        Arc::new(
            ShearBuilding::new(
                name.to_owned(),
                vec![m; 3],
                vec![k; 3],
                vec![3.0; 3],
                damping,
            )
            .unwrap(),
        )
    };
    let mut system = System::new(
        vec![
            building("light", 25e3, 3.460e6, 6.609e4),
            building("heavy", 1000e3, 2.215e9, 1.057e7),
        ],
        sine(),
    );
    if let Some((name, parameters, separation)) = model {
        let mut parameters = ModelParameters::from_pairs(parameters);
        parameters.separation = separation;
        let law: Arc<dyn pounding_gap_element::ImpactModel> =
            registry::build(name, &parameters).unwrap().into();
        let pairs = (0..3)
            .map(|s| {
                (
                    Floor::Storey(0, s),
                    Floor::Storey(1, s),
                    0.02,
                    Arc::clone(&law),
                )
            })
            .collect();
        system
            .add_gap("pair", ["light".to_owned(), "heavy".to_owned()], pairs)
            .unwrap();
    }
    system
}

struct Row {
    displacement: [f64; 4],
    acceleration: [f64; 2],
    force: [f64; 3],
    impacts: [usize; 3],
    /// First contact of the lowest level and half a unit of its last digit (s).
    first_at_1: (f64, f64),
}

fn check(label: &str, model: Law<'_>, row: &Row) {
    let outcome = run(
        &pair(Some(model)),
        &RunOptions::default(),
        &mut [],
        &mut |_| {},
    )
    .unwrap();
    let near = |what: &str, value: f64, expected: f64| {
        assert!(
            (value / expected - 1.0).abs() < 1e-3,
            "{label}: {what} = {value}, not {expected}"
        );
    };
    let (light, heavy) = (&outcome.buildings[0].storeys, &outcome.buildings[1].storeys);
    for (i, expected) in row.displacement[..3].iter().enumerate() {
        near("displacement", light[i].displacement.value, *expected);
    }
    near(
        "heavy roof",
        heavy[2].displacement.value,
        row.displacement[3],
    );
    near(
        "light roof acceleration",
        light[2].acceleration_absolute.value,
        row.acceleration[0],
    );
    near(
        "heavy roof acceleration",
        heavy[2].acceleration_absolute.value,
        row.acceleration[1],
    );
    let levels = &outcome.gaps[0].levels;
    for i in 0..3 {
        near("force", levels[i].peak_force.value, row.force[i]);
    }
    assert_eq!(
        [levels[0].impacts, levels[1].impacts, levels[2].impacts],
        row.impacts,
        "{label}"
    );
    for (level, (expected, print)) in [
        (2, (0.619_953, 5e-7)),
        (1, (0.620_871, 5e-7)),
        (0, row.first_at_1),
    ] {
        let first = levels[level].first_contact.unwrap();
        // 1e-6 s, and what the print rounded off.
        assert!(
            (first - expected).abs() <= 1e-6 + print,
            "{label}: first contact at level {level}: {first}"
        );
    }
    assert!(outcome.energy.residual_ratio < 1e-8, "{label}");
}

#[test]
fn without_contact() {
    let outcome = run(&pair(None), &RunOptions::default(), &mut [], &mut |_| {}).unwrap();
    for (storey, expected) in outcome.buildings[0]
        .storeys
        .iter()
        .zip([0.04631, 0.08485, 0.10813])
    {
        assert!((storey.displacement.value / expected - 1.0).abs() < 1e-3);
    }
}

#[test]
fn jankowski() {
    check(
        "jankowski",
        (
            "jankowski_2005",
            &[("stiffness", 2.75e9), ("damping_ratio", 0.35)],
            None,
        ),
        &Row {
            displacement: [0.114389, 0.194443, 0.228957, 0.0139352],
            acceleration: [138.96, 5.6835],
            force: [4.281e5, 2.0561e6, 3.4590e6],
            impacts: [9, 11, 11],
            first_at_1: (0.648372, 5.0e-7),
        },
    );
}

#[test]
fn kelvin_voigt() {
    let parameters: &[(&str, f64)] = &[("stiffness", 9.35e7), ("restitution", 0.65)];
    check(
        "Kelvin-Voigt",
        ("anagnostopoulos_2004", parameters, None),
        &Row {
            displacement: [0.10354, 0.17811, 0.21135, 0.013227],
            acceleration: [70.60, 5.255],
            force: [2.755e5, 1.122e6, 1.743e6],
            impacts: [9, 11, 11],
            first_at_1: (0.647218, 5.0e-7),
        },
    );
    check(
        "Kelvin-Voigt without tension",
        (
            "anagnostopoulos_2004",
            parameters,
            Some(SeparationRule::NoTension),
        ),
        &Row {
            displacement: [0.10675, 0.18378, 0.21815, 0.013301],
            acceleration: [72.11, 5.289],
            force: [2.869e5, 1.150e6, 1.780e6],
            impacts: [9, 11, 11],
            first_at_1: (0.647218, 5.0e-7),
        },
    );
}

#[test]
fn hertz() {
    check(
        "Hertz",
        ("hertz_1882", &[("stiffness", 2.75e9)], None),
        &Row {
            displacement: [0.19360, 0.33198, 0.39244, 0.016562],
            acceleration: [302.0, 9.705],
            force: [1.327e6, 4.731e6, 7.563e6],
            impacts: [11, 14, 14],
            first_at_1: (0.64755, 5.0e-6),
        },
    );
}
