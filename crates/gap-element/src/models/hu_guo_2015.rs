//! Hu and Guo: the relation of Ye and Li with the spring of Hertz.

use crate::classes::DampingPhases;
use crate::classes::hunt_crossley::{self, HuntCrossley};
use crate::descriptor::{ModelDescriptor, Verification};
use crate::error::GapElementError;
use crate::model::ImpactModel;
use crate::parameters::ModelParameters;

use super::ye_li_2009::damping_factor;

pub(crate) static DESCRIPTOR: ModelDescriptor = ModelDescriptor {
    name: "hu_guo_2015",
    title: "Hu-Guo",
    formula: "F = k delta^n (1 + y v / v0);  y = (3/2) (1 - e) / e",
    citation: "Hu and Guo, Multibody System Dynamics 35 (2015) 131",
    verification: Verification::SecondarySources(
        "relation as quoted in the literature, not read in the paper; behaviour verified against the closed form",
    ),
    traps: &[
        "Among the best explicit relations: 0.4877 for 0.5, 0.5936 for 0.6, 0.7992 for 0.8; poor at small e (0.0741 for 0.1).",
        "Pulls if the floors separate faster than v0 / y; no_tension cuts that.",
    ],
    build,
    ..hunt_crossley::DESCRIPTOR
};

fn build(parameters: &ModelParameters) -> Result<Box<dyn ImpactModel>, GapElementError> {
    HuntCrossley::build(&DESCRIPTOR, parameters, DampingPhases::Both, damping_factor)
}
