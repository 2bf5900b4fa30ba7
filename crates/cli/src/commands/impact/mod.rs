//! `pounding impact`: the laboratory of impact models.

mod against;
mod chosen;
mod collisions;
mod curves;
mod measured;
mod remarks;
mod setting;
mod table;

use pounding_gap_element::laboratory::{Difference, Specimen};
use serde_json::{Value, json};

use crate::arguments::ImpactArguments;
use crate::failure::Failure;
use crate::output::{pretty, print, written};
use setting::Setting;

/// Collisions by one or several models, a table over restitutions, or a comparison
/// with a measured force.
pub fn impact(arguments: &ImpactArguments) -> Result<(), Failure> {
    if arguments.models.iter().any(|m| m == "calibrate") {
        return Err(Failure::input(
            "calibrate is no model".to_owned(),
            Some(
                "write `pounding impact calibrate` with all options behind it, none before"
                    .to_owned(),
            ),
        ));
    }
    let setting = setting::setting(arguments)?;
    let mut chosen = chosen::choose(arguments)?;
    if arguments.table {
        chosen.iter_mut().for_each(Specimen::forget_restitution);
        return table::table(arguments, &chosen, &setting);
    }
    collisions(arguments, &chosen, &setting)
}

fn collisions(
    arguments: &ImpactArguments,
    chosen: &[Specimen],
    setting: &Setting,
) -> Result<(), Failure> {
    let history = against::measured(arguments)?;
    let collided = collisions::collide_all(chosen, setting)?;
    let compared: Option<Vec<Difference>> = history.as_ref().map(|measured| {
        let outcomes = collided.iter().map(|c| &c.outcome);
        outcomes.map(|o| measured.difference(o)).collect()
    });
    if let Some(path) = &arguments.csv {
        curves::write_csv(path, &collided, setting)?;
    }
    if let Some(path) = &arguments.svg {
        let longest = collided.iter().map(|c| c.outcome.duration);
        let longest = longest.fold(0.0, f64::max);
        let curve = history.as_ref().map(|m| against::curve(m, longest));
        curves::write_svg(path, &collided, curve)?;
    }
    if arguments.json {
        let mut objects: Vec<_> = collided.iter().map(|c| c.json()).collect();
        for (object, one) in objects.iter_mut().zip(compared.iter().flatten()) {
            object.insert("against".into(), json!(one));
        }
        let mut shared = setting.json();
        if let Some(measured) = &history {
            shared.insert("measured".into(), json!(measured));
        }
        return print(&pretty(&one_or_several(objects, shared)));
    }
    let mut text = collisions::text(&collided, setting);
    if let (Some(measured), Some(compared)) = (&history, &compared) {
        text.push_str(&against::text(measured, arguments, &collided, compared)?);
    }
    text.push_str(&written([
        arguments.csv.as_deref(),
        arguments.svg.as_deref(),
    ]));
    print(&text)
}

/// One model is an object of its own; several are a list, and what they share
/// stands beside it.
fn one_or_several(
    mut objects: Vec<serde_json::Map<String, Value>>,
    mut shared: serde_json::Map<String, Value>,
) -> Value {
    if objects.len() == 1
        && let Some(mut one) = objects.pop()
    {
        one.extend(shared);
        return Value::Object(one);
    }
    shared.insert("models".into(), json!(objects));
    Value::Object(shared)
}
