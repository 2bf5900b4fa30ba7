//! ASCE/SEI 41: seismic evaluation and retrofit of existing buildings.

use crate::assumptions::{Ground, HeightDatum};
use crate::descriptor::{Basis, ProvisionDescriptor, Rule};
use crate::edition::{Edition, InForce};
use crate::error::SeparationError;
use crate::inputs::{Input, Site, Situation, Structure};
use crate::status::Status;
use crate::working::Working;

/// Part of the height beyond which no gap is asked for.
const CAP: f64 = 0.04;

fn boundary(
    working: &mut Working,
    structure: &Structure,
    _: &Site,
) -> Result<f64, SeparationError> {
    let displacement = working.displacement(structure)?;
    let cap = working.note("cap", CAP, "-") * working.elevation(structure);
    Ok(displacement.min(cap))
}

fn between(working: &mut Working, situation: &Situation) -> Result<f64, SeparationError> {
    let root = working.root_of_squares(situation, Working::displacement)?;
    let cap = working.note("cap", CAP, "-") * working.common_elevation(situation);
    Ok(root.min(cap))
}

static EDITION: Edition = Edition {
    title: "ASCE/SEI 41-17 and 41-23",
    region: "United States",
    in_force: InForce::recalled("2017", None),
    superseded_by: None,
};

pub(crate) static BOUNDARY: ProvisionDescriptor = ProvisionDescriptor {
    name: "asce_41_boundary",
    edition: &EDITION,
    clause: "7.2.13",
    basis: Basis::Displacement,
    height: HeightDatum::NotSeen,
    ground: Ground::OwnSide,
    elastic_displacement_factor: None,
    formula: "min(u, 0.04 h)",
    inputs: &[Input::Displacement],
    status: Status::Unverified("formula and clause"),
    remarks: &[],
    worked: "min(80, 0.04 * 18000)",
    rule: Rule::Boundary(boundary),
};

pub(crate) static BETWEEN: ProvisionDescriptor = ProvisionDescriptor {
    name: "asce_41_between",
    formula: "min(sqrt(u1^2 + u2^2), 0.04 h)",
    rule: Rule::Between(between),
    worked: "min(sqrt(pow(80, 2) + pow(60, 2)), 0.04 * 18000)",
    ground: Ground::NotAsked,
    ..BOUNDARY
};

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    /// 80 and 60 mm: 100 mm; at a height of 2 m no more than 80 mm.
    #[test]
    fn by_hand() {
        let structure = |u, elevation| Structure {
            displacement: Some(u),
            elevation,
            ..Structure::default()
        };
        for (elevation, width) in [(9.0, 0.1), (2.0, 0.08)] {
            let situation = Situation {
                left: structure(0.08, elevation),
                right: structure(0.06, elevation),
                ..Situation::default()
            };
            let found = BETWEEN.between(&situation).unwrap().width;
            assert!((found - width).abs() < 1.0e-12);
        }
        let own = |h| BOUNDARY.boundary(&structure(0.08, h), &Site::default());
        assert!((own(9.0).unwrap().width - 0.08).abs() < 1.0e-12);
        assert!((own(1.0).unwrap().width - 0.04).abs() < 1.0e-12);
    }
}
