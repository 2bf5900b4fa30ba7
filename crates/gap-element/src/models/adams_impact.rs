//! The IMPACT function of ADAMS: a power spring and a dashpot that is switched on
//! smoothly with the penetration.

use pounding_catalogue::Descriptor;

use crate::classes::hunt_crossley::{self, elastic};
use crate::classes::no_tension;
use crate::descriptor::{
    AchievedRestitution, ModelDescriptor, ParameterDescriptor, ParameterUnit, Verification,
    constant,
};
use crate::error::GapElementError;
use crate::model::{
    ClosedForm, Collision, Direction, Force, Guard, ImpactModel, Memory, Phase, SeparationRule,
    Target, Transition,
};
use crate::parameters::{EXPONENT, ModelParameters, POWER_STIFFNESS, optional_non_negative};

pub(crate) static DESCRIPTOR: ModelDescriptor = ModelDescriptor {
    name: "adams_impact",
    title: "IMPACT function of ADAMS",
    formula: "F = max(0, k delta^n + c(delta) v);  c = c_max s^2 (3 - 2 s), s = min(delta / d, 1)",
    citation: "MSC/Altair documentation of the functions IMPACT and STEP; Zhou, Wu, Zhang and Xie 2012",
    class: "power spring, dashpot stepped with penetration",
    parameters: &[
        POWER_STIFFNESS,
        DAMPING,
        DAMPING_RATIO,
        FULL_DAMPING_PENETRATION,
        EXPONENT,
    ],
    constants: &[
        constant("stiffness", ParameterUnit::NewtonPerMetreToExponent),
        constant("damping", ParameterUnit::NewtonSecondPerMetre),
        constant("full_damping_penetration", ParameterUnit::Metre),
    ],
    separation_rules: &[SeparationRule::NoTension],
    needs_approach_velocity: false,
    achieved_restitution: AchievedRestitution::Varies,
    verification: Verification::Verified(
        "independent integration of the two steel balls of Zhou et al. 2012",
    ),
    example: &[("stiffness", 2.75e9), ("damping", 7.0e5)],
    traps: &[
        "No restitution can be asked for: it depends on speed, mass, stiffness and full_damping_penetration.",
        "The rule c_max = 0.1 to 1 % of k is a ratio of numbers in N, mm and s: give it as damping_ratio_n_mm_s. In SI it is c_max = ratio k 10^(3 - 3 n).",
        "For the steel balls of Zhou et al. the rule's 0.1 % returns 0.23 and 1 % returns 0.04; 0.8 needs 0.0068 %.",
        "Without memory: a force that was cut at zero may return within the same contact.",
    ],
    build,
    ..hunt_crossley::DESCRIPTOR
};

const DAMPING: ParameterDescriptor = optional_non_negative(
    "damping",
    ParameterUnit::NewtonSecondPerMetre,
    "Maximum dashpot coefficient c_max",
);
const DAMPING_RATIO: ParameterDescriptor = optional_non_negative(
    "damping_ratio_n_mm_s",
    ParameterUnit::One,
    "c_max over k as numbers in N, mm and s, instead of damping",
);
const FULL_DAMPING_PENETRATION: ParameterDescriptor = ParameterDescriptor {
    default: Some(1.0e-4),
    minimum: (0.0, false),
    ..optional_non_negative(
        "full_damping_penetration",
        ParameterUnit::Metre,
        "Penetration d at which the dashpot is fully on",
    )
};

/// The dashpot is fully on: the second derivative of the force jumps where it comes to be.
const FULL: Phase = Phase::Branch(0);
/// `delta - d`.
const FULL_DAMPING: Guard = Guard::Model(0);
const PULLS: Transition = Transition {
    guard: Guard::RawForce,
    direction: Direction::Falling,
    target: Target::Phase(Phase::Released),
};

/// The dashpot is on in part. A force that returns beyond `d` begins here too, and goes over with
/// the next approach.
const APPROACH: [Transition; 2] = [
    PULLS,
    Transition {
        guard: FULL_DAMPING,
        direction: Direction::Rising,
        target: Target::Phase(FULL),
    },
];
const FULLY_DAMPED: [Transition; 2] = [
    PULLS,
    Transition {
        guard: FULL_DAMPING,
        direction: Direction::Falling,
        target: Target::Phase(Phase::Approach),
    },
];

/// Part of the penetration of full damping up to which a force that has let go does not return. There
/// the spring exceeds the dashpot once more, for nanometres before the floors part and by less
/// than a newton: the time with force ends where the force lets go, as with other laws.
const NEAR_END: f64 = 1.0e-3;

#[derive(Debug)]
struct AdamsImpact {
    stiffness: f64,
    exponent: f64,
    damping: f64,
    depth: f64,
}

