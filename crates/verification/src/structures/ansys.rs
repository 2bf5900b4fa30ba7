//! VM65 of the verification manual of Ansys, which LS-DYNA has as VM-061: a ball falls on a spring.

use super::case_file::{CaseFile, case_file};
use super::quantity::{Quantity, comparison};
use crate::comparison::{Comparison, Part};
use crate::error::VerificationError;

const VM65: CaseFile = case_file!("ansys/vm65");

/// VM65 of the verification manual of Ansys.
///
/// # Errors
/// A case that cannot be run.
pub(super) fn ansys() -> Result<Part, VerificationError> {
    Ok(Part {
        name: "ansys",
        citation: "Ansys verification manual VM65 and LS-DYNA VM-061, after Thomson, Vibration Theory and Applications; the printed figures unverified",
        comparisons: vec![vm65()?],
        findings: vec![
            "In inches, pounds and lbf s2/in, taken as if they were SI: no unit enters the equations. The printed 1.5506 in is 4e-5 off the closed form 1.55067 in, whose penetration solves k d^2 = 2 m g (h + d).".to_owned(),
        ],
    })
}

fn vm65() -> Result<Comparison, VerificationError> {
    let (m, k, g, height) = (0.5, 1973.92, 386.0, 1.0);
    let weight: f64 = m * g;
    let penetration = (weight + (weight * weight + 2.0 * k * weight * height).sqrt()) / k;
    let speed = f64::sqrt(2.0 * g * height);
    let run = VM65.run()?;
    let impact = run.impact(1)?;
    let ours = impact.approach_velocity;
    let line = |name, theirs, closed_form, ours, tolerance| {
        Quantity {
            name,
            theirs,
            closed_form: Some(closed_form),
            ours,
            tolerance,
        }
        .reproduced()
    };
    Ok(comparison(
        "m = 0.5 lbf s2/in, k = 1973.92 lbf/in, h = 1 in, g = 386 in/s2",
        vec![
            line(
                "closes (s)",
                0.071_982,
                speed / g,
                impact.time_closed,
                1.0e-5,
            ),
            line("approach velocity (in/s)", 27.785, speed, ours, 1.0e-5),
            line(
                "kinetic energy (in lbf)",
                193.0,
                weight * height,
                0.5 * m * ours * ours,
                1.0e-5,
            ),
            line(
                "lowest place below the start (in)",
                1.5506,
                height + penetration,
                height + impact.peak_penetration.value,
                1.0e-4,
            ),
        ],
    ))
}
