//! Rung 4 of the ladder: the order of each method, fitted from runs with impacts.
#![allow(clippy::print_stdout)]

use std::sync::Arc;

use pounding_time_history::{MethodChoice, RunOptions, System, run};
use verification::{reference_cases, reference_system, single_storey, synthetic_motion};

/// Least-squares slope of log(error) over log(step).
fn slope(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let (mut sx, mut sy, mut sxx, mut sxy) = (0.0, 0.0, 0.0, 0.0);
    for (h, e) in points {
        let (x, y) = (h.ln(), e.ln());
        sx += x;
        sy += y;
        sxx += x * x;
        sxy += x * y;
    }
    (n * sxy - sx * sy) / (n * sxx - sx * sx)
}

/// Errors of all floor displacements at the end (30 s, after all impacts) against
/// the 113-bit reference, relative to the peak displacement.
fn errors(
    case: &str,
    model: &str,
    steps: &[f64],
    method: impl Fn(f64) -> MethodChoice,
) -> Vec<(f64, f64)> {
    let cases = reference_cases().unwrap();
    let case = &cases.cases[case];
    let reference = &case.models[model];
    let scale = reference.peak_u.iter().fold(0.0_f64, |m, u| m.max(*u));
    steps
        .iter()
        .map(|h| {
            let system = reference_system(case, model, synthetic_motion().unwrap(), 1.0).unwrap();
            let options = RunOptions {
                method: method(*h),
                duration: None,
                energy_tolerance: None,
            };
            let outcome = run(&system, &options, &mut [], &mut |_| {}).unwrap();
            let worst = outcome
                .final_displacement
                .iter()
                .zip(&reference.final_u)
                .map(|(a, b)| (a - b).abs() / scale)
                .fold(0.0, f64::max);
            (*h, worst)
        })
        .collect()
}

fn check(label: &str, order: f64, points: &[(f64, f64)]) {
    let fitted = slope(points);
    println!("{label}: order {fitted:.2}, errors {points:?}");
    assert!(
        (fitted - order).abs() < 0.35,
        "{label}: fitted order {fitted}, errors {points:?}"
    );
}

#[test]
fn runge_kutta_4_is_of_order_4_between_events() {
    let steps = [5e-4, 2.5e-4, 1.25e-4, 6.25e-5];
    for model in ["linear", "kv", "mj", "fricl"] {
        check(
            &format!("C2 {model} RK4"),
            4.0,
            &errors("C2", model, &steps, |step| MethodChoice::RungeKutta4 {
                step,
            }),
        );
    }
}

#[test]
fn newmark_and_hht_are_of_order_2_between_events() {
    let steps = [2.5e-4, 1.25e-4, 6.25e-5, 3.125e-5];
    for model in ["linear", "kv", "mj", "hertzdamp", "fricl"] {
        let newmark = |step| MethodChoice::Newmark {
            step,
            beta: 0.25,
            gamma: 0.5,
        };
        check(
            &format!("C2 {model} Newmark"),
            2.0,
            &errors("C2", model, &steps, newmark),
        );
    }
    check(
        "C2 kv HHT-alpha",
        2.0,
        &errors("C2", "kv", &steps, |step| MethodChoice::HhtAlpha {
            step,
            alpha: -0.1,
        }),
    );
    check(
        "C2 kv linear acceleration",
        2.0,
        &errors("C2", "kv", &steps, |step| MethodChoice::Newmark {
            step,
            beta: 1.0 / 6.0,
            gamma: 0.5,
        }),
    );
}

/// Hilber, Hughes and Taylor 1977, written out for one mass: samples that the round-off of
/// `value + slope * length` misses are no jumps, at which the acceleration of the method would be lost.
#[test]
fn hht_alpha_carries_its_acceleration_across_the_samples() {
    let (mass, stiffness, alpha) = (1.0e5, 4.0e6, -0.3);
    let mut ground = synthetic_motion().unwrap();
    ground.samples = Arc::new(ground.samples.iter().map(|a| 0.7 * a).collect());
    let step = ground.time_step;
    let (beta, gamma) = (0.25 * (1.0 - alpha) * (1.0 - alpha), 0.5 - alpha);
    let (mut u, mut v) = (0.0, 0.0);
    let mut a = -ground.samples[0];
    let (mut peak, mut last): (f64, f64) = (0.0, ground.samples[0]);
    for sample in ground.samples.iter().skip(1) {
        let load = -mass * ((1.0 + alpha) * sample - alpha * last);
        let predicted = u + step * v + step * step * (0.5 - beta) * a;
        let force = stiffness * ((1.0 + alpha) * predicted - alpha * u);
        let next = (load - force) / (mass + (1.0 + alpha) * stiffness * beta * step * step);
        u = predicted + beta * step * step * next;
        v += step * ((1.0 - gamma) * a + gamma * next);
        (a, last) = (next, *sample);
        peak = peak.max(u.abs());
    }
    let options = RunOptions {
        method: MethodChoice::HhtAlpha { step, alpha },
        duration: Some((ground.samples.len() - 1) as f64 * step),
        energy_tolerance: Some(1.0),
    };
    let system = System::new(vec![single_storey("one", mass, stiffness)], ground);
    let outcome = run(&system, &options, &mut [], &mut |_| {}).unwrap();
    let error = (outcome.final_displacement[0] - u).abs() / peak;
    assert!(error < 1e-12, "{error:e}");
}

/// Laws that start like a power of time lower the order of any method whose steps
/// do not shrink there: `delta^1.5` starts like `t^1.5`, so that one step errs by
/// `h^2.5` in velocity; Jankowski's dashpot starts like `t^0.25` and leaves `h^1.25`.
#[test]
fn singular_starts_lower_the_order_as_they_must() {
    let steps = [2.5e-4, 1.25e-4, 6.25e-5, 3.125e-5];
    let newmark = |step| MethodChoice::Newmark {
        step,
        beta: 0.25,
        gamma: 0.5,
    };
    let rk4 = |step| MethodChoice::RungeKutta4 { step };
    check(
        "C2 jank Newmark",
        1.25,
        &errors("C2", "jank", &steps, newmark),
    );
    check("C2 jank RK4", 1.25, &errors("C2", "jank", &steps, rk4));
    // RK4 with Hertzdamp: the length of the second step of each contact, the rest of
    // the grid, decides about the error, so that it falls irregularly and no slope
    // can be fitted; it must still converge to the reference.
    let fine = errors("C2", "hertzdamp", &[2.5e-3, 1.25e-4], rk4);
    assert!(fine[0].1 < 1e-8 && fine[1].1 < 1e-11, "{fine:?}");
}
