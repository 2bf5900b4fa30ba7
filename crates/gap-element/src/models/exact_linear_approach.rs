//! The exact member of the linear class with damping in approach only, any exponent.

use crate::classes::DampingPhases;
use crate::classes::linear::damping_ratio_approach_only;
use crate::classes::linear::{self, LinearClass};
use crate::descriptor::{ModelDescriptor, Verification};
use crate::error::GapElementError;
use crate::model::ImpactModel;
use crate::parameters::ModelParameters;

pub(crate) static DESCRIPTOR: ModelDescriptor = ModelDescriptor {
    name: "exact_linear_approach",
    title: "Exact linear class, damped in approach only",
    formula: "F = k delta^n + c delta^((n-1)/2) v (v > 0), k delta^n (v <= 0);  c = zeta sqrt(2 (n + 1) k m),  zeta solves e = exp(-g(zeta))",
    citation: "closed forms of the class, derived in docs/theory/contact-laws.md",
    class: "linear class, damping in approach only",
    recommended: true,
    verification: Verification::Verified("closed form e = exp(-g(zeta)) of approach-only damping"),
    traps: &[
        "Returns exactly what is asked in a free collision, and never pulls.",
        "With exponent = 1 it is Mahmoud and Jankowski 2011, with exponent = 3/2 Jankowski 2005, each with the damping that their relations approximate.",
        "zeta exceeds 1 below e = 0.368.",
    ],
    build,
    ..linear::DESCRIPTOR
};

fn build(parameters: &ModelParameters) -> Result<Box<dyn ImpactModel>, GapElementError> {
    LinearClass::build(
        &DESCRIPTOR,
        parameters,
        DampingPhases::ApproachOnly,
        damping_ratio_approach_only,
    )
}
