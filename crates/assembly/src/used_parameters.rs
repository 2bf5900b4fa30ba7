//! Parameters of models and laws as they are used.

use std::collections::BTreeMap;

use pounding_catalogue::numbers::six_digits;
use pounding_catalogue::{Descriptor, ParameterUnit};
use serde::Serialize;

use crate::dimension::exponent_of_units;

/// The parameters of a model of a level, or of the law of a storey or a link: those of the case, and
/// defaults of the others that have one, in the order of the descriptor.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(transparent)]
pub struct UsedParameters(Vec<UsedParameter>);

/// One of them.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct UsedParameter {
    /// Its key in case files.
    pub name: &'static str,
    /// Value (SI).
    pub value: f64,
    /// SI unit as case files take it; empty of a pure number.
    pub unit: String,
    /// Whether the case says it; else it is the default.
    pub is_given: bool,
}

impl UsedParameters {
    /// Those of a law of forces and displacements, or of moments and rotations.
    pub(crate) fn of(
        descriptor: &impl Descriptor,
        given: impl IntoIterator<Item = (String, f64)>,
        rotates: bool,
    ) -> Self {
        let given: BTreeMap<String, f64> = given.into_iter().collect();
        let exponent = given.get("exponent").copied();
        let used = descriptor.parameters().iter().filter_map(|parameter| {
            let stated = given.get(parameter.name).copied();
            Some(UsedParameter {
                name: parameter.name,
                value: stated.or(parameter.default)?,
                unit: {
                    let exponent = exponent_of_units(descriptor, parameter, exponent);
                    match rotates {
                        true => of_rotation(parameter.unit, exponent),
                        false => parameter.unit.with_exponent(exponent),
                    }
                },
                is_given: stated.is_some(),
            })
        });
        Self(used.collect())
    }

    /// All of them.
    pub fn iter(&self) -> impl Iterator<Item = &UsedParameter> {
        self.0.iter()
    }
}

/// The unit of a parameter where moments are in the place of forces, and rotations, which have none, in that of
/// displacements.
fn of_rotation(unit: ParameterUnit, exponent: f64) -> String {
    match unit {
        ParameterUnit::One | ParameterUnit::Metre => String::new(),
        ParameterUnit::Newton
        | ParameterUnit::NewtonPerMetre
        | ParameterUnit::NewtonPerMetreToExponent
        | ParameterUnit::NewtonPerMetreToTwoPlusExponent => "N m".to_owned(),
        ParameterUnit::NewtonSecondPerMetre => "N m s".to_owned(),
        ParameterUnit::NewtonSecondPerMetreToExponent if exponent == 1.0 => "N m s".to_owned(),
        ParameterUnit::NewtonSecondPerMetreToExponent => format!("N m s^{exponent}"),
        ParameterUnit::SecondPerMetre | ParameterUnit::Second => "s".to_owned(),
        ParameterUnit::MetrePerSecond => "1/s".to_owned(),
    }
}

impl std::fmt::Display for UsedParameters {
    /// `stiffness 9.35e7 N/m, restitution 0.65`, those that are defaults behind the others.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let told = |is_given: bool| {
            let those = self.0.iter().filter(move |p| p.is_given == is_given);
            let told = those.map(|p| {
                let value = six_digits(p.value);
                format!("{} {}", p.name, format!("{value} {}", p.unit).trim_end())
            });
            told.collect::<Vec<_>>().join(", ")
        };
        let (given, defaults) = (told(true), told(false));
        match (given.is_empty(), defaults.is_empty()) {
            (_, true) => f.write_str(&given),
            (true, false) => write!(f, "by default {defaults}"),
            (false, false) => write!(f, "{given}; by default {defaults}"),
        }
    }
}
