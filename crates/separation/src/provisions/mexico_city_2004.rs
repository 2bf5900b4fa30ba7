//! Complementary technical rules for seismic design of Mexico City, 2004.

use crate::descriptor::{Basis, ProvisionDescriptor, Rule, Verification};
use crate::error::SeparationError;
use crate::inputs::{Input, Site, Situation, Structure};
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
    elevation: f64,
    site: &Site,
) -> Result<f64, SeparationError> {
    let zone = working.need(site.soil_zone, Input::SoilZone, "")?;
    let part = working.note("part of h for the zone", zone.choose(parts), "-");
    Ok(part * working.elevation(elevation))
}

fn boundary(
    working: &mut Working,
    structure: &Structure,
    elevation: f64,
    site: &Site,
) -> Result<f64, SeparationError> {
    let displacement = working.displacement(structure)?;
    Ok((displacement + part(working, ADDITIONS, elevation, site)?).max(LEAST))
}

fn boundary_simplified(
    working: &mut Working,
    _: &Structure,
    elevation: f64,
    site: &Site,
) -> Result<f64, SeparationError> {
    Ok(part(working, SIMPLIFIED, elevation, site)?.max(LEAST))
}

/// Half where both are alike: equal height, kind of structure and floors.
fn halved(working: &mut Working, situation: &Situation, sum: f64) -> Result<f64, SeparationError> {
    let Situation {
        left, right, site, ..
    } = situation;
    let systems = (
        working.need(left.system, Input::StructuralSystem, &left.name)?,
        working.need(right.system, Input::StructuralSystem, &right.name)?,
    );
    let level = working.floors_aligned(site)? && (left.height - right.height).abs() < 0.01;
    let alike = level && systems.0 == systems.1;
    Ok(sum * working.note("factor", if alike { 0.5 } else { 1.0 }, "-"))
}

fn between(working: &mut Working, situation: &Situation) -> Result<f64, SeparationError> {
    let Situation {
        left,
        right,
        elevation,
        site,
    } = situation;
    let sum =
        boundary(working, left, *elevation, site)? + boundary(working, right, *elevation, site)?;
    halved(working, situation, sum)
}

fn between_simplified(
    working: &mut Working,
    situation: &Situation,
) -> Result<f64, SeparationError> {
    let Situation {
        left,
        right,
        elevation,
        site,
    } = situation;
    let sum = boundary_simplified(working, left, *elevation, site)?
        + boundary_simplified(working, right, *elevation, site)?;
    halved(working, situation, sum)
}

pub(crate) static BOUNDARY: ProvisionDescriptor = ProvisionDescriptor {
    name: "mexico_city_2004_boundary",
    region: "Mexico City",
    edition: "NTC-Sismo 2004",
    clause: "1.10",
    basis: Basis::Displacement,
    elastic_displacement_factor: None,
    formula: "max(50 mm, u + (0.001, 0.003, 0.006 in zones I, II, III) h)",
    inputs: &[Input::Displacement, Input::SoilZone],
    status: Verification::Verified("text of the clause"),
    remarks: &[],
    rule: Rule::Boundary(boundary),
};

pub(crate) static BOUNDARY_SIMPLIFIED: ProvisionDescriptor = ProvisionDescriptor {
    name: "mexico_city_2004_boundary_simplified",
    basis: Basis::Prescriptive,
    formula: "max(50 mm, (0.007, 0.009, 0.012 in zones I, II, III) h)",
    inputs: &[Input::SoilZone],
    remarks: &["For the simplified method of analysis."],
    rule: Rule::Boundary(boundary_simplified),
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
    ..BOUNDARY
};

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use crate::inputs::{SoilZone, StructuralSystem};

    /// Zone II at 10 m: 80 + 30 = 110 and 60 + 30 = 90 mm, together 200 mm; half of it
    /// for buildings alike. Simplified 90 mm, 180 mm. Zone I at 10 m with 20 mm: 50 mm.
    #[test]
    fn by_hand() {
        let structure = |u, system| Structure {
            displacement: Some(u),
            height: 10.0,
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
                elevation: 10.0,
                site: site(SoilZone::Two, aligned),
            };
            let found = |c: &ProvisionDescriptor| c.between(&situation).unwrap().width;
            assert!((found(&BETWEEN) - width).abs() < 1.0e-12);
            assert!((found(&BETWEEN_SIMPLIFIED) - simplified).abs() < 1.0e-12);
            assert!((found(&BOUNDARY) - 0.2).abs() < 1.0e-12);
            assert!((found(&BOUNDARY_SIMPLIFIED) - 0.18).abs() < 1.0e-12);
        }
        let small = structure(0.02, frame);
        let own = BOUNDARY.boundary(&small, 10.0, &site(SoilZone::One, true));
        assert_eq!(own.unwrap().width, 0.05);
        let own = BOUNDARY_SIMPLIFIED.boundary(&small, 10.0, &site(SoilZone::Three, true));
        assert!((own.unwrap().width - 0.12).abs() < 1.0e-12);
    }
}
