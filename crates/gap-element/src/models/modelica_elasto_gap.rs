//! Kelvin-Voigt with the damper limited to the spring force: neither jump nor tension.

use crate::classes::hunt_crossley;
use crate::classes::linear::{self, damping_ratio_zero_penetration};
use crate::descriptor::{AchievedRestitution, Alias, ModelDescriptor, Verification};
use crate::error::GapElementError;
use crate::model::{
    ClosedForm, Collision, Direction, Force, Guard, ImpactModel, Memory, Phase, SeparationRule,
    Target, Transition,
};
use crate::parameters::ModelParameters;

pub(crate) static DESCRIPTOR: ModelDescriptor = ModelDescriptor {
    name: "modelica_elasto_gap",
    aliases: &[Alias {
        name: "damper_limited_kelvin_voigt",
        citation: "what it does",
    }],
    title: "Kelvin-Voigt with a limited damper",
    formula: "F = k delta + clamp(c v, -k delta, k delta);  c = 2 zeta sqrt(k m),  zeta = -ln e / sqrt(pi^2 + ln^2 e)",
    citation: "Modelica Standard Library, Mechanics.Translational.Components.ElastoGap",
    class: "linear class, exponent 1, damper limited by the spring",
    achieved_restitution: AchievedRestitution::Constant,
    verification: Verification::Verified(
        "the example ElastoGap of the Modelica Standard Library as Dymola computes it, times and velocities to its tolerance (5e-6, pounding verify structures); an independent integration to 1e-8",
    ),
    traps: &[
        "The library leaves c to the user; the customary zeta(e) of the law with tension is taken.",
        "Neither jump nor tension, but it returns neither what the law with tension nor what the one without does: 0.4790 for 0.3, 0.5968 for 0.5, 0.7360 for 0.7.",
        "Force and its slope are continuous in neither limit: the kinks are located.",
    ],
    build,
    ..linear::LINEAR_DESCRIPTOR
};

/// The damper is unlimited.
const FREE: Phase = Phase::Branch(0);
/// `k delta - c v`.
const APPROACH_LIMIT: Guard = Guard::Model(0);

const APPROACH: [Transition; 1] = [Transition {
    guard: APPROACH_LIMIT,
    direction: Direction::Rising,
    target: Target::Phase(FREE),
}];
const UNLIMITED: [Transition; 2] = [
    Transition {
        guard: APPROACH_LIMIT,
        direction: Direction::Falling,
        target: Target::Phase(Phase::Approach),
    },
    Transition {
        guard: Guard::RawForce,
        direction: Direction::Falling,
        target: Target::Phase(Phase::Released),
    },
];
const RELEASED: [Transition; 1] = [Transition {
    guard: Guard::RawForce,
    direction: Direction::Rising,
    target: Target::Phase(FREE),
}];

/// In [`Phase::Approach`] the damper is at its limit and doubles the spring.
#[derive(Debug)]
struct ElastoGap {
    stiffness: f64,
    zeta: f64,
}

fn build(parameters: &ModelParameters) -> Result<Box<dyn ImpactModel>, GapElementError> {
    Ok(Box::new(ElastoGap {
        stiffness: parameters.get(&DESCRIPTOR, "stiffness")?,
        zeta: parameters.damping(&DESCRIPTOR, "damping_ratio", damping_ratio_zero_penetration)?,
    }))
}

impl ImpactModel for ElastoGap {
    fn descriptor(&self) -> &'static ModelDescriptor {
        &DESCRIPTOR
    }
    fn separation(&self) -> SeparationRule {
        SeparationRule::ZeroPenetration
    }
    fn begin(&self, approach_velocity: f64, effective_mass: f64) -> Collision {
        let dashpot = 2.0 * self.zeta * (self.stiffness * effective_mass).sqrt();
        Collision {
            approach_velocity,
            effective_mass,
            constants: [self.stiffness, dashpot, 0.0, 0.0],
        }
    }
    fn force(
        &self,
        collision: &Collision,
        _: &Memory,
        phase: Phase,
        delta: f64,
        velocity: f64,
    ) -> Force {
        let k = self.stiffness;
        match phase {
            Phase::Approach => linear::force(2.0 * k, 1.0, 0.0, delta, velocity),
            FREE => linear::force(k, 1.0, collision.constants[1], delta, velocity),
            _ => Force::default(),
        }
    }
    fn raw_force(
        &self,
        collision: &Collision,
        _: &Memory,
        _: Phase,
        delta: f64,
        velocity: f64,
    ) -> f64 {
        self.stiffness * delta + collision.constants[1] * velocity
    }
    fn guard(&self, _: u8, collision: &Collision, _: &Memory, delta: f64, velocity: f64) -> f64 {
        self.stiffness * delta - collision.constants[1] * velocity
    }
    fn is_affine(&self, _: &Collision, _: Phase) -> bool {
        true
    }
    fn stored_energy(&self, _: &Collision, _: &Memory, _: Phase, delta: f64) -> f64 {
        hunt_crossley::stored_energy(self.stiffness, 1.0, delta)
    }
    fn transitions(&self, phase: Phase) -> &'static [Transition] {
        match phase {
            Phase::Approach => &APPROACH,
            FREE => &UNLIMITED,
            Phase::Released => &RELEASED,
            _ => &[],
        }
    }
    fn closed_form(&self, _approach_velocity: f64, _effective_mass: f64) -> Option<ClosedForm> {
        None
    }
    fn smooth_at_closure(&self) -> bool {
        true
    }
}
