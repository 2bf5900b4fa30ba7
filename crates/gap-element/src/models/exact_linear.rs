//! The exact member of the linear class with any exponent, for either separation rule.

use super::exact_kelvin_voigt::relation;
use crate::classes::DampingPhases;
use crate::classes::linear::{self, LinearClass};
use crate::descriptor::{ModelDescriptor, Verification};
use crate::error::GapElementError;
use crate::model::{ImpactModel, SeparationRule};
use crate::parameters::ModelParameters;

pub(crate) static DESCRIPTOR: ModelDescriptor = ModelDescriptor {
    name: "exact_linear",
    title: "Exact linear class",
    formula: "F = k delta^n + c delta^((n-1)/2) v;  c = zeta sqrt(2 (n + 1) k m),  zeta from e for the separation rule in force",
    citation: "closed forms of the class, derived in docs/theory/contact-laws.md; Antypov and Elliott, EPL 94 (2011) 50004 for n = 3/2",
    separation_rules: &[
        SeparationRule::NoTension,
        SeparationRule::ZeroPenetration,
        SeparationRule::NoTensionLatched,
        SeparationRule::GapShift,
    ],
    recommended: true,
    verification: Verification::Verified(
        "closed form of the oscillator in delta^((n+1)/2), all separation rules",
    ),
    traps: &[
        "Returns exactly what is asked, with or without tension, in a free collision.",
        "The dashpot starts like delta^((n-1)/2): its tangent has no bound at closure.",
    ],
    build,
    ..linear::DESCRIPTOR
};

fn build(parameters: &ModelParameters) -> Result<Box<dyn ImpactModel>, GapElementError> {
    LinearClass::build(
        &DESCRIPTOR,
        parameters,
        DampingPhases::Both,
        relation(parameters.separation(&DESCRIPTOR)),
    )
}
