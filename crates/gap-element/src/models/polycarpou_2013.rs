//! Rubber bumper: damped in approach only, stiff once it is crushed.

use crate::classes::hunt_crossley::{self, elastic, restitution_approach_only};
use crate::descriptor::{
    AchievedRestitution, ModelDescriptor, ParameterDescriptor, ParameterUnit, Verification,
};
use crate::error::GapElementError;
use crate::model::{
    APPROACH_VELOCITY_FLOOR, ClosedForm, Collision, Direction, Force, Guard, ImpactModel, Memory,
    Phase, SeparationRule, Target, Transition,
};
use crate::parameters::{
    DAMPING_FACTOR, EXPONENT, ModelParameters, POWER_STIFFNESS, RESTITUTION, optional_positive,
};

pub(crate) static DESCRIPTOR: ModelDescriptor = ModelDescriptor {
    name: "polycarpou_2013",
    title: "Rubber bumper",
    formula: "F = f(delta) (1 + y v / v0) (v > 0), f(delta) (v <= 0);  f = k delta^n up to crushing, then f_u + k_u (delta - delta_u);  y = (3/2) (1 - e^2) / e^2",
    citation: "Polycarpou, Komodromos and Polycarpou, Earthquake Engineering and Structural Dynamics 42 (2013) 81",
    class: "Hunt-Crossley class, damping in approach only, stiff branch when crushed",
    parameters: &[
        POWER_STIFFNESS,
        RESTITUTION,
        DAMPING_FACTOR,
        BUMPER_EXPONENT,
        CRUSH_PENETRATION,
        CRUSH_STIFFNESS,
    ],
    separation_rules: &[SeparationRule::ZeroPenetration],
    achieved_restitution: AchievedRestitution::Constant,
    verification: Verification::SecondarySources(
        "exponent, crushed branch and calibration of k not compared with the paper; behaviour verified against the closed form e = sqrt(2 (y - ln(1 + y))) / y, which holds with the crushed branch too",
    ),
    example: &[
        ("stiffness", 3.0e10),
        ("crush_penetration", 0.015),
        ("crush_stiffness", 5.0e8),
    ],
    traps: &[
        "Returns a little more than asked: 0.5254 for 0.5, 0.6201 for 0.6, 0.6670 for 0.65.",
        "Without crush_penetration and crush_stiffness the bumper never bottoms out.",
        "Damping multiplies the spring force on the crushed branch too; the paper's own rule there could not be verified.",
    ],
    build,
    ..hunt_crossley::DESCRIPTOR
};

const BUMPER_EXPONENT: ParameterDescriptor = ParameterDescriptor {
    default: Some(2.65),
    ..EXPONENT
};
const CRUSH_PENETRATION: ParameterDescriptor = optional_positive(
    "crush_penetration",
    ParameterUnit::Metre,
    "Penetration at which the bumper is crushed; together with crush_stiffness",
);
const CRUSH_STIFFNESS: ParameterDescriptor = optional_positive(
    "crush_stiffness",
    ParameterUnit::NewtonPerMetre,
    "Stiffness of the crushed bumper; together with crush_penetration",
);

const CRUSHED_APPROACH: Phase = Phase::Branch(0);
const CRUSHED_RESTITUTION: Phase = Phase::Branch(1);

const fn turn(direction: Direction, target: Phase) -> Transition {
    Transition {
        guard: Guard::Velocity,
        direction,
        target: Target::Phase(target),
    }
}
/// `delta - delta_u` changes sign.
const fn crush(direction: Direction, target: Phase) -> Transition {
    Transition {
        guard: Guard::Model(0),
        direction,
        target: Target::Phase(target),
    }
}
const APPROACH: [Transition; 2] = [
    turn(Direction::Falling, Phase::Restitution),
    crush(Direction::Rising, CRUSHED_APPROACH),
];
const RETURN: [Transition; 1] = [turn(Direction::Rising, Phase::Approach)];
const CRUSHED: [Transition; 1] = [turn(Direction::Falling, CRUSHED_RESTITUTION)];
const CRUSHED_RETURN: [Transition; 2] = [
    turn(Direction::Rising, CRUSHED_APPROACH),
    crush(Direction::Falling, Phase::Restitution),
];

