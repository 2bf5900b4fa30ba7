//! Norme Tecniche per le Costruzioni 2018.

use pounding_catalogue::STANDARD_GRAVITY;

use crate::assumptions::{Ground, HeightDatum};
use crate::descriptor::{Basis, ProvisionDescriptor, Rule};
use crate::edition::{Edition, InForce};
use crate::error::SeparationError;
use crate::inputs::{Input, Situation, Structure};
use crate::status::Status;
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
    Ok(0.01 * working.common_elevation(situation) * ratio)
}

static EDITION: Edition = Edition {
    title: "NTC 2018",
    region: "Italy",
    in_force: Some(InForce {
        from: "2018-03-22",
        until: None,
        source: Some("report on the decree of 17 January 2018 at ingenio-web.it"),
    }),
    superseded_by: None,
};

pub(crate) static SUM: ProvisionDescriptor = ProvisionDescriptor {
    name: "ntc_2018_between",
    edition: &EDITION,
    clause: "7.2.1",
    basis: Basis::Displacement,
    height: HeightDatum::NotUsed,
    ground: Ground::NotAsked,
    elastic_displacement_factor: Some("mu_d"),
    formula: "u1 + u2",
    inputs: &[Input::Displacement],
    status: Status::Unverified(
        "that 7.2.1 keeps the sum, which was seen in an excerpt of NTC 2008, 7.2.2",
    ),
    remarks: &[
        "For displacements of the limit state of life safety (SLV).",
        "7.3.3.3 multiplies those of a linear analysis by mu_d (recalled, unverified); u is the unreduced one.",
    ],
    worked: "80 + 60",
    rule: Rule::Between(sum),
};

/// `H / 100 a_g S / g` for either building, with its own height `H`.
fn without_calculation(
    working: &mut Working,
    situation: &Situation,
) -> Result<f64, SeparationError> {
    let given = situation.site.design_ground_acceleration;
    let acceleration = working.need(given, Input::DesignGroundAcceleration, "")?;
    let acceleration = working.note("a_g S", acceleration, "m/s2");
    let mut of = |structure: &Structure| {
        let height = working.note(format!("H({})", structure.name), structure.height, "m");
        let moved = 0.01 * height * acceleration / STANDARD_GRAVITY;
        working.note(format!("u({})", structure.name), moved, "m")
    };
    Ok(of(&situation.left) + of(&situation.right))
}

pub(crate) static WITHOUT_CALCULATION: ProvisionDescriptor = ProvisionDescriptor {
    name: "ntc_2018_without_calculation",
    basis: Basis::Prescriptive,
    height: HeightDatum::Foundation,
    formula: "u1 + u2, u = H / 100 * a_g S / g with the height H of each building",
    inputs: &[Input::DesignGroundAcceleration],
    status: Status::SeenInText(
        "an excerpt of NTC 2018, 7.2.1; that H is the height of the building in a quotation of NTC 2008, 7.2.2, which divides by 0.5 g",
    ),
    remarks: &[
        "In place of the sum of displacements, where those of a building are not computed; not for one on isolators.",
    ],
    worked: "21000 / 100 * 0.25 + 18000 / 100 * 0.25",
    rule: Rule::Between(without_calculation),
    elastic_displacement_factor: None,
    ..SUM
};

pub(crate) static MINIMUM: ProvisionDescriptor = ProvisionDescriptor {
    name: "ntc_2018_minimum",
    basis: Basis::Prescriptive,
    formula: "h / 100 * min(1, 2 a_g S / g)",
    inputs: &[Input::DesignGroundAcceleration],
    status: Status::SeenInText("an excerpt of NTC 2018, 7.2.1"),
    remarks: &["Holds beside the sum of displacements."],
    rule: Rule::Between(minimum),
    worked: "18000 / 100 * min(1, 2 * 0.25)",
    height: HeightDatum::Foundation,
    elastic_displacement_factor: None,
    ..SUM
};

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use crate::inputs::Site;

    /// 80 and 60 mm: 140 mm. At 9 m with a_g S = 0.25 g: 90 mm * 0.5 = 45 mm; with
    /// 0.6 g: 90 mm.
    #[test]
    fn by_hand() {
        let structure = |u, height| Structure {
            displacement: Some(u),
            height,
            elevation: 9.0,
            ..Structure::default()
        };
        let situation = |acceleration: f64| Situation {
            left: structure(0.08, 9.0),
            right: structure(0.06, 15.0),
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
        // 9 m / 100 * 0.25 is 22.5 mm, 15 m / 100 * 0.25 is 37.5 mm.
        assert!((width(&WITHOUT_CALCULATION, 0.25) - 0.06).abs() < 1.0e-12);
    }
}
