//! All models on the three-storey pair of the examples.
#![allow(clippy::unwrap_used)]

use std::path::{Path, PathBuf};

use pounding_case::Case;
use pounding_gap_element::SeparationRule;
use pounding_study::comparison::{
    Comparison, ComparisonOptions, Holds, QuantityKind, RestitutionRule, StiffnessRule, compare,
};
use pounding_study::gap_check::{CheckError, UNWATCHED, under_records};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn case(model: &str, stiffness: &str) -> Case {
    let file = root().join("examples/three_storey_pair/case.toml");
    let text = std::fs::read_to_string(&file).unwrap();
    let (before, after) = text.split_once("model = \"jankowski_2005\"").unwrap();
    let after = after.split_once("[ground_motion]").unwrap().1;
    let law = format!("model = \"{model}\"\nstiffness = \"{stiffness}\"\nrestitution = 0.65");
    let text = format!("{before}{law}\n[ground_motion]{after}");
    Case::parse(&text, &file).unwrap()
}

fn options(models: &[&str]) -> ComparisonOptions {
    ComparisonOptions {
        models: models.iter().map(|m| (*m).to_owned()).collect(),
        stiffness_rule: StiffnessRule::Penetration,
        restitution_rule: RestitutionRule::AsPublished,
        restitution: None,
        approach_velocity: None,
        threads: 2,
    }
}

fn compared(case: &Case, options: &ComparisonOptions) -> Comparison {
    let records = under_records(case, &[]).unwrap();
    compare(case, &records, options, UNWATCHED).unwrap()
}

fn value(c: &Comparison, model: &str, kind: QuantityKind, of: &str) -> f64 {
    let m = c
        .models
        .iter()
        .position(|m| m.descriptor.name == model)
        .unwrap();
    let q = c
        .quantities
        .iter()
        .position(|q| q.kind == kind && q.of == of)
        .unwrap();
    c.value(m, 0, q)
}

/// Kelvin-Voigt (k = 93.5 MN/m, e = 0.65) by an independent fixed-step RK4, four to five
/// digits: roof displacement, roof acceleration and maximum force.
#[test]
fn kelvin_voigt_of_the_published_pair() {
    let case = case("anagnostopoulos_2004", "93.5 MN/m");
    let model = "anagnostopoulos_2004";
    let c = compared(&case, &options(&[model]));
    {
        let roof = value(&c, model, QuantityKind::Displacement, "light");
        assert!((roof / 0.123_42 - 1.0).abs() < 3.0e-3, "{model}: {roof}");
        let acceleration = value(&c, model, QuantityKind::AccelerationAbsolute, "light");
        assert!(
            (acceleration / 37.34 - 1.0).abs() < 3.0e-3,
            "{model}: {acceleration}"
        );
        let force = value(&c, model, QuantityKind::PeakForce, "light-heavy");
        assert!((force / 9.287e5 - 1.0).abs() < 3.0e-3, "{model}: {force}");
    }
    assert!((c.references[0].stiffness - 93.5e6).abs() < 1.0);
    assert_eq!(c.references[0].exponent, 1.0);
}

/// The same law under two names leaves no spread; threads do not matter.
#[test]
fn one_law_under_two_names() {
    let case = case("exact_hunt_crossley", "2.75e9 N/m^1.5");
    let mut asked = options(&["exact_hunt_crossley", "exact_kelvin_voigt"]);
    asked.restitution_rule = RestitutionRule::Exact;
    let two = compared(&case, &asked);
    asked.threads = 1;
    let one = compared(&case, &asked);
    for (a, b) in two.models.iter().zip(&one.models) {
        assert_eq!(
            a.records[0]
                .as_ref()
                .unwrap()
                .values
                .iter()
                .map(|x| x.to_bits())
                .collect::<Vec<_>>(),
            b.records[0]
                .as_ref()
                .unwrap()
                .values
                .iter()
                .map(|x| x.to_bits())
                .collect::<Vec<_>>()
        );
        for gap in a.calibrated.as_ref().unwrap() {
            assert!((gap.free_restitution - 0.65).abs() < 1.0e-9);
        }
    }
    asked.models = vec![
        "hunt_crossley_1975".to_owned(),
        "hunt_crossley_1975".to_owned(),
    ];
    let same = compared(&case, &asked);
    assert_eq!(same.models.len(), 1, "a model twice is one model");
    assert!(same.spreads[0].between_models.is_nan());
}

