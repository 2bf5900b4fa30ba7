//! Linear class: `F = k delta^n + c delta^((n-1)/2) v`.
//!
//! With `s` such that `ds = delta^((n-1)/2) dt` it is a linear oscillator in
//! `delta^((n+1)/2)` for any exponent; `zeta = c / sqrt(2 (n+1) k m)`.

mod closed_forms;
mod law;

pub(crate) use closed_forms::{
    damping_ratio_approach_only, damping_ratio_no_tension, damping_ratio_zero_penetration,
};
pub(crate) use law::{DESCRIPTOR, LINEAR_DESCRIPTOR, LinearClass};

use super::hunt_crossley::elastic;
use crate::model::Force;

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
        dashpot * libm::pow(delta, half)
    };
    Force {
        value: spring + coefficient * velocity,
        by_penetration: slope + half * coefficient * velocity / delta,
        by_velocity: coefficient,
    }
}
