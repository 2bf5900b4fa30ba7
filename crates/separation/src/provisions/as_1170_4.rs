//! AS 1170.4 of Australia.

use crate::assumptions::{Ground, HeightDatum};
use crate::descriptor::{Basis, ProvisionDescriptor, Rule};
use crate::edition::Edition;
use crate::error::SeparationError;
use crate::inputs::{Site, Structure};
use crate::status::Status;
use crate::working::Working;

/// Height (m) from which the rule speaks.
const LOWEST: f64 = 15.0;

fn boundary(
    working: &mut Working,
    _: &Structure,
    elevation: f64,
    _: &Site,
) -> Result<f64, SeparationError> {
    if elevation <= LOWEST {
        return Err(working.not_applicable("it speaks of levels above 15 m"));
    }
    Ok(0.01 * working.elevation(elevation))
}

static EDITION: Edition = Edition {
    title: "AS 1170.4",
    region: "Australia",
    in_force: None,
    superseded_by: None,
};

pub(crate) static BOUNDARY: ProvisionDescriptor = ProvisionDescriptor {
    name: "as_1170_4_boundary",
    edition: &EDITION,
    clause: "",
    basis: Basis::Prescriptive,
    height: HeightDatum::NotSeen,
    ground: Ground::OwnSide,
    elastic_displacement_factor: None,
    formula: "h / 100, or by analysis",
    inputs: &[],
    status: Status::Unverified("the rule and its limit of 15 m"),
    remarks: &["For levels above 15 m."],
    worked: "18000 / 100",
    rule: Rule::Boundary(boundary),
};

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    /// 20 m: 200 mm. Below 15 m: nothing.
    #[test]
    fn by_hand() {
        let own = |h| BOUNDARY.boundary(&Structure::default(), h, &Site::default());
        assert!((own(20.0).unwrap().width - 0.2).abs() < 1.0e-12);
        assert!(matches!(
            own(15.0),
            Err(SeparationError::NotApplicable { .. })
        ));
    }
}
