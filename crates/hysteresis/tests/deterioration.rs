//! The deteriorating laws of Ibarra, Medina and Krawinkler on paths worked out by
//! hand from the rules of the paper.
use pounding_hysteresis::laboratory::{LaboratoryPoint, history};
use pounding_hysteresis::{HysteresisError, LawParameters, build};

/// Envelope: slope 100 to (0.01, 1), 5 to (0.03, 1.1), -10 to (0.12, 0.2), then 0.2.
fn run(rule: &str, more: &[(&str, f64)], path: &[f64]) -> Vec<LaboratoryPoint> {
    let mut parameters = LawParameters::from_pairs(&[
        ("stiffness", 100.0),
        ("yield_force", 1.0),
        ("hardening_ratio", 0.05),
        ("capping_deformation", 0.03),
        ("softening_ratio", 0.1),
        ("residual_ratio", 0.2),
    ]);
    for (name, value) in more {
        parameters = parameters.with(name, *value);
    }
    let name = format!("ibarra_medina_krawinkler_2005_{rule}");
    history(build(&name, &parameters).unwrap().as_ref(), path, 1.0)
}

fn follows(rule: &str, more: &[(&str, f64)], steps: &[(f64, f64)]) {
    let path: Vec<f64> = steps.iter().map(|s| s.0).collect();
    for (point, (x, force)) in run(rule, more, &path).iter().zip(steps) {
        assert!(
            (point.force - force).abs() < 2e-14,
            "{rule} at {x}: {} for {force}",
            point.force
        );
    }
}

const PINCHED: [(&str, f64); 2] = [("pinching_force", 0.3), ("pinching_deformation", 0.4)];

#[test]
fn first_loading_follows_the_envelope_on_both_sides() {
    for (rule, more) in [
        ("bilinear", &[][..]),
        ("peak_oriented", &[]),
        ("pinching", &PINCHED),
    ] {
        for side in [1.0, -1.0] {
            let steps = [
                (0.005, 0.5),
                (0.01, 1.0),
                (0.02, 1.05),
                (0.03, 1.1),
                (0.05, 0.9),
                (0.12, 0.2),
                (0.3, 0.2),
                (0.299, 0.1),
            ];
            let mirrored: Vec<_> = steps.iter().map(|(x, f)| (side * x, side * f)).collect();
            follows(rule, more, &mirrored);
        }
    }
}

#[test]
fn bilinear_rule_moves_between_envelopes_and_keeps_its_strength_limit() {
    // The other hardening line, -0.95 + 5 x, is met where 100 (x - 0.041) = -0.95 + 5 x.
    let met = (4.1 - 0.95) / 95.0;
    follows(
        "bilinear",
        &[],
        &[
            (0.05, 0.9),
            (0.045, 0.4),
            (0.048, 0.7),
            (0.052, 0.88),
            (0.05, 0.68),
            (0.052, 0.88),
            (0.05, 0.68),
            (0.041, -0.22),
        ],
    );
    follows(
        "bilinear",
        &[],
        &[
            (0.05, 0.9),
            (0.041, 0.0),
            (met, -0.95 + 5.0 * met),
            (0.0, -0.95),
            (-0.02, -1.05),
            (-0.0095, 0.0),
            // Not beyond the 0.9 reached on the falling line.
            (0.0, 0.9),
            (0.04, 0.9),
            (0.06, 0.8),
        ],
    );
}

#[test]
fn peak_oriented_rule_heads_for_the_farthest_point() {
    let slope = 1.0 / 0.051;
    let back = 0.9 / (0.05 + 0.0095);
    follows(
        "peak_oriented",
        &[],
        &[
            (0.05, 0.9),
            (0.041, 0.0),
            (0.02, -slope * 0.021),
            (0.021, -slope * 0.021 + 0.1),
            (0.02, -slope * 0.021),
            (-0.01, -1.0),
            (-0.02, -1.05),
            (-0.0095, 0.0),
            (0.02, back * 0.0295),
            (0.05, 0.9),
            (0.06, 0.8),
        ],
    );
}

