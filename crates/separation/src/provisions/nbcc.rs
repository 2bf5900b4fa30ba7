//! National Building Code of Canada.

use crate::assumptions::{Ground, HeightDatum};
use crate::descriptor::{Basis, ProvisionDescriptor, Rule};
use crate::edition::{Edition, InForce};
use crate::error::SeparationError;
use crate::inputs::{Input, Situation};
use crate::status::Status;
use crate::working::Working;

/// Deflections of 4.1.8.13 are elastic ones times `Rd Ro / IE`: the unreduced `u`.
fn between(working: &mut Working, situation: &Situation) -> Result<f64, SeparationError> {
    working.root_of_squares(situation, Working::displacement)
}

static EDITION: Edition = Edition {
    title: "NBCC 2015 and 2020",
    region: "Canada",
    in_force: InForce::recalled("2015", None),
    superseded_by: None,
};

pub(crate) static BETWEEN: ProvisionDescriptor = ProvisionDescriptor {
    name: "nbcc_2015_between",
    edition: &EDITION,
    clause: "4.1.8.14",
    basis: Basis::Displacement,
    height: HeightDatum::NotUsed,
    ground: Ground::NotAsked,
    elastic_displacement_factor: Some("Rd Ro / IE"),
    formula: "sqrt(u1^2 + u2^2)",
    inputs: &[Input::Displacement],
    status: Status::SeenInText("the text of the clause in the code of Ontario"),
    remarks: &[
        "Or tie the buildings: by a rigid tie, with the lower Rd Ro of the two; by any other, with a special study.",
    ],
    worked: "sqrt(pow(80, 2) + pow(60, 2))",
    rule: Rule::Between(between),
};

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use crate::inputs::Structure;

    /// 80 and 60 mm: 100 mm.
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
        assert!((BETWEEN.between(&situation).unwrap().width - 0.1).abs() < 1.0e-12);
    }
}
