//! What a reference solution says of a run.

use std::collections::BTreeMap;

use pounding_time_history::{Outcome, Peak};
use serde::Deserialize;

/// Peaks, contacts, impacts and energies of a reference in `data/structures`.
#[derive(Deserialize)]
pub struct Reference {
    outputs: BTreeMap<String, Output>,
    contacts: Vec<Contact>,
    impacts: Vec<Impact>,
    energy: BTreeMap<String, f64>,
}

#[derive(Deserialize)]
struct Output {
    peak: f64,
    time: f64,
}

#[derive(Deserialize)]
struct Contact {
    impacts: usize,
    first_contact: f64,
    peak_force: f64,
    peak_force_time: f64,
}

#[derive(Deserialize)]
struct Impact {
    contact: usize,
    t_close: f64,
    t_open: f64,
    approach_velocity: f64,
    peak_force: f64,
    impulse: f64,
    energy_dissipated: f64,
}

impl Reference {
    /// Peak of a response.
    pub fn peak(&self, name: &str) -> f64 {
        self.outputs[name].peak
    }

    /// All that the reference says, within this relative error of values.
    pub fn agrees(&self, outcome: &Outcome, allowed: f64) {
        let reference = self;
        let near = |what: &str, found: f64, expected: f64, size: f64| {
            let error = (found - expected).abs() / size.abs();
            assert!(
                error <= allowed,
                "{what}: {found} against {expected} ({error:e})"
            );
        };
        let mut peaks: BTreeMap<String, Peak> = BTreeMap::new();
        for building in &outcome.buildings {
            for (i, storey) in building.storeys.iter().enumerate() {
                let place = format!("{}{}", building.name, i + 1);
                peaks.insert(format!("u_{place}"), storey.displacement);
                peaks.insert(format!("a_{place}"), storey.acceleration_absolute);
            }
            for response in &building.responses {
                peaks.insert(response.name.clone(), response.peak);
            }
        }
        for response in &outcome.gaps[0].levels[0].responses {
            if response.name == "relative_ground_displacement" {
                peaks.insert("ground_gap_change".to_owned(), response.peak);
            }
        }
        for (name, expected) in &reference.outputs {
            // The matrices alone do not say how the ground moves.
            let Some(found) = peaks.get(name) else {
                assert_eq!(name, "ground_gap_change");
                continue;
            };
            near(name, found.value, expected.peak, expected.peak);
            // The value is flat around its peak.
            let off = (found.time - expected.time).abs();
            assert!(off < 100.0 * allowed.sqrt(), "{name}: {off:e} s");
        }
        for (level, expected) in outcome.gaps[0].levels.iter().zip(&reference.contacts) {
            assert_eq!(level.impacts, expected.impacts);
            near(
                "force",
                level.peak_force.value,
                expected.peak_force,
                expected.peak_force,
            );
            let first = level.first_contact.unwrap();
            near("first contact", first, expected.first_contact, 1.0);
            assert!((level.peak_force.time - expected.peak_force_time).abs() < 1e-6);
        }
        assert_eq!(outcome.impacts.len(), reference.impacts.len());
        for (found, expected) in outcome.impacts.iter().zip(&reference.impacts) {
            assert_eq!(found.level, expected.contact);
            near("closed", found.time_closed, expected.t_close, 1.0);
            near("opened", found.time_opened, expected.t_open, 1.0);
            let speed = expected.approach_velocity;
            near("approach", found.approach_velocity, speed, speed);
            near(
                "impact",
                found.peak_force.value,
                expected.peak_force,
                expected.peak_force,
            );
            near("impulse", found.impulse, expected.impulse, expected.impulse);
            let (lost, size) = (expected.energy_dissipated, reference.energy["input"]);
            near("loss", found.energy_dissipated, lost, size);
        }
        let (end, energy) = (outcome.energy.end, &reference.energy);
        for (name, found) in [
            ("input", end.input),
            ("kinetic", end.kinetic),
            ("strain", end.strain),
            ("viscous", end.viscous),
            ("impact", end.impact),
        ] {
            let expected = energy[name]
                + if name == "input" {
                    energy["ground_gap"]
                } else {
                    0.0
                };
            near(name, found, expected, energy["input"]);
        }
        let residual = outcome.energy.residual_ratio;
        assert!(residual < 1e-9, "{residual:e}");
    }
}
