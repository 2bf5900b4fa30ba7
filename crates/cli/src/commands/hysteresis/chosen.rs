//! A law with its parameters.

use pounding_assembly::parameter_dimension;
use pounding_case::parse_quantity;
use pounding_catalogue::{DefinitionError, Descriptor};
use pounding_hysteresis::iwan::IwanDensity;
use pounding_hysteresis::{
    HysteresisError, HysteresisLaw, LawDescriptor, LawParameters, ParameterDescriptor,
    ParameterUnit, build,
};
use serde_json::{Map, Value, json};

use crate::commands::models::numbers::plain;
use crate::failure::Failure;

/// A law, ready to be driven.
pub struct Chosen {
    /// Its descriptor.
    pub descriptor: &'static LawDescriptor,
    /// Parameters, given and filled in.
    pub parameters: LawParameters,
    /// Names of those that were filled in from the descriptor's example.
    pub filled: Vec<String>,
    /// The law itself.
    pub law: Box<dyn HysteresisLaw>,
}

/// The law with the parameters of `--set`: without any, those of its example; else what
/// is missing and has no default is taken from there.
pub fn choose(descriptor: &'static LawDescriptor, set: &[String]) -> Result<Chosen, Failure> {
    let mut parameters = given(descriptor, set)?;
    // The example's coefficient belongs to the example's exponent.
    let free = descriptor.parameters.iter().find(|p| p.name == "exponent");
    let default = free.and_then(|p| p.default).filter(|_| !set.is_empty());
    let own_exponent = parameters.values.get("exponent").copied().or(default);
    let foreign = |name: &str| {
        let unit = descriptor.parameters.iter().find(|p| p.name == name);
        let by_exponent = unit.is_some_and(|p| {
            matches!(
                p.unit,
                ParameterUnit::NewtonPerMetreToTwoPlusExponent
                    | ParameterUnit::NewtonSecondPerMetreToExponent
            )
        });
        let example = descriptor
            .example
            .iter()
            .find(|(name, _)| *name == "exponent");
        by_exponent && own_exponent.is_some() && example.map(|e| e.1) != own_exponent
    };
    let required = |name: &str| {
        let known = descriptor.parameters.iter().find(|p| p.name == name);
        known.is_some_and(|p| p.default.is_none())
    };
    let mut filled = Vec::new();
    for (name, value) in descriptor.example {
        let wanted = set.is_empty() || required(name);
        if wanted && !foreign(name) && !parameters.values.contains_key(*name) {
            parameters.values.insert((*name).to_owned(), *value);
            filled.push((*name).to_owned());
        }
    }
    let law = build(descriptor.name, &parameters).map_err(|e| refused(e, &filled))?;
    Ok(Chosen {
        descriptor,
        parameters,
        filled,
        law,
    })
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
    let example = descriptor
        .example
        .iter()
        .find(|(name, _)| *name == "exponent");
    let required = free.is_some_and(|p| p.default.is_none());
    let exponent = exponent.or(example.filter(|_| required).map(|e| e.1));
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

/// A refusal, with a hint where a value of the example may be the cause.
fn refused(error: HysteresisError, filled: &[String]) -> Failure {
    let mut help = match &error {
        HysteresisError::Definition(DefinitionError::MissingParameter { parameter, .. }) => {
            format!("add --set {parameter}=VALUE: the example's belongs to another exponent")
        }
        _ => error.help().unwrap_or_default(),
    };
    if matches!(error, HysteresisError::Inconsistent { .. }) && !filled.is_empty() {
        help.push_str(&format!(
            "; from the example of the descriptor are {}",
            filled.join(", ")
        ));
    }
    Failure::input(error.to_string(), Some(help))
}

/// Unit of a parameter as case files and arguments take it; empty without one.
pub fn unit(descriptor: &LawDescriptor, parameters: &LawParameters, parameter: &str) -> String {
    let given = parameters.values.get("exponent").copied();
    let free = descriptor.parameters.iter().find(|p| p.name == "exponent");
    let exponent = given.or(free.and_then(|p| p.default)).unwrap_or(1.0);
    // Sums of decimal powers carry noise that no reader wants to see.
    let power = |power: f64| match (power * 1e9).round() / 1e9 {
        1.0 => String::new(),
        power => format!("^{power}"),
    };
    let known = descriptor.parameters.iter().find(|p| p.name == parameter);
    match known.map(|p| p.unit) {
        None | Some(ParameterUnit::One) => String::new(),
        Some(ParameterUnit::NewtonPerMetreToTwoPlusExponent) => {
            format!("N/m{}", power(2.0 + exponent))
        }
        Some(ParameterUnit::NewtonSecondPerMetreToExponent) => {
            format!("N s{0}/m{0}", power(exponent))
        }
        Some(unit) => unit.symbol().to_owned(),
    }
}

impl Chosen {
    /// The law of a fitted density.
    pub fn fitted(
        descriptor: &'static LawDescriptor,
        density: &IwanDensity,
    ) -> Result<Self, Failure> {
        let parameters = LawParameters::from_pairs(&[
            ("density", density.density),
            ("exponent", density.exponent),
            ("phi_1", density.phi_1),
            ("phi_2", density.phi_2),
            ("slider_stiffness", density.slider_stiffness),
            ("residual_stiffness", density.residual_stiffness),
        ]);
        Ok(Self {
            descriptor,
            law: build(descriptor.name, &parameters)?,
            parameters,
            filled: Vec::new(),
        })
    }

    /// A value with its unit as case files and arguments take it, and whether it has one.
    pub fn with_unit(&self, name: &str, value: f64) -> (String, bool) {
        let unit = unit(self.descriptor, &self.parameters, name);
        if unit.is_empty() {
            (plain(value), false)
        } else {
            (format!("{} {unit}", plain(value)), true)
        }
    }

    /// Parameters that are not left at their default, in the order of the descriptor.
    pub fn stated(&self) -> impl Iterator<Item = (&'static str, f64)> {
        let values = &self.parameters.values;
        self.descriptor
            .parameters
            .iter()
            .filter_map(|p| Some((p.name, *values.get(p.name)?)))
    }

    /// The law and its parameters in a few lines.
    pub fn text(&self) -> String {
        let list = |of_example: bool| -> Vec<String> {
            self.stated()
                .filter(|(name, _)| self.filled.iter().any(|f| f == name) == of_example)
                .map(|(name, value)| format!("{name} = {}", self.with_unit(name, value).0))
                .collect()
        };
        let (own, example) = (list(false), list(true));
        let mut text = format!("{} - {}\n", self.descriptor.name, self.descriptor.title);
        if !own.is_empty() {
            text.push_str(&format!("  {}\n", own.join(", ")));
        }
        if !example.is_empty() {
            text.push_str(&format!(
                "  from the example of its descriptor: {}\n",
                example.join(", ")
            ));
        }
        text.push_str(&format!("  {}\n", self.descriptor.verification));
        text
    }

    /// The law and its parameters as `key=value` pairs for the head of a file.
    pub fn pairs(&self) -> String {
        let mut text = format!("law={}", self.descriptor.name);
        for (name, value) in self.stated() {
            text.push_str(&format!(" {name}={value:e}"));
        }
        text
    }

    /// The law and its parameters for machines.
    pub fn json(&self) -> Map<String, Value> {
        let mut object = Map::new();
        object.insert("law".into(), json!(self.descriptor.name));
        object.insert("title".into(), json!(self.descriptor.title));
        object.insert("parameters".into(), json!(self.parameters.values));
        object.insert("filled_from_example".into(), json!(self.filled));
        object.insert(
            "rate_dependent".into(),
            json!(self.descriptor.rate_dependent),
        );
        object.insert(
            "initial_stiffness".into(),
            json!(self.law.initial_stiffness()),
        );
        object.insert(
            "verification".into(),
            json!(self.descriptor.verification.to_string()),
        );
        object
    }
}
