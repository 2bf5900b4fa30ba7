//! The same collision by each model.

use comfy_table::{CellAlignment, presets};
use pounding_catalogue::numbers::{scientific, significant};
use pounding_gap_element::laboratory::Specimen;
use pounding_gap_element::{CollisionOutcome, CollisionSample, GapElementError, collide_with};
use serde::Serialize;

use super::remarks::remarks;
use super::setting::{Setting, refused};
use crate::failure::Failure;
use crate::tables::Table;

/// One model and what it did.
pub struct Collided<'a> {
    /// The model with its parameters.
    pub chosen: &'a Specimen,
    /// Its collision.
    pub outcome: CollisionOutcome,
}

/// One of several models whose collision does not end.
#[derive(Debug, Serialize)]
pub struct Failed {
    model: &'static str,
    reason: String,
}

/// Puts every model through the collision.
pub fn collide_all<'a>(
    chosen: &'a [Specimen],
    setting: &Setting,
) -> Result<(Vec<Collided<'a>>, Vec<Failed>), Failure> {
    let collide =
        |one: &Specimen| collide_with(one.build()?.as_ref(), &setting.bodies, &setting.options);
    let (collided, failed) = of_each(chosen, collide)?;
    let collided = collided.into_iter();
    let collided = collided.map(|(chosen, outcome)| Collided { chosen, outcome });
    Ok((collided.collect(), failed))
}

/// Models with what came of them.
pub type OfEach<'a, T> = Vec<(&'a Specimen, T)>;

/// The results of models, and those of several whose collision does not end: they keep the others
/// from nothing.
pub fn of_each<'a, T>(
    chosen: impl IntoIterator<Item = &'a Specimen, IntoIter: ExactSizeIterator>,
    result: impl Fn(&Specimen) -> Result<T, GapElementError>,
) -> Result<(OfEach<'a, T>, Vec<Failed>), Failure> {
    let (mut results, mut failed) = (Vec::new(), Vec::new());
    let chosen = chosen.into_iter();
    let several = chosen.len() > 1;
    for one in chosen {
        match result(one) {
            Ok(result) => results.push((one, result)),
            Err(error @ GapElementError::Unfinished { .. }) if several => {
                failed.push(Failed {
                    model: one.descriptor.name,
                    reason: error.to_string(),
                });
            }
            Err(error) => return Err(refused(one, error)),
        }
    }
    Ok((results, failed))
}

/// The failure of a call in which the collisions of some models do not end, behind the results of the others.
pub fn failure_of(failed: &[Failed]) -> Result<(), Failure> {
    if failed.is_empty() {
        return Ok(());
    }
    let reasons: Vec<_> = failed.iter().map(|one| one.reason.as_str()).collect();
    Err(Failure::computation(
        reasons.join("; "),
        Some("leave these models out, or check mass, speed and parameters with their units: by itself each says more".to_owned()),
    ))
}

