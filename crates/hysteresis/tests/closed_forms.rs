//! Laws on paths that can be worked out by hand from their rules.
use pounding_hysteresis::laboratory::{Cycling, cycle_dissipation, history};
use pounding_hysteresis::{HysteresisLaw, LawParameters, Motion, build};

fn law(name: &str, parameters: &[(&str, f64)]) -> Box<dyn HysteresisLaw> {
    build(name, &LawParameters::from_pairs(parameters)).unwrap()
}

/// Forces along a path against expected ones, to `1e-13` of the maximum.
fn follows(law: &dyn HysteresisLaw, steps: &[(f64, f64)]) {
    let path: Vec<f64> = steps.iter().map(|s| s.0).collect();
    let maximum = steps.iter().fold(0.0_f64, |m, s| m.max(s.1.abs()));
    for (point, (x, force)) in history(law, &path, 1.0).iter().zip(steps) {
        assert!(
            (point.force - force).abs() < 1e-13 * maximum,
            "{} at {x}: {} for {force}",
            law.descriptor().name,
            point.force
        );
    }
}

const YIELDING: [(&str, f64); 3] = [
    ("stiffness", 100.0),
    ("yield_force", 1.0),
    ("hardening_ratio", 0.05),
];

/// The backbone of [`YIELDING`]: slope 100 to 0.01, then 5.
fn backbone(x: f64) -> f64 {
    1.0 + 5.0 * (x - 0.01)
}

#[test]
fn bilinear_law_yields_on_two_parallel_lines() {
    let law = law("bilinear", &YIELDING);
    let top = backbone(0.03);
    follows(
        law.as_ref(),
        &[
            (0.005, 0.5),
            (0.03, top),
            (0.02, top - 1.0),
            (0.025, top - 0.5),
            (0.04, backbone(0.04)),
            // The lower line is the upper one less twice (1 - 0.05).
            (-0.03, -backbone(0.03)),
            (0.0, 0.95),
        ],
    );
    // 4 (1-r) Fy (A - xy), Fy = 1, xy = 0.01, r = 0.05.
    for (amplitude, expected) in [
        (0.01, 0.0),
        (0.03, 4.0 * 0.95 * 0.02),
        (0.1, 4.0 * 0.95 * 0.09),
    ] {
        let cycle = cycle_dissipation(law.as_ref(), amplitude, Cycling::default());
        assert!((cycle - expected).abs() < 1e-14, "{amplitude}: {cycle}");
    }
}

#[test]
fn plastic_and_friction_laws_hold_their_force() {
    let plastic = law(
        "elastic_perfectly_plastic",
        &[("stiffness", 100.0), ("yield_force", 1.0)],
    );
    let friction = law(
        "coulomb_friction",
        &[("sticking_stiffness", 100.0), ("friction_force", 1.0)],
    );
    for law in [plastic, friction] {
        follows(
            law.as_ref(),
            &[
                (0.03, 1.0),
                (0.025, 0.5),
                (0.03, 1.0),
                (0.01, -1.0),
                (0.02, 0.0),
                (0.1, 1.0),
            ],
        );
        let cycle = cycle_dissipation(law.as_ref(), 0.05, Cycling::default());
        assert!((cycle - 4.0 * (0.05 - 0.01)).abs() < 1e-14, "{cycle}");
    }
}