#[test]
fn pinching_rule_reloads_in_two_legs() {
    // To the untouched side the legs meet at zero deformation, the residual one there.
    let first = 0.3 / 0.029 * 0.019;
    let other = 0.33 / 0.0395 * (0.0114 + 0.0095);
    let second = (1.1 - other) / (0.03 - 0.0114);
    follows(
        "pinching",
        &PINCHED,
        &[
            (0.03, 1.1),
            (0.019, 0.0),
            (0.0095, -0.5 * first),
            (0.0, -first),
            (-0.005, -0.5 * (first + 1.0)),
            (-0.01, -1.0),
            (-0.02, -1.05),
            (-0.0095, 0.0),
            // (1 - 0.4) of the residual 0.019.
            (0.0114, other),
            (0.012, other + 0.0006 * second),
            (0.0119, other + 0.0006 * second - 0.01),
            (0.012, other + 0.0006 * second),
            (0.03, 1.1),
            (0.04, 1.0),
        ],
    );
}

/// Dissipated on (0, 0) - (0.01, 1) - (0.03, 1.1) - zero force.
const EXCURSION: f64 = 0.005 + 0.021 - 0.5 * 1.1 * 1.1 / 100.0;

#[test]
fn the_first_excursion_takes_its_share_of_each_mode() {
    // Capacity 50 Fy xy = 0.5.
    let rate = EXCURSION / (0.5 - EXCURSION);
    let zero = 0.019;
    let target = 0.01;

    // Strength: hardening line of the other side, yield force and slope reduced.
    let (fy, ks) = (1.0 - rate, 5.0 * (1.0 - rate));
    let line = |x: f64| fy * (1.0 - ks / 100.0) + ks * x;
    follows(
        "peak_oriented",
        &[("strength_capacity", 50.0)],
        &[
            (0.03, 1.1),
            (zero, 0.0),
            (-target, -line(target)),
            (-0.02, -line(0.02)),
        ],
    );

    // Cap: the falling line of the other side, 1.4 at zero deformation.
    follows(
        "bilinear",
        &[("capping_capacity", 50.0)],
        &[
            (0.03, 1.1),
            (zero, 0.0),
            (-0.05, -(1.4 * (1.0 - rate) - 0.5)),
        ],
    );

    // Target of the other side moves on.
    let farther = target * (1.0 + rate);
    follows(
        "peak_oriented",
        &[("reloading_capacity", 50.0)],
        &[
            (0.03, 1.1),
            (zero, 0.0),
            (0.0, -(0.95 + 5.0 * farther) * zero / (zero + farther)),
        ],
    );

    // Unloading stiffness, at the turning point itself.
    let unloading = 100.0 * (1.0 - rate);
    follows(
        "bilinear",
        &[("unloading_capacity", 50.0)],
        &[(0.03, 1.1), (0.025, 1.1 - 0.005 * unloading)],
    );

    // The exponent.
    let squared = 100.0 * (1.0 - rate * rate);
    follows(
        "bilinear",
        &[
            ("unloading_capacity", 50.0),
            ("deterioration_exponent", 2.0),
        ],
        &[(0.03, 1.1), (0.025, 1.1 - 0.005 * squared)],
    );
}

#[test]
fn a_second_excursion_counts_what_the_first_has_used() {
    let first = EXCURSION / (0.5 - EXCURSION);
    let (fy, ks) = (1.0 - first, 5.0 * (1.0 - first));
    let start = fy * (1.0 - ks / 100.0);
    // Bilinear: from 0.019 down to -start + ks x, on to -0.02, and back to zero.
    let met = (1.9 - start) / (100.0 - ks);
    let low = start + 0.02 * ks;
    let zero = -0.02 + low / 100.0;
    let at_met = start - ks * met;
    let second = 0.5 * at_met * (0.019 - met) + 0.5 * (at_met + low) * (met + 0.02)
        - 0.5 * low * low / 100.0;
    let rate = second / (0.5 - EXCURSION - second);
    let fy = 1.0 - rate;
    let line = |x: f64| fy * (1.0 - 5.0 * fy / 100.0) + 5.0 * fy * x;
    follows(
        "bilinear",
        &[("strength_capacity", 50.0)],
        &[
            (0.03, 1.1),
            (0.019, 0.0),
            (met, -at_met),
            (-0.02, -low),
            (zero, 0.0),
            (0.01, line(0.01)),
        ],
    );
}

