//! Numbers of the pages: few enough digits that no machine's round-off shows.

use pounding_gap_element::{ModelDescriptor, ModelParameters, ParameterUnit};

/// With this many decimals, and never as minus zero.
pub fn fixed(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let zero = text.bytes().all(|b| matches!(b, b'-' | b'0' | b'.'));
    if zero {
        text.trim_start_matches('-').to_owned()
    } else {
        text
    }
}

/// A parameter's own value, all digits, with an exponent where that is shorter.
pub fn plain(value: f64) -> String {
    let size = value.abs();
    if size != 0.0 && !(1.0e-3..1.0e5).contains(&size) {
        format!("{value:e}")
    } else {
        format!("{value}")
    }
}

/// A value with its unit as case files and arguments take it, if it has one.
pub fn with_unit(
    descriptor: &ModelDescriptor,
    parameters: &ModelParameters,
    name: &str,
    value: f64,
) -> (String, bool) {
    let known = descriptor.parameters.iter().find(|p| p.name == name);
    let number = plain(value);
    match known.map(|p| p.unit) {
        None | Some(ParameterUnit::One) => (number, false),
        Some(ParameterUnit::NewtonPerMetreToExponent) => {
            let exponent = exponent(descriptor, parameters);
            (format!("{number} N/m^{exponent}"), true)
        }
        Some(unit) => (format!("{number} {}", unit.symbol()), true),
    }
}

/// The exponent in the unit of the stiffness.
fn exponent(descriptor: &ModelDescriptor, parameters: &ModelParameters) -> f64 {
    let default = descriptor
        .parameters
        .iter()
        .find(|p| p.name == "exponent")
        .and_then(|p| p.default);
    let given = parameters.values.get("exponent").copied();
    given.or(default).unwrap_or(1.5)
}
