//! The exact member of the Hunt-Crossley class.

use crate::classes::DampingPhases;
use crate::classes::hunt_crossley::{self, HuntCrossley};
use crate::descriptor::ModelDescriptor;
use crate::error::GapElementError;
use crate::model::ImpactModel;
use crate::parameters::ModelParameters;

use crate::classes::hunt_crossley::damping_factor;

pub(crate) static DESCRIPTOR: ModelDescriptor = ModelDescriptor {
    name: "exact_hunt_crossley",
    title: "Exact Hunt-Crossley",
    formula: "F = k delta^n (1 + y v / v0);  y solves y (1 + e) = ln((1 + y) / (1 - y e))",
    citation: "closed form of the class, derived in docs/theory/contact-laws.md; compare Gonthier et al. 2004 and Khatiwada, Chouw and Butterworth, Engineering Structures 62-63 (2014) 33",
    recommended: true,
    traps: &[
        "Returns exactly what is asked, for every mass, stiffness and exponent, and every speed from 1 mm/s on, in a free collision.",
        "With exponent = 1 it is the exact modified Kelvin-Voigt law.",
        "Pulls if the floors separate faster than v0 / y; no_tension cuts that.",
    ],
    build,
    ..hunt_crossley::DESCRIPTOR
};

fn build(parameters: &ModelParameters) -> Result<Box<dyn ImpactModel>, GapElementError> {
    HuntCrossley::build(&DESCRIPTOR, parameters, DampingPhases::Both, damping_factor)
}