#[test]
fn the_unloading_stiffness_falls_at_turning_points_of_reloading_too() {
    let first = 100.0 * (1.0 - EXCURSION / (0.5 - EXCURSION));
    let zero = 0.03 - 1.1 / first;
    // Put in, and dissipated at the first turning point.
    let work = 0.005 + 0.021;
    let before = work - 1.21 / (2.0 * first);
    // Halfway to the target (-0.01, -1) of the other side.
    let force = (zero + 0.005) / (zero + 0.01);
    let dissipated = before + 0.5 * force * (zero + 0.005) - force * force / (2.0 * first);
    let second = first * (1.0 - (dissipated - before) / (0.5 - dissipated));
    follows(
        "peak_oriented",
        &[("unloading_capacity", 50.0)],
        &[
            (0.03, 1.1),
            (zero, 0.0),
            (-0.005, -force),
            (-0.004, -force + 0.001 * second),
        ],
    );
}

/// The rule of Ibarra, Medina and Krawinkler names load reversals in the inelastic range: one at the
/// target or right before it is like one beyond it.
#[test]
fn repeated_cycles_deteriorate_as_growing_ones_do() {
    for law in ["peak_oriented", "pinching"] {
        for reloading in [0.0, 30.0] {
            let dissipated = |growth: f64| {
                let path: Vec<f64> = (0..20)
                    .flat_map(|k| [1.0, -1.0].map(|side| side * (0.03 + growth * f64::from(k))))
                    .collect();
                let mut set = vec![
                    ("unloading_capacity", 30.0),
                    ("reloading_capacity", reloading),
                ];
                if law == "pinching" {
                    set.extend(PINCHED);
                }
                run(law, &set, &path).last().unwrap().dissipated
            };
            let constant = dissipated(0.0);
            for growth in [1e-9, -1e-9] {
                let other = dissipated(growth);
                assert!(
                    (other / constant - 1.0).abs() < 1e-5,
                    "{law}, {reloading}: {other} for {constant}"
                );
            }
        }
    }
}

/// As its capacity runs out the published stiffness falls to zero, which would give back any energy.
#[test]
fn no_turning_point_gives_back_more_than_was_put_in() {
    // Weyl's sequence of the golden section: amplitudes without a pattern.
    let share = |k: usize| (k as f64 * 0.618_033_988_749_895).fract();
    let mut least: f64 = 1.0;
    for law in ["bilinear", "peak_oriented", "pinching"] {
        for case in 0..200 {
            let mut set = vec![("unloading_capacity", 2.0 + 13.0 * share(case + 1))];
            if law == "pinching" {
                set.extend(PINCHED);
            }
            let turning: Vec<f64> = (0..30)
                .map(|k| (0.1 * share(7 * case + k + 3) + 0.005) * [1.0, -1.0][k % 2])
                .collect();
            let mut path = Vec::new();
            let mut from = 0.0;
            for to in &turning {
                path.extend((1..=20).map(|i| from + (to - from) * f64::from(i) / 20.0));
                from = *to;
            }
            let points = run(law, &set, &path);
            let mut before = 0.0;
            for (i, point) in points.iter().enumerate() {
                assert!(
                    point.dissipated >= before - 1e-15,
                    "{law}, case {case}, point {i}: {} after {before}",
                    point.dissipated
                );
                if i % 20 == 19 {
                    before = point.dissipated;
                    least = least.min(point.force.abs());
                }
            }
        }
    }
    // Elements failed on the way.
    assert_eq!(least, 0.0);
}

