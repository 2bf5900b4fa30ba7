//! Bad parameters are refused with the reason and a remedy.
use pounding_catalogue::DefinitionError;
use pounding_hysteresis::{HysteresisError, build, descriptors, find};

fn refused(name: &str, changes: &[(&str, f64)]) -> HysteresisError {
    let mut parameters = find(name).unwrap().example_parameters();
    for (parameter, value) in changes {
        parameters = parameters.with(parameter, *value);
    }
    let error = build(name, &parameters).unwrap_err();
    assert!(error.help().is_some(), "{error}");
    error
}

#[test]
fn values_outside_their_range_are_refused_by_name() {
    for (law, parameter, value) in [
        ("bilinear", "yield_force", 0.0),
        ("bilinear", "stiffness", -1.0),
        ("bilinear", "hardening_ratio", -1.0),
        ("bilinear", "hardening_ratio", 1.0),
        ("takeda", "hardening_ratio", -0.01),
        ("modified_clough", "hardening_ratio", -0.01),
        ("ramberg_osgood", "exponent", 1.0),
        ("iwan_six_parameter", "exponent", -1.0),
        ("iwan_six_parameter", "exponent", -1.5),
        ("segalman_2005", "chi", -1.0),
        ("segalman_2005", "chi", 0.1),
        ("song_2004", "residual_ratio", 1.0),
        ("bouc_wen", "exponent", 0.9),
        ("viscous_damper", "exponent", 0.0),
        ("viscous_damper", "transition_velocity", 0.0),
        ("maxwell", "damping", 0.0),
        ("baber_noori_1985", "pinching", 1.0),
        ("linear", "stiffness", f64::NAN),
        ("linear", "stiffness", f64::INFINITY),
    ] {
        match refused(law, &[(parameter, value)]) {
            HysteresisError::Definition(DefinitionError::OutOfRange {
                parameter: named, ..
            }) => assert_eq!(named, parameter),
            other => panic!("{law}: {other}"),
        }
    }
}

#[test]
fn values_that_contradict_one_another_are_refused_with_the_reason() {
    for (law, changes, reason) in [
        ("iwan_six_parameter", &[("phi_1", 2e-4)][..], "phi_1"),
        ("iwan_six_parameter", &[("phi_1", 1e-4)], "phi_1"),
        (
            "iwan_six_parameter",
            &[
                ("density", 0.0),
                ("slider_stiffness", 0.0),
                ("residual_stiffness", 0.0),
            ],
            "initial stiffness",
        ),
        (
            "song_2004",
            &[("phi_1", 1e-3)],
            "phi_1 0.001 m is not below its phi_2 0.0005 m",
        ),
        (
            "song_2004",
            &[("phi_1", 5e-4)],
            "phi_1 0.0005 m is not below",
        ),
        (
            "song_2004",
            &[("stiffness", 1e308)],
            "stiffness = 1e308 N/m, residual_ratio = 0.1",
        ),
        (
            "segalman_2005",
            &[("stiffness", 1e-320)],
            "slip_force = 4000.0 N",
        ),
        ("bouc_wen", &[("gamma", 0.6)], "create energy"),
        ("bouc_wen", &[("gamma", -0.5)], "create energy"),
        (
            "menegotto_pinto_1973",
            &[("curvature", 3.9)],
            "create energy",
        ),
        (
            "gap_hook",
            &[("compression_stiffness", 0.0), ("tension_stiffness", 0.0)],
            "neither",
        ),
    ] {
        let error = refused(law, changes);
        assert!(
            matches!(error, HysteresisError::Inconsistent { .. }),
            "{error}"
        );
        assert!(error.to_string().contains(reason), "{error}");
        // Under its own name, not that of the law that it is a case of.
        assert!(
            error.to_string().starts_with(&format!("law {law}: ")),
            "{error}"
        );
    }
}

#[test]
fn unknown_and_missing_names_are_told() {
    let error = find("bilinaer").unwrap_err();
    assert_eq!(error.help().unwrap(), "did you mean \"bilinear\"?");
    assert!(matches!(
        refused("bilinear", &[("hardening", 0.1)]),
        HysteresisError::Definition(DefinitionError::UnknownParameter { .. })
    ));
    for descriptor in descriptors() {
        for parameter in descriptor.parameters.iter().filter(|p| p.required) {
            let mut parameters = descriptor.example_parameters();
            parameters.values.remove(parameter.name);
            match build(descriptor.name, &parameters).unwrap_err() {
                HysteresisError::Definition(DefinitionError::MissingParameter {
                    parameter: named,
                    ..
                }) => {
                    assert_eq!(named, parameter.name);
                }
                other => panic!("{}: {other}", descriptor.name),
            }
        }
        for alias in descriptor.aliases {
            assert_eq!(find(alias.name).unwrap().name, descriptor.name);
        }
    }
}
