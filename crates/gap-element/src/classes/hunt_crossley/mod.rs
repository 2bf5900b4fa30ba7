//! Hunt-Crossley class: `F = k delta^n (1 + y v / v0)`, and its elastic limit.
//!
//! Closed forms by integration in the phase plane, valid for any exponent: the
//! achieved restitution solves `y (1 + e) = ln((1 + y) / (1 - y e))`.

mod closed_forms;
mod law;

pub(crate) use closed_forms::{
    damping_factor, damping_factor_approach_only, restitution_approach_only,
};
pub(crate) use law::{DESCRIPTOR, HuntCrossley, LINEAR_DESCRIPTOR};

use crate::model::Force;

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
            stiffness * libm::pow(delta, exponent - 1.0)
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
