//! Rungs 1 and 3 of the ladder: single collisions of every registered model against
//! closed forms and independent integrations.
//!
//! Origin of the numbers: `tests/data/impact_models.json`.
use pounding_gap_element::{
    AchievedRestitution, Bodies, CollisionOutcome, ImpactModel, ModelParameters, REQUESTED,
    SeparationRule, collide, published::restitution::REFERENCES, registry,
};
use serde_json::Value;

fn data() -> Value {
    serde_json::from_str(include_str!("data/impact_models.json")).unwrap()
}

fn parameters(row: &Value) -> ModelParameters {
    let mut parameters = ModelParameters::default();
    for (name, value) in row["parameters"].as_object().into_iter().flatten() {
        let value = value.as_f64().unwrap();
        parameters.values.insert(name.clone(), value);
    }
    parameters.separation = row["separation"]
        .as_str()
        .and_then(SeparationRule::from_name);
    parameters
}

fn bodies(row: &Value) -> Bodies {
    let number = |key: &str| row["bodies"][key].as_f64();
    Bodies {
        mass_left: number("mass_left").unwrap(),
        mass_right: number("mass_right"),
        velocity_left: number("velocity_left").unwrap(),
        velocity_right: number("velocity_right").unwrap(),
    }
}

fn quantity(out: &CollisionOutcome, name: &str) -> f64 {
    match name {
        "restitution" => out.restitution,
        "peak_force" => out.peak_force,
        "peak_force_time" => out.peak_force_time,
        "peak_penetration" => out.peak_penetration,
        "peak_penetration_time" => out.peak_penetration_time,
        "duration" => out.duration,
        "impulse" => out.impulse,
        "velocity_left" => out.velocity_left,
        "velocity_right" => out.velocity_right,
        "energy_dissipated" => out.energy_dissipated,
        "initial_force" => out.history[0].force,
        "separation_penetration" => {
            let released = out.history.iter().find(|s| s.time >= out.duration);
            released.unwrap().penetration
        }
        other => panic!("unknown quantity {other}"),
    }
}

/// Size against which a quantity is compared: its own, but for those that are small
/// differences of large ones.
fn scale(name: &str, expected: f64, bodies: &Bodies) -> f64 {
    let closing = bodies.velocity_left - bodies.velocity_right;
    let mass = bodies.mass_right.map_or(bodies.mass_left, |m| {
        bodies.mass_left * m / (bodies.mass_left + m)
    });
    match name {
        "separation_penetration" if expected == 0.0 => 1.0e-3,
        "energy_dissipated" => 0.5 * mass * closing * closing,
        "velocity_left" | "velocity_right" => closing,
        // The law may peak at closure itself.
        "peak_force_time" | "initial_force" if expected == 0.0 => 1.0,
        _ => expected.abs(),
    }
}

fn closed_form_agrees(name: &str, law: &dyn ImpactModel, out: &CollisionOutcome) {
    let collision = &out.collision;
    let closed = law.closed_form(collision.approach_velocity, collision.effective_mass);
    let Some(closed) = closed else {
        return;
    };
    let difference = (closed.restitution - out.restitution).abs();
    assert!(difference < 1e-10, "{name}: restitution {difference:e}");
    for (what, closed, integrated) in [
        ("penetration", closed.peak_penetration, out.peak_penetration),
        ("force", closed.peak_force, out.peak_force),
        ("duration", closed.duration, out.duration),
    ] {
        if let Some(closed) = closed {
            let difference = (closed - integrated).abs();
            assert!(
                difference <= 1e-10 * integrated.abs(),
                "{name}: {what} {closed} {integrated}"
            );
        }
    }
}

