//! Every registered model: tangents, regularity, invariance, its descriptor.
use pounding_catalogue::DefinitionError;
use pounding_gap_element::{
    AchievedRestitution, Bodies, GapElementError, ImpactModel, MAXIMUM_CONSTANTS, Memory,
    ModelDescriptor, ModelParameters, Phase, REQUESTED, SeparationRule, collide, registry,
};
use proptest::prelude::*;

/// A model with plausible parameters, whatever it asks for.
fn sample(d: &ModelDescriptor, restitution: f64, stiffness: f64) -> Box<dyn ImpactModel> {
    let mut parameters = d.example_parameters(restitution);
    if let Some(value) = parameters.values.get_mut("stiffness") {
        *value = stiffness;
    }
    registry::build(d.name, &parameters).unwrap()
}

/// Finite-difference tangents of every registered model, in all its phases: one
/// property test for each region of the state, each over the whole registry.
macro_rules! tangents {
    ($($region:ident: $delta:expr, $velocity:expr;)*) => {
        mod tangent {
            use super::*;
            $(
                proptest! {
                    #[test]
                    fn $region(delta in $delta, v in $velocity, v0 in 1e-2..1.5_f64, e in 0.2..1.0_f64) {
                        for d in registry::descriptors() {
                            check_tangent(sample(d, e, 1e9).as_ref(), delta, v, v0);
                        }
                    }
                }
            )*
        }
    };
}

tangents! {
    approach: 1e-5..2e-2_f64, 0.0..1.0_f64;
    restitution: 1e-5..2e-2_f64, -1.0..0.0_f64;
    near_the_turning_point: 1e-3..2e-2_f64, -1e-6..1e-6_f64;
    near_zero_penetration: 1e-9..1e-6_f64, -1.0..1.0_f64;
}

proptest! {
    /// What a model says of its law in powers is what it computes, in every phase.
    #[test]
    fn power_laws_are_the_laws(
        delta in 1e-7..2e-2_f64,
        v in -1.0..1.0_f64,
        v0 in 1e-2..1.5_f64,
        e in 0.2..1.0_f64,
    ) {
        let mut compared = 0;
        for d in registry::descriptors() {
            let model = sample(d, e, 1e9);
            let collision = model.begin(v0, 2.0e4);
            for phase in [Phase::Approach, Phase::Restitution, Phase::Released] {
                let Some(law) = model.power_law(&collision, phase) else { continue };
                let force = model.force(&collision, &Memory::default(), phase, delta, v).value;
                let spring = law.stiffness * delta.powf(law.exponent);
                let dashpot = law.dashpot * delta.powf(law.dashpot_exponent) * v;
                let error = (force - (spring + dashpot)).abs();
                let size = spring.abs() + dashpot.abs();
                prop_assert!(error <= 1e-13 * size, "{} {phase:?}: {error:e}", d.name);
                let error = (law.force(delta, v) - (spring + dashpot)).abs();
                prop_assert!(error <= 1e-13 * size, "{} {phase:?}, by the law: {error:e}", d.name);
                compared += 1;
            }
        }
        prop_assert!(compared > 40, "{compared}");
    }
}

fn check_tangent(model: &dyn ImpactModel, delta: f64, v: f64, v0: f64) {
    let collision = model.begin(v0, 2.0e4);
    let memory = Memory {
        maximum_penetration: delta,
        plastic_penetration: 0.1 * delta,
    };
    for phase in [
        Phase::Approach,
        Phase::Restitution,
        Phase::Stuck,
        Phase::Released,
        Phase::Branch(0),
        Phase::Branch(1),
    ] {
        let f = |d: f64, v: f64| model.force(&collision, &memory, phase, d, v);
        let at = f(delta, v);
        let (hd, hv) = (1e-5 * delta, 1e-5);
        let by_delta = (f(delta + hd, v).value - f(delta - hd, v).value) / (2.0 * hd);
        let by_velocity = (f(delta, v + hv).value - f(delta, v - hv).value) / (2.0 * hv);
        // Central differences of a value of size F err by eps F / h and h^2.
        let noise = 1e-10 * (at.value.abs() + at.by_velocity.abs());
        let close = |a: f64, b: f64, h: f64| (a - b).abs() <= 1e-7 * a.abs() + noise / h;
        assert!(
            close(at.by_penetration, by_delta, hd),
            "{} {phase:?} by penetration: {} {by_delta}",
            model.descriptor().name,
            at.by_penetration
        );
        assert!(
            close(at.by_velocity, by_velocity, hv),
            "{} {phase:?} by velocity: {} {by_velocity}",
            model.descriptor().name,
            at.by_velocity
        );
    }
}

