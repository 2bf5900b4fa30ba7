//! Gonthier, McPhee, Lange and Piedboeuf: the exact equation, solved approximately.

use crate::classes::DampingPhases;
use crate::classes::hunt_crossley::{self, HuntCrossley};
use crate::descriptor::{ModelDescriptor, Verification};
use crate::error::GapElementError;
use crate::model::ImpactModel;
use crate::parameters::ModelParameters;

pub(crate) static DESCRIPTOR: ModelDescriptor = ModelDescriptor {
    name: "gonthier_2004",
    title: "Gonthier",
    formula: "F = k delta^n (1 + y v / v0);  y = (1 - e^2) / e",
    citation: "Gonthier, McPhee, Lange and Piedboeuf, Multibody System Dynamics 11 (2004) 209",
    verification: Verification::SecondarySources(
        "relation as quoted in the literature, not read in the paper; behaviour verified against the closed form",
    ),
    traps: &[
        "Good at small e, poor near one: 0.4877 for 0.5, 0.5773 for 0.6, 0.7680 for 0.8; its slope at e = 1 is 2 where the exact one is 3/2.",
        "Pulls if the floors separate faster than v0 / y; no_tension cuts that.",
    ],
    build,
    ..hunt_crossley::DESCRIPTOR
};

/// The paper's d = 1 - e^2, an approximation of the root of its own equation
/// `(1 + d/e) / (1 - d) = exp(d (1 + 1/e))`, which is the exact one of the class.
fn damping_factor(e: f64) -> f64 {
    (1.0 - e * e) / e
}

fn build(parameters: &ModelParameters) -> Result<Box<dyn ImpactModel>, GapElementError> {
    HuntCrossley::build(&DESCRIPTOR, parameters, DampingPhases::Both, damping_factor)
}
