//! Norme Tecniche per le Costruzioni 2018.

use pounding_catalogue::STANDARD_GRAVITY;

use crate::descriptor::{Basis, ProvisionDescriptor, Rule, Verification};
use crate::error::SeparationError;
use crate::inputs::{Input, Situation};
use crate::working::Working;

fn sum(working: &mut Working, situation: &Situation) -> Result<f64, SeparationError> {
    Ok(working.displacement(&situation.left)? + working.displacement(&situation.right)?)
}

fn minimum(working: &mut Working, situation: &Situation) -> Result<f64, SeparationError> {
    let given = situation.site.design_ground_acceleration;
    let acceleration = working.need(given, Input::DesignGroundAcceleration, "")?;
    let acceleration = working.note("a_g S", acceleration, "m/s2");
    let ratio = (2.0 * acceleration / STANDARD_GRAVITY).min(1.0);
    let ratio = working.note("min(1, 2 a_g S / g)", ratio, "-");
    Ok(0.01 * working.elevation(situation.elevation) * ratio)
}

pub(crate) static SUM: ProvisionDescriptor = ProvisionDescriptor {
    name: "ntc_2018_between",
    region: "Italy",
    edition: "NTC 2018",
    clause: "7.2.1",
    basis: Basis::Displacement,
    elastic_displacement_factor: None,
    formula: "u1 + u2",
    inputs: &[Input::Displacement],
    status: Verification::Unverified("the clause"),
    remarks: &["For displacements of the limit state of life safety (SLV)."],
    rule: Rule::Between(sum),
};

pub(crate) static MINIMUM: ProvisionDescriptor = ProvisionDescriptor {
    name: "ntc_2018_minimum",
    basis: Basis::Prescriptive,
    formula: "h / 100 * min(1, 2 a_g S / g)",
    inputs: &[Input::DesignGroundAcceleration],
    status: Verification::Unverified("the clause, and that the factor is capped at 1"),
    remarks: &["Holds beside the sum of displacements."],
    rule: Rule::Between(minimum),
    ..SUM
};

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use crate::inputs::{Site, Structure};

    /// 80 and 60 mm: 140 mm. At 9 m with a_g S = 0.25 g: 90 mm * 0.5 = 45 mm; with
    /// 0.6 g: 90 mm.
    #[test]
    fn by_hand() {
        let structure = |u| Structure {
            displacement: Some(u),
            ..Structure::default()
        };
        let situation = |acceleration: f64| Situation {
            left: structure(0.08),
            right: structure(0.06),
            elevation: 9.0,
            site: Site {
                design_ground_acceleration: Some(acceleration * STANDARD_GRAVITY),
                ..Site::default()
            },
        };
        let width =
            |descriptor: &ProvisionDescriptor, a| descriptor.between(&situation(a)).unwrap().width;
        assert!((width(&SUM, 0.25) - 0.14).abs() < 1.0e-12);
        assert!((width(&MINIMUM, 0.25) - 0.045).abs() < 1.0e-12);
        assert!((width(&MINIMUM, 0.6) - 0.09).abs() < 1.0e-12);
    }
}