#[test]
fn zero_approach_velocity_is_regular() {
    for d in registry::descriptors() {
        for e in [0.1, 0.65, 1.0] {
            let model = sample(d, e, 1e9);
            let collision = model.begin(0.0, 2.0e4);
            for phase in [Phase::Approach, Phase::Restitution] {
                for (delta, v) in [(0.0, 0.0), (1e-6, 1e-3), (1e-3, -1e-2), (-1e-9, 0.1)] {
                    let f = model.force(&collision, &Memory::default(), phase, delta, v);
                    assert!(
                        f.value.is_finite()
                            && f.by_penetration.is_finite()
                            && f.by_velocity.is_finite(),
                        "{} {f:?}",
                        d.name
                    );
                }
            }
        }
    }
}

#[test]
fn descriptors_are_complete_and_names_unique() {
    let mut names = Vec::new();
    for d in registry::descriptors() {
        let status = d.verification.remark();
        let texts = [d.title, d.formula, d.citation, d.class, d.family(), status];
        for text in texts.iter().chain(d.traps) {
            assert_eq!(text.trim(), *text, "{}", d.name);
            assert!(!text.is_empty(), "{} has an empty field", d.name);
        }
        let rigid = example(d, 0.65).rigid_restitution().is_some();
        assert!(!d.traps.is_empty(), "{} has nothing to know", d.name);
        assert!(!d.separation_rules.is_empty(), "{}", d.name);
        assert!(!d.constants.is_empty() || rigid, "{}", d.name);
        assert!(d.constants.len() <= MAXIMUM_CONSTANTS, "{}", d.name);
        names.push(d.name);
        for alias in d.aliases {
            names.push(alias.name);
            assert!(!alias.citation.is_empty(), "{}", alias.name);
            assert_eq!(registry::find(alias.name).unwrap().name, d.name);
        }
    }
    for name in &names {
        let allowed = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
        assert!(name.chars().all(allowed), "{name}");
    }
    let count = names.len();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), count);
    let Err(GapElementError::Definition(DefinitionError::UnknownName { nearest, .. })) =
        registry::find("jankowsky_2005")
    else {
        panic!("an unknown name was accepted");
    };
    assert_eq!(nearest, "jankowski_2005");
}

/// The model of the documentation's example.
fn example(d: &ModelDescriptor, restitution: f64) -> Box<dyn ImpactModel> {
    registry::build(d.name, &d.example_parameters(restitution))
        .unwrap_or_else(|e| panic!("the example of {}: {e}", d.name))
}

#[test]
fn parameters_are_described_and_examples_build() {
    for d in registry::descriptors() {
        for (index, p) in d.parameters.iter().enumerate() {
            let before = &d.parameters[..index];
            assert!(before.iter().all(|q| q.name != p.name), "{}", p.name);
            assert!(!p.explanation.is_empty(), "{}: {}", d.name, p.name);
            assert!(
                p.default.is_none_or(|x| p.allows(x)),
                "{}: {}",
                d.name,
                p.name
            );
            assert!(!p.required || p.default.is_none(), "{}: {}", d.name, p.name);
        }
        for e in [0.1, 0.4, 0.65, 0.9, 1.0] {
            for &rule in d.separation_rules {
                let parameters = d.example_parameters(e).with_separation(rule);
                let model = registry::build(d.name, &parameters)
                    .unwrap_or_else(|e| panic!("the example of {}: {e}", d.name));
                assert_eq!(model.separation(), rule, "{}", d.name);
                assert_eq!(model.descriptor().name, d.name);
            }
        }
    }
}

/// One model a file of its own name, and no file that nobody registered.
#[test]
fn every_model_has_its_file() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/src/models");
    let mut files: Vec<String> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .map(|path| path.file_stem().unwrap().to_str().unwrap().to_owned())
        .filter(|name| name != "mod")
        .collect();
    let mut names: Vec<&str> = registry::descriptors().iter().map(|d| d.name).collect();
    files.sort_unstable();
    names.sort_unstable();
    assert_eq!(
        files, names,
        "files of src/models and the list in models/mod.rs"
    );
}

/// What the example returns in a free collision.
fn returned(d: &ModelDescriptor, restitution: f64, rule: SeparationRule) -> f64 {
    let bodies = Bodies {
        mass_left: 25e3,
        mass_right: Some(40e3),
        velocity_left: 0.8,
        velocity_right: 0.0,
    };
    let parameters = d.example_parameters(restitution).with_separation(rule);
    let model = registry::build(d.name, &parameters).unwrap();
    collide(model.as_ref(), &bodies).unwrap().restitution
}

/// Why they are recommended: in a free collision they return what is asked, with
/// every separation rule that they offer.
#[test]
fn recommended_models_return_the_restitution_asked_for() {
    for d in registry::descriptors().iter().filter(|d| d.recommended) {
        for &rule in d.separation_rules {
            for e in REQUESTED {
                let returned = returned(d, e, rule);
                let error = (returned - e).abs();
                assert!(error < 1e-9, "{} {rule:?} {e}: {returned}", d.name);
            }
        }
    }
}

