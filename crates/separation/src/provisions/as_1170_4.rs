//! AS 1170.4 of Australia.

use crate::assumptions::{Ground, HeightDatum};
use crate::descriptor::{Basis, ProvisionDescriptor, Rule};
use crate::edition::Edition;
use crate::error::SeparationError;
use crate::inputs::Structure;
use crate::status::Status;
use crate::working::Working;

/// Height of the structure (m) above which the rule speaks.
const LOWEST: f64 = 15.0;

fn boundary(working: &mut Working, structure: &Structure) -> Result<Option<f64>, SeparationError> {
    if structure.height <= LOWEST {
        return Ok(None);
    }
    let height = working.note(format!("H({})", structure.name), structure.height, "m");
    Ok(Some(0.01 * height))
}

static EDITION: Edition = Edition {
    title: "AS 1170.4",
    region: "Australia",
    in_force: None,
    superseded_by: None,
};

pub(crate) static BOUNDARY: ProvisionDescriptor = ProvisionDescriptor {
    name: "as_1170_4_boundary",
    edition: &EDITION,
    clause: "",
    basis: Basis::Prescriptive,
    height: HeightDatum::NotSeen,
    ground: Ground::OwnSide,
    elastic_displacement_factor: None,
    formula: "H / 100 with the height H of the structure, or by analysis",
    inputs: &[],
    status: Status::Unverified("the rule and its limit of 15 m"),
    remarks: &[
        "For structures of more than 15 m; at each of their levels. Of a lower one beside them it asks nothing.",
        "The edition of 2007 (5.4.5, as recalled) is also satisfied where the primary elements that resist earthquakes are structural walls that extend to the base: that is not judged here, whatever the structural system.",
    ],
    worked: "21000 / 100",
    rule: Rule::BoundaryOfSome(boundary, "it speaks of structures of more than 15 m"),
};

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use crate::inputs::{Site, Situation};

    /// A structure of 20 m: 200 mm at each of its levels. One of 15 m: nothing.
    #[test]
    fn by_hand() {
        let own = |height, elevation| {
            let structure = Structure {
                height,
                elevation,
                ..Structure::default()
            };
            BOUNDARY.boundary(&structure, &Site::default())
        };
        for elevation in [5.0, 20.0] {
            assert!((own(20.0, elevation).unwrap().width - 0.2).abs() < 1.0e-12);
        }
        assert!(matches!(
            own(15.0, 15.0),
            Err(SeparationError::NotApplicable { .. })
        ));
    }

    /// 20 m beside 12 m: 200 mm for the higher one, on either side. 20 m beside 16 m: 360 mm. Of two
    /// low ones it says nothing, and the code has no other rule.
    #[test]
    fn beside_a_low_structure_the_high_one_counts() {
        let of = |left, right| {
            let structure = |height| Structure {
                height,
                ..Structure::default()
            };
            BOUNDARY.between(&Situation {
                left: structure(left),
                right: structure(right),
                ..Situation::default()
            })
        };
        for (left, right, width) in [(20.0, 12.0, 0.2), (12.0, 20.0, 0.2), (20.0, 16.0, 0.36)] {
            let found = of(left, right).unwrap().width;
            assert!((found - width).abs() < 1.0e-12, "{left} {right}: {found}");
        }
        let help = of(12.0, 15.0).unwrap_err().help().unwrap();
        for part in [
            "no other rule",
            "absolute_sum",
            "(SRSS)",
            "[[separation.rule]]",
        ] {
            assert!(help.contains(part), "{part}: {help}");
        }
    }
}
