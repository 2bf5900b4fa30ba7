//! NCh433 of Chile.

use crate::descriptor::{Basis, ProvisionDescriptor, Rule, Verification};
use crate::error::SeparationError;
use crate::inputs::{Input, Site, Situation, Structure};
use crate::working::Working;

fn own(working: &mut Working, structure: &Structure) -> Result<f64, SeparationError> {
    Ok(working.restored(structure)? / working.note("divisor", 3.0, "-"))
}

fn boundary(
    working: &mut Working,
    structure: &Structure,
    _: f64,
    _: &Site,
) -> Result<f64, SeparationError> {
    own(working, structure)
}

fn minimum(
    working: &mut Working,
    _: &Structure,
    elevation: f64,
    _: &Site,
) -> Result<f64, SeparationError> {
    Ok((0.002 * working.elevation(elevation)).max(0.015))
}

fn between(working: &mut Working, situation: &Situation) -> Result<f64, SeparationError> {
    Ok(own(working, &situation.left)? + own(working, &situation.right)?)
}

pub(crate) static BOUNDARY: ProvisionDescriptor = ProvisionDescriptor {
    name: "nch_433_boundary",
    region: "Chile",
    edition: "NCh433",
    clause: "5.9",
    basis: Basis::Displacement,
    elastic_displacement_factor: Some("R* / 3"),
    formula: "(R* / 3) d (R* d = I u)",
    inputs: &[Input::Displacement, Input::Importance],
    status: Verification::Unverified("formula and clause; R* stands under response_modification"),
    remarks: &[],
    rule: Rule::Boundary(boundary),
};

pub(crate) static BOUNDARY_MINIMUM: ProvisionDescriptor = ProvisionDescriptor {
    name: "nch_433_boundary_minimum",
    basis: Basis::Prescriptive,
    elastic_displacement_factor: None,
    formula: "max(0.002 h, 15 mm)",
    inputs: &[],
    status: Verification::Unverified("formula and clause"),
    remarks: &["Holds beside the rule of displacements."],
    rule: Rule::Boundary(minimum),
    ..BOUNDARY
};

pub(crate) static BETWEEN: ProvisionDescriptor = ProvisionDescriptor {
    name: "nch_433_between",
    formula: "sum over both buildings of (R* / 3) d (R* d = I u)",
    rule: Rule::Between(between),
    ..BOUNDARY
};

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    /// R* = 6, d = 15 mm: 30 mm; I = 1, u = 60 mm: 20 mm; together 50 mm. Least 15 mm up
    /// to 7.5 m, 18 mm at 9 m.
    #[test]
    fn by_hand() {
        let structure = |u| Structure {
            displacement: Some(u),
            importance: Some(1.0),
            response_modification: Some(6.0),
            ..Structure::default()
        };
        let mut situation = Situation {
            left: structure(0.3),
            right: structure(0.06),
            ..Situation::default()
        };
        situation.left.elastic_displacement = Some(0.015);
        let own = BOUNDARY.boundary(&situation.left, 9.0, &situation.site);
        assert!((own.unwrap().width - 0.03).abs() < 1.0e-12);
        assert!((BETWEEN.between(&situation).unwrap().width - 0.05).abs() < 1.0e-12);
        let least = |h| BOUNDARY_MINIMUM.boundary(&situation.left, h, &situation.site);
        assert!((least(6.0).unwrap().width - 0.015).abs() < 1.0e-12);
        assert!((least(9.0).unwrap().width - 0.018).abs() < 1.0e-12);
    }
}
