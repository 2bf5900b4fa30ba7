//! Which models, with which parameters.

use std::collections::BTreeMap;
use std::path::Path;

use pounding_assembly::parameter_dimension;
use pounding_case::{Dimension, Quantity, parse_quantity};
use pounding_catalogue::{Parameters, suggestion};
use pounding_gap_element::laboratory::{Specimen, unit_of};
use pounding_gap_element::{
    GapElementError, ModelDescriptor, ModelParameters, ParameterDescriptor, SeparationRule,
    registry,
};
use serde::Serialize;

use crate::arguments::ImpactArguments;
use crate::columns::{Column, Source};
use crate::failure::Failure;

/// One parameter as given.
struct Given {
    text: String,
    model: Option<&'static ModelDescriptor>,
    key: String,
    quantity: Quantity,
}

/// The models of the arguments.
pub fn choose(arguments: &ImpactArguments) -> Result<Vec<Specimen>, Failure> {
    let descriptors = descriptors(arguments)?;
    let given = arguments
        .parameters
        .iter()
        .map(|text| given(text, &descriptors))
        .collect::<Result<Vec<_>, _>>()?;
    let spring = arguments.spring.as_deref().map(spring).transpose()?;
    let mut used = vec![false; given.len()];
    let mut chosen = Vec::new();
    for &descriptor in &descriptors {
        let values = values(descriptor, &given, &mut used)?;
        let mut parameters: ModelParameters = Parameters { values }.into();
        parameters.spring.clone_from(&spring);
        chosen.push(Specimen::new(descriptor, parameters));
    }
    if let Some(at) = used.iter().position(|used| !used) {
        return Err(Failure::input(
            format!("-p {} serves no model", given[at].text),
            Some("its unit fits none of the chosen models, or each has a value of its own".into()),
        ));
    }
    separation(arguments, &mut chosen)?;
    if arguments.example {
        chosen.iter_mut().for_each(Specimen::fill_from_example);
    }
    Ok(chosen)
}

/// Penetrations (m) and forces (N) of the file of a spring.
fn spring(path: &Path) -> Result<Vec<(f64, f64)>, Failure> {
    let column = |name, dimension| Column { name, dimension };
    let columns = [
        column("penetration", Dimension::LENGTH),
        column("force", Dimension::FORCE),
    ];
    let source = Source::of_option(path, "--spring", "penetration_mm,force_kN")?;
    let mut table: Vec<(f64, f64)> = Vec::new();
    for (place, row) in source.rows(&[&columns])? {
        let (penetration, force) = (row[0], row[1]);
        // It begins at the origin.
        if table.is_empty() && penetration == 0.0 && force == 0.0 {
            continue;
        }
        let before = table.last().copied().unwrap_or((0.0, 0.0));
        if !(penetration > before.0 && force > before.1) {
            return Err(source.error(
                place,
                "penetration and force do not both increase here".to_owned(),
                "give penetrations and forces that increase from zero on",
            ));
        }
        table.push((penetration, force));
    }
    if table.is_empty() {
        return Err(source.error(
            0..0,
            "there is no row of numbers above zero".to_owned(),
            "give penetrations and forces that increase from zero on",
        ));
    }
    Ok(table)
}

fn descriptors(arguments: &ImpactArguments) -> Result<Vec<&'static ModelDescriptor>, Failure> {
    if arguments.all {
        return Ok(registry::descriptors().to_vec());
    }
    let mut found: Vec<&'static ModelDescriptor> = Vec::new();
    for name in &arguments.models {
        let descriptor = registry::find(name)?;
        if found.iter().any(|d| d.name == descriptor.name) {
            return Err(Failure::input(
                format!("model {} is asked for twice", descriptor.name),
                Some(format!(
                    "leave \"{name}\" out: one name or alias per model is enough"
                )),
            ));
        }
        found.push(descriptor);
    }
    Ok(found)
}

