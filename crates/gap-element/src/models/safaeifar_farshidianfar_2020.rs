//! Safaeifar and Farshidianfar.

use crate::classes::DampingPhases;
use crate::classes::hunt_crossley::{self, HuntCrossley};
use crate::descriptor::{ModelDescriptor, Verification};
use crate::error::GapElementError;
use crate::model::ImpactModel;
use crate::parameters::ModelParameters;

pub(crate) static DESCRIPTOR: ModelDescriptor = ModelDescriptor {
    name: "safaeifar_farshidianfar_2020",
    title: "Safaeifar-Farshidianfar",
    formula: "F = k delta^n (1 + y v / v0);  y = (5/4) (1 - e) / e",
    citation: "Safaeifar and Farshidianfar, Multibody System Dynamics 50 (2020) 233",
    verification: Verification::SecondarySources(
        "the constant 5/4 could not be verified in the paper; behaviour verified against the closed form",
    ),
    traps: &[
        "Returns 0.5362 for 0.5, 0.6383 for 0.6, 0.8271 for 0.8; its slope at e = 1 is 5/4 where the exact one is 3/2.",
        "Pulls if the floors separate faster than v0 / y; no_tension cuts that.",
    ],
    build,
    ..hunt_crossley::DESCRIPTOR
};

/// Relation of the paper.
fn damping_factor(e: f64) -> f64 {
    1.25 * (1.0 - e) / e
}

fn build(parameters: &ModelParameters) -> Result<Box<dyn ImpactModel>, GapElementError> {
    HuntCrossley::build(&DESCRIPTOR, parameters, DampingPhases::Both, damping_factor)
}
