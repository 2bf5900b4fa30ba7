//! The example ElastoGap of the Modelica Standard Library, as Dymola computes it.

use super::case_file::{CaseFile, case_file};
use super::quantity::{Quantity, comparison};
use crate::comparison::{Comparison, Part};
use crate::error::VerificationError;

const ELASTO_GAP: CaseFile = case_file!("modelica/elasto_gap");

/// Their first closure (s), from which times count.
const FIRST_CLOSURE: f64 = 0.875_160_379_649_849;
/// Closures and openings (s) after it, and separation velocities (m/s), of their impacts.
const IMPACTS: [(f64, Option<(f64, f64)>); 3] = [
    (0.875_160_380, Some((1.896_204_494, 1.969_028_316_974_869))),
    (
        2.404_069_207,
        Some((3.425_110_928, 1.131_288_186_008_987_2)),
    ),
    (4.309_058_991, None),
];
/// Dymola integrates with a relative tolerance of 1e-6; these are a few steps' worth.
const TOLERANCE: f64 = 5.0e-6;

/// The example ElastoGap of the Modelica Standard Library 4.0.0.
///
/// # Errors
/// A case that cannot be run.
pub(super) fn modelica() -> Result<Part, VerificationError> {
    Ok(Part {
        name: "modelica",
        citation: "Modelica Standard Library 4.0.0, Mechanics.Translational.Examples.ElastoGap: reference result of Dymola 2020x (tolerance 1e-6)",
        comparisons: vec![elasto_gap()?],
        findings: vec![
            "Their file holds the tolerance of Dymola, 1e-6; ours are located events at a tolerance of 1e-10. The law itself, whose dashpot never pulls more than the spring pushes, is held against an independent integration in `verify impact --source table`.".to_owned(),
        ],
    })
}

fn elasto_gap() -> Result<Comparison, VerificationError> {
    let run = ELASTO_GAP.run()?;
    let shift = FIRST_CLOSURE - run.impact(1)?.time_closed;
    let mut lines = Vec::new();
    for (n, (closes, left)) in (1..).zip(IMPACTS) {
        let impact = run.impact(n)?;
        let mut push = |name: &str, theirs, ours| {
            let quantity = Quantity {
                name,
                theirs,
                closed_form: None,
                ours,
                tolerance: TOLERANCE,
            };
            lines.push(quantity.reproduced());
        };
        // The first is where the times are counted from.
        if n > 1 {
            push(
                &format!("impact {n} closes (s)"),
                closes,
                impact.time_closed + shift,
            );
        }
        if let Some((opens, velocity)) = left {
            push(
                &format!("impact {n} opens (s)"),
                opens,
                impact.time_opened + shift,
            );
            push(
                &format!("leaves with (m/s), impact {n}"),
                velocity,
                impact.separation_velocity,
            );
        }
    }
    Ok(comparison(
        "1 kg between two stops 1 m apart, 10 N/m and 1.5 N s/m each; first impact at 3.427150206880187 m/s and 0.87516 s as theirs",
        lines,
    ))
}
