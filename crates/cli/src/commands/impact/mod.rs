//! `pounding impact`: the laboratory of impact models.

mod against;
mod chosen;
mod collisions;
mod curves;
mod measured;
mod remarks;
mod setting;
mod table;

use pounding_gap_element::CollisionOutcome;
use pounding_gap_element::laboratory::{Difference, MeasuredForce, Specimen};
use serde::Serialize;

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
        chosen.iter_mut().for_each(Specimen::remove_restitution);
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
    let (collided, failed) = collisions::collide_all(chosen, setting)?;
    let compared: Option<Vec<Difference>> = history.as_ref().map(|measured| {
        let of =
            |c: &collisions::Collided<'_>| measured.difference(&c.outcome, c.chosen.exponent());
        collided.iter().map(of).collect()
    });
    let any = !collided.is_empty();
    if let Some(path) = arguments.csv.as_ref().filter(|_| any) {
        curves::write_csv(path, &collided, setting)?;
    }
    if let Some(path) = arguments.svg.as_ref().filter(|_| any) {
        curves::write_svg((path, &arguments.figure), &collided, history.as_ref())?;
    }
    if arguments.json {
        let models = collided.iter().enumerate().map(|(i, one)| {
            let against = compared.as_ref().map(|compared| &compared[i]);
            let outcome = &one.outcome;
            (one.chosen, Compared { outcome, against })
        });
        let measured = history.as_ref();
        let shared = Measured {
            measured,
            failed: &failed,
        };
        let shown = Models::new(models, shared, setting, chosen.len() > 1);
        print(&pretty(&shown)?)?;
        return collisions::failure_of(&failed);
    }
    if !any {
        return collisions::failure_of(&failed);
    }
    let mut text = collisions::text(&collided, setting);
    if let (Some(measured), Some(compared)) = (&history, &compared) {
        text.push_str(&against::text(measured, arguments, &collided, compared)?);
    }
    text.push_str(&written([
        arguments.csv.as_deref(),
        arguments.svg.as_deref(),
    ]));
    print(&text)?;
    collisions::failure_of(&failed)
}

/// What `--json` prints of models: one is an object of its own; several are a list, and what
/// they share stands beside it.
#[derive(Serialize)]
struct Models<'s, R, S> {
    #[serde(flatten)]
    results: OneOrSeveral<'s, R>,
    #[serde(flatten)]
    shared: S,
    bodies: setting::Shown,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    warnings: Vec<String>,
}

/// The results of models.
#[derive(Serialize)]
#[serde(untagged)]
enum OneOrSeveral<'s, R> {
    One(OfModel<'s, R>),
    Several { models: Vec<OfModel<'s, R>> },
}

/// A model and what it did.
#[derive(Serialize)]
struct OfModel<'s, R> {
    #[serde(flatten)]
    chosen: chosen::Shown<'s>,
    #[serde(flatten)]
    results: R,
}

impl<'s, R, S> Models<'s, R, S> {
    /// Models with their results, and what they share: a list, where `several` were asked for.
    fn new(
        models: impl IntoIterator<Item = (&'s Specimen, R)>,
        shared: S,
        setting: &Setting,
        several: bool,
    ) -> Self {
        let models: Vec<_> = models.into_iter().collect();
        let warnings = remarks::warnings(models.iter().map(|(specimen, _)| *specimen), setting);
        let models = models.into_iter().map(|(specimen, results)| OfModel {
            chosen: chosen::Shown::of(specimen),
            results,
        });
        let mut models: Vec<_> = models.collect();
        let results = match models.pop() {
            Some(only) if !several => OneOrSeveral::One(only),
            last => {
                models.extend(last);
                OneOrSeveral::Several { models }
            }
        };
        Self {
            results,
            shared,
            bodies: setting.shown(),
            warnings,
        }
    }
}

/// A collision, beside a measured one.
#[derive(Serialize)]
struct Compared<'c> {
    #[serde(flatten)]
    outcome: &'c CollisionOutcome,
    #[serde(skip_serializing_if = "Option::is_none")]
    against: Option<&'c Difference>,
}

/// What all models are compared with.
#[derive(Serialize)]
struct Measured<'m> {
    #[serde(skip_serializing_if = "Option::is_none")]
    measured: Option<&'m MeasuredForce>,
    /// Models of which there is no result.
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    failed: &'m [collisions::Failed],
}
