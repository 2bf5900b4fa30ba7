//! One code a file.

use crate::descriptor::{ProvisionDescriptor, Unavailable};

/// Declares the files of the codes and lists their cards.
macro_rules! provisions {
    ($($file:ident: $($card:ident)*;)*) => {
        $(mod $file;)*
        /// Cards of all provisions, in the order in which users see them.
        pub(crate) static ALL: &[&ProvisionDescriptor] = &[$($(&$file::$card),*),*];
    };
}

provisions! {
    asce_7: ASCE_7_10_BOUNDARY ASCE_7_10_BETWEEN ASCE_7_16_BOUNDARY ASCE_7_16_BETWEEN
        ASCE_7_22_BOUNDARY ASCE_7_22_BETWEEN IBC_2009_BOUNDARY IBC_2009_BETWEEN
        KDS_BOUNDARY KDS_BETWEEN SNI_1726_BOUNDARY SNI_1726_BETWEEN;
    ubc_1997: UBC_BOUNDARY UBC_BETWEEN NSCP_BOUNDARY NSCP_BETWEEN;
    asce_41: BOUNDARY BETWEEN;
    nbcc: BETWEEN;
    eurocode_8: FIRST_BOUNDARY FIRST_BETWEEN SECOND_BOUNDARY SECOND_BETWEEN;
    ntc_2018: SUM MINIMUM;
    eak_2000: DISPLACEMENT JOINT;
    nzs_1170_5: BOUNDARY BETWEEN;
    as_1170_4: BOUNDARY;
    is_1893: EDITION_2016 EDITION_2002;
    is_4326: BETWEEN;
    iran_2800: BOUNDARY_BY_HEIGHT BOUNDARY_BY_ANALYSIS BETWEEN TEHRAN;
    taiwan_2011: BOUNDARY BETWEEN;
    gb_50011: BETWEEN;
    japan: PRACTICE;
    turkey: TBDY_2018 TBDY_2018_MINIMUM TDY_2007 TDY_2007_MINIMUM;
    mexico_city_2004: BOUNDARY BOUNDARY_SIMPLIFIED BETWEEN BETWEEN_SIMPLIFIED;
    nch_433: BOUNDARY BOUNDARY_MINIMUM BETWEEN;
    e_030: BOUNDARY BETWEEN MINIMUM;
}

const NOT_RESEARCHED: &str = "displacement sum or square root; national clause not researched";

