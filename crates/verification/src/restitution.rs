//! Requested against achieved restitution of every law that takes one.

use pounding_gap_element::published::restitution::{REFERENCES, RestitutionReference};
use pounding_gap_element::{
    Bodies, CollisionOptions, GapElementError, ModelDescriptor, ModelParameters, RestitutionTable,
    registry, restitution_table,
};

use crate::comparison::{
    Cell, Comparison, Line, Part, Verdict, largest, nothing, number, power, text,
};
use crate::error::VerificationError;

/// Two concrete floors; restitution does not depend on them.
const BODIES: Bodies = Bodies {
    mass_left: 25.0e3,
    mass_right: Some(40.0e3),
    velocity_left: 0.8,
    velocity_right: 0.0,
};

const COLUMNS: [(&str, &str); 14] = [
    ("model", "model"),
    ("achieved_0.1", "0.1"),
    ("achieved_0.2", "0.2"),
    ("achieved_0.3", "0.3"),
    ("achieved_0.4", "0.4"),
    ("achieved_0.5", "0.5"),
    ("achieved_0.6", "0.6"),
    ("achieved_0.7", "0.7"),
    ("achieved_0.8", "0.8"),
    ("achieved_0.9", "0.9"),
    ("achieved_1.0", "1.0"),
    ("mean_error_percent", "0.1-1.0 (%)"),
    ("mean_error_percent_0.5_0.8", "0.5-0.8 (%)"),
    ("largest_difference", "difference"),
];

/// Requested against achieved restitution: one line for every law that takes one.
///
/// # Errors
/// A collision that cannot be computed.
pub fn restitution() -> Result<Part, VerificationError> {
    let mut lines = REFERENCES
        .iter()
        .map(referenced)
        .collect::<Result<Vec<_>, _>>()?;
    for descriptor in registry::descriptors() {
        if descriptor.takes_restitution() && !has_reference(descriptor) {
            lines.push(computed(descriptor)?);
        }
    }
    Ok(Part {
        name: "table",
        citation: "Requested against achieved restitution in a free collision: integrated, against closed forms of the laws in 30 digits",
        comparisons: vec![Comparison {
            title: "Achieved restitution under the restitution asked for, mean errors in %, and the largest difference from the reference".to_owned(),
            columns: COLUMNS.to_vec(),
            lines,
        }],
        findings: [
            "Every law agrees with its closed form; no law but the exact ones, Kelvin-Voigt and Tsuji with tension, dry friction and the rigid impact returns what is asked.",
            "For lapshin_yurin_2016 there is no such row: the restitution asked for is that at low speed, and the viscous part takes more the faster the floors meet.",
        ]
        .map(str::to_owned)
        .to_vec(),
    })
}

fn has_reference(descriptor: &ModelDescriptor) -> bool {
    REFERENCES
        .iter()
        .any(|r| r.model == descriptor.name || descriptor.aliases.iter().any(|a| a.name == r.model))
}

fn referenced(reference: &RestitutionReference) -> Result<Line, GapElementError> {
    let descriptor = registry::find(reference.model)?;
    let table = run(descriptor, &reference.parameters()?)?;
    let pairs = table.rows.iter().zip(&reference.achieved);
    let difference =
        largest(pairs.map(|(row, expected)| (row.outcome.restitution - expected).abs()));
    let mut name = reference.model.to_owned();
    for (key, value) in reference.parameters {
        name.push_str(&format!(", {key} = {value}"));
    }
    if let Some(rule) = reference.separation {
        name.push_str(&format!(", {}", rule.name()));
    }
    Ok(Line {
        cells: line(&name, &table, power(difference, 0)),
        verdict: Verdict::reference(difference, reference.tolerance),
        claimed: Verdict::AgreesWithReference,
    })
}

/// A law without a reference row.
fn computed(descriptor: &'static ModelDescriptor) -> Result<Line, GapElementError> {
    let mut parameters = descriptor.example_parameters(1.0);
    parameters.values.remove("restitution");
    let table = run(descriptor, &parameters)?;
    Ok(Line {
        cells: line(descriptor.name, &table, nothing()),
        verdict: Verdict::ComputedOnly,
        claimed: Verdict::ComputedOnly,
    })
}

fn run(
    descriptor: &'static ModelDescriptor,
    parameters: &ModelParameters,
) -> Result<RestitutionTable, GapElementError> {
    restitution_table(
        descriptor,
        parameters,
        &BODIES,
        &CollisionOptions::default(),
    )
}

fn line(name: &str, table: &RestitutionTable, difference: Cell) -> Vec<Cell> {
    let mut cells = vec![text(name)];
    let achieved = table.rows.iter().map(|row| row.outcome.restitution);
    cells.extend(achieved.map(|e| number(e, 5)));
    cells.push(number(table.mean_error_percent(0.1, 1.0), 2));
    cells.push(number(table.mean_error_percent(0.5, 0.8), 2));
    cells.push(difference);
    cells
}
