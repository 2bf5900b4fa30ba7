//! Computed against measured force.

use pounding_case::Dimension;
use pounding_catalogue::numbers::{signed_percent, significant};
use pounding_catalogue::wording::counted;
use pounding_gap_element::laboratory::{Difference, MeasuredForce, MeasuredForceError};

use super::collisions::{Collided, right_aligned};
use super::measured;
use crate::arguments::{ImpactArguments, optional, value};
use crate::failure::Failure;
use crate::tables::Table;

/// Reads and aligns the measured history, if one is asked for.
pub fn measured(arguments: &ImpactArguments) -> Result<Option<MeasuredForce>, Failure> {
    let Some(path) = &arguments.against else {
        return Ok(None);
    };
    let threshold = threshold(arguments)?;
    let shift = optional(arguments.shift.as_deref(), "shift", Dimension::TIME)?;
    let samples = measured::read(path, arguments.against_units.as_deref())?;
    let name = path.display().to_string();
    Ok(Some(MeasuredForce::align(
        name, &samples, threshold, shift,
    )?))
}

/// Part of the measured peak above which there is contact.
fn threshold(arguments: &ImpactArguments) -> Result<f64, Failure> {
    let threshold = value(&arguments.threshold, "threshold", Dimension::NUMBER)?;
    if threshold > 0.0 && threshold < 1.0 {
        return Ok(threshold);
    }
    let error = MeasuredForceError::Threshold { threshold };
    Err(Failure::input(
        format!("--{error}"),
        Some(error.help().to_owned()),
    ))
}

/// The comparison for people.
pub fn text(
    measured: &MeasuredForce,
    arguments: &ImpactArguments,
    collided: &[Collided<'_>],
    compared: &[Difference],
) -> Result<String, Failure> {
    let found = match arguments.shift {
        Some(_) => "as given by --shift".to_owned(),
        None => format!(
            "extrapolated to zero force from the first sample above {} % of the peak and one of twice its force; of each law along F^(1/n), n its exponent",
            significant(100.0 * threshold(arguments)?)
        ),
    };
    let mut text = format!(
        "\nAgainst {}\nfirst contact at {} ms there, {}\n{}\n",
        measured.name,
        significant(measured.first_contact * 1e3),
        found,
        comparison(measured, collided, compared)
    );
    text.push_str(&format!(
        "impulse: each over its own contact, measured by trapezoids over {}; rms difference: from first contact until both contacts are over\n",
        counted(measured.samples_in_contact, "sample")
    ));
    for warning in &measured.warnings {
        text.push_str(&format!("warning: {warning}\n"));
    }
    Ok(text)
}

fn comparison(
    measured: &MeasuredForce,
    collided: &[Collided<'_>],
    compared: &[Difference],
) -> Table {
    let header = [
        "",
        "peak force (kN)",
        "error %",
        "impulse (kN s)",
        "error %",
        "contact time (ms)",
        "rms difference (% of measured peak)",
        "over (ms)",
        "first contact (ms)",
    ];
    let mut table = right_aligned(header.map(str::to_owned).into());
    let kilo = |x: f64| significant(x * 1e-3);
    let milli = |x: f64| significant(x * 1e3);
    table.add_row([
        "measured".to_owned(),
        kilo(measured.peak.0),
        String::new(),
        kilo(measured.impulse),
        String::new(),
        milli(measured.contact_time),
        String::new(),
        String::new(),
        milli(measured.first_contact),
    ]);
    for (one, difference) in collided.iter().zip(compared) {
        table.add_row([
            one.chosen.descriptor.name.to_owned(),
            kilo(one.outcome.peak_force),
            signed_percent(difference.peak_force_error_percent),
            kilo(one.outcome.impulse_of_parted()),
            signed_percent(difference.impulse_error_percent),
            milli(one.outcome.contact_time()),
            significant(difference.rms_force_difference_percent_of_peak),
            milli(difference.window),
            milli(difference.first_contact),
        ]);
    }
    table
}