#[test]
fn peak_oriented_and_clough_laws_aim_at_the_farthest_point() {
    let top = backbone(0.03);
    // Unloading with 100 reaches zero force here.
    let zero = 0.03 - top / 100.0;
    // The other side never yielded: its target is (-0.01, -1).
    let slope = 1.0 / (zero + 0.01);
    let common = [
        (0.03, top),
        (0.025, top - 0.5),
        (zero, 0.0),
        (0.0, -slope * zero),
        (-0.01, -1.0),
        (-0.02, -backbone(0.02)),
    ];
    let low = backbone(0.02);
    let zero_low = -0.02 + low / 100.0;
    let reload = top / (0.03 - zero_low);
    // Reloading towards (0.03, top), a small unloading at 0.01, back up.
    let at = reload * (0.01 - zero_low);
    let dip = at - 0.3;
    let clough = law("modified_clough", &YIELDING);
    let retraced = [
        (0.01, at),
        (0.007, dip),
        (0.0085, dip + 0.15),
        (0.01, at),
        (0.02, reload * (0.02 - zero_low)),
        (0.04, backbone(0.04)),
    ];
    follows(clough.as_ref(), &[&common[..], &retraced[..]].concat());
    let peak = law("peak_oriented", &YIELDING);
    let direct = (top - dip) / (0.03 - 0.007);
    let aimed = [
        (0.01, at),
        (0.007, dip),
        (0.01, dip + direct * 0.003),
        (0.03, top),
        (0.04, backbone(0.04)),
    ];
    follows(peak.as_ref(), &[&common[..], &aimed[..]].concat());
}

#[test]
fn takeda_law_unloads_softer_and_reloads_to_a_nearer_target() {
    let mut parameters = YIELDING.to_vec();
    parameters.extend([("unloading_exponent", 0.5), ("reloading_factor", 0.25)]);
    let law = law("takeda", &parameters);
    // Ductility 4: half the stiffness.
    let top = backbone(0.04);
    let zero = 0.04 - top / 50.0;
    let slope = 1.0 / (zero + 0.01);
    let low = backbone(0.0225);
    // Ductility 2.25: two thirds of the stiffness.
    let zero_low = -0.0225 + low / (100.0 / 1.5);
    // The target lies a quarter of 0.03 before the peak.
    let target = 0.04 - 0.25 * 0.03;
    let reload = backbone(target) / (target - zero_low);
    follows(
        law.as_ref(),
        &[
            (0.04, top),
            (0.03, top - 0.5),
            (0.0, -slope * zero),
            (-0.0225, -low),
            (zero_low, 0.0),
            (0.02, reload * (0.02 - zero_low)),
            (target, backbone(target)),
            (0.036, backbone(0.036)),
            // The unloading stiffness is still that of the farthest point.
            (0.03, backbone(0.036) - 0.3),
            (0.05, backbone(0.05)),
        ],
    );
}

#[test]
fn takeda_law_whose_target_lies_behind_rises_with_the_unloading_stiffness() {
    let mut parameters = YIELDING.to_vec();
    parameters.extend([("unloading_exponent", 0.0), ("reloading_factor", 0.9)]);
    let law = law("takeda", &parameters);
    let top = backbone(0.1);
    let zero = 0.1 - top / 100.0;
    let aim = 1.0 / (zero + 0.01);
    // A small loop below zero force next to the peak; the target (0.019) is behind.
    let (turn, force) = (zero - 0.001, -aim * 0.001);
    let again = turn - force / 100.0;
    let meets = again + (backbone(again)) / (100.0 - 5.0);
    follows(
        law.as_ref(),
        &[
            (0.1, top),
            (turn, force),
            (again, 0.0),
            (again + 0.002, 0.2),
            (meets, backbone(meets)),
            (meets + 0.001, backbone(meets + 0.001)),
        ],
    );
}

#[test]
fn origin_oriented_law_returns_through_zero_and_keeps_sides_apart() {
    let law = law("origin_oriented", &YIELDING);
    let top = backbone(0.03);
    let secant = top / 0.03;
    follows(
        law.as_ref(),
        &[
            (0.03, top),
            (0.01, secant * 0.01),
            (-0.01, -1.0),
            (-0.02, -backbone(0.02)),
            (0.02, secant * 0.02),
            (0.05, backbone(0.05)),
        ],
    );
    // Area under the backbone less the triangle to the origin.
    let path = history(law.as_ref(), &[0.03, 0.0, 0.02, 0.0], 1.0);
    let area = 0.5 * 0.01 + 0.5 * (1.0 + top) * 0.02;
    for point in path {
        assert!((point.dissipated - (area - 0.5 * top * 0.03)).abs() < 1e-15);
    }
}

