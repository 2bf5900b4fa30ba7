//! The laboratory of impact models: examples, and measured forces.
#![allow(clippy::unwrap_used)]

use pounding_gap_element::laboratory::{
    EXAMPLE_BODIES, EXAMPLE_RESTITUTION, MeasuredForce, MeasuredForceError, Specimen, unit_of,
};
use pounding_gap_element::{ModelParameters, collide, registry};

fn specimen(name: &str, pairs: &[(&str, f64)]) -> Specimen {
    Specimen::new(
        registry::find(name).unwrap(),
        ModelParameters::from_pairs(pairs),
    )
}

/// Every model with its example can be built; what was given stays, and excludes what would
/// contradict it.
#[test]
fn examples_fill_what_is_missing() {
    for descriptor in registry::descriptors() {
        let mut one = specimen(descriptor.name, &[]);
        one.fill_from_example();
        assert!(one.build().is_ok(), "{}", descriptor.name);
        assert_eq!(one.filled.len(), one.parameters.values.len());
    }
    let mut damped = specimen("jankowski_2005", &[("stiffness", 1.0e9)]);
    damped.fill_from_example();
    assert_eq!(damped.parameters.values["stiffness"], 1.0e9);
    assert_eq!(damped.parameters.values["restitution"], EXAMPLE_RESTITUTION);
    let mut other = specimen("anagnostopoulos_2004", &[("damping_ratio", 0.1)]);
    other.fill_from_example();
    assert!(!other.parameters.values.contains_key("restitution"));
    assert!(other.build().is_ok());
    damped.forget_restitution();
    assert!(!damped.parameters.values.contains_key("restitution"));
}

#[test]
fn units_have_the_exponent_of_the_law() {
    let unit = |name, pairs: &[(&str, f64)], key| {
        let one = specimen(name, pairs);
        unit_of(one.descriptor, &one.parameters, key)
    };
    assert_eq!(unit("jankowski_2005", &[], "stiffness").unwrap(), "N/m^1.5");
    let given = [("exponent", 2.5)];
    assert_eq!(
        unit("exact_hunt_crossley", &given, "stiffness").unwrap(),
        "N/m^2.5"
    );
    assert_eq!(unit("linear_elastic", &[], "stiffness").unwrap(), "N/m");
    assert_eq!(unit("jankowski_2005", &[], "restitution"), None);
}

/// A triangle of force from 2 s to 4 s with its peak of 1 kN at 3 s, sampled every 0.05 s:
/// what the lines through its samples must give.
#[test]
fn a_triangle_is_found_where_it_lies() {
    let force = |t: f64| 1.0e3 * (1.0 - (t - 3.0).abs()).max(0.0);
    let times = (0..=100).map(|i| 0.05 * f64::from(i));
    let raw: Vec<_> = times.map(|t| (t, force(t))).collect();
    let found = MeasuredForce::align("triangle".to_owned(), &raw, 0.01, None).unwrap();
    assert!((found.first_contact - 2.0).abs() < 1e-9, "{found:?}");
    assert!((found.contact_time - 2.0).abs() < 1e-9);
    assert!((found.impulse - 1.0e3).abs() < 1e-6);
    assert!((found.peak.1 - 1.0).abs() < 1e-9 && (found.peak.0 - 1.0e3).abs() < 1e-9);
    assert!(found.warnings.is_empty());
}

/// A collision held against its own force differs by the interpolation alone; a rigid impact has
/// an impulse and no force.
#[test]
fn a_collision_is_like_its_own_force() {
    let outcome = |name| {
        let mut one = specimen(name, &[]);
        one.fill_from_example();
        collide(one.build().unwrap().as_ref(), &EXAMPLE_BODIES).unwrap()
    };
    let computed = outcome("hertz_1882");
    let raw: Vec<_> = computed.history.iter().map(|s| (s.time, s.force)).collect();
    let align = |shift| MeasuredForce::align("own".to_owned(), &raw, 0.01, shift).unwrap();
    let difference = align(Some(0.0)).difference(&computed);
    assert!(
        difference.peak_force_error_percent.abs() < 0.1,
        "{difference:?}"
    );
    assert!(
        difference.impulse_error_percent.abs() < 0.1,
        "{difference:?}"
    );
    assert!(
        difference.rms_force_difference_percent_of_peak < 0.1,
        "{difference:?}"
    );
    let rigid = outcome("stereomechanical");
    assert!(rigid.is_rigid() && rigid.contact_time().is_nan() && rigid.impulse_of_parted() > 0.0);
    let difference = align(None).difference(&rigid);
    assert!(difference.window.is_nan() && difference.impulse_error_percent.is_finite());
}

#[test]
fn histories_without_a_contact_are_refused() {
    let align = |raw: &[(f64, f64)], threshold, shift| {
        MeasuredForce::align("file".to_owned(), raw, threshold, shift).unwrap_err()
    };
    let rising = [(0.0, 0.0), (1.0, 2.0), (2.0, 0.0)];
    let wide = align(&rising, 1.0, None);
    assert_eq!(wide, MeasuredForceError::Threshold { threshold: 1.0 });
    let late = align(&rising, 0.1, Some(1.5));
    assert!(matches!(late, MeasuredForceError::FirstContact { .. }));
    for none in [&[][..], &[(0.0, -1.0), (1.0, 0.0)][..]] {
        let refused = align(none, 0.1, None);
        assert!(matches!(refused, MeasuredForceError::NoForce { .. }));
    }
}
