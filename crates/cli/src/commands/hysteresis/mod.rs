//! `pounding hysteresis`: the laws of storeys and links, and their laboratory.

mod chosen;
mod curve;
mod cycles;
mod descriptor;
mod fit;
mod motion;
mod output;

use pounding_hysteresis::laboratory::{Loop, Specimen};
use pounding_hysteresis::{LawDescriptor, descriptors, find};
use pounding_report::documentation::laws as documentation;
use serde::Serialize;

use crate::arguments::HysteresisArguments;
use crate::failure::Failure;
use crate::output::{pretty, print, written};
use crate::plot::write_documentation;
use curve::DissipationCurve;
use fit::Fitted;

/// Everything that one call computes.
struct Results {
    specimen: Specimen,
    fitted: Option<Fitted>,
    /// A loop, and its cycles in words.
    driven: Option<(Loop, String)>,
    curve: Option<DissipationCurve>,
}

/// Lists all laws, shows one, drives one along deformations, or writes the pages of the
/// documentation.
pub fn hysteresis(arguments: &HysteresisArguments) -> Result<(), Failure> {
    if let Some(folder) = &arguments.pages {
        write_documentation(folder, &documentation::files()?)?;
        return print(&format!(
            "{} laws in {}",
            descriptors().len(),
            folder.display()
        ));
    }
    let Some(name) = &arguments.law else {
        return list(arguments.json);
    };
    let law = find(name)?;
    let moved = !arguments.cycles.is_empty()
        || arguments.history.is_some()
        || !arguments.dissipation.is_empty();
    let paced = arguments.period.is_some() || arguments.rate.is_some();
    let of_motion = paced || arguments.steps.is_some();
    if moved || !arguments.fit.is_empty() && !of_motion {
        return laboratory(law, arguments);
    }
    // Parameters are judged even where nothing moves: a refusal says more than the lack.
    chosen::choose(law, &arguments.set)?;
    let asked = !arguments.set.is_empty() || arguments.csv.is_some() || arguments.svg.is_some();
    if asked || of_motion {
        return Err(Failure::input(
            format!("nothing moves the element of law {}", law.name),
            Some(
                match arguments.fit.is_empty() {
                    true => "add --cycles \"10 mm,20 mm\", --history FILE, --dissipation \"0.1 mm,10 mm\" or --fit backbone FILE",
                    false => "leave --period, --rate and --steps away, which a fit does not ask for, or add --cycles \"10 mm,20 mm\"",
                }
                .to_owned(),
            ),
        ));
    }
    if arguments.json {
        return print(&pretty(&descriptor::Described::of(law))?);
    }
    print(&descriptor::text(law))
}

fn list(as_json: bool) -> Result<(), Failure> {
    if as_json {
        let all = descriptors().iter();
        let described: Vec<_> = all.map(|d| descriptor::Described::of(d)).collect();
        return print(&pretty(&described)?);
    }
    print(&descriptor::list(descriptors()))
}

fn laboratory(law: &'static LawDescriptor, arguments: &HysteresisArguments) -> Result<(), Failure> {
    let (specimen, fitted) = match &arguments.fit[..] {
        [] => (chosen::choose(law, &arguments.set)?, None),
        words => {
            let fitted = fit::fit(law, words, &arguments.set)?;
            let specimen = Specimen::of_density(law, &fitted.fit.density)?;
            (specimen, Some(fitted))
        }
    };
    let driven = match motion::path(law, arguments)? {
        Some((path, description)) => Some((Loop::drive(&specimen, &path)?, description)),
        None => None,
    };
    let results = Results {
        curve: curve::curve(&specimen, arguments)?,
        specimen,
        fitted,
        driven,
    };
    if let Some(path) = &arguments.csv {
        output::write_csv(path, &results)?;
    }
    if let Some(path) = &arguments.svg {
        output::write_svg(path, &results, &arguments.figure)?;
    }
    if arguments.json {
        return print(&pretty(&results.shown())?);
    }
    print(&format!(
        "{}{}",
        results.text(),
        written([arguments.csv.as_deref(), arguments.svg.as_deref()])
    ))
}

impl Results {
    fn text(&self) -> String {
        let mut text = chosen::text(&self.specimen);
        if let Some(fitted) = &self.fitted {
            text.push_str(&fitted.text());
        }
        if let Some((driven, description)) = &self.driven {
            text.push_str(&cycles::text(driven, description));
        }
        if let Some(curve) = &self.curve {
            text.push_str(&curve.text());
        }
        text
    }

    fn shown(&self) -> Shown<'_> {
        Shown {
            chosen: chosen::Chosen::of(&self.specimen),
            fit: self.fitted.as_ref().map(Fitted::shown),
            driven: self.driven.as_ref().map(|(driven, _)| driven),
            dissipation: self.curve.as_ref().map(DissipationCurve::shown),
        }
    }
}

/// What `--json` prints.
#[derive(Serialize)]
struct Shown<'r> {
    #[serde(flatten)]
    chosen: chosen::Chosen<'r>,
    #[serde(skip_serializing_if = "Option::is_none")]
    fit: Option<fit::ShownFit>,
    #[serde(rename = "loop", skip_serializing_if = "Option::is_none")]
    driven: Option<&'r Loop>,
    #[serde(skip_serializing_if = "Option::is_none")]
    dissipation: Option<curve::ShownCurve<'r>>,
}
