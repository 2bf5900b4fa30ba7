//! Linear class: `F = k delta^n + c delta^((n-1)/2) v`.
//!
//! With `s` such that `ds = delta^((n-1)/2) dt` it is a linear oscillator in
//! `delta^((n+1)/2)` for any exponent; `zeta = c / sqrt(2 (n+1) k m)`.

use std::f64::consts::PI;

use super::hunt_crossley::elastic;
use crate::model::{ClosedForm, Force};

/// Force with dashpot coefficient `dashpot` (N s/m^((n+1)/2)).
///
/// For n > 1 the dashpot's slope grows without bound towards zero penetration;
/// at and below zero the dashpot, and both derivatives, are zero.
pub(crate) fn force(
    stiffness: f64,
    exponent: f64,
    dashpot: f64,
    delta: f64,
    velocity: f64,
) -> Force {
    let (spring, slope) = elastic(stiffness, exponent, delta);
    if exponent == 1.0 {
        return Force {
            value: spring + dashpot * velocity,
            by_penetration: slope,
            by_velocity: dashpot,
        };
    }
    if delta <= 0.0 {
        return Force::default();
    }
    let half = 0.5 * (exponent - 1.0);
    let coefficient = if exponent == 1.5 {
        dashpot * delta.sqrt().sqrt()
    } else {
        dashpot * delta.powf(half)
    };
    Force {
        value: spring + coefficient * velocity,
        by_penetration: slope + half * coefficient * velocity / delta,
        by_velocity: coefficient,
    }
}

/// `zeta acos(zeta) / sqrt(1 - zeta^2)` and its continuation beyond one.
pub(crate) fn decrement(zeta: f64) -> f64 {
    let distance = 1.0 - zeta * zeta;
    if distance.abs() < 1.0e-8 {
        1.0 - 2.0 / 3.0 * (1.0 - zeta)
    } else if distance > 0.0 {
        zeta * zeta.acos() / distance.sqrt()
    } else {
        zeta * zeta.acosh() / (-distance).sqrt()
    }
}

/// Restitution with damping in both phases, contact ending at zero penetration.
pub(crate) fn restitution_zero_penetration(zeta: f64) -> f64 {
    if zeta >= 1.0 {
        return 0.0;
    }
    (-PI * zeta / (1.0 - zeta * zeta).sqrt()).exp()
}

/// Restitution with damping in both phases, contact ending at zero force.
pub(crate) fn restitution_no_tension(zeta: f64) -> f64 {
    (-2.0 * decrement(zeta)).exp()
}

/// Restitution with damping in approach only.
pub(crate) fn restitution_approach_only(zeta: f64) -> f64 {
    (-decrement(zeta)).exp()
}

/// Greatest penetration (m): the oscillator's first peak, which damping in
/// restitution does not change.
pub(crate) fn peak_penetration(
    stiffness: f64,
    exponent: f64,
    zeta: f64,
    velocity: f64,
    mass: f64,
) -> f64 {
    let power = exponent + 1.0;
    let elastic_peak = (power * mass * velocity * velocity / (2.0 * stiffness)).powf(1.0 / power);
    elastic_peak * (-decrement(zeta) * 2.0 / power).exp()
}

/// Closed forms with damping in approach only.
pub(crate) fn closed_form_approach_only(
    stiffness: f64,
    exponent: f64,
    zeta: f64,
    velocity: f64,
    mass: f64,
) -> ClosedForm {
    ClosedForm {
        restitution: restitution_approach_only(zeta),
        peak_penetration: Some(peak_penetration(stiffness, exponent, zeta, velocity, mass)),
        peak_force: None,
        duration: None,
    }
}