/// One model in full, or a table of several, with what is to be known of them.
pub fn text(collided: &[Collided<'_>], setting: &Setting) -> String {
    let mut text = match collided {
        [one] => one_model(one, setting),
        _ => format!("{}\n{}\n", setting.description, several(collided, setting)),
    };
    for one in collided.iter().filter(|c| c.outcome.stays_in_contact) {
        text.push_str(&format!(
            "stays in contact: {} has too little energy left to part\n",
            one.chosen.descriptor.name
        ));
    }
    for one in collided.iter().filter(|c| c.outcome.is_rigid()) {
        text.push_str(&format!(
            "no force history: {} lets velocities jump; it has an impulse but no force, and no curve\n",
            one.chosen.descriptor.name
        ));
    }
    let chosen: Vec<_> = collided.iter().map(|c| c.chosen).collect();
    text.push_str(&remarks(&chosen, setting));
    text
}

/// Whether bodies that stay in contact have settled by the time of the reading.
fn at_rest(reading: &CollisionSample, outcome: &CollisionOutcome) -> bool {
    let slow = reading.velocity.abs() < 1.0e-6 * outcome.collision.approach_velocity;
    outcome.stays_in_contact && slow
}

fn one_model(one: &Collided<'_>, setting: &Setting) -> String {
    let outcome = &one.outcome;
    let requested = one.chosen.parameters.values.get("restitution");
    let at = |value: f64, unit: &str, time: f64| {
        if outcome.is_rigid() {
            "-".to_owned()
        } else {
            format!("{} at {}", scientific(value, unit), scientific(time, "s"))
        }
    };
    let mut text = format!(
        "{} - {}\n{}\n\nachieved restitution  {:.9}{}\n",
        one.chosen.descriptor.name,
        one.chosen.descriptor.title,
        setting.description,
        outcome.restitution,
        requested.map_or_else(String::new, |e| format!("  (requested {e})")),
    );
    if let Some(time) = setting.options.read_at {
        let reading = match &outcome.reading {
            Some(s) => format!(
                "{:.9}  ({})",
                outcome.restitution_at(s),
                match outcome.stays_in_contact || time < outcome.duration {
                    true if at_rest(s, outcome) => "the bodies rest on one another",
                    true if s.velocity > 0.0 => "still approaching",
                    true => "still in contact",
                    false => "after contact",
                }
            ),
            None => "-  (the bodies met again before)".to_owned(),
        };
        text.push_str(&format!(
            "read at {:14}{reading}\n",
            format!("{} ms", significant(1e3 * time))
        ));
    }
    text.push_str(&format!(
        "peak force            {}\npeak penetration      {}\ncontact time          {}\nimpulse               {}\nenergy lost           {}\nvelocities after      {}\n",
        at(outcome.peak_force, "N", outcome.peak_force_time),
        at(outcome.peak_penetration, "m", outcome.peak_penetration_time),
        scientific(outcome.contact_time(), "s"),
        scientific(outcome.impulse_of_parted(), "N s"),
        scientific(outcome.energy_lost(), "J"),
        if outcome.stays_in_contact {
            "-".to_owned()
        } else {
            format!("{:.6} and {:.6} m/s", outcome.velocity_left, outcome.velocity_right)
        },
    ));
    text
}

fn several(collided: &[Collided<'_>], setting: &Setting) -> Table {
    let mut header = vec!["model".to_owned(), "requested".into(), "achieved".into()];
    if let Some(time) = setting.options.read_at {
        header.push(format!("read at {} ms", significant(1e3 * time)));
    }
    header.extend(
        [
            "peak force (kN)",
            "at (ms)",
            "penetration (mm)",
            "contact time (ms)",
            "impulse (kN s)",
            "energy lost (kJ)",
        ]
        .map(str::to_owned),
    );
    let mut table = right_aligned(header);
    for one in collided {
        let outcome = &one.outcome;
        let requested = one.chosen.parameters.values.get("restitution");
        let force = |value: f64| {
            if outcome.is_rigid() {
                "-".to_owned()
            } else {
                significant(value)
            }
        };
        let mut row = vec![
            one.chosen.descriptor.name.to_owned(),
            requested.map_or("-".to_owned(), f64::to_string),
            format!("{:.6}", outcome.restitution),
        ];
        if setting.options.read_at.is_some() {
            let read = outcome.reading.map(|s| outcome.restitution_at(&s));
            row.push(read.map_or("-".to_owned(), |e| format!("{e:.6}")));
        }
        row.extend([
            force(outcome.peak_force * 1e-3),
            force(outcome.peak_force_time * 1e3),
            force(outcome.peak_penetration * 1e3),
            significant(outcome.contact_time() * 1e3),
            significant(outcome.impulse_of_parted() * 1e-3),
            significant(outcome.energy_lost() * 1e-3),
        ]);
        table.add_row(row);
    }
    table
}

/// A table of names and numbers.
pub fn right_aligned(header: Vec<String>) -> Table {
    let mut table = Table::new();
    table.load_style(presets::ASCII_FULL_CONDENSED);
    table.set_header(header);
    for column in table.column_iter_mut().skip(1) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table
}