/// Pairs of numbers in "... 0.4946 for 0.5, 0.6470 for 0.65 ...".
fn quoted_pairs(text: &str) -> Vec<(&str, f64)> {
    let words: Vec<&str> = text
        .split_whitespace()
        .map(|word| word.trim_matches(|c: char| c.is_ascii_punctuation()))
        .collect();
    words
        .windows(3)
        .filter(|w| w[1] == "for" && w[0].parse::<f64>().is_ok())
        .filter_map(|w| Some((w[0], w[2].parse().ok()?)))
        .collect()
}

/// What descriptors say of achieved for requested restitution holds with one of the
/// separation rules that the model offers.
#[test]
fn descriptors_quote_what_the_models_return() {
    let mut compared = 0;
    for d in registry::descriptors() {
        for (quoted, e) in d.traps.iter().flat_map(|trap| quoted_pairs(trap)) {
            let decimals = quoted.split('.').nth(1).map_or(0, str::len);
            let returned: Vec<String> = d
                .separation_rules
                .iter()
                .map(|&rule| returned(d, e, rule))
                .map(|returned| format!("{returned:.decimals$}"))
                .collect();
            let known = returned.iter().any(|r| r == quoted);
            assert!(known, "{} for {e}: {quoted}, not {returned:?}", d.name);
            compared += 1;
        }
    }
    assert!(compared > 50, "{compared}");
}

#[test]
fn wrong_parameters_are_refused() {
    let build = |pairs: &[(&str, f64)]| {
        registry::build("jankowski_2005", &ModelParameters::from_pairs(pairs)).map(|_| ())
    };
    assert!(matches!(
        build(&[("restitution", 0.6)]),
        Err(GapElementError::Definition(
            DefinitionError::MissingParameter { .. }
        ))
    ));
    assert!(matches!(
        build(&[("stiffness", 1e9)]),
        Err(GapElementError::Definition(
            DefinitionError::MissingParameter { .. }
        ))
    ));
    assert!(matches!(
        build(&[("stiffness", 1e9), ("restitution", 0.0)]),
        Err(GapElementError::Definition(
            DefinitionError::OutOfRange { .. }
        ))
    ));
    assert!(matches!(
        build(&[("stiffness", f64::NAN), ("restitution", 0.5)]),
        Err(GapElementError::Definition(
            DefinitionError::OutOfRange { .. }
        ))
    ));
    assert!(matches!(
        build(&[
            ("stiffness", 1e9),
            ("restitution", 0.5),
            ("damping_ratio", 0.3)
        ]),
        Err(GapElementError::Conflict { .. })
    ));
    assert!(matches!(
        build(&[("stiffness", 1e9), ("restitution", 0.5), ("colour", 1.0)]),
        Err(GapElementError::Definition(
            DefinitionError::UnknownParameter { .. }
        ))
    ));
}

