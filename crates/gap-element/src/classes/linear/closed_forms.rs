//! Closed forms of the linear class: a damped oscillator for every exponent.

use std::f64::consts::PI;

use crate::classes::{DampingPhases, solve_increasing};
use crate::model::{ClosedForm, SeparationRule};

/// `zeta acos(zeta) / sqrt(1 - zeta^2)` and its continuation beyond one.
fn decrement(zeta: f64) -> f64 {
    // The factors are exact near one, where 1 - zeta^2 would be round-off.
    let distance = (1.0 - zeta) * (1.0 + zeta);
    if distance.abs() < 1.0e-8 {
        1.0 - 2.0 / 3.0 * (1.0 - zeta)
    } else if distance > 0.0 {
        zeta * libm::acos(zeta) / distance.sqrt()
    } else {
        zeta * libm::acosh(zeta) / (-distance).sqrt()
    }
}

/// Restitution of a free collision.
fn restitution(phases: DampingPhases, separation: SeparationRule, zeta: f64) -> f64 {
    match phases {
        DampingPhases::ApproachOnly => libm::exp(-decrement(zeta)),
        DampingPhases::Both if separation.forbids_tension() => libm::exp(-2.0 * decrement(zeta)),
        DampingPhases::Both if zeta >= 1.0 => 0.0,
        DampingPhases::Both => libm::exp(-PI * zeta / (1.0 - zeta * zeta).sqrt()),
    }
}

/// The ratio with which damping in both phases returns exactly `e` if contact
/// ends at zero penetration. The same for every exponent.
pub(crate) fn damping_ratio_zero_penetration(e: f64) -> f64 {
    let log = libm::log(e);
    // `0 - log` and not `-log`, so that restitution 1 gives +0.
    (0.0 - log) / (PI * PI + log * log).sqrt()
}

/// The ratio with which damping in both phases returns exactly `e` if contact
/// ends at zero force.
pub(crate) fn damping_ratio_no_tension(e: f64) -> f64 {
    ratio_of_decrement(-0.5 * libm::log(e))
}

/// The ratio with which damping in approach only returns exactly `e`.
pub(crate) fn damping_ratio_approach_only(e: f64) -> f64 {
    ratio_of_decrement(-libm::log(e))
}

/// The inverse of [`decrement`], which rises from zero without bound.
fn ratio_of_decrement(wanted: f64) -> f64 {
    if wanted <= 0.0 {
        return 0.0;
    }
    // Below: decrement <= zeta pi / 2. Above: it exceeds ln(2 zeta) beyond one.
    solve_increasing(
        |zeta| decrement(zeta) - wanted,
        wanted / PI,
        1.0 + libm::exp(wanted),
    )
}

/// Maximum penetration (m): the oscillator's first peak, which damping in
/// restitution does not change.
fn peak_penetration(stiffness: f64, exponent: f64, zeta: f64, velocity: f64, mass: f64) -> f64 {
    let power = exponent + 1.0;
    let elastic_peak = libm::pow(
        power * mass * velocity * velocity / (2.0 * stiffness),
        1.0 / power,
    );
    elastic_peak * libm::exp(-decrement(zeta) * 2.0 / power)
}

/// Time until the bodies stop acting on one another (s), exponent 1, `zeta < 1`.
fn duration(phases: DampingPhases, separation: SeparationRule, zeta: f64, omega: f64) -> f64 {
    let damped = (1.0 - zeta * zeta).sqrt() * omega;
    match phases {
        DampingPhases::ApproachOnly => libm::acos(zeta) / damped + 0.5 * PI / omega,
        DampingPhases::Both if separation.forbids_tension() => 2.0 * libm::acos(zeta) / damped,
        DampingPhases::Both => PI / damped,
    }
}

/// Closed forms of a free collision.
pub(crate) fn closed_form(
    (phases, separation): (DampingPhases, SeparationRule),
    (stiffness, exponent, zeta): (f64, f64, f64),
    velocity: f64,
    mass: f64,
) -> ClosedForm {
    let omega = (stiffness / mass).sqrt();
    ClosedForm {
        restitution: restitution(phases, separation, zeta),
        peak_penetration: Some(peak_penetration(stiffness, exponent, zeta, velocity, mass)),
        peak_force: None,
        duration: (exponent == 1.0 && zeta < 1.0)
            .then(|| duration(phases, separation, zeta, omega)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_inverses_invert() {
        use DampingPhases::{ApproachOnly, Both};
        use SeparationRule::{NoTension, ZeroPenetration};
        for i in 1..=1000 {
            let e = f64::from(i) / 1000.0;
            for (phases, rule, zeta) in [
                (Both, ZeroPenetration, damping_ratio_zero_penetration(e)),
                (Both, NoTension, damping_ratio_no_tension(e)),
                (ApproachOnly, NoTension, damping_ratio_approach_only(e)),
            ] {
                let returned = restitution(phases, rule, zeta);
                assert!((returned - e).abs() < 1e-13, "{phases:?} {e}: {returned}");
            }
        }
    }
}
