//! Histories as files: numbers and pictures.

use std::path::Path;

use pounding_gap_element::CollisionSample;

use super::chosen;
use super::collisions::Collided;
use super::setting::Setting;
use crate::failure::Failure;
use crate::output::comma_separated;
use crate::plot::{self, Curve, Panel, Reference};

/// Writes the histories of all models that have one, in SI units and full
/// precision.
pub fn write_csv(path: &Path, collided: &[Collided<'_>], setting: &Setting) -> Result<(), Failure> {
    let mut head = format!("# pounding impact: {}\n", setting.pairs());
    let mut rows = Vec::new();
    for one in with_history(collided)? {
        head.push_str(&format!("# {}\n", chosen::pairs(one.chosen)));
        let name = one.chosen.descriptor.name;
        let row = |s: &CollisionSample| (name, s.time, s.penetration, s.velocity, s.force);
        rows.extend(one.outcome.history.iter().map(row));
    }
    let columns = [
        "model",
        "time_s",
        "penetration_m",
        "velocity_m_per_s",
        "force_n",
    ];
    plot::write(path, &format!("{head}{}", comma_separated(&columns, rows)?))
}

/// Draws force against time, force against penetration, penetration against time;
/// a measured force history, if there is one, beside the first.
pub fn write_svg(
    path: &Path,
    collided: &[Collided<'_>],
    measured: Option<Curve>,
) -> Result<(), Failure> {
    let with = with_history(collided)?;
    type Axis = fn(&CollisionSample) -> f64;
    let curves = |horizontal: Axis, vertical: Axis| -> Vec<Curve> {
        with.iter()
            .map(|one| Curve {
                name: one.chosen.descriptor.name.to_owned(),
                points: one
                    .outcome
                    .history
                    .iter()
                    .map(|s| (horizontal(s), vertical(s)))
                    .collect(),
            })
            .collect()
    };
    let time: Axis = |s| s.time * 1e3;
    let penetration: Axis = |s| s.penetration * 1e3;
    let force: Axis = |s| s.force * 1e-3;
    let panel = |caption: &str, horizontal: &str, curves| Panel {
        caption: caption.to_owned(),
        horizontal: horizontal.to_owned(),
        curves,
    };
    let after = "time after first contact (ms)";
    let panels = [
        panel("Contact force (kN)", after, curves(time, force)),
        panel(
            "Contact force (kN)",
            "penetration (mm)",
            curves(penetration, force),
        ),
        panel("Penetration (mm)", after, curves(time, penetration)),
    ];
    let references: Vec<_> = measured
        .map(|curve| Reference { panel: 0, curve })
        .into_iter()
        .collect();
    plot::write(path, &plot::figure_with_references(&panels, &references)?)
}

fn with_history<'a, 'b>(collided: &'a [Collided<'b>]) -> Result<Vec<&'a Collided<'b>>, Failure> {
    let with: Vec<_> = collided
        .iter()
        .filter(|one| !one.outcome.is_rigid())
        .collect();
    if with.is_empty() {
        return Err(Failure::input(
            "none of the chosen models has a force history to write",
            Some("a rigid impact lets velocities jump: choose a model with a contact force".into()),
        ));
    }
    Ok(with)
}
