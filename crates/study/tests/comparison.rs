//! All models on the three-storey pair of the examples.
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
    let records = under_records(&case, &[]).unwrap();
    // An alias is another name of the same.
    for twice in [
        ["hunt_crossley_1975"; 2],
        ["anagnostopoulos_2004", "kelvin_voigt"],
    ] {
        asked.models = twice.map(str::to_owned).to_vec();
        let error = compare(&case, &records, &asked, UNWATCHED).unwrap_err();
        let said = format!("model {} is asked for twice", twice[0]);
        assert_eq!(error.to_string(), said);
        assert!(error.help().unwrap().contains(twice[1]), "{error:?}");
    }
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

/// The case with the lines of this law.
fn case_of_law(law: &str) -> Case {
    let file = root().join("examples/three_storey_pair/case.toml");
    let text = std::fs::read_to_string(&file).unwrap();
    let (before, after) = text.split_once("model = \"jankowski_2005\"").unwrap();
    let after = after.split_once("[ground_motion]").unwrap().1;
    Case::parse(&format!("{before}{law}\n[ground_motion]{after}"), &file).unwrap()
}

/// Maximum contact force of a run of the case.
fn force_of_run(case: &Case) -> f64 {
    let assembly = pounding_assembly::assemble(case).unwrap();
    let (system, options) = (assembly.system, assembly.options);
    let outcome = pounding_time_history::run(&system, &options, &mut [], &mut |_| {}).unwrap();
    let levels = outcome.gaps[0].levels.iter();
    levels.fold(0.0, |m, l| f64::max(m, l.peak_force.value))
}

/// Maximum penetration of a model without damping in the reference collision.
fn undamped_penetration(c: &Comparison, model: usize) -> f64 {
    let calibrated = &c.models[model].calibrated.as_ref().unwrap()[0];
    let mut parameters = calibrated.parameters.clone();
    if parameters.values.remove("restitution").is_some() {
        parameters.values.insert("restitution".to_owned(), 1.0);
    }
    parameters.values.remove("damping_ratio");
    let model = pounding_gap_element::registry::build(calibrated.descriptor.name, &parameters);
    let bodies = pounding_gap_element::Bodies {
        mass_left: c.references[0].effective_mass,
        mass_right: None,
        velocity_left: c.references[0].approach_velocity,
        velocity_right: 0.0,
    };
    let outcome = pounding_gap_element::collide(model.unwrap().as_ref(), &bodies);
    outcome.unwrap().peak_penetration
}

/// A bumper that is crushed at 1 mm is compared as it is in the case: its force is that of a run. The
/// others penetrate as deep as it does without damping: where the energies of its two branches,
/// `k d^(n+1) / (n+1)` up to there and `(F + k_u b / 2) b` beyond, are that of the collision.
#[test]
fn the_own_law_keeps_all_its_parameters() {
    let case = case_of_law(
        "model = \"polycarpou_2013\"\nstiffness = 3e10\nrestitution = 0.5\ncrush_penetration = 0.001\ncrush_stiffness = 1e9",
    );
    let models = ["polycarpou_2013", "linear_elastic", "hertz_1882"];
    let c = compared(&case, &options(&models));
    let own = value(&c, models[0], QuantityKind::PeakForce, "light-heavy");
    let run = force_of_run(&case);
    assert!((own / run - 1.0).abs() < 1e-9, "{own} {run}");
    let (k, n, crush, crushed): (f64, f64, f64, f64) = (3e10, 2.65, 1e-3, 1e9);
    let reference = &c.references[0];
    let energy = 0.5 * reference.effective_mass * reference.approach_velocity.powi(2);
    let force = k * crush.powf(n);
    let left = energy - force * crush / (n + 1.0);
    let beyond = (-force + (force * force + 2.0 * crushed * left).sqrt()) / crushed;
    for model in 0..3 {
        let depth = undamped_penetration(&c, model);
        assert!(
            (depth / (crush + beyond) - 1.0).abs() < 1e-6,
            "{model}: {depth}"
        );
    }
    // And equally long, where that is asked for.
    let mut asked = options(&models[1..]);
    asked.stiffness_rule = StiffnessRule::Duration;
    let c = compared(&case, &asked);
    let model = c.models[0].calibrated.as_ref().unwrap();
    let mass = reference.effective_mass;
    let time = std::f64::consts::PI * (mass / model[0].parameters.values["stiffness"]).sqrt();
    // Up to crushing between the velocities there and at first; then a spring that is preloaded with F.
    let omega = (crushed / mass).sqrt();
    let at_first = reference.approach_velocity;
    let at_crush = (2.0 * left / mass).sqrt();
    let spring = (at_crush * omega * mass / force).atan() / omega;
    let [least, most] = [at_first, at_crush].map(|v| 2.0 * (crush / v + spring));
    assert!(
        least < time && time < most && most < 1.1 * least,
        "{time} {least} {most}"
    );
    let restitution = compared(&case, &{
        let mut asked = options(&["polycarpou_2013"]);
        asked.restitution = Some(0.8);
        asked
    });
    let parameters = &restitution.models[0].calibrated.as_ref().unwrap()[0].parameters;
    assert_eq!(parameters.values["crush_penetration"], 0.001);
    assert_eq!(parameters.values["restitution"], 0.8);
}

