//! Contact stiffness: numbers, integrated collisions, warnings, hostile input.
//!
//! Numbers of Hertz's formula: evaluated in decimals of 30 digits.
use pounding_gap_element::contact_stiffness::{
    Approach, ContactStiffness, ContactStiffnessError, Slab, Sphere, duration, hertz, multiple,
    penetration, slab,
};
use pounding_gap_element::{
    Bodies, CollisionOutcome, ModelParameters, Verification, collide, registry,
};
use proptest::prelude::*;

fn close(value: f64, expected: f64, relative: f64) {
    assert!(
        (value / expected - 1.0).abs() < relative,
        "{value} is not {expected}"
    );
}

fn sphere(radius: f64, elastic_modulus: f64, poisson_ratio: f64) -> Sphere {
    Sphere {
        radius,
        elastic_modulus,
        poisson_ratio,
        density: None,
    }
}

fn steel(radius: f64) -> Sphere {
    sphere(radius, 206e9, 0.28)
}

fn floors() -> Approach {
    Approach::new(0.8, 25e3, Some(40e3)).unwrap()
}

fn warned(result: &ContactStiffness, part: &str) -> bool {
    result.warnings.iter().any(|w| w.contains(part))
}

fn intermediate(result: &ContactStiffness, name: &str) -> f64 {
    let found = result.intermediate.iter().find(|i| i.name == name);
    found.unwrap().value
}

#[test]
fn hertz_of_steel_balls_and_of_a_rubber_ball() {
    let balls = hertz(&steel(0.025), &steel(0.05), None).unwrap();
    close(balls.value, 19_237_909_175.316_547, 1e-10);
    assert_eq!(balls.exponent, 1.5);
    assert_eq!(balls.unit(), "N/m^1.5");
    let rubber = sphere(0.023_670_801_410_2, 8e6, 0.5);
    let floor = sphere(f64::INFINITY, 27.5e9, 0.15);
    let ball = hertz(&rubber, &floor, None).unwrap();
    close(ball.value, 2_187_304.814_760_116, 1e-10);
    close(
        hertz(&floor, &rubber, None).unwrap().value,
        ball.value,
        1e-15,
    );
}

#[test]
fn a_flat_is_the_limit_of_a_large_sphere() {
    let flat = hertz(&steel(0.05), &steel(f64::INFINITY), None).unwrap();
    let large = hertz(&steel(0.05), &steel(1e12), None).unwrap();
    close(flat.value, large.value, 1e-12);
}

#[test]
fn slabs_in_series() {
    let left = Slab {
        elastic_modulus: 30e9,
        area: 1.8,
        length: 20.0,
    };
    let right = Slab {
        elastic_modulus: 25e9,
        area: 1.5,
        length: 15.0,
    };
    // 2.7e9 and 2.5e9 N/m in series: 2.7 * 2.5 / 5.2 e9.
    let result = slab(&left, &right, None).unwrap();
    close(result.value, 6.75e9 / 5.2, 1e-14);
    close(intermediate(&result, "left slab stiffness"), 2.7e9, 1e-15);
    close(intermediate(&result, "right slab stiffness"), 2.5e9, 1e-15);
    assert_eq!(result.unit(), "N/m");
    let halves = slab(&left, &left, None).unwrap();
    close(halves.value, 1.35e9, 1e-15);
}

#[test]
fn a_multiple_of_the_storey_stiffness() {
    let result = multiple(20.0, 3.46e6).unwrap();
    close(result.value, 69.2e6, 1e-15);
    assert_eq!(result.exponent, 1.0);
    assert!(
        matches!(result.status, Verification::SecondarySources(how) if how.contains("rule of thumb"))
    );
}

#[test]
fn effective_mass_of_floors_and_wall() {
    close(floors().effective_mass, 25e3 * 40e3 / 65e3, 1e-15);
    assert_eq!(Approach::new(0.8, 25e3, None).unwrap().effective_mass, 25e3);
    // The product of these masses is no number.
    close(
        Approach::new(0.8, 1e300, Some(1e300))
            .unwrap()
            .effective_mass,
        5e299,
        1e-15,
    );
}

