//! E.030 of Peru, editions 2018 and 2026.

use pounding_catalogue::STANDARD_GRAVITY;

use crate::assumptions::{Ground, HeightDatum};
use crate::descriptor::{Basis, ProvisionDescriptor, Rule};
use crate::edition::{Edition, InForce};
use crate::error::SeparationError;
use crate::inputs::{Input, Site, Situation, Structure};
use crate::status::Status;
use crate::working::Working;

const PART: f64 = 2.0 / 3.0;

/// `s` of 2018: `max(0.006 h, 30 mm)`.
fn s_2018(_: &mut Working, h: f64, _: &Site) -> Result<f64, SeparationError> {
    Ok((0.006 * h).max(0.03))
}

/// `s` of 2026: `max(0.02 Z S h, 30 mm)`, with `Z S` from the design ground acceleration `Z S g`.
fn s_2026(working: &mut Working, h: f64, site: &Site) -> Result<f64, SeparationError> {
    let given = site.design_ground_acceleration;
    let acceleration = working.need(given, Input::DesignGroundAcceleration, "")?;
    let zone_and_soil = working.note("Z S", acceleration / STANDARD_GRAVITY, "-");
    Ok((0.02 * zone_and_soil * h).max(0.03))
}

type Least = fn(&mut Working, f64, &Site) -> Result<f64, SeparationError>;

/// The rules of an edition with its own `s`.
macro_rules! rules_with {
    ($module:ident, $least:ident) => {
        mod $module {
            use super::*;

            const LEAST: Least = $least;

            pub(super) fn boundary(
                working: &mut Working,
                structure: &Structure,
                site: &Site,
            ) -> Result<f64, SeparationError> {
                let displacement = working.unreduced(structure)?;
                let height = working.elevation(structure);
                let half = 0.5 * LEAST(working, height, site)?;
                Ok((PART * displacement).max(working.note("s / 2", half, "m")))
            }

            pub(super) fn minimum(
                working: &mut Working,
                situation: &Situation,
            ) -> Result<f64, SeparationError> {
                let height = working.common_elevation(situation);
                LEAST(working, height, &situation.site)
            }

            pub(super) fn without_joint(
                working: &mut Working,
                situation: &Situation,
            ) -> Result<f64, SeparationError> {
                let mut half = |structure: &Structure| -> Result<f64, SeparationError> {
                    let height = working.elevation(structure);
                    let half = 0.5 * LEAST(working, height, &situation.site)?;
                    let name = format!("s / 2({})", structure.name);
                    Ok(working.note(name, half, "m"))
                };
                Ok(half(&situation.left)? + half(&situation.right)?)
            }
        }
    };
}

rules_with!(of_2018, s_2018);
rules_with!(of_2026, s_2026);

fn between(working: &mut Working, situation: &Situation) -> Result<f64, SeparationError> {
    let sum = working.unreduced(&situation.left)? + working.unreduced(&situation.right)?;
    Ok(PART * sum)
}

static E_030_2018: Edition = Edition {
    title: "E.030-2018",
    region: "Peru",
    in_force: InForce::recalled("2018", Some("2026")),
    superseded_by: Some("E.030-2026"),
};

static E_030_2026: Edition = Edition {
    title: "E.030-2026 (RM 183-2026-VIVIENDA)",
    region: "Peru",
    in_force: InForce::recalled("2026", None),
    superseded_by: None,
};

const UNREDUCED: &str = "I u is the displacement without reduction of forces; the code takes 0.75 R (irregular buildings 0.85 R) times the reduced one (Art. 31), which is 0.75 or 0.85 of that: on the safe side. I is its factor U of use, 1 where `importance` is not given.";
const UNREDUCED_2026: &str = "I u is the displacement without reduction of forces; the edition of 2018 takes 0.75 R (irregular buildings 0.85 R) times the reduced one (its Art. 31), which is 0.75 or 0.85 of that: on the safe side; that of 2026 was not seen on it. I is its factor U of use, 1 where `importance` is not given.";

