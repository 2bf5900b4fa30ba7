//! Dry friction: the spring force is raised in approach and lowered in
//! restitution by the same part.

use crate::classes::{elastic_time_factor, hunt_crossley};
use crate::descriptor::{
    ConstantDescriptor, ModelDescriptor, ParameterDescriptor, ParameterUnit, Verification,
};
use crate::error::GapElementError;
use crate::model::{
    ClosedForm, Collision, Direction, Force, Guard, ImpactModel, Memory, Phase, SeparationRule,
    Target, Transition,
};
use crate::parameters::{ModelParameters, RESTITUTION};

pub(crate) static DESCRIPTOR: ModelDescriptor = ModelDescriptor {
    name: "borovin_2014",
    aliases: &["dry_friction"],
    title: "Dry friction in the contact",
    formula: "F = k delta^n (1 + D sgn v);  D = (1 - e^2) / (1 + e^2);  at v = 0 it holds with any force between k delta^n (1 - D) and k delta^n (1 + D)",
    citation: "Borovin, Lapshin and Yurin, Keldysh Institute preprint 46 (2014), equations 3-4",
    class: "dry friction",
    parameters: &[STIFFNESS, RESTITUTION, FRICTION, EXPONENT],
    constants: &[
        ConstantDescriptor {
            name: "stiffness",
            unit: ParameterUnit::NewtonPerMetreToExponent,
        },
        ConstantDescriptor {
            name: "friction",
            unit: ParameterUnit::One,
        },
        ConstantDescriptor {
            name: "exponent",
            unit: ParameterUnit::One,
        },
    ],
    separation_rules: &[SeparationRule::ZeroPenetration],
    needs_approach_velocity: false,
    needs_effective_mass: false,
    verification: Verification::Verified(
        "the preprint's ball on concrete, closed form, all printed digits",
    ),
    traps: &[
        "Exact restitution, independent of speed, mass and spring.",
        "The force drops by (1 - D) / (1 + D) at the turning point.",
        "Floors that stop relative to one another stick; fixed steps without that state chatter.",
    ],
    build,
};

const STIFFNESS: ParameterDescriptor = ParameterDescriptor {
    name: "stiffness",
    unit: ParameterUnit::NewtonPerMetreToExponent,
    minimum: (0.0, false),
    maximum: (f64::INFINITY, false),
    default: None,
    required: true,
    explanation: "Contact stiffness, N/m^n with the exponent n",
};
const EXPONENT: ParameterDescriptor = ParameterDescriptor {
    name: "exponent",
    unit: ParameterUnit::One,
    minimum: (1.0, true),
    maximum: (5.0, true),
    default: Some(1.5),
    required: false,
    explanation: "Exponent n of the spring",
};
const FRICTION: ParameterDescriptor = ParameterDescriptor {
    name: "friction",
    unit: ParameterUnit::One,
    minimum: (0.0, true),
    maximum: (1.0, false),
    default: None,
    required: false,
    explanation: "Friction factor D, instead of restitution",
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

#[derive(Debug)]
struct DryFriction {
    stiffness: f64,
    exponent: f64,
    friction: f64,
}

fn friction(e: f64) -> f64 {
    (1.0 - e * e) / (1.0 + e * e)
}

fn build(parameters: &ModelParameters) -> Result<Box<dyn ImpactModel>, GapElementError> {
    Ok(Box::new(DryFriction {
        stiffness: parameters.required(DESCRIPTOR.name, "stiffness")?,
        exponent: parameters.get("exponent").unwrap_or(1.5),
        friction: parameters.damping(DESCRIPTOR.name, "friction", friction)?,
    }))
}

impl ImpactModel for DryFriction {
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
            constants: [self.stiffness, self.friction, self.exponent, 0.0],
        }
    }
    fn force(&self, _: &Collision, _: &Memory, phase: Phase, delta: f64, _velocity: f64) -> Force {
        let factor = match phase {
            Phase::Approach => 1.0 + self.friction,
            Phase::Restitution => 1.0 - self.friction,
            Phase::Stuck | Phase::Released => return Force::default(),
        };
        let (spring, slope) = hunt_crossley::elastic(self.stiffness, self.exponent, delta);
        Force {
            value: spring * factor,
            by_penetration: slope * factor,
            by_velocity: 0.0,
        }
    }
    fn stored_energy(&self, _: &Collision, _: &Memory, _: Phase, delta: f64) -> f64 {
        hunt_crossley::stored_energy(self.stiffness, self.exponent, delta)
    }
    fn transitions(&self, phase: Phase) -> &'static [Transition] {
        match phase {
            Phase::Approach => &APPROACH,
            Phase::Restitution => &RESTITUTION_PHASE,
            Phase::Stuck => &STUCK,
            Phase::Released => &[],
        }
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
        let restitution = ((1.0 - d) / (1.0 + d)).sqrt();
        let energy = effective_mass * approach_velocity * approach_velocity;
        let peak = (power * energy / (2.0 * self.stiffness * (1.0 + d))).powf(1.0 / power);
        let compression = elastic_time_factor(self.exponent) * peak / approach_velocity;
        Some(ClosedForm {
            restitution,
            peak_penetration: Some(peak),
            peak_force: Some(
                hunt_crossley::elastic(self.stiffness, self.exponent, peak).0 * (1.0 + d),
            ),
            duration: (approach_velocity > 0.0).then_some(compression * (1.0 + 1.0 / restitution)),
        })
    }
    fn smooth_at_closure(&self) -> bool {
        self.exponent == 1.0
    }
}
