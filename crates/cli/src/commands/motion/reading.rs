//! From arguments to a record.

use std::path::Path;

use pounding_case::Dimension;
use pounding_ground_motion::{
    AccelerationUnit, Accelerogram, Format, Offset, Quantity, ReadOptions, read,
};

use crate::arguments::value;
use crate::arguments::{OffsetWord, ReadArguments};
use crate::failure::Failure;

/// Counts per m/s2.
const SENSITIVITY: Dimension = Dimension {
    mass: 0.0,
    length: -1.0,
    time: 2.0,
};

/// The options of the library; `unless` is what becomes of the mean by default.
pub fn options(arguments: &ReadArguments, unless: Offset) -> Result<ReadOptions, Failure> {
    let positive = |text: &Option<String>, name: &str, dimension| {
        let read = |text: &String| match value(text, name, dimension)? {
            number if number > 0.0 => Ok(number),
            number => Err(Failure::input(
                format!("--{name} = {number} must be greater than zero"),
                Some(format!("correct it, or leave --{name} out")),
            )),
        };
        text.as_ref().map(read).transpose()
    };
    Ok(ReadOptions {
        format: arguments.format.as_deref().map(Format::find).transpose()?,
        time_step: positive(&arguments.time_step, "time-step", Dimension::TIME)?,
        unit: arguments
            .unit
            .as_deref()
            .map(str::parse::<AccelerationUnit>)
            .transpose()?,
        layout: arguments.layout.clone(),
        component: arguments.component.clone(),
        quantity: None,
        skip_lines: arguments.skip_lines,
        skip_columns: arguments.skip_columns,
        prepend_zero: arguments.prepend_zero,
        lenient: arguments.lenient,
        sensitivity: positive(&arguments.sensitivity, "sensitivity", SENSITIVITY)?,
        response: arguments.response.as_ref().map(|p| p.to_path_buf()),
        gravity: positive(&arguments.gravity, "gravity", Dimension::ACCELERATION)?,
        offset: match arguments.offset {
            None => unless,
            Some(OffsetWord::Automatic) => Offset::Automatic,
            Some(OffsetWord::Keep) => Offset::Keep,
            Some(OffsetWord::Remove) => Offset::Remove,
        },
    })
}

/// The quantity of a word.
pub fn quantity(word: &str) -> Result<Quantity, Failure> {
    Quantity::from_name(word).ok_or_else(|| {
        Failure::input(
            format!("unknown quantity \"{word}\""),
            Some("write acceleration, velocity or displacement".to_owned()),
        )
    })
}

/// The acceleration that the arguments choose.
pub fn acceleration(path: &Path, arguments: &ReadArguments) -> Result<Accelerogram, Failure> {
    Ok(read(path, &options(arguments, Offset::Automatic)?)?)
}

/// What was read, for the screen.
pub fn reported(record: &Accelerogram) -> String {
    let mut text = String::new();
    for line in record.echo() {
        text.push_str(&format!("  {line}\n"));
    }
    text.push_str(&warned(record.origin().map_or(&[], |o| &o.warnings)));
    text
}

/// Warnings, a line each, for the screen.
pub fn warned(warnings: &[String]) -> String {
    let lines = warnings.iter().map(|w| format!("warning: {w}\n"));
    lines.collect()
}
