//! The laboratory of impact models: examples, and measured forces.
use pounding_gap_element::laboratory::{
    EXAMPLE_BODIES, EXAMPLE_RESTITUTION, MeasuredForce, MeasuredForceError, Specimen, unit_of,
};
use pounding_gap_element::{Bodies, ModelParameters, collide, registry};

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
    damped.remove_restitution();
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
    let difference = align(Some(0.0)).difference(&computed, 1.5);
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
    let difference = align(None).difference(&rigid, 1.0);
    assert!(difference.window.is_nan() && difference.impulse_error_percent.is_finite());
}

/// A force sampled up to a hundred times as densely begins and ends where it did: below the threshold
/// lie many samples then.
#[test]
fn dense_samples_are_aligned_as_coarse_ones() {
    for name in ["hertz_1882", "hunt_crossley_1975", "linear_elastic"] {
        let mut one = specimen(name, &[]);
        one.fill_from_example();
        let computed = collide(one.build().unwrap().as_ref(), &EXAMPLE_BODIES).unwrap();
        let history = &computed.history;
        let force = |t: f64| {
            let after = history.partition_point(|s| s.time <= t);
            match (after, history.get(after)) {
                (1.., Some(next)) => {
                    let last = &history[after - 1];
                    let part = (t - last.time) / (next.time - last.time);
                    last.force + part * (next.force - last.force)
                }
                _ => 0.0,
            }
        };
        for samples in [40, 400, 4000] {
            let step = computed.duration / f64::from(samples);
            let times = (-10..samples + 10).map(|i| (f64::from(i) + 0.37) * step);
            let raw: Vec<_> = times.map(|t| (t, force(t))).collect();
            let found = MeasuredForce::align(name.to_owned(), &raw, 0.01, None).unwrap();
            let difference = found.difference(&computed, one.exponent());
            let rms = difference.rms_force_difference_percent_of_peak;
            assert!(rms < 0.15, "{name}, {samples}: {difference:?}");
            let late = found.first_contact_of(one.exponent()) / computed.duration;
            assert!(late.abs() < 2e-3, "{name}, {samples}: {late}");
            let end = (found.first_contact + found.contact_time) / computed.duration;
            assert!((end - 1.0).abs() < 0.02, "{name}, {samples}: {end}");
        }
    }
}

