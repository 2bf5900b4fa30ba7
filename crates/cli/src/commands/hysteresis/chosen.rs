//! A law with its parameters.

use std::collections::BTreeMap;

use pounding_assembly::parameter_dimension;
use pounding_case::parse_quantity;
use pounding_catalogue::Descriptor;
use pounding_hysteresis::laboratory::{Specimen, exponent_of_example};
use pounding_hysteresis::{HysteresisError, LawDescriptor, LawParameters, ParameterDescriptor};
use serde::Serialize;

use crate::failure::Failure;

/// The law with the parameters of `--set`: without any, those of its example; else what
/// is missing and has no default is taken from there.
pub fn choose(descriptor: &'static LawDescriptor, set: &[String]) -> Result<Specimen, Failure> {
    Ok(Specimen::new(descriptor, given(descriptor, set)?)?)
}

/// The parameters of `--set` (SI), each checked for its dimension.
pub fn given(descriptor: &'static LawDescriptor, set: &[String]) -> Result<LawParameters, Failure> {
    let mut texts: Vec<(&ParameterDescriptor, &str, &str)> = Vec::new();
    for text in set {
        let (key, value) = text.split_once('=').ok_or_else(|| {
            Failure::input(
                format!("--set {text}: this is not KEY=VALUE"),
                Some("for example --set yield_force=\"137 kN\"".to_owned()),
            )
        })?;
        let key = key.trim();
        let parameter = descriptor.parameter(key).map_err(HysteresisError::from)?;
        if texts.iter().any(|(p, _, _)| p.name == key) {
            return Err(Failure::input(
                format!("--set {text}: {key} is given twice"),
                Some("leave one out".to_owned()),
            ));
        }
        texts.push((parameter, text, value));
    }
    // The exponent first: the unit of a coefficient follows from it.
    texts.sort_by_key(|(p, _, _)| p.name != "exponent");
    let mut parameters = LawParameters::default();
    for (parameter, text, value) in texts {
        let exponent = parameters.values.get("exponent").copied();
        let value = quantity(descriptor, parameter, exponent, (text, value))?;
        parameters.values.insert(parameter.name.to_owned(), value);
    }
    Ok(parameters)
}

fn quantity(
    descriptor: &LawDescriptor,
    parameter: &ParameterDescriptor,
    exponent: Option<f64>,
    (text, value): (&str, &str),
) -> Result<f64, Failure> {
    let quantity = parse_quantity(value)
        .map_err(|e| Failure::input(format!("--set {text}: {e}"), Some(e.help())))?;
    // Without a given exponent that of the example holds, unless the law has a default.
    let free = descriptor.parameters.iter().find(|p| p.name == "exponent");
    let required = free.is_some_and(|p| p.default.is_none());
    let exponent = exponent.or(exponent_of_example(descriptor).filter(|_| required));
    let wanted = parameter_dimension(descriptor, parameter, exponent);
    match quantity.dimension {
        Some(found) if found != wanted => Err(Failure::input(
            format!(
                "`{}` of law {} must be {wanted}, but \"{}\" is {found}",
                parameter.name, descriptor.name, quantity.text
            ),
            Some("correct the unit; plain numbers are SI".to_owned()),
        )),
        _ => Ok(quantity.value),
    }
}

/// The law and its parameters in a few lines.
pub fn text(specimen: &Specimen) -> String {
    let list = |of_example: bool| -> Vec<String> {
        specimen
            .stated()
            .filter(|(name, _)| specimen.filled.iter().any(|f| f == name) == of_example)
            .map(|(name, value)| format!("{name} = {}", specimen.with_unit(name, value).0))
            .collect()
    };
    let (own, example) = (list(false), list(true));
    let descriptor = specimen.descriptor;
    let mut text = format!("{} - {}\n", descriptor.name, descriptor.title);
    if !own.is_empty() {
        text.push_str(&format!("  {}\n", own.join(", ")));
    }
    if !example.is_empty() {
        text.push_str(&format!(
            "  from the example of its descriptor: {}\n",
            example.join(", ")
        ));
    }
    text.push_str(&format!("  {}\n", descriptor.verification));
    text
}

/// The law and its parameters as `key=value` pairs for the head of a file.
pub fn pairs(specimen: &Specimen) -> String {
    let stated = specimen.stated();
    let pairs: String = stated
        .map(|(name, value)| format!(" {name}={value:e}"))
        .collect();
    format!("law={}{pairs}", specimen.descriptor.name)
}

/// The law and its parameters for machines.
#[derive(Serialize)]
pub struct Chosen<'s> {
    law: &'static str,
    title: &'static str,
    parameters: &'s BTreeMap<String, f64>,
    filled_from_example: &'s [String],
    rate_dependent: bool,
    initial_stiffness: f64,
    verification: String,
}

impl<'s> Chosen<'s> {
    /// A specimen.
    pub fn of(specimen: &'s Specimen) -> Self {
        let descriptor = specimen.descriptor;
        Self {
            law: descriptor.name,
            title: descriptor.title,
            parameters: &specimen.parameters.values,
            filled_from_example: &specimen.filled,
            rate_dependent: descriptor.rate_dependent,
            initial_stiffness: specimen.law.initial_stiffness(),
            verification: descriptor.verification.to_string(),
        }
    }
}
