//! What a reference solution says of a run: the one comparison of all references in
//! `data/structures` that hold peaks, contacts, impacts and energies.

use std::collections::BTreeMap;

use pounding_time_history::{Outcome, Peak};
use serde::Deserialize;
use serde_json::Value;

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

/// A level, counted through all gaps.
#[derive(Deserialize)]
struct Contact {
    impacts: usize,
    first_contact: Option<f64>,
    peak_force: f64,
    peak_force_time: f64,
    peak_penetration: f64,
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

/// How near a run has to come.
#[derive(Debug, Clone, Copy)]
pub struct Within {
    /// Relative error of peaks, forces, penetrations and impulses; of energies over the input.
    pub values: f64,
    /// Relative error of velocities at closure.
    pub approach: f64,
    /// Error of the times of peaks (s): values are flat around their peaks.
    pub peak_times: f64,
    /// Error of the times of maximum forces (s).
    pub force_times: f64,
    /// Error of the time of the first contact (s).
    pub first_contact: f64,
    /// Error of the times at which contacts close and open (s).
    pub impact_times: f64,
    /// Relative error of the loss of every impact, where it is not held against the input alone.
    pub own_loss: f64,
}

impl Within {
    /// This relative error of values, and what it makes of times.
    pub fn all(values: f64) -> Self {
        Self {
            values,
            approach: values,
            peak_times: 100.0 * values.sqrt(),
            force_times: 1e-6,
            first_contact: values,
            impact_times: values,
            own_loss: f64::INFINITY,
        }
    }
}

/// A number of the reference and of the run.
struct Error {
    what: String,
    error: f64,
    of: fn(&Within) -> f64,
}

/// What a run has in the place of an output of the reference.
pub type Found = Option<(f64, Option<f64>)>;

/// A peak with its time.
pub fn found(peak: Peak, factor: f64) -> Found {
    Some((factor * peak.value, Some(peak.time)))
}

impl Reference {
    /// That of a file.
    pub fn read(text: &str) -> Self {
        let file: Value = serde_json::from_str(text).unwrap();
        serde_json::from_value(file["reference"].clone()).unwrap()
    }

    /// Peak of a response.
    pub fn peak(&self, name: &str) -> f64 {
        self.outputs[name].peak
    }

    /// All that the reference says, within this relative error of values.
    pub fn agrees(&self, outcome: &Outcome, allowed: f64) {
        self.agrees_within(outcome, Within::all(allowed), &|_| None);
    }

    /// The same with outputs that the names of buildings and storeys do not lead to.
    pub fn agrees_within(
        &self,
        outcome: &Outcome,
        within: Within,
        further: &dyn Fn(&str) -> Found,
    ) {
        for Error { what, error, of } in self.errors(outcome, further) {
            assert!(error <= of(&within), "{what}: {error:e}, {within:?}");
        }
        let residual = outcome.energy.residual_ratio;
        assert!(residual < 1e-9, "{residual:e}");
    }

    /// The largest error of all values (-) and of the times of contacts (s).
    pub fn largest_error(&self, outcome: &Outcome, further: &dyn Fn(&str) -> Found) -> f64 {
        let counted = Within {
            values: 1.0,
            approach: 1.0,
            first_contact: 1.0,
            impact_times: 1.0,
            ..Within::all(0.0)
        };
        let errors = self.errors(outcome, further).into_iter();
        let errors = errors.filter(|e| (e.of)(&counted) == 1.0);
        errors.map(|e| e.error).fold(0.0, f64::max)
    }

    fn errors(&self, outcome: &Outcome, further: &dyn Fn(&str) -> Found) -> Vec<Error> {
        let mut errors = Vec::new();
        let mut add = |what: &str, difference: f64, size: f64, of: fn(&Within) -> f64| {
            errors.push(Error {
                what: what.to_owned(),
                error: (difference / size).abs(),
                of,
            });
        };
        let peaks = peaks(outcome);
        for (name, expected) in &self.outputs {
            let own = peaks.get(name).map(|p| (p.value, Some(p.time)));
            // The matrices alone do not say how the ground moves.
            let Some((value, time)) = own.or_else(|| further(name)) else {
                assert_eq!(name, "ground_gap_change");
                continue;
            };
            add(name, value - expected.peak, expected.peak, |w| w.values);
            if let Some(time) = time {
                add(name, time - expected.time, 1.0, |w| w.peak_times);
            }
        }
        let levels = || outcome.gaps.iter().flat_map(|gap| &gap.levels);
        assert_eq!(levels().count(), self.contacts.len());
        for (level, expected) in levels().zip(&self.contacts) {
            assert_eq!(level.impacts, expected.impacts);
            let Some(first) = expected.first_contact.filter(|_| expected.impacts > 0) else {
                continue;
            };
            let (force, deep) = (expected.peak_force, expected.peak_penetration);
            add("force", level.peak_force.value - force, force, |w| w.values);
            let at = level.peak_force.time - expected.peak_force_time;
            add("time of the force", at, 1.0, |w| w.force_times);
            let off = level.peak_penetration.value - deep;
            add("penetration", off, deep, |w| w.values);
            let off = level.first_contact.unwrap() - first;
            add("first contact", off, 1.0, |w| w.first_contact);
        }
        assert_eq!(outcome.impacts.len(), self.impacts.len());
        let input = self.energy["input"];
        for (impact, expected) in outcome.impacts.iter().zip(&self.impacts) {
            let before = outcome.gaps[..impact.gap].iter().map(|g| g.levels.len());
            assert_eq!(before.sum::<usize>() + impact.level, expected.contact);
            let (closed, opened) = (impact.time_closed, impact.time_opened);
            add("closed", closed - expected.t_close, 1.0, |w| w.impact_times);
            add("opened", opened - expected.t_open, 1.0, |w| w.impact_times);
            let speed = expected.approach_velocity;
            add("approach", impact.approach_velocity - speed, speed, |w| {
                w.approach
            });
            let force = expected.peak_force;
            add("impact", impact.peak_force.value - force, force, |w| {
                w.values
            });
            let impulse = expected.impulse;
            add("impulse", impact.impulse - impulse, impulse, |w| w.values);
            let lost = expected.energy_dissipated;
            let off = impact.energy_dissipated - lost;
            add("loss", off, input, |w| w.values);
            if lost > 1e-6 * input {
                add("loss by itself", off, lost, |w| w.own_loss);
            }
        }
        let end = outcome.energy.end;
        for (name, found) in [
            ("input", end.input),
            ("kinetic", end.kinetic),
            ("strain", end.strain),
            ("viscous", end.viscous),
            ("hysteretic", end.hysteretic),
            ("impact", end.impact),
        ] {
            let of_ground = if name == "input" {
                self.energy["ground_gap"]
            } else {
                0.0
            };
            add(name, found - self.energy[name] - of_ground, input, |w| {
                w.values
            });
        }
        errors
    }
}

/// Peaks by the names that references give them.
fn peaks(outcome: &Outcome) -> BTreeMap<String, Peak> {
    let mut peaks = BTreeMap::new();
    for building in &outcome.buildings {
        let name = &building.name;
        for (i, storey) in building.storeys.iter().enumerate() {
            let place = format!("{name}{}", i + 1);
            peaks.insert(format!("u_{place}"), storey.displacement);
            peaks.insert(format!("a_{place}"), storey.acceleration_absolute);
            peaks.insert(format!("shear_{place}"), storey.storey_shear);
        }
        if let Some(moment) = building.base_moment {
            peaks.insert(format!("base_moment_{name}"), moment);
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
    peaks
}
