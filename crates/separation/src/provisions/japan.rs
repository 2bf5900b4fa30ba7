//! Practice in Japan.

use crate::descriptor::{Basis, ProvisionDescriptor, Rule, Verification};
use crate::error::SeparationError;
use crate::inputs::Situation;
use crate::working::Working;

fn practice(working: &mut Working, situation: &Situation) -> Result<f64, SeparationError> {
    Ok(0.01 * working.elevation(situation.elevation))
}

pub(crate) static PRACTICE: ProvisionDescriptor = ProvisionDescriptor {
    name: "japan_practice",
    region: "Japan",
    edition: "practice, no explicit provision",
    clause: "",
    basis: Basis::Prescriptive,
    elastic_displacement_factor: None,
    formula: "h / 100",
    inputs: &[],
    status: Verification::Unverified("the practice"),
    remarks: &["A drift of 1/100 in all; no provision speaks of the gap."],
    rule: Rule::Between(practice),
};

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    /// 9 m: 90 mm.
    #[test]
    fn by_hand() {
        let situation = Situation {
            elevation: 9.0,
            ..Situation::default()
        };
        assert!((PRACTICE.between(&situation).unwrap().width - 0.09).abs() < 1.0e-12);
    }
}
