//! Kelvin-Voigt: spring and dashpot in both phases.

use std::f64::consts::PI;

use crate::classes::{hunt_crossley, linear};
use crate::descriptor::{ConstantDescriptor, ModelDescriptor, ParameterUnit, Verification};
use crate::error::GapElementError;
use crate::model::{
    ClosedForm, Collision, Direction, Force, Guard, ImpactModel, Memory, Phase, SeparationRule,
    Target, Transition,
};
use crate::parameters::{DAMPING_RATIO, LINEAR_STIFFNESS, ModelParameters, RESTITUTION};

pub(crate) static DESCRIPTOR: ModelDescriptor = ModelDescriptor {
    name: "anagnostopoulos_2004",
    aliases: &["kelvin_voigt", "anagnostopoulos_1988"],
    title: "Kelvin-Voigt spring and dashpot",
    formula: "F = k delta + c v;  c = 2 zeta sqrt(k m),  zeta = -ln e / sqrt(pi^2 + ln^2 e)",
    citation: "Anagnostopoulos, EESD 16 (1988) 443 and 33 (2004) 897, equations 2-4",
    class: "linear, damping in both phases",
    parameters: &[LINEAR_STIFFNESS, RESTITUTION, DAMPING_RATIO],
    constants: &[
        ConstantDescriptor {
            name: "stiffness",
            unit: ParameterUnit::NewtonPerMetre,
        },
        ConstantDescriptor {
            name: "dashpot",
            unit: ParameterUnit::NewtonSecondPerMetre,
        },
    ],
    separation_rules: &[SeparationRule::ZeroPenetration, SeparationRule::NoTension],
    needs_approach_velocity: false,
    needs_effective_mass: true,
    verification: Verification::Verified(
        "closed form of the damped oscillator, both separation rules",
    ),
    traps: &[
        "Exact restitution only while tension is allowed until zero penetration: it pulls during the last part of the contact.",
        "With no_tension the same zeta(e) returns more: 0.2527 for 0.1, 0.5503 for 0.5, 0.6748 for 0.65, 0.7182 for 0.7.",
        "The force jumps to c v0 at closure.",
    ],
    build,
};

const NO_TENSION_APPROACH: [Transition; 1] = [Transition {
    guard: Guard::RawForce,
    direction: Direction::Falling,
    target: Target::Phase(Phase::Released),
}];
const NO_TENSION_RELEASED: [Transition; 1] = [Transition {
    guard: Guard::RawForce,
    direction: Direction::Rising,
    target: Target::Phase(Phase::Approach),
}];

#[derive(Debug)]
struct KelvinVoigt {
    stiffness: f64,
    zeta: f64,
    separation: SeparationRule,
}

/// Equation 4 of the 2004 paper.
fn damping_ratio(restitution: f64) -> f64 {
    let log = restitution.ln();
    // `0 - log` and not `-log`, so that restitution 1 gives +0.
    (0.0 - log) / (PI * PI + log * log).sqrt()
}

fn build(parameters: &ModelParameters) -> Result<Box<dyn ImpactModel>, GapElementError> {
    Ok(Box::new(KelvinVoigt {
        stiffness: parameters.required(DESCRIPTOR.name, "stiffness")?,
        zeta: parameters.damping(DESCRIPTOR.name, "damping_ratio", damping_ratio)?,
        separation: parameters.separation(&DESCRIPTOR),
    }))
}

impl ImpactModel for KelvinVoigt {
    fn descriptor(&self) -> &'static ModelDescriptor {
        &DESCRIPTOR
    }
    fn separation(&self) -> SeparationRule {
        self.separation
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
        if phase == Phase::Released {
            return Force::default();
        }
        linear::force(self.stiffness, 1.0, collision.constants[1], delta, velocity)
    }
    fn raw_force(
        &self,
        collision: &Collision,
        _: &Memory,
        _: Phase,
        delta: f64,
        velocity: f64,
    ) -> f64 {
        linear::force(self.stiffness, 1.0, collision.constants[1], delta, velocity).value
    }
    fn stored_energy(&self, _: &Collision, _: &Memory, phase: Phase, delta: f64) -> f64 {
        if phase == Phase::Released {
            return 0.0;
        }
        hunt_crossley::stored_energy(self.stiffness, 1.0, delta)
    }
    fn transitions(&self, phase: Phase) -> &'static [Transition] {
        match (self.separation, phase) {
            (SeparationRule::NoTension, Phase::Approach) => &NO_TENSION_APPROACH,
            (SeparationRule::NoTension, Phase::Released) => &NO_TENSION_RELEASED,
            _ => &[],
        }
    }
    fn closed_form(&self, approach_velocity: f64, effective_mass: f64) -> Option<ClosedForm> {
        let zeta = self.zeta;
        let omega = (self.stiffness / effective_mass).sqrt();
        let damped = (1.0 - zeta * zeta).sqrt() * omega;
        let (restitution, duration) = match self.separation {
            SeparationRule::ZeroPenetration => {
                (linear::restitution_zero_penetration(zeta), PI / damped)
            }
            SeparationRule::NoTension => (
                linear::restitution_no_tension(zeta),
                2.0 * zeta.acos() / damped,
            ),
        };
        Some(ClosedForm {
            restitution,
            peak_penetration: Some(linear::peak_penetration(
                self.stiffness,
                1.0,
                zeta,
                approach_velocity,
                effective_mass,
            )),
            peak_force: None,
            duration: (zeta < 1.0).then_some(duration),
        })
    }
    fn smooth_at_closure(&self) -> bool {
        true
    }
}
