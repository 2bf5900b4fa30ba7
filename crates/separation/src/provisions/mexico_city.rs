//! Complementary technical rules for seismic design of Mexico City, 2004 and 2020.

use crate::assumptions::{Ground, HeightDatum};
use crate::descriptor::{Basis, ProvisionDescriptor, Rule};
use crate::edition::{Edition, InForce};
use crate::error::SeparationError;
use crate::inputs::{Input, Site, Situation, Structure};
use crate::status::Status;
use crate::working::Working;

/// Narrowest distance from the border (m).
const LEAST: f64 = 0.05;
/// Additions to the displacement, parts of the height in zones I, II, III.
const ADDITIONS: [f64; 3] = [0.001, 0.003, 0.006];
/// Parts of the height without analysis.
const SIMPLIFIED: [f64; 3] = [0.007, 0.009, 0.012];

fn part(
    working: &mut Working,
    parts: [f64; 3],
    structure: &Structure,
    site: &Site,
) -> Result<f64, SeparationError> {
    let zone = working.need(site.soil_zone, Input::SoilZone, "")?;
    let part = working.note("part of h for the zone", zone.choose(parts), "-");
    Ok(part * working.elevation(structure))
}

fn boundary(
    working: &mut Working,
    structure: &Structure,
    site: &Site,
) -> Result<f64, SeparationError> {
    let displacement = working.displacement(structure)?;
    Ok((displacement + part(working, ADDITIONS, structure, site)?).max(LEAST))
}

fn boundary_simplified(
    working: &mut Working,
    structure: &Structure,
    site: &Site,
) -> Result<f64, SeparationError> {
    Ok(part(working, SIMPLIFIED, structure, site)?.max(LEAST))
}

/// Half where both are alike: equal height, kind of structure and floors.
fn halved(working: &mut Working, situation: &Situation, sum: f64) -> Result<f64, SeparationError> {
    let Situation { left, right, site } = situation;
    let systems = (
        working.need(left.system, Input::StructuralSystem, &left.name)?,
        working.need(right.system, Input::StructuralSystem, &right.name)?,
    );
    let level = working.floors_aligned(site)? && (left.height - right.height).abs() < 0.01;
    let alike = level && systems.0 == systems.1;
    Ok(sum * working.note("factor", if alike { 0.5 } else { 1.0 }, "-"))
}

fn between(working: &mut Working, situation: &Situation) -> Result<f64, SeparationError> {
    let Situation { left, right, site } = situation;
    let sum = boundary(working, left, site)? + boundary(working, right, site)?;
    halved(working, situation, sum)
}

fn between_simplified(
    working: &mut Working,
    situation: &Situation,
) -> Result<f64, SeparationError> {
    let Situation { left, right, site } = situation;
    let sum =
        boundary_simplified(working, left, site)? + boundary_simplified(working, right, site)?;
    halved(working, situation, sum)
}

static NTC_2004: Edition = Edition {
    title: "NTC-Sismo 2004",
    region: "Mexico City",
    in_force: InForce::recalled("2004-10-06", Some("2017-12-15")),
    superseded_by: Some("NTC-Sismo 2017"),
};

static NTC_2020: Edition = Edition {
    title: "NTC-Sismo 2020",
    region: "Mexico City",
    in_force: InForce::recalled("2020-06-09", Some("2023-11-06")),
    superseded_by: Some("NTC-Sismo 2023"),
};

pub(crate) static BOUNDARY: ProvisionDescriptor = ProvisionDescriptor {
    name: "mexico_city_2004_boundary",
    edition: &NTC_2004,
    clause: "1.10",
    basis: Basis::Displacement,
    height: HeightDatum::Ground,
    ground: Ground::OwnSide,
    elastic_displacement_factor: None,
    formula: "max(50 mm, u + (0.001, 0.003, 0.006 in zones I, II, III) h)",
    inputs: &[Input::Displacement, Input::SoilZone],
    status: Status::SeenInText("a transcription of 1.10 (scribd.com, document 671909992)"),
    remarks: &["Bending as a whole and rotation of the base are to be in u where they matter."],
    worked: "max(50, 80 + 0.003 * 18000)",
    rule: Rule::Boundary(boundary),
};

pub(crate) static BOUNDARY_SIMPLIFIED: ProvisionDescriptor = ProvisionDescriptor {
    name: "mexico_city_2004_boundary_simplified",
    basis: Basis::Prescriptive,
    formula: "max(50 mm, (0.007, 0.009, 0.012 in zones I, II, III) h)",
    inputs: &[Input::SoilZone],
    remarks: &["For the simplified method of analysis."],
    rule: Rule::Boundary(boundary_simplified),
    worked: "max(50, 0.009 * 18000)",
    ..BOUNDARY
};

/// What rotation and sway of the base add where the model does not have them, by zone.
const BASE: [f64; 3] = [0.0, 0.003, 0.006];

fn boundary_2020(
    working: &mut Working,
    structure: &Structure,
    site: &Site,
) -> Result<f64, SeparationError> {
    let mut width = working.displacement(structure)?;
    // The zone is asked for either way: what is added is a fact of the building's model.
    let base = part(working, BASE, structure, site)?;
    if !structure.base_moves {
        width += working.note(format!("base({})", structure.name), base, "m");
    }
    Ok(width.max(LEAST))
}

