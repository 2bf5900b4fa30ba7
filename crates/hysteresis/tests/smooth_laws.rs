//! Bouc-Wen, Baber-Noori, viscous and Maxwell laws against independent solutions.
use crate::common::{path, times};
use pounding_hysteresis::laboratory::{Cycling, cycle_dissipation, drive, history};
use pounding_hysteresis::{HysteresisLaw, LawParameters, Motion, build};
use pounding_runge_kutta::Dop853;
use proptest::prelude::*;

fn law(name: &str, parameters: &[(&str, f64)]) -> Box<dyn HysteresisLaw> {
    build(name, &LawParameters::from_pairs(parameters)).unwrap()
}

/// Solves an ordinary differential equation with the pair of order 8(5,3), local
/// errors below `tolerance`. Where the first component changes its sign, a kink of
/// these equations, steps shrink to 1e-11.
fn solve(
    mut slope: impl FnMut(f64, &[f64], &mut [f64]),
    state: &mut [f64],
    from: f64,
    to: f64,
    tolerance: f64,
) {
    let n = state.len();
    let mut method = Dop853::new(n);
    let (mut time, mut step) = (from, to - from);
    let mut end = vec![0.0; n];
    while time < to {
        step = step.min(to - time);
        let start = time;
        let mut shifted = |offset: f64, y: &[f64], out: &mut [f64]| slope(start + offset, y, out);
        method.step(&mut shifted, state, step, &mut end);
        let error = method.error_norm(|i| tolerance * (1.0 + state[i].abs()));
        let kink = state[0] * end[0] < 0.0 && step > 1e-11;
        if !kink && (error <= 1.0 || step < 1e-11) {
            state.copy_from_slice(&end);
            time = if to - time <= step { to } else { time + step };
        }
        method.invalidate();
        step *= if kink {
            0.3
        } else {
            Dop853::step_factor(error)
        };
    }
}

/// Equation of Wen (1976) in the original variables, z in metres, with time as the
/// variable: nothing of the law's own form.
#[test]
fn bouc_wen_follows_its_differential_equation() {
    for (n, beta, gamma) in [
        (1.0, 0.5, 0.5),
        (2.0, 0.7, 0.3),
        (1.4, 0.6, -0.4),
        (5.0, 0.5, 0.5),
    ] {
        let (k, fy, a, amplitude) = (2.0e7, 2.0e5, 0.05, 0.05);
        let parameters = [
            ("stiffness", k),
            ("yield_force", fy),
            ("hardening_ratio", a),
            ("exponent", n),
            ("beta", beta),
            ("gamma", gamma),
        ];
        let law = law("bouc_wen", &parameters);
        let instants = times(30.0, 0.05);
        let positions: Vec<f64> = instants[1..]
            .iter()
            .map(|t| amplitude * path(*t).0)
            .collect();
        let points = history(law.as_ref(), &positions, 0.05);
        let xy: f64 = fy / k;
        // In metres the shape factors carry the unit m^-n.
        let (b, g) = (beta / xy.powf(n), gamma / xy.powf(n));
        let mut state = vec![0.0];
        for (pair, point) in instants.windows(2).zip(&points) {
            let slope = |t: f64, y: &[f64], out: &mut [f64]| {
                let v = amplitude * path(t).1;
                let z = y[0].abs();
                out[0] = v - b * v.abs() * z.powf(n - 1.0) * y[0] - g * v * z.powf(n);
            };
            solve(slope, &mut state, pair[0], pair[1], 1e-18);
            let force = a * k * point.deformation + (1.0 - a) * k * state[0];
            assert!(
                (force - point.force).abs() < 1e-10 * fy,
                "n = {n}: {force} {point:?}"
            );
        }
    }
}

#[test]
fn bouc_wen_reaches_its_closed_forms() {
    // n = 1, beta = gamma: dz = (1 - z) dx on loading, so z = 1 - exp(-x).
    let one = law(
        "bouc_wen",
        &[("stiffness", 1.0), ("yield_force", 1.0), ("exponent", 1.0)],
    );
    // n = 2, beta = gamma: z = tanh x.
    let two = law(
        "bouc_wen",
        &[("stiffness", 1.0), ("yield_force", 1.0), ("exponent", 2.0)],
    );
    for x in [1e-3, 0.4, 1.0, 3.0_f64] {
        let force = history(one.as_ref(), &[x], 1.0)[0].force;
        assert!((force + (-x).exp_m1()).abs() < 1e-11, "{force}");
        let points = history(two.as_ref(), &[x, 0.5 * x], 1.0);
        assert!((points[0].force - x.tanh()).abs() < 1e-11);
        // Straight unloading for beta = gamma.
        if x.tanh() > 0.5 * x {
            assert!((points[1].force - (x.tanh() - 0.5 * x)).abs() < 1e-11);
        }
    }
    // Maximum force Fy (beta + gamma)^(-1/n).
    let wide = law(
        "bouc_wen",
        &[
            ("stiffness", 1.0),
            ("yield_force", 1.0),
            ("exponent", 3.0),
            ("beta", 1.0),
            ("gamma", 0.5),
        ],
    );
    let force = history(wide.as_ref(), &[60.0], 1.0)[0].force;
    assert!((force - 1.5_f64.powf(-1.0 / 3.0)).abs() < 1e-10, "{force}");
}