#[test]
fn ramberg_osgood_backbone_and_cycle_satisfy_their_equations() {
    let (alpha, n) = (0.5, 7.0);
    let parameters = [
        ("stiffness", 100.0),
        ("yield_force", 1.0),
        ("alpha", alpha),
        ("exponent", n),
    ];
    let law = law("ramberg_osgood", &parameters);
    for y in [1e-3, 0.3, 0.99, 1.7, 4.0_f64] {
        // x(F) of the paper.
        let x = 0.01 * (y + alpha * y.powf(n));
        let force = history(law.as_ref(), &[x], 1.0)[0].force;
        assert!((force / y - 1.0).abs() < 1e-14, "{force} for {y}");
        // Jennings 1964: the loop of Masing's rule.
        let expected = 4.0 * 0.01 * alpha * (n - 1.0) / (n + 1.0) * y.powf(n + 1.0);
        let cycle = cycle_dissipation(law.as_ref(), x, Cycling::default());
        assert!(
            (cycle / expected - 1.0).abs() < 1e-11,
            "{cycle} for {expected}"
        );
    }
}

#[test]
fn menegotto_pinto_law_is_its_formula_and_bilinear_away_from_a_sharp_knee() {
    // First loading: xy = 0.01, Fy = 1, R = R0 = 2, so s / sqrt(1 + s^2).
    let mut parameters = YIELDING.to_vec();
    parameters.extend([
        ("curvature", 2.0),
        ("curvature_loss", 0.5),
        ("curvature_excursion", 0.2),
    ]);
    let curved = law("menegotto_pinto_1973", &parameters);
    let first = |s: f64| 0.05 * s + 0.95 * s / (1.0 + s * s).sqrt();
    let top = first(3.0);
    // Down from (0.03, top): the tangent 100 meets the line -0.95 + 5 x.
    let x0 = (top - 3.0 + 0.95) / (5.0 - 100.0);
    // The farthest point of that side is still the yield point.
    let excursion = (-0.01 - x0).abs() / 0.01;
    let r = 2.0 * (1.0 - 0.5 * excursion / (0.2 + excursion));
    let s = (0.0 - 0.03) / (x0 - 0.03);
    let down = 0.05 * s + 0.95 * s / (1.0 + s.powf(r)).powf(1.0 / r);
    let f0 = -0.95 + 5.0 * x0;
    follows(
        curved.as_ref(),
        &[
            (0.01, first(1.0)),
            (0.03, top),
            (0.0, top + (f0 - top) * down),
        ],
    );
    let mut parameters = YIELDING.to_vec();
    parameters.extend([("curvature", 100.0), ("curvature_loss", 0.0)]);
    let sharp = law("menegotto_pinto_1973", &parameters);
    let path = [0.005, 0.03, 0.02, -0.02, -0.01, 0.03, 0.02];
    let bilinear = history(law("bilinear", &YIELDING).as_ref(), &path, 1.0);
    for (a, b) in history(sharp.as_ref(), &path, 1.0).iter().zip(&bilinear) {
        assert!((a.force - b.force).abs() < 1e-13, "{a:?} {b:?}");
    }
}

/// Where R may fall to 0.3, the least that is taken, cycles dissipate, large ones and small ones after them.
#[test]
fn cycles_of_curved_steel_dissipate() {
    for first in [1.05, 2.0, 5.0, 20.0] {
        for hardening in [0.0, 0.05] {
            let law = law(
                "menegotto_pinto_1973",
                &[
                    ("stiffness", 100.0),
                    ("yield_force", 1.0),
                    ("hardening_ratio", hardening),
                    ("curvature", first),
                    ("curvature_loss", 1.0 - 0.3001 / first),
                ],
            );
            for amplitude in [0.015, 0.03, 0.1, 0.5] {
                let turning =
                    [1.0, -1.0, 1.0, -1.0, 1.0, -0.2, 0.2, -0.2, 0.2].map(|a| a * amplitude);
                let mut path = vec![0.0];
                for to in turning {
                    let from = path[path.len() - 1];
                    path.extend((1..=100).map(|i| from + (to - from) * f64::from(i) / 100.0));
                }
                let points = history(law.as_ref(), &path, 1.0);
                let at = |turn: usize| points[100 * turn].dissipated;
                for [from, to] in [[1, 3], [3, 5], [7, 9]] {
                    assert!(at(to) > at(from), "{first} {hardening} {amplitude} {to}");
                }
            }
        }
    }
}

