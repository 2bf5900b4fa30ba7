//! The search for Papi and Toopchi-Nezhad's `alpha`, against roots of the closed form
//! in 30 digits and an independent integration of the drop test.
use pounding_gap_element::calibration::{
    CalibrationError, DropTest, calibrate, free_alpha, rule_alpha,
};
use pounding_gap_element::published::papi_toopchi_2022::DROP_TEST;
use pounding_gap_element::{ModelParameters, registry};
use serde_json::Value;

fn data() -> Value {
    serde_json::from_str(include_str!("data/impact_models.json")).unwrap()
}

#[test]
fn the_free_optimum_agrees_with_its_reference_row() {
    let data = data();
    let row = data["exact_inverse"]["alpha_papi_exact"]
        .as_array()
        .unwrap();
    let mut compared = 0;
    for (index, expected) in row.iter().enumerate() {
        // At 1 there is none.
        let Some(expected) = expected.as_f64() else {
            continue;
        };
        let e = data["exact_inverse"]["e"][index].as_f64().unwrap();
        let alpha = free_alpha(e).unwrap();
        assert!((alpha - expected).abs() < 1e-9, "{e}: {alpha}");
        // The search finds it too, where nothing but the contact acts.
        let searched = calibrate(&DROP_TEST.free(), e, 1e-11).unwrap();
        assert!(
            (searched.found.alpha - expected).abs() < 1e-9,
            "{searched:?}"
        );
        assert!((searched.free.achieved - e).abs() < 1e-11, "{searched:?}");
        compared += 1;
    }
    assert_eq!(compared, 9);
}

/// With the free optimum the law is the exact member of the class.
#[test]
fn the_free_optimum_is_the_exact_member() {
    for e in [0.05, 0.35, 0.65, 0.95] {
        let exact = ModelParameters::from_pairs(&[
            ("stiffness", DROP_TEST.stiffness),
            ("restitution", e),
            ("exponent", 1.0),
        ]);
        let exact = registry::build("exact_hunt_crossley", &exact).unwrap();
        let shown = DROP_TEST.restitution(exact.as_ref()).unwrap();
        let alpha = free_alpha(e).unwrap();
        let same = DROP_TEST.restitution_with(e, alpha).unwrap();
        assert!((shown - same).abs() < 1e-12, "{e}: {shown} {same}");
    }
}

#[test]
fn the_search_meets_the_request_in_the_drop_test() {
    for tenth in 1..=9 {
        let e = f64::from(tenth) / 10.0;
        let found = calibrate(&DROP_TEST, e, 1e-10).unwrap();
        let last = *found.steps.last().unwrap();
        assert_eq!(
            (last.alpha, last.achieved),
            (found.found.alpha, found.found.achieved)
        );
        assert!((last.achieved - e).abs() <= 1e-10, "{found:?}");
        assert!(found.steps.len() < 30, "{} collisions", found.steps.len());
        assert_eq!(found.rule.alpha, rule_alpha(e));
        // Gravity and the late reading take speed away, so more is asked for.
        assert!(found.found.alpha > found.free.alpha, "{found:?}");
        assert!(found.found.achieved_in_free_collision > e);
    }
}

/// Where almost nothing comes back: without an `alpha` the body would creep out of the contact. In
/// the drop test against roots of an independent integration (Radau in SciPy, tolerance 1e-12).
#[test]
fn the_search_meets_small_restitutions() {
    for (e, expected) in [(0.01, 0.018000824406), (0.03, 0.050493499891)] {
        let found = calibrate(&DROP_TEST, e, 1e-10).unwrap();
        assert!((found.found.alpha - expected).abs() < 1e-9, "{found:?}");
        assert!(found.steps.len() < 30, "{} collisions", found.steps.len());
    }
    for e in [0.01, 0.003] {
        let found = calibrate(&DROP_TEST.free(), e, 1e-11).unwrap();
        assert!((found.found.alpha - free_alpha(e).unwrap()).abs() < 1e-8);
    }
}

#[test]
fn rigid_tolerances_and_impossible_requests_are_located() {
    let refused =
        |test: &DropTest, e: f64, tolerance: f64| calibrate(test, e, tolerance).unwrap_err();
    // Elastic, the reading shows 0.9908: no damping gives more.
    let error = refused(&DROP_TEST, 0.995, 1e-10);
    let CalibrationError::NoRoot {
        achieved_high,
        high,
        ..
    } = error
    else {
        panic!("{error}");
    };
    assert!((achieved_high - 0.990764).abs() < 1e-5 && high > 1e5);
    assert!(error.help().unwrap().contains("leaves the slab"));
    for (e, name) in [
        (0.0, "restitution"),
        (1.0, "restitution"),
        (f64::NAN, "restitution"),
    ] {
        let error = refused(&DROP_TEST, e, 1e-10);
        assert!(error.to_string().contains(name), "{error}");
    }
    assert!(
        refused(&DROP_TEST, 0.5, 0.0)
            .to_string()
            .contains("tolerance")
    );
    let negative = DropTest {
        mass: -1.0,
        ..DROP_TEST
    };
    assert!(
        refused(&negative, 0.5, 1e-10)
            .to_string()
            .contains("mass = -1 kg")
    );
    let early = DropTest {
        read_at: Some(1e-5),
        ..DROP_TEST
    };
    assert!(matches!(
        refused(&early, 0.5, 1e-10),
        CalibrationError::NoRoot { .. }
    ));
    let late = DropTest {
        read_at: Some(1.0),
        ..DROP_TEST
    };
    assert!(matches!(
        refused(&late, 0.5, 1e-10),
        CalibrationError::FallsBack { .. }
    ));
}

/// Below 1 mm/s the law divides by 1 mm/s, and is damped so little that no `alpha` shows 0.5: the error
/// says so, and not that the rebound be read elsewhere. From there on the free optimum is found.
#[test]
fn a_drop_test_slower_than_the_law_divides_by() {
    let slow = DropTest {
        approach_velocity: 1.0e-4,
        ..DROP_TEST
    };
    let error = calibrate(&slow.free(), 0.5, 1e-10).unwrap_err();
    assert!(matches!(error, CalibrationError::TooSlow { .. }), "{error}");
    let help = error.help().unwrap();
    assert!(help.contains("0.001 m/s or more"), "{help}");
    assert!(slow.is_below_floor());
    let least = DropTest {
        approach_velocity: 1.0e-3,
        ..DROP_TEST
    };
    assert!(!least.is_below_floor());
    let found = calibrate(&least.free(), 0.5, 1e-10).unwrap();
    assert!((found.found.alpha - free_alpha(0.5).unwrap()).abs() < 1e-8);
}