/// Takes `KEY=VALUE` or `MODEL.KEY=VALUE` apart, for models that were chosen.
fn given(text: &str, descriptors: &[&'static ModelDescriptor]) -> Result<Given, Failure> {
    let (name, value) = text.split_once('=').ok_or_else(|| {
        Failure::input(
            format!("-p {text}: this is not KEY=VALUE"),
            Some("for example -p stiffness=\"93.5 MN/m\" -p restitution=0.65".to_owned()),
        )
    })?;
    let (model, key) = match name.trim().split_once('.') {
        Some((model, key)) => (Some(registry::find(model)?), key.trim()),
        None => (None, name.trim()),
    };
    if let Some(model) = model.filter(|m| descriptors.iter().all(|d| d.name != m.name)) {
        return Err(Failure::input(
            format!("-p {text}: model {} is not among those chosen", model.name),
            Some("name it before the options, or correct the name".to_owned()),
        ));
    }
    let asked: Vec<_> = model.map_or_else(|| descriptors.to_vec(), |m| vec![m]);
    let known = || asked.iter().flat_map(|d| d.parameters).map(|p| p.name);
    if !known().any(|name| name == key) {
        return Err(unknown(key, &asked, known()));
    }
    let quantity = parse_quantity(value)
        .map_err(|e| Failure::input(format!("-p {text}: {e}"), Some(e.help())))?;
    Ok(Given {
        text: text.to_owned(),
        model,
        key: key.to_owned(),
        quantity,
    })
}

fn unknown(
    key: &str,
    asked: &[&ModelDescriptor],
    known: impl Iterator<Item = &'static str>,
) -> Failure {
    let mut known: Vec<_> = known.collect();
    known.sort_unstable();
    known.dedup();
    let nearest = suggestion::misspelt(key, &known);
    let guess = nearest.map_or_else(String::new, |name| format!("did you mean \"{name}\"? "));
    let who = match asked {
        [one] => format!("model {} has no parameter \"{key}\"", one.name),
        _ => format!("no chosen model has a parameter \"{key}\""),
    };
    Failure::input(
        who,
        Some(format!("{guess}the parameters are {}", known.join(", "))),
    )
}

/// What of the given parameters one model takes.
fn values(
    descriptor: &'static ModelDescriptor,
    given: &[Given],
    used: &mut [bool],
) -> Result<BTreeMap<String, f64>, Failure> {
    let mut values = BTreeMap::new();
    let mut take = |parameter: &ParameterDescriptor, exponent| {
        if let Some(at) = pick(descriptor, parameter, given, exponent)? {
            used[at] = true;
            values.insert(parameter.name.to_owned(), given[at].quantity.value);
            return Ok::<_, Failure>(Some(given[at].quantity.value));
        }
        Ok(None)
    };
    // The exponent first: the unit of the stiffness depends on it.
    let free = descriptor.parameters.iter().find(|p| p.name == "exponent");
    let exponent = match free {
        Some(parameter) => take(parameter, None)?,
        None => None,
    };
    for parameter in descriptor
        .parameters
        .iter()
        .filter(|p| p.name != "exponent")
    {
        take(parameter, exponent)?;
    }
    Ok(values)
}

/// Which of the given parameters serves a parameter of a model: the model's own
/// before the general ones, and of several general ones that with the right unit.
fn pick(
    descriptor: &ModelDescriptor,
    parameter: &ParameterDescriptor,
    given: &[Given],
    exponent: Option<f64>,
) -> Result<Option<usize>, Failure> {
    let of = |own: bool| -> Vec<usize> {
        (0..given.len())
            .filter(|&i| given[i].key == parameter.name)
            .filter(|&i| match given[i].model {
                Some(model) => own && model.name == descriptor.name,
                None => !own,
            })
            .collect()
    };
    let own = of(true);
    let candidates = if own.is_empty() { of(false) } else { own };
    let wanted = parameter_dimension(descriptor, parameter, exponent);
    let fits = |i: &&usize| given[**i].quantity.dimension.is_none_or(|d| d == wanted);
    let fitting: Vec<usize> = candidates.iter().filter(fits).copied().collect();
    match (candidates.as_slice(), fitting.as_slice()) {
        ([], _) => Ok(None),
        (_, [one]) => Ok(Some(*one)),
        ([first, ..], []) => {
            let found = given[*first].quantity.dimension;
            Err(Failure::input(
                format!(
                    "`{}` of model {} must be {wanted}, but \"{}\" is {}",
                    parameter.name,
                    descriptor.name,
                    given[*first].quantity.text,
                    found.map_or_else(String::new, |d| d.to_string())
                ),
                Some(format!(
                    "correct the unit, or give this model a value of its own: -p {}.{}=VALUE",
                    descriptor.name, parameter.name
                )),
            ))
        }
        (_, [first, second, ..]) => Err(Failure::input(
            format!(
                "`{}` of model {} is given twice: \"{}\" and \"{}\"",
                parameter.name,
                descriptor.name,
                given[*first].quantity.text,
                given[*second].quantity.text
            ),
            Some("leave one out".to_owned()),
        )),
    }
}

/// One model must offer the rule asked for; of several, those that do take it.
fn separation(arguments: &ImpactArguments, chosen: &mut [Specimen]) -> Result<(), Failure> {
    let Some(name) = &arguments.separation else {
        return Ok(());
    };
    let Some(rule) = SeparationRule::from_name(name) else {
        let known: Vec<_> = SeparationRule::ALL.iter().map(|r| r.name()).collect();
        return Err(Failure::input(
            format!("unknown separation \"{name}\""),
            Some(format!("it is one of {}", known.join(", "))),
        ));
    };
    if let [only] = chosen
        && !only.offers(rule)
    {
        return Err(Failure::from(GapElementError::Separation {
            model: only.descriptor.name,
            rule: name.clone(),
            offered: only
                .descriptor
                .separation_rules
                .iter()
                .map(|r| r.name())
                .collect(),
        }));
    }
    if !chosen.iter().any(|one| one.offers(rule)) {
        return Err(Failure::input(
            format!("no chosen model offers separation \"{name}\""),
            Some("`pounding models NAME` shows what a model offers".to_owned()),
        ));
    }
    chosen
        .iter_mut()
        .for_each(|one| one.ask_for_separation(rule));
    Ok(())
}

/// A parameter with its unit, such as `stiffness = 2.75e9 N/m^1.5`.
pub fn parameter(specimen: &Specimen, key: &str) -> String {
    let values = &specimen.parameters.values;
    let value = values.get(key).copied().unwrap_or(f64::NAN);
    let unit = unit_of(specimen.descriptor, &specimen.parameters, key);
    let unit = unit.map_or_else(String::new, |unit| format!(" {unit}"));
    if value != 0.0 && !(1e-3..1e6).contains(&value.abs()) {
        format!("{key} = {value:e}{unit}")
    } else {
        format!("{key} = {value}{unit}")
    }
}

/// All parameters as `key=value` pairs for the head of a file.
pub fn pairs(specimen: &Specimen) -> String {
    let values = specimen.parameters.values.iter();
    let pairs: String = values
        .map(|(key, value)| format!(" {key}={value:e}"))
        .collect();
    format!(
        "model={}{pairs} separation={}",
        specimen.descriptor.name,
        specimen.separation().name()
    )
}

/// The model and its parameters for machines.
#[derive(Serialize)]
pub struct Shown<'s> {
    model: &'static str,
    title: &'static str,
    parameters: &'s BTreeMap<String, f64>,
    filled_from_example: &'s [String],
    separation: &'static str,
    verification: String,
}

impl<'s> Shown<'s> {
    /// A specimen.
    pub fn of(specimen: &'s Specimen) -> Self {
        Self {
            model: specimen.descriptor.name,
            title: specimen.descriptor.title,
            parameters: &specimen.parameters.values,
            filled_from_example: &specimen.filled,
            separation: specimen.separation().name(),
            verification: specimen.descriptor.verification.to_string(),
        }
    }
}
