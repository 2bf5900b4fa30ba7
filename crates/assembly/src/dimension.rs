//! Where the units of a text meet the units of an impact model.

use pounding_case::Dimension;
use pounding_gap_element::{ModelDescriptor, ParameterDescriptor, ParameterUnit};
use pounding_hysteresis as hysteresis;

/// Dimension that a parameter of a law with memory must have; the unit of a density or
/// of a damper follows from the exponent of the law: the one given, or its default.
#[must_use]
pub fn law_parameter_dimension(
    law: &hysteresis::LawDescriptor,
    parameter: &hysteresis::ParameterDescriptor,
    exponent: Option<f64>,
) -> Dimension {
    use hysteresis::ParameterUnit as Unit;
    let exponent = || {
        let free = law.parameters.iter().find(|p| p.name == "exponent");
        exponent.or(free.and_then(|p| p.default)).unwrap_or(1.0)
    };
    match parameter.unit {
        Unit::One => Dimension::NUMBER,
        Unit::Newton => Dimension::FORCE,
        Unit::NewtonPerMetre => Dimension::STIFFNESS,
        Unit::NewtonPerMetreToExponent => Dimension::stiffness_with_exponent(2.0 + exponent()),
        Unit::NewtonSecondPerMetreToExponent => Dimension::dashpot_with_exponent(exponent()),
        Unit::NewtonSecondPerMetre => Dimension::DASHPOT,
        Unit::Metre => Dimension::LENGTH,
        Unit::MetrePerSecond => Dimension::VELOCITY,
    }
}

/// Dimension that a parameter of an impact model must have. The unit of a contact
/// stiffness follows from the exponent of the law: the one given, or the default of
/// the model, which is 1.5 where the law's exponent is fixed.
#[must_use]
pub fn parameter_dimension(
    model: &ModelDescriptor,
    parameter: &ParameterDescriptor,
    exponent: Option<f64>,
) -> Dimension {
    match parameter.unit {
        ParameterUnit::One => Dimension::NUMBER,
        ParameterUnit::NewtonPerMetre => Dimension::STIFFNESS,
        ParameterUnit::NewtonPerMetreToExponent => {
            let free = model.parameters.iter().find(|p| p.name == "exponent");
            let default = free.and_then(|p| p.default).unwrap_or(1.5);
            Dimension::stiffness_with_exponent(exponent.unwrap_or(default))
        }
        ParameterUnit::NewtonSecondPerMetre => Dimension::DASHPOT,
        ParameterUnit::SecondPerMetre => Dimension::SLOWNESS,
        ParameterUnit::Metre => Dimension::LENGTH,
        ParameterUnit::Second => Dimension::TIME,
    }
}
