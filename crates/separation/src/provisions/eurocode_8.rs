//! Eurocode 8, both generations.

use crate::assumptions::{Ground, HeightDatum};
use crate::descriptor::{Basis, ProvisionDescriptor, Rule};
use crate::edition::{Edition, InForce};
use crate::error::SeparationError;
use crate::inputs::{Input, Site, Situation, Structure};
use crate::status::Status;
use crate::working::Working;

/// 0.7 where the floors of both buildings lie at equal elevations.
fn reduction(working: &mut Working, site: &Site) -> Result<f64, SeparationError> {
    let aligned = working.floors_aligned(site)?;
    Ok(working.note("reduction", if aligned { 0.7 } else { 1.0 }, "-"))
}

fn boundary(
    working: &mut Working,
    structure: &Structure,
    site: &Site,
) -> Result<f64, SeparationError> {
    Ok(working.displacement(structure)? * reduction(working, site)?)
}

fn between(working: &mut Working, situation: &Situation) -> Result<f64, SeparationError> {
    let same_owner = working.need(situation.site.same_owner, Input::SameOwner, "")?;
    if !same_owner {
        let reason =
            "across a property line each building keeps its own distance: see the boundary rule";
        return Err(working.not_applicable(reason));
    }
    let root = working.root_of_squares(situation, Working::displacement)?;
    Ok(root * reduction(working, &situation.site)?)
}

static FIRST: Edition = Edition {
    title: "EN 1998-1:2004",
    region: "Europe",
    in_force: InForce::recalled("2004", None),
    superseded_by: None,
};

static SECOND: Edition = Edition {
    title: "prEN 1998-1-2",
    region: "Europe",
    in_force: None,
    superseded_by: None,
};

pub(crate) static FIRST_BOUNDARY: ProvisionDescriptor = ProvisionDescriptor {
    name: "en_1998_1_2004_boundary",
    edition: &FIRST,
    clause: "4.4.2.7",
    basis: Basis::Displacement,
    height: HeightDatum::NotUsed,
    ground: Ground::OwnSide,
    elastic_displacement_factor: Some("qd"),
    formula: "ds, times 0.7 where floors are aligned (ds = qd de = u)",
    inputs: &[Input::Displacement, Input::FloorsAligned],
    status: Status::Unverified("the clause, with its reduction"),
    remarks: &["ds = qd de is taken as u: qd = q, as above the corner period TC."],
    worked: "1 * 80",
    rule: Rule::Boundary(boundary),
};

pub(crate) static FIRST_BETWEEN: ProvisionDescriptor = ProvisionDescriptor {
    name: "en_1998_1_2004_between",
    formula: "sqrt(ds1^2 + ds2^2), times 0.7 where floors are aligned (ds = qd de = u)",
    inputs: &[Input::Displacement, Input::FloorsAligned, Input::SameOwner],
    rule: Rule::Between(between),
    worked: "1 * sqrt(pow(80, 2) + pow(60, 2))",
    ground: Ground::OneProperty,
    ..FIRST_BOUNDARY
};

const SIMILAR: Status = Status::Unverified("that the draft keeps the rule of 2004");
const STATE: &[&str] = &["For displacements of the limit state of significant damage."];

pub(crate) static SECOND_BOUNDARY: ProvisionDescriptor = ProvisionDescriptor {
    name: "pr_en_1998_1_2_boundary",
    edition: &SECOND,
    clause: "",
    status: SIMILAR,
    remarks: STATE,
    ..FIRST_BOUNDARY
};

pub(crate) static SECOND_BETWEEN: ProvisionDescriptor = ProvisionDescriptor {
    name: "pr_en_1998_1_2_between",
    edition: &SECOND,
    clause: "",
    status: SIMILAR,
    remarks: STATE,
    ..FIRST_BETWEEN
};

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    /// 80 and 60 mm: 100 mm on one property, 70 mm with aligned floors; on the own side
    /// 80 mm and 56 mm.
    #[test]
    fn by_hand() {
        let structure = |u| Structure {
            displacement: Some(u),
            ..Structure::default()
        };
        let situation = |aligned, owner| Situation {
            left: structure(0.08),
            right: structure(0.06),
            site: Site {
                floors_aligned: Some(aligned),
                same_owner: Some(owner),
                ..Site::default()
            },
        };
        for (aligned, between, own) in [(false, 0.1, 0.08), (true, 0.07, 0.056)] {
            let s = situation(aligned, true);
            for descriptor in [&FIRST_BETWEEN, &SECOND_BETWEEN] {
                assert!((descriptor.between(&s).unwrap().width - between).abs() < 1.0e-12);
            }
            for descriptor in [&FIRST_BOUNDARY, &SECOND_BOUNDARY] {
                let width = descriptor.boundary(&s.left, &s.site).unwrap().width;
                assert!((width - own).abs() < 1.0e-12);
                let both = descriptor.between(&s).unwrap().width;
                assert!((both - own * 1.75).abs() < 1.0e-12);
            }
        }
        let across = FIRST_BETWEEN.between(&situation(true, false));
        assert!(matches!(across, Err(SeparationError::NotApplicable { .. })));
    }
}