/// An own law that is given by its damping, and one with an exponent, are those of a run too.
#[test]
fn the_own_law_is_that_of_a_run() {
    for (model, law) in [
        (
            "jankowski_2005",
            "stiffness = \"2.75e9 N/m^1.5\"\ndamping_ratio = 0.35",
        ),
        (
            "exact_hunt_crossley",
            "stiffness = \"9e7 N/m\"\nexponent = 1\nrestitution = 0.5",
        ),
        (
            "kuwabara_kono_1987",
            "stiffness = \"2.75e9 N/m^1.5\"\ndissipation_time = \"0.001 s\"",
        ),
    ] {
        let case = case_of_law(&format!("model = \"{model}\"\n{law}"));
        let c = compared(&case, &options(&[model]));
        let own = value(&c, model, QuantityKind::PeakForce, "light-heavy");
        let run = force_of_run(&case);
        assert!((own / run - 1.0).abs() < 1e-9, "{model}: {own} {run}");
    }
}

/// In a soft contact, which penetrates more than the 15 mm at which the bumper of the example is crushed,
/// polycarpou_2013 penetrates as deep as the others.
#[test]
fn all_penetrate_equally_deep() {
    let case = case("anagnostopoulos_2004", "1 MN/m");
    let c = compared(
        &case,
        &options(&["linear_elastic", "hertz_1882", "polycarpou_2013"]),
    );
    let linear = undamped_penetration(&c, 0);
    assert!(linear > 0.03, "{linear}");
    for model in 1..3 {
        let depth = undamped_penetration(&c, model);
        assert!(
            (depth / linear - 1.0).abs() < 1e-6,
            "{model}: {depth} {linear}"
        );
    }
}

/// Elastic laws lose no energy, whatever round-off leaves of it: neither those without damping nor
/// those that are asked for the restitution 1, among them those whose damping is found.
#[test]
fn elastic_laws_lose_nothing() {
    let case = case("exact_hunt_crossley", "2.75e9 N/m^1.5");
    let models = [
        "linear_elastic",
        "hertz_1882",
        "exact_hunt_crossley",
        "adams_impact",
        "kuwabara_kono_1987",
    ];
    let mut asked = options(&models);
    asked.restitution = Some(1.0);
    let c = compared(&case, &asked);
    for model in models {
        let lost = value(&c, model, QuantityKind::ImpactEnergy, "light-heavy");
        assert_eq!(lost, 0.0, "{model}");
    }
    asked.restitution = Some(0.999_99);
    for model in &compared(&case, &asked).models[3..] {
        let free = model.calibrated.as_ref().unwrap()[0].free_restitution;
        assert!((free - 0.999_99).abs() < 1e-6, "{}", model.descriptor.name);
    }
}

/// A reference collision below 1 mm/s: laws that divide by the approach velocity are calibrated as they
/// run, and a warning names them and no others.
#[test]
fn a_slow_reference_is_warned_of() {
    let case = case("anagnostopoulos_2004", "93.5 MN/m");
    let mut asked = options(&["exact_hunt_crossley", "exact_kelvin_voigt"]);
    for (velocity, warned) in [(0.5e-3, true), (1.0e-3, false)] {
        asked.approach_velocity = Some(velocity);
        let c = compared(&case, &asked);
        let slow = c.warnings.iter().filter(|w| w.contains("below 1 mm/s"));
        let slow: Vec<_> = slow.collect();
        assert_eq!(slow.len(), usize::from(warned));
        for warning in slow {
            assert!(warning.contains("0.5 mm/s"), "{warning}");
            assert!(warning.ends_with(": exact_hunt_crossley"), "{warning}");
        }
        let free = c.models[0].calibrated.as_ref().unwrap()[0].free_restitution;
        assert_eq!(free > 0.7, warned, "{free}");
    }
}

/// Beside a law without loss, whose collision returns 1 but for round-off, all models are asked for a restitution of 1, which
/// leaves the motion of an elastic contact.
#[test]
fn models_beside_a_law_without_loss() {
    let file = root().join("examples/three_storey_pair/case.toml");
    let text = std::fs::read_to_string(&file).unwrap();
    let law = "model = \"kuwabara_kono_1987\"\nstiffness = \"2.75e9 N/m^1.5\"\ndissipation_time = 0.0\n\n[ground_motion]";
    let (before, after) = text.split_once("model = \"jankowski_2005\"").unwrap();
    let after = after.split_once("[ground_motion]").unwrap().1;
    let text = format!("{before}{law}{after}").replace("31 s", "6 s");
    let case = Case::parse(&text, &file).unwrap();
    let models = ["hertz_1882", "jankowski_2005", "exact_hunt_crossley"];
    let found = compared(&case, &options(&models));
    for model in &found.models {
        assert!(
            model.calibrated.is_ok(),
            "{:?}",
            model.calibrated.as_ref().err()
        );
    }
    let force = |model| value(&found, model, QuantityKind::PeakForce, "light-heavy");
    for model in &models[1..] {
        let ratio = force(model) / force("hertz_1882");
        assert!((ratio - 1.0).abs() < 1e-6, "{model}: {ratio}");
    }
}
