//! `pounding impact`: the laboratory of impact models.

mod against;
mod chosen;
mod collisions;
pub(super) mod curves;
pub(super) mod measured;
pub(super) mod numbers;
mod remarks;
pub(super) mod setting;
mod table;

use serde_json::{Value, json};

use super::{pretty, print};
use crate::arguments::ImpactArguments;
use crate::failure::Failure;
use chosen::Chosen;
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
        chosen.iter_mut().for_each(Chosen::forget_restitution);
        return table::table(arguments, &chosen, &setting);
    }
    collisions(arguments, &chosen, &setting)
}

fn collisions(
    arguments: &ImpactArguments,
    chosen: &[Chosen],
    setting: &Setting,
) -> Result<(), Failure> {
    let history = against::measured(arguments)?;
    let collided = collisions::collide_all(chosen, setting)?;
    let compared = history.as_ref().map(|m| against::compare(m, &collided));
    if let Some(path) = &arguments.csv {
        curves::write_csv(path, &collided, setting)?;
    }
    if let Some(path) = &arguments.svg {
        let longest = collided.iter().map(|c| c.outcome.duration);
        let longest = longest.fold(0.0, f64::max);
        let curve = history.as_ref().map(|m| m.curve(longest));
        curves::write_svg(path, &collided, curve)?;
    }
    if arguments.json {
        let mut objects: Vec<_> = collided.iter().map(|c| c.json()).collect();
        for (object, one) in objects.iter_mut().zip(compared.iter().flatten()) {
            object.insert("against".into(), one.json());
        }
        let mut shared = setting_object(setting);
        if let Some(measured) = &history {
            shared.insert("measured".into(), measured.json());
        }
        return print(&pretty(&one_or_several(objects, shared)));
    }
    let mut text = collisions::text(&collided, setting);
    if let (Some(measured), Some(compared)) = (&history, &compared) {
        text.push_str(&against::text(measured, compared));
    }
    text.push_str(&written(arguments));
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

fn setting_object(setting: &Setting) -> serde_json::Map<String, Value> {
    let mut object = serde_json::Map::new();
    object.insert("bodies".into(), setting.json());
    object
}

/// Says which files were written.
fn written(arguments: &ImpactArguments) -> String {
    let files = [&arguments.csv, &arguments.svg];
    let lines = files
        .into_iter()
        .flatten()
        .map(|path| format!("written to {}\n", path.display()));
    lines.collect()
}
