//! Building codes of Turkey, 2018 and 2007.

use crate::descriptor::{Basis, ProvisionDescriptor, Rule, Verification};
use crate::error::SeparationError;
use crate::inputs::{Input, Situation, Structure};
use crate::working::{Working, root};

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
    let left = over_importance(working, &situation.left)?;
    let right = over_importance(working, &situation.right)?;
    Ok(share(working, situation)? * root(left, right))
}

fn tdy_2007(working: &mut Working, situation: &Situation) -> Result<f64, SeparationError> {
    let sum = working.restored(&situation.left)? + working.restored(&situation.right)?;
    Ok(share(working, situation)? * sum)
}

fn minimum(working: &mut Working, situation: &Situation) -> Result<f64, SeparationError> {
    let height = working.elevation(situation.elevation);
    // A height that is a whole number of steps but for round-off is one.
    let steps = ((height - 6.0).max(0.0) / 3.0 - 1.0e-9).ceil().max(0.0);
    Ok(0.03 + 0.01 * working.note("begun steps of 3 m above 6 m", steps, "-"))
}

pub(crate) static TBDY_2018: ProvisionDescriptor = ProvisionDescriptor {
    name: "tbdy_2018_between",
    region: "Turkey",
    edition: "TBDY 2018",
    clause: "4.9.3",
    basis: Basis::Displacement,
    elastic_displacement_factor: Some("0.25 R / I or 0.5 R / I"),
    formula: "alpha sqrt(d1^2 + d2^2), alpha = 0.25 R / I where floors are aligned, else 0.5 R / I (R d / I = u)",
    inputs: &[Input::Displacement, Input::FloorsAligned],
    status: Verification::Unverified("the clause"),
    remarks: &["Each building's own R / I goes with its displacement."],
    rule: Rule::Between(tbdy_2018),
};

pub(crate) static TBDY_2018_MINIMUM: ProvisionDescriptor = ProvisionDescriptor {
    name: "tbdy_2018_minimum",
    basis: Basis::Prescriptive,
    elastic_displacement_factor: None,
    formula: "30 mm up to 6 m, 10 mm more for each begun 3 m above",
    inputs: &[],
    status: Verification::Unverified("the clause, and that begun steps count whole"),
    remarks: &["Holds beside the rule of displacements."],
    rule: Rule::Between(minimum),
    ..TBDY_2018
};

pub(crate) static TDY_2007: ProvisionDescriptor = ProvisionDescriptor {
    name: "tdy_2007_between",
    edition: "TDY 2007",
    clause: "2.10.3",
    elastic_displacement_factor: Some("R / 4 or R / 2"),
    formula: "alpha (d1 + d2), alpha = R / 4 where floors are aligned, else R / 2 (R d = I u)",
    inputs: &[Input::Displacement, Input::Importance, Input::FloorsAligned],
    status: Verification::Unverified("the clause; the sum is the safe reading of it"),
    remarks: &["Each building's own R goes with its displacement."],
    rule: Rule::Between(tdy_2007),
    ..TBDY_2018
};

pub(crate) static TDY_2007_MINIMUM: ProvisionDescriptor = ProvisionDescriptor {
    name: "tdy_2007_minimum",
    edition: "TDY 2007",
    clause: "2.10.3",
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
                elevation: 9.0,
                site: Site {
                    floors_aligned: Some(aligned),
                    ..Site::default()
                },
            };
            situation.left.elastic_displacement = Some(0.016);
            assert!((TBDY_2018.between(&situation).unwrap().width - new).abs() < 1.0e-12);
            assert!((TDY_2007.between(&situation).unwrap().width - old).abs() < 1.0e-12);
        }
    }

    /// 6 m: 30 mm; 9 m: 40 mm; 9.1 m: 50 mm.
    #[test]
    fn minimum_by_hand() {
        for (elevation, width) in [(3.0, 0.03), (6.0, 0.03), (9.0, 0.04), (9.1, 0.05)] {
            let situation = Situation {
                elevation,
                ..Situation::default()
            };
            for descriptor in [&TBDY_2018_MINIMUM, &TDY_2007_MINIMUM] {
                let found = descriptor.between(&situation).unwrap().width;
                assert!((found - width).abs() < 1.0e-12);
            }
        }
    }
}