/// Codes without a formula here.
pub(crate) static UNAVAILABLE: &[Unavailable] = &[
    Unavailable {
        region: "Switzerland",
        edition: "SIA 261",
        reason: NOT_RESEARCHED,
    },
    Unavailable {
        region: "Portugal",
        edition: "national rules",
        reason: NOT_RESEARCHED,
    },
    Unavailable {
        region: "Spain",
        edition: "NCSE",
        reason: NOT_RESEARCHED,
    },
    Unavailable {
        region: "Mexico City",
        edition: "NTC-Sismo 2017 and 2023",
        reason: "the idea of 2004 with other numbers, which were not seen",
    },
    Unavailable {
        region: "Colombia",
        edition: "NSR-10, A.6.5",
        reason: "fractions of the drift limit by storeys and alignment of levels, which were not seen",
    },
];

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use proptest::prelude::*;

    use super::ALL;
    use crate::descriptor::{Basis, Place, Status};
    use crate::error::SeparationError;
    use crate::inputs::{Input, Site, Situation, SoilZone, StructuralSystem, Structure};

    fn structure(name: &str, u: f64) -> Structure {
        Structure {
            name: name.to_owned(),
            height: 16.0,
            storeys: 5,
            displacement: Some(u),
            elastic_displacement: None,
            response_modification: Some(5.0),
            displacement_amplification: Some(4.5),
            importance: Some(1.0),
            yield_amplification: Some(1.0),
            system: Some(StructuralSystem::Frame),
        }
    }

    /// A situation in which every provision applies.
    fn complete(left: f64, right: f64) -> Situation {
        Situation {
            left: structure("left", left),
            right: structure("right", right),
            elevation: 16.0,
            site: Site {
                floors_aligned: Some(false),
                same_owner: Some(true),
                fortification_intensity: Some(8),
                soil_zone: Some(SoilZone::Two),
                design_ground_acceleration: Some(2.5),
                seismic_coefficient: Some(0.12),
            },
        }
    }

    fn without(input: Input) -> Situation {
        let mut s = complete(0.1, 0.05);
        for b in [&mut s.left, &mut s.right] {
            match input {
                Input::Displacement => b.displacement = None,
                Input::ResponseModification => b.response_modification = None,
                Input::DisplacementAmplification => b.displacement_amplification = None,
                Input::Importance => b.importance = None,
                Input::YieldAmplification => b.yield_amplification = None,
                Input::StructuralSystem => b.system = None,
                _ => {}
            }
        }
        match input {
            Input::FloorsAligned => s.site.floors_aligned = None,
            Input::SameOwner => s.site.same_owner = None,
            Input::FortificationIntensity => s.site.fortification_intensity = None,
            Input::SoilZone => s.site.soil_zone = None,
            Input::DesignGroundAcceleration => s.site.design_ground_acceleration = None,
            Input::SeismicCoefficient => s.site.seismic_coefficient = None,
            _ => {}
        }
        s
    }

    #[test]
    fn cards_are_complete() {
        for card in ALL {
            let same = ALL.iter().filter(|c| c.name == card.name).count();
            assert_eq!(same, 1, "{}", card.name);
            for text in [card.region, card.edition, card.formula] {
                assert!(!text.is_empty(), "{}", card.name);
            }
            assert!(!card.status.remark().is_empty(), "{}", card.name);
            let needs = card.inputs.contains(&Input::Displacement);
            assert_eq!(needs, card.basis == Basis::Displacement, "{}", card.name);
            let ends = match card.place() {
                Place::Boundary => card.name.contains("_boundary"),
                Place::Between => !card.name.contains("_boundary"),
            };
            assert!(ends, "{}", card.name);
        }
    }

    /// Without a listed input a provision names it; without any other it still answers.
    #[test]
    fn inputs_are_those_listed() {
        for card in ALL {
            for input in Input::ALL {
                let result = card.between(&without(input));
                if card.inputs.contains(&input) {
                    let Err(SeparationError::MissingInput { input: named, .. }) = result else {
                        panic!("{} without {input:?}: {result:?}", card.name);
                    };
                    assert_eq!(named, input, "{}", card.name);
                } else {
                    assert!(
                        result.is_ok(),
                        "{} without {input:?}: {result:?}",
                        card.name
                    );
                }
            }
        }
    }

    #[test]
    fn explanations_hold_every_factor() {
        for card in ALL {
            let requirement = card.between(&complete(0.1, 0.05)).unwrap();
            assert!(requirement.width > 0.0, "{}", card.name);
            assert!(!requirement.factors.is_empty(), "{}", card.name);
            for factor in &requirement.factors {
                let shown = format!("{} = ", factor.name);
                assert!(requirement.explanation.contains(&shown), "{}", card.name);
            }
            assert!(requirement.explanation.contains(card.formula));
        }
    }

    /// What was seen in a text is a short list: nothing slips into it unnoticed.
    #[test]
    fn verified_provisions() {
        let verified: Vec<_> = ALL
            .iter()
            .filter(|c| matches!(c.status, Status::Verified(_)))
            .map(|c| c.name)
            .collect();
        assert_eq!(
            verified,
            [
                "asce_7_10_boundary",
                "asce_7_10_between",
                "ibc_2009_boundary",
                "ibc_2009_between",
                "nbcc_2015_between",
                "iran_2800_boundary_by_height",
                "tehran_between",
                "gb_50011_2010_between",
                "mexico_city_2004_boundary",
                "mexico_city_2004_boundary_simplified",
                "mexico_city_2004_between",
                "mexico_city_2004_between_simplified",
            ]
        );
    }

    proptest! {
        /// A greater displacement never asks for a smaller gap.
        #[test]
        fn monotone_in_displacement(a in 0.0..0.5_f64, b in 0.0..0.5_f64, more in 0.0..0.5_f64) {
            for card in ALL {
                let width = |l, r| card.between(&complete(l, r)).map(|r| r.width);
                let (one, left, right) = (width(a, b), width(a + more, b), width(a, b + more));
                prop_assert!(left? >= one.clone()?, "{}", card.name);
                prop_assert!(right? >= one?, "{}", card.name);
            }
        }

        /// The side on which a building stands does not matter.
        #[test]
        fn symmetric(a in 0.0..0.5_f64, b in 0.0..0.5_f64) {
            for card in ALL {
                let one = card.between(&complete(a, b))?.width;
                let other = card.between(&complete(b, a))?.width;
                prop_assert!((one - other).abs() <= 1.0e-15 + 1.0e-15 * one, "{}", card.name);
            }
        }
    }
}
