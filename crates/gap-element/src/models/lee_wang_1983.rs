//! Lee and Wang: half the factor of Hunt and Crossley.

use crate::classes::DampingPhases;
use crate::classes::hunt_crossley::{self, HuntCrossley};
use crate::descriptor::{ModelDescriptor, Verification};
use crate::error::GapElementError;
use crate::model::ImpactModel;
use crate::parameters::ModelParameters;

pub(crate) static DESCRIPTOR: ModelDescriptor = ModelDescriptor {
    name: "lee_wang_1983",
    title: "Lee-Wang",
    formula: "F = k delta^n (1 + y v / v0);  y = (3/4) (1 - e)",
    citation: "Lee and Wang, J. Dynamic Systems, Measurement and Control 105 (1983) 278",
    verification: Verification::SecondarySources(
        "relation as quoted in the literature, not read in the paper; behaviour verified against the closed form",
    ),
    traps: &[
        "Wrong by a factor of two even for nearly elastic impact: the exact slope at e = 1 is (3/2) (1 - e).",
        "Returns 0.8329 for 0.6 and never less than 0.66.",
        "Pulls if the floors separate faster than v0 / y; no_tension cuts that.",
    ],
    build,
    ..hunt_crossley::DESCRIPTOR
};

/// Relation of the paper.
fn damping_factor(e: f64) -> f64 {
    0.75 * (1.0 - e)
}

fn build(parameters: &ModelParameters) -> Result<Box<dyn ImpactModel>, GapElementError> {
    HuntCrossley::build(&DESCRIPTOR, parameters, DampingPhases::Both, damping_factor)
}
