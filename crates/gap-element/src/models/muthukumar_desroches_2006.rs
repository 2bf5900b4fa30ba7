//! Hertzdamp: the law of Lankarani and Nikravesh brought to pounding.

use crate::classes::DampingPhases;
use crate::classes::hunt_crossley::{self, HuntCrossley};
use crate::descriptor::{Alias, ModelDescriptor};
use crate::error::GapElementError;
use crate::model::ImpactModel;
use crate::parameters::ModelParameters;

use super::lankarani_nikravesh_1990::damping_factor;

pub(crate) static DESCRIPTOR: ModelDescriptor = ModelDescriptor {
    name: "muthukumar_desroches_2006",
    aliases: &[Alias {
        name: "hertzdamp",
        citation: "name in OpenSees (impact material HertzDamp)",
    }],
    title: "Hertzdamp",
    formula: "F = k delta^n (1 + y v / v0), n = 3/2;  y = (3/4) (1 - e^2)",
    citation: "Muthukumar and DesRoches, Earthquake Engineering and Structural Dynamics 35 (2006) 811",
    traps: &[
        "Hertzdamp of OpenSees takes the approach velocity at the end of its first step in contact, one step late; here it is that of the located closure. Peaks of pairs agree to 6e-6 at steps of 10 us (pounding verify structures).",
        "The relation of lankarani_nikravesh_1990: 0.7252 for 0.5, 0.7561 for 0.6, 0.7748 for 0.65; never below 0.66.",
        "Pulls if the floors separate faster than v0 / y; no_tension cuts that.",
    ],
    build,
    ..hunt_crossley::DESCRIPTOR
};

fn build(parameters: &ModelParameters) -> Result<Box<dyn ImpactModel>, GapElementError> {
    HuntCrossley::build(&DESCRIPTOR, parameters, DampingPhases::Both, damping_factor)
}