#[test]
fn gap_and_hook_act_beyond_their_gaps_only() {
    let law = law(
        "gap_hook",
        &[
            ("compression_stiffness", 1000.0),
            ("compression_gap", 0.01),
            ("tension_stiffness", 100.0),
            ("tension_gap", 0.02),
        ],
    );
    follows(
        law.as_ref(),
        &[
            (0.02, 0.0),
            (0.03, 1.0),
            (-0.01, 0.0),
            (-0.011, -1.0),
            (0.04, 2.0),
            (0.0, 0.0),
        ],
    );
}

#[test]
fn a_yielding_bumper_leaves_a_wider_gap() {
    let law = law(
        "elastoplastic_gap",
        &[
            ("stiffness", 100.0),
            ("yield_force", 1.0),
            ("hardening_ratio", 0.05),
            ("gap", 0.02),
        ],
    );
    // Closes at 0.02, yields at 0.03; at 0.05 the force is 1.1.
    let top = 1.0 + 5.0 * 0.02;
    let gap = 0.05 - top / 100.0;
    follows(
        law.as_ref(),
        &[
            (-0.02, 0.0),
            (-0.025, -0.5),
            (-0.05, -top),
            (-0.045, -(top - 0.5)),
            (0.03, 0.0),
            (-gap, 0.0),
            (-0.045, -(top - 0.5)),
            (-0.06, -(top + 0.05)),
        ],
    );
    let points = history(law.as_ref(), &[-0.05, 0.0], 1.0);
    let area = 0.5 * 0.01 + 0.5 * (1.0 + top) * 0.02 - 0.5 * top * top / 100.0;
    assert!((points[1].dissipated - area).abs() < 1e-15);
}

/// Forces by hand, and the loss of virgin excursions
/// `y/b - (a/b^2) ln(1 + b y/a) - F^2/(2 Ku)`, `a = 1/Ki`, `b = Rf/Fu`.
#[test]
fn backfill_is_a_hyperbola_that_leaves_a_wider_gap() {
    let parameters = [
        ("initial_stiffness", 200.0),
        ("unloading_stiffness", 400.0),
        ("ultimate_force", 2.0),
        ("failure_ratio", 0.8),
        ("gap", 0.01),
    ];
    let backfill = law("hyperbolic_gap", &parameters);
    let (a, b) = (1.0 / 200.0, 0.8 / 2.0);
    let force = |y: f64| y / (a + b * y);
    let loss = |y: f64| y / b - a / (b * b) * (1.0 + b * y / a).ln() - force(y) * force(y) / 800.0;
    let (first, second) = (0.02, 0.05);
    let left = first - force(first) / 400.0;
    let path = [
        (-0.01, 0.0),
        (-0.02, -force(0.01)),
        (-0.01 - first, -force(first)),
        (-0.01 - first + 0.001, -(force(first) - 0.4)),
        (0.03, 0.0),
        (-0.01 - left, 0.0),
        (-0.01 - left - 0.001, -0.4),
        (-0.01 - second, -force(second)),
        (0.0, 0.0),
        (-0.02, 0.0),
    ];
    follows(backfill.as_ref(), &path);
    let deformations: Vec<f64> = path.iter().map(|p| p.0).collect();
    let points = history(backfill.as_ref(), &deformations, 1.0);
    assert!((points[4].dissipated - loss(first)).abs() < 1e-15);
    assert!((points[9].dissipated - loss(second)).abs() < 1e-14);
    // The ultimate force is passed where the descriptor says, and a plateau ends it there.
    let reached = 2.0 / (200.0 * 0.2);
    assert!((force(reached) - 2.0).abs() < 1e-14);
    let capped = [&parameters[..], &[("force_limit", 2.0)]].concat();
    let capped = law("hyperbolic_gap", &capped);
    let beyond = -0.01 - 2.0 * reached;
    let path = [
        (beyond, -2.0),
        (beyond + 0.002, -1.2),
        (beyond - 0.01, -2.0),
    ];
    follows(capped.as_ref(), &path);
    let points = history(capped.as_ref(), &[beyond, 0.0], 1.0);
    let plateau = loss(reached) + 2.0 * reached;
    assert!((points[1].dissipated - plateau).abs() < 1e-14);
}