#[test]
fn contact_time_of_a_linear_law_is_half_a_period() {
    let result = duration(0.02, 1.0, floors(), None).unwrap();
    let frequency = std::f64::consts::PI / 0.02;
    close(
        result.value,
        floors().effective_mass * frequency * frequency,
        1e-13,
    );
}

/// `I_n = sqrt(pi) Gamma(1 + 1/(n+1)) / Gamma(1/2 + 1/(n+1))`; the
/// quadrature behind it is good to 1e-11 for powers that are no whole numbers.
#[test]
fn contact_time_of_powers_by_gamma_functions() {
    for (exponent, factor) in [
        (1.0, std::f64::consts::FRAC_PI_2),
        (1.5, 1.471_637_592_162_352_3),
        (2.0, 1.402_182_105_325_454_4),
        (2.5, 1.350_724_530_628_998_8),
    ] {
        let result = penetration(5e-3, exponent, floors(), None, None).unwrap();
        close(
            intermediate(&result, "contact time"),
            2.0 * factor * 5e-3 / 0.8,
            1e-11,
        );
        let back = duration(2.0 * factor * 5e-3 / 0.8, exponent, floors(), None).unwrap();
        close(back.value, result.value, 1e-11);
    }
}

fn integrated(exponent: f64, stiffness: f64) -> CollisionOutcome {
    let name = if exponent == 1.0 {
        "linear_elastic"
    } else {
        "hertz_1882"
    };
    let parameters = ModelParameters::from_pairs(&[("stiffness", stiffness)]);
    let bodies = Bodies {
        mass_left: 25e3,
        mass_right: Some(40e3),
        velocity_left: 0.6,
        velocity_right: -0.2,
    };
    collide(
        registry::build(name, &parameters).unwrap().as_ref(),
        &bodies,
    )
    .unwrap()
}

#[test]
fn integrated_collisions_last_as_long_as_wanted() {
    for exponent in [1.0, 1.5] {
        for wanted in [1e-3, 0.02, 0.3] {
            let result = duration(wanted, exponent, floors(), None).unwrap();
            let outcome = integrated(exponent, result.value);
            close(outcome.duration, wanted, 1e-9);
            close(
                intermediate(&result, "maximum penetration"),
                outcome.peak_penetration,
                1e-9,
            );
            close(
                intermediate(&result, "maximum force"),
                outcome.peak_force,
                1e-9,
            );
        }
    }
}

#[test]
fn integrated_collisions_penetrate_as_far_as_wanted() {
    for exponent in [1.0, 1.5] {
        for wanted in [1e-4, 5e-3, 0.05] {
            let result = penetration(wanted, exponent, floors(), None, None).unwrap();
            let outcome = integrated(exponent, result.value);
            close(outcome.peak_penetration, wanted, 1e-9);
            close(
                intermediate(&result, "contact time"),
                outcome.duration,
                1e-9,
            );
        }
    }
}

#[test]
fn hertz_always_says_that_slabs_are_flat() {
    let result = hertz(&steel(0.025), &steel(0.05), None).unwrap();
    assert_eq!(result.warnings.len(), 1);
    assert!(warned(&result, "flat-on-flat"));
}

/// Contact of balls lasts as `v^(-1/5)`, so that slow ones meet quasi-statically.
#[test]
fn hertz_warns_of_waves_in_fast_collisions_only() {
    let ball = |density| Sphere {
        density,
        ..steel(0.05)
    };
    let mass = 4.11;
    let at = |velocity: f64, density| {
        let approach = Approach::new(velocity, mass, Some(mass)).unwrap();
        hertz(&ball(density), &ball(density), Some(approach)).unwrap()
    };
    assert!(warned(&at(50.0, Some(7850.0)), "waves carry energy"));
    assert!(!warned(&at(0.01, Some(7850.0)), "waves carry energy"));
    assert!(!warned(&at(50.0, None), "waves carry energy"));
    let transit = 0.1 / (206e9_f64 / 7850.0).sqrt();
    close(
        intermediate(&at(50.0, Some(7850.0)), "wave transit time"),
        transit,
        1e-14,
    );
}

