//! ASCE/SEI 41: seismic evaluation and retrofit of existing buildings.

use crate::assumptions::{Ground, HeightDatum};
use crate::descriptor::{Basis, ProvisionDescriptor, Rule};
use crate::edition::{Edition, InForce};
use crate::error::SeparationError;
use crate::inputs::{Input, Site, Situation, Structure};
use crate::status::Status;
use crate::working::{Working, root};

/// Part of the height beyond which no gap is asked for.
const CAP: f64 = 0.04;

fn cap(working: &mut Working, elevation: f64) -> f64 {
    working.note("cap", CAP, "-") * working.elevation(elevation)
}

fn boundary(
    working: &mut Working,
    structure: &Structure,
    elevation: f64,
    _: &Site,
) -> Result<f64, SeparationError> {
    let displacement = working.displacement(structure)?;
    Ok(displacement.min(cap(working, elevation)))
}

fn between(working: &mut Working, situation: &Situation) -> Result<f64, SeparationError> {
    let left = working.displacement(&situation.left)?;
    let right = working.displacement(&situation.right)?;
    Ok(root(left, right).min(cap(working, situation.elevation)))
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
        let structure = |u| Structure {
            displacement: Some(u),
            ..Structure::default()
        };
        let mut situation = Situation {
            left: structure(0.08),
            right: structure(0.06),
            elevation: 9.0,
            ..Situation::default()
        };
        assert!((BETWEEN.between(&situation).unwrap().width - 0.1).abs() < 1.0e-12);
        situation.elevation = 2.0;
        assert!((BETWEEN.between(&situation).unwrap().width - 0.08).abs() < 1.0e-12);
        let own = |h| BOUNDARY.boundary(&situation.left, h, &situation.site);
        assert!((own(9.0).unwrap().width - 0.08).abs() < 1.0e-12);
        assert!((own(1.0).unwrap().width - 0.04).abs() < 1.0e-12);
    }
}