pub(crate) static BOUNDARY_2020: ProvisionDescriptor = ProvisionDescriptor {
    name: "mexico_city_2020_boundary",
    edition: &NTC_2020,
    clause: "1.9",
    height: HeightDatum::NotSeen,
    formula: "max(50 mm, u + (0, 0.003, 0.006 in zones I, II, III) h); nothing is added where the building stands on a foundation in the model",
    status: Status::SeenInText("an excerpt of 1.9"),
    remarks: &[
        "u is the displacement of the limit state of collapse prevention.",
        "What 1.9 says of two buildings on one property was not seen: both sides are summed.",
    ],
    rule: Rule::Boundary(boundary_2020),
    ..BOUNDARY
};

const ALIKE: &str =
    "Half for equal heights, kinds of structure and floors; heights within 10 mm count as equal.";

pub(crate) static BETWEEN: ProvisionDescriptor = ProvisionDescriptor {
    name: "mexico_city_2004_between",
    formula: "sum over both buildings of max(50 mm, u + (0.001, 0.003, 0.006) h), half of it where both are alike",
    inputs: &[
        Input::Displacement,
        Input::SoilZone,
        Input::StructuralSystem,
        Input::FloorsAligned,
    ],
    remarks: &[ALIKE],
    rule: Rule::Between(between),
    worked: "1 * (max(50, 80 + 0.003 * 18000) + max(50, 60 + 0.003 * 18000))",
    ground: Ground::OneProperty,
    ..BOUNDARY
};

pub(crate) static BETWEEN_SIMPLIFIED: ProvisionDescriptor = ProvisionDescriptor {
    name: "mexico_city_2004_between_simplified",
    basis: Basis::Prescriptive,
    formula: "sum over both buildings of max(50 mm, (0.007, 0.009, 0.012) h), half of it where both are alike",
    inputs: &[
        Input::SoilZone,
        Input::StructuralSystem,
        Input::FloorsAligned,
    ],
    remarks: &[ALIKE, "For the simplified method of analysis."],
    rule: Rule::Between(between_simplified),
    worked: "1 * (max(50, 0.009 * 18000) + max(50, 0.009 * 18000))",
    ground: Ground::OneProperty,
    ..BOUNDARY
};

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use crate::inputs::{SoilZone, StructuralSystem};

    /// Zone II at 10 m: 80 + 30 = 110 mm, zone III 80 + 60 = 140 mm, zone I 80 mm; 80 mm in all of
    /// them where the base moves in the model, and 50 mm at least.
    #[test]
    fn base_by_hand() {
        for (zone, u, base_moves, width) in [
            (SoilZone::One, 0.08, false, 0.08),
            (SoilZone::Two, 0.08, false, 0.11),
            (SoilZone::Three, 0.08, false, 0.14),
            (SoilZone::Three, 0.08, true, 0.08),
            (SoilZone::Three, 0.02, true, 0.05),
        ] {
            let structure = Structure {
                displacement: Some(u),
                elevation: 10.0,
                base_moves,
                ..Structure::default()
            };
            let site = Site {
                soil_zone: Some(zone),
                ..Site::default()
            };
            let own = BOUNDARY_2020.boundary(&structure, &site).unwrap();
            assert!(
                (own.width - width).abs() < 1.0e-12,
                "{zone:?}: {}",
                own.width
            );
        }
    }

    /// Zone II at 10 m: 80 + 30 = 110 and 60 + 30 = 90 mm, together 200 mm; half of it
    /// for buildings alike. Simplified 90 mm, 180 mm. Zone I at 10 m with 20 mm: 50 mm.
    #[test]
    fn by_hand() {
        let structure = |u, system| Structure {
            displacement: Some(u),
            height: 10.0,
            elevation: 10.0,
            system: Some(system),
            ..Structure::default()
        };
        let site = |zone, aligned| Site {
            soil_zone: Some(zone),
            floors_aligned: Some(aligned),
            ..Site::default()
        };
        let frame = StructuralSystem::Frame;
        let wall = StructuralSystem::Wall;
        for (other, aligned, width, simplified) in [
            (frame, true, 0.1, 0.09),
            (frame, false, 0.2, 0.18),
            (wall, true, 0.2, 0.18),
        ] {
            let situation = Situation {
                left: structure(0.08, frame),
                right: structure(0.06, other),
                site: site(SoilZone::Two, aligned),
            };
            let found = |c: &ProvisionDescriptor| c.between(&situation).unwrap().width;
            assert!((found(&BETWEEN) - width).abs() < 1.0e-12);
            assert!((found(&BETWEEN_SIMPLIFIED) - simplified).abs() < 1.0e-12);
            assert!((found(&BOUNDARY) - 0.2).abs() < 1.0e-12);
            assert!((found(&BOUNDARY_SIMPLIFIED) - 0.18).abs() < 1.0e-12);
        }
        let small = structure(0.02, frame);
        let own = BOUNDARY.boundary(&small, &site(SoilZone::One, true));
        assert_eq!(own.unwrap().width, 0.05);
        let own = BOUNDARY_SIMPLIFIED.boundary(&small, &site(SoilZone::Three, true));
        assert!((own.unwrap().width - 0.12).abs() < 1.0e-12);
    }
}
