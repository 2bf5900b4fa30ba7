//! Laws whose force has a zero of a high order at closure let go where it changes its sign, not
//! where a polynomial through it does: located contacts against the adaptive pair.
use std::sync::Arc;

use pounding_gap_element::{ImpactModel, ModelParameters, SeparationRule, registry};
use pounding_time_history::{MethodChoice, Outcome, RunOptions, System, run};
use verification::{ReferenceLink, reference_cases, reference_system_with, synthetic_motion};

fn go(system: &System, method: MethodChoice) -> Outcome {
    let options = RunOptions {
        method,
        duration: Some(20.0),
        energy_tolerance: None,
    };
    run(system, &options, &mut [], &mut |_| {}).unwrap()
}

#[test]
fn contacts_of_high_exponents() {
    let cases = reference_cases().unwrap();
    let ground = synthetic_motion().unwrap();
    let stiffness = |exponent: f64| 9.35e7 * 0.005_f64.powf(1.0 - exponent);
    let adams = |exponent: f64| {
        ModelParameters::from_pairs(&[
            ("exponent", exponent),
            ("stiffness", stiffness(exponent)),
            ("damping", 3.0e5),
            ("full_damping_penetration", 1.0e-3),
        ])
    };
    let linear = |exponent: f64, restitution: f64, rule: SeparationRule| {
        ModelParameters::from_pairs(&[
            ("exponent", exponent),
            ("stiffness", stiffness(exponent)),
            ("restitution", restitution),
        ])
        .with_separation(rule)
    };
    let latched = SeparationRule::NoTensionLatched;
    for (name, parameters) in [
        ("adams_impact", adams(2.0)),
        ("adams_impact", adams(2.2)),
        ("adams_impact", adams(2.5)),
        ("adams_impact", adams(3.0)),
        ("exact_linear", linear(1.5, 1.0, latched)),
        ("exact_linear", linear(2.0, 0.65, latched)),
        ("exact_linear", linear(3.0, 0.65, latched)),
        ("exact_linear", linear(5.0, 0.65, latched)),
        ("exact_linear", linear(5.0, 0.8, SeparationRule::GapShift)),
    ] {
        let law: Arc<dyn ImpactModel> = registry::build(name, &parameters).unwrap().into();
        for case in ["C1", "C2"] {
            let what = format!("{name} {parameters:?} {case}");
            let case = &cases.cases[case];
            let law = |_: &ReferenceLink| Ok(Arc::clone(&law));
            let system = reference_system_with(case, &law, ground.clone(), 1.0).unwrap();
            let relative_tolerance = 1e-11;
            let located = go(&system, MethodChoice::EventDriven { relative_tolerance });
            let pair = go(&system, MethodChoice::Adaptive { relative_tolerance });
            let levels = |o: &Outcome| o.gaps[0].levels.clone();
            assert!(!located.impacts.is_empty(), "{what}");
            for (a, b) in levels(&located).iter().zip(&levels(&pair)) {
                assert_eq!(a.impacts, b.impacts, "{what}");
                let (a, b) = (a.peak_force.value, b.peak_force.value);
                assert!((a - b).abs() <= 1e-5 * b.abs(), "{what}: {a} {b}");
            }
            // No contact gives energy to the buildings.
            for impact in &located.impacts {
                let lost = impact.energy_dissipated;
                assert!(
                    lost > -1e-6 * located.energy.largest_input,
                    "{what}: {lost}"
                );
            }
        }
    }
}
