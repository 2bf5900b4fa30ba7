//! NSR-10 of Colombia.

use crate::assumptions::{Ground, HeightDatum};
use crate::descriptor::{Basis, ProvisionDescriptor, Rule};
use crate::edition::{Edition, InForce};
use crate::error::SeparationError;
use crate::inputs::{Input, Site, Situation, Structure};
use crate::status::Status;
use crate::working::Working;

fn within(working: &mut Working, situation: &Situation) -> Result<f64, SeparationError> {
    Ok(working.displacement(&situation.left)? + working.displacement(&situation.right)?)
}

/// Parts of the height that a new building of so many storeys keeps.
struct Setback {
    /// Beside a building without its gap, floors aligned.
    aligned: f64,
    /// The same, floors not aligned.
    unaligned: f64,
    /// Beside none, or one that left its own gap.
    free: f64,
}

/// Table A.6.5-1.
fn setback(storeys: usize) -> Setback {
    let [aligned, unaligned, free] = match storeys {
        0..=2 => [0.0, 0.0, 0.0],
        3 => [0.0, 0.01, 0.0],
        _ => [0.02, 0.03, 0.01],
    };
    Setback {
        aligned,
        unaligned,
        free,
    }
}

fn noted(working: &mut Working, structure: &Structure, part: f64) -> f64 {
    let storeys = structure.storeys as f64;
    working.note(format!("storeys({})", structure.name), storeys, "-");
    working.note(format!("part of h({})", structure.name), part, "-")
}

fn boundary(
    working: &mut Working,
    structure: &Structure,
    _: &Site,
) -> Result<f64, SeparationError> {
    let part = noted(working, structure, setback(structure.storeys).free);
    Ok(part * working.elevation(structure))
}

fn beside_existing(working: &mut Working, situation: &Situation) -> Result<f64, SeparationError> {
    let site = &situation.site;
    if working.need(site.neighbour_has_gap, Input::NeighbourHasGap, "")? {
        let reason = "the neighbour has left its own gap: see nsr_10_boundary";
        return Err(working.not_applicable(reason));
    }
    let aligned = working.floors_aligned(site)?;
    let mut width = |structure: &Structure| {
        let setback = setback(structure.storeys);
        let part = if aligned {
            setback.aligned
        } else {
            setback.unaligned
        };
        noted(working, structure, part) * working.elevation(structure)
    };
    Ok(width(&situation.left).max(width(&situation.right)))
}

static EDITION: Edition = Edition {
    title: "NSR-10",
    region: "Colombia",
    in_force: InForce::recalled("2010-12-15", None),
    superseded_by: None,
};

pub(crate) static WITHIN: ProvisionDescriptor = ProvisionDescriptor {
    name: "nsr_10_between",
    edition: &EDITION,
    clause: "A.6.5.1",
    basis: Basis::Displacement,
    height: HeightDatum::NotUsed,
    ground: Ground::OneStructure,
    elastic_displacement_factor: None,
    formula: "|u1| + |u2|",
    inputs: &[Input::Displacement],
    status: Status::SeenInText("an excerpt of A.6.5.1"),
    remarks: &["Between parts of one construction."],
    worked: "80 + 60",
    rule: Rule::Between(within),
};

const NOT_ASKED_FOR: &str = "In zones of low hazard and beside a public way none is asked for.";

pub(crate) static BOUNDARY: ProvisionDescriptor = ProvisionDescriptor {
    name: "nsr_10_boundary",
    clause: "A.6.5.2.3, Table A.6.5-1",
    basis: Basis::Prescriptive,
    height: HeightDatum::NotSeen,
    ground: Ground::OwnSide,
    formula: "0.01 h above 3 storeys, else 0",
    inputs: &[],
    status: Status::SeenInText("an excerpt of A.6.5.2.3 with its table"),
    remarks: &[
        "Beside no neighbour, or one that has left its own gap.",
        NOT_ASKED_FOR,
    ],
    worked: "0.01 * 18000",
    rule: Rule::Boundary(boundary),
    ..WITHIN
};

pub(crate) static BESIDE_EXISTING: ProvisionDescriptor = ProvisionDescriptor {
    name: "nsr_10_beside_existing",
    ground: Ground::BesideExisting,
    formula: "by the storeys of the new building: up to 2 none; 3 none, 0.01 h where floors are not aligned; above 3 0.02 h where they are aligned, else 0.03 h",
    inputs: &[Input::NeighbourHasGap, Input::FloorsAligned],
    remarks: &[
        "Beside a neighbour without its own gap: the new building keeps all of it. Which of both is new is not asked, the wider counts.",
        NOT_ASKED_FOR,
    ],
    worked: "0.03 * 18000",
    rule: Rule::Between(beside_existing),
    ..BOUNDARY
};

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    /// At 9 m: nothing for 2 storeys; for 3 nothing, or 90 mm where floors are not aligned; for 4
    /// 180 mm, 270 mm, and 90 mm on the own side.
    #[test]
    fn by_hand() {
        for (storeys, aligned, unaligned, own) in [
            (1, 0.0, 0.0, 0.0),
            (2, 0.0, 0.0, 0.0),
            (3, 0.0, 0.09, 0.0),
            (4, 0.18, 0.27, 0.09),
            (20, 0.18, 0.27, 0.09),
        ] {
            let structure = |u, storeys| Structure {
                displacement: Some(u),
                storeys,
                elevation: 9.0,
                ..Structure::default()
            };
            let situation = |floors_aligned, neighbour_has_gap| Situation {
                left: structure(0.08, storeys),
                right: structure(0.06, 1),
                site: Site {
                    floors_aligned: Some(floors_aligned),
                    neighbour_has_gap: Some(neighbour_has_gap),
                    ..Site::default()
                },
            };
            for (floors, width) in [(true, aligned), (false, unaligned)] {
                let found = BESIDE_EXISTING.between(&situation(floors, false)).unwrap();
                assert!((found.width - width).abs() < 1.0e-12, "{storeys} {floors}");
            }
            let s = situation(true, true);
            let refused = BESIDE_EXISTING.between(&s);
            assert!(matches!(
                refused,
                Err(SeparationError::NotApplicable { .. })
            ));
            let found = BOUNDARY.boundary(&s.left, &s.site).unwrap();
            assert!((found.width - own).abs() < 1.0e-12, "{storeys}");
            assert!((WITHIN.between(&s).unwrap().width - 0.14).abs() < 1.0e-12);
        }
    }
}
