//! UFC 3-310-03A, seismic design of buildings of the armed forces of the United States.

use crate::assumptions::{Ground, HeightDatum};
use crate::descriptor::{Basis, ProvisionDescriptor, Rule};
use crate::edition::{Edition, InForce};
use crate::error::SeparationError;
use crate::inputs::{Input, Situation};
use crate::status::Status;
use crate::working::Working;

fn flexible(working: &mut Working, situation: &Situation) -> Result<f64, SeparationError> {
    Ok(working.displacement(&situation.left)? + working.displacement(&situation.right)?)
}

static EDITION: Edition = Edition {
    title: "UFC 3-310-03A",
    region: "United States, armed forces",
    in_force: InForce::recalled("2005", Some("2007")),
    superseded_by: Some("UFC 3-310-04"),
};

pub(crate) static FLEXIBLE: ProvisionDescriptor = ProvisionDescriptor {
    name: "ufc_3_310_03a_between",
    edition: &EDITION,
    clause: "",
    basis: Basis::Displacement,
    height: HeightDatum::NotUsed,
    ground: Ground::NotAsked,
    elastic_displacement_factor: None,
    formula: "u1 + u2",
    inputs: &[Input::Displacement],
    status: Status::SeenInText("an excerpt, without the number of its clause"),
    remarks: &[
        "For flexible structures, with the rotation of foundations in u.",
        "For others half an inch for each 10 ft of additional height was seen, and not the line with the width that it is added to: that rule is not here.",
    ],
    worked: "80 + 60",
    rule: Rule::Between(flexible),
};

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use crate::inputs::Structure;

    /// 80 and 60 mm: 140 mm.
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
        assert!((FLEXIBLE.between(&situation).unwrap().width - 0.14).abs() < 1.0e-12);
    }
}
