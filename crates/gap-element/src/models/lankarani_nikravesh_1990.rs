//! Lankarani and Nikravesh: energy balance along the elastic trajectory.

use crate::classes::DampingPhases;
use crate::classes::hunt_crossley::{self, HuntCrossley};
use crate::descriptor::ModelDescriptor;
use crate::error::GapElementError;
use crate::model::ImpactModel;
use crate::parameters::ModelParameters;

pub(crate) static DESCRIPTOR: ModelDescriptor = ModelDescriptor {
    name: "lankarani_nikravesh_1990",
    title: "Lankarani-Nikravesh",
    formula: "F = k delta^n (1 + y v / v0);  y = (3/4) (1 - e^2)",
    citation: "Lankarani and Nikravesh, J. Mechanical Design 112 (1990) 369",
    traps: &[
        "The elastic trajectory is right near e = 1 only: 0.7252 for 0.5, 0.7561 for 0.6, 0.7748 for 0.65; never below 0.66.",
        "Pulls if the floors separate faster than v0 / y; no_tension cuts that.",
    ],
    build,
    ..hunt_crossley::DESCRIPTOR
};

/// The loss of the elastic trajectory set equal to the loss asked for.
pub(super) fn damping_factor(e: f64) -> f64 {
    0.75 * (1.0 - e * e)
}

fn build(parameters: &ModelParameters) -> Result<Box<dyn ImpactModel>, GapElementError> {
    HuntCrossley::build(&DESCRIPTOR, parameters, DampingPhases::Both, damping_factor)
}
