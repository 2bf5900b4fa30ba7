//! Where the units of a text meet the units of a model or law.

use pounding_case::{Case, CaseError, Dimension, Located, Quantity, UnreadParameter};
use pounding_catalogue::{DefinitionError, Descriptor, ParameterDescriptor, ParameterUnit};
use pounding_gap_element::{GapElementError, registry};

/// Dimension that a parameter of an impact model or of a law with memory must have. Where its
/// unit follows from the exponent of the law, that is the one given, or the default, or the fixed
/// one: 1.5 of a spring, 1 of others.
#[must_use]
pub fn parameter_dimension(
    of: &impl Descriptor,
    parameter: &ParameterDescriptor,
    exponent: Option<f64>,
) -> Dimension {
    let exponent = exponent_of_units(of, parameter, exponent);
    match parameter.unit {
        ParameterUnit::One => Dimension::NUMBER,
        ParameterUnit::Newton => Dimension::FORCE,
        ParameterUnit::NewtonPerMetre => Dimension::STIFFNESS,
        ParameterUnit::NewtonPerMetreToExponent => Dimension::stiffness_with_exponent(exponent),
        ParameterUnit::NewtonPerMetreToTwoPlusExponent => {
            Dimension::stiffness_with_exponent(2.0 + exponent)
        }
        ParameterUnit::NewtonSecondPerMetre => Dimension::DASHPOT,
        ParameterUnit::NewtonSecondPerMetreToExponent => Dimension::dashpot_with_exponent(exponent),
        ParameterUnit::SecondPerMetre => Dimension::SLOWNESS,
        ParameterUnit::Metre => Dimension::LENGTH,
        ParameterUnit::MetrePerSecond => Dimension::VELOCITY,
        ParameterUnit::Second => Dimension::TIME,
    }
}

/// The exponent that a unit may follow from: that given, or the default, or the fixed one, 1.5 of a spring and 1
/// of others.
pub(crate) fn exponent_of_units(
    of: &impl Descriptor,
    parameter: &ParameterDescriptor,
    exponent: Option<f64>,
) -> f64 {
    let fixed = match parameter.unit {
        ParameterUnit::NewtonPerMetreToExponent => 1.5,
        _ => 1.0,
    };
    exponent.or(of.default_of("exponent")).unwrap_or(fixed)
}

/// The error of a parameter that its model or law has not at all; `None` where that is known, or
/// the model is not.
#[must_use]
pub fn unknown_parameter(case: &Case, given: &UnreadParameter) -> Option<CaseError> {
    let UnreadParameter { key, model, of_gap } = given;
    let (error, help) = if *of_gap {
        let descriptor = registry::find(&model.value).ok()?;
        let error = descriptor.parameter(&key.value).err()?;
        (error.to_string(), GapElementError::from(error).help())
    } else {
        let descriptor = pounding_hysteresis::find(&model.value).ok()?;
        let error = descriptor.parameter(&key.value).err()?;
        (error.to_string(), Some(error.help()))
    };
    Some(case.error(key.span.clone(), error, help))
}

/// The value (SI) of a parameter: known, of its dimension and within its range. `help` is what to
/// do about a name or value that is refused.
pub(crate) fn parameter_value<D: Descriptor>(
    case: &Case,
    of: &D,
    (key, value): (&Located<String>, &Located<Quantity>),
    exponent: Option<f64>,
    help: impl Fn(DefinitionError) -> Option<String>,
) -> Result<f64, CaseError> {
    parameter_value_as(
        case,
        of,
        (key, value),
        exponent,
        |dimension| dimension,
        help,
    )
}

/// The same, where the law is not that of a force and a displacement: `turned` makes of the
/// dimension of a parameter the one that it must have.
pub(crate) fn parameter_value_as<D: Descriptor>(
    case: &Case,
    of: &D,
    (key, value): (&Located<String>, &Located<Quantity>),
    exponent: Option<f64>,
    turned: impl Fn(Dimension) -> Dimension,
    help: impl Fn(DefinitionError) -> Option<String>,
) -> Result<f64, CaseError> {
    let refused = |span: &std::ops::Range<usize>, error: DefinitionError| {
        case.error(span.clone(), error.to_string(), help(error))
    };
    let (name, quantity) = (&key.value, &value.value);
    let parameter = of.parameter(name).map_err(|e| refused(&key.span, e))?;
    let wanted = turned(parameter_dimension(of, parameter, exponent));
    if let Some(found) = quantity.dimension.filter(|found| *found != wanted) {
        let is = match quantity.has_no_unit() {
            true => "has no unit".to_owned(),
            false => format!("is {found}"),
        };
        return Err(case.error(
            value.span.clone(),
            format!(
                "`{name}` of {} {} must be {wanted}, but \"{}\" {is}",
                D::NOUN,
                of.name(),
                quantity.text
            ),
            Some(match parameter.unit {
                _ if quantity.has_no_unit() => quantity.unit_help(),
                ParameterUnit::NewtonPerMetreToExponent => {
                    "correct the unit; the exponent of the law is in the unit of its stiffness"
                        .to_owned()
                }
                ParameterUnit::NewtonSecondPerMetreToExponent => {
                    "correct the unit; the exponent of the law is in the unit of its damping"
                        .to_owned()
                }
                _ => "correct the unit; plain numbers are SI".to_owned(),
            }),
        ));
    }
    of.check_value(name, quantity.value)
        .map_err(|e| refused(&value.span, e))?;
    Ok(quantity.value)
}
