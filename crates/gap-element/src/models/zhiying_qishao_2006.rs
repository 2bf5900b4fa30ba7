//! Zhiying and Qishao: Lankarani and Nikravesh with an exponential correction.

use crate::classes::DampingPhases;
use crate::classes::hunt_crossley::{self, HuntCrossley};
use crate::descriptor::{ModelDescriptor, Verification};
use crate::error::GapElementError;
use crate::model::ImpactModel;
use crate::parameters::ModelParameters;

pub(crate) static DESCRIPTOR: ModelDescriptor = ModelDescriptor {
    name: "zhiying_qishao_2006",
    title: "Zhiying-Qishao",
    formula: "F = k delta^n (1 + y v / v0);  y = (3/4) (1 - e^2) exp(2 (1 - e))",
    citation: "Zhiying and Qishao, Multibody contact (2006)",
    verification: Verification::SecondarySources(
        "relation as quoted in the literature, not read in the paper; behaviour verified against the closed form",
    ),
    traps: &[
        "Good above e = 0.4 (0.4826 for 0.5, 0.7874 for 0.8), poor below: 0.2175 for 0.1.",
        "Pulls if the floors separate faster than v0 / y; no_tension cuts that.",
    ],
    build,
    ..hunt_crossley::DESCRIPTOR
};

/// Relation of the paper.
fn damping_factor(e: f64) -> f64 {
    0.75 * (1.0 - e * e) * libm::exp(2.0 * (1.0 - e))
}

fn build(parameters: &ModelParameters) -> Result<Box<dyn ImpactModel>, GapElementError> {
    HuntCrossley::build(&DESCRIPTOR, parameters, DampingPhases::Both, damping_factor)
}