#[test]
fn waves_count_in_the_larger_body_and_never_return_from_a_half_space() {
    let dense = |radius| Sphere {
        density: Some(7850.0),
        ..steel(radius)
    };
    let approach = Approach::new(5.0, 0.5, None).unwrap();
    let transit = |left: f64, right: f64| {
        let result = hertz(&dense(left), &dense(right), Some(approach)).unwrap();
        intermediate(&result, "wave transit time")
    };
    close(
        transit(0.025, 0.05),
        2.0 * transit(0.025, f64::INFINITY),
        1e-14,
    );
    close(transit(0.025, 0.05), transit(0.05, 0.025), 1e-14);
}

#[test]
fn hertz_warns_of_a_wide_contact() {
    let at = |velocity: f64| {
        let approach = Approach::new(velocity, 0.05, None).unwrap();
        let (ball, floor) = (
            sphere(0.0237, 8e6, 0.5),
            sphere(f64::INFINITY, 27.5e9, 0.15),
        );
        hertz(&ball, &floor, Some(approach)).unwrap()
    };
    assert!(warned(&at(2.0), "no half-spaces"));
    assert!(!warned(&at(0.01), "no half-spaces"));
}

#[test]
fn slab_warns_of_a_stiffness_near_that_of_the_storeys() {
    let side = Slab {
        elastic_modulus: 30e9,
        area: 1.8,
        length: 20.0,
    };
    let with = |storey| slab(&side, &side, storey).unwrap();
    for result in [with(None), with(Some(1e6)), with(Some(1e9))] {
        assert!(warned(&result, "linear laws only"));
    }
    // 1.35e9 N/m is five times 2.7e8 N/m.
    assert!(warned(&with(Some(2.71e8)), "softer than customary"));
    assert!(!warned(&with(Some(2.69e8)), "softer than customary"));
    assert!(!warned(&with(None), "softer than customary"));
}

#[test]
fn duration_warns_of_velocity_and_damping() {
    let with = |exponent, restitution| duration(0.02, exponent, floors(), restitution).unwrap();
    assert!(warned(&with(1.5, None), "at 0.8 m/s only"));
    assert!(!warned(&with(1.0, None), "at 0.8 m/s only"));
    assert!(warned(&with(1.0, None), "without damping"));
    assert!(warned(&with(1.0, Some(0.65)), "without damping"));
    assert!(with(1.0, Some(1.0)).warnings.is_empty());
}

#[test]
fn penetration_warns_of_damping_and_of_the_gap() {
    let with = |restitution, gap| penetration(5e-3, 1.5, floors(), restitution, gap).unwrap();
    assert!(warned(&with(None, None), "penetrates less"));
    assert!(warned(&with(Some(0.65), None), "penetrates less"));
    assert!(warned(&with(Some(1.0), Some(4e-3)), "exceeds the gap"));
    assert!(with(Some(1.0), Some(5e-3)).warnings.is_empty());
    assert!(with(Some(1.0), None).warnings.is_empty());
}

/// The warning itself is true: damped laws of both exponents penetrate less.
#[test]
fn damped_laws_do_penetrate_less() {
    let bodies = Bodies {
        mass_left: 25e3,
        mass_right: Some(40e3),
        velocity_left: 0.8,
        velocity_right: 0.0,
    };
    for (name, exponent) in [
        ("anagnostopoulos_2004", 1.0),
        ("mahmoud_jankowski_2011", 1.0),
        ("jankowski_2005", 1.5),
        ("muthukumar_desroches_2006", 1.5),
    ] {
        let stiffness = penetration(5e-3, exponent, floors(), Some(0.65), None)
            .unwrap()
            .value;
        let parameters =
            ModelParameters::from_pairs(&[("stiffness", stiffness), ("restitution", 0.65)]);
        let model = registry::build(name, &parameters).unwrap();
        let peak = collide(model.as_ref(), &bodies).unwrap().peak_penetration;
        assert!(peak < 0.99 * 5e-3, "{name} penetrates {peak} m");
    }
}

