//! Closed forms of the Hunt-Crossley class, by integration in the phase plane.

use crate::classes::{DampingPhases, elastic_time_factor, solve_increasing};
use crate::model::ClosedForm;

/// Achieved restitution for the damping factor `y` in both phases, by Newton on
/// `f(e) = ln((1+y)/(1-y e)) - y (1+e)`, whose root is wanted below 1/y.
pub(crate) fn restitution(y: f64) -> f64 {
    if y < 1.0e-3 {
        // Series about y = 0, from the same equation; the next term is of order y^4.
        return 1.0 - y * (2.0 / 3.0 - y * (4.0 / 9.0 - y * 44.0 / 135.0));
    }
    // The other root is e = -1; between zero and 1/y the function rises from a
    // negative value, so bisection is safe and Newton fast.
    let f = |e: f64| libm::log1p(y) - libm::log1p(-y * e) - y * (1.0 + e);
    let (mut low, mut high) = (0.0, 1.0_f64.min(1.0 / y));
    let mut e = 0.5 * high;
    for _ in 0..200 {
        let value = f(e);
        if value > 0.0 || value.is_nan() {
            high = e;
        } else {
            low = e;
        }
        let slope = y * y * e / (1.0 - y * e);
        let newton = e - value / slope;
        let next = if newton > low && newton < high {
            newton
        } else {
            0.5 * (low + high)
        };
        if (next - e).abs() <= 1.0e-16 {
            return next;
        }
        e = next;
    }
    e
}

/// The damping factor with which damping in both phases returns exactly `e`:
/// the inverse of [`restitution`].
pub(crate) fn damping_factor(e: f64) -> f64 {
    let loss = 1.0 - e;
    if loss < 1.0e-4 {
        // The rational inverse of Carvalho and Martins 2019 agrees with the series
        // to second order in the loss, beyond round-off of the equation here.
        return 1.5 * loss * (11.0 - e) / (1.0 + 9.0 * e);
    }
    // f falls from zero at y = 0 and rises without bound towards 1/e; the root
    // lies above half the slope's estimate and below 1/e.
    let f = |y: f64| libm::log1p(y) - libm::log1p(-y * e) - y * (1.0 + e);
    solve_increasing(f, 0.75 * loss, (1.0 - f64::EPSILON) / e)
}

/// `2 (y - ln(1 + y)) / y^2`, regular at zero.
fn approach_loss(y: f64) -> f64 {
    if y < 1.0e-2 {
        // 2 sum_k (-y)^k / (k + 2)
        (0..9)
            .rev()
            .fold(0.0, |sum, k| 2.0 / f64::from(k + 2) - y * sum)
    } else {
        2.0 * (y - libm::log1p(y)) / (y * y)
    }
}

/// Achieved restitution with damping in approach only.
pub(crate) fn restitution_approach_only(y: f64) -> f64 {
    approach_loss(y).sqrt()
}

/// The damping factor with which damping in approach only returns exactly `e`.
pub(crate) fn damping_factor_approach_only(e: f64) -> f64 {
    if e >= 1.0 {
        return 0.0;
    }
    // For heavy damping e^2 tends to 2 / y from below.
    solve_increasing(|y| e - restitution_approach_only(y), 1.0e-16, 2.0 / (e * e))
}

/// Maximum penetration (m) of a free collision with damping factor `y`.
fn peak_penetration(stiffness: f64, exponent: f64, y: f64, velocity: f64, mass: f64) -> f64 {
    let power = exponent + 1.0;
    libm::pow(
        power * mass * velocity * velocity / (2.0 * stiffness) * approach_loss(y),
        1.0 / power,
    )
}

/// Closed forms of a free collision.
pub(crate) fn closed_form(
    phases: DampingPhases,
    (stiffness, exponent, y): (f64, f64, f64),
    velocity: f64,
    mass: f64,
) -> ClosedForm {
    let peak = peak_penetration(stiffness, exponent, y, velocity, mass);
    let elastic_law = y == 0.0;
    ClosedForm {
        restitution: match phases {
            DampingPhases::Both => restitution(y),
            DampingPhases::ApproachOnly => restitution_approach_only(y),
        },
        peak_penetration: Some(peak),
        peak_force: elastic_law.then(|| super::elastic(stiffness, exponent, peak).0),
        duration: (elastic_law && velocity > 0.0)
            .then(|| 2.0 * elastic_time_factor(exponent) * peak / velocity),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_inverses_invert() {
        for i in 1..=2000 {
            let e = f64::from(i) / 2000.0;
            assert!((restitution(damping_factor(e)) - e).abs() < 2e-12, "{e}");
            let y = damping_factor_approach_only(e);
            assert!((restitution_approach_only(y) - e).abs() < 2e-14, "{e}");
        }
        for e in [0.999_9, 0.999_99, 0.999_999_9] {
            assert!((restitution(damping_factor(e)) - e).abs() < 1e-12, "{e}");
        }
    }

    #[test]
    fn series_and_equation_meet() {
        // On either side of the switch the two evaluations agree.
        for (f, at) in [
            (restitution as fn(f64) -> f64, 1.0e-3),
            (restitution_approach_only, 1.0e-2),
        ] {
            let step = 1.0e-9 * at;
            let jump = f(at + step) - f(at - step);
            let slope = (f(at * 1.01) - f(at * 0.99)) / (0.02 * at);
            assert!((jump - slope * 2.0 * step).abs() < 1e-12, "{jump}");
        }
    }
}
