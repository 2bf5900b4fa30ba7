//! Linear spring: `F = k delta`.

use crate::classes::hunt_crossley::{self, HuntCrossley};
use crate::descriptor::{
    AchievedRestitution, ModelDescriptor, ParameterUnit, Verification, constant,
};
use crate::error::GapElementError;
use crate::model::{ImpactModel, SeparationRule};
use crate::parameters::{LINEAR_STIFFNESS, ModelParameters};

pub(crate) static DESCRIPTOR: ModelDescriptor = ModelDescriptor {
    name: "linear_elastic",
    title: "Linear spring",
    formula: "F = k delta",
    citation: "Textbook law; in pounding since Maison and Kasai, Earthquake Spectra 6 (1990) 711",
    class: "elastic",
    parameters: &[LINEAR_STIFFNESS],
    constants: &[constant("stiffness", ParameterUnit::NewtonPerMetre)],
    separation_rules: &[SeparationRule::ZeroPenetration],
    needs_approach_velocity: false,
    achieved_restitution: AchievedRestitution::Elastic,
    verification: Verification::Verified("closed form of the harmonic half wave"),
    example: &[("stiffness", 9.35e7)],
    traps: &["Returns all energy: restitution is 1 whatever the floors are made of."],
    build,
    ..hunt_crossley::DESCRIPTOR
};

fn build(parameters: &ModelParameters) -> Result<Box<dyn ImpactModel>, GapElementError> {
    HuntCrossley::elastic(&DESCRIPTOR, parameters, 1.0)
}
