//! RPA 2024 of Algeria.

use crate::assumptions::{Ground, HeightDatum};
use crate::descriptor::{Basis, ProvisionDescriptor, Rule};
use crate::edition::{Edition, InForce};
use crate::error::SeparationError;
use crate::inputs::{Input, Situation};
use crate::status::Status;
use crate::working::Working;

/// Narrowest gap (m).
const LEAST: f64 = 0.04;

fn between(working: &mut Working, situation: &Situation) -> Result<f64, SeparationError> {
    let root = working.root_of_squares(situation, Working::displacement)?;
    Ok(root.max(LEAST))
}

static EDITION: Edition = Edition {
    title: "RPA 2024",
    region: "Algeria",
    in_force: InForce::recalled("2024", None),
    superseded_by: None,
};

pub(crate) static BETWEEN: ProvisionDescriptor = ProvisionDescriptor {
    name: "rpa_2024_between",
    edition: &EDITION,
    clause: "5.8",
    basis: Basis::Displacement,
    height: HeightDatum::NotUsed,
    ground: Ground::NotAsked,
    elastic_displacement_factor: None,
    formula: "max(sqrt(u1^2 + u2^2), 40 mm)",
    inputs: &[Input::Displacement],
    status: Status::SeenInText("an excerpt of 5.8"),
    remarks: &[
        "The code takes the displacements at the top of the lower block, with torsion in them.",
        "Whether its displacements are reduced by R was not seen: the unreduced ones are taken.",
    ],
    worked: "max(sqrt(pow(80, 2) + pow(60, 2)), 40)",
    rule: Rule::Between(between),
};

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use crate::inputs::Structure;

    /// 80 and 60 mm: 100 mm; 24 and 18 mm: 30 mm, and so the least, 40 mm.
    #[test]
    fn by_hand() {
        for (left, right, width) in [(0.08, 0.06, 0.1), (0.024, 0.018, 0.04)] {
            let structure = |u| Structure {
                displacement: Some(u),
                ..Structure::default()
            };
            let situation = Situation {
                left: structure(left),
                right: structure(right),
                ..Situation::default()
            };
            let found = BETWEEN.between(&situation).unwrap().width;
            assert!((found - width).abs() < 1.0e-12, "{found}");
        }
    }
}
