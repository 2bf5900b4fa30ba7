//! Hunt-Crossley class: `F = k delta^n (1 + y v / v0)`, and its elastic limit.
//!
//! Closed forms by integration in the phase plane, valid for any exponent: the
//! achieved restitution solves `y (1 + e) = ln((1 + y) / (1 - y e))`.

use crate::model::{ClosedForm, Force};

/// `k delta^n` and its derivative; zero outside contact for powers, continued for
/// the linear law, whose step past the separation stays smooth that way.
pub(crate) fn elastic(stiffness: f64, exponent: f64, delta: f64) -> (f64, f64) {
    if exponent == 1.0 {
        (stiffness * delta, stiffness)
    } else if delta <= 0.0 {
        (0.0, 0.0)
    } else {
        let slope = if exponent == 1.5 {
            stiffness * delta.sqrt()
        } else {
            stiffness * delta.powf(exponent - 1.0)
        };
        (slope * delta, exponent * slope)
    }
}

/// Energy stored in the spring (J).
pub(crate) fn stored_energy(stiffness: f64, exponent: f64, delta: f64) -> f64 {
    elastic(stiffness, exponent, delta).0 * delta / (exponent + 1.0)
}

/// Force with `rate = y / v0` (s/m).
pub(crate) fn force(stiffness: f64, exponent: f64, rate: f64, delta: f64, velocity: f64) -> Force {
    let (spring, slope) = elastic(stiffness, exponent, delta);
    let factor = 1.0 + rate * velocity;
    Force {
        value: spring * factor,
        by_penetration: slope * factor,
        by_velocity: spring * rate,
    }
}

/// Achieved restitution for the damping factor `y`, by Newton on
/// `f(e) = ln((1+y)/(1-y e)) - y (1+e)`, whose root is wanted below 1/y.
pub(crate) fn restitution(y: f64) -> f64 {
    if y < 1.0e-6 {
        // Series about y = 0; the next term is of order y^3.
        return 1.0 - 2.0 / 3.0 * y + 4.0 / 9.0 * y * y;
    }
    // The other root is e = -1; between zero and 1/y the function rises from a
    // negative value, so bisection is safe and Newton fast.
    let f = |e: f64| f64::ln_1p(y) - f64::ln_1p(-y * e) - y * (1.0 + e);
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

/// Greatest penetration (m) of a free collision with damping factor `y`.
pub(crate) fn peak_penetration(
    stiffness: f64,
    exponent: f64,
    y: f64,
    velocity: f64,
    mass: f64,
) -> f64 {
    let power = exponent + 1.0;
    let loss = if y < 1.0e-4 {
        0.5 - y / 3.0 + 0.25 * y * y
    } else {
        (y - f64::ln_1p(y)) / (y * y)
    };
    (power * mass * velocity * velocity / stiffness * loss).powf(1.0 / power)
}

/// Closed forms for damping in both phases.
pub(crate) fn closed_form(
    stiffness: f64,
    exponent: f64,
    y: f64,
    velocity: f64,
    mass: f64,
) -> ClosedForm {
    let peak = peak_penetration(stiffness, exponent, y, velocity, mass);
    let elastic_law = y == 0.0;
    ClosedForm {
        restitution: restitution(y),
        peak_penetration: Some(peak),
        peak_force: elastic_law.then(|| elastic(stiffness, exponent, peak).0),
        duration: (elastic_law && velocity > 0.0)
            .then(|| 2.0 * super::elastic_time_factor(exponent) * peak / velocity),
    }
}