/// Chung and Ooi 2011, test 1, two glass spheres: their curve, as read off the figure (us, kN), has
/// 22 samples. With the line of F^(2/3) a right law is 0.2 % of the peak off it, with one of F 5 %.
#[test]
fn first_contact_follows_the_exponent_of_the_law() {
    const CURVE: [(f64, f64); 24] = [
        (0.0, 0.0),
        (2.4402, 0.73743),
        (3.8756, 1.51955),
        (6.2440, 3.12849),
        (8.4689, 4.80447),
        (10.6220, 6.43575),
        (12.6316, 7.88827),
        (14.5694, 9.07263),
        (16.5072, 9.96648),
        (18.4450, 10.52514),
        (19.4498, 10.68156),
        (20.4545, 10.70391),
        (21.4593, 10.63687),
        (22.3206, 10.48045),
        (23.2536, 10.23464),
        (25.1914, 9.47486),
        (27.2010, 8.35754),
        (29.1388, 7.03911),
        (31.2201, 5.45251),
        (33.3732, 3.82123),
        (35.8134, 2.07821),
        (37.1770, 1.27374),
        (38.6124, 0.55866),
        (40.4785, 0.0),
    ];
    let raw: Vec<_> = CURVE.iter().map(|(t, f)| (1e-6 * t, 1e3 * f)).collect();
    let mass = 4.0 / 3.0 * std::f64::consts::PI * 0.010_f64.powi(3) * 2800.0;
    let bodies = Bodies {
        mass_left: mass,
        mass_right: Some(mass),
        velocity_left: 10.0,
        velocity_right: -10.0,
    };
    // Hertz: 48 GPa, Poisson's ratio 0.2, radius 10 mm.
    let stiffness = 4.0 / 3.0 * (48.0e9 / (2.0 * 0.96)) * 0.005_f64.sqrt();
    let one = specimen("hertz_1882", &[("stiffness", stiffness)]);
    assert_eq!(one.exponent(), 1.5);
    let outcome = collide(one.build().unwrap().as_ref(), &bodies).unwrap();
    let curve = MeasuredForce::align("curve".to_owned(), &raw, 0.01, None).unwrap();
    let rms = |exponent| {
        let difference = curve.difference(&outcome, exponent);
        difference.rms_force_difference_percent_of_peak
    };
    assert!(rms(1.5) < 0.2, "{}", rms(1.5));
    assert!((rms(1.0) - 5.256).abs() < 0.01, "{}", rms(1.0));
    // On the line of F^(2/3) through the first two samples.
    let (a, b) = (0.73743_f64.powf(2.0 / 3.0), 1.51955_f64.powf(2.0 / 3.0));
    let expected = 2.4402 - a * (3.8756 - 2.4402) / (b - a);
    assert!((1e6 * curve.first_contact_of(1.5) - expected).abs() < 1e-9);
    // What was given stays.
    let given = MeasuredForce::align("curve".to_owned(), &raw, 0.01, Some(1e-7)).unwrap();
    assert_eq!(given.first_contact_of(1.5), 1e-7);
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

/// A history that begins with the force at two thirds of its peak has lost the beginning of its contact; one with zeros
/// before it, or whose first contact is said to be there, has not.
#[test]
fn a_history_that_begins_in_contact_is_warned_of() {
    let peak = |t: f64| (1.0e6 * (1.0 - (t / 0.01).powi(2))).max(0.0);
    let rows = |from: i32| -> Vec<(f64, f64)> {
        let times = (from..=24).map(|i| f64::from(i) * 5.0e-4);
        times.map(|t| (t, peak(t))).collect()
    };
    let warned = |from: i32, shift| {
        let force = MeasuredForce::align("m".to_owned(), &rows(from), 0.01, shift).unwrap();
        force
            .warnings
            .iter()
            .any(|w| w.contains("begins in contact"))
    };
    assert!(warned(-12, None));
    assert!(warned(-12, Some(-0.0064)));
    assert!(!warned(-22, None));
    assert!(!warned(-12, Some(-0.006)));
}

/// A force that rises like a power of time and whose first samples are missing: the line through the first that are
/// there meets zero several samples before them, and is followed for as
/// long as the force takes to double. The same beside noise before the contact is refused, and says why.
#[test]
fn a_history_cut_shortly_after_its_first_contact() {
    let force = |t: f64| match t > 0.0 && t < 0.02 {
        true => 1.0e6 * (std::f64::consts::PI * t / 0.02).sin().powf(1.5),
        false => 0.0,
    };
    let rows = |from: i32| -> Vec<(f64, f64)> {
        let times = (from..=250).map(|i| f64::from(i) * 1.0e-4);
        times.map(|t| (t, force(t))).collect()
    };
    let align = |rows: &[(f64, f64)]| MeasuredForce::align("m".to_owned(), rows, 0.01, None);
    for from in [10, 15, 20, 40] {
        let cut = align(&rows(from)).unwrap();
        assert!(cut.warnings[0].contains("begins in contact"));
        let first_contact = cut.first_contact_of(1.5);
        let missing = f64::from(from) * 1.0e-4;
        // By no more than the force takes to double.
        let allowed = -0.05 * missing..0.6 * missing;
        assert!(allowed.contains(&first_contact), "{from}: {first_contact}");
    }
    let mut noisy = rows(-200);
    for (i, (_, f)) in noisy.iter_mut().enumerate().take(180) {
        *f = [3.0e4, -2.0e4, 2.6e4, 4.0e4][i % 4];
    }
    let error = align(&noisy).unwrap_err();
    assert!(error.help().contains("--threshold"), "{error}");
}

/// At 1e-160 m/s squares of velocities leave the range of numbers: refused, where a collision at the
/// least velocity returns what it is asked for.
#[test]
fn bodies_that_hardly_move_do_not_collide() {
    let descriptor = registry::find("exact_linear").unwrap();
    let model = registry::build("exact_linear", &descriptor.example_parameters(0.65)).unwrap();
    let at = |velocity_left| {
        collide(
            model.as_ref(),
            &Bodies {
                mass_left: 1e5,
                mass_right: None,
                velocity_left,
                velocity_right: 0.0,
            },
        )
    };
    for velocity in [1e-300, 1e-160, 9e-31] {
        let error = at(velocity).unwrap_err();
        assert!(error.to_string().contains("round-off"), "{error}");
    }
    let returned = at(1e-30).unwrap().restitution;
    assert!((returned - 0.65).abs() < 1e-9, "{returned}");
}
