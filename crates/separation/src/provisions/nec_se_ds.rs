//! NEC-SE-DS of Ecuador.

use crate::assumptions::{Ground, HeightDatum};
use crate::descriptor::{Basis, ProvisionDescriptor, Rule};
use crate::edition::{Edition, InForce};
use crate::error::SeparationError;
use crate::inputs::{Input, Situation};
use crate::status::Status;
use crate::working::Working;

fn within(working: &mut Working, situation: &Situation) -> Result<f64, SeparationError> {
    let left = working.unreduced(&situation.left)?;
    let right = working.unreduced(&situation.right)?;
    let aligned = working.floors_aligned(&situation.site)?;
    let taken = if aligned {
        left.max(right)
    } else {
        left + right
    };
    Ok(working.note("factor", 0.5, "-") * taken)
}

static EDITION: Edition = Edition {
    title: "NEC-SE-DS",
    region: "Ecuador",
    in_force: InForce::recalled("2015", None),
    superseded_by: None,
};

pub(crate) static WITHIN: ProvisionDescriptor = ProvisionDescriptor {
    name: "nec_se_ds_between",
    edition: &EDITION,
    clause: "5.2.1",
    basis: Basis::Displacement,
    height: HeightDatum::NotUsed,
    ground: Ground::OneStructure,
    elastic_displacement_factor: Some("0.75 R"),
    formula: "half of max(|DeltaM1|, |DeltaM2|) where floors are aligned, else half of |DeltaM1| + |DeltaM2| (DeltaM = I u)",
    inputs: &[Input::Displacement, Input::FloorsAligned],
    status: Status::SeenInText("an excerpt of 5.2.1"),
    remarks: &[
        "Between parts of one structure; what holds across a property line was not seen.",
        "That DeltaM is 0.75 R times the elastic displacement is recalled; I u is R times that, on the safe side; I is 1 where `importance` is not given.",
    ],
    worked: "(1.1 * 80 + 1.1 * 60) / 2",
    rule: Rule::Between(within),
};

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use crate::inputs::{Site, Structure};

    /// 80 and 60 mm: their mean, 70 mm; with aligned floors half the larger, 40 mm.
    #[test]
    fn by_hand() {
        for (aligned, width) in [(false, 0.07), (true, 0.04)] {
            let structure = |u| Structure {
                displacement: Some(u),
                ..Structure::default()
            };
            let situation = Situation {
                left: structure(0.08),
                right: structure(0.06),
                site: Site {
                    floors_aligned: Some(aligned),
                    ..Site::default()
                },
            };
            let found = WITHIN.between(&situation).unwrap().width;
            assert!((found - width).abs() < 1.0e-12, "{found}");
        }
    }
}
