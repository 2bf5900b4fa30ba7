//! Hertz contact: `F = k delta^1.5`.

use crate::classes::hunt_crossley::{self, HuntCrossley};
use crate::descriptor::{
    AchievedRestitution, ModelDescriptor, ParameterUnit, Verification, constant,
};
use crate::error::GapElementError;
use crate::model::{ImpactModel, SeparationRule};
use crate::parameters::{HERTZ_STIFFNESS, ModelParameters};

pub(crate) static DESCRIPTOR: ModelDescriptor = ModelDescriptor {
    name: "hertz_1882",
    title: "Hertz contact without damping",
    formula: "F = k delta^1.5",
    citation: "Hertz, J. reine angew. Math. 92 (1882) 156; in pounding: Jing and Young, Earthquake Engineering and Structural Dynamics 20 (1991) 667; Chau and Wei, Earthquake Engineering and Structural Dynamics 30 (2001) 633",
    class: "elastic",
    parameters: &[HERTZ_STIFFNESS],
    constants: &[constant(
        "stiffness",
        ParameterUnit::NewtonPerMetreToExponent,
    )],
    separation_rules: &[SeparationRule::ZeroPenetration],
    needs_approach_velocity: false,
    achieved_restitution: AchievedRestitution::Elastic,
    verification: Verification::Verified("closed form: contact time 2.9432751843 delta_max / v0"),
    traps: &[
        "Returns all energy: restitution is 1.",
        "Derived for curved bodies; the stiffness of slab against slab is a fitted penalty, not Hertz's.",
    ],
    build,
    ..hunt_crossley::DESCRIPTOR
};

fn build(parameters: &ModelParameters) -> Result<Box<dyn ImpactModel>, GapElementError> {
    HuntCrossley::elastic(&DESCRIPTOR, parameters, 1.5)
}
