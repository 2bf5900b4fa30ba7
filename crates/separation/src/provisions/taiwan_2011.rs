//! Seismic design code of Taiwan, 2011.

use crate::assumptions::{Ground, HeightDatum};
use crate::descriptor::{Basis, ProvisionDescriptor, Rule};
use crate::edition::{Edition, InForce};
use crate::error::SeparationError;
use crate::inputs::{Input, Site, Situation, Structure};
use crate::status::Status;
use crate::working::Working;

fn own(working: &mut Working, structure: &Structure) -> Result<f64, SeparationError> {
    let factors = working.note("factor", 0.6, "-")
        * working.note("1.4", 1.4, "-")
        * working.yield_amplification(structure)?;
    Ok(factors * working.restored(structure)?)
}

fn boundary(
    working: &mut Working,
    structure: &Structure,
    _: &Site,
) -> Result<f64, SeparationError> {
    own(working, structure)
}

fn between(working: &mut Working, situation: &Situation) -> Result<f64, SeparationError> {
    Ok(own(working, &situation.left)? + own(working, &situation.right)?)
}

static EDITION: Edition = Edition {
    title: "seismic design code, 2011",
    region: "Taiwan",
    in_force: InForce::recalled("2011", Some("2022")),
    superseded_by: Some("seismic design code, 2022"),
};

pub(crate) static BOUNDARY: ProvisionDescriptor = ProvisionDescriptor {
    name: "taiwan_2011_boundary",
    edition: &EDITION,
    clause: "2.16",
    basis: Basis::Displacement,
    height: HeightDatum::NotUsed,
    ground: Ground::OwnSide,
    elastic_displacement_factor: Some("0.6 * 1.4 alpha_y Ra"),
    formula: "0.6 * 1.4 alpha_y Ra d (Ra d = I u)",
    inputs: &[
        Input::Displacement,
        Input::Importance,
        Input::YieldAmplification,
    ],
    status: Status::Unverified("the factors; Ra stands under response_modification"),
    remarks: &[],
    worked: "0.6 * 1.4 * 1 * 1.1 * 80",
    rule: Rule::Boundary(boundary),
};

pub(crate) static BETWEEN: ProvisionDescriptor = ProvisionDescriptor {
    name: "taiwan_2011_between",
    formula: "sum over both buildings of 0.6 * 1.4 alpha_y Ra d (Ra d = I u)",
    status: Status::Unverified("the factors; the sum across the property line was seen"),
    rule: Rule::Between(between),
    worked: "0.6 * 1.4 * 1 * (1.1 * 80 + 1.1 * 60)",
    ..BOUNDARY
};

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    /// alpha_y = 1.5, I = 1, u = 80 and 60 mm: 0.6 * 1.4 * 1.5 = 1.26; 100.8 mm on the
    /// own side, 1.26 * 140 = 176.4 mm between.
    #[test]
    fn by_hand() {
        let structure = |u| Structure {
            displacement: Some(u),
            importance: Some(1.0),
            yield_amplification: Some(1.5),
            ..Structure::default()
        };
        let situation = Situation {
            left: structure(0.08),
            right: structure(0.06),
            ..Situation::default()
        };
        let own = BOUNDARY.boundary(&situation.left, &situation.site);
        assert!((own.unwrap().width - 0.100_8).abs() < 1.0e-12);
        assert!((BETWEEN.between(&situation).unwrap().width - 0.176_4).abs() < 1.0e-12);
    }
}
