//! IS 4326 of India.

use crate::assumptions::{Ground, HeightDatum};
use crate::descriptor::{Basis, ProvisionDescriptor, Rule};
use crate::edition::{Edition, InForce};
use crate::error::SeparationError;
use crate::inputs::{Input, Situation, StructuralSystem, Structure};
use crate::status::Status;
use crate::working::Working;

/// Coefficient at which the table holds.
const REFERENCE: f64 = 0.12;
/// Narrowest gap (m).
const LEAST: f64 = 0.025;

/// Width for one storey (m).
fn for_a_storey(working: &Working, structure: &Structure) -> Result<f64, SeparationError> {
    let system = working.need(structure.system, Input::StructuralSystem, &structure.name)?;
    Ok(match system {
        StructuralSystem::BoxWall | StructuralSystem::Wall | StructuralSystem::FrameWall => 0.015,
        StructuralSystem::Frame => 0.020,
        StructuralSystem::SteelFrame => 0.030,
    })
}

fn between(working: &mut Working, situation: &Situation) -> Result<f64, SeparationError> {
    let left = for_a_storey(working, &situation.left)?;
    let width = left.max(for_a_storey(working, &situation.right)?);
    let width = working.note("width for a storey", width, "m");
    let storeys = situation.left.storeys.min(situation.right.storeys);
    let storeys = working.note("storeys of the lower building", storeys as f64, "-");
    let given = situation.site.seismic_coefficient;
    let coefficient = working.need(given, Input::SeismicCoefficient, "")?;
    let coefficient = working.note("alpha_h", coefficient, "-");
    Ok((storeys * width * coefficient / REFERENCE).max(LEAST))
}

static EDITION: Edition = Edition {
    title: "IS 4326:1993 and 2013",
    region: "India",
    in_force: InForce::recalled("1993", None),
    superseded_by: None,
};

pub(crate) static BETWEEN: ProvisionDescriptor = ProvisionDescriptor {
    name: "is_4326_between",
    edition: &EDITION,
    clause: "Table 1",
    basis: Basis::Prescriptive,
    height: HeightDatum::NotUsed,
    ground: Ground::NotAsked,
    elastic_displacement_factor: None,
    formula: "storeys * (15 mm walls or frame with walls, 20 mm frame, 30 mm steel) * alpha_h / 0.12, at least 25 mm",
    inputs: &[Input::StructuralSystem, Input::SeismicCoefficient],
    status: Status::Unverified(
        "the table, also that frames with shear walls stand beside the box of walls, as recalled",
    ),
    remarks: &[
        "The storeys are those of the lower building.",
        "Of two kinds of structure the wider width is taken.",
        "The table's kinds are box system or frames with shear walls, moment-resistant frames of reinforced concrete, and of steel; walls without frame are counted as the first.",
    ],
    worked: "max(6 * 20 * 0.12 / 0.12, 25)",
    rule: Rule::Between(between),
};

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use crate::inputs::Site;

    /// Four storeys beside nine: at 0.12 frames need 80 mm, boxes and frames with walls 60 mm, steel beside a
    /// box 120 mm; at 0.03 boxes need the least, 25 mm.
    #[test]
    fn by_hand() {
        use StructuralSystem::{BoxWall, Frame, FrameWall, SteelFrame};
        for (left, right, coefficient, width) in [
            (Frame, Frame, 0.12, 0.08),
            (BoxWall, BoxWall, 0.12, 0.06),
            (FrameWall, FrameWall, 0.12, 0.06),
            (FrameWall, Frame, 0.12, 0.08),
            (BoxWall, SteelFrame, 0.12, 0.12),
            (Frame, Frame, 0.06, 0.04),
            (BoxWall, BoxWall, 0.03, 0.025),
        ] {
            let structure = |system, storeys| Structure {
                system: Some(system),
                storeys,
                ..Structure::default()
            };
            let situation = Situation {
                left: structure(left, 4),
                right: structure(right, 9),
                site: Site {
                    seismic_coefficient: Some(coefficient),
                    ..Site::default()
                },
            };
            let found = BETWEEN.between(&situation).unwrap().width;
            assert!((found - width).abs() < 1.0e-12, "{found} {width}");
        }
    }
}
