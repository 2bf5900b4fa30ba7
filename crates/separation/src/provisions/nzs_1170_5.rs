//! NZS 1170.5 of New Zealand.

use crate::assumptions::{Ground, HeightDatum};
use crate::descriptor::{Basis, ProvisionDescriptor, Rule};
use crate::edition::{Edition, InForce};
use crate::error::SeparationError;
use crate::inputs::{Input, Site, Situation, Structure};
use crate::status::Status;
use crate::working::Working;

fn boundary(
    working: &mut Working,
    structure: &Structure,
    _: &Site,
) -> Result<f64, SeparationError> {
    working.displacement(structure)
}

fn between(working: &mut Working, situation: &Situation) -> Result<f64, SeparationError> {
    Ok(working.displacement(&situation.left)? + working.displacement(&situation.right)?)
}

static EDITION: Edition = Edition {
    title: "NZS 1170.5:2004",
    region: "New Zealand",
    in_force: InForce::recalled("2004", None),
    superseded_by: None,
};

const FACTOR: &str = "7.2.1.1 multiplies those of an elastic analysis by mu (recalled, unverified); u is the unreduced one.";

pub(crate) static BOUNDARY: ProvisionDescriptor = ProvisionDescriptor {
    name: "nzs_1170_5_boundary",
    edition: &EDITION,
    clause: "7.4",
    basis: Basis::Displacement,
    height: HeightDatum::NotUsed,
    ground: Ground::OwnSide,
    elastic_displacement_factor: Some("mu"),
    formula: "u",
    inputs: &[Input::Displacement],
    status: Status::Unverified("the clause"),
    remarks: &["For deflections of the ultimate limit state.", FACTOR],
    worked: "80",
    rule: Rule::Boundary(boundary),
};

pub(crate) static BETWEEN: ProvisionDescriptor = ProvisionDescriptor {
    name: "nzs_1170_5_between",
    formula: "u1 + u2",
    remarks: &[
        "For deflections of the ultimate limit state; no relief by SRSS.",
        FACTOR,
    ],
    rule: Rule::Between(between),
    worked: "80 + 60",
    ground: Ground::OneProperty,
    ..BOUNDARY
};

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    /// 80 and 60 mm: 80 mm on the own side, 140 mm between.
    #[test]
    fn by_hand() {
        let structure = |u| Structure {
            displacement: Some(u),
            ..Structure::default()
        };
        let situation = Situation {
            left: structure(0.08),
            right: structure(0.06),
            ..Situation::default()
        };
        let own = BOUNDARY.boundary(&situation.left, &situation.site);
        assert!((own.unwrap().width - 0.08).abs() < 1.0e-12);
        assert!((BETWEEN.between(&situation).unwrap().width - 0.14).abs() < 1.0e-12);
    }
}
