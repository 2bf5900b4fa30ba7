//! Kelvin-Voigt: spring and dashpot in both phases.

use crate::classes::DampingPhases;
use crate::classes::linear::damping_ratio_zero_penetration;
use crate::classes::linear::{self, LinearClass};
use crate::descriptor::{Alias, ModelDescriptor, Verification};
use crate::error::GapElementError;
use crate::model::{ImpactModel, SeparationRule};
use crate::parameters::ModelParameters;

pub(crate) static DESCRIPTOR: ModelDescriptor = ModelDescriptor {
    name: "anagnostopoulos_2004",
    aliases: &[
        Alias {
            name: "kelvin_voigt",
            citation: "common name",
        },
        Alias {
            name: "anagnostopoulos_1988",
            citation: "Anagnostopoulos, Earthquake Engineering and Structural Dynamics 16 (1988) 443",
        },
    ],
    title: "Kelvin-Voigt spring and dashpot",
    formula: "F = k delta + c v;  c = 2 zeta sqrt(k m),  zeta = -ln e / sqrt(pi^2 + ln^2 e)",
    citation: "Anagnostopoulos, Earthquake Engineering and Structural Dynamics 16 (1988) 443 and 33 (2004) 897, equations 2-4",
    separation_rules: &[
        SeparationRule::ZeroPenetration,
        SeparationRule::NoTension,
        SeparationRule::NoTensionLatched,
        SeparationRule::GapShift,
    ],
    verification: Verification::Verified(
        "closed form of the damped oscillator, all separation rules",
    ),
    traps: &[
        "Exact restitution only while tension is allowed until zero penetration: it pulls during the last part of the contact.",
        "With no_tension the same zeta(e) returns more: 0.2527 for 0.1, 0.5503 for 0.5, 0.6748 for 0.65, 0.7182 for 0.7; exact_kelvin_voigt has the ratio that returns what is asked.",
        "no_tension is max(0, k delta + c v), without memory; no_tension_latched stays off until the floors approach again or part; gap_shift lets the penetration left at zero force widen the gap.",
        "The force jumps to c v0 at closure.",
        "The mass in c is m1 m2 / (m1 + m2) of the two floors, not their sum.",
    ],
    build,
    ..linear::LINEAR_DESCRIPTOR
};

fn build(parameters: &ModelParameters) -> Result<Box<dyn ImpactModel>, GapElementError> {
    LinearClass::build(
        &DESCRIPTOR,
        parameters,
        DampingPhases::Both,
        damping_ratio_zero_penetration,
    )
}
