//! Modified linear viscoelastic law: the dashpot acts in approach only.

use std::f64::consts::PI;

use super::approach_only;
use crate::classes::{hunt_crossley, linear};
use crate::descriptor::{ConstantDescriptor, ModelDescriptor, ParameterUnit, Verification};
use crate::error::GapElementError;
use crate::model::{
    ClosedForm, Collision, Force, ImpactModel, Memory, Phase, SeparationRule, Transition,
};
use crate::parameters::{DAMPING_RATIO, LINEAR_STIFFNESS, ModelParameters, RESTITUTION};

pub(crate) static DESCRIPTOR: ModelDescriptor = ModelDescriptor {
    name: "mahmoud_jankowski_2011",
    aliases: &[],
    title: "Modified linear viscoelastic",
    formula: "F = k delta + c v (v > 0), k delta (v <= 0);  c = 2 zeta sqrt(k m),  zeta = (1 - e^2) / (e (e (pi - 2) + 2))",
    citation: "Mahmoud and Jankowski, IJST Transactions C 35 (2011) 51, equations 6-7",
    class: "linear, damping in approach only",
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
    separation_rules: &[SeparationRule::ZeroPenetration],
    needs_approach_velocity: false,
    needs_effective_mass: true,
    verification: Verification::Verified("closed form e = exp(-g(zeta)) of approach-only damping"),
    traps: &[
        "Returns slightly more than asked: 0.2055 for 0.2, 0.6046 for 0.6, 0.6538 for 0.65.",
        "The force jumps to c v0 at closure, and for e below about 0.5 that jump is the peak.",
        "zeta grows to 4.68 at e = 0.1: explicit fixed steps need 2 zeta omega h < 2.78.",
    ],
    build,
};

#[derive(Debug)]
struct MahmoudJankowski {
    stiffness: f64,
    zeta: f64,
}

/// Equation 7 of the paper.
fn damping_ratio(e: f64) -> f64 {
    (1.0 - e * e) / (e * (e * (PI - 2.0) + 2.0))
}

fn build(parameters: &ModelParameters) -> Result<Box<dyn ImpactModel>, GapElementError> {
    Ok(Box::new(MahmoudJankowski {
        stiffness: parameters.required(DESCRIPTOR.name, "stiffness")?,
        zeta: parameters.damping(DESCRIPTOR.name, "damping_ratio", damping_ratio)?,
    }))
}

impl ImpactModel for MahmoudJankowski {
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
        let dashpot = if phase == Phase::Approach {
            collision.constants[1]
        } else {
            0.0
        };
        linear::force(self.stiffness, 1.0, dashpot, delta, velocity)
    }
    fn stored_energy(&self, _: &Collision, _: &Memory, _: Phase, delta: f64) -> f64 {
        hunt_crossley::stored_energy(self.stiffness, 1.0, delta)
    }
    fn transitions(&self, phase: Phase) -> &'static [Transition] {
        approach_only(phase)
    }
    fn closed_form(&self, approach_velocity: f64, effective_mass: f64) -> Option<ClosedForm> {
        Some(linear::closed_form_approach_only(
            self.stiffness,
            1.0,
            self.zeta,
            approach_velocity,
            effective_mass,
        ))
    }
    fn smooth_at_closure(&self) -> bool {
        true
    }
}
