//! E.030 of Peru.

use crate::descriptor::{Basis, ProvisionDescriptor, Rule, Verification};
use crate::error::SeparationError;
use crate::inputs::{Input, Site, Situation, Structure};
use crate::working::Working;

const PART: f64 = 2.0 / 3.0;

fn least(working: &mut Working, elevation: f64) -> f64 {
    (0.006 * working.elevation(elevation)).max(0.03)
}

fn boundary(
    working: &mut Working,
    structure: &Structure,
    elevation: f64,
    _: &Site,
) -> Result<f64, SeparationError> {
    let displacement = working.displacement(structure)?;
    let half = 0.5 * least(working, elevation);
    Ok((PART * displacement).max(working.note("s / 2", half, "m")))
}

fn between(working: &mut Working, situation: &Situation) -> Result<f64, SeparationError> {
    let sum = working.displacement(&situation.left)? + working.displacement(&situation.right)?;
    Ok(PART * sum)
}

fn minimum(working: &mut Working, situation: &Situation) -> Result<f64, SeparationError> {
    Ok(least(working, situation.elevation))
}

pub(crate) static BOUNDARY: ProvisionDescriptor = ProvisionDescriptor {
    name: "e_030_boundary",
    region: "Peru",
    edition: "E.030",
    clause: "33",
    basis: Basis::Displacement,
    elastic_displacement_factor: Some("0.75 R or 0.85 R"),
    formula: "max(2/3 u, s / 2), s = max(0.006 h, 30 mm)",
    inputs: &[Input::Displacement],
    status: Verification::Unverified("formula and clause"),
    remarks: &[
        "u is the unreduced displacement; the code takes 0.75 R or 0.85 R of the reduced one.",
    ],
    rule: Rule::Boundary(boundary),
};

pub(crate) static BETWEEN: ProvisionDescriptor = ProvisionDescriptor {
    name: "e_030_between",
    formula: "2/3 (u1 + u2)",
    rule: Rule::Between(between),
    ..BOUNDARY
};

pub(crate) static MINIMUM: ProvisionDescriptor = ProvisionDescriptor {
    name: "e_030_minimum",
    basis: Basis::Prescriptive,
    elastic_displacement_factor: None,
    formula: "max(0.006 h, 30 mm)",
    inputs: &[],
    remarks: &["Holds beside the rule of displacements."],
    rule: Rule::Between(minimum),
    ..BOUNDARY
};

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    /// 90 and 60 mm: 100 mm between, 60 mm on the own side; at 9 m s = 54 mm, at 4 m 30 mm;
    /// 30 mm of own displacement at 9 m: s / 2 = 27 mm.
    #[test]
    fn by_hand() {
        let structure = |u| Structure {
            displacement: Some(u),
            ..Structure::default()
        };
        let situation = |elevation| Situation {
            left: structure(0.09),
            right: structure(0.06),
            elevation,
            ..Situation::default()
        };
        let s = situation(9.0);
        assert!((BETWEEN.between(&s).unwrap().width - 0.1).abs() < 1.0e-12);
        assert!((MINIMUM.between(&s).unwrap().width - 0.054).abs() < 1.0e-12);
        assert!((MINIMUM.between(&situation(4.0)).unwrap().width - 0.03).abs() < 1.0e-12);
        let own = |u, h| BOUNDARY.boundary(&structure(u), h, &s.site).unwrap().width;
        assert!((own(0.09, 9.0) - 0.06).abs() < 1.0e-12);
        assert!((own(0.03, 9.0) - 0.027).abs() < 1.0e-12);
    }
}