#[derive(Debug)]
struct RubberBumper {
    stiffness: f64,
    exponent: f64,
    damping_factor: f64,
    crush_penetration: f64,
    crush_stiffness: f64,
}

fn build(parameters: &ModelParameters) -> Result<Box<dyn ImpactModel>, GapElementError> {
    let (crush_penetration, crush_stiffness) = match (
        parameters.given("crush_penetration"),
        parameters.given("crush_stiffness"),
    ) {
        (Some(penetration), Some(stiffness)) => (penetration, stiffness),
        (None, None) => (f64::INFINITY, 0.0),
        (Some(_), None) => {
            parameters.get(&DESCRIPTOR, "crush_stiffness")?;
            (f64::INFINITY, 0.0)
        }
        (None, Some(_)) => {
            parameters.get(&DESCRIPTOR, "crush_penetration")?;
            (f64::INFINITY, 0.0)
        }
    };
    Ok(Box::new(RubberBumper {
        stiffness: parameters.get(&DESCRIPTOR, "stiffness")?,
        exponent: parameters.exponent(&DESCRIPTOR),
        damping_factor: parameters.damping(
            &DESCRIPTOR,
            "damping_factor",
            super::pant_2010::damping_factor,
        )?,
        crush_penetration,
        crush_stiffness,
    }))
}

impl RubberBumper {
    fn is_crushed(&self, phase: Phase) -> bool {
        matches!(phase, CRUSHED_APPROACH | CRUSHED_RESTITUTION)
            && self.crush_penetration.is_finite()
    }

    /// Spring force and its slope.
    fn spring(&self, phase: Phase, delta: f64) -> (f64, f64) {
        if self.is_crushed(phase) {
            let (at_crush, _) = elastic(self.stiffness, self.exponent, self.crush_penetration);
            let beyond = delta - self.crush_penetration;
            (
                at_crush + self.crush_stiffness * beyond,
                self.crush_stiffness,
            )
        } else {
            elastic(self.stiffness, self.exponent, delta)
        }
    }
}

impl ImpactModel for RubberBumper {
    fn descriptor(&self) -> &'static ModelDescriptor {
        &DESCRIPTOR
    }
    fn separation(&self) -> SeparationRule {
        SeparationRule::ZeroPenetration
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
        let rate = match phase {
            Phase::Approach | CRUSHED_APPROACH => collision.constants[1],
            Phase::Restitution | CRUSHED_RESTITUTION => 0.0,
            _ => return Force::default(),
        };
        let (spring, slope) = self.spring(phase, delta);
        let factor = 1.0 + rate * velocity;
        Force {
            value: spring * factor,
            by_penetration: slope * factor,
            by_velocity: spring * rate,
        }
    }
    fn guard(&self, _: u8, _: &Collision, _: &Memory, delta: f64, _velocity: f64) -> f64 {
        // Without crushing the threshold is infinite: the guard stays negative.
        delta - self.crush_penetration.min(1.0e6)
    }
    fn stored_energy(&self, _: &Collision, _: &Memory, phase: Phase, delta: f64) -> f64 {
        if self.is_crushed(phase) {
            let crush = self.crush_penetration;
            let (at_crush, _) = elastic(self.stiffness, self.exponent, crush);
            let beyond = delta - crush;
            hunt_crossley::stored_energy(self.stiffness, self.exponent, crush)
                + (at_crush + 0.5 * self.crush_stiffness * beyond) * beyond
        } else {
            hunt_crossley::stored_energy(self.stiffness, self.exponent, delta)
        }
    }
    fn transitions(&self, phase: Phase) -> &'static [Transition] {
        match phase {
            Phase::Approach => &APPROACH,
            Phase::Restitution => &RETURN,
            CRUSHED_APPROACH => &CRUSHED,
            CRUSHED_RESTITUTION => &CRUSHED_RETURN,
            _ => &[],
        }
    }
    /// The phase-plane integral of the class holds for any spring: only the
    /// penetration depends on it.
    fn closed_form(&self, approach_velocity: f64, _effective_mass: f64) -> Option<ClosedForm> {
        (approach_velocity >= APPROACH_VELOCITY_FLOOR).then(|| ClosedForm {
            restitution: restitution_approach_only(self.damping_factor),
            peak_penetration: None,
            peak_force: None,
            duration: None,
        })
    }
    fn smooth_at_closure(&self) -> bool {
        false
    }
}