/// The equations of Baber and Noori (1985) as in Foliente (1995), in metres and
/// seconds, with the work of the hysteretic force as a state of its own.
#[test]
fn baber_noori_follows_its_differential_equation() {
    let (k, fy, a, n, amplitude) = (2.0e7, 2.0e5, 0.05, 1.5, 0.05);
    let (dnu, deta, zs, p, q, psi, dpsi, lambda) = (0.01, 0.02, 0.9, 0.4, 0.15, 0.2, 0.004, 0.5);
    let parameters = [
        ("stiffness", k),
        ("yield_force", fy),
        ("hardening_ratio", a),
        ("exponent", n),
        ("strength_degradation", dnu),
        ("stiffness_degradation", deta),
        ("pinching", zs),
        ("pinching_rate", p),
        ("pinching_position", q),
        ("pinching_spread", psi),
        ("pinching_spread_rate", dpsi),
        ("pinching_coupling", lambda),
    ];
    let law = law("baber_noori_1985", &parameters);
    let instants = times(30.0, 0.05);
    let positions: Vec<f64> = instants[1..]
        .iter()
        .map(|t| amplitude * path(*t).0)
        .collect();
    let points = history(law.as_ref(), &positions, 0.05);
    let xy: f64 = fy / k;
    let mut state = vec![0.0, 0.0];
    for (pair, point) in instants.windows(2).zip(&points) {
        let slope = |t: f64, y: &[f64], out: &mut [f64]| {
            let v = amplitude * path(t).1;
            // Work over Fy xy.
            let e = y[1] / (fy * xy);
            let (nu, eta) = (1.0 + dnu * e, 1.0 + deta * e);
            let z1 = zs * (1.0 - (-p * e).exp());
            let z2 = (psi + dpsi * e) * (lambda + z1);
            let zu = (1.0 / nu).powf(1.0 / n);
            let zeta = y[0] / xy;
            let h = 1.0 - z1 * (-((zeta * v.signum() - q * zu) / z2).powi(2)).exp();
            let bend =
                0.5 * v.abs() * zeta.abs().powf(n - 1.0) * zeta + 0.5 * v * zeta.abs().powf(n);
            out[0] = h * (v - nu * bend) / eta;
            out[1] = k * y[0] * v;
        };
        // The sign of v is that of the middle of the interval.
        let middle = path(0.5 * (pair[0] + pair[1])).1.signum();
        let guarded = |t: f64, y: &[f64], out: &mut [f64]| {
            if path(t).1 * middle <= 0.0 {
                out.fill(0.0);
            } else {
                slope(t, y, out);
            }
        };
        solve(guarded, &mut state, pair[0], pair[1], 1e-18);
        let force = a * k * point.deformation + (1.0 - a) * k * state[0];
        assert!(
            (force - point.force).abs() < 1e-10 * fy,
            "{force} {point:?}"
        );
    }
    // It did degrade: e beyond 25 takes a fifth of the strength.
    assert!(state[1] > 25.0 * fy * xy, "{state:?}");
}

#[test]
fn baber_noori_without_degradation_is_bouc_wen() {
    let base = [
        ("stiffness", 2.0e7),
        ("yield_force", 2.0e5),
        ("exponent", 3.0),
    ];
    let path: Vec<f64> = times(30.0, 0.1).iter().map(|t| 0.05 * path(*t).0).collect();
    let plain = history(law("bouc_wen", &base).as_ref(), &path, 0.1);
    let other = history(law("baber_noori_1985", &base).as_ref(), &path, 0.1);
    assert_eq!(plain, other);
}

