//! Periods or frequencies of a spectrum, by its options.

use pounding_case::Dimension;
use pounding_ground_motion::GroundMotionError;
use pounding_ground_motion::spectra::logarithmic_periods;

use crate::arguments::{SpectrumArguments, ascending, frequency, list, once, value};
use crate::failure::Failure;

/// Places of a spectrum: those given, or evenly spaced in their logarithm.
pub fn places(
    arguments: &SpectrumArguments,
    default: (f64, f64, usize),
    dimension: Dimension,
) -> Result<Vec<f64>, Failure> {
    let place = |text: &str, name: &str| match dimension == Dimension::FREQUENCY {
        true => frequency(text, name),
        false => value(text, name, dimension),
    };
    if let Some(text) = &arguments.at {
        let places = list(text, "at", dimension)?;
        let unit = match dimension == Dimension::FREQUENCY {
            true => " Hz",
            false => " s",
        };
        once("at", &places, unit)?;
        return Ok(places);
    }
    let end = |text: &Option<String>, name, default| match text {
        Some(text) => place(text, name),
        None => Ok(default),
    };
    let from = end(&arguments.from, "from", default.0)?;
    let to = end(&arguments.to, "to", default.1)?;
    let unit = if dimension == Dimension::TIME {
        "s"
    } else {
        "Hz"
    };
    ascending(("from", from), ("to", to), unit)?;
    let count = arguments.count.unwrap_or(default.2);
    logarithmic_periods(from, to, count).map_err(|e| named(e, arguments))
}

/// An error of the library under the option that it comes from.
pub fn named(error: GroundMotionError, arguments: &SpectrumArguments) -> Failure {
    let option = match &error {
        GroundMotionError::OutOfRange { name, .. } => match *name {
            "damping ratio" => Some("damping"),
            "bandwidth coefficient" => Some("smoothing"),
            "number of periods" => Some("count"),
            "last period" => Some("to"),
            _ if arguments.at.is_some() => Some("at"),
            _ => Some("from"),
        },
        // Two components that do not fit together have nothing to do with the periods.
        GroundMotionError::NotPossible { step, .. } if *step == "rotation" => None,
        GroundMotionError::NotPossible { .. } if arguments.at.is_some() => Some("at"),
        _ => None,
    };
    match option {
        Some(option) => Failure::input(format!("--{option}: {error}"), error.help()),
        None => error.into(),
    }
}