fn build(parameters: &ModelParameters) -> Result<Box<dyn ImpactModel>, GapElementError> {
    let ratio = "damping_ratio_n_mm_s";
    let stiffness = parameters.get(&DESCRIPTOR, "stiffness")?;
    let exponent = parameters.exponent(&DESCRIPTOR);
    let damping = match (parameters.given("damping"), parameters.given(ratio)) {
        (Some(_), Some(_)) => {
            return Err(GapElementError::Conflict {
                model: DESCRIPTOR.name,
                first: "damping",
                second: ratio,
            });
        }
        (Some(damping), None) => damping,
        // k in N/mm^n is k_SI 10^(-3 n); N s/mm is 10^3 N s/m.
        (None, Some(value)) => value * stiffness * libm::pow(10.0, 3.0 - 3.0 * exponent),
        (None, None) => {
            return Err(DESCRIPTOR.missing("damping or damping_ratio_n_mm_s").into());
        }
    };
    Ok(Box::new(AdamsImpact {
        stiffness,
        exponent,
        damping,
        depth: parameters.get(&DESCRIPTOR, "full_damping_penetration")?,
    }))
}

impl AdamsImpact {
    /// Dashpot coefficient and its derivative: the function STEP. Its slope is
    /// continuous at both ends.
    fn step(&self, phase: Phase, delta: f64) -> (f64, f64) {
        if phase == FULL {
            return (self.damping, 0.0);
        }
        let s = (delta / self.depth).clamp(0.0, 1.0);
        (
            self.damping * s * s * (3.0 - 2.0 * s),
            self.damping * 6.0 * s * (1.0 - s) / self.depth,
        )
    }

    fn uncut(&self, phase: Phase, delta: f64, velocity: f64) -> Force {
        let (spring, slope) = elastic(self.stiffness, self.exponent, delta);
        let (coefficient, rate) = self.step(phase, delta);
        Force {
            value: spring + coefficient * velocity,
            by_penetration: slope + rate * velocity,
            by_velocity: coefficient,
        }
    }
}

impl ImpactModel for AdamsImpact {
    fn descriptor(&self) -> &'static ModelDescriptor {
        &DESCRIPTOR
    }
    fn separation(&self) -> SeparationRule {
        SeparationRule::NoTension
    }
    fn begin(&self, approach_velocity: f64, effective_mass: f64) -> Collision {
        Collision {
            approach_velocity,
            effective_mass,
            constants: [self.stiffness, self.damping, self.depth, 0.0],
        }
    }
    fn force(&self, _: &Collision, _: &Memory, phase: Phase, delta: f64, velocity: f64) -> Force {
        if phase == Phase::Released {
            return Force::default();
        }
        self.uncut(phase, delta, velocity)
    }
    /// The force over `delta^n`, and over `delta^2` for exponents from two on: no zero at closure and
    /// no pole or jump, as the dashpot's share grows like `delta^2` there. Of a contact that has let go it is
    /// taken no nearer to the end than [`NEAR_END`].
    fn raw_force(&self, _: &Collision, _: &Memory, phase: Phase, delta: f64, velocity: f64) -> f64 {
        let delta = match phase {
            Phase::Released => delta.max(NEAR_END * self.depth),
            _ => delta,
        };
        let full = phase == FULL || delta >= self.depth;
        if self.exponent >= 2.0 {
            // STEP over delta^2, from its polynomial where it is one.
            let coefficient = match full {
                true => self.damping / (delta * delta),
                false => {
                    let s = (delta / self.depth).max(0.0);
                    self.damping * (3.0 - 2.0 * s) / (self.depth * self.depth)
                }
            };
            let spring = libm::pow(delta.max(0.0), self.exponent - 2.0);
            return self.stiffness * spring + coefficient * velocity;
        }
        if delta <= 0.0 {
            return self.stiffness;
        }
        let (coefficient, _) = self.step(phase, delta);
        self.stiffness + coefficient / libm::pow(delta, self.exponent) * velocity
    }
    fn stored_energy(&self, _: &Collision, _: &Memory, _: Phase, delta: f64) -> f64 {
        hunt_crossley::stored_energy(self.stiffness, self.exponent, delta)
    }
    fn transitions(&self, phase: Phase) -> &'static [Transition] {
        match phase {
            Phase::Approach => &APPROACH,
            FULL => &FULLY_DAMPED,
            other => no_tension(other),
        }
    }
    fn guard(&self, _: u8, _: &Collision, _: &Memory, delta: f64, _velocity: f64) -> f64 {
        delta - self.depth
    }
    fn closed_form(&self, _approach_velocity: f64, _effective_mass: f64) -> Option<ClosedForm> {
        None
    }
    fn smooth_at_closure(&self) -> bool {
        self.exponent == 1.0
    }
}
