//! Histories as files: numbers and pictures.

use std::path::Path;

use pounding_gap_element::CollisionSample;
use pounding_gap_element::laboratory::MeasuredForce;
use pounding_report::pictures::collision::histories;

use super::chosen;
use super::collisions::Collided;
use super::setting::Setting;
use crate::arguments::FigureArguments;
use crate::failure::Failure;
use crate::output::comma_separated;
use crate::plot;

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

/// Draws the histories of all models that have one; a measured force history, if there is
/// one, beside them.
pub fn write_svg(
    (path, size): (&Path, &FigureArguments),
    collided: &[Collided<'_>],
    measured: Option<&MeasuredForce>,
) -> Result<(), Failure> {
    let with = with_history(collided)?;
    let models: Vec<_> = with
        .iter()
        .map(|one| (one.chosen.descriptor.name, &one.outcome))
        .collect();
    plot::write_drawn(path, histories(&models, measured), size)
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
