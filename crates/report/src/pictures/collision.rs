//! Collisions of two bodies.

use pounding_gap_element::laboratory::MeasuredForce;
use pounding_gap_element::{CollisionOutcome, CollisionSample, RestitutionTable};

use super::panel;
use crate::chart::Chart;
use crate::figure::{Curve, Reference, figure_with_references};

/// Force over time, force over penetration and penetration over time of named models, which
/// have a force history; a measured force, if there is one, beside the first.
pub fn histories(models: &[(&str, &CollisionOutcome)], measured: Option<&MeasuredForce>) -> Chart {
    type Axis = fn(&CollisionSample) -> f64;
    let curves = |horizontal: Axis, vertical: Axis| -> Vec<Curve> {
        let curve = |(name, outcome): &(&str, &CollisionOutcome)| {
            let samples = outcome.history.iter();
            Curve {
                name: (*name).to_owned(),
                points: samples.map(|s| (horizontal(s), vertical(s))).collect(),
            }
        };
        models.iter().map(curve).collect()
    };
    let time: Axis = |s| s.time * 1e3;
    let penetration: Axis = |s| s.penetration * 1e3;
    let force: Axis = |s| s.force * 1e-3;
    let after = "time after first contact (ms)";
    let over_penetration = curves(penetration, force);
    let panels = [
        panel("Contact force (kN)", after, curves(time, force)),
        panel("Contact force (kN)", "penetration (mm)", over_penetration),
        panel("Penetration (mm)", after, curves(time, penetration)),
    ];
    let longest = models.iter().map(|(_, outcome)| outcome.duration);
    let longest = longest.fold(0.0, f64::max);
    let references = measured.map(|measured| Reference {
        panel: 0,
        curve: force_until(measured, longest),
    });
    figure_with_references(&panels, references.as_slice())
}

/// The measured force (kN) over time (ms) until the contact is over, there and in computed
/// contacts of up to this length (s).
fn force_until(measured: &MeasuredForce, longest: f64) -> Curve {
    let end = measured.contact_time.max(longest);
    let shown = measured.samples.iter().filter(|(t, _)| *t <= end);
    Curve {
        name: "measured".to_owned(),
        points: shown.map(|(t, f)| (t * 1e3, f * 1e-3)).collect(),
    }
}

/// Achieved over requested restitution of named models, and what was requested.
pub fn restitutions(models: &[(&str, &RestitutionTable)]) -> Chart {
    let curve = |(name, table): &(&str, &RestitutionTable)| {
        let rows = table.rows.iter();
        Curve {
            name: (*name).to_owned(),
            points: rows.map(|r| (r.requested, r.outcome.restitution)).collect(),
        }
    };
    let curves = models.iter().map(curve).collect();
    let diagonal = Reference {
        panel: 0,
        curve: Curve {
            name: "as requested".to_owned(),
            points: vec![(0.0, 0.0), (1.0, 1.0)],
        },
    };
    let panel = panel("Achieved restitution", "requested restitution", curves);
    figure_with_references(&[panel], &[diagonal])
}
