//! Order, dense output and error estimate, against closed forms.
#![allow(clippy::unwrap_used)]

use pounding_runge_kutta::Dop853;

/// Forced oscillator `x'' = -x + cos 2t`, `x(0) = x'(0) = 0`:
/// `x = (cos t - cos 2t) / 3`.
fn exact(t: f64) -> [f64; 2] {
    [
        (t.cos() - (2.0 * t).cos()) / 3.0,
        (2.0 * (2.0 * t).sin() - t.sin()) / 3.0,
    ]
}

fn integrate(steps: usize, end: f64) -> (f64, f64, f64) {
    let h = end / steps as f64;
    let mut method = Dop853::new(2);
    let mut state = vec![0.0, 0.0];
    let mut new = vec![0.0, 0.0];
    let mut dense_error = 0.0_f64;
    let mut estimate = 0.0_f64;
    for i in 0..steps {
        let t = i as f64 * h;
        let mut f = |offset: f64, y: &[f64], dy: &mut [f64]| {
            dy[0] = y[1];
            dy[1] = -y[0] + (2.0 * (t + offset)).cos();
        };
        method.step(&mut f, &state, h, &mut new);
        estimate = estimate.max(method.error_norm(|_| 1.0));
        method.prepare_dense(&mut f);
        for j in 0..2 {
            let p = method.polynomial(j);
            for theta in [0.0, 0.2, 0.55, 0.9, 1.0_f64] {
                let value = p.iter().rev().fold(0.0, |s, c| s * theta + c);
                dense_error = dense_error.max((value - exact(t + theta * h)[j]).abs());
            }
        }
        method.advance();
        state.copy_from_slice(&new);
    }
    let end_error = (state[0] - exact(end)[0])
        .abs()
        .max((state[1] - exact(end)[1]).abs());
    (end_error, dense_error, estimate)
}

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

#[test]
fn order_of_solution_and_dense_output() {
    let runs: Vec<_> = [8, 12, 16, 24]
        .iter()
        .map(|n| (8.0 / *n as f64, integrate(*n, 8.0)))
        .collect();
    let end: Vec<_> = runs.iter().map(|(h, r)| (*h, r.0)).collect();
    let dense: Vec<_> = runs.iter().map(|(h, r)| (*h, r.1)).collect();
    let estimate: Vec<_> = runs.iter().map(|(h, r)| (*h, r.2)).collect();
    assert!((slope(&end) - 8.0).abs() < 0.6, "order {}", slope(&end));
    assert!(slope(&dense) > 7.2, "dense order {}", slope(&dense));
    assert!(
        slope(&estimate) > 6.5,
        "estimate order {}",
        slope(&estimate)
    );
}

#[test]
fn quadrature_of_a_polynomial_of_degree_seven_is_exact() {
    let mut method = Dop853::new(1);
    let mut new = [0.0];
    method.step(
        &mut |t: f64, _: &[f64], dy: &mut [f64]| dy[0] = 8.0 * t.powi(7),
        &[0.0],
        1.0,
        &mut new,
    );
    assert!((new[0] - 1.0).abs() < 4e-15, "{}", new[0]);
}

#[test]
fn a_nan_rejects_the_step() {
    let mut method = Dop853::new(1);
    let mut new = [0.0];
    method.step(
        &mut |_: f64, _: &[f64], dy: &mut [f64]| dy[0] = f64::NAN,
        &[0.0],
        1.0,
        &mut new,
    );
    assert_eq!(method.error_norm(|_| 1.0), f64::INFINITY);
}
