//! The exact member of the linear class with exponent 1, for every separation rule.

use crate::classes::DampingPhases;
use crate::classes::linear::{self, LinearClass};
use crate::classes::linear::{damping_ratio_no_tension, damping_ratio_zero_penetration};
use crate::descriptor::{ModelDescriptor, Verification};
use crate::error::GapElementError;
use crate::model::{ImpactModel, SeparationRule};
use crate::parameters::ModelParameters;

pub(crate) static DESCRIPTOR: ModelDescriptor = ModelDescriptor {
    name: "exact_kelvin_voigt",
    title: "Exact Kelvin-Voigt",
    formula: "F = k delta + c v;  c = 2 zeta sqrt(k m),  zeta from e for the separation rule in force",
    citation: "closed forms of the class, derived in docs/theory/contact-laws.md",
    separation_rules: &[
        SeparationRule::NoTension,
        SeparationRule::ZeroPenetration,
        SeparationRule::NoTensionLatched,
        SeparationRule::GapShift,
    ],
    recommended: true,
    verification: Verification::Verified(
        "closed form of the damped oscillator, all separation rules",
    ),
    traps: &[
        "Returns exactly what is asked, with or without tension, in a free collision.",
        "Without tension zeta exceeds 1 below e = 0.135.",
        "The force jumps to c v0 at closure.",
    ],
    build,
    ..linear::LINEAR_DESCRIPTOR
};

/// The relation that is exact for this separation rule.
pub(super) fn relation(separation: SeparationRule) -> fn(f64) -> f64 {
    if separation.forbids_tension() {
        damping_ratio_no_tension
    } else {
        damping_ratio_zero_penetration
    }
}

fn build(parameters: &ModelParameters) -> Result<Box<dyn ImpactModel>, GapElementError> {
    LinearClass::build(
        &DESCRIPTOR,
        parameters,
        DampingPhases::Both,
        relation(parameters.separation(&DESCRIPTOR)),
    )
}
