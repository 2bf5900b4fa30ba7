//! A law with all its parameters, ready to be tested.

use pounding_catalogue::numbers::all_digits;

use super::LaboratoryError;
use crate::descriptor::{LawDescriptor, ParameterUnit};
use crate::error::HysteresisError;
use crate::iwan::IwanDensity;
use crate::law::HysteresisLaw;
use crate::parameters::LawParameters;
use crate::registry::build;

/// Longest path over the yield deformation for laws that are integrated along it: the
/// work grows with it, for exponents above this one in proportion to them as well.
const LONGEST: f64 = 2.0e6;
const USUAL_EXPONENT: f64 = 2.0;

/// A law with its parameters.
pub struct Specimen {
    /// Its descriptor.
    pub descriptor: &'static LawDescriptor,
    /// Parameters (SI), given and filled in.
    pub parameters: LawParameters,
    /// Names of those that were filled in from the descriptor's example.
    pub filled: Vec<String>,
    /// The law itself.
    pub law: Box<dyn HysteresisLaw>,
}

impl Specimen {
    /// The law with given parameters: without any, those of its example; else what is missing
    /// and has no default is taken from there.
    ///
    /// # Errors
    /// [`LaboratoryError::Parameters`]: the law does not take them, or not together.
    pub fn new(
        descriptor: &'static LawDescriptor,
        given: LawParameters,
    ) -> Result<Self, LaboratoryError> {
        let nothing_given = given.values.is_empty();
        let mut parameters = given;
        // The example's coefficient belongs to the example's exponent.
        let known = |name: &str| descriptor.parameters.iter().find(|p| p.name == name);
        let default = known("exponent").and_then(|p| p.default);
        let own_exponent =
            (parameters.values.get("exponent").copied()).or(default.filter(|_| !nothing_given));
        let example_exponent = exponent_of_example(descriptor);
        let foreign = |name: &str| {
            let by_exponent = known(name).is_some_and(|p| {
                matches!(
                    p.unit,
                    ParameterUnit::NewtonPerMetreToTwoPlusExponent
                        | ParameterUnit::NewtonSecondPerMetreToExponent
                )
            });
            by_exponent && own_exponent.is_some() && example_exponent != own_exponent
        };
        let required = |name: &str| known(name).is_some_and(|p| p.default.is_none());
        let mut filled = Vec::new();
        for (name, value) in descriptor.example {
            let wanted = nothing_given || required(name);
            if wanted && !foreign(name) && !parameters.values.contains_key(*name) {
                parameters.values.insert((*name).to_owned(), *value);
                filled.push((*name).to_owned());
            }
        }
        match build(descriptor.name, &parameters) {
            Ok(law) => Ok(Self {
                descriptor,
                parameters,
                filled,
                law,
            }),
            Err(source) => Err(LaboratoryError::Parameters { source, filled }),
        }
    }

    /// The law of a density, such as a fitted one.
    ///
    /// # Errors
    /// [`HysteresisError`]: the law does not take it.
    pub fn of_density(
        descriptor: &'static LawDescriptor,
        density: &IwanDensity,
    ) -> Result<Self, HysteresisError> {
        let parameters = density.parameters();
        Ok(Self {
            descriptor,
            law: build(descriptor.name, &parameters)?,
            parameters,
            filled: Vec::new(),
        })
    }

    /// Parameters that are not left at their default, in the order of the descriptor (SI).
    pub fn stated(&self) -> impl Iterator<Item = (&'static str, f64)> {
        let values = &self.parameters.values;
        let all = self.descriptor.parameters.iter();
        all.filter_map(|p| Some((p.name, *values.get(p.name)?)))
    }

    /// A value (SI) with its unit as case files and arguments take it, and whether it has one.
    #[must_use]
    pub fn with_unit(&self, name: &str, value: f64) -> (String, bool) {
        let unit = self.unit(name);
        if unit.is_empty() {
            (all_digits(value), false)
        } else {
            (format!("{} {unit}", all_digits(value)), true)
        }
    }

    /// Unit of a parameter as case files and arguments take it; empty without one.
    fn unit(&self, parameter: &str) -> String {
        let known = |name: &str| self.descriptor.parameters.iter().find(|p| p.name == name);
        let given = self.parameters.values.get("exponent").copied();
        let default = known("exponent").and_then(|p| p.default);
        let exponent = given.or(default).unwrap_or(1.0);
        known(parameter).map_or_else(String::new, |p| p.unit.with_exponent(exponent))
    }

    /// Refuses a path of this length (m) far beyond yield to a law that has to be integrated
    /// along it.
    ///
    /// # Errors
    /// [`LaboratoryError::TooLong`].
    pub fn reaches(&self, length: f64) -> Result<(), LaboratoryError> {
        let value = |name: &str| self.parameters.values.get(name).copied();
        let (Some(stiffness), Some(yield_force)) = (value("stiffness"), value("yield_force"))
        else {
            return Ok(());
        };
        let law = self.descriptor.name;
        let integrated = self.law.internal_variables() > 0;
        let sharper = value("exponent").map_or(1.0, |n| (n / USUAL_EXPONENT).max(1.0));
        let (ratio, most) = (length * stiffness / yield_force, LONGEST / sharper);
        if !integrated || ratio <= most {
            return Ok(());
        }
        Err(LaboratoryError::TooLong {
            law,
            length,
            ratio,
            most,
        })
    }
}

/// The exponent in the example of a descriptor.
#[must_use]
pub fn exponent_of_example(descriptor: &LawDescriptor) -> Option<f64> {
    let mut pairs = descriptor.example.iter();
    pairs.find(|(name, _)| *name == "exponent").map(|e| e.1)
}
