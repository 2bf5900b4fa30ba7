//! Building codes of Turkey, 2018 and 2007.

use crate::assumptions::{Ground, HeightDatum};
use crate::descriptor::{Basis, ProvisionDescriptor, Rule};
use crate::edition::{Edition, InForce};
use crate::error::SeparationError;
use crate::inputs::{Input, Situation, Structure};
use crate::status::Status;
use crate::working::Working;

/// 1/4 where floors are aligned, else 1/2.
fn share(working: &mut Working, situation: &Situation) -> Result<f64, SeparationError> {
    let aligned = working.floors_aligned(&situation.site)?;
    Ok(working.note("factor", if aligned { 0.25 } else { 0.5 }, "-"))
}

/// `(R / I) d`, which is `u` unless `d` is given.
fn over_importance(working: &mut Working, s: &Structure) -> Result<f64, SeparationError> {
    match s.elastic_displacement {
        Some(_) => Ok(working.restored(s)? / working.importance(s)?),
        None => working.displacement(s),
    }
}

fn tbdy_2018(working: &mut Working, situation: &Situation) -> Result<f64, SeparationError> {
    let root = working.root_of_squares(situation, over_importance)?;
    Ok(share(working, situation)? * root)
}

fn tdy_2007(working: &mut Working, situation: &Situation) -> Result<f64, SeparationError> {
    let sum = working.restored(&situation.left)? + working.restored(&situation.right)?;
    Ok(share(working, situation)? * sum)
}

fn minimum(working: &mut Working, situation: &Situation) -> Result<f64, SeparationError> {
    let height = working.common_elevation(situation);
    // A height that is a whole number of steps but for round-off is one.
    let steps = ((height - 6.0).max(0.0) / 3.0 - 1.0e-9).ceil().max(0.0);
    Ok(0.03 + 0.01 * working.note("begun steps of 3 m above 6 m", steps, "-"))
}

static TBDY_2018_EDITION: Edition = Edition {
    title: "TBDY 2018",
    region: "Turkey",
    in_force: InForce::recalled("2019-01-01", None),
    superseded_by: None,
};

static TDY_2007_EDITION: Edition = Edition {
    title: "TDY 2007",
    region: "Turkey",
    in_force: InForce::recalled("2007-03-06", Some("2019-01-01")),
    superseded_by: Some("TBDY 2018"),
};

pub(crate) static TBDY_2018: ProvisionDescriptor = ProvisionDescriptor {
    name: "tbdy_2018_between",
    edition: &TBDY_2018_EDITION,
    clause: "4.9.3.1",
    basis: Basis::Displacement,
    height: HeightDatum::NotUsed,
    ground: Ground::NotAsked,
    elastic_displacement_factor: Some("0.25 R / I or 0.5 R / I"),
    formula: "alpha sqrt(d1^2 + d2^2), alpha = 0.25 R / I where floors are aligned, else 0.5 R / I (R d / I = u)",
    inputs: &[Input::Displacement, Input::FloorsAligned],
    status: Status::SeenInText("an excerpt of 4.9.3.1"),
    remarks: &[
        "Each building's own R / I goes with its displacement.",
        "If floors differ in some storeys only, 0.5 holds for the whole building.",
    ],
    worked: "0.5 * sqrt(pow(80, 2) + pow(60, 2))",
    rule: Rule::Between(tbdy_2018),
};

pub(crate) static TBDY_2018_MINIMUM: ProvisionDescriptor = ProvisionDescriptor {
    name: "tbdy_2018_minimum",
    basis: Basis::Prescriptive,
    elastic_displacement_factor: None,
    formula: "30 mm up to 6 m, 10 mm more for each begun 3 m above",
    inputs: &[],
    clause: "4.9.3.2",
    height: HeightDatum::NotSeen,
    status: Status::SeenInText("an excerpt of 4.9.3.2; 50 mm at 12 m"),
    remarks: &["Holds beside the rule of displacements."],
    worked: "30 + 10 * ceil((18 - 6) / 3)",
    rule: Rule::Between(minimum),
    ..TBDY_2018
};

