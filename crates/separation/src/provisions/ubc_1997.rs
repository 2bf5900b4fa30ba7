//! UBC 1997 and the code of the Philippines after it.

use crate::descriptor::{Basis, ProvisionDescriptor, Rule, Verification};
use crate::error::SeparationError;
use crate::inputs::{Input, Site, Situation, Structure};
use crate::working::{Working, root};

fn maximum(working: &mut Working, structure: &Structure) -> Result<f64, SeparationError> {
    Ok(working.note("factor", 0.7, "-") * working.restored(structure)?)
}

fn boundary(
    working: &mut Working,
    structure: &Structure,
    _: f64,
    _: &Site,
) -> Result<f64, SeparationError> {
    maximum(working, structure)
}

fn between(working: &mut Working, situation: &Situation) -> Result<f64, SeparationError> {
    let left = maximum(working, &situation.left)?;
    let right = maximum(working, &situation.right)?;
    Ok(root(left, right))
}

pub(crate) static UBC_BOUNDARY: ProvisionDescriptor = ProvisionDescriptor {
    name: "ubc_1997_boundary",
    region: "United States",
    edition: "UBC 1997",
    clause: "1633.2.11",
    basis: Basis::Displacement,
    elastic_displacement_factor: Some("0.7 R"),
    formula: "deltaM = 0.7 R d (R d = I u)",
    inputs: &[Input::Displacement, Input::Importance],
    status: Verification::Unverified("the formula; that it applied in all zones was seen"),
    remarks: &[],
    rule: Rule::Boundary(boundary),
};

pub(crate) static UBC_BETWEEN: ProvisionDescriptor = ProvisionDescriptor {
    name: "ubc_1997_between",
    formula: "sqrt(deltaM1^2 + deltaM2^2), deltaM = 0.7 R d (R d = I u)",
    remarks: &["For buildings on one property."],
    rule: Rule::Between(between),
    ..UBC_BOUNDARY
};

const FOLLOWS: Verification = Verification::Unverified("that the code follows UBC 1997");

pub(crate) static NSCP_BOUNDARY: ProvisionDescriptor = ProvisionDescriptor {
    name: "nscp_2015_boundary",
    region: "Philippines",
    edition: "NSCP 2015",
    clause: "",
    status: FOLLOWS,
    ..UBC_BOUNDARY
};

pub(crate) static NSCP_BETWEEN: ProvisionDescriptor = ProvisionDescriptor {
    name: "nscp_2015_between",
    region: "Philippines",
    edition: "NSCP 2015",
    clause: "",
    status: FOLLOWS,
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
            let width = own.boundary(&situation.left, 9.0, &site).unwrap().width;
            assert!((width - 0.056).abs() < 1.0e-12);
            let width = between.between(&situation).unwrap().width;
            assert!((width - 0.07).abs() < 1.0e-12);
        }
        situation.left.elastic_displacement = Some(0.01);
        let width = UBC_BETWEEN.between(&situation).unwrap().width;
        assert!((width - 0.07).abs() < 1.0e-12);
    }
}
