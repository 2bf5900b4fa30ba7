//! The class as an impact model: a published law is a relation `zeta(e)`, an
//! exponent, a phase rule and a separation rule.

use super::closed_forms;
use crate::classes::{
    DampingPhases, approach_only, gap_shift, hunt_crossley, no_tension, no_tension_latched, unbuilt,
};
use crate::descriptor::{
    AchievedRestitution, ModelDescriptor, ParameterUnit, Verification, constant,
};
use crate::error::GapElementError;
use crate::model::{
    ClosedForm, Collision, Force, ImpactModel, Memory, Phase, PowerLaw, SeparationRule, Transition,
};
use crate::parameters::{
    DAMPING_RATIO, EXPONENT, LINEAR_STIFFNESS, ModelParameters, POWER_STIFFNESS, RESTITUTION,
};

/// What all descriptors of the class share; the exponent is free, 3/2 by default.
pub(crate) const DESCRIPTOR: ModelDescriptor = ModelDescriptor {
    name: "",
    aliases: &[],
    title: "",
    formula: "",
    citation: "",
    class: "linear class, damping in both phases",
    parameters: &[POWER_STIFFNESS, RESTITUTION, DAMPING_RATIO, EXPONENT],
    constants: &[
        constant("stiffness", ParameterUnit::NewtonPerMetreToExponent),
        constant("class_damping_ratio", ParameterUnit::One),
    ],
    separation_rules: &[SeparationRule::ZeroPenetration],
    needs_approach_velocity: false,
    needs_effective_mass: true,
    achieved_restitution: AchievedRestitution::Constant,
    recommended: false,
    verification: Verification::Verified("closed form of the damped oscillator"),
    example: &[("stiffness", 2.75e9)],
    traps: &[],
    build: unbuilt,
};

/// The same with the exponent 1.
pub(crate) const LINEAR_DESCRIPTOR: ModelDescriptor = ModelDescriptor {
    class: "linear class, exponent 1, damping in both phases",
    parameters: &[LINEAR_STIFFNESS, RESTITUTION, DAMPING_RATIO],
    constants: &[
        constant("stiffness", ParameterUnit::NewtonPerMetre),
        constant("dashpot", ParameterUnit::NewtonSecondPerMetre),
    ],
    example: &[("stiffness", 9.35e7)],
    ..DESCRIPTOR
};

/// `F = k delta^n + c delta^((n-1)/2) v` with one relation `zeta(e)`.
#[derive(Debug)]
pub(crate) struct LinearClass {
    pub(crate) descriptor: &'static ModelDescriptor,
    pub(crate) stiffness: f64,
    pub(crate) exponent: f64,
    /// `c / sqrt(2 (n + 1) k m)`.
    pub(crate) zeta: f64,
    pub(crate) phases: DampingPhases,
    pub(crate) separation: SeparationRule,
}

impl LinearClass {
    /// A law with the exponent 1 from its descriptor, the parameters and the paper's
    /// relation `zeta(e)`.
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
            zeta: parameters.damping(descriptor, "damping_ratio", relation)?,
            phases,
            separation: parameters.separation(descriptor),
        }))
    }

    fn dashpot(&self, effective_mass: f64) -> f64 {
        self.zeta * (2.0 * (self.exponent + 1.0) * self.stiffness * effective_mass).sqrt()
    }

    fn law(&self, collision: &Collision, phase: Phase, delta: f64, velocity: f64) -> Force {
        let damped = self.phases == DampingPhases::Both || phase == Phase::Approach;
        let dashpot = match (damped, self.exponent == 1.0) {
            (false, _) => 0.0,
            (true, true) => collision.constants[1],
            (true, false) => collision.constants[2],
        };
        super::force(self.stiffness, self.exponent, dashpot, delta, velocity)
    }
}

impl ImpactModel for LinearClass {
    fn descriptor(&self) -> &'static ModelDescriptor {
        self.descriptor
    }
    fn separation(&self) -> SeparationRule {
        self.separation
    }
    fn begin(&self, approach_velocity: f64, effective_mass: f64) -> Collision {
        let dashpot = self.dashpot(effective_mass);
        let constant = if self.exponent == 1.0 {
            dashpot
        } else {
            self.zeta
        };
        Collision {
            approach_velocity,
            effective_mass,
            // The third is not on the descriptor: it spares a root at every evaluation.
            constants: [self.stiffness, constant, dashpot, 0.0],
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
    fn raw_force(
        &self,
        collision: &Collision,
        _: &Memory,
        _: Phase,
        delta: f64,
        velocity: f64,
    ) -> f64 {
        if self.exponent == 1.0 {
            return self.law(collision, Phase::Approach, delta, velocity).value;
        }
        // Over `delta^((n - 1) / 2)`: no zero of a high order at closure.
        let dashpot = collision.constants[2];
        if dashpot == 0.0 {
            return self.stiffness;
        }
        let spring = libm::pow(delta.max(0.0), 0.5 * (self.exponent + 1.0));
        self.stiffness * spring + dashpot * velocity
    }
    fn is_affine(&self, _: &Collision, phase: Phase) -> bool {
        self.exponent == 1.0 || phase == Phase::Released
    }
    fn power_law(&self, collision: &Collision, phase: Phase) -> Option<PowerLaw> {
        let damped = self.phases == DampingPhases::Both || phase == Phase::Approach;
        (self.exponent != 1.0 && phase != Phase::Released).then(|| PowerLaw {
            stiffness: self.stiffness,
            exponent: self.exponent,
            dashpot: if damped { collision.constants[2] } else { 0.0 },
            dashpot_exponent: 0.5 * (self.exponent - 1.0),
        })
    }
    fn stored_energy(&self, _: &Collision, _: &Memory, _: Phase, delta: f64) -> f64 {
        hunt_crossley::stored_energy(self.stiffness, self.exponent, delta)
    }
    fn transitions(&self, phase: Phase) -> &'static [Transition] {
        match (self.phases, self.separation) {
            (DampingPhases::ApproachOnly, _) => approach_only(phase),
            (_, SeparationRule::ZeroPenetration) => &[],
            (_, SeparationRule::NoTension) => no_tension(phase),
            (_, SeparationRule::NoTensionLatched) => no_tension_latched(phase),
            (_, SeparationRule::GapShift) => gap_shift(phase),
        }
    }
    fn closed_form(&self, approach_velocity: f64, effective_mass: f64) -> Option<ClosedForm> {
        Some(closed_forms::closed_form(
            (self.phases, self.separation),
            (self.stiffness, self.exponent, self.zeta),
            approach_velocity,
            effective_mass,
        ))
    }
    fn smooth_at_closure(&self) -> bool {
        self.exponent == 1.0
    }
}
