//! Rigid impact: velocities jump, nothing deforms.

use crate::classes::hunt_crossley;
use crate::descriptor::{
    AchievedRestitution, Alias, ModelDescriptor, ParameterDescriptor, Verification,
};
use crate::error::GapElementError;
use crate::model::{
    ClosedForm, Collision, Direction, Force, Guard, ImpactModel, Memory, Phase, SeparationRule,
    Target, Transition,
};
use crate::parameters::{ModelParameters, RESTITUTION};

pub(crate) static DESCRIPTOR: ModelDescriptor = ModelDescriptor {
    name: "stereomechanical",
    aliases: &[
        Alias {
            name: "newton_restitution",
            citation: "Newton, Principia (1687), scholium to the laws of motion",
        },
        Alias {
            name: "goldsmith_1960",
            citation: "Goldsmith, Impact (1960)",
        },
    ],
    title: "Velocity jump with Newton's restitution",
    formula: "v_left' = v_left - (1 + e) m_right v0 / (m_left + m_right),  v_right' = v_right + (1 + e) m_left v0 / (m_left + m_right);  lasting contact holds with any force F >= 0",
    citation: "Newton 1687; Goldsmith, Impact (1960); simultaneous impacts as a linear complementarity problem: Jean and Moreau (1992)",
    class: "rigid, non-smooth",
    parameters: &[RESTITUTION_ASKED],
    constants: &[],
    separation_rules: &[SeparationRule::ZeroPenetration],
    needs_effective_mass: true,
    achieved_restitution: AchievedRestitution::Constant,
    verification: Verification::Verified(
        "impulse-momentum theory; the bouncing ball with its infinite sequence of impacts to 1e-9",
    ),
    example: &[],
    traps: &[
        "Contact force and contact time are undefined: impulses are reported.",
        "Only the two floors that touch change their velocity; storeys feel an infinite acceleration, so peaks of floor acceleration have no meaning at impacts.",
        "Impacts that follow one another ever faster end in lasting contact.",
        "Simultaneous impacts are solved together; the answer (Newton's restitution in every contact) is one of several that experiments show.",
        "The method moreau_jean treats it without locating events; all others locate every impact.",
    ],
    build,
    ..hunt_crossley::DESCRIPTOR
};

const RESTITUTION_ASKED: ParameterDescriptor = ParameterDescriptor {
    required: true,
    minimum: (0.0, true),
    ..RESTITUTION
};

/// Lasting contact ends when it would have to pull.
const STUCK: [Transition; 1] = [Transition {
    guard: Guard::StickLower,
    direction: Direction::Falling,
    target: Target::Open,
}];

#[derive(Debug)]
struct Stereomechanical {
    restitution: f64,
}

fn build(parameters: &ModelParameters) -> Result<Box<dyn ImpactModel>, GapElementError> {
    Ok(Box::new(Stereomechanical {
        restitution: parameters.get(&DESCRIPTOR, "restitution")?,
    }))
}

impl ImpactModel for Stereomechanical {
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
            constants: [0.0; 4],
        }
    }
    fn force(&self, _: &Collision, _: &Memory, _: Phase, _delta: f64, _velocity: f64) -> Force {
        Force::default()
    }
    fn stored_energy(&self, _: &Collision, _: &Memory, _: Phase, _delta: f64) -> f64 {
        0.0
    }
    fn transitions(&self, phase: Phase) -> &'static [Transition] {
        match phase {
            Phase::Stuck => &STUCK,
            _ => &[],
        }
    }
    fn rigid_restitution(&self) -> Option<f64> {
        Some(self.restitution)
    }
    fn stick_range(&self, _: &Collision, _: &Memory, _delta: f64) -> (f64, f64) {
        (0.0, f64::INFINITY)
    }
    fn closed_form(&self, _approach_velocity: f64, _effective_mass: f64) -> Option<ClosedForm> {
        Some(ClosedForm {
            restitution: self.restitution,
            peak_penetration: None,
            peak_force: None,
            duration: Some(0.0),
        })
    }
    fn smooth_at_closure(&self) -> bool {
        true
    }
}
