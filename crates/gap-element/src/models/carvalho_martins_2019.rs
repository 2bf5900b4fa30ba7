//! Carvalho and Martins: a rational approximation of the exact relation.

use crate::classes::DampingPhases;
use crate::classes::hunt_crossley::{self, HuntCrossley};
use crate::descriptor::{ModelDescriptor, Verification};
use crate::error::GapElementError;
use crate::model::ImpactModel;
use crate::parameters::ModelParameters;

pub(crate) static DESCRIPTOR: ModelDescriptor = ModelDescriptor {
    name: "carvalho_martins_2019",
    title: "Carvalho-Martins, explicit form",
    formula: "F = k delta^n (1 + y v / v0);  y = (3/2) (1 - e) (11 - e) / (1 + 9 e)",
    citation: "Carvalho and Martins, Mechanism and Machine Theory 139 (2019) 174",
    verification: Verification::SecondarySources(
        "rational form quoted in the literature; confirmed numerically as an excellent inverse of the exact equation",
    ),
    traps: &[
        "The best explicit relation: right to 2e-4 for e of 0.5 and more; 0.1289 for 0.1.",
        "Pulls if the floors separate faster than v0 / y; no_tension cuts that.",
    ],
    build,
    ..hunt_crossley::DESCRIPTOR
};

/// The explicit approximation of the exact inverse.
fn damping_factor(e: f64) -> f64 {
    1.5 * (1.0 - e) * (11.0 - e) / (1.0 + 9.0 * e)
}

fn build(parameters: &ModelParameters) -> Result<Box<dyn ImpactModel>, GapElementError> {
    HuntCrossley::build(&DESCRIPTOR, parameters, DampingPhases::Both, damping_factor)
}
