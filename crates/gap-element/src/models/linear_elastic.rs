//! Linear spring: `F = k delta`.

use crate::classes::hunt_crossley;
use crate::descriptor::{ConstantDescriptor, ModelDescriptor, ParameterUnit, Verification};
use crate::error::GapElementError;
use crate::model::{
    ClosedForm, Collision, Force, ImpactModel, Memory, Phase, SeparationRule, Transition,
};
use crate::parameters::{LINEAR_STIFFNESS, ModelParameters};

pub(crate) static DESCRIPTOR: ModelDescriptor = ModelDescriptor {
    name: "linear_elastic",
    aliases: &[],
    title: "Linear spring",
    formula: "F = k delta",
    citation: "Textbook law; in pounding since Maison and Kasai, Earthquake Spectra 6 (1990) 711",
    class: "elastic",
    parameters: &[LINEAR_STIFFNESS],
    constants: &[ConstantDescriptor {
        name: "stiffness",
        unit: ParameterUnit::NewtonPerMetre,
    }],
    separation_rules: &[SeparationRule::ZeroPenetration],
    needs_approach_velocity: false,
    needs_effective_mass: false,
    verification: Verification::Verified("closed form of the harmonic half wave"),
    traps: &["Returns all energy: restitution is 1 whatever the floors are made of."],
    build,
};

#[derive(Debug)]
struct LinearElastic {
    stiffness: f64,
}

fn build(parameters: &ModelParameters) -> Result<Box<dyn ImpactModel>, GapElementError> {
    let stiffness = parameters.required(DESCRIPTOR.name, "stiffness")?;
    Ok(Box::new(LinearElastic { stiffness }))
}

impl ImpactModel for LinearElastic {
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
    fn force(&self, _: &Collision, _: &Memory, _: Phase, delta: f64, _velocity: f64) -> Force {
        Force {
            value: self.stiffness * delta,
            by_penetration: self.stiffness,
            by_velocity: 0.0,
        }
    }
    fn stored_energy(&self, _: &Collision, _: &Memory, _: Phase, delta: f64) -> f64 {
        hunt_crossley::stored_energy(self.stiffness, 1.0, delta)
    }
    fn transitions(&self, _phase: Phase) -> &'static [Transition] {
        &[]
    }
    fn closed_form(&self, approach_velocity: f64, effective_mass: f64) -> Option<ClosedForm> {
        Some(hunt_crossley::closed_form(
            self.stiffness,
            1.0,
            0.0,
            approach_velocity,
            effective_mass,
        ))
    }
    fn smooth_at_closure(&self) -> bool {
        true
    }
}
