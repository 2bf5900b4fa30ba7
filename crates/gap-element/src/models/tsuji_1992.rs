//! Tsuji, Tanaka and Ishida: Hertz spring and dashpot in both phases.

use crate::classes::DampingPhases;
use crate::classes::linear::damping_ratio_zero_penetration;
use crate::classes::linear::{self, LinearClass};
use crate::descriptor::{Alias, ModelDescriptor, Verification};
use crate::error::GapElementError;
use crate::model::{ImpactModel, SeparationRule};
use crate::parameters::{DAMPING_RATIO, HERTZ_STIFFNESS, ModelParameters, RESTITUTION};

pub(crate) static DESCRIPTOR: ModelDescriptor = ModelDescriptor {
    name: "tsuji_1992",
    aliases: &[Alias {
        name: "chrono_hertz",
        citation: "contact force model of Chrono, with no_tension",
    }],
    title: "Hertz spring, dashpot in both phases",
    formula: "F = k delta^1.5 + c v;  c = 2 xi sqrt(k m sqrt(delta)),  xi = (sqrt5 / 2) zeta,  zeta = -ln e / sqrt(pi^2 + ln^2 e)",
    citation: "Tsuji, Tanaka and Ishida, Powder Technology 71 (1992) 239; the contact law \"Hertz\" of Chrono",
    class: "linear class, exponent 3/2, damping in both phases",
    parameters: &[HERTZ_STIFFNESS, RESTITUTION, DAMPING_RATIO],
    separation_rules: &[
        SeparationRule::ZeroPenetration,
        SeparationRule::NoTension,
        SeparationRule::NoTensionLatched,
    ],
    verification: Verification::SecondarySources(
        "formula as coded in Chrono; behaviour verified against the closed forms of the class",
    ),
    traps: &[
        "Exact restitution only while tension is allowed until zero penetration.",
        "With no_tension, as Chrono has it, the same xi returns more: 0.5503 for 0.5, 0.6748 for 0.65; exact_linear has the ratio that returns what is asked.",
        "The dashpot starts like delta^0.25: its tangent has no bound at closure.",
    ],
    build,
    ..linear::DESCRIPTOR
};

/// The relation in the terms of the paper.
fn xi(e: f64) -> f64 {
    0.5 * 5.0_f64.sqrt() * damping_ratio_zero_penetration(e)
}

fn build(parameters: &ModelParameters) -> Result<Box<dyn ImpactModel>, GapElementError> {
    let xi = parameters.damping(&DESCRIPTOR, "damping_ratio", xi)?;
    Ok(Box::new(LinearClass {
        descriptor: &DESCRIPTOR,
        stiffness: parameters.get(&DESCRIPTOR, "stiffness")?,
        exponent: 1.5,
        // The papers' c = 2 xi sqrt(k m sqrt(delta)) in terms of the class.
        zeta: 2.0 * xi / 5.0_f64.sqrt(),
        phases: DampingPhases::Both,
        separation: parameters.separation(&DESCRIPTOR),
    }))
}