/// An unloading stiffness below the hardening one: the elastic line ends at the residual force, and the path goes on along
/// that to the hardening line, `0.7 + 30 x` by hand; no line passes through the envelope, and no force leaps.
#[test]
fn a_flat_elastic_line_ends_at_the_residual_force() {
    let set = |hardening: f64, unloading: f64| {
        [
            ("hardening_ratio", hardening),
            ("capping_deformation", 0.05),
            ("softening_ratio", 0.3),
            ("unloading_capacity", unloading),
        ]
    };
    // From one turning point to the next in 1000 steps.
    let path = |turning: &[f64]| {
        let from = [&[0.0], turning].concat();
        let legs = from.into_iter().zip(turning.to_vec());
        let points = legs.flat_map(|(from, to)| {
            (1..=1000).map(move |i| from + (to - from) * f64::from(i) / 1e3)
        });
        points.collect::<Vec<f64>>()
    };
    for unloading in [38.0, 39.0, 40.0, 41.0, 42.0, 50.0] {
        let way = path(&[0.045, -0.099, 0.045]);
        let points = run("bilinear", &set(0.3, unloading), &way);
        let most = points.iter().map(|p| p.force.abs()).fold(0.0, f64::max);
        assert!((most - 2.2).abs() < 5e-3, "{unloading}: {most}");
        let (x, force) = (points[2894].deformation, points[2894].force);
        assert!((x - 0.02988).abs() < 1e-12);
        assert!(
            (force - (0.7 + 30.0 * x)).abs() < 1e-12,
            "{unloading}: {force}"
        );
    }
    let share = |k: usize| (k as f64 * 0.618_033_988_749_895).fract();
    for law in ["bilinear", "peak_oriented", "pinching"] {
        for case in 0..100 {
            let turning: Vec<f64> = (0..12)
                .map(|k| (0.1 * share(7 * case + k + 3) + 0.005) * [1.0, -1.0][k % 2])
                .collect();
            let mut set = set(0.1 + 0.3 * share(case), 10.0 + 60.0 * share(3 * case)).to_vec();
            if law == "pinching" {
                set.extend(PINCHED);
            }
            let points = run(law, &set, &path(&turning));
            let mut before = (0.0, 0.0);
            for point in points {
                let has_failed = point.force == 0.0;
                let leap = (point.force - before.1).abs();
                let way = (point.deformation - before.0).abs();
                assert!(
                    has_failed || leap <= 100.0 * way * (1.0 + 1e-9) + 1e-12,
                    "{law}, case {case} at {}: {leap}",
                    point.deformation
                );
                before = (point.deformation, point.force);
            }
        }
    }
}

#[test]
fn exhausted_elements_carry_nothing_ever_after() {
    // Capacity 0.03 < 2 EXCURSION: fails on crossing zero force.
    let points = run(
        "peak_oriented",
        &[("strength_capacity", 3.0)],
        &[0.03, 0.02, 0.0, -0.05, 0.1, 0.0],
    );
    assert!(points[1].force > 0.0);
    assert!(points[2..].iter().all(|p| p.force == 0.0));
    assert!((points[5].dissipated - EXCURSION).abs() < 1e-16);
    // Without residual strength the falling line ends in zero at 0.14.
    let points = run(
        "bilinear",
        &[("residual_ratio", 0.0)],
        &[0.13, 0.15, 0.1, -0.1, 0.0],
    );
    assert!((points[0].force - 0.1).abs() < 1e-14);
    assert!(points[1..].iter().all(|p| p.force == 0.0));
}

#[test]
fn a_cap_before_yield_is_refused() {
    let parameters = LawParameters::from_pairs(&[
        ("stiffness", 100.0),
        ("yield_force", 1.0),
        ("capping_deformation", 0.009),
        ("softening_ratio", 0.1),
    ]);
    let error = build("ibarra_medina_krawinkler_2005", &parameters).unwrap_err();
    assert!(matches!(error, HysteresisError::Inconsistent { .. }));
    assert!(error.to_string().contains("yield") && error.help().is_some());
}