#[test]
fn backfill_that_cannot_be_is_refused() {
    let refused = |more: &[(&str, f64)]| {
        let mut all = vec![
            ("initial_stiffness", 200.0),
            ("ultimate_force", 2.0),
            ("failure_ratio", 0.8),
        ];
        all.retain(|(name, _)| more.iter().all(|(other, _)| other != name));
        all.extend(more);
        let parameters = LawParameters::from_pairs(&all);
        let error = build("hyperbolic_gap", &parameters);
        error.unwrap_err().to_string()
    };
    assert!(refused(&[("unloading_stiffness", 100.0)]).contains("below its initial_stiffness"));
    assert!(refused(&[("force_limit", 2.5)]).contains("never reaches"));
    assert!(refused(&[("failure_ratio", 1.0)]).contains("failure_ratio"));
    assert!(refused(&[("ultimate_force", 0.0)]).contains("ultimate_force"));
}

/// A sliding pendulum: forces by hand on straight paths, along which `z` is a hyperbolic
/// tangent, and the loss of a cycle, a little less than the rectangle `4 mu W A`.
#[test]
fn a_friction_pendulum_slides_as_its_closed_form() {
    let (weight, radius, friction, y) = (8.0e6, 2.0, 0.06, 0.002);
    let parameters = [
        ("weight", weight),
        ("radius", radius),
        ("friction_fast", friction),
        ("friction_slow", friction),
        ("friction_rate", 50.0),
        ("yield_displacement", y),
    ];
    let pendulum = law("friction_pendulum", &parameters);
    let force = |x: f64, z: f64| weight * x / radius + friction * weight * z;
    let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-9 * weight, "{a} {b}");
    let top = 0.1;
    // Unloading goes straight to z = 0, one Y back, and on as a hyperbolic tangent.
    let path = [0.001, top, top - 0.5 * y, top - 2.0 * y, -top, top];
    let points = history(pendulum.as_ref(), &path, 1.0);
    let z = [0.5_f64.tanh(), 1.0, 0.5, -(1.0_f64.tanh()), -1.0, 1.0];
    for ((point, x), z) in points.iter().zip(path).zip(z) {
        close(point.force, force(x, z));
    }
    // From z = 1 at the top and back: the work of the friction over both ways, each of them
    // Y straight down and ln cosh of the rest.
    let rest = 2.0 * top / y - 1.0;
    let one_way = -0.5 + rest + (0.5 * (1.0 + (-2.0 * rest).exp())).ln();
    let expected = 2.0 * friction * weight * y * one_way;
    let lost = points[5].dissipated - points[1].dissipated;
    assert!((lost / expected - 1.0).abs() < 1e-12, "{lost} {expected}");
    let rectangle = 4.0 * friction * weight * top;
    assert!(lost < rectangle && lost > 0.97 * rectangle);
}

