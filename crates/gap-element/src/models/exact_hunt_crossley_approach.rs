//! The exact member of the approach-only Hunt-Crossley class.

use crate::classes::DampingPhases;
use crate::classes::hunt_crossley::{self, HuntCrossley};
use crate::descriptor::{ModelDescriptor, Verification};
use crate::error::GapElementError;
use crate::model::ImpactModel;
use crate::parameters::ModelParameters;

use crate::classes::hunt_crossley::damping_factor_approach_only;

pub(crate) static DESCRIPTOR: ModelDescriptor = ModelDescriptor {
    name: "exact_hunt_crossley_approach",
    title: "Exact Hunt-Crossley, damped in approach only",
    formula: "F = k delta^n (1 + y v / v0) (v > 0), k delta^n (v <= 0);  y solves e = sqrt(2 (y - ln(1 + y))) / y",
    citation: "closed form of the class, derived in docs/theory/contact-laws.md",
    class: "Hunt-Crossley class, damping in approach only",
    separation_rules: &[crate::model::SeparationRule::ZeroPenetration],
    recommended: true,
    verification: Verification::Verified("closed form e = sqrt(2 (y - ln(1 + y))) / y"),
    traps: &[
        "Returns exactly what is asked, for every mass, stiffness and exponent, and every speed from 1 mm/s on, in a free collision.",
        "Never pulls.",
        "Needs very strong damping at small e: y = 194.6 at 0.1.",
    ],
    build,
    ..hunt_crossley::DESCRIPTOR
};

fn build(parameters: &ModelParameters) -> Result<Box<dyn ImpactModel>, GapElementError> {
    HuntCrossley::build(
        &DESCRIPTOR,
        parameters,
        DampingPhases::ApproachOnly,
        damping_factor_approach_only,
    )
}
