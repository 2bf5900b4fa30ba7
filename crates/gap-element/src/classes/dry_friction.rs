//! Dry friction in the contact, with or without a viscous part:
//! `F = k delta^n (1 + D sgn v + b v)`.

use super::{elastic_time_factor, hunt_crossley};
use crate::descriptor::ModelDescriptor;
use crate::model::{
    ClosedForm, Collision, Direction, Force, Guard, ImpactModel, Memory, Phase, PowerLaw,
    SeparationRule, Target, Transition,
};

const APPROACH: [Transition; 1] = [Transition {
    guard: Guard::Velocity,
    direction: Direction::Falling,
    target: Target::StickOrSlip,
}];
const RESTITUTION_PHASE: [Transition; 1] = [Transition {
    guard: Guard::Velocity,
    direction: Direction::Rising,
    target: Target::StickOrSlip,
}];
const STUCK: [Transition; 2] = [
    Transition {
        guard: Guard::StickLower,
        direction: Direction::Falling,
        target: Target::Phase(Phase::Restitution),
    },
    Transition {
        guard: Guard::StickUpper,
        direction: Direction::Falling,
        target: Target::Phase(Phase::Approach),
    },
];

/// The ways between slipping in approach, in restitution, and sticking.
pub(crate) fn transitions(phase: Phase) -> &'static [Transition] {
    match phase {
        Phase::Approach => &APPROACH,
        Phase::Restitution => &RESTITUTION_PHASE,
        Phase::Stuck => &STUCK,
        _ => &[],
    }
}

/// `F = k delta^n (1 + D sgn v + b v)`; at `v = 0` it holds with any force between
/// `k delta^n (1 - D)` and `k delta^n (1 + D)`.
#[derive(Debug)]
pub(crate) struct DryFriction {
    pub(crate) descriptor: &'static ModelDescriptor,
    pub(crate) stiffness: f64,
    pub(crate) exponent: f64,
    /// D (-).
    pub(crate) friction: f64,
    /// b (s/m).
    pub(crate) rate: f64,
}

/// The friction factor D with which friction alone returns exactly `e`.
pub(crate) fn friction(e: f64) -> f64 {
    (1.0 - e * e) / (1.0 + e * e)
}

/// Restitution of `F = f(delta) (1 + D sgn v + y v / v0)`: the two phases are
/// integrated in the phase plane and joined at the maximum penetration, where
/// both have done the work `L` on the spring. With `D >= 1` friction holds what the spring
/// pushes: the impact is plastic.
fn restitution(d: f64, y: f64) -> f64 {
    if d >= 1.0 {
        return 0.0;
    }
    if y == 0.0 {
        return ((1.0 - d) / (1.0 + d)).sqrt();
    }
    let compression = phase_work(y / (1.0 + d)) / (1.0 + d);
    // Restitution: (1-d) s - ... = compression with s = y e / (1 - d) in [0, 1).
    let target = compression * y * y / (1.0 - d);
    let s = super::solve_increasing(
        |s| -libm::log1p(-s) - s - target,
        1.0e-16,
        1.0 - f64::EPSILON,
    );
    s * (1.0 - d) / y
}

/// `(x - ln(1 + x)) / x^2` (1/2 at zero): work of the approach in units of
/// `m v0^2`, with `x = y / (1 + D)`.
fn phase_work(x: f64) -> f64 {
    if x < 1.0e-2 {
        (0..9)
            .rev()
            .fold(0.0, |sum, k| 1.0 / f64::from(k + 2) - x * sum)
    } else {
        (x - libm::log1p(x)) / (x * x)
    }
}

impl ImpactModel for DryFriction {
    fn descriptor(&self) -> &'static ModelDescriptor {
        self.descriptor
    }
    fn separation(&self) -> SeparationRule {
        SeparationRule::ZeroPenetration
    }
    fn begin(&self, approach_velocity: f64, effective_mass: f64) -> Collision {
        Collision {
            approach_velocity,
            effective_mass,
            constants: [self.stiffness, self.friction, self.exponent, self.rate],
        }
    }
    fn force(&self, _: &Collision, _: &Memory, phase: Phase, delta: f64, velocity: f64) -> Force {
        let dry = match phase {
            Phase::Approach => 1.0 + self.friction,
            Phase::Restitution => 1.0 - self.friction,
            _ => return Force::default(),
        };
        let (spring, slope) = hunt_crossley::elastic(self.stiffness, self.exponent, delta);
        let factor = dry + self.rate * velocity;
        Force {
            value: spring * factor,
            by_penetration: slope * factor,
            by_velocity: spring * self.rate,
        }
    }
    fn is_affine(&self, _: &Collision, phase: Phase) -> bool {
        self.exponent == 1.0 && self.rate == 0.0 && phase != Phase::Stuck
    }
    fn power_law(&self, _: &Collision, phase: Phase) -> Option<PowerLaw> {
        let dry = match phase {
            Phase::Approach => 1.0 + self.friction,
            Phase::Restitution => 1.0 - self.friction,
            _ => return None,
        };
        Some(PowerLaw {
            stiffness: self.stiffness * dry,
            exponent: self.exponent,
            dashpot: self.stiffness * self.rate,
            dashpot_exponent: self.exponent,
        })
    }
    fn stored_energy(&self, _: &Collision, _: &Memory, _: Phase, delta: f64) -> f64 {
        hunt_crossley::stored_energy(self.stiffness, self.exponent, delta)
    }
    fn transitions(&self, phase: Phase) -> &'static [Transition] {
        transitions(phase)
    }
    fn stick_range(&self, _: &Collision, _: &Memory, delta: f64) -> (f64, f64) {
        let (spring, _) = hunt_crossley::elastic(self.stiffness, self.exponent, delta);
        (
            spring * (1.0 - self.friction),
            spring * (1.0 + self.friction),
        )
    }
    fn closed_form(&self, approach_velocity: f64, effective_mass: f64) -> Option<ClosedForm> {
        let (d, power) = (self.friction, self.exponent + 1.0);
        let y = self.rate * approach_velocity;
        let restitution = restitution(d, y);
        let energy = effective_mass * approach_velocity * approach_velocity;
        let work = phase_work(y / (1.0 + d)) / (1.0 + d);
        let peak = libm::pow(power * energy * work / self.stiffness, 1.0 / power);
        let alone = y == 0.0 && approach_velocity > 0.0;
        let compression = elastic_time_factor(self.exponent) * peak / approach_velocity;
        Some(ClosedForm {
            restitution,
            peak_penetration: Some(peak),
            peak_force: alone
                .then(|| hunt_crossley::elastic(self.stiffness, self.exponent, peak).0 * (1.0 + d)),
            duration: (alone && restitution > 0.0)
                .then_some(compression * (1.0 + 1.0 / restitution)),
        })
    }
    fn smooth_at_closure(&self) -> bool {
        self.exponent == 1.0
    }
}
