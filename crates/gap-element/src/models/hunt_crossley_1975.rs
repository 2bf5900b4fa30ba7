//! Hunt and Crossley: damping proportional to the spring force, from the slope of
//! restitution over speed.

use crate::classes::DampingPhases;
use crate::classes::hunt_crossley::{self, HuntCrossley};
use crate::descriptor::ModelDescriptor;
use crate::error::GapElementError;
use crate::model::ImpactModel;
use crate::parameters::ModelParameters;

pub(crate) static DESCRIPTOR: ModelDescriptor = ModelDescriptor {
    name: "hunt_crossley_1975",
    title: "Hunt-Crossley",
    formula: "F = k delta^n (1 + y v / v0);  y = (3/2) (1 - e)",
    citation: "Hunt and Crossley, J. Applied Mechanics 42 (1975) 440",
    traps: &[
        "Right to first order near e = 1 only: 0.7120 for 0.6, 0.7390 for 0.65; never below 0.487.",
        "Pulls if the floors separate faster than v0 / y; no_tension cuts that.",
    ],
    build,
    ..hunt_crossley::DESCRIPTOR
};

/// The paper's alpha = (3/2) (1 - e) / v0.
fn damping_factor(e: f64) -> f64 {
    1.5 * (1.0 - e)
}

fn build(parameters: &ModelParameters) -> Result<Box<dyn ImpactModel>, GapElementError> {
    HuntCrossley::build(&DESCRIPTOR, parameters, DampingPhases::Both, damping_factor)
}