#[test]
fn maxwell_element_relaxes_and_dissipates_as_its_closed_forms() {
    let (k, c) = (50.0, 10.0);
    let law = law("maxwell", &[("stiffness", k), ("damping", c)]);
    // Constant velocity for 0.1 s, then rest: exact whatever the step.
    let v = 2.0;
    let run = |steps: usize| {
        let step = 0.1 / steps as f64;
        let moving = (1..=steps).map(|i| i as f64 * step * v);
        let path: Vec<f64> = moving.chain(std::iter::repeat_n(0.1 * v, steps)).collect();
        history(law.as_ref(), &path, step)
    };
    let fade = (-0.1 * k / c).exp();
    for steps in [1, 7] {
        let points = run(steps);
        let peak = c * v * (1.0 - fade);
        assert!((points[steps - 1].force / peak - 1.0).abs() < 1e-13);
        let last = points.last().unwrap();
        assert!((last.force / (peak * fade) - 1.0).abs() < 1e-13);
        // What went in and is not stored any more.
        let work = c * v * v * (0.1 - c / k * (1.0 - fade));
        let stored = 0.5 * last.force * last.force / k;
        assert!((last.dissipated / (work - stored) - 1.0).abs() < 1e-12);
    }
    // Harmonic cycle: pi c w A^2 / (1 + (w c / k)^2).
    let (amplitude, period) = (0.03, 0.8);
    let w = std::f64::consts::TAU / period;
    let expected =
        std::f64::consts::PI * c * w * amplitude * amplitude / (1.0 + (w * c / k) * (w * c / k));
    let off = |steps: usize| {
        let cycling = Cycling {
            steps,
            cycles_before: 30,
            period,
        };
        cycle_dissipation(law.as_ref(), amplitude, cycling) / expected - 1.0
    };
    let (coarse, fine) = (off(200), off(400));
    assert!(
        fine.abs() < 1e-4 && (3.8..4.2).contains(&(coarse / fine)),
        "{coarse} {fine}"
    );
}

#[test]
fn viscous_dampers_dissipate_as_the_closed_form() {
    // int over a cycle of c |v|^(a+1) dt = c A^(a+1) w^a * int_0^(2 pi) |cos|^(a+1),
    // the integral 4, pi, 8/3 for a = 0, 1, 2; for a = 1/2 it is
    // 2 sqrt(pi) Gamma(5/4) / Gamma(7/4) = 3.496 076 76...
    let half = 2.0 * std::f64::consts::PI.sqrt() * 0.906_402_477_055_477 / 0.919_062_526_848_883_2;
    let cases = [(0.5, half), (1.0, std::f64::consts::PI), (2.0, 8.0 / 3.0)];
    for (a, integral) in cases {
        let parameters = [
            ("damping", 3.0),
            ("exponent", a),
            ("transition_velocity", 1e-6),
        ];
        let law = law("viscous_damper", &parameters);
        let (amplitude, period) = (0.1, 2.0);
        let w = std::f64::consts::TAU / period;
        let expected = 3.0 * f64::powf(amplitude, a + 1.0) * f64::powf(w, a) * integral;
        let off = |steps: usize| {
            let cycling = Cycling {
                steps,
                cycles_before: 1,
                period,
            };
            (cycle_dissipation(law.as_ref(), amplitude, cycling) / expected - 1.0).abs()
        };
        let (coarse, fine) = (off(1000), off(2000));
        assert!(fine < 1e-5, "{a}: {coarse} {fine}");
        assert!(coarse / fine > 3.0, "{a}: {coarse} {fine}");
        assert_eq!(law.is_linear(), a == 1.0);
        let motion = Motion {
            deformation: 0.0,
            velocity: -0.25,
        };
        let force = drive(law.as_ref(), [motion], 1.0)[0].force;
        assert!((force + 3.0 * 0.25_f64.powf(a)).abs() < 1e-14);
    }
}

proptest! {
    /// Without degradation the smooth law dissipates at every instant.
    #[test]
    fn bouc_wen_never_creates_energy(
        path in prop::collection::vec(-0.05..0.05_f64, 1..30),
        n in 1.0..6.0_f64,
        beta in 0.2..1.0_f64,
        share in -0.95..1.0_f64,
    ) {
        let parameters = [
            ("stiffness", 2.0e7),
            ("yield_force", 2.0e5),
            ("exponent", n),
            ("beta", beta),
            ("gamma", share * beta),
        ];
        let law = law("bouc_wen", &parameters);
        let mut last = 0.0;
        let maximum = 2.0e5 * (beta * (1.0 + share)).powf(-1.0 / n);
        for point in history(law.as_ref(), &path, 1.0) {
            prop_assert!(point.dissipated >= last - 1e-9 * 2.0e3);
            prop_assert!(point.force.abs() <= maximum * (1.0 + 1e-9));
            last = point.dissipated;
        }
    }
}