pub(crate) static BOUNDARY_2018: ProvisionDescriptor = ProvisionDescriptor {
    name: "e_030_2018_boundary",
    edition: &E_030_2018,
    clause: "33.3",
    basis: Basis::Displacement,
    height: HeightDatum::NotSeen,
    ground: Ground::OwnSide,
    elastic_displacement_factor: Some("0.75 R or 0.85 R"),
    formula: "max(2/3 I u, s / 2), s = max(0.006 h, 30 mm)",
    inputs: &[Input::Displacement],
    status: Status::SeenInText("a transcription of Art. 33"),
    remarks: &[
        UNREDUCED,
        "s / 2 holds beside a neighbour that has its joint; beside another see 33.4.",
    ],
    worked: "max(2 / 3 * 1.1 * 80, max(0.006 * 18000, 30) / 2)",
    rule: Rule::Boundary(of_2018::boundary),
};

pub(crate) static BETWEEN_2018: ProvisionDescriptor = ProvisionDescriptor {
    name: "e_030_2018_between",
    clause: "33.2",
    height: HeightDatum::NotUsed,
    ground: Ground::NotAsked,
    formula: "2/3 (I1 u1 + I2 u2)",
    remarks: &[UNREDUCED],
    worked: "2 / 3 * (1.1 * 80 + 1.1 * 60)",
    rule: Rule::Between(between),
    ..BOUNDARY_2018
};

pub(crate) static MINIMUM_2018: ProvisionDescriptor = ProvisionDescriptor {
    name: "e_030_2018_minimum",
    clause: "33.2",
    basis: Basis::Prescriptive,
    ground: Ground::NotAsked,
    elastic_displacement_factor: None,
    formula: "max(0.006 h, 30 mm)",
    inputs: &[],
    remarks: &["Holds beside the rule of displacements."],
    worked: "max(0.006 * 18000, 30)",
    rule: Rule::Between(of_2018::minimum),
    ..BOUNDARY_2018
};

pub(crate) static WITHOUT_JOINT_2018: ProvisionDescriptor = ProvisionDescriptor {
    name: "e_030_2018_beside_existing",
    clause: "33.4",
    ground: Ground::BesideExisting,
    formula: "s1 / 2 + s2 / 2, s = max(0.006 h, 30 mm)",
    remarks: &["Beside a neighbour without its joint: the new building keeps both halves."],
    worked: "max(0.006 * 18000, 30) / 2 + max(0.006 * 18000, 30) / 2",
    rule: Rule::Between(of_2018::without_joint),
    ..MINIMUM_2018
};

const OF_2026: Status = Status::SeenInText("a program by others and its documentation");

pub(crate) static BOUNDARY_2026: ProvisionDescriptor = ProvisionDescriptor {
    name: "e_030_2026_boundary",
    edition: &E_030_2026,
    clause: "52.3",
    formula: "max(2/3 I u, s / 2), s = max(0.02 Z S h, 30 mm)",
    inputs: &[Input::Displacement, Input::DesignGroundAcceleration],
    status: OF_2026,
    remarks: &[
        UNREDUCED_2026,
        "s / 2 holds beside a neighbour that has its joint; beside another see 52.4.",
    ],
    worked: "max(2 / 3 * 1.1 * 80, max(0.02 * 0.25 * 18000, 30) / 2)",
    rule: Rule::Boundary(of_2026::boundary),
    ..BOUNDARY_2018
};

pub(crate) static BETWEEN_2026: ProvisionDescriptor = ProvisionDescriptor {
    name: "e_030_2026_between",
    edition: &E_030_2026,
    clause: "52",
    remarks: &[UNREDUCED_2026],
    status: OF_2026,
    ..BETWEEN_2018
};

