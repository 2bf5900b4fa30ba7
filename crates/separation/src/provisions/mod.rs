//! One code per file.

use crate::descriptor::{ProvisionDescriptor, Unavailable};

pub(crate) mod as_1170_4;
pub(crate) mod asce_41;
pub(crate) mod asce_7;
pub(crate) mod asce_7_isolation;
pub(crate) mod e_030;
pub(crate) mod eak_2000;
pub(crate) mod eurocode_8;
pub(crate) mod gb_50011;
pub(crate) mod iran_2800;
pub(crate) mod is_1893;
pub(crate) mod is_4326;
pub(crate) mod japan;
pub(crate) mod mexico_city;
pub(crate) mod nbcc;
pub(crate) mod nch_433;
pub(crate) mod nec_se_ds;
pub(crate) mod nsr_10;
pub(crate) mod ntc_2018;
pub(crate) mod nzs_1170_5;
pub(crate) mod rpa_2024;
pub(crate) mod taiwan_2011;
pub(crate) mod turkey;
pub(crate) mod ubc_1997;
pub(crate) mod ufc_3_310_03a;

/// Descriptors of all provisions, in the order in which users see them.
pub(crate) static ALL: &[&ProvisionDescriptor] = &[
    &asce_7::ASCE_7_10_BOUNDARY,
    &asce_7::ASCE_7_10_BETWEEN,
    &asce_7::ASCE_7_16_BOUNDARY,
    &asce_7::ASCE_7_16_BETWEEN,
    &asce_7::ASCE_7_22_BOUNDARY,
    &asce_7::ASCE_7_22_BETWEEN,
    &asce_7_isolation::ASCE_7_10,
    &asce_7_isolation::ASCE_7_16,
    &asce_7_isolation::ASCE_7_22,
    &asce_7::IBC_2009_BOUNDARY,
    &asce_7::IBC_2009_BETWEEN,
    &asce_7::KDS_BOUNDARY,
    &asce_7::KDS_BETWEEN,
    &asce_7::SNI_1726_BOUNDARY,
    &asce_7::SNI_1726_BETWEEN,
    &ubc_1997::UBC_BOUNDARY,
    &ubc_1997::UBC_BETWEEN,
    &ubc_1997::NSCP_BOUNDARY,
    &ubc_1997::NSCP_BETWEEN,
    &asce_41::BOUNDARY,
    &asce_41::BETWEEN,
    &nbcc::BETWEEN,
    &eurocode_8::FIRST_BOUNDARY,
    &eurocode_8::FIRST_BETWEEN,
    &eurocode_8::SECOND_BOUNDARY,
    &eurocode_8::SECOND_BETWEEN,
    &ntc_2018::SUM,
    &ntc_2018::MINIMUM,
    &ntc_2018::WITHOUT_CALCULATION,
    &eak_2000::DISPLACEMENT,
    &eak_2000::JOINT,
    &nzs_1170_5::BOUNDARY,
    &nzs_1170_5::BETWEEN,
    &as_1170_4::BOUNDARY,
    &is_1893::EDITION_2016,
    &is_1893::EDITION_2002,
    &is_4326::BETWEEN,
    &iran_2800::BOUNDARY_BY_HEIGHT,
    &iran_2800::BOUNDARY_BY_ANALYSIS,
    &iran_2800::BETWEEN_BY_HEIGHT,
    &iran_2800::BETWEEN,
    &iran_2800::TEHRAN,
    &taiwan_2011::BOUNDARY,
    &taiwan_2011::BETWEEN,
    &gb_50011::BETWEEN,
    &japan::PRACTICE,
    &turkey::TBDY_2018,
    &turkey::TBDY_2018_MINIMUM,
    &turkey::TBDY_2018_SEAT,
    &turkey::TDY_2007,
    &turkey::TDY_2007_MINIMUM,
    &mexico_city::BOUNDARY,
    &mexico_city::BOUNDARY_SIMPLIFIED,
    &mexico_city::BETWEEN,
    &mexico_city::BETWEEN_SIMPLIFIED,
    &mexico_city::BOUNDARY_2020,
    &nch_433::BOUNDARY,
    &nch_433::BOUNDARY_MINIMUM,
    &nch_433::BETWEEN,
    &e_030::BOUNDARY_2018,
    &e_030::BETWEEN_2018,
    &e_030::MINIMUM_2018,
    &e_030::WITHOUT_JOINT_2018,
    &e_030::BOUNDARY_2026,
    &e_030::BETWEEN_2026,
    &e_030::MINIMUM_2026,
    &e_030::WITHOUT_JOINT_2026,
    &nsr_10::WITHIN,
    &nsr_10::BOUNDARY,
    &nsr_10::BESIDE_EXISTING,
    &nec_se_ds::WITHIN,
    &rpa_2024::BETWEEN,
    &ufc_3_310_03a::FLEXIBLE,
];

