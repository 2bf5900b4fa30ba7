//! Practice in Japan.

use crate::assumptions::{Ground, HeightDatum};
use crate::descriptor::{Basis, ProvisionDescriptor, Rule};
use crate::edition::Edition;
use crate::error::SeparationError;
use crate::inputs::Situation;
use crate::status::Status;
use crate::working::Working;

fn practice(working: &mut Working, situation: &Situation) -> Result<f64, SeparationError> {
    Ok(0.01 * working.common_elevation(situation))
}

static PRACTICE_OF_JAPAN: Edition = Edition {
    title: "practice, no explicit provision",
    region: "Japan",
    in_force: None,
    superseded_by: None,
};

pub(crate) static PRACTICE: ProvisionDescriptor = ProvisionDescriptor {
    name: "japan_practice",
    edition: &PRACTICE_OF_JAPAN,
    clause: "",
    basis: Basis::Prescriptive,
    height: HeightDatum::NotSeen,
    ground: Ground::NotAsked,
    elastic_displacement_factor: None,
    formula: "h / 100",
    inputs: &[],
    status: Status::SeenInText("a description of the practice"),
    remarks: &[
        "A drift of 1/100 in all; no provision speaks of the gap.",
        "Practice moves to 1/50, which is twice as wide.",
    ],
    worked: "18000 / 100",
    rule: Rule::Between(practice),
};

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use crate::inputs::Structure;

    /// 9 m: 90 mm. Floors at 22 and 19.2 m: 220 mm, on whichever side the higher one lies.
    #[test]
    fn by_hand() {
        for (left, right, width) in [(9.0, 9.0, 0.09), (22.0, 19.2, 0.22), (19.2, 22.0, 0.22)] {
            let structure = |elevation| Structure {
                elevation,
                ..Structure::default()
            };
            let situation = Situation {
                left: structure(left),
                right: structure(right),
                ..Situation::default()
            };
            let found = PRACTICE.between(&situation).unwrap().width;
            assert!((found - width).abs() < 1.0e-12, "{left} {right}: {found}");
        }
    }
}
