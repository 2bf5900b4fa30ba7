//! Hertz contact: `F = k delta^1.5`.

use crate::classes::hunt_crossley;
use crate::descriptor::{ConstantDescriptor, ModelDescriptor, ParameterUnit, Verification};
use crate::error::GapElementError;
use crate::model::{
    ClosedForm, Collision, Force, ImpactModel, Memory, Phase, SeparationRule, Transition,
};
use crate::parameters::{HERTZ_STIFFNESS, ModelParameters};

pub(crate) static DESCRIPTOR: ModelDescriptor = ModelDescriptor {
    name: "hertz_1882",
    aliases: &[],
    title: "Hertz contact without damping",
    formula: "F = k delta^1.5",
    citation: "Hertz, J. reine angew. Math. 92 (1882) 156; in pounding: Jing and Young, EESD 20 (1991) 667; Chau and Wei, EESD 30 (2001) 633",
    class: "elastic",
    parameters: &[HERTZ_STIFFNESS],
    constants: &[ConstantDescriptor {
        name: "stiffness",
        unit: ParameterUnit::NewtonPerMetreToExponent,
    }],
    separation_rules: &[SeparationRule::ZeroPenetration],
    needs_approach_velocity: false,
    needs_effective_mass: false,
    verification: Verification::Verified("closed form: contact time 2.9432751843 delta_max / v0"),
    traps: &[
        "Returns all energy: restitution is 1.",
        "Derived for curved bodies; the stiffness of slab against slab is a fitted penalty, not Hertz's.",
    ],
    build,
};

const EXPONENT: f64 = 1.5;

#[derive(Debug)]
struct Hertz {
    stiffness: f64,
}

fn build(parameters: &ModelParameters) -> Result<Box<dyn ImpactModel>, GapElementError> {
    let stiffness = parameters.required(DESCRIPTOR.name, "stiffness")?;
    Ok(Box::new(Hertz { stiffness }))
}

impl ImpactModel for Hertz {
    fn descriptor(&self) -> &'static ModelDescriptor {
        &DESCRIPTOR
    }
    fn separation(&self) -> SeparationRule {
        SeparationRule::ZeroPenetration
    }
    fn begin(&self, approach_velocity: f64, effective_mass: f64) -> Collision {
        Collision {
            approach_velocity,
            effective_mass,
            constants: [self.stiffness, 0.0, 0.0, 0.0],
        }
    }
    fn force(&self, _: &Collision, _: &Memory, _: Phase, delta: f64, velocity: f64) -> Force {
        hunt_crossley::force(self.stiffness, EXPONENT, 0.0, delta, velocity)
    }
    fn stored_energy(&self, _: &Collision, _: &Memory, _: Phase, delta: f64) -> f64 {
        hunt_crossley::stored_energy(self.stiffness, EXPONENT, delta)
    }
    fn transitions(&self, _phase: Phase) -> &'static [Transition] {
        &[]
    }
    fn closed_form(&self, approach_velocity: f64, effective_mass: f64) -> Option<ClosedForm> {
        Some(hunt_crossley::closed_form(
            self.stiffness,
            EXPONENT,
            0.0,
            approach_velocity,
            effective_mass,
        ))
    }
    fn smooth_at_closure(&self) -> bool {
        false
    }
}