/// Uniform in the logarithm.
fn decades(from: f64, to: f64) -> impl Strategy<Value = f64> {
    (from..to).prop_map(|exponent| 10.0_f64.powf(exponent))
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 48,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    /// Theory: restitution of these laws depends on mass, stiffness and speed not at
    /// all, here over eight decades of each; momentum is conserved, and the loss is
    /// (1/2) m v0^2 (1 - e^2). Speeds begin where the floor of the approach velocity
    /// ends.
    #[test]
    fn restitution_is_invariant_and_the_balances_hold(
        e in 0.15..1.0_f64, m1 in decades(-1.0, 7.0), m2 in decades(-1.0, 7.0),
        v in decades(-3.0, 5.0), k in decades(3.0, 11.0),
    ) {
        let constant = registry::descriptors()
            .iter()
            .filter(|d| d.achieved_restitution != AchievedRestitution::Varies);
        for d in constant {
            let bodies = Bodies { mass_left: m1, mass_right: Some(m2), velocity_left: 0.7 * v, velocity_right: -0.3 * v };
            let out = collide(sample(d, e, k).as_ref(), &bodies).unwrap();
            let standard = Bodies { mass_left: 1e4, mass_right: None, velocity_left: 0.5, velocity_right: 0.0 };
            let other = collide(sample(d, e, 1e9).as_ref(), &standard).unwrap();
            prop_assert!((out.restitution - other.restitution).abs() < 1e-9, "{}: {} {}", d.name, out.restitution, other.restitution);
            let before = m1 * bodies.velocity_left + m2 * bodies.velocity_right;
            let after = m1 * out.velocity_left + m2 * out.velocity_right;
            prop_assert!((before - after).abs() <= 1e-12 * (m1 + m2) * v);
            let kinetic = |a: f64, b: f64| 0.5 * m1 * a * a + 0.5 * m2 * b * b;
            let lost = kinetic(bodies.velocity_left, bodies.velocity_right) - kinetic(out.velocity_left, out.velocity_right);
            prop_assert!((lost - out.energy_dissipated).abs() <= 1e-9 * kinetic(bodies.velocity_left, bodies.velocity_right));
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 64,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    /// Where a model says that its law is affine, the force at any state is that of its
    /// constants at zero.
    #[test]
    fn affine_laws_are_affine(
        delta in 0.0..2e-2_f64, v in -1.0..1.0_f64, v0 in 1e-2..1.5_f64, e in 0.2..1.0_f64,
    ) {
        let mut affine = 0;
        for d in registry::descriptors() {
            let model = sample(d, e, 1e8);
            let collision = model.begin(v0, 2.0e4);
            let memory = Memory { maximum_penetration: delta, plastic_penetration: 0.1 * delta };
            for phase in [Phase::Approach, Phase::Restitution, Phase::Released, Phase::Branch(0), Phase::Branch(1)] {
                if !model.is_affine(&collision, phase) {
                    continue;
                }
                affine += 1;
                let zero = model.force(&collision, &memory, phase, 0.0, 0.0);
                let there = model.force(&collision, &memory, phase, delta, v);
                let expected = zero.value + zero.by_penetration * delta + zero.by_velocity * v;
                let scale = (zero.by_penetration * delta).abs() + (zero.by_velocity * v).abs() + zero.value.abs();
                prop_assert!((there.value - expected).abs() <= 1e-12 * scale, "{} {phase:?}", d.name);
                prop_assert_eq!((there.by_penetration, there.by_velocity), (zero.by_penetration, zero.by_velocity));
            }
        }
        prop_assert!(affine > 25, "{affine}");
    }
}

/// At a restitution of one the two lines of the bilinear law are one: a spring, which stores
/// half its force times its length.
#[test]
fn the_bilinear_law_without_loss_is_a_spring() {
    let descriptor = registry::find("muthukumar_2003").unwrap();
    let model = registry::build(descriptor.name, &descriptor.example_parameters(1.0)).unwrap();
    let (collision, memory) = (model.begin(0.5, 2.0e4), Memory::default());
    for delta in [1.0e-6, 1.0e-4, 2.0e-3] {
        let force = model
            .force(&collision, &memory, Phase::Approach, delta, 0.0)
            .value;
        let stored = model.stored_energy(&collision, &memory, Phase::Approach, delta);
        assert!(
            (stored / (0.5 * force * delta) - 1.0).abs() < 1.0e-12,
            "{stored}"
        );
    }
}

/// Laws whose restitution depends on nothing but their parameters return it at 1 mm/s and above; at
/// 0.1 mm/s those, and only those, that divide by the approach velocity return more.
#[test]
fn which_laws_divide_by_the_approach_velocity() {
    let mut divide = 0;
    for descriptor in registry::descriptors() {
        if descriptor.achieved_restitution != AchievedRestitution::Constant {
            continue;
        }
        let parameters = descriptor.example_parameters(0.5);
        let model = registry::build(descriptor.name, &parameters).unwrap();
        let at = |velocity_left: f64| {
            let bodies = Bodies {
                mass_left: 25.0e3,
                mass_right: Some(40.0e3),
                velocity_left,
                velocity_right: 0.0,
            };
            collide(model.as_ref(), &bodies).unwrap().restitution
        };
        let (name, usual) = (descriptor.name, at(0.8));
        assert!((at(1.0e-3) - usual).abs() < 1.0e-6, "{name}");
        let slow = at(1.0e-4);
        let divides = descriptor.divides_by_approach_velocity();
        assert_eq!(slow > usual + 0.1, divides, "{name}: {slow} {usual}");
        assert!(divides || (slow - usual).abs() < 1.0e-6, "{name}");
        divide += usize::from(divides);
    }
    assert!(divide > 10, "{divide}");
}

/// Elastic laws have no damping that could make a contact creep.
#[test]
fn what_to_do_about_a_collision_without_end() {
    let error = |name| {
        let model = registry::find(name).unwrap();
        GapElementError::Unfinished {
            model: model.name,
            elastic: model.achieved_restitution == AchievedRestitution::Elastic,
            steps: 100_000,
            time: 1.0e-9,
        }
    };
    for elastic in ["linear_elastic", "hertz_1882"] {
        let help = error(elastic).help().unwrap();
        assert!(
            !help.contains("damping") && help.contains("stiffness"),
            "{help}"
        );
    }
    let help = error("exact_hunt_crossley").help().unwrap();
    assert!(
        help.contains("damping") && help.contains("stiffness"),
        "{help}"
    );
}
