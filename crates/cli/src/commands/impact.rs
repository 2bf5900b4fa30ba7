//! `pounding impact`: the two-body laboratory.

use comfy_table::Table;
use pounding_case::{Dimension, parse_quantity};
use pounding_gap_element::{
    Bodies, CollisionOutcome, ModelParameters, SeparationRule, collide, registry,
};
use serde_json::json;

use super::{pretty, print};
use crate::arguments::ImpactArguments;
use crate::failure::Failure;

/// One collision, or a table over restitutions.
pub fn impact(arguments: &ImpactArguments) -> Result<(), Failure> {
    let bodies = Bodies {
        mass_left: quantity(&arguments.mass_left, "mass-left", Some(Dimension::MASS))?,
        mass_right: match arguments.mass_right.as_str() {
            "wall" => None,
            text => Some(quantity(text, "mass-right", Some(Dimension::MASS))?),
        },
        velocity_left: quantity(&arguments.velocity, "velocity", Some(Dimension::VELOCITY))?,
        velocity_right: 0.0,
    };
    let parameters = parameters(arguments)?;
    if arguments.table {
        return table(arguments, &bodies, parameters);
    }
    let model = registry::build(arguments.model.as_deref().unwrap_or_default(), &parameters)?;
    let outcome = collide(model.as_ref(), &bodies)?;
    if arguments.json {
        return print(&pretty(&outcome_json(&outcome)));
    }
    let requested = parameters.values.get("restitution");
    print(&format!(
        "{} - {}\n\nachieved restitution  {:.9}{}\npeak force            {:.6e} N at {:.6e} s\npeak penetration      {:.6e} m at {:.6e} s\ncontact time          {:.6e} s\nimpulse               {:.6e} N s\nenergy lost           {:.6e} J\nvelocities after      {:.6} and {:.6} m/s",
        model.descriptor().name,
        model.descriptor().title,
        outcome.restitution,
        requested.map_or_else(String::new, |e| format!("  (requested {e})")),
        outcome.peak_force,
        outcome.peak_force_time,
        outcome.peak_penetration,
        outcome.peak_penetration_time,
        outcome.duration,
        outcome.impulse,
        outcome.energy_dissipated,
        outcome.velocity_left,
        outcome.velocity_right,
    ))
}

fn quantity(text: &str, name: &str, wanted: Option<Dimension>) -> Result<f64, Failure> {
    let quantity =
        parse_quantity(text).map_err(|e| Failure::input(format!("--{name}: {e}"), None))?;
    match (quantity.dimension, wanted) {
        (Some(found), Some(wanted)) if found != wanted => Err(Failure::input(
            format!("--{name} must be {wanted}, but \"{text}\" is {found}"),
            Some("plain numbers are SI".to_owned()),
        )),
        _ => Ok(quantity.value),
    }
}

fn parameters(arguments: &ImpactArguments) -> Result<ModelParameters, Failure> {
    let mut parameters = ModelParameters::default();
    for text in &arguments.parameters {
        let (key, value) = text.split_once('=').ok_or_else(|| {
            Failure::input(
                format!("-p {text}: this is not KEY=VALUE"),
                Some("for example -p stiffness=\"93.5 MN/m\" -p restitution=0.65".to_owned()),
            )
        })?;
        parameters
            .values
            .insert(key.to_owned(), quantity(value, key, None)?);
    }
    if let Some(name) = &arguments.separation {
        parameters.separation = Some(SeparationRule::from_name(name).ok_or_else(|| {
            Failure::input(
                format!("unknown separation \"{name}\""),
                Some("it is zero_penetration or no_tension".to_owned()),
            )
        })?);
    }
    Ok(parameters)
}

/// Requested against achieved restitution with the mean errors.
fn table(
    arguments: &ImpactArguments,
    bodies: &Bodies,
    parameters: ModelParameters,
) -> Result<(), Failure> {
    let mut rows = Vec::new();
    for tenth in 1..=10 {
        let requested = f64::from(tenth) / 10.0;
        let mut parameters = parameters.clone();
        parameters
            .values
            .insert("restitution".to_owned(), requested);
        let model = registry::build(arguments.model.as_deref().unwrap_or_default(), &parameters)?;
        rows.push((requested, collide(model.as_ref(), bodies)?));
    }
    let error = |(e, out): &(f64, CollisionOutcome)| 100.0 * (out.restitution - e).abs() / e;
    let mean =
        |rows: &[(f64, CollisionOutcome)]| rows.iter().map(error).sum::<f64>() / rows.len() as f64;
    let (all, middle) = (mean(&rows), mean(&rows[4..8]));
    if arguments.json {
        let list: Vec<_> = rows
            .iter()
            .map(|(e, out)| json!({"requested": e, "achieved": out.restitution, "peak_force": out.peak_force}))
            .collect();
        return print(&pretty(
            &json!({"rows": list, "mean_error_percent": all, "mean_error_percent_0.5_0.8": middle}),
        ));
    }
    let mut table = Table::new();
    table.set_header([
        "requested",
        "achieved",
        "error %",
        "peak force (N)",
        "contact time (s)",
    ]);
    for row in &rows {
        let (e, out) = row;
        table.add_row([
            format!("{e:.1}"),
            format!("{:.7}", out.restitution),
            format!("{:.2}", error(row)),
            format!("{:.4e}", out.peak_force),
            format!("{:.4e}", out.duration),
        ]);
    }
    print(&format!(
        "{table}\nmean error {all:.2} % over 0.1-1.0, {middle:.2} % over 0.5-0.8"
    ))
}

fn outcome_json(outcome: &CollisionOutcome) -> serde_json::Value {
    let history: Vec<_> = outcome
        .history
        .iter()
        .map(|s| json!([s.time, s.penetration, s.velocity, s.force]))
        .collect();
    json!({
        "restitution": outcome.restitution,
        "peak_force": {"peak": outcome.peak_force, "time": outcome.peak_force_time},
        "peak_penetration": {"peak": outcome.peak_penetration, "time": outcome.peak_penetration_time},
        "duration": outcome.duration, "impulse": outcome.impulse,
        "energy_dissipated": outcome.energy_dissipated,
        "velocity_left": outcome.velocity_left, "velocity_right": outcome.velocity_right,
        "history_columns": ["time", "penetration", "velocity", "force"], "history": history,
    })
}
