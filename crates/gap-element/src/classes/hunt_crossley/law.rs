//! The class as an impact model: a published law is a relation `y(e)`, an exponent
//! and a phase rule.

use super::closed_forms;
use crate::classes::{DampingPhases, approach_only, no_tension, unbuilt};
use crate::descriptor::{
    AchievedRestitution, ModelDescriptor, ParameterUnit, Verification, constant,
};
use crate::error::GapElementError;
use crate::model::{
    APPROACH_VELOCITY_FLOOR, ClosedForm, Collision, Force, ImpactModel, Memory, Phase, PowerLaw,
    SeparationRule, Transition,
};
use crate::parameters::{
    DAMPING_FACTOR, EXPONENT, LINEAR_STIFFNESS, ModelParameters, POWER_STIFFNESS, RESTITUTION,
};

/// What all descriptors of the class share; the exponent is free, 3/2 by default.
pub(crate) const DESCRIPTOR: ModelDescriptor = ModelDescriptor {
    name: "",
    aliases: &[],
    title: "",
    formula: "",
    citation: "",
    class: "Hunt-Crossley class, damping in both phases",
    parameters: &[POWER_STIFFNESS, RESTITUTION, DAMPING_FACTOR, EXPONENT],
    constants: &[
        constant("stiffness", ParameterUnit::NewtonPerMetreToExponent),
        constant("damping_rate", ParameterUnit::SecondPerMetre),
    ],
    separation_rules: &[SeparationRule::ZeroPenetration, SeparationRule::NoTension],
    needs_approach_velocity: true,
    needs_effective_mass: false,
    achieved_restitution: AchievedRestitution::Constant,
    recommended: false,
    verification: Verification::Verified("closed form y (1 + e) = ln((1 + y) / (1 - y e))"),
    example: &[("stiffness", 2.75e9)],
    traps: &[],
    build: unbuilt,
};

/// The same with the exponent 1.
pub(crate) const LINEAR_DESCRIPTOR: ModelDescriptor = ModelDescriptor {
    class: "Hunt-Crossley class, exponent 1, damping in both phases",
    parameters: &[LINEAR_STIFFNESS, RESTITUTION, DAMPING_FACTOR],
    constants: &[
        constant("stiffness", ParameterUnit::NewtonPerMetre),
        constant("damping_rate", ParameterUnit::SecondPerMetre),
    ],
    example: &[("stiffness", 9.35e7)],
    ..DESCRIPTOR
};

/// `F = k delta^n (1 + y v / v0)` with one relation `y(e)`.
#[derive(Debug)]
pub(crate) struct HuntCrossley {
    descriptor: &'static ModelDescriptor,
    stiffness: f64,
    exponent: f64,
    damping_factor: f64,
    phases: DampingPhases,
    separation: SeparationRule,
}

impl HuntCrossley {
    /// A spring without damping.
    pub(crate) fn elastic(
        descriptor: &'static ModelDescriptor,
        parameters: &ModelParameters,
        exponent: f64,
    ) -> Result<Box<dyn ImpactModel>, GapElementError> {
        Ok(Box::new(Self {
            descriptor,
            stiffness: parameters.get(descriptor, "stiffness")?,
            exponent,
            damping_factor: 0.0,
            phases: DampingPhases::Both,
            separation: SeparationRule::ZeroPenetration,
        }))
    }

    /// The model from its descriptor, the parameters and the paper's relation `y(e)`.
    pub(crate) fn build(
        descriptor: &'static ModelDescriptor,
        parameters: &ModelParameters,
        phases: DampingPhases,
        relation: impl Fn(f64) -> f64,
    ) -> Result<Box<dyn ImpactModel>, GapElementError> {
        Ok(Box::new(Self {
            descriptor,
            stiffness: parameters.get(descriptor, "stiffness")?,
            exponent: parameters.exponent(descriptor),
            damping_factor: parameters.damping(descriptor, "damping_factor", relation)?,
            phases,
            separation: parameters.separation(descriptor),
        }))
    }

    fn law(&self, collision: &Collision, phase: Phase, delta: f64, velocity: f64) -> Force {
        let damped = self.phases == DampingPhases::Both || phase == Phase::Approach;
        let rate = if damped { collision.constants[1] } else { 0.0 };
        super::force(self.stiffness, self.exponent, rate, delta, velocity)
    }
}

impl ImpactModel for HuntCrossley {
    fn descriptor(&self) -> &'static ModelDescriptor {
        self.descriptor
    }
    fn separation(&self) -> SeparationRule {
        self.separation
    }
    fn begin(&self, approach_velocity: f64, effective_mass: f64) -> Collision {
        let rate = self.damping_factor / approach_velocity.max(APPROACH_VELOCITY_FLOOR);
        Collision {
            approach_velocity,
            effective_mass,
            constants: [self.stiffness, rate, 0.0, 0.0],
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
        self.law(collision, phase, delta, velocity)
    }
    /// `1 + y v / v0`: the sign of the force, without its zero at closure.
    fn raw_force(
        &self,
        collision: &Collision,
        _: &Memory,
        _: Phase,
        _delta: f64,
        velocity: f64,
    ) -> f64 {
        1.0 + collision.constants[1] * velocity
    }
    fn is_affine(&self, collision: &Collision, phase: Phase) -> bool {
        let damped = self.phases == DampingPhases::Both || phase == Phase::Approach;
        let elastic = !damped || collision.constants[1] == 0.0;
        (self.exponent == 1.0 && elastic) || phase == Phase::Released
    }
    fn power_law(&self, collision: &Collision, phase: Phase) -> Option<PowerLaw> {
        let damped = self.phases == DampingPhases::Both || phase == Phase::Approach;
        let rate = if damped { collision.constants[1] } else { 0.0 };
        (phase != Phase::Released).then_some(PowerLaw {
            stiffness: self.stiffness,
            exponent: self.exponent,
            dashpot: self.stiffness * rate,
            dashpot_exponent: self.exponent,
        })
    }
    fn stored_energy(&self, _: &Collision, _: &Memory, _: Phase, delta: f64) -> f64 {
        super::stored_energy(self.stiffness, self.exponent, delta)
    }
    fn transitions(&self, phase: Phase) -> &'static [Transition] {
        match (self.phases, self.separation) {
            (DampingPhases::ApproachOnly, _) => approach_only(phase),
            (_, SeparationRule::NoTension) => no_tension(phase),
            _ => &[],
        }
    }
    fn closed_form(&self, approach_velocity: f64, effective_mass: f64) -> Option<ClosedForm> {
        let scaled = approach_velocity >= APPROACH_VELOCITY_FLOOR || self.damping_factor == 0.0;
        scaled.then(|| {
            closed_forms::closed_form(
                self.phases,
                (self.stiffness, self.exponent, self.damping_factor),
                approach_velocity,
                effective_mass,
            )
        })
    }
    fn smooth_at_closure(&self) -> bool {
        self.exponent == 1.0
    }
}