pub(crate) static MINIMUM_2026: ProvisionDescriptor = ProvisionDescriptor {
    name: "e_030_2026_minimum",
    edition: &E_030_2026,
    clause: "52",
    formula: "max(0.02 Z S h, 30 mm)",
    inputs: &[Input::DesignGroundAcceleration],
    status: OF_2026,
    worked: "max(0.02 * 0.25 * 18000, 30)",
    rule: Rule::Between(of_2026::minimum),
    ..MINIMUM_2018
};

pub(crate) static WITHOUT_JOINT_2026: ProvisionDescriptor = ProvisionDescriptor {
    name: "e_030_2026_beside_existing",
    edition: &E_030_2026,
    clause: "52.4",
    formula: "s1 / 2 + s2 / 2, s = max(0.02 Z S h, 30 mm)",
    inputs: &[Input::DesignGroundAcceleration],
    status: OF_2026,
    worked: "max(0.02 * 0.25 * 18000, 30) / 2 + max(0.02 * 0.25 * 18000, 30) / 2",
    rule: Rule::Between(of_2026::without_joint),
    ..WITHOUT_JOINT_2018
};

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    fn structure(u: f64, elevation: f64) -> Structure {
        Structure {
            displacement: Some(u),
            elevation,
            ..Structure::default()
        }
    }

    fn situation(elevation: f64) -> Situation {
        Situation {
            left: structure(0.09, elevation),
            right: structure(0.06, elevation),
            site: Site {
                design_ground_acceleration: Some(0.45 * 1.1 * STANDARD_GRAVITY),
                ..Site::default()
            },
        }
    }

    /// 90 and 60 mm: 100 mm between, 60 mm on the own side; at 9 m s = 54 mm, at 4 m 30 mm;
    /// 30 mm of own displacement at 9 m: s / 2 = 27 mm. Beside a building without its joint both
    /// halves, 54 mm.
    #[test]
    fn by_hand() {
        let s = situation(9.0);
        assert!((BETWEEN_2018.between(&s).unwrap().width - 0.1).abs() < 1.0e-12);
        assert!((MINIMUM_2018.between(&s).unwrap().width - 0.054).abs() < 1.0e-12);
        assert!((MINIMUM_2018.between(&situation(4.0)).unwrap().width - 0.03).abs() < 1.0e-12);
        assert!((WITHOUT_JOINT_2018.between(&s).unwrap().width - 0.054).abs() < 1.0e-12);
        let own = |u, h| {
            BOUNDARY_2018
                .boundary(&structure(u, h), &s.site)
                .unwrap()
                .width
        };
        assert!((own(0.09, 9.0) - 0.06).abs() < 1.0e-12);
        assert!((own(0.03, 9.0) - 0.027).abs() < 1.0e-12);
        // An essential building, whose design forces are 1.5 times as large: 100 mm + 20 mm on its own side alone.
        let mut essential = s;
        essential.right.importance = Some(1.5);
        assert!((BETWEEN_2018.between(&essential).unwrap().width - 0.12).abs() < 1.0e-12);
    }

    /// Z = 0.45, S = 1.1: 0.02 * 0.495 * 9 m is 89.1 mm, at 3 m 29.7 mm and so 30 mm; half of it
    /// is 44.55 mm, which 2/3 of 60 mm does not reach and 2/3 of 90 mm does.
    #[test]
    fn edition_of_2026_by_hand() {
        let s = situation(9.0);
        assert!((BETWEEN_2026.between(&s).unwrap().width - 0.1).abs() < 1.0e-12);
        assert!((MINIMUM_2026.between(&s).unwrap().width - 0.0891).abs() < 1.0e-12);
        assert!((MINIMUM_2026.between(&situation(3.0)).unwrap().width - 0.03).abs() < 1.0e-12);
        assert!((WITHOUT_JOINT_2026.between(&s).unwrap().width - 0.0891).abs() < 1.0e-12);
        let own = |u| {
            BOUNDARY_2026
                .boundary(&structure(u, 9.0), &s.site)
                .unwrap()
                .width
        };
        assert!((own(0.09) - 0.06).abs() < 1.0e-12);
        assert!((own(0.06) - 0.04455).abs() < 1.0e-12);
    }
}
