//! Requested against achieved restitution of every law that takes one.

use pounding_gap_element::published::mean_error_percent;
use pounding_gap_element::published::restitution::{REFERENCES, RestitutionReference};
use pounding_gap_element::{
    Bodies, CollisionOptions, GapElementError, ModelDescriptor, ModelParameters, RestitutionTable,
    SeparationRule, registry, restitution_table,
};

use super::report::{Cell, Comparison, Line, Part, Verdict, largest, nothing, number, power, text};
use crate::failure::Failure;

/// Two concrete floors; restitution does not depend on them.
const BODIES: Bodies = Bodies {
    mass_left: 25.0e3,
    mass_right: Some(40.0e3),
    velocity_left: 0.8,
    velocity_right: 0.0,
};

/// One line a law.
pub fn part() -> Result<Part, Failure> {
    let mut lines = REFERENCES
        .iter()
        .map(referenced)
        .collect::<Result<Vec<_>, _>>()?;
    for card in registry::descriptors() {
        if card.takes_restitution() && !has_reference(card) {
            lines.push(computed(card)?);
        }
    }
    Ok(Part {
        name: "table",
        citation: "Requested against achieved restitution in a free collision: integrated, against closed forms of the laws in 30 digits",
        comparisons: vec![Comparison {
            title: "Mean error in % over 0.1-1.0 and 0.5-0.8, reference beside computed; largest difference of achieved restitution over the ten rows".to_owned(),
            columns: vec![
                ("model", "model"),
                ("separation", "separation"),
                ("reference_mean_error_percent", "reference 0.1-1.0"),
                ("mean_error_percent", "computed 0.1-1.0"),
                ("reference_mean_error_percent_0.5_0.8", "reference 0.5-0.8"),
                ("mean_error_percent_0.5_0.8", "computed 0.5-0.8"),
                ("largest_difference", "largest difference"),
            ],
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

fn has_reference(card: &ModelDescriptor) -> bool {
    REFERENCES
        .iter()
        .any(|r| r.model == card.name || card.aliases.iter().any(|a| a.name == r.model))
}

fn referenced(reference: &RestitutionReference) -> Result<Line, GapElementError> {
    let card = registry::find(reference.model)?;
    let table = run(card, &reference.parameters()?)?;
    let pairs = table.rows.iter().zip(&reference.achieved);
    let difference =
        largest(pairs.map(|(row, expected)| (row.outcome.restitution - expected).abs()));
    let name = reference
        .parameters
        .iter()
        .fold(reference.model.to_owned(), |name, (key, value)| {
            format!("{name}, {key} = {value}")
        });
    let expected =
        |least, greatest| number(mean_error_percent(&reference.achieved, least, greatest), 2);
    Ok(Line {
        cells: line(
            &name,
            reference.separation,
            &table,
            [expected(0.1, 1.0), expected(0.5, 0.8)],
            power(difference, 0),
        ),
        verdict: Verdict::reference(difference, reference.tolerance),
        claimed: Verdict::AgreesWithReference,
    })
}

/// A law without a reference row.
fn computed(card: &'static ModelDescriptor) -> Result<Line, GapElementError> {
    let mut parameters = card.example_parameters(1.0);
    parameters.values.remove("restitution");
    let table = run(card, &parameters)?;
    Ok(Line {
        cells: line(card.name, None, &table, [nothing(), nothing()], nothing()),
        verdict: Verdict::ComputedOnly,
        claimed: Verdict::ComputedOnly,
    })
}

fn run(
    card: &'static ModelDescriptor,
    parameters: &ModelParameters,
) -> Result<RestitutionTable, GapElementError> {
    restitution_table(card, parameters, &BODIES, &CollisionOptions::default())
}

fn line(
    name: &str,
    separation: Option<SeparationRule>,
    table: &RestitutionTable,
    [all, middle]: [Cell; 2],
    difference: Cell,
) -> Vec<Cell> {
    vec![
        text(name),
        separation.map_or_else(nothing, |rule| text(rule.name())),
        all,
        number(table.mean_error_percent(0.1, 1.0), 2),
        middle,
        number(table.mean_error_percent(0.5, 0.8), 2),
        difference,
    ]
}
