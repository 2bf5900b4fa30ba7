//! Hertzdamp corrected by Ye, Li and Zhu.

use crate::classes::DampingPhases;
use crate::classes::hunt_crossley::{self, HuntCrossley};
use crate::descriptor::{Alias, ModelDescriptor, Verification};
use crate::error::GapElementError;
use crate::model::ImpactModel;
use crate::parameters::ModelParameters;

pub(crate) static DESCRIPTOR: ModelDescriptor = ModelDescriptor {
    name: "ye_li_zhu_2009",
    aliases: &[Alias {
        name: "flores_2011",
        citation: "Flores, Machado, Silva and Martins, Multibody System Dynamics 25 (2011) 357",
    }],
    title: "Hertzdamp of Ye, Li and Zhu",
    formula: "F = k delta^n (1 + y v / v0);  y = (8/5) (1 - e) / e",
    citation: "Ye, Li and Zhu, Earthquake Engineering and Structural Dynamics 38 (2009) 1135, as documented in OpenSees",
    verification: Verification::Verified(
        "Hertzdamp of OpenSees in a pair of single storeys: peaks to 2e-6 at its steps of 10 us, falling with them (pounding verify structures); closed form of the class",
    ),
    traps: &[
        "The paper was not read: the relation is the one that OpenSees documents.",
        "Hertzdamp of OpenSees takes the approach velocity at the end of its first step in contact, one step late; here it is that of the located closure. The difference falls with the step.",
        "Returns less than asked: 0.4704 for 0.5, 0.5773 for 0.6, 0.6303 for 0.65.",
        "Its slope at e = 1 is 8/5 where the exact one is 3/2.",
        "Long tails at small e: at e = 0.1 the contact lasts 2.41 times as long as an elastic one.",
        "Pulls if the floors separate faster than v0 / y; no_tension cuts that.",
    ],
    build,
    ..hunt_crossley::DESCRIPTOR
};

/// Relation of the paper.
fn damping_factor(e: f64) -> f64 {
    1.6 * (1.0 - e) / e
}

fn build(parameters: &ModelParameters) -> Result<Box<dyn ImpactModel>, GapElementError> {
    HuntCrossley::build(&DESCRIPTOR, parameters, DampingPhases::Both, damping_factor)
}
