//! Hertzdamp: Hertz contact with damping proportional to `delta^1.5 v / v0`.

use crate::classes::hunt_crossley;
use crate::descriptor::{
    ConstantDescriptor, ModelDescriptor, ParameterDescriptor, ParameterUnit, Verification,
};
use crate::error::GapElementError;
use crate::model::{
    APPROACH_VELOCITY_FLOOR, ClosedForm, Collision, Force, ImpactModel, Memory, Phase,
    SeparationRule, Transition,
};
use crate::parameters::{HERTZ_STIFFNESS, ModelParameters, RESTITUTION};

pub(crate) static DESCRIPTOR: ModelDescriptor = ModelDescriptor {
    name: "muthukumar_desroches_2006",
    aliases: &["hertzdamp", "lankarani_nikravesh_1990"],
    title: "Hertzdamp",
    formula: "F = k delta^1.5 (1 + y v / v0);  y = (3/4) (1 - e^2)",
    citation: "Muthukumar and DesRoches, EESD 35 (2006) 811; the identical law: Lankarani and Nikravesh, J. Mechanical Design 112 (1990) 369",
    class: "Hunt-Crossley class with exponent 3/2, damping in both phases",
    parameters: &[HERTZ_STIFFNESS, RESTITUTION, DAMPING_FACTOR],
    constants: &[
        ConstantDescriptor {
            name: "stiffness",
            unit: ParameterUnit::NewtonPerMetreToExponent,
        },
        ConstantDescriptor {
            name: "damping_rate",
            unit: ParameterUnit::SecondPerMetre,
        },
    ],
    separation_rules: &[SeparationRule::ZeroPenetration],
    needs_approach_velocity: true,
    needs_effective_mass: false,
    verification: Verification::Verified("closed form y (1 + e) = ln((1 + y) / (1 - y e))"),
    traps: &[
        "Does not return the restitution asked for: 0.7252 for 0.5, 0.7561 for 0.6, 0.7748 for 0.65; never below 0.66.",
        "Scaled by the approach velocity, taken as at least 1 mm/s.",
        "Pulls if the floors separate faster than v0 / y.",
    ],
    build,
};

const EXPONENT: f64 = 1.5;

/// The dimensionless damping factor, instead of restitution.
const DAMPING_FACTOR: ParameterDescriptor = ParameterDescriptor {
    name: "damping_factor",
    unit: ParameterUnit::One,
    minimum: (0.0, true),
    maximum: (f64::INFINITY, false),
    default: None,
    required: false,
    explanation: "Dimensionless damping factor y, instead of restitution",
};

#[derive(Debug)]
struct Hertzdamp {
    stiffness: f64,
    y: f64,
}

fn damping_factor(e: f64) -> f64 {
    0.75 * (1.0 - e * e)
}

fn build(parameters: &ModelParameters) -> Result<Box<dyn ImpactModel>, GapElementError> {
    Ok(Box::new(Hertzdamp {
        stiffness: parameters.required(DESCRIPTOR.name, "stiffness")?,
        y: parameters.damping(DESCRIPTOR.name, "damping_factor", damping_factor)?,
    }))
}

impl ImpactModel for Hertzdamp {
    fn descriptor(&self) -> &'static ModelDescriptor {
        &DESCRIPTOR
    }
    fn separation(&self) -> SeparationRule {
        SeparationRule::ZeroPenetration
    }
    fn begin(&self, approach_velocity: f64, effective_mass: f64) -> Collision {
        let rate = self.y / approach_velocity.max(APPROACH_VELOCITY_FLOOR);
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
        _: Phase,
        delta: f64,
        velocity: f64,
    ) -> Force {
        hunt_crossley::force(
            self.stiffness,
            EXPONENT,
            collision.constants[1],
            delta,
            velocity,
        )
    }
    fn stored_energy(&self, _: &Collision, _: &Memory, _: Phase, delta: f64) -> f64 {
        hunt_crossley::stored_energy(self.stiffness, EXPONENT, delta)
    }
    fn transitions(&self, _phase: Phase) -> &'static [Transition] {
        &[]
    }
    fn closed_form(&self, approach_velocity: f64, effective_mass: f64) -> Option<ClosedForm> {
        (approach_velocity >= APPROACH_VELOCITY_FLOOR).then(|| {
            hunt_crossley::closed_form(
                self.stiffness,
                EXPONENT,
                self.y,
                approach_velocity,
                effective_mass,
            )
        })
    }
    fn smooth_at_closure(&self) -> bool {
        false
    }
}
