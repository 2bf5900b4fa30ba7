//! GB 50011 of China.

use crate::assumptions::{Ground, HeightDatum};
use crate::descriptor::{Basis, ProvisionDescriptor, Rule};
use crate::edition::{Edition, InForce};
use crate::error::SeparationError;
use crate::inputs::{Input, Situation, StructuralSystem, Structure};
use crate::status::Status;
use crate::working::Working;

/// Width (m) for frames: 100 mm up to 15 m, 20 mm more for every further step, begun
/// steps counted whole.
fn for_frames(height: f64, step: f64) -> f64 {
    // A height that is a whole number of steps but for round-off is one.
    let steps = ((height - 15.0).max(0.0) / step - 1.0e-9).ceil().max(0.0);
    0.1 + 0.02 * steps
}

fn for_structure(
    working: &Working,
    structure: &Structure,
    frames: f64,
) -> Result<f64, SeparationError> {
    let system = working.need(structure.system, Input::StructuralSystem, &structure.name)?;
    Ok(match system {
        StructuralSystem::Frame => frames,
        StructuralSystem::FrameWall => (0.7 * frames).max(0.1),
        StructuralSystem::Wall | StructuralSystem::BoxWall => (0.5 * frames).max(0.1),
        StructuralSystem::SteelFrame => 1.5 * frames,
    })
}

fn between(working: &mut Working, situation: &Situation) -> Result<f64, SeparationError> {
    let Situation {
        left, right, site, ..
    } = situation;
    let given = site.fortification_intensity;
    let intensity = working.need(given, Input::FortificationIntensity, "")?;
    if !(6..=9).contains(&intensity) {
        return Err(SeparationError::OutOfRange {
            quantity: "fortification intensity",
            value: f64::from(intensity),
            range: "6, 7, 8, 9",
        });
    }
    working.note("intensity", f64::from(intensity), "-");
    let step = working.note("step", 11.0 - f64::from(intensity), "m");
    let lower = left.height.min(right.height);
    let lower = working.note("height of the lower building", lower, "m");
    let frames = working.note("w", for_frames(lower, step), "m");
    let width = for_structure(working, left, frames)?;
    Ok(width.max(for_structure(working, right, frames)?))
}

static EDITION: Edition = Edition {
    title: "GB 50011-2010",
    region: "China",
    in_force: InForce::recalled("2010-12-01", None),
    superseded_by: None,
};

pub(crate) static BETWEEN: ProvisionDescriptor = ProvisionDescriptor {
    name: "gb_50011_2010_between",
    edition: &EDITION,
    clause: "6.1.4, 8.1.4",
    basis: Basis::Prescriptive,
    height: HeightDatum::NotSeen,
    ground: Ground::NotAsked,
    elastic_displacement_factor: None,
    formula: "w = 100 mm + 20 mm for each begun step above 15 m; frame w, frame-wall max(100 mm, 0.7 w), wall max(100 mm, 0.5 w), steel 1.5 w",
    inputs: &[Input::FortificationIntensity, Input::StructuralSystem],
    status: Status::SeenInText(
        "an excerpt of 6.1.4, and 1.5 of 8.1.4 for steel; whether begun steps count whole was not seen",
    ),
    remarks: &[
        "The lower height and the wider of both requirements count.",
        "A box of load-bearing walls (`box_wall`) counts as a wall.",
        "Single-storey factories have fixed widths, which are not here.",
    ],
    worked: "100 + 20 * ceil((18 - 15) / (11 - 8))",
    rule: Rule::Between(between),
};

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use crate::inputs::Site;

    /// Lower building 24 m, intensity 8 (steps of 3 m): 100 + 3 * 20 = 160 mm. At 6
    /// (5 m) two begun steps, 140 mm; at 9 (2 m) five, 200 mm. 15 m: 100 mm.
    #[test]
    fn by_hand() {
        use StructuralSystem::{Frame, FrameWall, SteelFrame, Wall};
        for (left, right, height, intensity, width) in [
            (Frame, Frame, 24.0, 8, 0.16),
            (Frame, Frame, 24.0, 6, 0.14),
            (Frame, Frame, 24.0, 9, 0.20),
            (Frame, Frame, 15.0, 9, 0.10),
            (FrameWall, FrameWall, 24.0, 8, 0.112),
            (Wall, Wall, 24.0, 8, 0.10),
            (Wall, Wall, 24.0, 9, 0.10),
            (Wall, Frame, 24.0, 8, 0.16),
            (SteelFrame, Frame, 24.0, 8, 0.24),
        ] {
            let structure = |system, height| Structure {
                system: Some(system),
                height,
                ..Structure::default()
            };
            let situation = Situation {
                left: structure(left, height),
                right: structure(right, 60.0),
                site: Site {
                    fortification_intensity: Some(intensity),
                    ..Site::default()
                },
            };
            let found = BETWEEN.between(&situation).unwrap().width;
            assert!((found - width).abs() < 1.0e-12, "{found} {width}");
        }
    }

    #[test]
    fn intensity_out_of_range() {
        let mut situation = Situation::default();
        situation.site.fortification_intensity = Some(11);
        let result = BETWEEN.between(&situation);
        assert!(matches!(result, Err(SeparationError::OutOfRange { .. })));
    }
}