const NOT_RESEARCHED: &str = "displacement sum or SRSS; national clause not researched";

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
        region: "France",
        edition: "rules of the older zoning",
        reason: "40 mm in zone Ib, 60 mm in zones II and III: for a zoning that is no more in use",
    },
    Unavailable {
        region: "United States, armed forces",
        edition: "UFC 3-310-03A, structures that are not flexible",
        reason: "half an inch for each 10 ft of additional height was seen, not the width that it is added to",
    },
];

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use proptest::prelude::*;

    use super::ALL;
    use crate::assumptions::HeightDatum;
    use crate::descriptor::{Basis, Place};
    use crate::error::SeparationError;
    use crate::inputs::{Input, Site, Situation, SoilZone, StructuralSystem, Structure};
    use crate::status::Status;
    use crate::worked_example::worked_example;

    /// A situation in which every provision applies.
    fn complete(left: f64, right: f64) -> Situation {
        let mut situation = worked_example();
        situation.left.displacement = Some(left);
        situation.right.displacement = Some(right);
        situation
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
                Input::IsolationPeriod => b.isolation_period = None,
                Input::IsolationDampingCoefficient => b.isolation_damping_coefficient = None,
                Input::PlanLength => b.plan_length = None,
                Input::PlanWidth => b.plan_width = None,
                Input::PlanEccentricity => b.plan_eccentricity = None,
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
            Input::SpectralAccelerationAtOneSecond => s.site.spectral_acceleration_1s = None,
            Input::NeighbourHasGap => s.site.neighbour_has_gap = None,
            _ => {}
        }
        s
    }

    #[test]
    fn descriptors_are_complete() {
        for descriptor in ALL {
            let same = ALL.iter().filter(|c| c.name == descriptor.name).count();
            assert_eq!(same, 1, "{}", descriptor.name);
            let edition = descriptor.edition;
            for text in [
                edition.region,
                edition.title,
                descriptor.formula,
                descriptor.worked,
            ] {
                assert!(!text.is_empty(), "{}", descriptor.name);
            }
            assert!(
                !descriptor.status.remark().is_empty(),
                "{}",
                descriptor.name
            );
            let needs = descriptor.inputs.contains(&Input::Displacement);
            assert_eq!(
                needs,
                descriptor.basis == Basis::Displacement,
                "{}",
                descriptor.name
            );
            let ends = match descriptor.place() {
                Place::Boundary => descriptor.name.contains("_boundary"),
                Place::Between | Place::Seat => !descriptor.name.contains("_boundary"),
            };
            assert!(ends, "{}", descriptor.name);
        }
    }

    /// Without a listed input a provision names it; without any other it still answers.
    #[test]
    fn inputs_are_those_listed() {
        for descriptor in ALL {
            for input in Input::ALL {
                let result = descriptor.between(&without(input));
                if descriptor.inputs.contains(&input) {
                    let Err(SeparationError::MissingInput { input: named, .. }) = result else {
                        panic!("{} without {input:?}: {result:?}", descriptor.name);
                    };
                    assert_eq!(named, input, "{}", descriptor.name);
                } else {
                    assert!(
                        result.is_ok(),
                        "{} without {input:?}: {result:?}",
                        descriptor.name
                    );
                }
            }
        }
    }

    /// Ground that moves differently widens every gap by its displacement, once, also where a
    /// rule is summed over both sides; an impossible one is refused.
    #[test]
    fn ground_is_added_once() {
        for descriptor in ALL {
            let still = complete(0.1, 0.05);
            let mut moving = complete(0.1, 0.05);
            moving.site.relative_ground_displacement = 0.0375;
            let [without, with] = [&still, &moving].map(|s| descriptor.between(s).unwrap());
            let added = with.width - without.width;
            assert!((added - 0.0375).abs() < 1.0e-15, "{}", descriptor.name);
            let explained = with.explanation.contains("u_g = 0.037500 m");
            assert!(explained, "{}", with.explanation);
            assert!(!without.explanation.contains("u_g"), "{}", descriptor.name);
            if descriptor.place() == Place::Boundary {
                let own = |s: &Situation| descriptor.boundary(&s.left, &s.site).unwrap();
                let added = own(&moving).width - own(&still).width;
                assert!((added - 0.0375).abs() < 1.0e-15, "{}", descriptor.name);
            }
            for bad in [-0.1, f64::NAN] {
                moving.site.relative_ground_displacement = bad;
                let refused = descriptor.between(&moving);
                let named = matches!(refused, Err(SeparationError::OutOfRange { .. }));
                assert!(named, "{}: {refused:?}", descriptor.name);
            }
        }
    }

    #[test]
    fn explanations_hold_every_factor() {
        for descriptor in ALL {
            let requirement = descriptor.between(&complete(0.1, 0.05)).unwrap();
            assert!(requirement.width > 0.0, "{}", descriptor.name);
            assert!(!requirement.factors.is_empty(), "{}", descriptor.name);
            for factor in &requirement.factors {
                let shown = format!("{} = ", factor.name);
                assert!(
                    requirement.explanation.contains(&shown),
                    "{}",
                    descriptor.name
                );
            }
            assert!(requirement.explanation.contains(descriptor.formula));
        }
    }

    /// Which codes multiply the displacement of an elastic analysis, by what, and where
    /// that stands. All others take displacements as they are, or none: see below.
    const MULTIPLIED: [(&str, &str, &str); 38] = [
        (
            "asce_7_10_boundary",
            "Cd / Ie",
            "12.8-15 and 12.12-1 of 7-10",
        ),
        (
            "asce_7_10_between",
            "Cd / Ie",
            "12.8-15 and 12.12-2 of 7-10",
        ),
        ("asce_7_16_boundary", "Cd / Ie", "as 7-10"),
        ("asce_7_16_between", "Cd / Ie", "as 7-10"),
        ("asce_7_22_boundary", "Cd / Ie", "as 7-10"),
        ("asce_7_22_between", "Cd / Ie", "as 7-10"),
        ("ibc_2009_boundary", "Cd / Ie", "after ASCE 7"),
        (
            "ibc_2009_between",
            "Cd / Ie",
            "after ASCE 7, equation 16-64",
        ),
        ("kds_boundary", "Cd / Ie", "after ASCE 7"),
        ("kds_between", "Cd / Ie", "after ASCE 7"),
        ("sni_1726_2019_boundary", "Cd / Ie", "after ASCE 7"),
        ("sni_1726_2019_between", "Cd / Ie", "after ASCE 7"),
        ("ubc_1997_boundary", "0.7 R", "1630.9.2: 0.7 R deltaS"),
        ("ubc_1997_between", "0.7 R", "1630.9.2: 0.7 R deltaS"),
        ("nscp_2015_boundary", "0.7 R", "208-21: 0.7 R deltaS"),
        ("nscp_2015_between", "0.7 R", "208-21: 0.7 R deltaS"),
        ("nbcc_2015_between", "Rd Ro / IE", "4.1.8.13"),
        ("en_1998_1_2004_boundary", "qd", "4.3.4: ds = qd de"),
        ("en_1998_1_2004_between", "qd", "4.3.4: ds = qd de"),
        ("pr_en_1998_1_2_boundary", "qd", "as the edition of 2004"),
        ("pr_en_1998_1_2_between", "qd", "as the edition of 2004"),
        ("is_1893_2016_between", "R", "7.11.3: R1 d1 + R2 d2"),
        ("is_1893_2002_between", "R", "7.11.3: R times the sum"),
        ("taiwan_2011_boundary", "0.6 * 1.4 alpha_y Ra", "2.16"),
        ("taiwan_2011_between", "0.6 * 1.4 alpha_y Ra", "2.16"),
        (
            "tbdy_2018_between",
            "0.25 R / I or 0.5 R / I",
            "4.9.3.1: alpha",
        ),
        ("tdy_2007_between", "R / 4 or R / 2", "2.10.3: alpha"),
        ("nch_433_boundary", "R* / 3", "5.10: (R* / 3) d"),
        ("nch_433_between", "R* / 3", "5.10: (R* / 3) d"),
        ("e_030_2018_boundary", "0.75 R or 0.85 R", "Art. 31"),
        ("e_030_2018_between", "0.75 R or 0.85 R", "Art. 31"),
        ("e_030_2026_boundary", "0.75 R or 0.85 R", "as 2018"),
        ("e_030_2026_between", "0.75 R or 0.85 R", "as 2018"),
        (
            "tbdy_2018_bridge_seat",
            "1.5 R / I",
            "4.9.3.4: reduced displacements",
        ),
        ("nec_se_ds_between", "0.75 R", "recalled"),
        ("ntc_2018_between", "mu_d", "7.3.3.3: dE = mu_d dEe"),
        ("nzs_1170_5_boundary", "mu", "7.2.1.1"),
        ("nzs_1170_5_between", "mu", "7.2.1.1"),
    ];

    /// Rules of displacements that multiply none, and what they ask for instead.
    const AS_ANALYSED: [(&str, &str); 11] = [
        (
            "asce_41_boundary",
            "displacement of the analysis, of any kind",
        ),
        (
            "asce_41_between",
            "displacement of the analysis, of any kind",
        ),
        ("eak_2000_between", "displacement of the design earthquake"),
        ("iran_2800_boundary_by_analysis", "nonlinear displacement"),
        (
            "iran_2800_between",
            "nonlinear displacement above 8 storeys",
        ),
        ("mexico_city_2004_boundary", "calculated displacement, 1.10"),
        ("mexico_city_2004_between", "calculated displacement, 1.10"),
        (
            "mexico_city_2020_boundary",
            "displacement of the limit state, 1.9",
        ),
        ("nsr_10_between", "displacements of both parts"),
        ("rpa_2024_between", "not seen whether reduced"),
        ("ufc_3_310_03a_between", "displacements of both structures"),
    ];

    #[test]
    fn every_provision_says_whether_it_multiplies_elastic_displacements() {
        assert_eq!(ALL.len(), 73);
        for descriptor in ALL {
            let multiplied = MULTIPLIED.iter().find(|m| m.0 == descriptor.name);
            let factor = multiplied.map(|m| m.1);
            assert_eq!(
                descriptor.elastic_displacement_factor, factor,
                "{}",
                descriptor.name
            );
            let as_analysed = AS_ANALYSED.iter().any(|a| a.0 == descriptor.name);
            let prescriptive = descriptor.basis == Basis::Prescriptive;
            let classes = [multiplied.is_some(), as_analysed, prescriptive];
            let stands_in = classes.iter().filter(|c| **c).count();
            assert_eq!(stands_in, 1, "{}: {classes:?}", descriptor.name);
        }
    }

    /// A rule that multiplies elastic displacements does not hold for a structure that
    /// yields; its width is the same and carries the caution. One building that yields is
    /// enough; a displacement of an elastic analysis beside it is none.
    #[test]
    fn inelastic_displacements_are_not_multiplied_without_a_word() {
        for descriptor in ALL {
            let elastic = descriptor.between(&complete(0.1, 0.05)).unwrap();
            assert_eq!(elastic.caution, None, "{}", descriptor.name);
            let mut yields = complete(0.1, 0.05);
            yields.right.inelastic = true;
            let marked = descriptor.between(&yields).unwrap();
            assert_eq!(marked.width, elastic.width, "{}", descriptor.name);
            let caution = marked.caution.as_deref();
            let Some(factor) = descriptor.elastic_displacement_factor else {
                assert_eq!(caution, None, "{}", descriptor.name);
                continue;
            };
            let caution = caution.unwrap();
            for part in [factor, "that of right is inelastic"] {
                assert!(caution.contains(part), "{}: {caution}", descriptor.name);
            }
            assert!(marked.explanation.ends_with(caution), "{}", descriptor.name);
            if descriptor.place() == Place::Boundary {
                let s = &yields;
                let own = |b| descriptor.boundary(b, &s.site).unwrap().caution;
                assert!(own(&s.left).is_none() && own(&s.right).is_some());
            }
            yields.right.elastic_displacement = Some(0.01);
            assert_eq!(descriptor.between(&yields).unwrap().caution, None);
        }
    }

    /// What was seen in a text is a short list: nothing slips into it unnoticed. Nothing was seen
    /// in a standard itself.
    #[test]
    fn provisions_seen() {
        let of = |wanted: fn(&Status) -> bool| -> Vec<_> {
            let found = ALL.iter().filter(|c| wanted(&c.status));
            found.map(|c| c.name).collect()
        };
        assert!(of(|s| matches!(s, Status::SeenInStandard(_) | Status::Yours)).is_empty());
        assert_eq!(
            of(|s| matches!(s, Status::Disputed { .. })),
            ["nch_433_boundary", "nch_433_between"]
        );
        assert_eq!(
            of(|s| matches!(s, Status::SeenInText(_))),
            [
                "asce_7_10_boundary",
                "asce_7_10_between",
                "ibc_2009_boundary",
                "ibc_2009_between",
                "nbcc_2015_between",
                "ntc_2018_minimum",
                "ntc_2018_without_calculation",
                "iran_2800_boundary_by_height",
                "iran_2800_between_by_height",
                "tehran_between",
                "gb_50011_2010_between",
                "japan_practice",
                "tbdy_2018_between",
                "tbdy_2018_minimum",
                "tbdy_2018_bridge_seat",
                "mexico_city_2004_boundary",
                "mexico_city_2004_boundary_simplified",
                "mexico_city_2004_between",
                "mexico_city_2004_between_simplified",
                "mexico_city_2020_boundary",
                "e_030_2018_boundary",
                "e_030_2018_between",
                "e_030_2018_minimum",
                "e_030_2018_beside_existing",
                "e_030_2026_boundary",
                "e_030_2026_between",
                "e_030_2026_minimum",
                "e_030_2026_beside_existing",
                "nsr_10_between",
                "nsr_10_boundary",
                "nsr_10_beside_existing",
                "nec_se_ds_between",
                "rpa_2024_between",
                "ufc_3_310_03a_between",
            ]
        );
    }

    prop_compose! {
        fn any_structure(name: &'static str)(
            storeys in 1_usize..12,
            (height, share) in (3.0..40.0_f64, 0.1..1.0_f64),
            displacement in 0.0..0.5_f64,
            (reduction, amplification) in (1.0..8.0_f64, 1.0..6.0_f64),
            (importance, yields) in (0.8..1.5_f64, 1.0..1.5_f64),
            system in 0_usize..StructuralSystem::ALL.len(),
            (period, damping) in (1.5..4.0_f64, 0.8..2.0_f64),
            (width, longer, eccentricity) in (10.0..30.0_f64, 0.0..30.0_f64, 0.0..4.0_f64),
            (base_moves, reduced) in (any::<bool>(), prop::option::of(0.0..0.1_f64)),
        ) -> Structure {
            Structure {
                name: name.to_owned(),
                height,
                elevation: share * height,
                storeys,
                displacement: Some(displacement),
                inelastic: false,
                elastic_displacement: reduced,
                on_isolators: false,
                base_moves,
                response_modification: Some(reduction),
                displacement_amplification: Some(amplification),
                importance: Some(importance),
                yield_amplification: Some(yields),
                system: Some(StructuralSystem::ALL[system]),
                isolation_period: Some(period),
                isolation_damping_coefficient: Some(damping),
                plan_length: Some(width + longer),
                plan_width: Some(width),
                plan_eccentricity: Some(eccentricity),
            }
        }
    }

    prop_compose! {
        fn any_site()(
            (aligned, owner, gap) in any::<(bool, bool, bool)>(),
            (intensity, zone) in (6_u8..10, 0_usize..3),
            (acceleration, coefficient, spectral) in (0.5..8.0_f64, 0.02..0.2_f64, 1.0..12.0_f64),
        ) -> Site {
            Site {
                floors_aligned: Some(aligned),
                same_owner: Some(owner),
                fortification_intensity: Some(intensity),
                soil_zone: Some([SoilZone::One, SoilZone::Two, SoilZone::Three][zone]),
                design_ground_acceleration: Some(acceleration),
                seismic_coefficient: Some(coefficient),
                spectral_acceleration_1s: Some(spectral),
                neighbour_has_gap: Some(gap),
                relative_ground_displacement: 0.0,
            }
        }
    }

    /// Factors that are not above zero, and heights below it, give no width, but are named.
    #[test]
    fn impossible_structures_are_refused() {
        let refusal = |change: &dyn Fn(&mut Structure)| {
            let mut situation = complete(0.1, 0.05);
            change(&mut situation.left);
            let all = ALL.iter().map(|d| d.between(&situation));
            let refused = all.filter_map(|width| match width {
                Err(error @ SeparationError::OutOfRange { .. }) => Some(error.to_string()),
                Err(_) => None,
                Ok(width) => {
                    assert!(width.width >= 0.0, "{width:?}");
                    None
                }
            });
            refused.collect::<Vec<_>>()
        };
        assert!(refusal(&|_| ()).is_empty());
        for value in [-1.0, 0.0, f64::NAN, f64::INFINITY] {
            let told = refusal(&|s| s.importance = Some(value));
            assert!(told.contains(&format!("importance = {value} is outside (0, inf)")));
        }
        for value in [-9.0, f64::NAN] {
            // No rule speaks of it.
            assert_eq!(refusal(&|s| s.height = value).len(), ALL.len());
            assert_eq!(refusal(&|s| s.elevation = value).len(), ALL.len());
        }
    }

    /// What says that it takes no height has the same width at any, and only that.
    #[test]
    fn whether_a_height_is_taken_is_said() {
        for descriptor in ALL {
            let of = |factor: f64| {
                let mut situation = complete(0.1, 0.05);
                for s in [&mut situation.left, &mut situation.right] {
                    s.height *= factor;
                    s.elevation *= factor;
                }
                descriptor.between(&situation).map(|r| r.width).ok()
            };
            // Other terms of a rule may hide its height at some of these.
            let varies = [0.1, 0.5, 2.0, 4.0, 8.0]
                .iter()
                .any(|factor| of(*factor) != of(1.0));
            let is_said = descriptor.height != HeightDatum::NotUsed;
            assert_eq!(varies, is_said, "{}", descriptor.name);
        }
    }

    /// Floors at 22 and 19.2 m, by hand in mm: each building's own where a distance is asked of each,
    /// the higher one where one distance is asked of both, and of a new building, by its own height
    /// and storeys, the wider.
    #[test]
    fn floors_of_a_level_at_different_elevations() {
        let mut situation = complete(0.1, 0.05);
        (situation.left.elevation, situation.right.elevation) = (22.0, 19.2);
        for (name, width) in [
            ("iran_2800_boundary_by_height", 0.005 * (22.0 + 19.2)),
            ("nch_433_boundary_minimum", 0.002 * (22.0 + 19.2)),
            ("nsr_10_boundary", 0.01 * (22.0 + 19.2)),
            ("mexico_city_2004_between_simplified", 0.009 * (22.0 + 19.2)),
            ("e_030_2018_beside_existing", 0.006 * (22.0 + 19.2) / 2.0),
            ("e_030_2018_minimum", 0.006 * 22.0),
            ("tehran_between", 0.22),
            ("japan_practice", 0.22),
            // a_g S = 0.25 g.
            ("ntc_2018_minimum", 0.22 / 2.0),
            // Six begun steps of 3 m above 6 m.
            ("tbdy_2018_minimum", 0.03 + 0.06),
            ("nsr_10_beside_existing", 0.03 * 22.0),
        ] {
            let descriptor = ALL.iter().find(|d| d.name == name).unwrap();
            let found = descriptor.between(&situation).unwrap();
            assert!(
                (found.width - width).abs() < 1.0e-12,
                "{name}: {}",
                found.width
            );
            for part in ["h(left) = 22.000000 m", "h(right) = 19.200000 m"] {
                assert!(
                    found.explanation.contains(part),
                    "{name}: {}",
                    found.explanation
                );
            }
        }
        // The new building on the right: 0.03 of 19.2 m, as the left one has two storeys.
        situation.left.storeys = 2;
        let found = super::nsr_10::BESIDE_EXISTING.between(&situation).unwrap();
        assert!(
            (found.width - 0.03 * 19.2).abs() < 1.0e-12,
            "{}",
            found.width
        );
    }

    proptest! {
        /// A greater displacement never asks for a smaller gap.
        #[test]
        fn monotone_in_displacement(a in 0.0..0.5_f64, b in 0.0..0.5_f64, more in 0.0..0.5_f64) {
            for descriptor in ALL {
                let width = |l, r| descriptor.between(&complete(l, r)).map(|r| r.width);
                let (one, left, right) = (width(a, b), width(a + more, b), width(a, b + more));
                prop_assert!(left? >= one.clone()?, "{}", descriptor.name);
                prop_assert!(right? >= one?, "{}", descriptor.name);
            }
        }

        /// The side on which a building stands matters to no rule: by formula, height, storeys or
        /// inputs, and at whatever elevations the floors of the level lie.
        #[test]
        fn symmetric(left in any_structure("a"), right in any_structure("b"), site in any_site()) {
            let situation = Situation { left, right, site };
            let exchanged = Situation {
                left: situation.right.clone(),
                right: situation.left.clone(),
                site,
            };
            for descriptor in ALL {
                let widths = [&situation, &exchanged].map(|s| descriptor.between(s).map(|r| r.width));
                match widths {
                    [Ok(one), Ok(other)] => {
                        let near = (one - other).abs() <= 1.0e-15 + 1.0e-15 * one;
                        prop_assert!(near, "{}: {one} and {other}", descriptor.name);
                    }
                    [Err(_), Err(_)] => {}
                    [one, other] => prop_assert!(false, "{}: {one:?} and {other:?}", descriptor.name),
                }
            }
        }
    }
}
