//! Kuwabara and Kono: viscoelastic spheres; restitution falls with speed.

use crate::classes::hunt_crossley::{self, elastic};
use crate::classes::{no_tension, no_tension_latched};
use crate::descriptor::{
    AchievedRestitution, Alias, ModelDescriptor, ParameterDescriptor, ParameterUnit, Verification,
    constant,
};
use crate::error::GapElementError;
use crate::model::{
    ClosedForm, Collision, Force, ImpactModel, Memory, Phase, SeparationRule, Transition,
};
use crate::parameters::{HERTZ_STIFFNESS, ModelParameters, optional_non_negative};

pub(crate) static DESCRIPTOR: ModelDescriptor = ModelDescriptor {
    name: "kuwabara_kono_1987",
    aliases: &[Alias {
        name: "brilliantov_1996",
        citation: "Brilliantov, Spahn, Hertzsch and Poeschel, Physical Review E 53 (1996) 5382",
    }],
    title: "Viscoelastic spheres",
    formula: "F = k (delta^1.5 + (3/2) A delta^0.5 v)",
    citation: "Kuwabara and Kono, Japanese J. Applied Physics 26 (1987) 1230",
    class: "viscoelastic, restitution depends on speed",
    parameters: &[HERTZ_STIFFNESS, DISSIPATION_TIME],
    constants: &[
        constant("stiffness", ParameterUnit::NewtonPerMetreToExponent),
        constant("dissipation_time", ParameterUnit::Second),
    ],
    separation_rules: &[
        SeparationRule::NoTension,
        SeparationRule::ZeroPenetration,
        SeparationRule::NoTensionLatched,
    ],
    needs_approach_velocity: false,
    achieved_restitution: AchievedRestitution::Varies,
    verification: Verification::Verified(
        "independent integration at five dissipations with and without tension, and the series 1 - 1.15344 b + 0.79826 b^2 at small b = (3/2) A (k/m)^(2/5) v0^(1/5)",
    ),
    example: &[("stiffness", 2.75e9), ("dissipation_time", 2.1e-3)],
    traps: &[
        "No restitution can be asked for: it falls with speed and tends to 1 at rest, opposite to the laws of constant restitution.",
        "With zero_penetration it pulls at the end of the contact.",
        "The dashpot starts like delta^0.5: its tangent has no bound at closure.",
    ],
    build,
    ..hunt_crossley::DESCRIPTOR
};

const DISSIPATION_TIME: ParameterDescriptor = ParameterDescriptor {
    required: true,
    ..optional_non_negative(
        "dissipation_time",
        ParameterUnit::Second,
        "The material's dissipation A",
    )
};

#[derive(Debug)]
struct KuwabaraKono {
    stiffness: f64,
    /// (3/2) A.
    time: f64,
    separation: SeparationRule,
}

fn build(parameters: &ModelParameters) -> Result<Box<dyn ImpactModel>, GapElementError> {
    Ok(Box::new(KuwabaraKono {
        stiffness: parameters.get(&DESCRIPTOR, "stiffness")?,
        time: 1.5 * parameters.get(&DESCRIPTOR, "dissipation_time")?,
        separation: parameters.separation(&DESCRIPTOR),
    }))
}

impl ImpactModel for KuwabaraKono {
    fn descriptor(&self) -> &'static ModelDescriptor {
        &DESCRIPTOR
    }
    fn separation(&self) -> SeparationRule {
        self.separation
    }
    fn begin(&self, approach_velocity: f64, effective_mass: f64) -> Collision {
        Collision {
            approach_velocity,
            effective_mass,
            constants: [self.stiffness, self.time / 1.5, 0.0, 0.0],
        }
    }
    fn force(&self, _: &Collision, _: &Memory, phase: Phase, delta: f64, velocity: f64) -> Force {
        if phase == Phase::Released || delta <= 0.0 {
            return Force::default();
        }
        let root = self.stiffness * delta.sqrt();
        let reach = delta + self.time * velocity;
        Force {
            value: root * reach,
            by_penetration: root * (1.0 + 0.5 * reach / delta),
            by_velocity: root * self.time,
        }
    }
    /// `delta + (3/2) A v`: the sign of the force, without its zero at closure.
    fn raw_force(&self, _: &Collision, _: &Memory, _: Phase, delta: f64, velocity: f64) -> f64 {
        delta + self.time * velocity
    }
    fn stored_energy(&self, _: &Collision, _: &Memory, _: Phase, delta: f64) -> f64 {
        elastic(self.stiffness, 1.5, delta).0 * delta / 2.5
    }
    fn transitions(&self, phase: Phase) -> &'static [Transition] {
        match self.separation {
            SeparationRule::NoTension => no_tension(phase),
            SeparationRule::NoTensionLatched => no_tension_latched(phase),
            _ => &[],
        }
    }
    fn closed_form(&self, _approach_velocity: f64, _effective_mass: f64) -> Option<ClosedForm> {
        None
    }
    fn smooth_at_closure(&self) -> bool {
        false
    }
}