/// Seats of bridges between buildings: `1.5 (R / I) (d1 + d2)`.
fn seat(working: &mut Working, situation: &Situation) -> Result<f64, SeparationError> {
    let left = over_importance(working, &situation.left)?;
    let right = over_importance(working, &situation.right)?;
    Ok(working.note("factor", 1.5, "-") * (left + right))
}

pub(crate) static TBDY_2018_SEAT: ProvisionDescriptor = ProvisionDescriptor {
    name: "tbdy_2018_bridge_seat",
    clause: "4.9.3.4",
    elastic_displacement_factor: Some("1.5 R / I"),
    formula: "1.5 (R / I) (|d1| + |d2|) (R d / I = u)",
    inputs: &[Input::Displacement],
    status: Status::SeenInText("an excerpt of 4.9.3.4"),
    remarks: &[
        "The seat of a bridge between two buildings, not a width of the gap.",
        "Each building's own R / I goes with its displacement.",
    ],
    worked: "1.5 * (80 + 60)",
    rule: Rule::Seat(seat),
    ..TBDY_2018
};

pub(crate) static TDY_2007: ProvisionDescriptor = ProvisionDescriptor {
    name: "tdy_2007_between",
    edition: &TDY_2007_EDITION,
    clause: "2.10.3",
    elastic_displacement_factor: Some("R / 4 or R / 2"),
    formula: "alpha (d1 + d2), alpha = R / 4 where floors are aligned, else R / 2 (R d = I u)",
    inputs: &[Input::Displacement, Input::Importance, Input::FloorsAligned],
    status: Status::Unverified("the clause; the sum is the safe reading of it"),
    remarks: &["Each building's own R goes with its displacement."],
    rule: Rule::Between(tdy_2007),
    worked: "0.5 * (1.1 * 80 + 1.1 * 60)",
    ..TBDY_2018
};

pub(crate) static TDY_2007_MINIMUM: ProvisionDescriptor = ProvisionDescriptor {
    name: "tdy_2007_minimum",
    edition: &TDY_2007_EDITION,
    clause: "2.10.3",
    status: Status::Unverified("the clause, and that begun steps count whole"),
    ..TBDY_2018_MINIMUM
};

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use crate::inputs::Site;

    /// d = 16 mm with R = 6, I = 1.2: R d / I = 80 mm, beside u = 60 mm: root 100 mm, so
    /// 50 mm, 25 mm with aligned floors. 2007: R d = 96 mm and I u = 72 mm: 84 and 42 mm.
    #[test]
    fn by_hand() {
        let structure = |u| Structure {
            displacement: Some(u),
            importance: Some(1.2),
            response_modification: Some(6.0),
            ..Structure::default()
        };
        for (aligned, new, old) in [(false, 0.05, 0.084), (true, 0.025, 0.042)] {
            let mut situation = Situation {
                left: structure(0.3),
                right: structure(0.06),
                site: Site {
                    floors_aligned: Some(aligned),
                    ..Site::default()
                },
            };
            situation.left.elastic_displacement = Some(0.016);
            assert!((TBDY_2018.between(&situation).unwrap().width - new).abs() < 1.0e-12);
            // 1.5 (80 + 60) mm, whatever the floors.
            assert!((TBDY_2018_SEAT.between(&situation).unwrap().width - 0.21).abs() < 1.0e-12);
            assert!((TDY_2007.between(&situation).unwrap().width - old).abs() < 1.0e-12);
        }
    }

    /// 6 m: 30 mm; 9 m: 40 mm; 9.1 m: 50 mm.
    #[test]
    fn minimum_by_hand() {
        for (elevation, width) in [
            (3.0, 0.03),
            (6.0, 0.03),
            (9.0, 0.04),
            (9.1, 0.05),
            (12.0, 0.05),
        ] {
            let structure = Structure {
                elevation,
                ..Structure::default()
            };
            let situation = Situation {
                left: structure.clone(),
                right: structure,
                ..Situation::default()
            };
            for descriptor in [&TBDY_2018_MINIMUM, &TDY_2007_MINIMUM] {
                let found = descriptor.between(&situation).unwrap().width;
                assert!((found - width).abs() < 1.0e-12);
            }
        }
    }
}
