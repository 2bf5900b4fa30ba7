//! Ye and Li: modified Kelvin-Voigt with damping proportional to penetration.

use crate::classes::DampingPhases;
use crate::classes::hunt_crossley::{self, HuntCrossley};
use crate::descriptor::{Alias, ModelDescriptor};
use crate::error::GapElementError;
use crate::model::ImpactModel;
use crate::parameters::ModelParameters;

pub(crate) static DESCRIPTOR: ModelDescriptor = ModelDescriptor {
    name: "ye_li_2009",
    aliases: &[Alias {
        name: "modified_kelvin_voigt",
        citation: "common name",
    }],
    title: "Modified Kelvin-Voigt of Ye and Li",
    formula: "F = k delta (1 + y v / v0);  y = (3/2) (1 - e) / e",
    citation: "Ye and Li, Frontiers of Architecture and Civil Engineering in China 3 (2009) 142, equations 8-10; Ye, Li and Zhu, Earthquake Engineering and Engineering Vibration 8 (2009) 433",
    traps: &[
        "Derived on the undamped trajectory: 0.4877 for 0.5, 0.5936 for 0.6, 0.6457 for 0.65; poor at small e (0.0741 for 0.1).",
        "Pulls if the floors separate faster than v0 / y; no_tension cuts that.",
    ],
    build,
    ..hunt_crossley::LINEAR_DESCRIPTOR
};

/// Equation 10 of the paper.
pub(super) fn damping_factor(e: f64) -> f64 {
    1.5 * (1.0 - e) / e
}

fn build(parameters: &ModelParameters) -> Result<Box<dyn ImpactModel>, GapElementError> {
    HuntCrossley::build(&DESCRIPTOR, parameters, DampingPhases::Both, damping_factor)
}
