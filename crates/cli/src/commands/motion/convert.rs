//! `pounding motion convert`: a series in another format.

use std::path::Path;

use pounding_catalogue::numbers::six_digits;
use pounding_catalogue::wording::counted;
use pounding_ground_motion::writers::{
    Column, Written, write_peer_at2, write_plain_columns, write_pounding_csv,
};
use pounding_ground_motion::{AccelerationUnit, Offset, Processing, Quantity, read_all};
use serde::Serialize;

use super::reading;
use crate::arguments::{ConvertArguments, Layout};
use crate::failure::Failure;
use crate::output::{pretty, print};
use crate::plot;
use crate::tables::warning_lines;

/// What is lost where a file has no header.
const RAW_IN_COLUMNS: &str = "the record is raw, which plain columns do not say: give `offset = \"remove\"` where they are used";

/// Writes one series, values as they are.
pub fn convert(arguments: &ConvertArguments) -> Result<(), Failure> {
    let mut options = reading::options(&arguments.read, Offset::Keep)?;
    options.quantity = Some(reading::quantity(&arguments.quantity)?);
    let recording = read_all(&arguments.file, &options)?;
    let series = recording.choose(&options)?;
    let of_excitation = [
        ("prepend-zero", arguments.read.prepend_zero),
        ("offset", arguments.read.offset.is_some()),
    ];
    if let Some((option, _)) = of_excitation.iter().find(|(_, given)| *given)
        && series.quantity != Quantity::Acceleration
    {
        return Err(Failure::input(
            format!(
                "--{option} is of accelerations, and a {} is written as it is",
                series.quantity
            ),
            Some("leave it out, or convert the acceleration".to_owned()),
        ));
    }
    let mut warnings = series.origin.warnings.clone();
    let mut written = if series.quantity == Quantity::Acceleration {
        let record = series.accelerogram(&options)?;
        // Those of the excitation are of its mean and its peak too.
        if let Some(origin) = record.origin() {
            warnings.clone_from(&origin.warnings);
        }
        Written {
            // Times of what is written anew count from its first sample.
            first_time: None,
            ..Written::of(&record)
        }
    } else {
        Written::of_series(&series)?
    };
    if arguments.output_unit.is_some() && arguments.to != Layout::PlainColumns {
        return Err(Failure::input(
            "--output-unit is of plain columns: the other formats have a unit of their own",
            Some("add --to plain_columns, or leave --output-unit out".to_owned()),
        ));
    }
    // Before the unit is read, as those of velocities are none that it could be.
    if arguments.output_unit.is_some() && written.quantity != Quantity::Acceleration {
        return Err(Failure::input(
            format!(
                "--output-unit is of accelerations, and a {} is written in {}",
                written.quantity,
                written.quantity.si_symbol()
            ),
            Some("leave it out, or convert the acceleration".to_owned()),
        ));
    }
    let unit = arguments
        .output_unit
        .as_deref()
        .map(str::parse::<AccelerationUnit>)
        .transpose()?;
    if arguments.columns.is_some() && arguments.to != Layout::PlainColumns {
        return Err(Failure::input(
            "--columns is of plain columns: the other formats have columns of their own",
            Some("add --to plain_columns, or leave --columns out".to_owned()),
        ));
    }
    let (text, symbol) = match arguments.to {
        Layout::PoundingCsv => (write_pounding_csv(&written)?, "m/s2"),
        Layout::PeerAt2 => (
            write_peer_at2(&written),
            match written.quantity {
                Quantity::Acceleration => "g",
                Quantity::Velocity => "cm/s",
                Quantity::Displacement => "cm",
            },
        ),
        Layout::PlainColumns => {
            let wanted = columns(arguments.columns.as_deref().unwrap_or("t,a"))?;
            write_plain_columns(&written, &wanted, unit)
        }
    };
    let lost = losses(&written, arguments.to);
    let notes = lost.iter().map(|loss| format!("Note: {loss}"));
    written.remarks.extend(notes);
    warnings.extend(lost);
    plot::write(&arguments.output, &text)?;
    if arguments.json {
        return print(&pretty(&Converted {
            output: &arguments.output,
            quantity: written.quantity.name(),
            component: &written.component,
            unit: symbol,
            samples: written.samples.len(),
            time_step: written.time_step,
            remarks: &written.remarks,
            warnings: &warnings,
        })?);
    }
    let mut text = format!(
        "{}: {}, {} at {} s\n",
        arguments.file.display(),
        series.label(),
        counted(written.samples.len(), "sample"),
        written.time_step
    );
    text.push_str(&warning_lines(&warnings));
    text.push_str(&format!(
        "written to {} in {symbol}\n",
        arguments.output.display()
    ));
    print(&text)
}

/// What a series says that a format has no place for.
fn losses(written: &Written, to: Layout) -> Vec<String> {
    let mut lost = Vec::new();
    if to == Layout::PlainColumns && written.processing == Processing::Raw {
        lost.push(RAW_IN_COLUMNS.to_owned());
    }
    if to == Layout::PoundingCsv {
        return lost;
    }
    if let Some((velocity, displacement)) = written.initial
        && (velocity, displacement) != (0.0, 0.0)
        && written.quantity == Quantity::Acceleration
    {
        lost.push(format!(
            "velocity and displacement of the first sample, {} m/s and {} m, are not written, as the format has no place for them: integrals of the acceleration start at zero; pounding_csv holds them",
            six_digits(velocity),
            six_digits(displacement)
        ));
    }
    if !written.start_time.is_empty() {
        lost.push(format!(
            "the time of the first sample, {}, is not written, as the format has no place for it: components in files of their own are then not held against one another; pounding_csv holds it",
            written.start_time
        ));
    }
    lost
}

fn columns(text: &str) -> Result<Vec<Column>, Failure> {
    let columns: Option<Vec<Column>> = text
        .split(',')
        .map(|word| match word.trim() {
            "t" => Some(Column::Time),
            "a" | "v" | "d" => Some(Column::Value),
            _ => None,
        })
        .collect();
    columns
        .filter(|c| c.iter().filter(|c| **c == Column::Value).count() == 1 && c.len() <= 2)
        .ok_or_else(|| {
            Failure::input(
                format!("--columns \"{text}\" is not \"a\" or \"t,a\""),
                Some("t is the time, a the values".to_owned()),
            )
        })
}

/// What `--json` prints.
#[derive(Serialize)]
struct Converted<'w> {
    output: &'w Path,
    quantity: &'static str,
    component: &'w str,
    unit: &'w str,
    samples: usize,
    time_step: f64,
    remarks: &'w [String],
    warnings: &'w [String],
}
