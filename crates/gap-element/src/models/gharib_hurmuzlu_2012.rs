//! Gharib and Hurmuzlu: for heavily damped collisions.

use crate::classes::DampingPhases;
use crate::classes::hunt_crossley::{self, HuntCrossley};
use crate::descriptor::{ModelDescriptor, Verification};
use crate::error::GapElementError;
use crate::model::ImpactModel;
use crate::parameters::ModelParameters;

pub(crate) static DESCRIPTOR: ModelDescriptor = ModelDescriptor {
    name: "gharib_hurmuzlu_2012",
    title: "Gharib-Hurmuzlu",
    formula: "F = k delta^n (1 + y v / v0);  y = 1 / e",
    citation: "Gharib and Hurmuzlu, J. Applied Mechanics 79 (2012) 064502",
    verification: Verification::SecondarySources(
        "relation as quoted in the literature, not read in the paper; behaviour verified against the closed form",
    ),
    traps: &[
        "Meant for small e: 0.0999816 for 0.1, 0.1970 for 0.2, but 0.4107 for 0.5.",
        "Does not become elastic: returns 0.5936 for 1.",
        "Pulls if the floors separate faster than v0 / y; no_tension cuts that.",
    ],
    build,
    ..hunt_crossley::DESCRIPTOR
};

/// The limit of the exact relation for e to zero.
fn damping_factor(e: f64) -> f64 {
    1.0 / e
}

fn build(parameters: &ModelParameters) -> Result<Box<dyn ImpactModel>, GapElementError> {
    HuntCrossley::build(&DESCRIPTOR, parameters, DampingPhases::Both, damping_factor)
}
