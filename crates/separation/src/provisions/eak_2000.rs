//! Greek seismic code EAK 2000.

use crate::assumptions::{Ground, HeightDatum};
use crate::descriptor::{Basis, ProvisionDescriptor, Rule};
use crate::edition::{Edition, InForce};
use crate::error::SeparationError;
use crate::inputs::{Input, Situation};
use crate::status::Status;
use crate::working::Working;

fn displacement(working: &mut Working, situation: &Situation) -> Result<f64, SeparationError> {
    working.root_of_squares(situation, Working::displacement)
}

fn joint(working: &mut Working, situation: &Situation) -> Result<f64, SeparationError> {
    let storeys = situation.left.storeys.min(situation.right.storeys);
    working.note("storeys in contact", storeys as f64, "-");
    Ok(match storeys {
        0..=3 => 0.04,
        4..=8 => 0.08,
        _ => 0.10,
    })
}

static EDITION: Edition = Edition {
    title: "EAK 2000",
    region: "Greece",
    in_force: InForce::recalled("2000", None),
    superseded_by: None,
};

const BESIDE: &str = "EN 1998-1 with the National Annex of Greece is admitted beside EAK 2000 (recalled, unverified): `eurocode_8_2004` is that code.";

pub(crate) static DISPLACEMENT: ProvisionDescriptor = ProvisionDescriptor {
    name: "eak_2000_between",
    edition: &EDITION,
    clause: "4.1.7.2",
    basis: Basis::Displacement,
    height: HeightDatum::NotUsed,
    ground: Ground::NotAsked,
    elastic_displacement_factor: None,
    formula: "sqrt(u1^2 + u2^2)",
    inputs: &[Input::Displacement],
    status: Status::Unverified("that SRSS is allowed; a sum is the safe reading"),
    remarks: &[BESIDE],
    worked: "sqrt(pow(80, 2) + pow(60, 2))",
    rule: Rule::Between(displacement),
};

pub(crate) static JOINT: ProvisionDescriptor = ProvisionDescriptor {
    name: "eak_2000_joint",
    basis: Basis::Prescriptive,
    formula: "40 mm up to 3 storeys in contact, 80 mm up to 8, 100 mm above",
    inputs: &[],
    status: Status::Unverified("the widths, and the numbers of storeys at which they change"),
    remarks: &[
        "The storeys in contact are taken as those of the lower building.",
        BESIDE,
    ],
    rule: Rule::Between(joint),
    worked: "80",
    ..DISPLACEMENT
};

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use crate::inputs::Structure;

    /// 80 and 60 mm: 100 mm. Joints by the lower building.
    #[test]
    fn by_hand() {
        let structure = |u, storeys| Structure {
            displacement: Some(u),
            storeys,
            ..Structure::default()
        };
        let situation = |storeys| Situation {
            left: structure(0.08, storeys),
            right: structure(0.06, 20),
            ..Situation::default()
        };
        let root = DISPLACEMENT.between(&situation(3)).unwrap().width;
        assert!((root - 0.1).abs() < 1.0e-12);
        for (storeys, width) in [(1, 0.04), (3, 0.04), (4, 0.08), (8, 0.08), (9, 0.1)] {
            assert_eq!(JOINT.between(&situation(storeys)).unwrap().width, width);
        }
    }
}
