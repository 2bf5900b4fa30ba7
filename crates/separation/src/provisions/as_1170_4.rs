//! AS 1170.4 of Australia.

use crate::assumptions::{Ground, HeightDatum};
use crate::descriptor::{Basis, ProvisionDescriptor, Rule};
use crate::edition::Edition;
use crate::error::SeparationError;
use crate::inputs::{Site, Structure};
use crate::status::Status;
use crate::working::Working;

/// Height of the structure (m) above which the rule speaks.
const LOWEST: f64 = 15.0;

fn boundary(
    working: &mut Working,
    structure: &Structure,
    _: f64,
    _: &Site,
) -> Result<f64, SeparationError> {
    if structure.height <= LOWEST {
        return Err(working.not_applicable("it speaks of structures of more than 15 m"));
    }
    Ok(0.01 * working.note("H", structure.height, "m"))
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
    formula: "H / 100 with the height H of the structure, or by analysis",
    inputs: &[],
    status: Status::Unverified("the rule and its limit of 15 m"),
    remarks: &["For structures of more than 15 m; at each of their levels."],
    worked: "21000 / 100",
    rule: Rule::Boundary(boundary),
};

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    /// A structure of 20 m: 200 mm at each of its levels. One of 15 m: nothing.
    #[test]
    fn by_hand() {
        let own = |height, elevation| {
            let structure = Structure {
                height,
                ..Structure::default()
            };
            BOUNDARY.boundary(&structure, elevation, &Site::default())
        };
        for elevation in [5.0, 20.0] {
            assert!((own(20.0, elevation).unwrap().width - 0.2).abs() < 1.0e-12);
        }
        assert!(matches!(
            own(15.0, 15.0),
            Err(SeparationError::NotApplicable { .. })
        ));
    }
}
