//! Values of arguments: texts with units.

use std::f64::consts::TAU;

use pounding_case::{Dimension, parse_quantity};
use pounding_catalogue::numbers::six_digits;

use crate::failure::Failure;

/// Damping ratio of spectra where none is given.
pub const DAMPING: &str = "5 %";

/// A number without dimension, such as `0.1` or `10 %`.
pub fn number(text: &str) -> Result<f64, String> {
    of_dimension(text, Dimension::NUMBER)
}

/// A velocity (m/s) above zero, such as `0.5 m/s` or `50 cm/s`.
pub fn positive_velocity(text: &str) -> Result<f64, String> {
    let velocity = of_dimension(text, Dimension::VELOCITY)?;
    if velocity > 0.0 {
        return Ok(velocity);
    }
    Err(
        "it must be greater than zero: bodies that do not approach each other do not touch"
            .to_owned(),
    )
}

/// The value (SI) of an option that must have this dimension; a plain number is SI.
pub fn value(text: &str, option: &str, wanted: Dimension) -> Result<f64, Failure> {
    let quantity = parse_quantity(text)
        .map_err(|e| Failure::input(format!("--{option}: {e}"), Some(e.help_for(Some(wanted)))))?;
    match quantity.dimension {
        Some(found) if found != wanted => Err(Failure::input(
            format!("--{option} must be {wanted}, but \"{text}\" is {found}"),
            Some("plain numbers are SI".to_owned()),
        )),
        _ => Ok(quantity.value),
    }
}

/// The value (Hz) of an option that must be a frequency: an angle per second, such as "15.6 rad/s", is a circular one.
pub fn frequency(text: &str, name: &str) -> Result<f64, Failure> {
    let found = value(text, name, Dimension::FREQUENCY)?;
    Ok(if text.contains("rad") {
        found / TAU
    } else {
        found
    })
}

/// Seconds of a time limit, which is also given in minutes, hours and days.
pub fn time_limit(text: &str, option: &str) -> Result<f64, Failure> {
    let long = [("min", 60.0), ("h", 3600.0), ("d", 86_400.0)];
    let of_unit = |(unit, seconds): &(&str, f64)| {
        let number = text.trim().strip_suffix(unit)?.trim_end().parse::<f64>();
        Some(number.ok()? * seconds)
    };
    match long.iter().find_map(of_unit) {
        Some(seconds) => Ok(seconds),
        None => value(text, option, Dimension::TIME),
    }
}

/// Whether a quantity was written without a unit.
pub fn is_bare(text: &str) -> bool {
    text.trim().parse::<f64>().is_ok()
}

/// The value of an option that may be left out.
pub fn optional(
    text: Option<&str>,
    option: &str,
    wanted: Dimension,
) -> Result<Option<f64>, Failure> {
    text.map(|text| value(text, option, wanted)).transpose()
}

/// The same, greater than zero, `option` with an example of its value.
pub fn positive(
    text: &str,
    (option, example): (&str, &str),
    wanted: Dimension,
) -> Result<f64, Failure> {
    let value = value(text, option, wanted)?;
    if value > 0.0 {
        return Ok(value);
    }
    Err(Failure::input(
        format!("--{option} is \"{text}\", but it must be greater than zero"),
        Some(format!("for example --{option} \"{example}\"")),
    ))
}

/// The value (SI) of a text with a unit of this dimension, or what is wrong with it.
pub fn of_dimension(text: &str, wanted: Dimension) -> Result<f64, String> {
    let quantity =
        parse_quantity(text).map_err(|e| format!("{e}; {}", e.help_for(Some(wanted))))?;
    match quantity.dimension {
        Some(found) if found != wanted => Err(format!(
            "it must be {wanted}, but this is {found}; plain numbers are SI"
        )),
        _ => Ok(quantity.value),
    }
}