#[test]
fn every_model_agrees_with_its_reference_values() {
    let data = data();
    let mut failures = Vec::new();
    let mut compared = 0;
    for (name, rows) in data["models"].as_object().unwrap() {
        for row in rows.as_array().unwrap() {
            let law = registry::build(name, &parameters(row)).unwrap();
            let bodies = bodies(row);
            let out = collide(law.as_ref(), &bodies).unwrap();
            let tolerance = row["tolerance"].as_f64().unwrap_or(1e-10);
            for (key, expected) in row["values"].as_object().unwrap() {
                let expected = expected.as_f64().unwrap();
                let computed = quantity(&out, key);
                let error = (computed - expected).abs() / scale(key, expected, &bodies);
                compared += 1;
                if !(error <= tolerance) {
                    failures.push(format!(
                        "{name} {} {}: {key} = {computed:e}, not {expected:e} ({error:.1e})",
                        row["parameters"], row["separation"]
                    ));
                }
            }
            closed_form_agrees(name, law.as_ref(), &out);
        }
    }
    assert!(compared > 700, "{compared} values compared");
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn restitution_tables_by_closed_form_and_by_integration() {
    let bodies = Bodies {
        mass_left: 3.0e4,
        mass_right: None,
        velocity_left: 0.37,
        velocity_right: 0.0,
    };
    for reference in REFERENCES {
        for (e, expected) in REQUESTED.iter().zip(reference.achieved) {
            let mut all = reference.parameters().unwrap();
            all.values.insert("restitution".to_owned(), *e);
            let law = registry::build(reference.model, &all).unwrap();
            let out = collide(law.as_ref(), &bodies).unwrap();
            closed_form_agrees(reference.model, law.as_ref(), &out);
            let error = (out.restitution - expected).abs();
            assert!(
                error <= reference.tolerance,
                "{} {e}: integrated {}, not {expected}: {error:e}",
                reference.model,
                out.restitution
            );
        }
    }
    assert!(REFERENCES.len() >= 35, "{}", REFERENCES.len());
}

/// A law of constant restitution has a table of requested against achieved
/// restitution; every other has single collisions.
#[test]
fn every_registered_model_has_reference_values() {
    let data = data();
    for descriptor in registry::descriptors() {
        let name = descriptor.name;
        let known = |n: &str| n == name || descriptor.aliases.iter().any(|a| a.name == n);
        let filled = |x: &Value| x.as_array().is_some_and(|rows| !rows.is_empty());
        let single = data["models"].as_object().unwrap().iter().any(|(n, rows)| {
            let values = |row: &Value| !row["values"].as_object().unwrap().is_empty();
            known(n) && filled(rows) && rows.as_array().unwrap().iter().all(values)
        });
        let table = REFERENCES.iter().any(|r| known(r.model));
        let constant = descriptor.achieved_restitution == AchievedRestitution::Constant;
        let (wanted, what) = if constant {
            (table, "row in src/published/restitution.rs")
        } else {
            (single, "collision in tests/data/impact_models.json")
        };
        assert!(wanted, "{name} has no {what}");
    }
}

/// The damping that returns exactly what is asked, against roots in 30 digits.
#[test]
fn exact_inverses_to_1e_10() {
    let data = data();
    let inverse = &data["exact_inverse"];
    let (stiffness, mass): (f64, f64) = (2.5e8, 1.6e4);
    for (index, e) in inverse["e"].as_array().unwrap().iter().enumerate() {
        let e = e.as_f64().unwrap();
        let constant = |name: &str, exponent: Option<f64>, separation| {
            let mut all = ModelParameters::from_pairs(&[("stiffness", stiffness)]);
            all.values.insert("restitution".to_owned(), e);
            if let Some(exponent) = exponent {
                all.values.insert("exponent".to_owned(), exponent);
            }
            all.separation = separation;
            let law = registry::build(name, &all).unwrap();
            law.begin(1.0, mass).constants[1]
        };
        let critical = 2.0 * (stiffness * mass).sqrt();
        for (key, computed) in [
            ("y_HC_exact", constant("exact_hunt_crossley", None, None)),
            (
                "y_HC_approach_only_exact",
                constant("exact_hunt_crossley_approach", Some(2.0), None),
            ),
            (
                "zeta_approach_only_exact",
                constant("exact_linear_approach", None, None),
            ),
            (
                "zeta_KV_F0_exact",
                constant("exact_kelvin_voigt", None, None) / critical,
            ),
            (
                "zeta_KV_F0_exact",
                constant("exact_linear", Some(2.5), Some(SeparationRule::NoTension)),
            ),
        ] {
            let expected = inverse[key][index].as_f64().unwrap();
            assert!(
                (computed - expected).abs() <= 1e-10 * expected.max(1e-3),
                "{key}({e}) = {computed}, not {expected}"
            );
        }
    }
}

/// Peak forces of four laws in units of `v0 sqrt(k m)`.
#[test]
fn peak_forces_without_dimension() {
    let data = data();
    let (stiffness, mass, speed): (f64, f64, f64) = (9.35e7, 2.0e4, 0.3);
    let bodies = Bodies {
        mass_left: mass,
        mass_right: None,
        velocity_left: speed,
        velocity_right: 0.0,
    };
    let mut compared = 0;
    for (e, row) in data["peak_force_over_v0_sqrt_km"].as_object().unwrap() {
        for (short, name) in [
            ("anag", "anagnostopoulos_2004"),
            ("mj", "mahmoud_jankowski_2011"),
            ("ye", "ye_li_2009"),
            ("papi", "papi_toopchi_2022"),
        ] {
            let parameters = ModelParameters::from_pairs(&[
                ("stiffness", stiffness),
                ("restitution", e.parse().unwrap()),
            ]);
            let law = registry::build(name, &parameters).unwrap();
            let force = collide(law.as_ref(), &bodies).unwrap().peak_force;
            let ratio = force / (speed * (stiffness * mass).sqrt());
            let expected = row[short].as_f64().unwrap();
            assert!((ratio / expected - 1.0).abs() < 1e-9, "{name} {e}: {ratio}");
            compared += 1;
        }
    }
    assert_eq!(compared, 24);
}