/// All models: the light building depends on the model, its acceleration more than its
/// displacement, and the heavy building hardly notices.
#[test]
fn all_models() {
    let case = case("jankowski_2005", "2.75e9 N/m^1.5");
    let c = compared(&case, &options(&[]));
    assert_eq!(
        c.models.len(),
        pounding_gap_element::registry::descriptors().len()
    );
    for model in &c.models {
        assert!(
            model.is_complete(),
            "{}: {:?}",
            model.descriptor.name,
            model.diagnosis()
        );
    }
    let spread = |kind: QuantityKind, of: &str| {
        let q = c
            .quantities
            .iter()
            .position(|q| q.kind == kind && q.of == of)
            .unwrap();
        c.spreads[q].between_models
    };
    let light = spread(QuantityKind::AccelerationAbsolute, "light");
    let roof = spread(QuantityKind::Displacement, "light");
    assert!(light > roof && roof > 0.1, "{light} {roof}");
    assert!(spread(QuantityKind::Displacement, "heavy") < 0.005);
    let holds = |text: &str| {
        let found = c.conclusions.iter().find(|x| x.statement.contains(text));
        found.unwrap_or_else(|| panic!("{text}")).judgement.holds
    };
    assert_eq!(
        holds("raises the peak absolute acceleration of light"),
        Holds::Always
    );
    assert_eq!(holds("light-heavy is closed"), Holds::Always);
    assert_eq!(
        holds("raises the peak displacement of light"),
        Holds::ByModel
    );
    let rigid = value(
        &c,
        "stereomechanical",
        QuantityKind::PeakForce,
        "light-heavy",
    );
    assert!(rigid.is_nan(), "a jump has no force");
}

/// A model that cannot be calibrated is kept with its diagnosis; the others run.
#[test]
fn failures_are_recorded() {
    let case = case("jankowski_2005", "2.75e9 N/m^1.5");
    let mut asked = options(&["jankowski_2005", "gonthier_2004"]);
    asked.restitution = Some(1.5);
    let records = under_records(&case, &[]).unwrap();
    let error = compare(&case, &records, &asked, UNWATCHED).unwrap_err();
    assert!(matches!(error, CheckError::Option { .. }));
    asked.restitution = None;
    asked.models = vec!["jankowsky_2005".to_owned()];
    let error = compare(&case, &records, &asked, UNWATCHED).unwrap_err();
    assert!(error.help().unwrap().contains("jankowski_2005"));
    asked.restitution_rule = RestitutionRule::Exact;
    // Without another parameter its relation leads no lower than this.
    asked.restitution = Some(1.0e-3);
    asked.models = vec![
        "muthukumar_2003".to_owned(),
        "exact_hunt_crossley".to_owned(),
    ];
    let c = compare(&case, &records, &asked, UNWATCHED).unwrap();
    let diagnosis = c.models[0].diagnosis().unwrap();
    assert!(diagnosis.contains("returns"), "{diagnosis}");
    assert!(c.models[1].is_complete(), "{:?}", c.models[1].diagnosis());
}

/// Models of one class, exponent and damping in both phases differ in their relations
/// alone: returned exactly, they are one law.
#[test]
fn exact_relations_make_one_law() {
    let case = case("exact_hunt_crossley", "2.75e9 N/m^1.5");
    let mut asked = options(&[
        "exact_hunt_crossley",
        "hunt_crossley_1975",
        "lankarani_nikravesh_1990",
        "gharib_hurmuzlu_2012",
        "ye_li_zhu_2009",
    ]);
    asked.restitution_rule = RestitutionRule::Exact;
    let c = compared(&case, &asked);
    for (quantity, spread) in c.quantities.iter().zip(&c.spreads) {
        let between = spread.between_models;
        assert!(between < 1.0e-5, "{}: {between:e}", quantity.label());
    }
    asked.restitution_rule = RestitutionRule::AsPublished;
    let published = compared(&case, &asked);
    assert!(
        published.spreads[0].between_models > 0.1,
        "the relations differ"
    );
}

/// The model of the case, with the case's separation rule, is what a run of the case is: not the model with its default rule.
/// Models that do not offer the rule say so.
#[test]
fn the_separation_of_the_gap_is_that_of_the_models() {
    let plain = case("exact_kelvin_voigt", "93.5 MN/m");
    let with_rule = case(
        "exact_kelvin_voigt",
        "93.5 MN/m\"\nseparation = \"zero_penetration",
    );
    let acceleration = |case: &Case| {
        let models = ["exact_kelvin_voigt", "jankowski_2005"];
        let c = compared(case, &options(&models));
        let own = value(&c, models[0], QuantityKind::AccelerationAbsolute, "light");
        let remarks = c.models[1].calibrated.as_ref().unwrap()[0].notes.join("; ");
        (own, remarks)
    };
    let run = |case: &Case| {
        let assembly = pounding_assembly::assemble(case).unwrap();
        let (system, options) = (assembly.system, assembly.options);
        let outcome = pounding_time_history::run(&system, &options, &mut [], &mut |_| {}).unwrap();
        let storeys = outcome.buildings[0].storeys.iter();
        storeys.fold(0.0, |m, s| f64::max(m, s.acceleration_absolute.value))
    };
    let (by_default, _) = acceleration(&plain);
    let (own, remarks) = acceleration(&with_rule);
    assert!((own / run(&with_rule) - 1.0).abs() < 1e-9, "{own}");
    assert!(
        (by_default / run(&plain) - 1.0).abs() < 1e-9,
        "{by_default}"
    );
    assert!((own / by_default - 1.0).abs() > 1e-6, "{own} {by_default}");
    let offers = pounding_gap_element::registry::find("jankowski_2005").unwrap();
    let offers = offers
        .separation_rules
        .contains(&SeparationRule::ZeroPenetration);
    assert_eq!(remarks.contains("does not offer"), !offers, "{remarks}");
}
