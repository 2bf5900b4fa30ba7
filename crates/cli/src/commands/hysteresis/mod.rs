//! `pounding hysteresis`: the laws of storeys and links, and their laboratory.

mod bounds;
mod chosen;
mod columns;
pub(super) mod curve;
mod cycles;
mod descriptor;
mod fit;
mod motion;
mod output;
mod pages;

use pounding_hysteresis::{LawDescriptor, descriptors, find};
use serde_json::{Map, Value, json};

use super::{pretty, print};
use crate::arguments::HysteresisArguments;
use crate::failure::Failure;
use chosen::Chosen;
use curve::DissipationCurve;
use cycles::Loop;
use fit::Fitted;
use motion::Path;

/// Everything that one call computes.
struct Results {
    chosen: Chosen,
    fitted: Option<Fitted>,
    driven: Option<Loop>,
    curve: Option<DissipationCurve>,
}

/// Lists all laws, shows one, drives one along deformations, or writes the pages of the
/// documentation.
pub fn hysteresis(arguments: &HysteresisArguments) -> Result<(), Failure> {
    if let Some(folder) = &arguments.pages {
        return pages::write(folder);
    }
    let Some(name) = &arguments.law else {
        return list(arguments.json);
    };
    let law = find(name)?;
    let moved = !arguments.cycles.is_empty()
        || arguments.history.is_some()
        || !arguments.dissipation.is_empty()
        || arguments.fit.is_some();
    if moved {
        return laboratory(law, arguments);
    }
    // Parameters are judged even where nothing moves: a refusal says more than the lack.
    chosen::choose(law, &arguments.set)?;
    let asked = !arguments.set.is_empty() || arguments.csv.is_some() || arguments.svg.is_some();
    if asked || arguments.period.is_some() || arguments.rate.is_some() {
        return Err(Failure::input(
            format!("nothing moves the element of law {}", law.name),
            Some(
                "add --cycles \"10 mm,20 mm\", --history FILE, --dissipation \"0.1 mm,10 mm\" or --fit FILE"
                    .to_owned(),
            ),
        ));
    }
    if arguments.json {
        return print(&pretty(&descriptor::json(law)));
    }
    print(&descriptor::text(law))
}

fn list(as_json: bool) -> Result<(), Failure> {
    if as_json {
        let descriptors: Vec<_> = descriptors().iter().map(|d| descriptor::json(d)).collect();
        return print(&pretty(&json!(descriptors)));
    }
    print(&descriptor::list(descriptors()))
}

fn laboratory(law: &'static LawDescriptor, arguments: &HysteresisArguments) -> Result<(), Failure> {
    let (chosen, fitted) = match &arguments.fit {
        Some(path) => {
            let fitted = fit::fit(law, path, &arguments.set)?;
            (Chosen::fitted(law, &fitted.density)?, Some(fitted))
        }
        None => (chosen::choose(law, &arguments.set)?, None),
    };
    let path = motion::path(law, arguments)?;
    let driven = path.map(|path| driven(&chosen, path)).transpose()?;
    let results = Results {
        curve: curve::curve(&chosen, arguments)?,
        chosen,
        fitted,
        driven,
    };
    if let Some(path) = &arguments.csv {
        output::write_csv(path, &results)?;
    }
    if let Some(path) = &arguments.svg {
        output::write_svg(path, &results)?;
    }
    if arguments.json {
        return print(&pretty(&results.json()));
    }
    print(&format!("{}{}", results.text(), written(arguments)))
}

fn driven(chosen: &Chosen, path: Path) -> Result<Loop, Failure> {
    bounds::reachable(chosen, bounds::length(&path))?;
    let driven = Loop::drive(chosen.law.as_ref(), path);
    bounds::finite(&driven.states)?;
    Ok(driven)
}

impl Results {
    fn text(&self) -> String {
        let mut text = self.chosen.text();
        if let Some(fitted) = &self.fitted {
            text.push_str(&fitted.text());
        }
        if let Some(driven) = &self.driven {
            text.push_str(&driven.text());
        }
        if let Some(curve) = &self.curve {
            text.push_str(&curve.text());
        }
        text
    }

    fn json(&self) -> Value {
        let mut object: Map<String, Value> = self.chosen.json();
        let parts = [
            ("fit", self.fitted.as_ref().map(Fitted::json)),
            ("loop", self.driven.as_ref().map(Loop::json)),
            (
                "dissipation",
                self.curve.as_ref().map(DissipationCurve::json),
            ),
        ];
        for (key, value) in parts {
            if let Some(value) = value {
                object.insert(key.to_owned(), value);
            }
        }
        Value::Object(object)
    }
}

/// Says which files were written.
fn written(arguments: &HysteresisArguments) -> String {
    let files = [&arguments.csv, &arguments.svg];
    let lines = files
        .into_iter()
        .flatten()
        .map(|path| format!("written to {}\n", path.display()));
    lines.collect()
}
