//! Rungs 1 and 3 of the ladder: single collisions against closed forms.
//!
//! Origin of the numbers: `tests/data/single_collisions.json`.
#![allow(clippy::unwrap_used)]

use pounding_gap_element::{
    Bodies, ImpactModel, ModelParameters, SeparationRule, collide, registry,
};
use serde_json::Value;

fn data() -> Value {
    serde_json::from_str(include_str!("data/single_collisions.json")).unwrap()
}

fn model(name: &str, separation: &str, stiffness: f64, e: Option<f64>) -> Box<dyn ImpactModel> {
    let mut parameters = ModelParameters::from_pairs(&[("stiffness", stiffness)]);
    if let Some(e) = e {
        parameters.values.insert("restitution".to_owned(), e);
    }
    parameters.separation = SeparationRule::from_name(separation);
    registry::build(name, &parameters).unwrap()
}

#[test]
fn reference_collisions_to_1e_9() {
    let data = data();
    let bodies = Bodies {
        mass_left: 25e3,
        mass_right: Some(40e3),
        velocity_left: 0.6,
        velocity_right: -0.2,
    };
    let mut failures = Vec::new();
    let mut compared = 0;
    for row in data["collisions"].as_array().unwrap() {
        let name = row["model"].as_str().unwrap();
        let e = row["restitution"].as_f64().unwrap();
        let given = (!row["elastic"].as_bool().unwrap()).then_some(e);
        let law = model(
            name,
            row["separation"].as_str().unwrap(),
            row["stiffness"].as_f64().unwrap(),
            given,
        );
        let out = collide(law.as_ref(), &bodies).unwrap();
        let values = &row["values"];
        for (key, computed) in [
            ("e_post", out.restitution),
            ("F_max", out.peak_force),
            ("t_Fmax", out.peak_force_time),
            ("d_max", out.peak_penetration),
            ("t_dmax", out.peak_penetration_time),
            ("t_contact", out.duration),
            ("impulse", out.impulse),
            ("v1_after", out.velocity_left),
            ("v2_after", out.velocity_right),
            ("E_diss", out.energy_dissipated),
        ] {
            let Some(expected) = values[key].as_f64() else {
                continue;
            };
            compared += 1;
            // Elastic losses are zero: held against the kinetic energy.
            let scale = if key == "E_diss" {
                expected.abs().max(4923.0)
            } else {
                expected.abs()
            };
            let error = if expected == 0.0 && scale == 0.0 {
                computed.abs()
            } else {
                (computed - expected).abs() / scale
            };
            if !(error <= 1e-9) {
                failures.push(format!(
                    "{name} e={e} {}: {key} = {computed:e}, not {expected:e} ({error:.1e})",
                    row["separation"]
                ));
            }
        }
        let closed = law.closed_form(0.8, 25e3 * 40e3 / 65e3).unwrap();
        assert!(
            (closed.restitution - out.restitution).abs() < 1e-10,
            "{name}: closed form {}",
            closed.restitution
        );
        if let Some(peak) = closed.peak_penetration {
            assert!(
                (peak / out.peak_penetration - 1.0).abs() < 1e-10,
                "{name}: peak penetration {peak}"
            );
        }
        if let Some(duration) = closed.duration {
            assert!(
                (duration / out.duration - 1.0).abs() < 1e-10,
                "{name}: duration {duration} {}",
                out.duration
            );
        }
    }
    assert!(compared > 100, "{compared} values compared");
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn restitution_tables_by_closed_form_and_by_integration() {
    let data = data();
    let requested: Vec<f64> = data["e_pre"]
        .as_array()
        .unwrap()
        .iter()
        .map(|x| x.as_f64().unwrap())
        .collect();
    let bodies = Bodies {
        mass_left: 3.0e4,
        mass_right: None,
        velocity_left: 0.37,
        velocity_right: 0.0,
    };
    let mut rows = 0;
    for table in data["tables"].as_array().unwrap() {
        let name = table["model"].as_str().unwrap();
        for (e, expected) in requested.iter().zip(table["e_post"].as_array().unwrap()) {
            let expected = expected.as_f64().unwrap();
            let law = model(name, table["separation"].as_str().unwrap(), 1.0e9, Some(*e));
            let closed = law.closed_form(0.37, 3.0e4).unwrap().restitution;
            let integrated = collide(law.as_ref(), &bodies).unwrap().restitution;
            assert!(
                (closed - expected).abs() < 1e-9,
                "{name} {e}: closed {closed}, not {expected}"
            );
            assert!(
                (integrated - expected).abs() < 1e-9,
                "{name} {e}: integrated {integrated}, not {expected}"
            );
            rows += 1;
        }
    }
    assert!(rows >= 60, "{rows}");
}

/// Borovin, Lapshin and Yurin 2014: rubber ball on concrete.
#[test]
fn ball_on_concrete() {
    let data = &data()["dry_friction"];
    let parameters = ModelParameters::from_pairs(&[
        ("stiffness", data["c"].as_f64().unwrap()),
        ("friction", 0.3),
    ]);
    let law = registry::build("borovin_2014", &parameters).unwrap();
    for row in data["rows"].as_array().unwrap() {
        let v = row["V"].as_f64().unwrap();
        let bodies = Bodies {
            mass_left: 0.1,
            mass_right: None,
            velocity_left: v,
            velocity_right: 0.0,
        };
        let out = collide(law.as_ref(), &bodies).unwrap();
        for (key, computed) in [
            ("x_max", out.peak_penetration),
            ("t_compression", out.peak_penetration_time),
            ("duration", out.duration),
            ("F_max_compression_end", out.peak_force),
            ("V_plus", out.restitution * v),
        ] {
            let expected = row[key].as_f64().unwrap();
            assert!(
                (computed / expected - 1.0).abs() < 1e-9,
                "V = {v}: {key} = {computed}, not {expected}"
            );
        }
    }
}