#[test]
fn multiple_warns_outside_the_range_in_use() {
    for (factor, outside) in [
        (9.9, true),
        (10.0, false),
        (20.0, false),
        (100.0, false),
        (101.0, true),
    ] {
        let result = multiple(factor, 3.46e6).unwrap();
        assert_eq!(warned(&result, "range in use"), outside, "{factor}");
    }
}

#[test]
fn the_line_for_a_case_file_keeps_all_digits() {
    let result = hertz(&steel(0.025), &steel(0.05), None).unwrap();
    let line = result.case_line();
    let number = line.strip_prefix("stiffness = \"").unwrap();
    let number = number.strip_suffix(" N/m^1.5\"").unwrap();
    assert_eq!(number.parse::<f64>().unwrap(), result.value);
    assert_eq!(
        multiple(20.0, 3.5e6).unwrap().case_line(),
        "stiffness = \"7e7 N/m\""
    );
}

const BAD: [f64; 5] = [0.0, -1.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY];

#[test]
fn bad_values_are_refused() {
    let good = steel(0.05);
    let side = Slab {
        elastic_modulus: 30e9,
        area: 1.8,
        length: 20.0,
    };
    for bad in BAD {
        if bad != f64::INFINITY {
            assert!(hertz(&steel(bad), &good, None).is_err());
        }
        assert!(hertz(&sphere(0.05, bad, 0.2), &good, None).is_err());
        assert!(hertz(&good, &sphere(0.05, bad, 0.2), None).is_err());
        let density = Some(bad);
        assert!(hertz(&Sphere { density, ..good }, &good, None).is_err());
        let crooked = Approach {
            velocity: bad,
            effective_mass: 1.0,
        };
        assert!(hertz(&good, &good, Some(crooked)).is_err());
        for slabs in [
            Slab {
                elastic_modulus: bad,
                ..side
            },
            Slab { area: bad, ..side },
            Slab {
                length: bad,
                ..side
            },
        ] {
            assert!(slab(&slabs, &side, None).is_err());
            assert!(slab(&side, &slabs, None).is_err());
        }
        assert!(slab(&side, &side, Some(bad)).is_err());
        assert!(duration(bad, 1.0, floors(), None).is_err());
        assert!(duration(0.02, bad, floors(), None).is_err());
        assert!(duration(0.02, 1.0, crooked, None).is_err());
        assert!(duration(0.02, 1.0, floors(), Some(bad)).is_err());
        assert!(penetration(bad, 1.0, floors(), None, None).is_err());
        assert!(penetration(0.02, bad, floors(), None, None).is_err());
        assert!(penetration(0.02, 1.0, crooked, None, None).is_err());
        assert!(penetration(0.02, 1.0, floors(), Some(bad), None).is_err());
        assert!(penetration(0.02, 1.0, floors(), None, Some(bad)).is_err());
        assert!(multiple(bad, 1e6).is_err());
        assert!(multiple(20.0, bad).is_err());
        assert!(Approach::new(bad, 1.0, None).is_err());
        assert!(Approach::new(1.0, bad, Some(1.0)).is_err());
        assert!(Approach::new(1.0, 1.0, Some(bad)).is_err());
    }
    for ratio in [-1.0, 0.500_001, f64::NAN, f64::INFINITY] {
        let error = hertz(&sphere(0.05, 206e9, ratio), &good, None).unwrap_err();
        assert!(matches!(error, ContactStiffnessError::OutOfRange { .. }));
    }
}

