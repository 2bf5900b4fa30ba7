//! NCh433 of Chile.

use crate::assumptions::{Ground, HeightDatum};
use crate::descriptor::{Basis, ProvisionDescriptor, Rule};
use crate::edition::{Edition, InForce};
use crate::error::SeparationError;
use crate::inputs::{Input, Site, Situation, Structure};
use crate::status::{Reading, Status};
use crate::working::Working;

/// `R* d` times one third, or two thirds by the other reading.
fn own(working: &mut Working, structure: &Structure, thirds: f64) -> Result<f64, SeparationError> {
    let whole = thirds * working.restored(structure)?;
    Ok(whole / working.note("divisor", 3.0, "-"))
}

fn boundary<const THIRDS: u8>(
    working: &mut Working,
    structure: &Structure,
    _: &Site,
) -> Result<f64, SeparationError> {
    own(working, structure, f64::from(THIRDS))
}

fn minimum(working: &mut Working, structure: &Structure, _: &Site) -> Result<f64, SeparationError> {
    Ok((0.002 * working.elevation(structure)).max(0.015))
}

fn between<const THIRDS: u8>(
    working: &mut Working,
    situation: &Situation,
) -> Result<f64, SeparationError> {
    let left = own(working, &situation.left, f64::from(THIRDS))?;
    Ok(left + own(working, &situation.right, f64::from(THIRDS))?)
}

const ABOUT: &str = "R* / 3 is recalled, two texts on the clause have 2 R* / 3; R* stands under response_modification";
const RECALLED: &str = "R* / 3, as recalled";
const TEXTS: &str = "2 R* / 3, in two secondary texts";

static EDITION: Edition = Edition {
    title: "NCh433",
    region: "Chile",
    in_force: InForce::recalled("1996", None),
    superseded_by: None,
};

pub(crate) static BOUNDARY: ProvisionDescriptor = ProvisionDescriptor {
    name: "nch_433_boundary",
    edition: &EDITION,
    clause: "5.10",
    basis: Basis::Displacement,
    height: HeightDatum::NotUsed,
    ground: Ground::OwnSide,
    elastic_displacement_factor: Some("R* / 3"),
    formula: "(R* / 3) d (R* d = I u)",
    inputs: &[Input::Displacement, Input::Importance],
    status: Status::Disputed {
        about: ABOUT,
        readings: &[
            Reading {
                text: RECALLED,
                formula: "(R* / 3) d (R* d = I u)",
                worked: "1.1 * 80 / 3",
                rule: Rule::Boundary(boundary::<1>),
            },
            Reading {
                text: TEXTS,
                formula: "(2 R* / 3) d (R* d = I u)",
                worked: "2 * 1.1 * 80 / 3",
                rule: Rule::Boundary(boundary::<2>),
            },
        ],
    },
    remarks: &[],
    worked: "1.1 * 80 / 3",
    rule: Rule::Boundary(boundary::<1>),
};

pub(crate) static BOUNDARY_MINIMUM: ProvisionDescriptor = ProvisionDescriptor {
    name: "nch_433_boundary_minimum",
    basis: Basis::Prescriptive,
    elastic_displacement_factor: None,
    formula: "max(0.002 h, 15 mm)",
    inputs: &[],
    status: Status::Unverified("15 mm; two per mil of the height was seen"),
    remarks: &["Holds beside the rule of displacements."],
    rule: Rule::Boundary(minimum),
    worked: "max(0.002 * 18000, 15)",
    height: HeightDatum::NotSeen,
    ..BOUNDARY
};

pub(crate) static BETWEEN: ProvisionDescriptor = ProvisionDescriptor {
    name: "nch_433_between",
    formula: "sum over both buildings of (R* / 3) d (R* d = I u)",
    ground: Ground::OneProperty,
    status: Status::Disputed {
        about: ABOUT,
        readings: &[
            Reading {
                text: RECALLED,
                formula: "sum over both buildings of (R* / 3) d (R* d = I u)",
                worked: "(1.1 * 80 + 1.1 * 60) / 3",
                rule: Rule::Between(between::<1>),
            },
            Reading {
                text: TEXTS,
                formula: "sum over both buildings of (2 R* / 3) d (R* d = I u)",
                worked: "2 * (1.1 * 80 + 1.1 * 60) / 3",
                rule: Rule::Between(between::<2>),
            },
        ],
    },
    worked: "(1.1 * 80 + 1.1 * 60) / 3",
    rule: Rule::Between(between::<1>),
    ..BOUNDARY
};

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    /// R* = 6, d = 15 mm: 30 mm, or 60 mm; I = 1, u = 60 mm: 20 mm, or 40 mm; together 50 mm, or
    /// 100 mm. The wider stands for the width, and neither decides. Least 15 mm up to 7.5 m, 18 mm
    /// at 9 m.
    #[test]
    fn by_hand() {
        let structure = |u| Structure {
            displacement: Some(u),
            importance: Some(1.0),
            response_modification: Some(6.0),
            ..Structure::default()
        };
        let mut situation = Situation {
            left: structure(0.3),
            right: structure(0.06),
            ..Situation::default()
        };
        situation.left.elastic_displacement = Some(0.015);
        let own = BOUNDARY.boundary(&situation.left, &situation.site);
        let both = BETWEEN.between(&situation);
        for (found, narrow, wide) in [(own, 0.03, 0.06), (both, 0.05, 0.1)] {
            let found = found.unwrap();
            let widths: Vec<f64> = found.readings.iter().map(|r| r.width).collect();
            assert!((widths[0] - narrow).abs() < 1.0e-12 && (widths[1] - wide).abs() < 1.0e-12);
            assert_eq!(found.width, widths[1]);
            let undecided = found.undecided().unwrap();
            assert!(undecided.contains("none is chosen"), "{undecided}");
        }
        let least = |elevation| {
            let structure = Structure {
                elevation,
                ..structure(0.06)
            };
            BOUNDARY_MINIMUM.boundary(&structure, &situation.site)
        };
        assert!((least(6.0).unwrap().width - 0.015).abs() < 1.0e-12);
        assert!((least(9.0).unwrap().width - 0.018).abs() < 1.0e-12);
    }
}