/// Refuses values of a list some of which have a unit and some none: a comma in a number divides it into two, and a unit
/// behind the last value is no unit of the others.
pub fn with_units_alike<'a>(
    option: &str,
    parts: impl Iterator<Item = &'a str> + Clone,
) -> Result<(), Failure> {
    // Zero is the same in every unit; behind a decimal comma stands no blank.
    let is_zero = |part: &str| part.trim().parse() == Ok(0.0);
    let next = parts
        .clone()
        .skip(1)
        .map(|next| next.starts_with(' '))
        .chain([false]);
    let mut bare = parts.clone().zip(next);
    let bare = bare.find(|(part, apart)| is_bare(part) && !(is_zero(part) && *apart));
    let bare = bare.map(|(part, _)| part);
    let united = parts.into_iter().find(|part| !is_bare(part));
    let (Some(bare), Some(united)) = (bare, united) else {
        return Ok(());
    };
    let (bare, united) = (bare.trim(), united.trim());
    Err(Failure::input(
        format!("--{option}: \"{bare}\" has no unit beside \"{united}\""),
        Some(
            "write decimal points, as commas divide values, and give each value its unit"
                .to_owned(),
        ),
    ))
}

/// Refuses a number that stands twice in a list.
pub fn once(option: &str, numbers: &[f64], unit: &str) -> Result<(), Failure> {
    let twice = |(place, number): &(usize, &f64)| numbers[..*place].contains(number);
    match numbers.iter().enumerate().find(twice) {
        None => Ok(()),
        Some((_, number)) => Err(Failure::input(
            format!("--{option}: {number}{unit} stands twice"),
            Some("give it once; commas divide values, and numbers have decimal points".to_owned()),
        )),
    }
}

/// SI values divided by commas; frequencies in Hz.
pub fn list(text: &str, name: &str, dimension: Dimension) -> Result<Vec<f64>, Failure> {
    let of_dimension = |part: &str| match dimension == Dimension::FREQUENCY {
        true => frequency(part, name),
        false => value(part, name, dimension),
    };
    let values = text.split(',').map(|part| of_dimension(part.trim()));
    let values = values.collect::<Result<Vec<f64>, Failure>>()?;
    with_units_alike(name, text.split(','))?;
    Ok(values)
}

/// Refuses two options of which the first is not below the second.
pub fn ascending(
    (first_option, first): (&str, f64),
    (last_option, last): (&str, f64),
    unit: &str,
) -> Result<(), Failure> {
    if first < last {
        return Ok(());
    }
    Err(Failure::input(
        format!(
            "--{first_option} = {} {unit} is not below --{last_option} = {} {unit}",
            six_digits(first),
            six_digits(last)
        ),
        Some("give the smaller one first".to_owned()),
    ))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    /// A decimal comma divides a number into two.
    #[test]
    fn lists_have_units_alike() {
        let times = |text: &str| list(text, "at", Dimension::TIME);
        assert_eq!(times("0.1 s, 500 ms").unwrap(), [0.1, 0.5]);
        assert_eq!(times("0.1, 0.5").unwrap(), [0.1, 0.5]);
        assert_eq!(times("0, 0.5 s").unwrap(), [0.0, 0.5]);
        for text in ["0,1 s", "1,5 s", "0,1 s, 0,5 s", "0.2, 0.5 s", "1 s, 2"] {
            assert!(times(text).is_err(), "{text}");
        }
    }

    #[test]
    fn units_are_taken_and_checked() {
        for text in ["0.1", "10 %", "10%"] {
            assert!((number(text).unwrap() - 0.1).abs() < 1e-15, "{text}");
        }
        for text in ["0.5", "0.5 m/s", "50 cm/s", "500 mm/s"] {
            assert!(
                (positive_velocity(text).unwrap() - 0.5).abs() < 1e-15,
                "{text}"
            );
        }
        for (found, part) in [
            (number("0.1 m"), "a length"),
            (positive_velocity("1 s"), "a velocity"),
            (positive_velocity("0 m/s"), "greater than zero"),
            (positive_velocity("-0.5 m/s"), "greater than zero"),
            (positive_velocity("fast"), "does not start with a number"),
            (number("nan"), "nan"),
        ] {
            let message = found.unwrap_err();
            assert!(message.contains(part), "{message}");
        }
    }
}