#[test]
fn errors_say_what_to_do() {
    let flat = steel(f64::INFINITY);
    let error = hertz(&flat, &flat, None).unwrap_err();
    assert_eq!(error, ContactStiffnessError::BothFlat);
    assert!(error.help().contains("stiffness slab"));
    let error = duration(0.02, 0.5, floors(), None).unwrap_err();
    assert_eq!(error.to_string(), "exponent = 0.5 is outside [1, 5]");
    assert!(error.help().contains("linear"));
    let error = duration(0.02, 1.0, floors(), Some(1.2)).unwrap_err();
    assert!(error.help().contains("restitution"));
    let error = hertz(&sphere(1.0, 1e9, 0.6), &flat, None).unwrap_err();
    assert!(error.help().contains("concrete"));
    let error = multiple(20.0, -1.0).unwrap_err();
    assert!(error.to_string().contains("storey stiffness = -1 N/m"));
    assert!(error.help().contains("unit"));
}

#[test]
fn results_that_are_no_numbers_are_refused() {
    for error in [
        penetration(1e-200, 1.0, floors(), None, None).unwrap_err(),
        penetration(1e200, 1.0, floors(), None, None).unwrap_err(),
        multiple(1e200, 1e200).unwrap_err(),
    ] {
        assert!(
            matches!(error, ContactStiffnessError::NotRepresentable { .. }),
            "{error}"
        );
    }
}

proptest! {
    /// Any magnitude gives a usable number or an error, never a panic, a NaN or zero.
    #[test]
    fn any_magnitude_gives_a_number_or_an_error(a in -320.0..308.0_f64, b in -320.0..308.0_f64, c in -320.0..308.0_f64, n in 0.0..12.0_f64) {
        let (a, b, c) = (10_f64.powf(a), 10_f64.powf(b), 10_f64.powf(c));
        let approach = Approach { velocity: a, effective_mass: b };
        let ball = Sphere { radius: a, elastic_modulus: b, poisson_ratio: 0.3, density: Some(c) };
        let side = Slab { elastic_modulus: a, area: b, length: c };
        for result in [
            hertz(&ball, &steel(c), Some(approach)),
            slab(&side, &side, Some(a)),
            duration(c, n, approach, None),
            penetration(c, n, approach, None, Some(a)),
            multiple(a, b),
        ].into_iter().flatten() {
            prop_assert!(result.value.is_normal() && result.value > 0.0);
            prop_assert!(result.intermediate.iter().all(|i| i.value.is_normal() && i.value > 0.0));
        }
    }
}

/// A case line is one that impact models take: exponents up to theirs, and with the exponent where
/// it is not that of linear laws or of Hertz.
#[test]
fn the_line_for_a_case_file_has_the_exponent() {
    let error = duration(0.02, 8.0, floors(), None).unwrap_err();
    assert_eq!(error.to_string(), "exponent = 8 is outside [1, 5]");
    assert!(error.help().contains("from 1 to 5"), "{}", error.help());
    let result = penetration(5e-3, 2.0, floors(), None, None).unwrap();
    let line = result.case_line();
    let (stiffness, exponent) = line.split_once('\n').unwrap();
    assert!(stiffness.ends_with(" N/m^2\""), "{line}");
    assert_eq!(exponent, "exponent = 2");
    let parameters = ModelParameters::from_pairs(&[
        ("stiffness", result.value),
        ("exponent", 2.0),
        ("restitution", 1.0),
    ]);
    let model = registry::build("exact_hunt_crossley", &parameters).unwrap();
    let bodies = Bodies {
        mass_left: floors().effective_mass,
        mass_right: None,
        velocity_left: floors().velocity,
        velocity_right: 0.0,
    };
    let peak = collide(model.as_ref(), &bodies).unwrap().peak_penetration;
    assert!((peak / 5e-3 - 1.0).abs() < 1e-9, "{peak}");
    for n in [1.0, 5.0] {
        let line = duration(0.02, n, floors(), None).unwrap().case_line();
        assert_eq!(line.contains("exponent"), n == 5.0, "{line}");
    }
}
