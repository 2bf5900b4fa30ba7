//! UBC 1997 and the code of the Philippines after it.

use crate::assumptions::{Ground, HeightDatum};
use crate::descriptor::{Basis, ProvisionDescriptor, Rule};
use crate::edition::{Edition, InForce};
use crate::error::SeparationError;
use crate::inputs::{Input, Site, Situation, Structure};
use crate::status::Status;
use crate::working::Working;

fn maximum(working: &mut Working, structure: &Structure) -> Result<f64, SeparationError> {
    Ok(working.note("factor", 0.7, "-") * working.restored(structure)?)
}

fn boundary(
    working: &mut Working,
    structure: &Structure,
    _: &Site,
) -> Result<f64, SeparationError> {
    maximum(working, structure)
}

fn between(working: &mut Working, situation: &Situation) -> Result<f64, SeparationError> {
    working.root_of_squares(situation, maximum)
}

static UBC_1997: Edition = Edition {
    title: "UBC 1997",
    region: "United States",
    in_force: InForce::recalled("1997", Some("2000")),
    superseded_by: Some("IBC 2000"),
};

static NSCP_2015: Edition = Edition {
    title: "NSCP 2015",
    region: "Philippines",
    in_force: InForce::recalled("2015", None),
    superseded_by: None,
};

const FACTOR: Status = Status::Unverified(
    "square root and clause; 0.7 R was seen in an excerpt of NSCP 2015, equation 208-21",
);

pub(crate) static UBC_BOUNDARY: ProvisionDescriptor = ProvisionDescriptor {
    name: "ubc_1997_boundary",
    edition: &UBC_1997,
    clause: "1633.2.11",
    basis: Basis::Displacement,
    height: HeightDatum::NotUsed,
    ground: Ground::OwnSide,
    elastic_displacement_factor: Some("0.7 R"),
    formula: "deltaM = 0.7 R d (R d = I u)",
    inputs: &[Input::Displacement, Input::Importance],
    status: FACTOR,
    remarks: &[],
    worked: "0.7 * 1.1 * 80",
    rule: Rule::Boundary(boundary),
};

pub(crate) static UBC_BETWEEN: ProvisionDescriptor = ProvisionDescriptor {
    name: "ubc_1997_between",
    formula: "sqrt(deltaM1^2 + deltaM2^2), deltaM = 0.7 R d (R d = I u)",
    remarks: &["For buildings on one property."],
    rule: Rule::Between(between),
    worked: "0.7 * sqrt(pow(1.1 * 80, 2) + pow(1.1 * 60, 2))",
    ground: Ground::OneProperty,
    ..UBC_BOUNDARY
};

pub(crate) static NSCP_BOUNDARY: ProvisionDescriptor = ProvisionDescriptor {
    name: "nscp_2015_boundary",
    edition: &NSCP_2015,
    clause: "",
    ..UBC_BOUNDARY
};

pub(crate) static NSCP_BETWEEN: ProvisionDescriptor = ProvisionDescriptor {
    name: "nscp_2015_between",
    edition: &NSCP_2015,
    clause: "",
    ..UBC_BETWEEN
};

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    /// u = 80 and 60 mm, I = 1: 56 and 42 mm, in root 70 mm. Given d = 10 mm and
    /// R = 8 instead: 0.7 * 8 * 10 = 56 mm.
    #[test]
    fn by_hand() {
        let structure = |u| Structure {
            displacement: Some(u),
            importance: Some(1.0),
            response_modification: Some(8.0),
            ..Structure::default()
        };
        let mut situation = Situation {
            left: structure(0.08),
            right: structure(0.06),
            ..Situation::default()
        };
        for (own, between) in [
            (&UBC_BOUNDARY, &UBC_BETWEEN),
            (&NSCP_BOUNDARY, &NSCP_BETWEEN),
        ] {
            let site = Site::default();
            let width = own.boundary(&situation.left, &site).unwrap().width;
            assert!((width - 0.056).abs() < 1.0e-12);
            let width = between.between(&situation).unwrap().width;
            assert!((width - 0.07).abs() < 1.0e-12);
        }
        situation.left.elastic_displacement = Some(0.01);
        let width = UBC_BETWEEN.between(&situation).unwrap().width;
        assert!((width - 0.07).abs() < 1.0e-12);
    }
}
