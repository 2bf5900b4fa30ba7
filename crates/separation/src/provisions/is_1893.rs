//! IS 1893 (Part 1) of India, editions 2016 and 2002.

use crate::assumptions::{Ground, HeightDatum};
use crate::descriptor::{Basis, ProvisionDescriptor, Rule};
use crate::edition::{Edition, InForce};
use crate::error::SeparationError;
use crate::inputs::{Input, Situation};
use crate::status::Status;
use crate::working::Working;

/// `R1 d1 + R2 d2`, half of it where floors are aligned, and whether they are.
fn halved(working: &mut Working, situation: &Situation) -> Result<(f64, bool), SeparationError> {
    let sum = working.restored(&situation.left)? + working.restored(&situation.right)?;
    let aligned = working.floors_aligned(&situation.site)?;
    let factor = working.note("factor", if aligned { 0.5 } else { 1.0 }, "-");
    Ok((sum * factor, aligned))
}

fn of_2016(working: &mut Working, situation: &Situation) -> Result<f64, SeparationError> {
    Ok(halved(working, situation)?.0)
}

/// What the edition of 2002 adds where it halves `R` (m).
const ADDED: f64 = 0.025;

fn of_2002(working: &mut Working, situation: &Situation) -> Result<f64, SeparationError> {
    let (sum, aligned) = halved(working, situation)?;
    Ok(match aligned {
        true => sum + working.note("added", ADDED, "m"),
        false => sum,
    })
}

static IS_1893_2016: Edition = Edition {
    title: "IS 1893 (Part 1):2016",
    region: "India",
    in_force: InForce::recalled("2016", None),
    superseded_by: None,
};

static IS_1893_2002: Edition = Edition {
    title: "IS 1893 (Part 1):2002",
    region: "India",
    in_force: InForce::recalled("2002", Some("2016")),
    superseded_by: Some("IS 1893 (Part 1):2016"),
};

pub(crate) static EDITION_2016: ProvisionDescriptor = ProvisionDescriptor {
    name: "is_1893_2016_between",
    edition: &IS_1893_2016,
    clause: "7.11.3",
    basis: Basis::Displacement,
    height: HeightDatum::NotUsed,
    ground: Ground::NotAsked,
    elastic_displacement_factor: Some("R"),
    formula: "R1 d1 + R2 d2, half of it where floors are aligned (R d = I u)",
    inputs: &[Input::Displacement, Input::Importance, Input::FloorsAligned],
    status: Status::Unverified(
        "the half where floors are aligned; R times the drifts was seen in an excerpt of 7.11",
    ),
    remarks: &[],
    worked: "1 * (1.1 * 80 + 1.1 * 60)",
    rule: Rule::Between(of_2016),
};

pub(crate) static EDITION_2002: ProvisionDescriptor = ProvisionDescriptor {
    name: "is_1893_2002_between",
    edition: &IS_1893_2002,
    formula: "R1 d1 + R2 d2; where floors are aligned half of it and 25 mm (R d = I u)",
    status: Status::Unverified(
        "the formula, and R/2 with 25 mm added for units whose floors lie at the same elevations, as recalled",
    ),
    remarks: &["R is halved, and 25 mm are added, where floors are aligned."],
    rule: Rule::Between(of_2002),
    ..EDITION_2016
};

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use crate::inputs::{Site, Structure};

    /// d = 16 mm with R = 5 and u = 60 mm with I = 1: 80 + 60 = 140 mm; 70 mm with
    /// aligned floors, and 25 mm more by the edition of 2002.
    #[test]
    fn by_hand() {
        let structure = |u| Structure {
            displacement: Some(u),
            importance: Some(1.0),
            response_modification: Some(5.0),
            ..Structure::default()
        };
        for (aligned, widths) in [(false, [0.14, 0.14]), (true, [0.07, 0.095])] {
            let mut situation = Situation {
                left: structure(0.2),
                right: structure(0.06),
                site: Site {
                    floors_aligned: Some(aligned),
                    ..Site::default()
                },
            };
            situation.left.elastic_displacement = Some(0.016);
            for (descriptor, width) in [&EDITION_2016, &EDITION_2002].into_iter().zip(widths) {
                let found = descriptor.between(&situation).unwrap().width;
                assert!((found - width).abs() < 1.0e-12);
            }
        }
    }
}