/// Friction at a constant speed; at rest it keeps up a load.
#[test]
fn the_friction_of_a_pendulum_grows_with_the_speed() {
    let parameters = [
        ("weight", 1.0),
        ("radius", 1.0e9),
        ("friction_fast", 0.10),
        ("friction_slow", 0.04),
        ("friction_rate", 20.0),
        ("yield_displacement", 0.001),
    ];
    let pendulum = law("friction_pendulum", &parameters);
    assert!(
        pendulum.holds_static_load()
            && !law("maxwell", &[("stiffness", 1.0), ("damping", 1.0)]).holds_static_load()
    );
    let mut candidate = pendulum.virgin();
    for speed in [0.0, 0.01, 0.05, 1.0, -0.05] {
        let end = Motion {
            deformation: f64::copysign(0.1, speed),
            velocity: speed,
        };
        let response = pendulum.trial(&pendulum.virgin(), &mut candidate, end, 1.0);
        let friction = 0.10 - 0.06 * (-20.0 * f64::abs(speed)).exp();
        let expected = f64::copysign(friction, speed);
        assert!(
            (response.force - expected).abs() < 1e-9,
            "{speed}: {response:?}"
        );
    }
}

/// Loaded slowly and unloaded fast within its yield displacement, the published law gives back
/// more than it took: `(mu_unloading - mu_loading) W Y z^2 / 2` less what the curve of loading
/// lies above its chord, at most `(mu_f - mu_s) W Y / 2`. The means of both ends of each step
/// are what the laboratory takes for the coefficients; steps are short here.
#[test]
fn a_friction_pendulum_gives_back_what_its_traps_say() {
    let (weight, y, fast, slow) = (5.0e6, 0.002, 0.10, 0.04);
    let parameters = [
        ("weight", weight),
        ("radius", 2.0),
        ("friction_fast", fast),
        ("friction_slow", slow),
        ("friction_rate", 1e4),
        ("yield_displacement", y),
    ];
    let pendulum = law("friction_pendulum", &parameters);
    let bound = 0.5 * (fast - slow) * weight * y;
    // Path up in units of Y: `z = tanh`, whose work is `ln cosh`; down, the work is `z^2 / 2`.
    let lost = |up: f64| {
        let (mut committed, mut candidate) = (pendulum.virgin(), pendulum.virgin());
        let mut go = |x: f64, velocity: f64| {
            let end = Motion {
                deformation: x,
                velocity,
            };
            pendulum.trial(&committed, &mut candidate, end, 1.0);
            committed.commit(&mut candidate);
            let work = pendulum.stored_energy(&committed, end, committed.variables())
                + pendulum.dissipated_energy(&committed, end, committed.variables());
            work - 0.5 * weight / 2.0 * x * x
        };
        go(up * y, 0.0);
        // The coefficient changes at the turning point, along no path.
        go(up * y, -1.0);
        go((up - up.tanh()) * y, -1.0)
    };
    for up in [1e-3_f64, 0.1, 0.5, 1.0, 2.0, 4.0] {
        let z = up.tanh();
        let expected = weight * y * (slow * up.cosh().ln() - 0.5 * fast * z * z);
        let lost = lost(up);
        assert!(
            (lost - expected).abs() < 1e-9 * bound,
            "{up}: {lost} {expected}"
        );
        assert!(lost >= -bound, "{up}: {lost} {bound}");
    }
    assert!(lost(0.5) < 0.0);
}

#[test]
fn friction_that_cannot_be_is_refused() {
    let refused = |name: &str, value: f64| {
        let parameters = pounding_hysteresis::find("friction_pendulum").unwrap();
        let parameters = parameters.example_parameters().with(name, value);
        let error = build("friction_pendulum", &parameters).unwrap_err();
        assert!(error.help().is_some());
        error.to_string()
    };
    assert!(refused("friction_slow", 0.09).contains("above its friction_fast"));
    assert!(refused("friction_fast", 1.0).contains("friction_fast"));
    assert!(refused("radius", 0.0).contains("radius"));
    assert!(refused("yield_displacement", -1.0).contains("yield_displacement"));
}
